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

/// One pass of CGAL's loop after another. It forgets an edge that was refused until its neighbourhood
/// changes, though the layer that blocked it may have moved away, and though its second direction may do. A
/// new pass asks again: at the end, and sooner when so many are forgotten that the loop is about to pay much
/// more elsewhere.
///
/// `make_stop()` returns a stop predicate, `count_blocked()` how many placements the intersection filter has
/// refused so far.
template <class TriangleMesh, class Cost, class Directions, class Filter, class Visitor, class MakeStop,
          class CountBlocked>
class Cgal_pass
{
  using Placement = Filtered_halfedge_placement<Directions, Filter>;

public:
  Cgal_pass(TriangleMesh& mesh, const Cost& costs, const Directions& directions, const Filter& filter,
            const Visitor& visitor, const MakeStop& make_stop, const CountBlocked& count_blocked)
      : m_mesh(&mesh), m_costs(costs), m_placement(mesh, directions, filter), m_visitor(visitor, m_placement),
        m_make_stop(make_stop), m_count_blocked(count_blocked)
  {
  }

  /// Whether another pass might do what this could not.
  bool operator()()
  {
    const std::size_t turned_before = m_placement.turned();
    const double dearest_before = m_dearest;
    m_blocked_before += blocked();
    const Any_stop stop(m_make_stop(), Function_stop([this](double cost) { return is_over_at(cost); }));
    CGAL::Surface_mesh_simplification::edge_collapse(
        *m_mesh, stop, CGAL::parameters::get_cost(m_costs).get_placement(m_placement).visitor(m_visitor));
    return m_dearest != dearest_before || m_placement.turned() != turned_before;
  }

private:
  // A pass ends early when one edge is forgotten for so many faces, and costs have grown by such a factor
  // since the last time.
  static constexpr std::size_t s_forgotten_share = 4;
  static constexpr double s_dearer = 4;

  struct Turning_visitor : Visitor
  {
    Turning_visitor(const Visitor& visitor, const Placement& placement_)
        : Visitor(visitor), placement(placement_)
    {
    }

    void OnStarted(TriangleMesh&) { placement.on_started(); }
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

  // In this pass.
  std::size_t blocked() const { return m_count_blocked() - m_blocked_before; }

  bool is_over_at(double cost)
  {
    if (cost < m_dearest || blocked() * s_forgotten_share < face_count(*m_mesh))
      return false;
    m_dearest = s_dearer * (std::max)(cost, (std::numeric_limits<double>::min)());
    return true;
  }

  TriangleMesh* m_mesh;
  Cost m_costs;
  Placement m_placement;
  Turning_visitor m_visitor;
  MakeStop m_make_stop;
  CountBlocked m_count_blocked;
  std::size_t m_blocked_before = 0;
  double m_dearest = 0;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CGAL_PASS_H
