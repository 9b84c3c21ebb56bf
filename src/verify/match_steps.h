// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_MATCH_STEPS_H
#define SELVEDGE_SRC_VERIFY_MATCH_STEPS_H

#include "Matching.h"

// The steps of `match_pieces`, in their order. Each looks at the pieces that are left; verify.h states the
// rules.

namespace selvedge::internal {

void match_by_vertices(Matching& matching);
void match_by_triangles(Matching& matching);
void match_within_reach(Matching& matching);
void match_by_near_vertices(Matching& matching);

/// Matches pieces that are joined where positions coincide; by distance, too, or not.
void match_joined(Matching& matching, bool is_by_distance);

void match_by_distance(Matching& matching);

/// Adds a mismatch for all that no step has matched.
void tell_what_is_left(Matching& matching);

/// Measures the matches, and adds a mismatch for those whose shapes differ.
void judge_shapes(Matching& matching);

/// Lists the pieces of the original at every position. A position that both meshes have also gets the pieces
/// with a border vertex within the weld distance, be it of this position or of a border vertex that was
/// reached so.
Lists within_reach(const Matching& matching);

/// Returns a number for each position, the same for those of border vertices of the original that the weld
/// distance joins, one after another.
std::vector<Index> joined_positions(const Matching& matching);

/// Returns the number of the position of each vertex of the result. A vertex whose position the original does
/// not have gets the position of the original that it is clearly next to, if there is one: it is no farther
/// than 3e-6 of the diagonal of the original, and any other position is at least ten times as far.
std::vector<Index> near_positions(const Matching& matching);

/// The numbers of the places of all vertices of the original, and its pieces at each place.
struct Places
{
  const Index* of_vertices;
  const Lists& pieces_at;
};

/// Of pieces that have no triangle of the result for themselves, returns those that may be missing: without
/// them, what they are joined to would be of the same kind. A patch that others surround would leave a hole;
/// a notch that it fills could stay open unnoticed. Places are positions, or what joins several of them.
std::vector<Index> perhaps_missing(const Matching& matching, const std::vector<Index>& unseen,
                                   const std::vector<Index>& of_original, const Places& places);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_MATCH_STEPS_H
