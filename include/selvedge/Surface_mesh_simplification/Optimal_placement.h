// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_OPTIMAL_PLACEMENT_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_OPTIMAL_PLACEMENT_H

#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>

#include <utility>

namespace selvedge {

/// Takes every place as it is: the default of `Optimal_placement`.
struct No_place_rounding
{
  template <class Halfedge, class Point>
  internal::Optional<Point> operator()(const Halfedge& /*edge*/, const Point& place) const
  {
    return place;
  }
};

/// Places the merged vertex where its quadric is least, or at one end of its edge.
///
/// An edge has up to three choices: the place of least cost, if it costs at least a fifth less than both
/// ends, and then the ends, as `Halfedge_placement` chooses them. (Places that gain less make results no
/// better, and take the time of a second motion: measured on garments.) The loop tries the next choice, at
/// its own cost, when filters refuse one; so edges that can collapse onto an end still do.
///
/// **Guarantees**
/// 1. The place is neither end only where the rule calls both ends free. A vertex that is locked or on a line
///    stays, or moves onto an end of its edge as `Halfedge_placement` moves it.
/// 2. The place is no farther from the middle of the edge than the edge is long, apart from rounding. Where
///    the quadric has its least value farther away, or at more than one point, the best point inside the edge
///    is taken; where that is an end, only the ends are left.
/// 3. The place is what `Rounding` made of it, before its cost is computed and before any filter is asked.
///
/// A model of CGAL's concept `GetPlacement`; CGAL's own loop sees the first choice alone, unless
/// `Filtered_halfedge_placement` decorates this one. `Cost` has, beyond what `Halfedge_placement` needs,
/// `least_place(profile, reach)` and `cost_at(profile, point)`, as `Quadric_cost` has. It may also have
/// `least_cost_bound(profile)`, an optional number that the costs at places and at both ends do not fall
/// below, beside the `cost_bounds` of `Halfedge_placement`. `Rule` also has `is_free(vertex)`, as
/// `Border_rule` has. `Rounding` is a function `Optional<Point>(halfedge, point)`: it returns the point as it
/// will be stored, or none where no vertex may be.
///
/// **Exactness** Floating point. Filters judge the place that is chosen.
///
/// **Reference** Garland, Heckbert: Surface simplification using quadric error metrics, section 4.
template <class TriangleMesh, class Cost, class Rule = No_border_rule, class Rounding = No_place_rounding>
class Optimal_placement
{
  using Ends = Halfedge_placement<TriangleMesh, Cost, Rule>;
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Edge = typename Graph_traits::edge_descriptor;

  static constexpr double s_reach = 1;       // in lengths of the edge
  static constexpr double s_most_cost = 0.8; // relative to that of the cheaper end

public:
  using TM = TriangleMesh;                      // named by CGAL's own placement decorators
  using Choosing_placement = Optimal_placement; // a class that derives from it has no choices of its own

  explicit Optimal_placement(const Cost& cost, const Rule& rule = {}, const Rounding& rounding = {})
      : m_ends(cost, rule), m_cost(cost), m_rule(rule), m_rounding(rounding)
  {
  }

  template <class Profile>
  internal::Optional<typename Profile::Point> operator()(const Profile& profile) const
  {
    require_initialised();
    const auto first = choice(profile, 0);
    return first ? collapse(profile, first->at)->place() : internal::Optional<typename Profile::Point>();
  }

  /// See `Halfedge_placement`.
  void require_initialised() const { m_ends.require_initialised(); }

  using Cost_policy = Cost;

  /// Returns the choice number `rank`, from 0, with its cost, or none when there are fewer.
  template <class Profile>
  internal::Optional<internal::Placement_choice> choice(const Profile& profile, unsigned rank) const
  {
    const auto place = least_place(profile);
    const auto cost = place ? m_cost.cost_at(profile, *place) : internal::Optional<double>();
    const internal::Placement_choice between{internal::Merged_at::between, cost};
    if (rank == 0 && cost && *cost < s_most_cost * bound_at_ends(profile, 0))
      return between;
    const auto end = m_ends.choice(profile, 0);
    if (!end || !end->cost)
      return rank == 0 ? end : decltype(end)();
    if (cost && *cost < s_most_cost * *end->cost) {
      if (rank == 0)
        return between;
      --rank;
    }
    return rank == 0 ? end : m_ends.choice(profile, rank);
  }

  /// Returns a cost that the first choice does not fall below, apart from rounding, and that takes less time
  /// to compute. None where the cost policy has none.
  template <class Profile, class Policy = Cost>
  auto first_cost_bound(const Profile& profile) const
      -> decltype(std::declval<const Policy&>().least_cost_bound(profile))
  {
    return are_ends_free(profile) ? m_cost.least_cost_bound(profile) : m_ends.first_cost_bound(profile);
  }

  /// Returns the collapse that a choice stands for.
  template <class Profile>
  internal::Optional<internal::Collapse<Profile>> collapse(const Profile& profile,
                                                           internal::Merged_at at) const
  {
    if (at != internal::Merged_at::between)
      return m_ends.collapse(profile, at);
    const auto place = least_place(profile);
    return place ? internal::Collapse<Profile>(profile, *place)
                 : internal::Optional<internal::Collapse<Profile>>();
  }

  /// See `Collapse_locality`.
  bool reaches_neighbours(Vertex kept) const { return m_ends.reaches_neighbours(kept); }
  bool reaches(Vertex kept, Edge edge) const { return m_ends.reaches(kept, edge); }
  bool can_wait(Vertex kept, Edge edge) const { return m_ends.can_wait(kept, edge); }

private:
  template <class Profile>
  bool are_ends_free(const Profile& profile) const
  {
    return m_rule.is_free(profile.v0()) && m_rule.is_free(profile.v1());
  }

  // Returns a number that the cost at an end does not fall below, in less time; 0 where the cost policy has
  // none.
  template <class Profile, class Policy = Cost>
  auto bound_at_ends(const Profile& profile, int) const
      -> decltype(std::declval<const Policy&>().cost_bounds(profile), double())
  {
    const auto bound = m_ends.first_cost_bound(profile);
    return bound ? *bound : 0;
  }
  template <class Profile>
  double bound_at_ends(const Profile&, long) const
  {
    return 0;
  }

  // Returns the place of least cost as it will be stored; none where it is an end, or may not be used.
  template <class Profile>
  internal::Optional<typename Profile::Point> least_place(const Profile& profile) const
  {
    using Point = typename Profile::Point;
    if (!are_ends_free(profile))
      return {};
    const auto least = m_cost.least_place(profile, s_reach);
    if (!least)
      return {};
    const internal::Optional<Point> place =
        m_rounding(profile.v0_v1(), Point((*least)[0], (*least)[1], (*least)[2]));
    return place && *place != profile.p0() && *place != profile.p1() ? place : internal::Optional<Point>();
  }

  Ends m_ends;
  Cost m_cost;
  Rule m_rule;
  Rounding m_rounding;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_OPTIMAL_PLACEMENT_H
