// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CLEARANCE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CLEARANCE_H

#include <selvedge/geometry/clearance.h>
#include <selvedge/internal/inflated.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

namespace selvedge {
namespace internal {

/// Keeps the distance that pieces of a mesh must have from each other, and knows the pieces: faces that are
/// connected by common positions. An obstacle connects none of them, and each of its faces is of another
/// piece than all that moves. A collapse neither joins nor parts pieces, so that they are found once.
///
/// **Complexity** 4 bytes for each vertex, and 1 for each face if there is an obstacle; nothing when no
/// clearance is asked for.
template <class VertexTable, class GeomTraits>
class Clearance
{
  using Number = typename VertexTable::Number;
  using Point = typename VertexTable::Point;

public:
  /// Throws `Argument_error` when the distance is not positive and finite.
  template <class FaceTable>
  void begin(const VertexTable& vertices, const FaceTable& faces, double distance,
             const std::vector<typename FaceTable::Face>& obstacle)
  {
    m_test.emplace(distance);
    m_distance = distance;
    m_is_of_obstacle.assign(obstacle.empty() ? 0 : faces.size(), false);
    for (const auto face : obstacle)
      m_is_of_obstacle[faces.id(face)] = true;
    m_pieces.resize(vertices.size());
    std::iota(m_pieces.begin(), m_pieces.end(), Number(0));
    const auto find = [&](Number v) {
      while (m_pieces[v] != v)
        v = m_pieces[v] = m_pieces[m_pieces[v]];
      return v;
    };
    const auto unite = [&](Number a, Number b) { m_pieces[find(a)] = find(b); };
    for (typename FaceTable::Id id = 0; id < faces.size(); ++id)
      for (const Number corner : faces.corners(id)) {
        if (is_of_obstacle(id))
          break;
        unite(corner, faces.corners(id)[0]);
        if (vertices.is_coincident(corner))
          unite(corner, vertices.number(vertices.all_at(corner).front()));
      }
    for (Number v = 0; v < m_pieces.size(); ++v)
      m_pieces[v] = find(v);
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

  /// Whether a face, of which `v` is a corner, belongs to the piece of the mover.
  bool is_own(std::size_t face, Number v) const { return m_pieces[v] == m_piece && !is_of_obstacle(face); }

  /// Whether the motion keeps the clearance from a stationary face of another piece.
  bool is_kept(const Point& p, const Point& q, const Point& r) { return m_test->is_kept(p, q, r); }

private:
  bool is_of_obstacle(std::size_t face) const { return !m_is_of_obstacle.empty() && m_is_of_obstacle[face]; }

  std::optional<Clearance_test<GeomTraits>> m_test;
  double m_distance = 0;
  std::vector<Number> m_pieces;       // by vertex
  std::vector<char> m_is_of_obstacle; // by face; empty when there is none
  Number m_piece = 0;                 // of the mover
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_CLEARANCE_H
