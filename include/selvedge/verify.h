// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_H
#define SELVEDGE_VERIFY_H

#include <selvedge/mesh/Triangle_soup.h>

#include <vector>

namespace selvedge {

/// What is wrong with a triangle or a pair of them.
enum class Offence {
  degenerate,  ///< fewer than three distinct positions, or three collinear ones
  duplicate,   ///< two triangles with the same set of positions, in whatever order
  intersection ///< two triangles that meet anywhere beyond the positions that they share
};

/// Two triangles of a soup that keep it from being embedded; `first < second`, or `first == second` for a
/// degenerate triangle.
struct Offending_pair
{
  Index first;
  Index second;
  Offence offence;
};

/// All that keeps a soup from being embedded, sorted by `first`, then `second`; empty when it is.
///
/// A soup is **embedded** when no triangle is degenerate, no two have the same positions, and any two meet
/// exactly in the simplex spanned by the positions that they share: nothing, a point, or an edge. Positions
/// are points by their exact coordinates (−0 is 0), whatever the numbers of the vertices; all pieces are
/// judged together.
///
/// A degenerate triangle offends by itself, and is also judged against the others as the segment or point
/// that it is, by the same rule: the common points must be those of the simplex that the shared positions
/// span. So a collinear triangle does not offend against the neighbours on its three edges, though the
/// neighbours offend against each other where its longest edge meets the two others. Whether a pair offends
/// depends on the positions of its two triangles alone: as long as both stand still, so does the verdict.
///
/// **Exactness.** Every decision is a sign of an exact predicate on input coordinates; nothing is rounded.
/// **Complexity.** O(n log³ n + k) for n triangles of which k pairs have boxes that meet, n log n in
/// practice; about 100 bytes a triangle.
/// **Reference.** Boxes: Zomorodian and Edelsbrunner, *Fast software for box intersections*, 2000
/// (CGAL's `box_self_intersection_d`). Triangles: Guigue and Devillers, *Fast and robust triangle-triangle
/// overlap test using orientation predicates*, 2003 (CGAL's `do_intersect`).
std::vector<Offending_pair> offending_pairs(const Triangle_soup& soup);

/// Whether `offending_pairs` is empty; stops at the first.
bool is_embedded(const Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_VERIFY_H
