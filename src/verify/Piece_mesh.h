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

/// Where more pieces than this meet in a position, it tells nothing; so no list of pairs is longer than
/// linear.
constexpr std::size_t most_at_a_position = 64;

/// Boundary loops, the Euler characteristic, and whether some edge has more than two faces.
using Kind = std::tuple<std::size_t, long, bool>;

inline Kind kind(const Piece& piece)
{
  return {piece.boundary_loops, piece.euler_characteristic, piece.non_manifold_edges > 0};
}

/// One of two meshes whose pieces are matched: its triangles of three distinct positions, and their pieces.
struct Piece_mesh
{
  /// `positions` numbers the positions of the vertices, in common with those of the other mesh; both must
  /// outlive this.
  Piece_mesh(const Triangle_soup& mesh, const Index* positions_of_vertices);

  Index position(Index triangle, int place) const { return positions[soup.triangles[triangle][place]]; }
  Index piece(Index triangle) const { return numbered.of_triangle[triangle]; }
  const std::vector<Piece>& pieces() const { return numbered.pieces; }

  /// Which pieces there are at each position.
  Lists pieces_at(std::size_t positions_in_all) const;

  std::vector<Index> triangles_of(const std::vector<Index>& some_pieces) const;

  /// The kinds of what some triangles are when they are joined where their positions coincide, in order.
  std::vector<Kind> kinds_by_position(const std::vector<Index>& some_triangles) const;

  const Triangle_soup& soup;
  const Index* positions; ///< of the vertices, with common numbers
  Numbered_pieces numbered;
  Lists triangles; ///< of each piece
};

/// "1 face", "2000 faces".
std::string counted(std::size_t count, const char* noun);

/// "2 boundary loops and Euler characteristic 0", "1 boundary loop, edges of more than two faces and ..."
std::string describe(const Kind& kind);

/// "piece 3 ('lining', 421 faces around (0.1, 0.9, 0))"
std::string describe(const Piece_mesh& mesh, Index piece);

/// The first three of several.
std::string describe(const Piece_mesh& mesh, const std::vector<Index>& pieces);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_PIECE_MESH_H
