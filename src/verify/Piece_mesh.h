// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_PIECE_MESH_H
#define SELVEDGE_SRC_VERIFY_PIECE_MESH_H

#include "Lists.h"
#include "pieces.h"

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace selvedge::internal {

/// Positions where more pieces than this meet are not used for matching, so that the number of pairs of
/// pieces stays linear in the number of positions.
constexpr std::size_t most_at_a_position = 64;

/// The topology of a piece: its number of boundary loops, its Euler characteristic, and whether some edge has
/// more than two faces.
using Kind = std::tuple<std::size_t, long, bool>;

inline Kind kind(const Piece& piece)
{
  return {piece.boundary_loops, piece.euler_characteristic, piece.non_manifold_edges > 0};
}

/// One of the two meshes, result and original, whose pieces `match_pieces` matches: its triangles with three
/// distinct positions, grouped by piece.
struct Piece_mesh
{
  /// `positions_of_vertices` holds the number of each vertex's position; the other mesh uses the same
  /// numbers. Both arguments must outlive this object.
  Piece_mesh(const Triangle_soup& mesh, const Index* positions_of_vertices);

  Index position(Index triangle, int place) const { return positions[soup.triangles[triangle][place]]; }
  Index piece(Index triangle) const { return numbered.of_triangle[triangle]; }
  const std::vector<Piece>& pieces() const { return numbered.pieces; }

  /// Returns the pieces at each position; `positions_in_all` is the number of positions of both meshes.
  Lists pieces_at(std::size_t positions_in_all) const { return pieces_at(positions_in_all, positions); }

  /// Returns the same with other positions of the vertices.
  Lists pieces_at(std::size_t positions_in_all, const Index* other_positions) const;

  std::vector<Index> triangles_of(const std::vector<Index>& some_pieces) const;

  /// Returns the kinds of the pieces that some triangles form when positions connect them instead of vertex
  /// numbers, sorted.
  std::vector<Kind> kinds_by_position(const std::vector<Index>& some_triangles) const
  {
    return kinds_by_position(some_triangles, positions);
  }

  /// Returns the same with other positions of the vertices.
  std::vector<Kind> kinds_by_position(const std::vector<Index>& some_triangles,
                                      const Index* other_positions) const;

  const Triangle_soup& soup;
  const Index* positions; ///< of each vertex, numbered in common with the other mesh
  Numbered_pieces numbered;
  Lists triangles; ///< of each piece
};

/// "1 face", "2000 faces".
std::string counted(std::size_t count, const char* noun);

/// "2 boundary loops and Euler characteristic 0", "1 boundary loop, edges of more than two faces and ..."
std::string describe(const Kind& kind);

/// "piece 3 ('lining', 421 faces around (0.1, 0.9, 0))"
std::string describe(const Piece_mesh& mesh, Index piece);

/// Describes the first three pieces and counts the others.
std::string describe(const Piece_mesh& mesh, const std::vector<Index>& pieces);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_PIECE_MESH_H
