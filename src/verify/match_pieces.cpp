// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "match_names.h"
#include "match_steps.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <utility>

// Finds which piece of a result came from which piece of its original, a part of the verdict of `verify`. The
// steps 1 to 4 are those that verify.h states.

namespace selvedge {

namespace {

Piece_matching matching_of(const Triangle_soup& result, const Triangle_soup& original,
                           const Verify_options& options, bool is_by_triangles_first)
{
  using namespace internal;
  Matching matching(result, original, options);
  if (is_by_triangles_first)
    match_by_triangles(matching);
  match_by_vertices(matching);
  Cancellation_scope::check();
  if (!is_by_triangles_first)
    match_by_triangles(matching);
  match_within_reach(matching);
  match_by_near_vertices(matching);
  match_joined(matching, false);
  Cancellation_scope::check();
  match_by_distance(matching);
  Cancellation_scope::check();
  match_joined(matching, true);
  Cancellation_scope::check();
  tell_what_is_left(matching);
  Piece_matching& found = matching.found;
  found.matches.erase(std::remove_if(found.matches.begin(), found.matches.end(),
                                     [](const Piece_match& match) { return match.of_original.empty(); }),
                      found.matches.end());
  match_names(found, matching.result, matching.original, matching.position_count, matching.exponent);
  if (options.are_shapes_judged)
    judge_shapes(matching);
  found.pieces_of_original = matching.original.pieces();
  found.pieces_of_result = matching.result.pieces();
  return std::move(found);
}

} // namespace

Piece_matching match_pieces(const Triangle_soup& result, const Triangle_soup& original,
                            const Verify_options& options)
{
  Piece_matching found = matching_of(result, original, options, false);
  if (found.mismatches.empty() || options.triangles_of_original.empty())
    return found;
  // A patch has all its vertices in common with the piece around it. Where that has new places, the patch may
  // be taken for it.
  Piece_matching by_triangles = matching_of(result, original, options, true);
  return by_triangles.mismatches.size() < found.mismatches.size() ? by_triangles : found;
}

} // namespace selvedge
