// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_PLACEMENT_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_PLACEMENT_H

#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>

namespace selvedge {

/// The rule that every vertex may move along every edge.
struct No_border_rule
{
  template <class Halfedge>
  bool may_move(const Halfedge&) const
  {
    return true;
  }
};

/// Places the merged vertex at one end of its edge: of the two directions those that the rule allows, of these the
/// cheaper. Where it allows neither, the cheaper, for a filter to refuse and count.
///
/// With this placement every vertex of the result is a vertex of the input, bit for bit.
///
/// A model of CGAL's concept `GetPlacement`. `Cost` has `cost_at(profile, point)`, as `Quadric_cost` has;
/// `Rule` has `may_move(halfedge)`, as `Border_rule` has.
///
/// **Reference** Derichs, Misiak, Fuhrmann, section 3 and figure 4.
template <class TriangleMesh, class Cost, class Rule = No_border_rule>
class Halfedge_placement
{
public:
  using TM = TriangleMesh; // named by CGAL's own placement decorators

  explicit Halfedge_placement(const Cost& cost, const Rule& rule = {}) : m_cost(cost), m_rule(rule) {}

  template <class Profile>
  internal::Optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    return is_v0_target_first(profile) ? profile.p0() : profile.p1();
  }

  /// Is the first choice to move v1 onto v0?
  template <class Profile>
  bool is_v0_target_first(const Profile& profile) const
  {
    const bool may_move_v0 = m_rule.may_move(profile.v0_v1());
    const bool may_move_v1 = m_rule.may_move(profile.v1_v0());
    if (may_move_v0 != may_move_v1)
      return may_move_v1;
    return cost_at(profile, profile.p0()) < cost_at(profile, profile.p1());
  }

  template <class Profile, class Point>
  double cost_at(const Profile& profile, const Point& point) const
  {
    return m_cost.cost_at(profile, point);
  }

private:
  Cost m_cost;
  Rule m_rule;
};

/// Decorates a `Halfedge_placement` so that an edge gets its second direction when filters refuse the first.
///
/// CGAL's loop takes an edge from its queue once, asks for one placement, and drops the edge when a filter refuses
/// that. This decorator asks the filter itself, for one direction and then the other, and answers with the one that
/// passed, or none. The second direction gets its chance when its turn has come: when it costs no more than some
/// edge has that was selected before. Sooner, and the dear directions of cheap edges would spoil what
/// the order by cost is for (on a scanned bunny the mean error at 30 % grows by half).
///
/// The loop's visitor must call `expect_decision` in `OnSelected`: that tells the popping of an edge, when the question
/// is asked in earnest, from the mere computing of a cost, for which the filters would be far too dear. The same filter
/// need not be given to the loop.
///
/// A model of CGAL's concept `GetPlacement`. Copies share one state.
template <class Placement, class Filter = No_filter>
class Filtered_halfedge_placement
{
  struct State
  {
    bool is_deciding = false;
    double reached_cost = 0;
    std::size_t deferrals = 0;
  };

public:
  using TM = typename Placement::TM;

  explicit Filtered_halfedge_placement(const Placement& placement, const Filter& filter = {})
    : m_placement(placement), m_filter(filter), m_state(std::make_shared<State>())
  {}

  template <class Profile>
  internal::Optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    using Result = internal::Optional<typename Profile::Point>;
    const bool is_v0_target = m_placement.is_v0_target_first(profile);
    const Result first = is_v0_target ? profile.p0() : profile.p1();
    if (!m_state->is_deciding)
      return first;
    m_state->is_deciding = false;
    m_state->reached_cost = (std::max)(m_state->reached_cost, m_placement.cost_at(profile, *first));
    if (const Result accepted = m_filter(profile, first))
      return accepted;
    const Result second = is_v0_target ? profile.p1() : profile.p0();
    if (m_placement.cost_at(profile, *second) <= m_state->reached_cost)
      return m_filter(profile, second);
    ++m_state->deferrals;
    return {};
  }

  /// The next placement asked for is a decision; to be called by the loop's visitor.
  void expect_decision() const { m_state->is_deciding = true; }

  /// How many second directions were not tried because their turn had not come.
  std::size_t deferrals() const { return m_state->deferrals; }

  /// From now on every second direction is tried at once.
  void stop_deferring() const { m_state->reached_cost = std::numeric_limits<double>::infinity(); }

private:
  Placement m_placement;
  Filter m_filter;
  std::shared_ptr<State> m_state;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_PLACEMENT_H
