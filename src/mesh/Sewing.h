// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_MESH_SEWING_H
#define SELVEDGE_SRC_MESH_SEWING_H

#include <selvedge/mesh/Triangle_soup.h>
#include <selvedge/mesh/Welding_notes.h>

#include <limits>
#include <vector>

namespace selvedge {

/// Says which sides of triangles are sewn together to an edge, and which corners so become one vertex.
///
/// Side 3i+k runs from corner 3i+k to the next corner of triangle i. The first sides may be a soup's own, and
/// the others an obstacle's; these are never sewn to those, so that the soup has the borders that it has
/// without.
///
/// **Guarantees** A halfedge mesh can hold it:
/// 1. The corners of a vertex follow each other across sewn sides, all round it or from border to border.
/// 2. No two edges have the same two vertices.
///
/// Both stay true when triangles are taken away: an edge then at most loses a side, and a vertex at most
/// falls into several.
class Sewing
{
public:
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Sews triangles of positions, none of which has one position twice. Two sides make an edge when they are
  /// all that lies between two positions, run opposite ways, and belong to triangles that differ in their
  /// third position. Where this would make parallel edges, all sides at both their ends stay apart.
  ///
  /// Notes are of the soup's own.
  ///
  /// **Complexity** O(n log n); linear where few sides have one lower end.
  Sewing(const std::vector<Index_triple>& triangles, Index own_sides, Index position_count,
         Welding_notes& notes);

  /// Makes what is left of another sewing when some of its triangles are taken away: `mates` names for every
  /// side that which it was sewn to, and `none` where there was none or it is gone.
  explicit Sewing(std::vector<Index> mates);

  /// The side on the other face of the same edge; none on a border.
  Index mate(Index side) const { return m_mates[side]; }
  Index side_count() const { return Index(m_mates.size()); }

  /// Vertices are numbered by their first corners.
  Index vertex(Index corner) const { return m_vertices[corner]; }
  Index vertex_count() const { return m_vertex_count; }

  static Index next(Index side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static Index previous(Index side) { return side % 3 == 0 ? side + 2 : side - 1; }

private:
  void number_vertices();
  bool tear_parallel_edges(const std::vector<std::vector<Index>>& unsewn);

  std::vector<Index> m_mates;
  std::vector<Index> m_vertices;
  Index m_vertex_count = 0;
};

} // namespace selvedge

#endif // SELVEDGE_SRC_MESH_SEWING_H
