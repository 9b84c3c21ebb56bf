// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_JOINT_MOTIONS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_JOINT_MOTIONS_H

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/unordered_map.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Knows groups of coincident vertices, one for each sheet at a line along which several sheets meet, such as
/// the non-manifold edges of a T-junction. The vertices of a group move together: each collapses along its
/// own border, and all arrive at one position. So the sheets stay joined.
///
/// **Preconditions** The mesh and the points outlive the groups. A vertex belongs to at most one. A group has
/// all vertices at its position.
template <class TriangleMesh, class VertexPointMap>
class Joint_motions
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;

public:
  using Groups = std::vector<std::vector<Vertex>>;

  Joint_motions(const TriangleMesh& mesh, const VertexPointMap& points, Groups groups)
      : m_mesh(mesh), m_points(points), m_groups(std::move(groups))
  {
    for (std::size_t i = 0; i < m_groups.size(); ++i)
      for (const Vertex v : m_groups[i])
        m_group_of.emplace(v, i);
  }

  bool is_joint(Vertex v) const { return !m_group_of.empty() && m_group_of.count(v) > 0; }

  /// Returns the collapses that the others of its group make when the source of `moving` moves onto its
  /// target, as halfedges from the vertices that move. Returns none where the group cannot go there as one:
  /// every sheet must have its border at the group, coming from one and the same position and going on to
  /// that of the target, and no two of them may have one vertex there.
  ///
  /// **Preconditions** The source of `moving` is in a group.
  std::optional<std::vector<Halfedge>> others(Halfedge moving) const
  {
    const auto behind = vertex_behind(moving);
    if (!behind || point(*behind) == point(target(moving, m_mesh)))
      return std::nullopt;
    std::vector<Halfedge> result;
    std::vector<Vertex> goals{target(moving, m_mesh)};
    for (const Vertex v : m_groups[m_group_of.at(source(moving, m_mesh))]) {
      if (v == source(moving, m_mesh))
        continue;
      const std::optional<Halfedge> along = border_to(v, point(target(moving, m_mesh)));
      const auto behind_it = along ? vertex_behind(*along) : std::nullopt;
      if (!behind_it || point(*behind_it) != point(*behind) ||
          std::find(goals.begin(), goals.end(), target(*along, m_mesh)) != goals.end())
        return std::nullopt;
      result.push_back(*along);
      goals.push_back(target(*along, m_mesh));
    }
    return result;
  }

  /// Call these before and after each collapse, with the halfedge from the vertex that goes, and with the
  /// vertex that is left.
  void before_collapse(Halfedge moving)
  {
    m_group_of_kept.reset();
    if (m_group_of.empty())
      return;
    leave_group(source(moving, m_mesh));
    m_group_of_kept = leave_group(target(moving, m_mesh));
  }
  void after_collapse(Vertex kept)
  {
    if (!m_group_of_kept)
      return;
    m_group_of[kept] = *m_group_of_kept;
    m_groups[*m_group_of_kept].push_back(kept);
  }

private:
  decltype(auto) point(Vertex v) const { return get(m_points, v); }

  // Returns the halfedge of the border at a vertex that leads to it, or none inside the mesh.
  std::optional<Halfedge> border_at(Vertex v) const
  {
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(v, m_mesh), m_mesh))
      if (CGAL::is_border(h, m_mesh))
        return h;
    return std::nullopt;
  }

  // Returns the next vertex of the border at the source of `h`, away from its target; none when `h` is not on
  // that border.
  std::optional<Vertex> vertex_behind(Halfedge h) const
  {
    if (CGAL::is_border(h, m_mesh))
      return source(prev(h, m_mesh), m_mesh);
    const Halfedge back = opposite(h, m_mesh);
    if (CGAL::is_border(back, m_mesh))
      return target(next(back, m_mesh), m_mesh);
    return std::nullopt;
  }

  // Returns the border edge from a vertex to a vertex at a place.
  template <class Point>
  std::optional<Halfedge> border_to(Vertex v, const Point& place) const
  {
    const std::optional<Halfedge> in = border_at(v);
    if (!in)
      return std::nullopt;
    if (point(source(*in, m_mesh)) == place)
      return opposite(*in, m_mesh);
    const Halfedge out = next(*in, m_mesh);
    return point(target(out, m_mesh)) == place ? std::optional(out) : std::nullopt;
  }

  std::optional<std::size_t> leave_group(Vertex v)
  {
    const auto found = m_group_of.find(v);
    if (found == m_group_of.end())
      return std::nullopt;
    const std::size_t group = found->second;
    std::vector<Vertex>& all = m_groups[group];
    all.erase(std::find(all.begin(), all.end(), v));
    m_group_of.erase(found);
    return group;
  }

  const TriangleMesh& m_mesh;
  VertexPointMap m_points;
  Groups m_groups;
  boost::unordered_map<Vertex, std::size_t> m_group_of;
  std::optional<std::size_t> m_group_of_kept;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_JOINT_MOTIONS_H
