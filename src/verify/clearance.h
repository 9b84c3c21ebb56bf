// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_CLEARANCE_H
#define SELVEDGE_SRC_VERIFY_CLEARANCE_H

#include "pieces.h"

#include <selvedge/verify.h>

#include <vector>

namespace selvedge::internal {

/// Numbers the pieces of a mesh that are connected by positions: returns the number of each triangle's, and
/// `no_piece` for one that belongs to none by vertices. Triangles without a number by vertices, which come
/// last, are those of an obstacle, which is one piece.
std::vector<Index> pieces_by_position(const Triangle_soup& mesh, const Numbered_pieces& by_vertices);

/// Numbers the pieces of a result and of its original alike: those of the original by position, with those
/// that a match joins made one, and those of the result by what they are matched with, or else by vertices.
/// Where `triangles_of_original` is given, a triangle has the number of that which it was. Triangles that
/// belong to no piece by vertices connect none. The last triangles of both meshes, which have no pieces by
/// vertices, are those of one obstacle, which connects no pieces.
struct Matched_pieces
{
  std::vector<Index> of_result, of_original; // by triangle
};
Matched_pieces matched_pieces(const Triangle_soup& result, const Triangle_soup& original,
                              const Numbered_pieces& pieces_of_result,
                              const Numbered_pieces& pieces_of_original, const Piece_matching& matching,
                              const std::vector<Index>& triangles_of_original);

/// Finds the pieces that are nearer to each other than a clearance, and which of them are too near.
///
/// **Exactness** The answers are exact: interval arithmetic decides where it can, rational numbers otherwise.
Clearance_verdict judge_clearance(double clearance, const Triangle_soup& mesh,
                                  const std::vector<Index>& pieces);
Clearance_verdict judge_clearance(double clearance, const Triangle_soup& result,
                                  const Triangle_soup& original, const Matched_pieces& pieces);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_CLEARANCE_H
