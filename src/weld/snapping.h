// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_WELD_SNAPPING_H
#define SELVEDGE_WELD_SNAPPING_H

#include "open_seams.h"
#include <selvedge/Snapping_notes.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Scale.h>
#include <selvedge/spatial/Packed_R_tree.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// What `snap_borders` did, and what it left open within the weld distance.
struct Snapped_borders
{
  Snapping_notes notes;
  Gaps_left left;
};

/// Snaps border vertices together, to close seams whose two sides lie within `distance` of each other: of two
/// partners, one moves to the position of the other.
///
/// Two border vertices are **partners** when
/// - they lie within `distance` of each other,
/// - they belong to no common face,
/// - the next vertices along their borders, in opposite directions, also lie within `distance` of each other,
///   or are one,
/// - no stretch of border of at most twice `distance` leads from one to the other.
///
/// They may belong to one piece, as at a dart.
///
/// Snapping goes in rounds, until a round changes nothing. In a round, every border vertex names its nearest
/// partner that is not frozen; of partners at the same distance, the one with the lower position number. Two
/// that name each other are snapped together if they are still partners when their turn comes. The order is
/// by distance, then by numbers. So where several pieces meet in a corner, all come to one position, one
/// after another. The vertex with fewer faces moves; if both have as many, the one with the higher number. If
/// that motion is refused, the other vertex is tried. All vertices at one position move together.
///
/// **Guarantees**
/// 1. *One of the two*: no new position is made. The vertex that moves takes the coordinates of its partner,
///    bit for bit. Everything else that a vertex has, such as texture coordinates, stays as it is, and so do
///    all numbers.
/// 2. *Embedded, motion*: each snap is judged, exactly, as the motion of a point with all its faces along a
///    straight line: nothing is met or passed through on the way, and no face degenerates. The offending
///    pairs afterwards are those before.
/// 3. *Frozen*: a vertex of a frozen face does not move, and none moves to it.
/// 4. *Manifold*: only two border edges that run opposite ways become one edge.
/// 5. *Deterministic*: the result depends neither on the index nor on the build.
///
/// `positions[v]` is the number of the first vertex at the position of v, before and after. `is_frozen` says
/// for each triangle whether its vertices stay where they are. `transforms`, empty or one number per vertex,
/// says which vertices may share a position: vertices with different numbers are not snapped together, and
/// positions with several numbers count as frozen. The last `obstacle_triangles` triangles, which are frozen,
/// are those of an obstacle: nothing is snapped to their borders, and where they lie along borders of the
/// others, these are borders all the same. Distances are compared after division by the scale.
///
/// **Preconditions** No triangle has two corners at one position. All triangles of offending pairs are
/// frozen.
///
/// Throws `Argument_error` unless `distance` is finite and not negative. At 0 nothing is done.
///
/// **Exactness** Distances, which decide what is tried, are rounded to double. Every judgement is exact.
///
/// **Complexity** O(n log n) for n triangles and, in each round, as many steps as there are pairs of border
/// vertices within `distance`. There are about as many rounds as pieces that meet in one corner.
template <class FaceIndex = Packed_R_tree>
Snapped_borders snap_borders(Triangle_soup& soup, std::vector<Index>& positions,
                             const std::vector<char>& is_frozen, double distance,
                             const std::vector<Index>& transforms = {}, std::size_t obstacle_triangles = 0,
                             const Scale& scale = Scale());

} // namespace selvedge

#endif // SELVEDGE_WELD_SNAPPING_H
