// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_PASS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_PASS_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/stop_predicates.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace selvedge {
namespace internal {

/// Runs CGAL's loop once per call: one pass of a reduction with `Collapse_loop::cgal`, the reference for
/// `selvedge::edge_collapse`.
///
/// It exists because one run of CGAL's loop leaves possible collapses undone. CGAL's loop drops a refused
/// edge until the neighbourhood of the edge changes, although the layer that blocked it may have moved away,
/// and although its second direction may be possible. A new pass asks again: at the end, and earlier when so
/// many edges have been dropped that the loop would soon pay much more elsewhere.
///
/// `make_stop()` returns a stop predicate, `count_blocked()` the number of placements that the intersection
/// filter has refused so far.
template <class TriangleMesh, class VertexPointMap, class Cost, class Directions, class Filter, class Visitor,
          class MakeStop, class CountBlocked>
class Cgal_pass
{
  using Placement = Filtered_halfedge_placement<Directions, Filter>;

public:
  Cgal_pass(TriangleMesh& mesh, const VertexPointMap& points, const Cost& costs, const Directions& directions,
            const Filter& filter, const Visitor& visitor, const MakeStop& make_stop,
            const CountBlocked& count_blocked)
      : m_mesh(&mesh), m_points(points), m_costs(costs), m_placement(mesh, directions, filter),
        m_visitor(visitor, m_placement), m_make_stop(make_stop), m_count_blocked(count_blocked)
  {
  }

  /// Runs a pass. Returns whether another one might do what this one could not.
  bool operator()()
  {
    const std::size_t reversed_before = m_placement.reversed();
    const double highest_before = m_highest_cost;
    m_blocked_before += blocked();
    const Any_stop stop(m_make_stop(), Function_stop([this](double cost) { return is_over_at(cost); }));
    CGAL::Surface_mesh_simplification::edge_collapse(*m_mesh, stop,
                                                     CGAL::parameters::vertex_point_map(m_points)
                                                         .get_cost(m_costs)
                                                         .get_placement(m_placement)
                                                         .visitor(m_visitor));
    return m_highest_cost != highest_before || m_placement.reversed() != reversed_before;
  }

private:
  // A pass ends early when it has one blocked placement for every `s_forgotten_share` faces, and the cost has
  // grown by the factor `s_cost_step` since a pass last ended early.
  static constexpr std::size_t s_forgotten_share = 4;
  static constexpr double s_cost_step = 4;

  struct Turning_visitor : Visitor
  {
    Turning_visitor(const Visitor& visitor, const Placement& placement_)
        : Visitor(visitor), placement(placement_)
    {
    }

    void OnStarted(TriangleMesh& mesh)
    {
      Visitor::OnStarted(mesh);
      placement.on_started();
    }
    template <class Profile, class OptionalCost>
    void OnCollected(const Profile&, const OptionalCost&)
    {
      poll();
    }
    template <class Profile, class OptionalCost, class Size>
    void OnSelected(const Profile&, const OptionalCost&, Size, Size)
    {
      placement.on_selected();
    }
    template <class Profile, class Vertex>
    void OnCollapsed(const Profile& profile, const Vertex& kept)
    {
      Visitor::OnCollapsed(profile, kept);
      placement.on_collapsed(kept);
    }

    Placement placement;
    Cancellation_poll poll;
  };

  // Counts the placements that were blocked in this pass.
  std::size_t blocked() const { return m_count_blocked() - m_blocked_before; }

  bool is_over_at(double cost)
  {
    if (cost < m_highest_cost || blocked() * s_forgotten_share < face_count(*m_mesh))
      return false;
    m_highest_cost = s_cost_step * (std::max)(cost, (std::numeric_limits<double>::min)());
    return true;
  }

  TriangleMesh* m_mesh;
  VertexPointMap m_points;
  Cost m_costs;
  Placement m_placement;
  Turning_visitor m_visitor;
  MakeStop m_make_stop;
  CountBlocked m_count_blocked;
  std::size_t m_blocked_before = 0;
  double m_highest_cost = 0; // below this cost, no pass ends early
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_PASS_H
