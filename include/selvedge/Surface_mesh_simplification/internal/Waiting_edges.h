// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_WAITING_EDGES_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_WAITING_EDGES_H

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <cstdint>
#include <vector>

namespace selvedge {
namespace internal {

/// Keeps, for every face, a list of the numbered edges that wait for it to change or vanish. An edge may wait
/// for several faces, and more than once.
///
/// The loop needs it for edges that a filter refused because of faces elsewhere in the mesh: a collapse there
/// does not change the neighbourhood of the edge.
template <class TriangleMesh>
class Waiting_edges
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Face = typename Graph_traits::face_descriptor;

public:
  using Id = std::uint32_t;

  explicit Waiting_edges(const TriangleMesh& mesh)
      : m_mesh(mesh), m_first(get(CGAL::dynamic_face_property_t<Id>(), mesh)), m_nodes(1)
  {
    for (const Face face : faces(mesh))
      put(m_first, face, 0);
  }

  void add(Face face, Id edge)
  {
    const Id first = get(m_first, face);
    if (first != 0 && m_nodes[first].edge == edge)
      return;
    Id node = m_free;
    if (node != 0) {
      m_free = m_nodes[node].next;
    } else {
      node = Id(m_nodes.size());
      m_nodes.emplace_back();
    }
    m_nodes[node] = {edge, first};
    put(m_first, face, node);
  }

  /// Releases the edges that wait for a face at this vertex.
  void release_around(Vertex vertex)
  {
    for (const auto h : CGAL::halfedges_around_target(halfedge(vertex, m_mesh), m_mesh)) {
      if (CGAL::is_border(h, m_mesh))
        continue;
      for (Id node = get(m_first, face(h, m_mesh)); node != 0;) {
        m_released.push_back(m_nodes[node].edge);
        const Id next = m_nodes[node].next;
        m_nodes[node].next = m_free;
        m_free = node;
        node = next;
      }
      put(m_first, face(h, m_mesh), 0);
    }
  }

  /// Calls `function(edge)` for all edges released since the last call.
  template <class Function>
  void take_released(const Function& function)
  {
    for (const Id edge : m_released)
      function(edge);
    m_released.clear();
  }

private:
  // An entry of a list. Number 0 stands for no entry.
  struct Node
  {
    Id edge = 0;
    Id next = 0;
  };

  const TriangleMesh& m_mesh;
  typename boost::property_map<TriangleMesh, CGAL::dynamic_face_property_t<Id>>::const_type m_first;
  std::vector<Node> m_nodes;
  Id m_free = 0;
  std::vector<Id> m_released;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_WAITING_EDGES_H
