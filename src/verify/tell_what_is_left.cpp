// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "match_steps.h"

#include <algorithm>
#include <utility>

// Says which pieces have no match, for `match_pieces`.

namespace selvedge::internal {
namespace {

bool is_in_group_of_several(const Matching& matching, Index r)
{
  return std::any_of(matching.groups.begin(), matching.groups.end(), [&](const Matching::Joined& group) {
    return group.of_original.size() + group.of_result.size() > 2 &&
           std::binary_search(group.of_result.begin(), group.of_result.end(), r);
  });
}

} // namespace

void tell_what_is_left(Matching& matching)
{
  std::vector<bool> is_told_of_result(matching.result.pieces().size()),
      is_told_of_original(matching.original.pieces().size());
  std::stable_sort(matching.near.begin(), matching.near.end());
  for (const Possible_match& near : matching.near) {
    const Index r = near.of_result, o = near.of_original;
    if (!matching.is_left_of_result(r) || !matching.is_left_of_original(o) || is_told_of_result[r] ||
        is_told_of_original[o] || is_in_group_of_several(matching, r))
      continue;
    is_told_of_result[r] = is_told_of_original[o] = true;
    matching.add_mismatch(Mismatch::topology, {o}, {r},
                          describe(matching.original, o) + " of the original is " +
                              describe(matching.result, r) + " of the result, which has " +
                              describe(kind(matching.result.pieces()[r])) + " instead of " +
                              describe(kind(matching.original.pieces()[o])));
  }
  for (const Matching::Joined& group : matching.groups) {
    bool is_any_new = false;
    const auto tell = [&](Index piece, std::vector<bool>& is_told, bool is_left) {
      is_any_new = is_any_new || (is_left && !is_told[piece]);
      is_told[piece] = true;
    };
    for (const Index o : group.of_original)
      tell(o, is_told_of_original, matching.is_left_of_original(o));
    for (const Index r : group.of_result)
      tell(r, is_told_of_result, matching.is_left_of_result(r));
    if (!is_any_new)
      continue;
    std::string message = describe(matching.original, group.of_original) + " of the original and " +
                          describe(matching.result, group.of_result) +
                          " of the result lie at the same place, but do not hang together alike";
    if (group.is_broken && matching.options.weld_distance == 0)
      message += "; if borders were joined on purpose, give the weld distance";
    matching.add_mismatch(Mismatch::topology, group.of_original, group.of_result, std::move(message));
    // Pieces of this group that did match have done so by chance.
    for (const Index o : group.of_original)
      if (const Index match = std::exchange(matching.match_of_original[o], no_piece); match != no_piece)
        matching.found.matches[match] = {};
    for (const Index r : group.of_result)
      matching.match_of_result[r] = no_piece;
  }
  for (const Index o : matching.left_of_original())
    if (!is_told_of_original[o])
      matching.add_mismatch(Mismatch::missing, {o}, {},
                            describe(matching.original, o) + " of the original is not in the result" +
                                (matching.is_hidden[o]
                                     ? ", or nothing shows that it is: all of its vertices are of other "
                                       "pieces, too, and the result does not number them apart"
                                     : ""));
  for (const Index r : matching.left_of_result())
    if (!is_told_of_result[r])
      matching.add_mismatch(Mismatch::added, {}, {r},
                            describe(matching.result, r) + " of the result is no piece of the original");
}

} // namespace selvedge::internal
