// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_BORDER_PARTNERS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_BORDER_PARTNERS_H

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/unordered_map.hpp>
#include <boost/unordered_set.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Knows pairs of vertices on the two sides of a seam that gapes, and which motions keep the sides alike:
/// when one of a pair goes along its border to the next vertex, its partner can go to the partner of that.
///
/// As long as both always go, the sides are chains of as many edges between vertices that are partners. Such
/// edges are nowhere farther apart than the farther of the two pairs at their ends, because the distance of
/// points at the same share of two segments is a convex function of the share: so the gap does not grow.
///
/// **Preconditions** The mesh outlives the pairs. A vertex belongs to at most one.
template <class TriangleMesh>
class Border_partners
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;

public:
  Border_partners(const TriangleMesh& mesh, const std::vector<std::pair<Vertex, Vertex>>& pairs)
      : m_mesh(mesh)
  {
    for (const auto& [a, b] : pairs)
      join(a, b);
  }

  /// Returns whether the source of `moving` may go to its target: it has no partner, or its partner can go
  /// along, as far as edges tell.
  bool allows(Halfedge moving) const
  {
    return m_partner_of.empty() || !partner_of(source(moving, m_mesh)) || partner_motion(moving);
  }

  /// Returns the motion that the partner of the source makes along with it, or none if it has no partner, or
  /// one that cannot.
  std::optional<Halfedge> partner_motion(Halfedge moving) const
  {
    return m_partner_of.empty() ? std::nullopt : motion_of_partner(moving);
  }

  /// Call these before and after each collapse, with the halfedge from the vertex that goes, and with the
  /// vertex that is left.
  void before_collapse(Halfedge moving)
  {
    m_partner_of_kept.reset();
    m_follow_up.reset();
    m_is_kept_alone = false;
    if (m_partner_of.empty() && m_alone.empty())
      return;
    if (const auto motion = partner_motion(moving))
      m_follow_up = {source(*motion, m_mesh), target(*motion, m_mesh)};
    if (const auto left = part(source(moving, m_mesh)))
      m_alone.insert(*left);
    m_alone.erase(source(moving, m_mesh));
    m_is_kept_alone = m_alone.erase(target(moving, m_mesh)) > 0;
    m_partner_of_kept = part(target(moving, m_mesh));
  }
  void after_collapse(Vertex kept)
  {
    if (m_is_kept_alone)
      m_alone.insert(kept);
    if (m_partner_of_kept)
      join(kept, *m_partner_of_kept);
  }

  /// Returns how many vertices are left whose partners have gone without them.
  std::size_t alone() const { return m_alone.size(); }

  /// Returns the motion of the partner of the vertex that has gone last, if there is one.
  std::optional<Halfedge> follow_up() const
  {
    if (!m_follow_up)
      return std::nullopt;
    const auto [along, is_edge] = halfedge(m_follow_up->first, m_follow_up->second, m_mesh);
    return is_edge ? std::optional(along) : std::nullopt;
  }

private:
  std::optional<Halfedge> motion_of_partner(Halfedge moving) const
  {
    if (!is_border_edge(moving))
      return std::nullopt;
    const auto from = partner_of(source(moving, m_mesh)), to = partner_of(target(moving, m_mesh));
    if (!from || !to || *from == target(moving, m_mesh))
      return std::nullopt;
    const auto [along, is_edge] = halfedge(*from, *to, m_mesh);
    return is_edge && is_border_edge(along) ? std::optional(along) : std::nullopt;
  }

  std::optional<Vertex> partner_of(Vertex v) const
  {
    const auto found = m_partner_of.find(v);
    return found == m_partner_of.end() ? std::nullopt : std::optional<Vertex>(found->second);
  }

  void join(Vertex a, Vertex b)
  {
    m_partner_of[a] = b;
    m_partner_of[b] = a;
  }

  // Returns the partner that the vertex had.
  std::optional<Vertex> part(Vertex v)
  {
    const std::optional<Vertex> partner = partner_of(v);
    if (partner) {
      m_partner_of.erase(v);
      m_partner_of.erase(*partner);
    }
    return partner;
  }

  bool is_border_edge(Halfedge h) const
  {
    return CGAL::is_border(h, m_mesh) || CGAL::is_border(opposite(h, m_mesh), m_mesh);
  }

  const TriangleMesh& m_mesh;
  boost::unordered_map<Vertex, Vertex> m_partner_of;
  boost::unordered_set<Vertex> m_alone;
  std::optional<Vertex> m_partner_of_kept;
  bool m_is_kept_alone = false;
  std::optional<std::pair<Vertex, Vertex>> m_follow_up;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_BORDER_PARTNERS_H
