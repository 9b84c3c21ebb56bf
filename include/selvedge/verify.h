// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_H
#define SELVEDGE_VERIFY_H

#include <selvedge/Soup_collapse.h>
#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// The judge. It judges any mesh by itself, or a result against its original. With the policies whose output
// it judges it shares no code, only the definition of an embedded mesh and CGAL's predicates.

namespace selvedge {

/// A lower and an upper bound of a figure.
struct Bounds
{
  double lower = 0;
  double upper = 0;
};

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
  Index first = 0;
  Index second = 0;
  Offence offence = Offence::degenerate;
};

/// Describes a pair in words, with triangles counted from 1: those beyond `triangles` are of an obstacle.
std::string describe(const Offending_pair& pair, std::size_t triangles);

/// Returns all pairs that keep a soup from being embedded, sorted by `first`, then `second`; none when it is
/// embedded.
///
/// A soup is **embedded** when no triangle is degenerate, no two have the same positions, and any two meet
/// exactly in the simplex spanned by the positions that they share: nothing, a point, or an edge. A position
/// is a point, identified by its exact coordinates (−0 is 0), whatever the numbers of the vertices. All
/// pieces are judged together.
///
/// A degenerate triangle offends by itself. It is also judged against the others, as the segment or point
/// that it is and by the same rule: the common points must be those of the simplex that the shared positions
/// span. So a collinear triangle does not offend against the neighbours on its three edges, though the
/// neighbours offend against each other where its longest edge meets the two others. Whether a pair offends
/// depends on the positions of its two triangles alone, so the answer stays the same as long as neither
/// moves.
///
/// **Exactness.** Every decision is a sign of an exact predicate on input coordinates; nothing is rounded.
/// **Complexity.** O(n log n + k) in practice, for n triangles of which k pairs have boxes that meet. A
/// million triangles of layered cloth take one thread a second, and 110 bytes each.
/// **Threads.** As many as oneTBB grants: all cores, unless the caller runs in a `tbb::task_arena` or sets
/// `tbb::global_control`. The answer does not depend on them. The same holds for everything in this header
/// that takes long. `verify` judges several poses at once, and has no more of them in memory than threads.
/// **Reference.** Guigue and Devillers, *Fast and robust triangle-triangle overlap test using orientation
/// predicates*, 2003 (CGAL's `do_intersect`).
/// **Preconditions**, checked (`Argument_error`): coordinates are finite, and triangles name vertices that
/// there are; the thread rounds to the nearest, and keeps subnormal numbers.
std::vector<Offending_pair> offending_pairs(const Triangle_soup& soup);

/// Returns whether `offending_pairs` is empty. Stops at the first pair that it finds.
bool is_embedded(const Triangle_soup& soup);

/// Returns those offending pairs of a result that its original does not have, in their order.
///
/// A pair is identified by the exact positions of its two triangles, whatever their numbers, order and
/// orientation. When the result has a pair more often than the original, the surplus is new: the last of them
/// are returned. Both lists of pairs are what `offending_pairs` returns for the two soups.
std::vector<Offending_pair> new_pairs(const Triangle_soup& result,
                                      const std::vector<Offending_pair>& pairs_of_result,
                                      const Triangle_soup& original,
                                      const std::vector<Offending_pair>& pairs_of_original);

/// Returns those offending pairs of a result that descend from no offending pair of its original, in their
/// order, and all pairs of two triangles beyond the number that the original has: the last of them.
///
/// `collapses` lead from the original to the result. At first, every triangle of an offending pair descends
/// from itself alone. A collapse makes all triangles at the moving vertices that it leaves descend from all
/// that such triangles, left or removed, descended from. A pair descends from a pair of the original when one
/// of its triangles descends from one triangle of that pair, and the other from the other one. A degenerate
/// triangle descends only from itself, as long as no collapse changes it. Nothing else is used: the triangles
/// of the result must be where the collapses lead, or they descend from nothing.
///
/// `triangles_of_original` has, for every triangle of the result, that of the original which it was, with the
/// same corners first.
///
/// **Exactness.** Points are compared exactly. **Complexity.** O(n log n) for n triangles and collapses in
/// practice.
std::vector<Offending_pair> pairs_without_descent(const Triangle_soup& result,
                                                  const std::vector<Offending_pair>& pairs_of_result,
                                                  const Triangle_soup& original,
                                                  const std::vector<Offending_pair>& pairs_of_original,
                                                  const std::vector<Soup_collapse>& collapses,
                                                  const std::vector<Index>& triangles_of_original);

/// Counts of one piece: triangles that are connected by the numbers of their vertices.
///
/// A triangle with two corners at one position has no inside; it belongs to no piece, connects none, and is
/// not counted: a reduction leaves it out. Else positions play no part: two sides of a seam that have
/// vertices of their own are two borders, even when they coincide. Triangles with the same three vertices are
/// one face for all counts but `faces`.
struct Piece
{
  Index first_triangle = 0;
  std::size_t faces = 0;
  std::size_t vertices = 0;
  /// Edges of exactly one face.
  std::size_t border_edges = 0;
  /// Edges of more than two faces.
  std::size_t non_manifold_edges = 0;
  /// The number of closed lines that the border edges form. At a vertex, a line goes on to the border edge at
  /// the other end of the same fan of faces, so that lines that only touch at a vertex are separate. Around
  /// an edge of three or more faces the fan branches, and all lines that end in it count as one.
  std::size_t boundary_loops = 0;
  /// Vertices − edges + faces, each vertex counted once, even where several fans of faces meet in it.
  long euler_characteristic = 0;
};

/// Returns the pieces of a soup, in the order of their first triangles. **Complexity.** O(n log n).
std::vector<Piece> pieces(const Triangle_soup& soup);

/// A kind of which original and result have different numbers of pieces.
struct Topology_difference
{
  std::size_t boundary_loops = 0;
  long euler_characteristic = 0;
  std::size_t pieces_of_original = 0;
  std::size_t pieces_of_result = 0;
};

/// Returns all kinds of which two meshes have different numbers of pieces. A kind is a number of boundary
/// loops together with an Euler characteristic. When there are none, the meshes have the same topology, as
/// far as these counts show.
///
/// **Not promised.** Pieces that have exchanged their kinds are not noticed, because only counts are
/// compared; `match_pieces` notices them. Orientability is no part of a kind: a torus and a Klein bottle are
/// alike.
std::vector<Topology_difference> topology_differences(const std::vector<Piece>& result,
                                                      const std::vector<Piece>& original);

/// How a piece of a result was matched with a piece of the original.
enum class Matched_by {
  vertices,  ///< at least half of its vertices lie at vertices of that piece, and the kind is the same
  positions, ///< several pieces at once: joined where their positions coincide, they are of the same kinds
  borders,   ///< likewise, with borders within the weld distance joined; kinds are not compared. Or it alone,
             ///< with all of its vertices within that distance of a piece of the same kind
  distance,  ///< of all pieces of the same kind, it lies nearest; or its vertices are next to those of that
             ///< piece
  triangles  ///< its triangles are those of that piece, as the caller says, and the kind is the same
};

/// Pieces of the original, and the pieces of the result that they became: one of each, unless they were
/// matched by positions or borders.
struct Piece_match
{
  std::vector<Index> of_original; ///< numbers of pieces of the original
  std::vector<Index> of_result;   ///< numbers of pieces of the result
  Matched_by by = Matched_by::vertices;

  /// The root mean square distance from the vertices of one side to the surface of the other, in the
  /// direction in which it is larger, as a share of the diagonal of the bounding box of `of_original`.
  double distance = 0;
  /// The share of the area of `of_result` whose normal is more than 104° from that of the nearest face of
  /// `of_original`, where no face as near is on the same side.
  double turned = 0;
};

/// What is wrong with pieces that should be those of the original.
enum class Mismatch {
  missing,  ///< a piece of the original has become no piece of the result
  added,    ///< a piece of the result has come from no piece of the original
  topology, ///< pieces lie where those of the original do, but are of other kinds
  name,     ///< faces have a group, object or material that the original has elsewhere, or a name is gone
  far,   ///< pieces are farther from those of the original than a quarter of their size, and than 1 % of the
         ///< whole diagonal or without a vertex of the original's pieces
  turned ///< nine tenths of the area face the other way, no border runs as it did, and the sides of the piece
         ///< are not nearer to each other than the pieces are
};

/// Pieces that do not match.
struct Piece_mismatch
{
  Mismatch what = Mismatch::missing;
  std::vector<Index> of_original; ///< numbers of pieces of the original
  std::vector<Index> of_result;   ///< numbers of pieces of the result
  std::string message; ///< one line for a person: which pieces, how many faces, where; counted from 1
};

/// The result of `match_pieces`: which piece of a result came from which piece of the original.
struct Piece_matching
{
  std::vector<Piece> pieces_of_original, pieces_of_result;
  std::vector<Piece_match> matches;
  std::vector<Piece_mismatch> mismatches;
  /// The kinds of names that were compared, of "group", "object" and "material".
  std::vector<std::string> names_compared;
  /// The kinds that could not be compared: only one mesh has them, or the two have no name in common.
  std::vector<std::string> names_not_compared;

  bool is_complete() const { return mismatches.empty(); }
};

/// Two pieces that are nearer to each other than a clearance. Here, pieces are connected by positions; as in
/// `Piece`, a triangle with two corners at one position belongs to none.
struct Near_pieces
{
  Index first = 0;          ///< the first triangle of one, in the result
  Index second = 0;         ///< the first triangle of the other
  Bounds now;               ///< of their least distance in the result
  Bounds before{};          ///< likewise in the original; both 0 when there is none
  bool is_too_near = false; ///< nearer than the clearance and, when there is an original, than in that
};

/// What `verify` finds when it is asked about a clearance. Lengths are in the unit of the coordinates, and
/// bounds are certified.
struct Clearance_verdict
{
  double clearance = 0;

  /// All pairs of pieces of the result that are nearer than the clearance, the nearest first.
  std::vector<Near_pieces> near;

  /// Of the distances of any two pieces, the least; infinite when there is one piece only.
  Bounds least{};
  std::optional<Bounds> least_of_original;

  /// Returns how many of `near` are too near.
  std::size_t too_near() const
  {
    return std::size_t(
        std::count_if(near.begin(), near.end(), [](const Near_pieces& pair) { return pair.is_too_near; }));
  }
};

/// The options of `match_pieces` and `verify`.
struct Verify_options
{
  /// The distance, in the unit of the coordinates, within which borders of the original may have been joined,
  /// directly or through a third border. It matters when a result does not keep pieces apart by vertex
  /// numbers. At 0, only coincident borders may have been joined.
  double weld_distance = 0;

  /// Whether `distance` and `turned` of matched pieces are computed, and judged as `Mismatch::far` and
  /// `Mismatch::turned`.
  bool are_shapes_judged = true;

  /// Whether a result that has 32-bit floats alone may have been rounded to them, so that the original is
  /// rounded for the comparison if it has other coordinates. A result that is known not to have been rounded
  /// may have such vertices by chance.
  bool may_be_rounded = true;

  /// For every triangle of the result, the triangle of the original that it was, when the caller knows: as
  /// `Simplified_soup::triangles` says. Empty when nobody does. `Argument_error` is thrown for a list of
  /// another length, or with a number that the original does not have.
  std::vector<Index> triangles_of_original;

  /// For every triangle of the result, its vertices as the file numbers them that it was read from, where
  /// some have been made one since (`share_vertices_without_normals`). They show pieces that lie on others.
  /// Empty when there is nothing to say. `Argument_error` is thrown for a list of another length, or with a
  /// vertex that the result does not have or has elsewhere.
  std::vector<Index_triple> triangles_in_file;

  /// The collapses that led from the original to the result, when its pairs were allowed to descend from
  /// those of the original: then `Verification::new_pairs` are `pairs_without_descent`. It needs
  /// `triangles_of_original`. Null when all pairs had to stay as they were.
  const std::vector<Soup_collapse>* collapses = nullptr;

  /// The offending pairs of the original in each of its further poses, when the caller knows them.
  const std::vector<std::vector<Offending_pair>>* pairs_in_poses_of_original = nullptr;

  /// Pairs of parts, by the names of groups, objects or materials (`triangles_named`), that may intersect
  /// each other. Pairs of triangles between them are left out of all lists and counted apart. A pair of the
  /// result is left out by the names of its triangles, and by those of `triangles_of_original` too where
  /// these are given. A name that no triangle has leaves out nothing.
  std::vector<std::pair<std::string, std::string>> may_intersect;

  /// A distance, in the unit of the coordinates, that pieces keep from each other in every pose: no two are
  /// nearer than this, or, where an original is given, than they are there. Pieces are connected by positions
  /// in the original, or in the mesh itself; `Piece_matching` says which of the result became of which. An
  /// obstacle has pieces of its own, and connects no others. Positive and finite; not judged by default, and
  /// not together with parts that may intersect.
  std::optional<double> clearance;
};

/// Matches the pieces of a result with those of its original, in these steps:
/// 1. By vertices: at least half of the positions of the piece of the result are positions of the piece of
///    the original, and both are of the same kind: in boundary loops, Euler characteristic, and whether some
///    edge has more than two faces. Among several such pieces, the one with the most common positions is
///    taken, and among those one with which it differs in the fewest names, and then one that is neither far
///    from it nor turned (`Mismatch`), if shapes are judged.
///    Where `Verify_options::triangles_of_original` is given: then, by triangles, each piece whose triangles
///    were all of one piece of the original, of the same kind, which no other piece comes from and no step
///    has matched. (If all steps together leave fewer mismatches so, this one comes first.) Where
///    `Verify_options::weld_distance` is: then, by borders, pieces of one kind, all of whose vertices are
///    within that length of the piece of the original, by the fewest different names, where all that are left
///    there go up one to one.
///    Then, by distance, likewise where the coordinates of the result were written with few digits: a vertex
///    counts as one at the position of the original that it is clearly next to, no farther than 3e-6 of the
///    diagonal of the original, with every other position at least ten times as far.
/// 2. By positions: the pieces that are left over, and all pieces that have faces in common with them by
///    positions, are joined where positions coincide. Files that number vertices in another way (STL, texture
///    seams in glTF) are matched here. Each piece of the original must show: some triangle of the result has
///    corners of no other piece, or is one of its triangles and there as often as in the original; or what it
///    is joined to would be of another kind without it, as a patch within a surface leaves a hole; positions
///    that the weld distance joins are one for this. A notch in a border that such a piece fills may be called
///    missing. Where `Verify_options::triangles_in_file` is given, these pieces show as well if the file has a
///    piece for each of them, of the same kind and names and with no position that is not theirs, which no
///    other piece of the original needs and without which the rest is of the same kinds as theirs is.
/// 3. By distance, for results whose vertices are not the original's: two pieces of one kind, each of which
///    is, up to a factor of two, the nearest to the vertices of the other, and no farther from them than a
///    quarter of the size of the piece of the original.
/// 4. By positions and distance together; a vertex that is clearly next to a position counts as there.
///
/// When the coordinates of the result are 32-bit floats and those of the original are not, those of the
/// original are rounded for this, unless `may_be_rounded` is false.
///
/// Names (groups, objects, materials, each if both meshes have such and at least one name in common) are
/// judged by patches. A patch is a set of triangles with one name that are connected by vertex numbers. At
/// least half of its triangles must lie where the original has the same name or none: their three corners are
/// at positions of such triangles, or their centre is nearest to such a triangle among those of the matched
/// pieces. Or the patch as a whole is most like one of the same name: by the root mean square distance from
/// the vertices of one to the surface of the other, in the direction in which it is larger. No name of a
/// matched piece may be gone. The names of glTF primitives count without the numbers
/// (`/0`, `#2`) that distinguish them.
///
/// **Not promised.** A piece may have lost a part at its border, or be another piece of the same kind whose
/// vertices are near; distances tell how far. Positions where more than 64 pieces meet are ignored.
/// **Exactness.** Positions are compared exactly, distances in floating point.
/// **Complexity.** O(n log n) in practice.
Piece_matching match_pieces(const Triangle_soup& result, const Triangle_soup& original,
                            const Verify_options& options = {});

/// How far the vertices of one mesh are from the surface of another.
struct Distance
{
  double root_mean_square = 0;
  double maximum = 0;
  Index farthest = 0; ///< a vertex that has the largest distance
};

/// Returns the distance from the vertices of the triangles of `from` to the nearest points of the triangles
/// of `to`, in the unit of the coordinates. Zero when `from` has no triangle, infinite when only `to` has
/// none.
///
/// Points between vertices are not looked at: the maximum over the surface may be larger (see
/// `maximum_distance` in compare.h).
/// **Exactness.** Double precision: a distance has an error of some 1e-15 of the largest coordinate. Near
/// needle-shaped triangles, rounding makes distances too large, never too small. Nothing overflows or
/// underflows at any scale.
/// **Complexity.** O(log n) for each vertex in practice; 70 bytes per triangle of `to`.
Distance distance(const Triangle_soup& from, const Triangle_soup& to);

/// Returns these distances one by one, for every vertex of `from`; 0 for vertices that no triangle uses.
std::vector<double> vertex_distances(const Triangle_soup& from, const Triangle_soup& to);

/// Distances in both directions, as shares of the diagonal.
///
/// **Reference.** Derichs, Misiak and Fuhrmann, *Intersection-free mesh decimation for high resolution cloth
/// models*, whose measure is `original_to_result.root_mean_square`.
struct Distances
{
  Distance original_to_result;
  Distance result_to_original;
  /// The diagonal of the bounding box of the original's triangles, in the unit of the coordinates; infinite
  /// when it is too long for a double. When it is zero, the distances are in that unit, too.
  double diagonal = 0;
};

Distances distances(const Triangle_soup& result, const Triangle_soup& original);

/// The verdict on a mesh, or on a result and its original.
struct Verification
{
  std::vector<Offending_pair> pairs;
  /// How many the original has; none when no original was given.
  std::size_t pairs_of_original = 0;
  /// The pairs that the original does not have, or, where pairs could descend, those that descend from none
  /// of the original; all pairs when no original was given.
  std::vector<Offending_pair> new_pairs;
  std::vector<Piece> pieces;
  /// How pieces differ from those of the original. It and the next two stay empty when none was given.
  std::vector<Topology_difference> topology_differences;
  Piece_matching matching;
  std::optional<Distances> distances;
  /// Whether the original was rounded to 32-bit floats, as the result is, before all of this.
  bool is_original_rounded = false;
  /// For each of `Verify_options::may_intersect`, how many pairs were left out. A pair that several of them
  /// name counts for the first.
  struct Permitted
  {
    std::string first, second; ///< the names of the two parts
    std::size_t pairs = 0;
    std::size_t pairs_of_original = 0;
  };
  std::vector<Permitted> permitted;
  std::optional<Clearance_verdict> clearance; ///< if `Verify_options::clearance` asks for it

  /// The verdict on a further pose: as `pairs`, `pairs_of_original` and `new_pairs` are on the first.
  struct In_pose
  {
    std::string name;
    std::vector<Offending_pair> pairs;
    std::size_t pairs_of_original = 0;
    std::vector<Offending_pair> new_pairs;
    std::optional<Clearance_verdict> clearance;
  };
  std::vector<In_pose> poses; ///< in the order of `Triangle_soup::poses`

  bool embedded() const
  {
    return pairs.empty() &&
           std::all_of(poses.begin(), poses.end(), [](const In_pose& pose) { return pose.pairs.empty(); });
  }
  /// Returns whether both have the same number of pieces of every kind, by vertex numbers.
  bool same_topology() const { return topology_differences.empty(); }

  /// Returns whether no two pieces are too near, in any pose. They are not when no clearance was asked for.
  bool is_clearance_kept() const
  {
    const auto is_kept = [](const std::optional<Clearance_verdict>& verdict) {
      return !verdict || verdict->too_near() == 0;
    };
    return is_kept(clearance) && std::all_of(poses.begin(), poses.end(),
                                             [&](const In_pose& pose) { return is_kept(pose.clearance); });
  }

  /// Returns whether nothing is wrong that was not wrong before.
  bool accepted() const
  {
    return new_pairs.empty() && matching.is_complete() && is_clearance_kept() &&
           std::all_of(poses.begin(), poses.end(),
                       [](const In_pose& pose) { return pose.new_pairs.empty(); });
  }
};

/// Returns whether of two triangles one belongs to the first of two parts and the other to the second. A
/// triangle of both parts counts for neither: no part may intersect itself. `first` and `second` say of every
/// triangle whether it belongs to the part; triangles with further numbers, such as those of an obstacle,
/// belong to neither.
bool are_between(const std::vector<char>& first, const std::vector<char>& second, Index a, Index b);

/// Takes the pairs between two parts out of a list of offending pairs. Returns how many there were. The parts
/// are those of `are_between`.
std::size_t take_out_pairs_between(const std::vector<char>& first, const std::vector<char>& second,
                                   std::vector<Offending_pair>& pairs);

/// Judges a mesh by itself: finds its offending pairs, in every pose, and its pieces. Of the options it takes
/// `may_intersect` and `clearance`.
///
/// An `obstacle`, such as the body in a garment, lies beside the mesh, in as many poses as that or in one for
/// all. Pairs of a triangle of the mesh and one of the obstacle then count as well; triangles of the obstacle
/// are numbered after those of the mesh. The obstacle is not judged itself, and is one piece.
Verification verify(const Triangle_soup& mesh, const Verify_options& options = {},
                    const Triangle_soup& obstacle = {});

/// Judges a result against its original. A result in several poses is judged in each: its further poses are
/// those of the original, in the same order, or `Argument_error` is thrown. Pieces, topology and distances
/// are those of the first pose. `obstacle` lies beside both, as above.
///
/// When all coordinates of the result are 32-bit floats and those of the original are not, the original is
/// rounded first. So offending pairs that the original has already are recognised after the result was
/// written to a format that stores 32-bit floats. Pairs that rounding itself makes do not count as new
/// either.
Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const Verify_options& options = {}, const Triangle_soup& obstacle = {});

/// Judges a result against its original, whose offending pairs the caller knows already. The original is not
/// rounded.
///
/// `obstacle` lies beside both. Offending pairs are then those of each mesh together with the obstacle, whose
/// triangles are numbered after those of the mesh; pieces, topology and distances are those of the mesh
/// alone.
Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const std::vector<Offending_pair>& pairs_of_original, const Verify_options& options = {},
                    const Triangle_soup& obstacle = {});

} // namespace selvedge

#endif // SELVEDGE_VERIFY_H
