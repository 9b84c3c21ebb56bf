// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_ONE_TO_ONE_H
#define SELVEDGE_SRC_VERIFY_ONE_TO_ONE_H

#include "Lists.h"

#include <tuple>

namespace selvedge::internal {

/// A piece of the result and a piece of the original that may match, a candidate of `match_pieces`.
struct Possible_match
{
  double distance;             ///< any measure; 0 is best
  std::size_t names_differing; ///< that only one of the two has; decides between equal distances
  Index of_result, of_original;
  double unlikeness = 0; ///< how different the two shapes are; decides where names do not

  bool operator<(const Possible_match& other) const
  {
    return std::tie(distance, names_differing, unlikeness, of_result, of_original) <
           std::tie(other.distance, other.names_differing, other.unlikeness, other.of_result,
                    other.of_original);
  }
};

/// Returns pairs of a piece of the result and one of the original, each piece in one pair at most: the best
/// first, then as many more as can be had by exchanging partners.
///
/// Each search for an exchange looks at no more than 1000 possible matches, so a pair may be missed where
/// thousands of pieces lie at one place.
std::vector<Pair> one_to_one(std::vector<Possible_match> possible, std::size_t pieces_of_result,
                             std::size_t pieces_of_original);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_ONE_TO_ONE_H
