// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_COMPARE_H
#define SELVEDGE_COMPARE_H

#include <selvedge/verify.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// Compares a result with its original, without knowing how the one became the other. Any program may have
// made the result; its vertices may have any numbers, and lie anywhere. All figures are floating point, and
// deterministic; only `Layer_swap` rests on exact arithmetic. Unless stated otherwise, lengths are shares of
// the diagonal of the bounding box of the original's triangles; when the diagonal is zero, they are in the
// unit of the coordinates. Further poses are compared where it says so, and otherwise only the first.

namespace selvedge {

/// Returns bounds of the largest distance from any point of the triangles of `from` to the nearest point of
/// the triangles of `to`, in the unit of the coordinates.
///
/// Given the bounds of other pairs of meshes, such as these two in another pose, it returns bounds of the
/// largest distance of them all, and looks for no point that is nearer than one known already.
///
/// **Guarantees** `lower` is the distance of a point that was looked at. `upper` exceeds `lower` by at most a
/// hundredth of it, or by a millionth of the longest side of the bounding box of `from` when that is more.
/// When `from.triangles.size() + 500'000` points do not suffice for this (or fewer, where the search for the
/// nearest triangle meets thousands), `upper` is the best bound that is known. Both are zero when `from` has
/// no triangle, and infinite when only `to` has none.
/// **Exactness** Both bounds have the errors of `distance`.
/// **Complexity** O(log n) for each vertex, and linear in the pairs of triangles that lie above each other.
/// **Reference** The distance to one triangle is a convex function, so its maximum over a triangle is at a
/// corner. A triangle for which no single triangle of `to` gives a good enough bound is divided by the edges
/// of `to` above it, projected onto its plane, and where this does not suffice, at points for which the
/// nearest triangle is sought. After Tang, Lee and Kim, *Interactive Hausdorff distance computation for
/// general polygonal models*, 2009.
Bounds maximum_distance(const Triangle_soup& from, const Triangle_soup& to, const Bounds& of_others = {0, 0});

/// Returns whether some point of `from` is farther from `to` than a share of the diagonal of `to` (at least
/// 0), as far as `maximum_distance` knows. It takes less time, for what is nearer is not looked at.
bool is_farther(const Triangle_soup& from, const Triangle_soup& to, double share);

/// Bounds of the largest distance of all poses, and the further pose in which the farthest point that was
/// looked at is so far; none for the first pose.
struct Bounds_over_poses : Bounds
{
  std::optional<std::size_t> pose = {};
};

/// Bounds of the largest distance from any point of one mesh to the other in any pose, both ways, as shares
/// of the diagonal of the original in its first pose.
struct Distances_anywhere
{
  Bounds_over_poses original_to_result = {};
  Bounds_over_poses result_to_original = {};

  const Bounds_over_poses& larger() const
  {
    return original_to_result.upper < result_to_original.upper ? result_to_original : original_to_result;
  }
};

/// Bounds the distances of two meshes anywhere, by `maximum_distance`. Throws `Argument_error` unless both
/// meshes have the same number of further poses; so does `compare`.
Distances_anywhere distances_anywhere(const Triangle_soup& result, const Triangle_soup& original);

/// How far the lines of one mesh are from those of the other.
struct Line_distance
{
  Distance of_ends; ///< at the ends of their edges
  Bounds maximum;   ///< anywhere on them
};

/// Compares the lines of one kind in both meshes. Lines are edges, identified by the positions of their ends;
/// vertex numbers play no part.
struct Line_comparison
{
  std::size_t edges_of_original = 0;
  std::size_t edges_of_result = 0;
  /// Zero when the mesh named first has no lines, infinite when only the other has none.
  Line_distance original_to_result = {};
  Line_distance result_to_original = {};
};

/// How far seams have opened.
///
/// A border edge of the result is *open* when its ends, taken together, are nearer to a seam of the original
/// than to a border of it. When they are equally near to both, the middle of the edge decides.
struct Gaps
{
  std::size_t open_edges = 0;
  double length = 0; ///< of all open edges together
  /// The largest distance from the middle of an open edge to the nearest open edge that has its face on the
  /// other side. For a gap that narrows towards its ends, this is about half of its width. Zero when there is
  /// no edge on the other side.
  double width = 0;
};

/// How much of an attribute that both meshes have comes from the original.
///
/// A *combination* is a position and a value of the attribute there; for smoothing groups and for attributes
/// of triangles it is a value alone. The combinations of the result are looked up among those of the
/// original, bit for bit. In positions, texture coordinates and normals, −0 is 0. Where the result is a glTF
/// scene and the original is none, texture coordinates are compared as glTF stores them, in 32-bit floats.
/// Colours of different types are compared as the coarser of these holds them: fractions as numbers up to 255
/// where the other mesh has such, and doubles as 32-bit floats.
struct Kept_attribute
{
  /// "uv", "normal", "group", "object", "material", "smoothing group", or the name in the file.
  std::string name;
  std::size_t combinations = 0;  ///< of the result, each counted once
  std::size_t original = 0;      ///< how many of them the original has
  std::size_t at_new_places = 0; ///< how many have a position at which the original has no value at all
};

/// Angles between the faces of the result and those of the original that lie nearest, in degrees.
///
/// Points are spread over the faces of the result, at least one on each. For each point, the nearest face of
/// the original is looked for among those that are turned by less than 90° from the face of the result, up to
/// the largest distance of either mesh from the other. (In layered cloth, and in cloth that has two sides,
/// the nearest face of all often belongs to another layer or to the other side.) When there is no such face,
/// the nearest of all is taken, and the point counts as *turned*.
struct Normal_deviation
{
  std::size_t samples = 0;
  double mean = 0;             ///< weighted by area
  double root_mean_square = 0; ///< weighted by area
  double maximum = 0;
  double turned = 0; ///< share of the area that is turned
};

/// Two layers that a line crosses in one order in the original, and in the other order in the result. Both
/// orders are decided exactly. What is not exact is the decision which triangle of the result belongs to
/// which layer.
struct Layer_swap
{
  /// Of the original, in the unit of its coordinates, through which the line was drawn.
  Point_3 point{0, 0, 0};
  std::array<Index, 2> of_original = {}; ///< the triangle of each layer that the line crosses, in their order
  std::array<Index, 2> of_result = {};   ///< the triangle of each of the same layers
};

/// Tells whether layers have kept their order, as far as lines through them show it.
///
/// *Lines* are drawn along the normals of the original's faces. There is a line through one point of each
/// face; through several when faces are few; and through fewer faces, evenly chosen, when there are more than
/// 200,000 or lines take long. To both sides, a line reaches two and a half times as far as any point of one
/// mesh is from the other, and at most a quarter of the diagonal: two layers that lie farther apart have not
/// changed places.
///
/// Every crossing of a line with the original is a *layer*, whether it belongs to another piece or to another
/// part of a folded piece; so the two legs of a fold are two layers. A triangle of the result belongs to the
/// layer from which its three corners are reached with the fewest edges of the original, when this is the
/// same layer for all three. For a corner that is no vertex of the original, the nearest vertex is taken.
///
/// Two layers are *compared* when the line crosses each of them once in both meshes: from the same side, at
/// no more than 60° from their normals, and no farther from the crossing in the original than twice the
/// largest distance. (The last condition is for a layer that bends round the end of another: a line may cross
/// it on one side of that end in the original, and on the other side in the result, though nothing has passed
/// through.)
///
/// **What it sees.** Layers that are in another order than before at a line: one mesh that has passed through
/// another and stays there, embedded or not.
/// **What it cannot see.** What passed through and returned. Passages smaller than the distance between
/// lines. A layer that is crossed in one mesh only, because it ends there or its border has drawn back.
/// Layers whose triangles cannot be assigned, as right at the bend of a fold. `compared` counts the pairs of
/// layers that could be judged; a swap can be seen only among these. A log shows everything: see replay.h.
/// **What may deceive it.** Layers that bend more sharply than they lie apart, as above, at high reductions.
/// When the vertices of a result are not those of the original, the nearest vertex may belong to another
/// layer.
struct Layer_order
{
  std::size_t lines = 0;          ///< lines drawn
  std::size_t crossing = 0;       ///< lines that cross two layers or more of the original
  std::size_t pairs = 0;          ///< pairs of neighbouring layers on these lines
  std::size_t compared = 0;       ///< pairs of layers that could be found in the result
  std::size_t lines_compared = 0; ///< lines on which these pairs lie
  double reach = 0;               ///< of a line to both sides, in the unit of the coordinates
  std::vector<Layer_swap> swaps;
  std::size_t without_order = 0; ///< swaps that `leave_out_without_order` has left out
};

/// Leaves out the swaps of layers that have no order: where the same two surfaces of the original, connected
/// by positions, intersect near both triangles of the result, no farther from the box of each than its
/// longest side and the reach of a line together. There, either may come to lie on either side.
/// `pairs_of_original` are the `offending_pairs` of the original.
///
/// **Complexity** O(n + p log p + s p) for n triangles, p pairs and s swaps.
void leave_out_without_order(Layer_order& layers, const Triangle_soup& result, const Triangle_soup& original,
                             const std::vector<Offending_pair>& pairs_of_original);

/// All figures of a comparison.
struct Comparison
{
  double diagonal = 0; ///< in the unit of the coordinates; infinite when it is too long for a double
  Distances_anywhere distances;

  /// Edges of one triangle.
  Line_comparison borders;
  /// Edges of several, across which a vertex number, texture coordinate, group, object or material changes.
  Line_comparison seams;
  Gaps gaps;

  std::size_t vertices = 0;          ///< positions of the result's triangles
  std::size_t original_vertices = 0; ///< how many of them the original's triangles have, bit for bit
  std::vector<Kept_attribute> attributes;
  std::vector<std::string> lost_attributes; ///< names of the attributes that only the original has

  Normal_deviation normals;
  Layer_order layers;

  /// Returns `original_vertices` as a share of `vertices`; 1 for a result without vertices.
  double share_of_original_vertices() const
  {
    return vertices == 0 ? 1 : static_cast<double>(original_vertices) / static_cast<double>(vertices);
  }
};

/// Computes all of the above. **Complexity.** O(n log n) in practice, some seconds for a million
/// triangles.
Comparison compare(const Triangle_soup& result, const Triangle_soup& original);

/// What `selvedge verify` says of a mesh: the verdict and, where there is an original, the comparison with
/// it.
struct Judgement
{
  Verification verification;
  std::optional<Comparison> comparison;

  /// Returns whether nothing is wrong that was not wrong before, and no layers have changed places.
  bool is_accepted() const
  {
    return verification.accepted() && (!comparison || comparison->layers.swaps.empty());
  }
};

/// Judges a result against its original by `verify`, and compares the two by `compare`. An original that was
/// rounded for the one is rounded for the other. Layers that changed places are left out where they may
/// intersect each other (`Verify_options::may_intersect`; every name must then be one of the result,
/// see `triangles_named`), and where they have no order (`leave_out_without_order`).
Judgement judge(const Triangle_soup& result, const Triangle_soup& original,
                const Verify_options& options = {}, const Triangle_soup& obstacle = {});

} // namespace selvedge

#endif // SELVEDGE_COMPARE_H
