// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Diagonal.h"
#include "Likeness.h"
#include "match_steps.h"

#include <selvedge/Cancellation_scope.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>

// Judges how far matched pieces are apart and whether they are turned inside out, for `match_pieces`.

namespace selvedge::internal {
namespace {

// A piece that has a vertex of its original may be this far off, as a share of the diagonal of the whole
// mesh: small parts are no larger, and a reduction may leave little of them.
constexpr double most_distance_of_own = 0.01;

bool has_vertex_of_original(Matching& matching, const Piece_match& match)
{
  const std::vector<Index>& positions = matching.positions_nearby();
  const auto is_of_original = [&](Index position) {
    const Lists::Range here = matching.original_at[position];
    return std::any_of(match.of_original.begin(), match.of_original.end(),
                       [&](Index o) { return std::binary_search(here.begin(), here.end(), o); });
  };
  const std::vector<Index> triangles = matching.result.triangles_of(match.of_result);
  return std::any_of(triangles.begin(), triangles.end(), [&](Index t) {
    const Index_triple& corners = matching.result.soup.triangles[t];
    return std::any_of(corners.begin(), corners.end(),
                       [&](Index vertex) { return is_of_original(positions[vertex]); });
  });
}

} // namespace

void judge_shapes(Matching& matching)
{
  std::vector<double> diagonals(matching.found.matches.size()); // of the pieces of the original
  std::vector<char> are_turned(matching.found.matches.size());
  const auto judge = [&](std::size_t i) {
    Piece_match& match = matching.found.matches[i];
    const Shape before(matching.original.soup, matching.original.triangles_of(match.of_original),
                       matching.exponent);
    const Shape now(matching.result.soup, matching.result.triangles_of(match.of_result), matching.exponent);
    const Likeness likeness(now, before);
    match.distance = likeness.distance;
    diagonals[i] = before.diagonal();
    match.turned = likeness.turned;
    are_turned[i] = likeness.is_turned;
  };
  tbb::parallel_for(std::size_t(0), matching.found.matches.size(), Cancellation_scope::inherited(judge));
  const double allowed = most_distance_of_own * Diagonal(matching.original.soup).length(matching.exponent);
  for (std::size_t i = 0; i < matching.found.matches.size(); ++i) {
    const Piece_match& match = matching.found.matches[i];
    const auto what = [&] {
      return describe(matching.original, match.of_original) + " of the original and " +
             describe(matching.result, match.of_result) + " of the result";
    };
    if (match.distance > most_distance &&
        !(match.distance * diagonals[i] <= allowed && has_vertex_of_original(matching, match))) {
      char percents[32];
      std::snprintf(percents, sizeof percents, "%.0f %%", 100 * match.distance);
      matching.add_mismatch(Mismatch::far, match.of_original, match.of_result,
                            what() + " are " + percents + " of their size apart in the mean");
    }
    if (are_turned[i])
      matching.add_mismatch(Mismatch::turned, match.of_original, match.of_result,
                            what() + " have their outsides on different sides");
  }
}

} // namespace selvedge::internal
