// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_SEWING_H
#define SELVEDGE_SOUP_SEWING_H

#include <selvedge/Sewing_notes.h>
#include <selvedge/Triangle_soup.h>

#include <limits>
#include <utility>
#include <vector>

namespace selvedge {

/// Says which sides of triangles are sewn to one edge, and which corners become one vertex thereby.
///
/// Side 3i+k runs from corner 3i+k to the next corner of triangle i. The first sides are those of a soup;
/// sides of an obstacle may follow. A side of the one is never sewn to a side of the other, so the soup has
/// the same borders with and without the obstacle.
///
/// **Guarantees** The result can be stored as a halfedge mesh:
/// 1. The corners of a vertex follow each other across sewn sides, either all around it or from border to
///    border.
/// 2. No two edges have the same two vertices.
///
/// Both stay true when triangles are taken away: at most, an edge then loses a side, and a vertex becomes
/// several.
class Sewing
{
public:
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Sews triangles whose corners are numbers of positions. Two sides make an edge when they are the only
  /// ones between two positions, run opposite ways, and belong to triangles with different third positions.
  /// Where this would make two edges between the same two vertices, all sides at these vertices stay apart.
  ///
  /// `own_sides` is the number of the soup's sides. Only these count in `notes`.
  ///
  /// **Preconditions** No triangle has one position twice.
  ///
  /// **Complexity** O(n log n); linear where few sides have one lower end.
  Sewing(const std::vector<Index_triple>& triangles, Index own_sides, Index position_count,
         Sewing_notes& notes);

  /// Makes what is left of another sewing when some of its triangles are taken away. `mates` has, for every
  /// side, the side to which it was sewn, or `none` where there was none or it is gone.
  explicit Sewing(std::vector<Index> mates);

  /// The other side of the same edge; `none` on a border.
  Index mate(Index side) const { return m_mates[side]; }
  Index side_count() const { return Index(m_mates.size()); }

  /// The sides, of the soup or of the obstacle, that stay apart though they are the only two between their
  /// ends, because both run the same way.
  const std::vector<Index>& misoriented_sides() const { return m_misoriented; }

  /// The vertex of a corner. Vertices are numbered in the order of their first corners.
  Index vertex(Index corner) const { return m_vertices[corner]; }
  Index vertex_count() const { return m_vertex_count; }

  static Index next(Index side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static Index previous(Index side) { return side % 3 == 0 ? side + 2 : side - 1; }

private:
  void number_vertices();
  bool tear_parallel_edges(const std::vector<std::vector<Index>>& unsewn);

  std::vector<Index> m_mates;
  std::vector<Index> m_misoriented;
  std::vector<Index> m_vertices;
  Index m_vertex_count = 0;
};

/// Says which triangles of the soup run against the others of their surface, and are to be turned, so that
/// the two sides of an edge run opposite ways. Triangles, `own_sides` and `position_count` are those of
/// `Sewing`; those of an obstacle are never turned. The result is empty when no triangle is to be turned.
///
/// Triangles belong together that agree across edges. Then the edges along which two disagree are taken in
/// the order of their sides, and each joins two such surfaces, one of them turned; where both are already one
/// surface (as in a Möbius band), the edge stays as it is. So triangles that agree across an edge still do.
/// In every surface, the fewer triangles are turned; of equal numbers, those that its first triangle
/// disagrees with.
///
/// **Complexity** O(n log n); that of `Sewing` where no two triangles disagree.
std::vector<char> turned_triangles(const std::vector<Index_triple>& triangles, Index own_sides,
                                   Index position_count);

/// Turns a triangle of corners, positions or vertices: its second and third change places.
inline void turn(Index_triple& triangle)
{
  std::swap(triangle[1], triangle[2]);
}

} // namespace selvedge

#endif // SELVEDGE_SOUP_SEWING_H
