// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MOTION_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MOTION_FILTER_H

#include <selvedge/Surface_mesh_simplification/Refusals.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_chain.h>
#include <selvedge/Surface_mesh_simplification/internal/Joint_motions.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/Reduction_setup.h>
#include <selvedge/Surface_mesh_simplification/internal/Topology_test.h>

#include <CGAL/Kernel_traits.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Says whether a reduction allows a motion: a collapse, and all collapses that must go with it. These are
/// - that of the partner of a border vertex, which comes next and is asked for again then;
/// - those of the *others*, the further vertices at one position, which move together with it
///   (`Joint_motions`);
/// - those of the *companions*, its images in the other places of a shared mesh (`No_observer::companions`).
///
/// Others and companions are done without another question. A motion of both ends of an edge has neither.
template <class TriangleMesh, class VertexPointMap, class Observer>
class Motion_filter
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Geom_traits =
      typename CGAL::Kernel_traits<typename boost::property_traits<VertexPointMap>::value_type>::Kernel;
  using Lazy_profile = Lazy_edge_profile<TriangleMesh, VertexPointMap, Geom_traits>;
  using Filters = Filter_chain<TriangleMesh, VertexPointMap, Observer>;

public:
  using Joint = Joint_motions<TriangleMesh, VertexPointMap>;

  /// **Preconditions** The mesh, the filters and the observer outlive this filter.
  Motion_filter(const Reduction_setup<TriangleMesh>& setup, const VertexPointMap& points, Filters& filters,
                const Observer& observer)
      : m_mesh(setup.mesh), m_points(points), m_filters(filters), m_observer(observer),
        m_joint(m_mesh, points, setup.joint_groups)
  {
  }

  const Joint& joint() const { return m_joint; }

  template <class Profile>
  bool allows(const Collapse<Profile>& collapse)
  {
    // The filters remember what they found of the last collapse of both ends that they accepted: so it is
    // asked after its partner. A collapse with companions moves one end.
    if (!allows_partner(collapse) || !allows_others(collapse) ||
        !m_filters.allows(collapse.with_others(m_others)) || !allows_companions(collapse))
      return false;
    m_collapses_left = 1 + m_companions.size() + m_others.size();
    return true;
  }

  /// Finds what goes along with a collapse that is known to be allowed, as `allows` does, and asks nothing.
  template <class Profile>
  void expect(const Collapse<Profile>& collapse)
  {
    m_others.clear();
    m_companions.clear();
    if (!collapse.are_both_moved()) {
      if (m_joint.is_joint(collapse.mover()))
        m_others = m_joint.others(collapse.moving()).value();
      m_companions = m_observer.companions(collapse.moving());
    }
    m_collapses_left = 1 + m_companions.size() + m_others.size();
  }

  /// Returns the companions of the collapse that was allowed last.
  const std::vector<Halfedge>& companions() const { return m_companions; }

  /// Returns the collapses that are left to be done of the motion that has begun, besides the partner's.
  std::vector<Halfedge> take_rest() { return std::exchange(m_companions, {}); }

  /// Returns the collapses that others make when the source of `moving` moves onto its target; none where
  /// they cannot go there as one, or would not leave pieces joined as they were.
  ///
  /// **Preconditions** The source of `moving` is one of several that move together.
  std::optional<std::vector<Halfedge>> others(Halfedge moving) const
  {
    auto others = m_joint.others(moving);
    return others && m_observer.keeps_joints(moving, *others) ? std::move(others) : std::nullopt;
  }

  /// Returns whether the next collapse is that of one of the others.
  bool is_other_next() const { return m_others_left > 0; }

  /// Returns whether no motion is half done.
  bool is_whole() const { return m_collapses_left == 0; }

  template <class Profile>
  void before_collapse(const Collapse<Profile>& collapse)
  {
    m_others_left = is_other_next() ? m_others_left - 1 : m_others.size();
    m_joint.before_collapse(collapse.moving());
    m_filters.before_collapse(collapse.with_others(m_others));
    if (!m_others.empty())
      m_companions = std::exchange(m_others, {});
  }
  void after_collapse(Vertex kept)
  {
    m_joint.after_collapse(kept);
    m_filters.after_collapse(kept);
    m_collapses_left -= m_collapses_left > 0;
  }

  Refusals refusals() const
  {
    Refusals result = m_filters.refusals();
    result.companions = m_companions_too_near;
    return result;
  }

  /// Returns how many motions only companions did not allow.
  std::size_t refused_elsewhere() const { return m_refused_elsewhere; }

private:
  // Whether topology and `is_allowed(collapse)` let the source of `moving` go to its target.
  template <class Predicate>
  bool may_go(Halfedge moving, const Predicate& is_allowed)
  {
    const Lazy_profile profile(moving, m_mesh, m_points, m_traits);
    return m_topology.is_kept(profile, No_constrained_edges()) &&
           is_allowed(Collapse<Lazy_profile>::along(profile, moving));
  }
  bool may_go_alone(Halfedge moving)
  {
    return may_go(moving, [this](const auto& collapse) { return m_filters.allows(collapse); });
  }

  // Whether the partner of the vertex that moves, if it has one, may move along, as far as the mesh tells
  // before either does. Once one has moved, its partner is asked again, and may then be refused.
  template <class Profile>
  bool allows_partner(const Collapse<Profile>& collapse)
  {
    if (collapse.are_both_moved())
      return true;
    const auto motion = m_filters.partners().partner_motion(collapse.moving());
    return !motion || may_go_alone(*motion);
  }

  // Whether all filters but the exact test allow the collapses of the others, which it finds. The exact test
  // is asked about all at once.
  template <class Profile>
  bool allows_others(const Collapse<Profile>& collapse)
  {
    m_others.clear();
    if (collapse.are_both_moved() || !m_joint.is_joint(collapse.mover()))
      return true;
    auto found = others(collapse.moving());
    if (!found)
      return false;
    m_others = *std::move(found);
    return std::all_of(m_others.begin(), m_others.end(), [this](Halfedge h) {
      return may_go(h, [this](const auto& of_other) { return m_filters.allows_shape(of_other); });
    });
  }

  // Whether all companions may move, which it finds. Each is asked for in the mesh as it is before any of
  // them: as their stars lie in boxes without a common point, none changes what is asked of another.
  template <class Profile>
  bool allows_companions(const Collapse<Profile>& collapse)
  {
    if (!collapse.are_both_moved())
      m_companions = m_observer.companions(collapse.moving());
    if (m_companions.empty())
      return true;
    const bool are_apart = m_observer.are_companions_apart(collapse.moving(), m_companions);
    m_companions_too_near += !are_apart;
    if (are_apart && std::all_of(m_companions.begin(), m_companions.end(),
                                 [this](Halfedge moving) { return may_go_alone(moving); }))
      return true;
    ++m_refused_elsewhere;
    m_companions.clear();
    return false;
  }

  TriangleMesh& m_mesh;
  VertexPointMap m_points;
  Geom_traits m_traits;
  Filters& m_filters;
  const Observer& m_observer;
  Joint m_joint;
  Topology_test<TriangleMesh> m_topology;
  std::vector<Halfedge> m_companions; // of the last motion allowed, until the loop does them
  std::vector<Halfedge> m_others;     // of the last motion asked about
  std::size_t m_others_left = 0;      // of the motion that has begun
  std::size_t m_collapses_left = 0;   // of the motion allowed last, in all
  std::size_t m_companions_too_near = 0;
  std::size_t m_refused_elsewhere = 0;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MOTION_FILTER_H
