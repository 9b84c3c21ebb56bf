// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CLEARANCE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CLEARANCE_H

#include <selvedge/geometry/clearance.h>
#include <selvedge/internal/inflated.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/boost/graph/iterator.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace selvedge {
namespace internal {

/// Keeps the distance that pieces of a mesh must have from each other, and knows the pieces: faces that are
/// connected by common positions. A collapse neither joins nor parts pieces, so that they are found once.
///
/// **Complexity** 4 bytes for each vertex, and nothing when no clearance is asked for.
template <class TriangleMesh, class VertexTable, class GeomTraits>
class Clearance
{
  using Number = typename VertexTable::Number;
  using Vertex = typename VertexTable::Vertex;
  using Point = typename VertexTable::Point;

public:
  /// Throws `Argument_error` when the distance is not positive and finite.
  void begin(const TriangleMesh& mesh, const VertexTable& table, double distance)
  {
    m_test.emplace(distance);
    m_distance = distance;
    constexpr Number none = Number(-1);
    m_pieces.assign(num_vertices(mesh), none);
    std::vector<Vertex> found;
    const auto find = [&](Vertex v, Number piece) {
      if (m_pieces[table.number(v)] == none) {
        m_pieces[table.number(v)] = piece;
        found.push_back(v);
      }
    };
    Number pieces = 0;
    for (const Vertex first : vertices(mesh)) {
      find(first, pieces);
      pieces += !found.empty();
      while (!found.empty()) {
        const Vertex v = found.back();
        const Number piece = m_pieces[table.number(v)];
        found.pop_back();
        if (halfedge(v, mesh) == boost::graph_traits<TriangleMesh>::null_halfedge())
          continue;
        for (const auto h : CGAL::halfedges_around_target(halfedge(v, mesh), mesh))
          find(source(h, mesh), piece);
        if (table.is_coincident(table.number(v)))
          for (const Vertex other : table.all_at(table.number(v)))
            find(other, piece);
      }
    }
  }

  bool is_asked() const { return m_test.has_value(); }

  /// Returns a box in which all faces lie from which a motion in a box could lack clearance.
  CGAL::Bbox_3 reach(const CGAL::Bbox_3& box) const { return inflated(box, m_distance); }

  /// Takes up a motion of a vertex. Call it before the questions.
  void begin_motion(const Vertex_motion<Point>& motion, Number mover)
  {
    m_test->begin(motion);
    m_piece = m_pieces[mover];
  }

  /// Whether a vertex belongs to the piece of the mover.
  bool is_own(Number v) const { return m_pieces[v] == m_piece; }

  /// Whether the motion keeps the clearance from a stationary face of another piece.
  bool is_kept(const Point& p, const Point& q, const Point& r) { return m_test->is_kept(p, q, r); }

private:
  std::optional<Clearance_test<GeomTraits>> m_test;
  double m_distance = 0;
  std::vector<Number> m_pieces; // by vertex
  Number m_piece = 0;           // of the mover
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CLEARANCE_H
