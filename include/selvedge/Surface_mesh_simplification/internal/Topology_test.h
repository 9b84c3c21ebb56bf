// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TOPOLOGY_TEST_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TOPOLOGY_TEST_H

#include <selvedge/Surface_mesh_simplification/internal/perform_collapse.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <type_traits>
#include <vector>

namespace selvedge {
namespace internal {

/// Tells whether the collapse of an edge leaves a mesh a manifold of the same topology, as far as the
/// connectivity of the mesh shows. The loop and the count of hindrances ask it.
template <class TriangleMesh>
class Topology_test
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;

public:
  /// Asks for the link condition: a vertex that is a neighbour of both ends is the third corner of a face at
  /// the edge. Besides, no face at the edge has two other border edges; no two stretches of a border, and no
  /// two constrained edges, one at each end, come to meet; a boundary loop of three edges, a tetrahedron and
  /// a closed piece of two faces stay.
  template <class Profile, class EdgeIsConstrainedMap>
  bool is_kept(const Profile& of_edge, const EdgeIsConstrainedMap& is_constrained)
  {
    const TriangleMesh& mesh = of_edge.surface_mesh();
    const auto is_outside = [&](Halfedge h) { return CGAL::is_border(opposite(h, mesh), mesh); };
    if (!of_edge.left_face_exists() && !of_edge.right_face_exists())
      return false;
    if (of_edge.left_face_exists() && is_outside(of_edge.v1_vL()) && is_outside(of_edge.vL_v0()))
      return false;
    if (of_edge.right_face_exists() && is_outside(of_edge.vR_v1()) && is_outside(of_edge.v0_vR()))
      return false;

    m_neighbours.clear();
    bool is_v0_on_border = false, is_v1_on_border = false;
    for (const Halfedge h : CGAL::halfedges_around_target(of_edge.v1_v0(), mesh)) {
      is_v0_on_border = is_v0_on_border || CGAL::is_border(h, mesh);
      if (h != of_edge.v1_v0())
        m_neighbours.push_back(source(h, mesh));
    }
    for (const Halfedge h : CGAL::halfedges_around_target(of_edge.v0_v1(), mesh)) {
      is_v1_on_border = is_v1_on_border || CGAL::is_border(h, mesh);
      const Vertex v = source(h, mesh);
      if (h != of_edge.v0_v1() &&
          std::find(m_neighbours.begin(), m_neighbours.end(), v) != m_neighbours.end() &&
          !(of_edge.left_face_exists() && v == of_edge.vL()) &&
          !(of_edge.right_face_exists() && v == of_edge.vR()))
        return false;
    }
    const auto is_at_constrained = [&](Halfedge into) {
      for (const Halfedge h : CGAL::halfedges_around_target(into, mesh))
        if (get(is_constrained, edge(h, mesh)))
          return true;
      return false;
    };
    if (!std::is_same_v<EdgeIsConstrainedMap, No_constrained_edges> && is_at_constrained(of_edge.v0_v1()) &&
        is_at_constrained(of_edge.v1_v0()))
      return false;
    for (const Halfedge h : {of_edge.v0_v1(), of_edge.v1_v0()})
      if (CGAL::is_border(h, mesh)) {
        const Halfedge second = next(h, mesh), third = next(second, mesh);
        return !(next(third, mesh) == h && CGAL::is_border(second, mesh) && CGAL::is_border(third, mesh));
      }
    if (is_v0_on_border && is_v1_on_border)
      return false;
    const bool is_two_faces = next(of_edge.v0_v1(), mesh) == opposite(prev(of_edge.v1_v0(), mesh), mesh) &&
                              prev(of_edge.v0_v1(), mesh) == opposite(next(of_edge.v1_v0(), mesh), mesh);
    return !is_two_faces && !CGAL::is_tetrahedron(of_edge.v0_v1(), mesh);
  }

private:
  std::vector<Vertex> m_neighbours; // a buffer
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TOPOLOGY_TEST_H
