// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "match_steps.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

// Tells which pieces of an original could be missing in a result without notice, for `match_pieces`.

namespace selvedge::internal {
namespace {

long characteristic(const std::vector<Kind>& kinds)
{
  return std::accumulate(kinds.begin(), kinds.end(), 0L,
                         [](long sum, const Kind& kind) { return sum + std::get<long>(kind); });
}

// A piece of the original, and those of some others that have a place in common with it.
std::vector<Index> pieces_around(const Piece_mesh& original, Index piece, const std::vector<Index>& others,
                                 const Places& places)
{
  std::vector<Index> around{piece}, result;
  for (const Index t : original.triangles[piece])
    for (const Index vertex : original.soup.triangles[t]) {
      const Lists::Range here = places.pieces_at[places.of_vertices[vertex]];
      around.insert(around.end(), here.begin(), here.end());
    }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  std::set_intersection(around.begin(), around.end(), others.begin(), others.end(),
                        std::back_inserter(result));
  return result;
}

} // namespace

std::vector<Index> perhaps_missing(const Matching& matching, const std::vector<Index>& unseen,
                                   const std::vector<Index>& of_original, const Places& places)
{
  if (unseen.empty())
    return {};
  const auto kinds_without = [&](const std::vector<Index>& left_out, const std::vector<Index>& all) {
    std::vector<Index> others;
    std::set_difference(all.begin(), all.end(), left_out.begin(), left_out.end(), std::back_inserter(others));
    return matching.original.kinds_by_position(matching.original.triangles_of(others), places.of_vertices);
  };
  const std::vector<Kind> whole = kinds_without({}, of_original);
  if (kinds_without(unseen, of_original) == whole)
    return unseen;
  constexpr int most = 100; // so many times, all is looked at
  int looks = 0;
  const auto would_be_missed = [&](Index o) {
    Cancellation_scope::check();
    // What the Euler characteristic of the whole loses is what that of the pieces around this one loses.
    const std::vector<Index> around = pieces_around(matching.original, o, of_original, places);
    return characteristic(kinds_without({o}, around)) != characteristic(kinds_without({}, around)) ||
           (looks++ < most && kinds_without({o}, of_original) != whole);
  };
  std::vector<Index> result;
  std::remove_copy_if(unseen.begin(), unseen.end(), std::back_inserter(result), would_be_missed);
  return result;
}

} // namespace selvedge::internal
