// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Likeness.h"
#include "Piece_names.h"
#include "match_steps.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

// Matches the pieces of a result whose vertices are those of a piece of the original, or next to them, for
// `match_pieces`.

namespace selvedge::internal {
namespace {

// Several pieces may have all vertices of one: a tube has those of its caps, and a doubled sheet lies in
// one place twice. Where neither vertices nor names tell pieces apart, those come first of which the least is
// turned, and those of different shapes last.
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
    if (results[rank_of_result(pair)] > 1 || originals[rank_of_original(pair)] > 1) {
      const Likeness likeness(now[pair.of_result], before[pair.of_original]);
      pair.unlikeness = likeness.turned + (likeness.is_wrong() ? 1 : 0);
    }
  }
}

// Returns all pairs of pieces of which at least half of the positions of the first are positions of the
// second, whatever their kinds. `result_at` has the pieces of the result at each position.
std::vector<Possible_match> with_common_positions(const Matching& matching, const Lists& result_at)
{
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
  std::vector<Possible_match> found;
  for (auto first = hits.begin(), last = first; first != hits.end(); first = last) {
    last = std::find_if(first, hits.end(), [&](const Pair& pair) { return pair != *first; });
    const auto [r, o] = *first;
    const std::size_t count = std::size_t(last - first);
    if (2 * count < sizes[r])
      continue;
    const double missing = 1 - double(count) / double(sizes[r]);
    found.push_back({missing, names.differing(r, o), r, o});
  }
  return found;
}

void match_those_of_one_kind(Matching& matching, const std::vector<Possible_match>& pairs, Matched_by by)
{
  std::vector<Possible_match> possible;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(possible), [&](const Possible_match& pair) {
    return matching.is_left_of_result(pair.of_result) && matching.is_left_of_original(pair.of_original) &&
           matching.are_of_one_kind(pair.of_result, pair.of_original);
  });
  if (matching.options.are_shapes_judged)
    compare_shapes_of_equals(matching, possible);
  matching.match_one_to_one(std::move(possible), by);
}

} // namespace

void match_by_vertices(Matching& matching)
{
  matching.near = with_common_positions(matching, matching.result.pieces_at(matching.position_count));
  match_those_of_one_kind(matching, matching.near, Matched_by::vertices);
}

// Numbers that were written with few digits are not the original's bit for bit. Distances between surfaces
// would not do: the vertices of the original may be nearer to another layer of the result than to their own,
// if that was reduced further, and all vertices of a small piece may lie on the border of another one.
void match_by_near_vertices(Matching& matching)
{
  if (matching.left_of_result().empty() || matching.left_of_original().empty())
    return;
  const Lists result_at =
      matching.result.pieces_at(matching.position_count, matching.positions_nearby().data());
  match_those_of_one_kind(matching, with_common_positions(matching, result_at), Matched_by::distance);
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
