// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_MATCH_NAMES_H
#define SELVEDGE_SRC_VERIFY_MATCH_NAMES_H

#include "Piece_mesh.h"

namespace selvedge::internal {

/// Judges the names of matched pieces: adds mismatches, and sets which names were compared; see
/// `match_pieces`.
///
/// `position_count` is the number of positions of both meshes. Division by 2^`exponent` brings both to a size
/// at which squares neither overflow nor vanish.
void match_names(Piece_matching& matching, const Piece_mesh& result, const Piece_mesh& original,
                 std::size_t position_count, int exponent);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_MATCH_NAMES_H
