// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Likeness.h"
#include "match_steps.h"

#include <algorithm>
#include <map>
#include <utility>

// Matches the pieces of a result whose vertices are not those of the original, for `match_pieces`.

namespace selvedge::internal {
namespace {

// How many times as far as the nearest piece a matching piece may be.
constexpr double most_excess = 2;

} // namespace

void match_by_distance(Matching& matching)
{
  const std::vector<Index> left_now = matching.left_of_result(), left_before = matching.left_of_original();
  if (left_now.empty() || left_before.empty())
    return;
  Shapes now(matching.result.soup, matching.result.triangles, matching.exponent);
  Shapes before(matching.original.soup, matching.original.triangles, matching.exponent);
  struct Distances_of_pair
  {
    double to_original, to_result;
  };
  std::map<Pair, Distances_of_pair> distances; // of a piece of the result and one of the original
  const auto add = [&](Index r, Index o) {
    if (distances.count({r, o}) == 0)
      distances[{r, o}] = {now[r].root_mean_square_distance(before[o]),
                           before[o].root_mean_square_distance(now[r])};
  };
  {
    const Nearest_pieces in_original(matching.original.soup, matching.original.numbered.of_triangle,
                                     matching.exponent);
    for (const Index r : left_now)
      for (const Index o : in_original.pieces_near(now[r]))
        add(r, o);
    const Nearest_pieces in_result(matching.result.soup, matching.result.numbered.of_triangle,
                                   matching.exponent);
    for (const Index o : left_before)
      for (const Index r : in_result.pieces_near(before[o]))
        add(r, o);
  }
  std::map<Index, double> least_to_original, least_to_result;
  for (const auto& [pair, distance] : distances) {
    const auto lower = [](std::map<Index, double>& least, Index piece, double value) {
      double& entry = least.emplace(piece, value).first->second;
      entry = std::min(entry, value);
    };
    lower(least_to_original, pair.first, distance.to_original);
    lower(least_to_result, pair.second, distance.to_result);
  }
  std::vector<Possible_match> possible;
  for (const auto& [pair, distance] : distances) {
    const auto [r, o] = pair;
    if (matching.is_left_of_result(r) && matching.is_left_of_original(o) && matching.are_of_one_kind(r, o) &&
        distance.to_original <= most_excess * least_to_original[r] &&
        distance.to_result <= most_excess * least_to_result[o] &&
        std::max(distance.to_original, distance.to_result) <= most_distance * before[o].diagonal())
      possible.push_back({distance.to_original, 0, r, o});
  }
  matching.match_one_to_one(std::move(possible), Matched_by::distance);
}

} // namespace selvedge::internal
