// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_PIECES_IN_FILE_H
#define SELVEDGE_SRC_VERIFY_PIECES_IN_FILE_H

#include "Piece_mesh.h"
#include "Piece_names.h"

#include <vector>

namespace selvedge::internal {

/// The pieces of a result as its file numbers them (`Verify_options::triangles_in_file`). Each is a part of a
/// piece of the result.
class Pieces_in_file
{
public:
  /// All arguments must outlive this object.
  Pieces_in_file(const Piece_mesh& result, const std::vector<Index_triple>& triangles_in_file,
                 const Piece_mesh& original);

  /// Returns whether some pieces of the original, `hidden`, are in the result, where `of_result` is what
  /// became of all of `of_original`: the file has a piece for each of them, of the same kind and names, at
  /// positions of that piece alone; beside these, it has one for as many of the others as without them; and
  /// what is left without these pieces is of the same kinds in both. `original_at` has the pieces of the
  /// original at each position. All numbers are in ascending order.
  bool have(const std::vector<Index>& hidden, const std::vector<Index>& of_original,
            const std::vector<Index>& of_result, const Lists& original_at) const;

private:
  std::vector<Index> origins(Index piece, const std::vector<Index>& of_original,
                             const Lists& original_at) const;

  const Piece_mesh& m_result;
  const Piece_mesh& m_original;
  Triangle_soup m_soup;
  Piece_mesh m_mesh;
  Piece_names m_names;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_PIECES_IN_FILE_H
