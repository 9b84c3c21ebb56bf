// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_PIECES_H
#define SELVEDGE_SRC_VERIFY_PIECES_H

#include <selvedge/verify.h>

namespace selvedge::internal {

constexpr Index no_piece = -1;

/// The pieces of a mesh, as the judge counts and matches them, with the piece of each triangle.
struct Numbered_pieces
{
  std::vector<Piece> pieces;
  /// The piece of each triangle; `no_piece` for one with two corners at one position.
  std::vector<Index> of_triangle;
};

/// Finds the pieces of triangles whose vertices, with numbers below `vertices`, all have positions of their
/// own.
Numbered_pieces numbered_pieces(const std::vector<Index_triple>& triangles, std::size_t vertices);

/// Finds the pieces of a soup, as `pieces` does.
Numbered_pieces numbered_pieces(const Triangle_soup& soup);

/// Finds the pieces of a soup where `positions` holds the number of each vertex's position.
Numbered_pieces numbered_pieces(const Triangle_soup& soup, const Index* positions);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_PIECES_H
