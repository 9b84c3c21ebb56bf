// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_H
#define SELVEDGE_VERIFY_H

#include <selvedge/mesh/Triangle_soup.h>

#include <cstddef>
#include <optional>
#include <vector>

// The judge: of any mesh by itself, or of a result against its original. It shares no code with the policies
// whose output it judges, and nothing with them but the definition of an embedded mesh and CGAL's predicates.

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
/// **Complexity.** O(n log n + k) in practice for n triangles of which k pairs have boxes that meet: for a
/// million triangles of layered cloth a second of one thread, and 110 bytes each.
/// **Threads.** As many as oneTBB grants: all cores, unless the caller lives in a `tbb::task_arena` or sets
/// `tbb::global_control`. The answer does not depend on them. So with everything here that takes long.
/// **Reference.** Guigue and Devillers, *Fast and robust triangle-triangle
/// overlap test using orientation predicates*, 2003 (CGAL's `do_intersect`).
std::vector<Offending_pair> offending_pairs(const Triangle_soup& soup);

/// Whether `offending_pairs` is empty; stops at the first.
bool is_embedded(const Triangle_soup& soup);

/// Those offending pairs of a result that its original does not have, in their order.
///
/// A pair is known by the exact positions of its two triangles, whatever their numbers, order and
/// orientation. What the result has more often than the original is new as often as it is more; the last of
/// them are named. Both lists are what `offending_pairs` says of the two soups.
std::vector<Offending_pair> new_pairs(const Triangle_soup& result,
                                      const std::vector<Offending_pair>& pairs_of_result,
                                      const Triangle_soup& original,
                                      const std::vector<Offending_pair>& pairs_of_original);

/// Triangles that hang together by the numbers of their vertices, counted.
///
/// A triangle that names a vertex twice has no inside; it belongs to no piece, and nothing here counts it.
/// Positions play no part: two sides of a seam with vertices of their own are two borders, even where they
/// coincide.
struct Piece
{
  Index first_triangle;
  std::size_t faces;
  std::size_t vertices;
  /// Edges of exactly one face.
  std::size_t border_edges;
  /// Edges of more than two faces.
  std::size_t non_manifold_edges;
  /// The closed lines that the border edges form. At a vertex a line goes on to the border edge at the other
  /// end of the same fan of faces, so lines that only touch at a vertex are told apart. Around an edge of
  /// three or more faces the fan branches, and all lines that end in it count as one.
  std::size_t boundary_loops;
  /// Vertices − edges + faces, each vertex counted once, even where several fans of faces meet in it.
  long euler_characteristic;
};

/// The pieces of a soup, in the order of their first triangles. **Complexity.** O(n log n).
std::vector<Piece> pieces(const Triangle_soup& soup);

/// How many pieces of one kind the original and the result have, where that differs.
struct Topology_difference
{
  std::size_t boundary_loops;
  long euler_characteristic;
  std::size_t pieces_of_original;
  std::size_t pieces_of_result;
};

/// What two meshes differ in by kinds of pieces, a kind being a number of boundary loops with an Euler
/// characteristic; empty when they have the same topology, as far as this tells.
///
/// **Not promised.** A file does not say which piece became which, so pieces that swapped their kinds pass.
/// Orientability is no part of a kind: a torus and a Klein bottle are alike.
std::vector<Topology_difference> topology_differences(const std::vector<Piece>& result,
                                                      const std::vector<Piece>& original);

/// How far the vertices of one mesh are from the surface of another.
struct Distance
{
  double root_mean_square;
  double maximum;
};

/// From every vertex of a triangle of `from` to the nearest point of the triangles of `to`, in the unit of
/// the coordinates. Zero when `from` has no triangle, infinite when only `to` has none.
///
/// What lies between vertices is not looked at: the maximum over the surface may be larger.
/// **Exactness.** Figures in double precision: a distance has an error of some 1e-15 of the largest
/// coordinate, and comes out too large, never too small, by what rounding does to needles. Neither overflow
/// nor underflow at any scale.
/// **Complexity.** O(log n) for each vertex in practice; 70 bytes per triangle of `to`.
Distance distance(const Triangle_soup& from, const Triangle_soup& to);

/// Distances both ways, as parts of the diagonal.
///
/// **Reference.** Derichs, Misiak and Fuhrmann, *Intersection-free mesh decimation for high resolution cloth
/// models*, whose measure is `original_to_result.root_mean_square`.
struct Distances
{
  Distance original_to_result;
  Distance result_to_original;
  /// Of the bounding box of the original's triangles, in the unit of the coordinates. Where it is zero, the
  /// distances are in that unit too.
  double diagonal;
};

Distances distances(const Triangle_soup& result, const Triangle_soup& original);

/// All that the judge has to say of a mesh, or of a result and its original.
struct Verification
{
  std::vector<Offending_pair> pairs;
  /// Those that the original does not have; all of them where no original was given.
  std::vector<Offending_pair> new_pairs;
  std::vector<Piece> pieces;
  /// These two stay empty where no original was given.
  std::vector<Topology_difference> topology_differences;
  std::optional<Distances> distances;

  bool embedded() const { return pairs.empty(); }
  bool same_topology() const { return topology_differences.empty(); }

  /// Nothing is wrong that was not wrong before.
  bool accepted() const { return new_pairs.empty() && same_topology(); }
};

Verification verify(const Triangle_soup& mesh);
Verification verify(const Triangle_soup& result, const Triangle_soup& original);

/// The same, for who knows the offending pairs of the original already.
Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const std::vector<Offending_pair>& pairs_of_original);

} // namespace selvedge

#endif // SELVEDGE_VERIFY_H
