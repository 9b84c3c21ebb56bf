// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_MATCHING_H
#define SELVEDGE_SRC_VERIFY_MATCHING_H

#include "Piece_mesh.h"
#include "Pieces_in_file.h"
#include "one_to_one.h"

#include <optional>

namespace selvedge::internal {

/// The pieces of a result and of its original, and what the steps of `match_pieces` have found of them so
/// far.
struct Matching
{
  /// Pieces that lie at the same place and did not match by positions.
  struct Joined
  {
    std::vector<Index> of_original, of_result;
    bool is_broken; ///< a triangle of the result has corners of different pieces
  };

  /// All arguments must outlive this object.
  Matching(const Triangle_soup& of_result, const Triangle_soup& of_original,
           const Verify_options& verify_options);

  bool is_left_of_result(Index piece) const { return match_of_result[piece] == no_piece; }
  bool is_left_of_original(Index piece) const { return match_of_original[piece] == no_piece; }
  std::vector<Index> left_of_result() const;
  std::vector<Index> left_of_original() const;
  bool is_complete() const { return left_of_result().empty() && left_of_original().empty(); }
  bool is_one_empty() const;
  bool are_of_one_kind(Index r, Index o) const
  {
    return kind(result.pieces()[r]) == kind(original.pieces()[o]);
  }

  /// Matches pieces; earlier matches of any of them are dissolved.
  void match(std::vector<Index> of_original, std::vector<Index> of_result, Matched_by by);

  /// Matches the best of possible matches, as `one_to_one` says.
  void match_one_to_one(std::vector<Possible_match> possible, Matched_by by);

  void add_mismatch(Mismatch what, std::vector<Index> of_original, std::vector<Index> of_result,
                    std::string message)
  {
    found.mismatches.push_back({what, std::move(of_original), std::move(of_result), std::move(message)});
  }

  /// Returns the pieces of the original at every position, as `within_reach` says.
  const Lists& reach();

  /// Returns the positions of the vertices of the result, as `near_positions` says.
  const std::vector<Index>& positions_nearby();

  /// Returns the pieces of the result as its file numbers them, or null where this is not known.
  const Pieces_in_file* pieces_in_file();

  const Verify_options& options;
  std::vector<Index> positions;
  std::size_t position_count;
  Piece_mesh result, original;
  int exponent;
  Lists original_at; ///< the pieces of the original at each position
  std::vector<Index> match_of_result, match_of_original;
  std::vector<bool> is_hidden;      ///< of pieces of the original, as `perhaps_missing` says
  std::vector<Possible_match> near; ///< pairs by vertices, whatever their kinds
  std::vector<Joined> groups;       ///< groups by positions that did not match
  Piece_matching found;

private:
  std::optional<Lists> m_reach;
  std::optional<std::vector<Index>> m_positions_nearby;
  std::optional<Pieces_in_file> m_pieces_in_file;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_MATCHING_H
