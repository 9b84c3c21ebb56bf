// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_POSE_MOTIONS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_POSE_MOTIONS_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>

#include <CGAL/Kernel_traits.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Shows a collapse of one pose of a mesh as it is in others, and moves vertices in those as edges collapse.
///
/// The poses are vertex point maps of one mesh. A collapse that moves one end of an edge onto the other does
/// so in every pose.
template <class TriangleMesh, class PosePointMap>
class Pose_motions
{
public:
  using Point = typename boost::property_traits<PosePointMap>::value_type;
  using Geom_traits = typename CGAL::Kernel_traits<Point>::Kernel;
  using Profile = Lazy_edge_profile<TriangleMesh, PosePointMap, Geom_traits>;
  using Vertex = typename boost::graph_traits<TriangleMesh>::vertex_descriptor;

  Pose_motions(TriangleMesh& mesh, std::vector<PosePointMap> poses) : m_mesh(mesh), m_poses(std::move(poses))
  {
  }

  std::size_t size() const { return m_poses.size(); }
  const PosePointMap& points(std::size_t pose) const { return m_poses[pose]; }

  /// Calls `function(collapse)` with a collapse onto an end of its edge as it is in a pose, and returns what
  /// it returns.
  template <class Collapse_, class Function>
  decltype(auto) in_pose(std::size_t pose, const Collapse_& collapse, const Function& function) const
  {
    const Profile profile(collapse.moving(), m_mesh, m_poses[pose], m_traits);
    return function(Collapse<Profile>::along(profile, collapse.moving()));
  }

  /// Called before each collapse, with its goal: notes where this is in each pose.
  void before_collapse(Vertex goal)
  {
    m_places.clear();
    for (const PosePointMap& points : m_poses)
      m_places.push_back(get(points, goal));
  }

  /// Called after the collapse, with the vertex that is left: puts it there.
  void after_collapse(Vertex kept) const
  {
    for (std::size_t pose = 0; pose < m_poses.size(); ++pose)
      put(m_poses[pose], kept, m_places[pose]);
  }

private:
  TriangleMesh& m_mesh;
  std::vector<PosePointMap> m_poses;
  std::vector<Point> m_places;
  Geom_traits m_traits;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_POSE_MOTIONS_H
