// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_OPTIONS_H
#define SELVEDGE_SIMPLIFY_OPTIONS_H

#include <selvedge/Surface_mesh_simplification/Quadric_cost.h>

#include <cstddef>
#include <functional>
#include <optional>

namespace selvedge {

/// How far a reduction has come, for whoever watches it.
struct Simplify_progress
{
  std::size_t faces_input;
  std::size_t faces_target;
  std::size_t faces; ///< now
};

/// Which loop takes edges from a queue and collapses them.
enum class Collapse_loop {
  own, ///< `selvedge::edge_collapse`
  cgal ///< `CGAL::Surface_mesh_simplification::edge_collapse`, in as many passes as it takes: the reference
};

/// Which index finds the faces near a motion.
enum class Face_index {
  packed,  ///< `Packed_R_tree`
  clusters ///< `Clustered_AABB_tree`: the reference
};

/// What `simplify` is asked to do. Values outside the ranges given throw `Argument_error`.
///
/// The target is the largest of the face counts that `ratio` and `faces` name; with neither it is no face at
/// all, and the limits decide.
struct Simplify_options
{
  /// Faces to keep, as a share of the input's, in [0, 1].
  std::optional<double> ratio;

  /// Faces to keep.
  std::optional<std::size_t> faces;

  /// The largest error of a collapse, as a share of the diagonal of the bounding box, at least 0: the root
  /// mean square distance, weighted by area, of the merged vertex to the planes of the original faces that it
  /// stands for.
  std::optional<double> max_error;

  /// The largest change of a face's normal in one collapse, in degrees from 0 to 180.
  double max_normal_change = 45;

  /// The least aspect ratio of a face, in [0, 1], unless it is better than before. The default is what looks
  /// best: folds keep their long, thin triangles. For a result that is simulated, 0.2 keeps triangles
  /// rounder, which is the value of Derichs, Misiak and Fuhrmann; at 10 % of the faces it costs 1.3 to 2
  /// times the error.
  double min_aspect_ratio = 0.05;

  /// The largest turn of a border at a vertex that leaves it, in degrees from 0 to 180.
  double max_border_turn = 8;

  /// The same for a line inside the surface: a sewn seam, a texture seam, a border between groups. There is
  /// no outline to fray there, and such lines are often bent: with 8° they would keep most of their vertices.
  double max_seam_turn = 60;

  /// The largest distance of an original border or seam vertex to the segment that replaced it, as a share of
  /// the diagonal, at least 0.
  double max_border_drift = 0.002;

  /// Whether layers are kept from piercing each other. Without, everything else stays the same: a control.
  bool check_intersections = true;

  /// Whether triangles of the texture are kept from turning over, where a mesh has texture coordinates.
  /// Without, everything else stays the same: a control.
  bool check_uv_orientation = true;

  /// How much a texture that swims counts in the cost, at least 0, against the same distance of the surface
  /// itself: the displacement of the texture in the plane of the texture, in units of the mesh. 0 turns it
  /// off.
  double uv_weight = 0.1;

  /// Both loops give the guarantees; the own one is faster.
  Collapse_loop loop = Collapse_loop::own;

  /// Both indices give the same result; the packed one is faster and smaller.
  Face_index index = Face_index::packed;

  /// What the cells of the clustered index aim at, at least 1.
  std::size_t faces_per_cluster = 100;

  /// Reduces a soup in *cells* first: disjoint boxes of space of at most about so many faces each, on as many
  /// threads as TBB has; then what is left, as without. 0: not. Every guarantee holds as without, and the
  /// result never depends on the number of threads; but it is another.
  std::size_t faces_per_cell = 0;

  Quadric_cost_options cost;

  /// Told of every collapse of a soup, before it: a vertex of the soup at the position that goes, and one at
  /// that to which it goes; what a log (collapse_log.h) holds. It may be empty.
  std::function<void(std::size_t removed, std::size_t kept)> on_collapse;

  /// Asked now and then; when it returns true, the reduction ends with the mesh as it is. It may be empty. In
  /// cells it is asked by several threads, one at a time. To end all work without a result, see
  /// Cancellation_scope.h.
  std::function<bool(const Simplify_progress&)> should_stop;
};

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_OPTIONS_H
