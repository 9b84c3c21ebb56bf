// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_COST_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_COST_H

#include <selvedge/Simplify_options.h>
#include <selvedge/Surface_mesh_simplification/No_observer.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_chain.h>
#include <selvedge/Surface_mesh_simplification/internal/Joint_motions.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/Surface_mesh_simplification/internal/relative_face_weight.h>

#include <CGAL/Kernel_traits.h>

#include <array>
#include <cstddef>
#include <type_traits>

namespace selvedge {
namespace internal {

/// What a collapse costs in a reduction: it adds the costs of texture and normals to that of the quadrics,
/// takes the mean over all poses; for vertices that move together the costs of all, and for those that leave
/// their borders in pairs the mean of both. An edge has no cost if none of its faces counts.
///
/// A model of CGAL's concept `GetCost`.
template <class TriangleMesh, class VertexPointMap, class Observer>
class Collapse_cost
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Edge = typename Graph_traits::edge_descriptor;
  using Geom_traits =
      typename CGAL::Kernel_traits<typename boost::property_traits<VertexPointMap>::value_type>::Kernel;
  using Filters = Filter_chain<TriangleMesh, VertexPointMap, Observer>;
  using Joint = Joint_motions<TriangleMesh, VertexPointMap>;

public:
  using Quadrics = Quadric_cost<TriangleMesh, typename Filters::Rule>;
  using Update_tag = CGAL::Tag_true;

  /// **Preconditions** The mesh, the filters, the joint motions and the observer outlive it.
  Collapse_cost(TriangleMesh& mesh, const Quadrics& quadrics, const Filters& filters, const Joint& joint,
                const Observer& observer, const Simplify_options& options, double diagonal)
      : m_mesh(&mesh), m_quadrics(quadrics), m_targets(filters.targets()), m_joint(&joint),
        m_partners(&filters.partners()), m_poses(&filters.poses()), m_observer(&observer)
  {
    // The observer's weights of faces are relative to the area 1, those of the quadrics to that of the
    // diagonal.
    const double unit = relative_face_weight(1 / (diagonal * diagonal));
    m_uv_weight = options.uv_weight * unit;
    m_normal_weight = options.normal_weight * unit;
  }

  void initialize(const TriangleMesh& mesh, const VertexPointMap& points, const Geom_traits& traits) const
  {
    m_quadrics.initialize(mesh, points, traits);
    m_poses->initialise_costs();
  }

  template <class Profile, class Point>
  Optional<typename Profile::FT> operator()(const Profile& profile, const Optional<Point>& placement) const
  {
    Optional<double> cost;
    if (placement) {
      const Collapse<Profile> collapse(profile, *placement);
      cost =
          collapse.are_both_moved() ? cost_at(profile, *placement) : cost_along(profile, collapse.moving());
    }
    return cost ? typename Profile::FT(*cost) : Optional<typename Profile::FT>();
  }

  template <class Profile>
  Optional<double> cost_along(const Profile& profile, Halfedge moving) const
  {
    if (!has_cost(moving))
      return {};
    const double cost = cost_alone(profile, moving);
    if (m_joint->is_joint(source(moving, *m_mesh))) {
      double sum = cost;
      if (const auto others = m_joint->others(moving))
        for (const Halfedge h : *others)
          sum += cost_beside(profile, h);
      return sum;
    }
    if (const auto motion = m_partners->partner_motion(moving))
      return (cost + cost_beside(profile, *motion)) / 2;
    return cost;
  }

  /// Returns the costs of moving v0 onto v1, and v1 onto v0: those of `cost_along`, in less time.
  template <class Profile>
  std::array<Optional<double>, 2> costs_along(const Profile& profile) const
  {
    const std::array<Halfedge, 2> motions{profile.v0_v1(), profile.v1_v0()};
    if (!has_cost(motions[0]))
      return {};
    if (!has_motions_alone(profile))
      return {cost_along(profile, motions[0]), cost_along(profile, motions[1])};
    if (!may_attributes_cost())
      return m_quadrics.costs_along(profile); // in its place: a copy has to wait for what was just written
    const auto [onto_v1, onto_v0] = m_quadrics.costs_along(profile);
    return {*onto_v1 + cost_of_attributes(motions[0]), *onto_v0 + cost_of_attributes(motions[1])};
  }

  /// Returns the costs of the quadrics alone, below which `costs_along` does not fall. None where that would
  /// save nothing: without texture and normals, in several poses, or for vertices that do not move alone.
  template <class Profile>
  std::array<Optional<double>, 2> cost_bounds(const Profile& profile) const
  {
    if (!may_attributes_cost() || !has_cost(profile.v0_v1()) || !has_motions_alone(profile))
      return {};
    return m_quadrics.costs_along(profile);
  }

  template <class Profile, class Point>
  Optional<double> cost_at(const Profile& profile, const Point& place) const
  {
    if (!m_targets.is_counted(profile.v0_v1()))
      return {};
    double cost = m_quadrics.cost_at(profile, place);
    if (m_uv_weight > 0)
      cost += m_uv_weight * m_observer->uv_cost_at(profile.v0_v1(), place);
    if (m_normal_weight > 0)
      cost += m_normal_weight * m_observer->normal_cost_at(profile.v0_v1(), place);
    return cost;
  }

  template <class Profile>
  auto least_place(const Profile& profile, double reach) const
  {
    return m_quadrics.least_place(profile, reach);
  }

  /// Returns a number that neither `cost_at` nor `costs_along` falls below anywhere, apart from rounding.
  /// None for an edge without a cost, in several poses, or for vertices that do not move alone.
  template <class Profile>
  Optional<double> least_cost_bound(const Profile& profile) const
  {
    if (!has_cost(profile.v0_v1()) || !has_motions_alone(profile))
      return {};
    return m_quadrics.least_cost(profile);
  }

  bool reaches_neighbours(Vertex kept) const { return m_quadrics.reaches_neighbours(kept); }
  bool reaches(Vertex kept, Edge edge) const { return m_quadrics.reaches(kept, edge); }
  bool can_wait(Vertex kept, Edge edge) const { return m_quadrics.can_wait(kept, edge); }

  template <class Profile>
  void update_after_collapse(const Profile& profile, Vertex kept, Merged_at at = Merged_at::between) const
  {
    m_quadrics.update_after_collapse(profile, kept, at);
    m_poses->update_costs(profile.v0(), profile.v1(), kept);
  }

private:
  bool may_attributes_cost() const
  {
    return !std::is_same_v<Observer, No_observer> && m_observer->adds_to_costs();
  }
  bool has_cost(Halfedge edge) const { return m_targets.is_counted(edge) && !m_observer->is_led(edge); }

  // Whether either end of the edge would move without any other vertex, and there is one pose.
  template <class Profile>
  bool has_motions_alone(const Profile& profile) const
  {
    return m_poses->empty() && !m_joint->is_joint(profile.v0()) && !m_joint->is_joint(profile.v1()) &&
           !m_partners->partner_motion(profile.v0_v1()) && !m_partners->partner_motion(profile.v1_v0());
  }

  // The cost of another motion in the same mesh.
  template <class Profile>
  double cost_beside(const Profile& profile, Halfedge moving) const
  {
    const Geom_traits traits;
    return cost_alone(Lazy_edge_profile<TriangleMesh, VertexPointMap, Geom_traits>(
                          moving, *m_mesh, profile.vertex_point_map(), traits),
                      moving);
  }

  template <class Profile>
  double cost_alone(const Profile& profile, Halfedge moving) const
  {
    double cost = *m_quadrics.cost_along(profile, moving);
    if (!m_poses->empty())
      cost = m_poses->mean_cost(cost, Collapse<Profile>::along(profile, moving));
    return cost + cost_of_attributes(moving);
  }

  double cost_of_attributes(Halfedge moving) const
  {
    double cost = 0;
    if (m_uv_weight > 0)
      cost += m_uv_weight * m_observer->uv_cost(moving);
    if (m_normal_weight > 0)
      cost += m_normal_weight * m_observer->normal_cost(moving);
    return cost;
  }

  TriangleMesh* m_mesh;
  Quadrics m_quadrics;
  typename Filters::Targets m_targets;
  const Joint* m_joint;
  const typename Filters::Partners* m_partners;
  const typename Filters::Poses* m_poses;
  const Observer* m_observer;
  double m_uv_weight, m_normal_weight;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_COST_H
