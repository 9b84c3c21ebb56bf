// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_ONE_TO_ONE_H
#define SELVEDGE_SRC_VERIFY_ONE_TO_ONE_H

#include "Lists.h"

#include <tuple>

namespace selvedge::internal {

/// A piece of the result that may be what became of a piece of the original.
struct Possible_match
{
  double distance; ///< of whatever kind; 0 for the best
  bool do_names_differ;
  Index of_result, of_original;

  bool operator<(const Possible_match& other) const
  {
    return std::tie(distance, do_names_differ, of_result, of_original) <
           std::tie(other.distance, other.do_names_differ, other.of_result, other.of_original);
  }
};

/// Pairs of a piece of the result and one of the original, each piece in one pair at most: the best first,
/// then as many more as exchanges among those chosen allow.
///
/// Each search for an exchange looks at no more than some thousand possible matches, so a pair may be missed
/// where thousands of pieces lie at one place.
std::vector<Pair> one_to_one(std::vector<Possible_match> possible, std::size_t pieces_of_result,
                             std::size_t pieces_of_original);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_ONE_TO_ONE_H
