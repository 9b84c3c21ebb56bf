// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_H
#define SELVEDGE_VERIFY_H

#include <selvedge/mesh/Triangle_soup.h>

#include <cstddef>
#include <optional>
#include <string>
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
/// **Not promised.** These are counts, so pieces that exchanged their kinds pass here; `match_pieces` sees
/// them. Orientability is no part of a kind: a torus and a Klein bottle are alike.
std::vector<Topology_difference> topology_differences(const std::vector<Piece>& result,
                                                      const std::vector<Piece>& original);

/// How a piece of a result was recognised as what became of a piece of the original.
enum class Matched_by {
  vertices,  ///< at least half of its vertices lie at vertices of that piece, and the kind is the same
  positions, ///< several pieces at once: joined where their positions coincide, they are of the same kinds
  borders,   ///< likewise, with borders within the weld distance joined; kinds are not compared
  distance   ///< of all pieces of the same kind it lies nearest
};

/// Pieces of the original, and those of the result that they became: one and one, unless they were matched by
/// positions or borders.
struct Piece_match
{
  std::vector<Index> of_original; ///< numbers of pieces of the original
  std::vector<Index> of_result;   ///< numbers of pieces of the result
  Matched_by by;

  /// The root mean square distance of the vertices of the one to the surface of the other, whichever way is
  /// larger, as a share of the diagonal of the bounding box of `of_original`.
  double distance = 0;
  /// The share of the area of `of_result` whose normal is more than 90° from that of the nearest face of
  /// `of_original`.
  double turned = 0;
};

/// What is wrong with pieces that should be those of the original.
enum class Mismatch {
  missing,  ///< a piece of the original has become no piece of the result
  added,    ///< a piece of the result has come from no piece of the original
  topology, ///< pieces lie where those of the original do, but are of other kinds
  name,     ///< faces have a group, object or material that the original has elsewhere, or a name is gone
  far,      ///< pieces are farther from those of the original than a quarter of their size
  turned    ///< inside is outside
};

struct Piece_mismatch
{
  Mismatch what;
  std::vector<Index> of_original; ///< numbers of pieces of the original
  std::vector<Index> of_result;   ///< numbers of pieces of the result
  std::string message; ///< one line for a person: which pieces, how many faces, where; counted from 1
};

/// Which piece of a result came from which piece of the original, one to one.
struct Piece_matching
{
  std::vector<Piece> pieces_of_original;
  std::vector<Piece_match> matches;
  std::vector<Piece_mismatch> mismatches;
  /// The kinds of names that were compared, of "group", "object" and "material".
  std::vector<std::string> names_compared;
  /// Those that could not be: only one mesh has them, or no name is common.
  std::vector<std::string> names_not_compared;

  bool is_complete() const { return mismatches.empty(); }
};

struct Verify_options
{
  /// Borders of the original within this distance of each other, or of a third, in the unit of the
  /// coordinates, may have been joined where a result does not keep pieces apart by vertex numbers. 0: only
  /// borders that coincide.
  double weld_distance = 0;

  /// Whether matched pieces may be `Mismatch::far` or `Mismatch::turned`, and have figures.
  bool are_shapes_judged = true;
};

/// Matches the pieces of a result with those of its original, one to one, in this order:
/// 1. by vertices: at least half of the positions of the one are positions of the other, and the kinds are
///    the same: boundary loops, Euler characteristic, and whether some edge has more than two faces. Of
///    several such, the one with most common positions, and of those one with the same names;
/// 2. by positions: what is left over, and all that has faces in common with it by positions, is joined where
///    positions coincide. Files that number vertices otherwise (STL, seams of textures in glTF) pass here;
/// 3. by distance, for results whose vertices are not the original's: pieces of one kind of which each is, up
///    to a factor of two, the nearest to the vertices of the other, and no farther from them than a quarter
///    of the size of the original's;
/// 4. by positions and distance together.
///
/// Where the coordinates of the result are 32-bit floats and those of the original are not, those of the
/// original are rounded for this. A piece without any triangle of three distinct positions is none.
///
/// Names (groups, objects, materials, each where both meshes have such and at least one name in common) are
/// judged by patches: triangles with common vertex numbers and one name. At least half of the triangles of a
/// patch must have their three corners at positions, or their centre nearest to a triangle of the matched
/// pieces, where the original has the same name or none; and no name of a matched piece may be gone. The
/// names of glTF primitives count without the numbers (`/0`, `#2`) that tell them apart.
///
/// **Not promised.** A piece may have lost a part at its border, or be another of the same kind whose
/// vertices are near: distances say how far. Positions where more than 64 pieces meet tell nothing.
/// **Exactness.** Positions are compared exactly, distances in floating point.
/// **Complexity.** O(n log n) in practice.
Piece_matching match_pieces(const Triangle_soup& result, const Triangle_soup& original,
                            const Verify_options& options = {});

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
  /// These stay empty where no original was given.
  std::vector<Topology_difference> topology_differences;
  Piece_matching matching;
  std::optional<Distances> distances;
  /// All of this is about an original rounded to 32-bit floats, as the result is.
  bool is_original_rounded = false;

  bool embedded() const { return pairs.empty(); }
  /// As many pieces of every kind, by vertex numbers.
  bool same_topology() const { return topology_differences.empty(); }

  /// Nothing is wrong that was not wrong before.
  bool accepted() const { return new_pairs.empty() && matching.is_complete(); }
};

Verification verify(const Triangle_soup& mesh);

/// When all coordinates of the result are 32-bit floats and those of the original are not, the original is
/// rounded first, so that what it had before it was written to a format that stores those is not taken for
/// new. Pairs that rounding itself makes are then not new either.
Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const Verify_options& options = {});

/// The same, for who knows the offending pairs of the original already.
Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const std::vector<Offending_pair>& pairs_of_original, const Verify_options& options = {});

} // namespace selvedge

#endif // SELVEDGE_VERIFY_H
