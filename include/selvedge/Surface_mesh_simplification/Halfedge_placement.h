// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_PLACEMENT_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_PLACEMENT_H

#include <selvedge/Surface_mesh_simplification/collapse_locality.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/internal/No_visitor.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/Surface_mesh_simplification/internal/require_initialised.h>

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace selvedge {

/// Lets every vertex move along every edge: the default rule of `Halfedge_placement`.
struct No_border_rule
{
  template <class Halfedge>
  bool may_move(const Halfedge&) const
  {
    return true;
  }

  template <class Vertex>
  bool is_free(const Vertex&) const
  {
    return true;
  }

  template <class Vertex>
  bool reaches_neighbours(const Vertex&) const
  {
    return false;
  }

  template <class Vertex, class Edge>
  bool reaches(const Vertex&, const Edge&) const
  {
    return false;
  }
};

/// Places the merged vertex at one end of its edge, so that every vertex of the result is a vertex of the
/// input, bit for bit.
///
/// Of the directions that the rule allows, it takes the cheaper one. Where the rule allows neither, it
/// returns the cheaper one all the same, so that a filter refuses and counts it.
///
/// A model of CGAL's concept `GetPlacement`. `Cost` is a model of `GetCost` with a further function
/// `cost_along(profile, halfedge)`, as `Quadric_cost` has: the same cost, for moving the source of a halfedge
/// of the profile's edge onto its target. It may also have `costs_along(profile)`, which returns the costs of
/// moving v0 onto v1 and v1 onto v0 in less time. With `cost_bounds(profile)`, two optional costs that these
/// do not fall below, a loop computes most costs only when an edge comes to be the cheapest. `Rule`
/// has `may_move(halfedge)`, `is_free(vertex)`, `reaches_neighbours(vertex)` and `reaches(vertex, edge)`, as
/// `Border_rule` has.
///
/// **Reference** Derichs, Misiak, Fuhrmann, section 3 and figure 4.
template <class TriangleMesh, class Cost, class Rule = No_border_rule>
class Halfedge_placement
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Edge = typename Graph_traits::edge_descriptor;

public:
  using TM = TriangleMesh;                       // named by CGAL's own placement decorators
  using Choosing_placement = Halfedge_placement; // a class that derives from it has no choices of its own

  explicit Halfedge_placement(const Cost& cost, const Rule& rule = {}) : m_cost(cost), m_rule(rule) {}

  template <class Profile>
  internal::Optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    require_initialised();
    return is_v0_target_first(profile) ? profile.p0() : profile.p1();
  }

  /// Throws `Argument_error` if the cost is a `Quadric_cost`, and not that of the loop.
  void require_initialised() const { internal::require_initialised(m_cost); }

  /// Returns the end that is not the first choice, or none if the rule does not allow both directions: for a
  /// loop such as `selvedge::edge_collapse`, which considers an edge again when its first placement was
  /// refused.
  template <class Profile>
  internal::Optional<typename Profile::Point> second(const Profile& profile) const
  {
    if (!m_rule.may_move(profile.v0_v1()) || !m_rule.may_move(profile.v1_v0()))
      return {};
    return is_v0_cheaper(profile) ? profile.p1() : profile.p0();
  }

  using Cost_policy = Cost;

  /// Returns the choice number `rank`, from 0, with its cost, or none when there are fewer: what `operator()`
  /// and `second` choose, for a loop that needs the costs as well.
  template <class Profile>
  internal::Optional<internal::Placement_choice> choice(const Profile& profile, unsigned rank) const
  {
    using internal::Merged_at;
    using Choice = internal::Placement_choice;
    const bool may_move_v0 = m_rule.may_move(profile.v0_v1());
    const bool may_move_v1 = m_rule.may_move(profile.v1_v0());
    if (rank > (may_move_v0 && may_move_v1))
      return {};
    if (may_move_v0 != may_move_v1)
      return may_move_v0 ? Choice{Merged_at::v1, cost_along(profile, profile.v0_v1())}
                         : Choice{Merged_at::v0, cost_along(profile, profile.v1_v0())};
    const auto [onto_v1, onto_v0] = costs_along(profile, m_cost, 0);
    return (onto_v0 < onto_v1) == (rank == 0) ? Choice{Merged_at::v0, onto_v0}
                                              : Choice{Merged_at::v1, onto_v1};
  }

  /// Returns a cost that a first choice that the rule allows does not fall below, and that takes less time to
  /// compute: of `cost_bounds` of the cost policy that for the end that is free, if it alone may move, or
  /// else the least. None where the policy has no bound.
  template <class Profile, class Policy = Cost>
  auto first_cost_bound(const Profile& profile) const ->
      typename std::decay_t<decltype(std::declval<const Policy&>().cost_bounds(profile))>::value_type
  {
    const auto [onto_v1, onto_v0] = m_cost.cost_bounds(profile);
    if (!onto_v0 || !onto_v1)
      return {};
    // An end on a line moves onto one that is on none along a spoke alone, which is soon asked. Whether one
    // of two ends on lines may move takes long to ask.
    const bool is_v0_free = m_rule.is_free(profile.v0()), is_v1_free = m_rule.is_free(profile.v1());
    if (is_v0_free != is_v1_free && !m_rule.may_move(is_v0_free ? profile.v1_v0() : profile.v0_v1()))
      return is_v0_free ? onto_v1 : onto_v0;
    return (std::min)(*onto_v0, *onto_v1);
  }

  /// Returns the collapse that a choice stands for.
  template <class Profile>
  internal::Optional<internal::Collapse<Profile>> collapse(const Profile& profile,
                                                           internal::Merged_at at) const
  {
    return internal::Collapse<Profile>::along(profile, at == internal::Merged_at::v0 ? profile.v1_v0()
                                                                                     : profile.v0_v1());
  }

  /// See `Collapse_locality`.
  bool reaches_neighbours(Vertex kept) const
  {
    return Collapse_locality<Cost>::reaches_neighbours(m_cost, kept) || m_rule.reaches_neighbours(kept);
  }
  bool reaches(Vertex kept, Edge edge) const
  {
    return Collapse_locality<Cost>::reaches(m_cost, kept, edge) || m_rule.reaches(kept, edge);
  }
  bool can_wait(Vertex kept, Edge edge) const
  {
    return Collapse_locality<Cost>::can_wait(m_cost, kept, edge) && !m_rule.reaches(kept, edge);
  }

private:
  // Returns whether the first choice is to move v1 onto v0.
  template <class Profile>
  bool is_v0_target_first(const Profile& profile) const
  {
    const bool may_move_v0 = m_rule.may_move(profile.v0_v1());
    const bool may_move_v1 = m_rule.may_move(profile.v1_v0());
    if (may_move_v0 != may_move_v1)
      return may_move_v1;
    return is_v0_cheaper(profile);
  }

  template <class Profile>
  internal::Optional<double> cost_along(const Profile& profile, Halfedge moving) const
  {
    return m_cost.cost_along(profile, moving);
  }

  // Returns the costs of moving v0 onto v1, and v1 onto v0.
  template <class Profile, class Policy>
  static auto costs_along(const Profile& profile, const Policy& cost, int)
      -> decltype(cost.costs_along(profile))
  {
    return cost.costs_along(profile);
  }
  template <class Profile, class Policy>
  static std::array<internal::Optional<double>, 2> costs_along(const Profile& profile, const Policy& cost,
                                                               long)
  {
    return {cost.cost_along(profile, profile.v0_v1()), cost.cost_along(profile, profile.v1_v0())};
  }

  template <class Profile>
  bool is_v0_cheaper(const Profile& profile) const
  {
    const auto [onto_v1, onto_v0] = costs_along(profile, m_cost, 0);
    return onto_v0 < onto_v1;
  }

  Cost m_cost;
  Rule m_rule;
};

/// Decorates a `Halfedge_placement` or an `Optimal_placement` so that an edge gets its next choice when
/// filters refuse the first.
///
/// CGAL's loop takes an edge from its queue once, asks for one placement, and drops the edge when its filter
/// refuses this placement. This decorator asks the filter itself, for the first choice and then for the next
/// ones, and returns the one that passed, or none. The loop does not need the same filter again.
///
/// Choices are tried in the order of costs. A choice that costs no more than the costliest one selected so
/// far in this run is tried at once. Otherwise the edge is *reversed*: from now on its cost is that of this
/// choice, and it comes in this order when the loop considers it again, in a further run or after a change
/// nearby. (Taking costly choices of cheap edges at once would spoil the order: on a scanned bunny reduced to
/// 30 % of its faces, the mean error grows by half.)
///
/// A model of CGAL's concept `GetPlacement`. Give the loop its `visitor()` as well. CGAL's loop also asks for
/// a placement when it only computes a cost, and filters would be far too costly then; the visitor says when
/// an edge has been selected, so that the next placement counts.
///
/// **Preconditions** The mesh outlives the placement. Copies share one state.
template <class Placement, class Filter = No_filter>
class Filtered_halfedge_placement
{
  using Triangle_mesh = typename Placement::TM;
  using Graph_traits = boost::graph_traits<Triangle_mesh>;
  using Edge = typename Graph_traits::edge_descriptor;
  using Vertex = typename Graph_traits::vertex_descriptor;

  struct State
  {
    explicit State(const Triangle_mesh& mesh_)
        : mesh(mesh_), rank(get(CGAL::dynamic_edge_property_t<unsigned char>(), mesh_))
    {
    }

    const Triangle_mesh& mesh;
    typename boost::property_map<Triangle_mesh, CGAL::dynamic_edge_property_t<unsigned char>>::const_type
        rank; // of the choice in whose order the edge comes
    bool is_deciding = false;
    double reached_cost = 0;
    std::size_t reversed = 0;
  };

public:
  using TM = Triangle_mesh;

  Filtered_halfedge_placement(const Triangle_mesh& mesh, const Placement& placement,
                              const Filter& filter = {})
      : m_placement(placement), m_filter(filter), m_state(std::make_shared<State>(mesh))
  {
  }

  template <class Profile>
  internal::Optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    State& state = *m_state;
    const Edge e = edge(profile.v0_v1(), state.mesh);
    unsigned rank = get(state.rank, e);
    auto choice = m_placement.choice(profile, rank);
    if (!choice) { // there are fewer now
      rank = 0;
      choice = m_placement.choice(profile, rank);
    }
    if (!state.is_deciding)
      return m_placement.collapse(profile, choice->at)->place();

    state.is_deciding = false;
    if (choice->cost)
      state.reached_cost = (std::max)(state.reached_cost, *choice->cost);
    for (unsigned next = 0; (choice = m_placement.choice(profile, next)) && choice->cost; ++next) {
      if (next > rank && *choice->cost > state.reached_cost) {
        put(state.rank, e, static_cast<unsigned char>(next));
        ++state.reversed;
        break;
      }
      const auto collapse = m_placement.collapse(profile, choice->at);
      if (collapse && internal::is_allowed(m_filter, *collapse))
        return collapse->place();
    }
    return {};
  }

  /// Called by the loop's visitor when a run starts, when an edge is selected, and after each collapse.
  void on_started() const
  {
    m_state->is_deciding = false; // the last run may have stopped just after a selection
    m_state->reached_cost = 0;
  }
  void on_selected() const { m_state->is_deciding = true; }
  void on_collapsed(Vertex kept) const
  {
    // First choices that were refused around here may be possible now.
    for (const auto h : CGAL::halfedges_around_target(halfedge(kept, m_state->mesh), m_state->mesh))
      for (const auto g : CGAL::halfedges_around_target(opposite(h, m_state->mesh), m_state->mesh))
        put(m_state->rank, edge(g, m_state->mesh), static_cast<unsigned char>(0));
  }

  /// A visitor that makes these three calls and does nothing else.
  class Visitor : public internal::No_visitor
  {
  public:
    explicit Visitor(const Filtered_halfedge_placement& placement) : m_placement(placement) {}

    void OnStarted(Triangle_mesh&) { m_placement.on_started(); }
    template <class Profile, class OptionalCost, class Size>
    void OnSelected(const Profile&, const OptionalCost&, Size, Size)
    {
      m_placement.on_selected();
    }
    template <class Profile>
    void OnCollapsed(const Profile&, const Vertex& kept)
    {
      m_placement.on_collapsed(kept);
    }

  private:
    Filtered_halfedge_placement m_placement;
  };

  Visitor visitor() const { return Visitor(*this); }

  /// Returns how many times an edge has been reversed so far.
  std::size_t reversed() const { return m_state->reversed; }

private:
  Placement m_placement;
  Filter m_filter;
  std::shared_ptr<State> m_state;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_PLACEMENT_H
