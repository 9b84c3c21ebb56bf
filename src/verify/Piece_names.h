// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_PIECE_NAMES_H
#define SELVEDGE_SRC_VERIFY_PIECE_NAMES_H

#include "Piece_mesh.h"

namespace selvedge::internal {

/// The names (groups, objects, materials) of the pieces of two meshes.
class Piece_names
{
public:
  Piece_names(const Piece_mesh& result, const Piece_mesh& original);

  /// Returns how many names only one of two pieces has. Kinds of names that only one mesh has do not count.
  std::size_t differing(Index of_result, Index of_original) const;

private:
  Lists m_of_result, m_of_original;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_PIECE_NAMES_H
