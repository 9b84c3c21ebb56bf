// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_COMPARE_H
#define SELVEDGE_COMPARE_H

#include <selvedge/verify.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// What can be said of a result and its original when nobody says how the one became the other. Any program
// may have made the result; vertices may have any numbers, and any place. All figures are floating point, and
// deterministic; `Layer_swap` alone rests on exact predicates. All lengths are shares of the diagonal of the
// bounding box of the original's triangles, or lengths where that is zero.

namespace selvedge {

/// What a figure is at least and at most.
struct Bounds
{
  double lower;
  double upper;
};

/// The largest distance of any point of the triangles of `from` to the nearest point of those of `to`, in the
/// unit of the coordinates.
///
/// **Guarantees** `lower` is the distance of a point that was looked at. `upper` is no more than `lower` and
/// a hundredth of it, or a millionth of the longest side of the bounding box of `from`, unless
/// `from.triangles.size() + 500'000` points do not suffice: then it is the best that is known. Zero when
/// `from` has no triangle, infinite when only `to` has none.
/// **Exactness** Both bounds have the errors of `distance`.
/// **Complexity** O(log n) for each point in practice, of which there are some more than vertices.
/// **Reference** The distance to one triangle is a convex function, so over a triangle its maximum is at a
/// corner; triangles for which no one triangle of `to` gives a bound that is good enough are divided. After
/// Tang, Lee and Kim, *Interactive Hausdorff distance computation for general polygonal models*, 2009.
Bounds maximum_distance(const Triangle_soup& from, const Triangle_soup& to);

/// How far the lines of one mesh are from those of the other: at the ends of their edges, and anywhere on
/// them.
struct Line_distance
{
  Distance of_ends;
  Bounds maximum;
};

/// Lines of one kind. They are edges by position: what vertices are called plays no part.
struct Line_comparison
{
  std::size_t edges_of_original = 0;
  std::size_t edges_of_result = 0;
  /// Zero where the one has no lines, infinite where only the other has none.
  Line_distance original_to_result = {};
  Line_distance result_to_original = {};
};

/// Where a seam has opened.
///
/// An edge of the result's border is *open* when its ends are nearer to a seam of the original than to its
/// border, or, when they are equally near to both, its middle is.
struct Gaps
{
  std::size_t open_edges = 0;
  double length = 0; ///< of all open edges together
  /// The largest distance from the middle of an open edge to the nearest open edge with its face on the other
  /// side; for a gap that narrows towards its ends, about half of its width. Zero where nothing lies on the
  /// other side.
  double width = 0;
};

/// Of an attribute that both meshes have: how many of the result's combinations of a position and a value at
/// it the original has, bit for bit (−0 is 0).
///
/// For smoothing groups and for attributes of triangles a combination is a value alone.
struct Kept_attribute
{
  /// "uv", "normal", "group", "object", "material", "smoothing group"; else as in the file.
  std::string name;
  std::size_t combinations = 0;
  std::size_t original = 0; ///< those that the original has
};

/// Angles between the faces of the result and those of the original that lie nearest, in degrees.
///
/// Points are spread over the faces of the result, at least one on each. The nearest point of the original is
/// looked for among faces turned less than 90° from that of the result, within the largest distance of either
/// mesh from the other: in layered cloth, and cloth that has two sides, the very nearest is often another
/// layer or the other side. Only where there is none, the very nearest counts, and the point is *turned*.
struct Normal_deviation
{
  std::size_t samples = 0;
  double mean = 0; ///< weighted by area, as the next
  double root_mean_square = 0;
  double maximum = 0;
  double turned = 0; ///< share of the area
};

/// A line that crosses two layers in one order in the original and in the other in the result, both decided
/// exactly. What is not exact is which triangle of the result is what became of which of the original.
struct Layer_swap
{
  Point_3 point; ///< of the original, in its unit, where the line was drawn
  std::array<Index, 2> of_original;
  std::array<Index, 2> of_result;
};

/// Whether layers have kept their order, as far as lines through them tell.
///
/// Lines are drawn along the normals of the original's faces, through one point of each face, more where
/// faces are few, and fewer than one per face, evenly chosen, where there are more than 200,000 or a line
/// takes long. They reach two and a half
/// times as far as any point of one mesh is from the other (at most a quarter of the diagonal) to both
/// sides: two layers farther apart have not changed places. Every crossing with the original is a *layer*, of
/// whatever piece, or part of a folded piece; so two legs of one fold are two layers. A triangle of the
/// result belongs to the layer from which its three corners are reached first over the original's edges, when
/// that is one and the same for all three. A corner that is no vertex of the original is stood in for by the
/// nearest. Two layers are compared when the line crosses each of them exactly once in both meshes, from
/// the same side, at less than 60° from their normals, and not farther from where it did than twice the
/// largest distance: where a layer bends round the end of another, a line may cross it first on this side of
/// the end, then on that, though nothing has passed through.
///
/// **What it sees.** Layers that are in another order than before at a line: one mesh that has passed through
/// another and stays there, embedded or not.
/// **What it cannot see.** What passed through and returned. Passages smaller than the distance of lines. A
/// layer that is crossed on one side only, since it ends there or its border has drawn back. Layers whose
/// triangles cannot be told to be theirs, as at the very bend of a fold. How often it could tell is in
/// `compared`; a swap can be seen only there. A log sees everything: see replay.h.
/// **What may deceive it.** Layers that are bent more sharply than they lie apart, as above, at high
/// reductions. In a result whose vertices are not those of the original, the nearest vertex may be one of
/// another layer.
struct Layer_order
{
  std::size_t lines = 0;    ///< drawn
  std::size_t crossing = 0; ///< those that cross two layers or more of the original
  std::size_t pairs = 0;    ///< of neighbouring layers on them
  std::size_t compared = 0; ///< those that could be found in the result
  std::vector<Layer_swap> swaps;
};

struct Comparison
{
  double diagonal = 0; ///< in the unit of the coordinates
  Bounds original_to_result = {};
  Bounds result_to_original = {};

  /// Edges of one triangle.
  Line_comparison borders;
  /// Edges of several, across which a vertex number, texture coordinate, group, object or material changes.
  Line_comparison seams;
  Gaps gaps;

  std::size_t vertices = 0;          ///< positions of the result's triangles
  std::size_t original_vertices = 0; ///< those that are positions of the original's, bit for bit
  std::vector<Kept_attribute> attributes;
  std::vector<std::string> lost_attributes; ///< names of those that only the original has

  Normal_deviation normals;
  Layer_order layers;

  /// 1 for a result without vertices.
  double share_of_original_vertices() const
  {
    return vertices == 0 ? 1 : static_cast<double>(original_vertices) / static_cast<double>(vertices);
  }
};

/// All of the above. **Complexity.** O(n log n) in practice, some ten seconds for a million triangles.
Comparison compare(const Triangle_soup& result, const Triangle_soup& original);

} // namespace selvedge

#endif // SELVEDGE_COMPARE_H
