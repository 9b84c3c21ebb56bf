// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_WEDGE_TABLE_H
#define SELVEDGE_SOUP_WEDGE_TABLE_H

#include "Corner_mesh.h"
#include "number_wedges.h"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace selvedge {

/// Says to which wedge the corners of faces belong while the mesh is reduced.
///
/// A vertex with one wedge alone, as most are, names it for all of its corners. At other vertices, each
/// corner of the soup has a number. A collapse carries the corners of the soup along (`Corner_mesh::carry`),
/// and with them their wedges.
///
/// **Preconditions** The mesh outlives the object, and `on_merging` is called before every collapse.
class Wedge_table
{
  using Mesh = Corner_mesh::Mesh;

public:
  /// **Preconditions** Nothing has been collapsed.
  Wedge_table(const Corner_mesh& corners, const Wedge_numbers& numbers);

  /// Whether a vertex has one wedge only, and always will, as lines neither begin nor end later.
  bool is_alone(Mesh::Vertex_index v) const { return m_of_vertex[v] != s_several; }

  /// Returns the wedge at the target of a halfedge that has a face of the soup.
  Index wedge(Corner_mesh::Halfedge h) const
  {
    const Index of_vertex = m_of_vertex[m_corners.mesh().target(h)];
    return of_vertex != s_several ? of_vertex : m_of_corner[rank(m_corners.corner_at(h))];
  }

  /// Called before a vertex merges with another, which CGAL may give the name of either.
  void on_merging(Mesh::Vertex_index gone, Mesh::Vertex_index goal) { m_of_vertex[gone] = m_of_vertex[goal]; }

private:
  static constexpr Index s_several = std::numeric_limits<Index>::max();

  // Which of 64 corners are numbered.
  struct Block
  {
    std::uint64_t bits = 0;
    Index before = 0; // how many are, in the blocks before
  };

  Index rank(Corner_mesh::Corner corner) const
  {
    const Block& block = m_blocks[corner / 64];
    const std::uint64_t lower = (std::uint64_t(1) << corner % 64) - 1;
    return block.before + Index(std::bitset<64>(block.bits & lower).count());
  }

  const Corner_mesh& m_corners;
  std::vector<Index> m_of_vertex;
  std::vector<Block> m_blocks;    // by corner of the soup
  std::vector<Index> m_of_corner; // by rank, of those at vertices that have several wedges
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_WEDGE_TABLE_H
