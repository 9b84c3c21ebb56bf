// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Likeness.h"
#include "Piece_names.h"
#include "match_steps.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

// Matches the pieces of a result whose vertices are those of a piece of the original, for `match_pieces`.

namespace selvedge::internal {
namespace {

// Several pieces may have all vertices of one: a tube has those of its caps, and a doubled sheet lies in
// one place twice. Where neither vertices nor names tell pieces apart, those of different shapes come last.
void compare_shapes_of_equals(const Matching& matching, std::vector<Possible_match>& possible)
{
  using Rank = std::tuple<Index, double, std::size_t>;
  const auto rank_of_result = [](const Possible_match& pair) {
    return Rank(pair.of_result, pair.distance, pair.names_differing);
  };
  const auto rank_of_original = [](const Possible_match& pair) {
    return Rank(pair.of_original, pair.distance, pair.names_differing);
  };
  std::map<Rank, std::size_t> results, originals;
  for (const Possible_match& pair : possible) {
    ++results[rank_of_result(pair)];
    ++originals[rank_of_original(pair)];
  }
  Shapes now(matching.result.soup, matching.result.triangles, matching.exponent);
  Shapes before(matching.original.soup, matching.original.triangles, matching.exponent);
  Cancellation_poll poll;
  for (Possible_match& pair : possible) {
    poll();
    if (results[rank_of_result(pair)] > 1 || originals[rank_of_original(pair)] > 1)
      pair.is_wrong = Likeness(now[pair.of_result], before[pair.of_original]).is_wrong();
  }
}

} // namespace

void match_by_vertices(Matching& matching)
{
  const Lists result_at = matching.result.pieces_at(matching.position_count);
  std::vector<std::size_t> sizes(matching.result.pieces().size());
  std::vector<Pair> hits;
  Cancellation_poll poll;
  for (std::size_t position = 0; position < matching.position_count; ++position) {
    poll();
    if (result_at[position].size() > most_at_a_position ||
        matching.original_at[position].size() > most_at_a_position)
      continue;
    for (const Index r : result_at[position]) {
      ++sizes[r];
      for (const Index o : matching.original_at[position])
        hits.emplace_back(r, o);
    }
  }
  std::sort(hits.begin(), hits.end());
  const Piece_names names(matching.result, matching.original);
  std::vector<Possible_match> possible;
  for (auto first = hits.begin(), last = first; first != hits.end(); first = last) {
    last = std::find_if(first, hits.end(), [&](const Pair& pair) { return pair != *first; });
    const auto [r, o] = *first;
    const std::size_t count = std::size_t(last - first);
    if (2 * count < sizes[r])
      continue;
    const double missing = 1 - double(count) / double(sizes[r]);
    matching.near.push_back({missing, names.differing(r, o), r, o});
    if (matching.are_of_one_kind(r, o))
      possible.push_back(matching.near.back());
  }
  if (matching.options.are_shapes_judged)
    compare_shapes_of_equals(matching, possible);
  matching.match_one_to_one(std::move(possible), Matched_by::vertices);
}

// What the caller says is checked as far as pieces go: one piece comes from one piece, and has its kind.
void match_by_triangles(Matching& matching)
{
  const std::vector<Index>& origins = matching.options.triangles_of_original;
  if (origins.size() != matching.result.soup.triangles.size())
    return;
  std::set<Pair> pairs;
  for (Index t = 0; t < origins.size(); ++t)
    if (matching.result.piece(t) != no_piece)
      pairs.emplace(matching.result.piece(t), matching.original.piece(origins[t]));
  std::vector<Index> origins_of(matching.result.pieces().size()),
      results_of(matching.original.pieces().size());
  for (const auto& [r, o] : pairs) {
    ++origins_of[r];
    if (o != no_piece)
      ++results_of[o];
  }
  for (const auto& [r, o] : pairs)
    if (o != no_piece && origins_of[r] == 1 && results_of[o] == 1 && matching.is_left_of_result(r) &&
        matching.is_left_of_original(o) && matching.are_of_one_kind(r, o))
      matching.match({o}, {r}, Matched_by::triangles);
}

} // namespace selvedge::internal
