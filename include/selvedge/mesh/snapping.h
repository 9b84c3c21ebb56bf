// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_SNAPPING_H
#define SELVEDGE_MESH_SNAPPING_H

#include <selvedge/mesh/Scale.h>
#include <selvedge/mesh/Triangle_soup.h>
#include <selvedge/spatial/Packed_R_tree.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// Two positions that became one, by the first vertex at each, as numbered before anything was snapped.
struct Snap
{
  Index from;
  Index to;
};

/// What snapping found and did, to be told to the user. Vertices are counted by position.
struct Snapping_notes
{
  double distance = 0; ///< within which partners were looked for

  std::size_t border_vertices = 0; ///< on borders, before
  std::size_t partnered = 0;       ///< of these: have a partner
  std::size_t sewn = 0;            ///< of the partnered: share a position with a partner now

  /// Partnered and left as they were, by reason; with `sewn` they make up `partnered`.
  std::size_t left_ambiguous = 0;  ///< every partner has a nearer one, or went with another
  std::size_t left_frozen = 0;     ///< they, or all partners, belong to frozen faces
  std::size_t left_foreign = 0;    ///< all partners are under other transforms
  std::size_t left_unmanifold = 0; ///< an edge would get a third face, or two that run along it the same way
  std::size_t left_folding = 0;    ///< the faces that move would degenerate or run into each other
  std::size_t left_blocked = 0;    ///< the faces that move would run into others

  /// Not partnered, though near another border: there is no edge to sew.
  std::size_t near_without_edge = 0;

  std::size_t seam_edges = 0;  ///< pairs of border edges that have become one edge
  double largest_distance = 0; ///< of one snap; where several pieces meet, a vertex may go more than once
  std::vector<Snap> snaps;     ///< the motions, one after another
};

/// Closes seams whose two sides lie within `distance` of each other, vertex by vertex: one of two partners
/// goes to the place of the other.
///
/// Two border vertices are **partners** when they lie within `distance`, belong to no common face, have the
/// next vertices along their borders, in opposite directions, within `distance` of each other too or in
/// common, and are not joined by a stretch of border of at most twice `distance`. They may belong to one
/// piece, as at a dart.
///
/// In rounds, until one changes nothing: every border vertex names its nearest partner that is not frozen,
/// the lower position number first where two are as near, and those who name each other are joined, by
/// ascending distance, then numbers, if they still are partners then. So where several pieces meet in a
/// corner, all come to one position, one after another. The one with fewer faces goes, of two alike the one
/// with the higher number; if that is refused, the other goes. All vertices at one position go together.
///
/// **Guarantees**
/// 1. *One of the two*: no new position is made; who goes takes the coordinates of the partner, bit for bit.
///    All else, texture coordinates among it, stays each vertex's own, and so do all numbers.
/// 2. *Embedded, motion*: each snap is judged, exactly, as the motion of a point with all its faces on a
///    straight line: nothing is met or passed on the way, and no face degenerates. The offending pairs
///    afterwards are those before.
/// 3. *Frozen*: a vertex of a frozen face does not move, and none moves to it.
/// 4. *Manifold*: two border edges that run opposite ways become one; no other edges do.
/// 5. *Deterministic*: what is found depends neither on the index nor on the build.
///
/// `positions[v]` is the number of the first vertex at the position of v, before and after. `is_frozen` holds
/// for each triangle whether its vertices stand still. `transforms`, empty or one number per vertex, says who
/// may share a position: vertices with different numbers are not joined, and positions that have several
/// stay. The last `obstacle_triangles` triangles, which are frozen, are an obstacle's: their borders are none
/// to be sewn, and take nothing from the borders of the others where they lie along them. Distances are
/// compared after division by the scale.
///
/// **Preconditions** No triangle has two corners at one position. All triangles of offending pairs are
/// frozen. Throws `Argument_error` unless `distance` is finite and not negative; at 0 there is nothing to do.
///
/// **Exactness** Distances, which choose what is tried, are rounded to double; every judgement is exact.
///
/// **Complexity** O(n log n) for n triangles, and as many steps as there are pairs of border vertices within
/// `distance`, for each round; rounds are about as many as pieces that meet in one corner.
template <class FaceIndex = Packed_R_tree>
Snapping_notes snap_borders(Triangle_soup& soup, std::vector<Index>& positions,
                            const std::vector<char>& is_frozen, double distance,
                            const std::vector<Index>& transforms = {}, std::size_t obstacle_triangles = 0,
                            const Scale& scale = Scale());

/// Gives all vertices at one position one number, so that pieces that meet there hang together; vertices
/// whose attributes differ keep their own. Of several, the first stays; those no longer used are dropped.
///
/// Neither the triangles nor their order nor any coordinate changes, except that −0 may become 0. A soup that
/// is a glTF scene stays as it is: its vertices are rows of accessors.
Triangle_soup joined_at_positions(const Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_MESH_SNAPPING_H
