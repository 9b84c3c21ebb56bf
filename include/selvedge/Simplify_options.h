// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_OPTIONS_H
#define SELVEDGE_SIMPLIFY_OPTIONS_H

#include <selvedge/Soup_collapse.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost_options.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace selvedge {
namespace internal {
class Collapse_record;
} // namespace internal

/// How far a reduction has come.
struct Simplify_progress
{
  std::size_t faces_input = 0;
  std::size_t faces_target = 0;
  std::size_t faces = 0; ///< faces left now
};

/// Where a collapse puts the merged vertex.
enum class Placement {
  vertices, ///< at one end of the edge: every vertex of the result is one of the input
  optimal   ///< where its quadric is least, and at an end where that is refused or an end must stay
};

/// Which loop takes edges from a queue and collapses them.
enum class Collapse_loop {
  own, ///< `selvedge::edge_collapse`
  cgal ///< `CGAL::Surface_mesh_simplification::edge_collapse`, repeated as long as it helps: the reference
};

/// Which index finds the faces near a motion.
enum class Face_index {
  packed,  ///< `Packed_R_tree`
  clusters ///< `Clustered_AABB_tree`: the reference
};

/// What becomes of a mesh that stands in several places of a glTF scene, in nodes or as instances.
enum class Instances {
  shared, ///< it is reduced once: a collapse is done in all places, or, where one does not allow it, in none;
          ///< the last one may pass a target by two faces in every place
  apart   ///< it is reduced in each place by itself
};

/// The options of `simplify_soup` and `simplify_mesh`. Values outside the ranges given throw
/// `Argument_error`.
///
/// The target is the larger of the face counts that `ratio` and `faces` name. With neither, the target is 0
/// faces, and the limits decide where the reduction ends.
struct Simplify_options
{
  /// Faces to keep, as a share of those of the input that can be reduced, in [0, 1]. A face whose corners are
  /// all locked from the start (in frozen or locked faces, or at coincident vertices that cannot move
  /// together) stays and does not count, so that the rest does not have to make up for it.
  std::optional<double> ratio;

  /// Faces to keep, of all.
  std::optional<std::size_t> faces;

  /// Numbers of faces below which no target is, whatever ratios say: of the faces that belong to no part with
  /// a ratio of its own, then of those of each such part (`Simplify_intent::ratios`). What is not listed has
  /// none. `Missed_target` sets them. The order of collapses is that of a reduction without them.
  std::vector<std::size_t> least_faces;

  /// Takes down the collapses of this reduction, from the first on, for `repeated` of another one.
  /// `Missed_target` makes it. May be null. One reduction at a time may use it.
  std::shared_ptr<internal::Collapse_record> record;

  /// The collapses of an earlier reduction of the same mesh, which had the same options but for
  /// `least_faces`, and neither cells nor shares (`Simplify_constraints::shares`). They are done again until
  /// the target is reached, and nothing is asked: the result is that of a reduction without them, but for
  /// what its report says of refusals and tests. May be null.
  std::shared_ptr<const internal::Collapse_record> repeated;

  /// The largest distance E between the surfaces of the original and the result, as a share of the diagonal
  /// of the bounding box, at least 0. It is measured at every collapse, and holds at any time: from every
  /// vertex of the original to the result, and from the vertices of the result to the original; and both
  /// ways from points between, of grids that divide the sides of triangles into parts no longer than E, and
  /// into 8 at most (for an original of many long sides fewer, see internal/Tracked_points.h). Between these
  /// points, the distance may be larger: where faces are long beside E, 1.3 E was seen, and where a sheet
  /// closes a hole that is smaller than the grids, it is as large as this hole. `distances_anywhere` bounds
  /// it, and `Error_search` finds an E with which every point is within another. With an E of 0, no surface
  /// is lost or gained anywhere. (The original is the mesh as `prepare` left it.)
  std::optional<double> max_error;

  /// The largest change of a face's normal in one collapse, in degrees from 0 to 180, where the face is not
  /// low (`max_corner_height`). The default lets small bumps and hollows go, so that the surface gets the
  /// faces that it needs. With 45°, the value of Derichs, Misiak and Fuhrmann, the error at 3 % of the faces
  /// is up to a fifth larger; at 10 % it is within 2 %. With 90°, lips open and ears lose their shape.
  double max_normal_change = 75;

  /// The least aspect ratio (`aspect_ratio()`: 1 for the equilateral triangle) that a collapse may leave
  /// among the faces that it changes, in [0, 1]. A smaller one is accepted when it was smaller still before,
  /// and for faces of a strip between two lines (borders or seams): all three corners are on lines, and at
  /// most one edge is a line. Along the edge of thick cloth, faces can only be as wide as the cloth is thick.
  ///
  /// The default is small, because what bends in one direction alone, as folds, ribs, tubes and mouldings do,
  /// keeps its shape by long, thin triangles along it. For cloth that is to be simulated, 0.2 keeps triangles
  /// rounder, which is the value of Derichs, Misiak and Fuhrmann; at 10 % of the faces, garments are then 1.2
  /// to 2.5 times as far off.
  double min_aspect_ratio = 0.01;

  /// The largest turn that a border may have at a vertex that a collapse removes from it, in degrees from 0
  /// to 180. The default keeps corners, and lets the cost and the drift decide about the rest. (Derichs,
  /// Misiak and Fuhrmann use 8°, with which a border keeps faces that the surface needs more.)
  double max_border_turn = 30;

  /// The largest height of a *low corner*, as a share of the diagonal of the bounding box, at least 0. There
  /// a border may turn by any angle: no original vertex of it is farther than this from the segment that
  /// replaces it. So may a face: its corner that moves is no farther from the line through the other two,
  /// before and after. What is so small is not seen, and the open ends of pipes, bevels and small parts need
  /// not keep faces that the rest needs more. 0 makes no corner low.
  double max_corner_height = 0.0025;

  /// The largest turn that a line inside the surface may have, likewise: a sewn seam, or a chain of edges
  /// across which texture coordinates, normals, groups, objects, materials or the values of large regions of
  /// faces change. The default is larger than for borders, because no outline frays there, and such lines are
  /// often bent.
  double max_seam_turn = 90;

  /// The largest distance from an original vertex of a border or seam to the segment that replaces it, as a
  /// share of the diagonal of the bounding box, at least 0. (With a fifth of the default, the lines of a
  /// coarse mesh keep so many faces at 10 % that its surface is twice as far off.)
  double max_border_drift = 0.01;

  /// Whether layers are kept from piercing each other. False changes nothing else; it is meant as a control.
  bool check_intersections = true;

  /// The distance, in units of the mesh, that pieces keep from each other: no two come nearer than this or,
  /// if they are nearer already, than they are, in any guarded pose (`Intersection_filter::keep_clearance`).
  /// Positive and finite; none by default. It needs `check_intersections`, and excludes cells and parts that
  /// may intersect.
  std::optional<double> clearance;

  /// Whether triangles of the texture are kept from turning over, where a mesh has texture coordinates. False
  /// changes nothing else; it is meant as a control.
  bool check_uv_orientation = true;

  /// The weight of texture displacement in the cost, relative to the same displacement of the surface itself:
  /// finite, at least 0. Displacement is measured in the plane of the texture, in units of the mesh. 0 turns
  /// this part of the cost off.
  double uv_weight = 0.02;

  /// The weight of the turn of normals in the cost: of how much the normal of a point of the surface turns,
  /// relative to the displacement of the surface itself; finite, at least 0. A radian counts as a length: the
  /// radius of the mean curvature that the normals tell. More weight keeps the shading truer, and the shape
  /// less so.
  ///
  /// The normals are those that a soup keeps. If it keeps none, is not shaded flat, and has at most
  /// `most_faces_shaded` triangles, they are the smooth ones with which viewers shade such a mesh, so that
  /// eyes, lips and folds stay to be seen; a radian then counts as at most 3 % of the diagonal. For larger
  /// meshes, this would take time and memory for what is too small to be seen. `simplify_mesh` counts none.
  double normal_weight = 0.005;
  static constexpr std::size_t most_faces_shaded = 500'000;

  /// The loop that does the collapses. Both loops give the guarantees; `own` is faster.
  Collapse_loop loop = Collapse_loop::own;

  /// The index of faces. Both indices give the same result; `packed` is faster and smaller.
  Face_index index = Face_index::packed;

  /// How many faces a cluster of `Face_index::clusters` should have, at least 1.
  std::size_t faces_per_cluster = 100;

  /// The further poses, by number, in which collapses are judged: all of them when it has no value. The
  /// others are carried along, and nothing is promised of them before `verify` has judged the result
  /// (key_poses.h).
  std::optional<std::vector<std::size_t>> guarded_poses;

  /// The number of faces per *cell*, or 0 for a reduction without cells. With cells, a soup is first reduced
  /// in disjoint boxes of space, each of at most about this many faces, on as many threads as oneTBB grants;
  /// then what is left is reduced as a whole. Every guarantee holds as without cells. The result differs from
  /// that without cells, but never depends on the number of threads. `simplify_mesh` has no cells, and throws
  /// `Argument_error`. The program takes `default_faces_per_cell`.
  std::size_t faces_per_cell = 0;

  /// Large enough that few vertices are at cell walls, and small enough that a cell stays in a processor's
  /// cache.
  static constexpr std::size_t default_faces_per_cell = 50'000;

  Quadric_cost_options cost;

  /// Where a collapse puts the merged vertex. With `optimal`, the result is nearer to the input for the same
  /// number of faces; the attributes of vertices at new places are interpolated (`simplify_soup`).
  Placement placement = Placement::vertices;

  /// Whether texture coordinates, attributes and normals of the result are fitted to those of the original.
  /// False saves time where a result may not be kept, and leaves it to `fit_values` when it is.
  bool are_values_fitted = true;

  /// What becomes of meshes that stand in several places of a glTF scene (`simplify_soup`).
  Instances instances = Instances::shared;

  /// Whether `Simplified_soup::progression` lists the steps. Not with `Placement::optimal`
  /// (`Argument_error`), which makes new vertices.
  bool is_progression_recorded = false;

  /// Whether `Simplified_soup::history` is kept. It changes nothing else. `simplify_mesh` keeps none.
  bool is_history_kept = false;

  /// Called before each collapse of a soup, as `Reduction_log` takes it. It may be empty. With
  /// `simplify_mesh` it must be empty (`Argument_error`); use an observer there.
  std::function<void(const Soup_collapse&)> on_collapse;

  /// Called from time to time; when it returns true, the reduction ends with the mesh as it is then. It may
  /// be empty. In cells, several threads call it, one at a time. To end all work without a result, see
  /// Cancellation_scope.h.
  std::function<bool(const Simplify_progress&)> should_stop;
};

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_OPTIONS_H
