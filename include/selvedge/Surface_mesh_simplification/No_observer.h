// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NO_OBSERVER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NO_OBSERVER_H

#include <selvedge/Surface_mesh_simplification/Hindrances.h>
#include <selvedge/Surface_mesh_simplification/Refusals.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>

#include <vector>

namespace selvedge {

/// Observes nothing: the default observer of `simplify_mesh`, and the base class of all others. An observer
/// derives from this class and replaces some of its functions.
///
/// In all functions, the source of `moving` moves to its target and merges with it, or, in those that have a
/// `place`, both go to that place, which is neither of their positions, and merge there. These are called
/// with `Placement::optimal` alone, and only where both ends are free: neither locked nor on a line. `Rule`
/// is a `Border_rule`, which knows which edges are lines now.
struct No_observer
{
  /// Called before each collapse onto an end of its edge.
  template <class Halfedge, class Rule>
  void before_collapse(const Halfedge& /*moving*/, const Rule&)
  {
  }

  /// Called before each further collapse of vertices that move together
  /// (`Simplify_constraints::joint_vertices`); for the first of them, `before_collapse` is called.
  template <class Halfedge, class Rule>
  void before_joint_collapse(const Halfedge& /*moving*/, const Rule&)
  {
  }

  /// Called before each collapse to another place. `is_mover_first` says whether the source of `moving` goes
  /// there before its target, or after it.
  template <class Halfedge, class Point>
  void before_placement(const Halfedge& /*moving*/, const Point& /*place*/, bool /*is_mover_first*/)
  {
  }

  /// Called when all vertices that move together have moved.
  void after_step() {}

  /// Returns the place as it will be stored, or none where no vertex may be.
  template <class Halfedge, class Point>
  internal::Optional<Point> rounded_place(const Halfedge& /*edge*/, const Point& place) const
  {
    return place;
  }

  /// Called for each motion that is refused. The count of the rule that refused it is 1, all others are 0.
  template <class Halfedge>
  void on_refused(const Halfedge& /*moving*/, const Refusals&)
  {
  }

  /// Returns whether every piece keeps its topology, where pieces are finer than the mesh. Called for motions
  /// that the border rule allows.
  template <class Halfedge, class Rule>
  bool keeps_pieces(const Halfedge& /*moving*/, const Rule&) const
  {
    return true;
  }

  /// Returns whether pieces are joined after vertices have moved together as they were before: the sources of
  /// `moving` and of all of `others` move, each to its target.
  template <class Halfedge>
  bool keeps_joints(const Halfedge& /*moving*/, const std::vector<Halfedge>& /*others*/) const
  {
    return true;
  }

  /// Returns whether every triangle of the texture keeps its orientation.
  template <class Halfedge, class Rule>
  bool keeps_uv_orientation(const Halfedge& /*moving*/, const Rule&) const
  {
    return true;
  }

  template <class Halfedge, class Point>
  bool keeps_uv_orientation_at(const Halfedge& /*moving*/, const Point& /*place*/) const
  {
    return true;
  }

  /// Returns why a vertex is locked: `Hindrance::locked`, or one of the reasons beside it. Asked of locked
  /// vertices, when a reduction ends short of its target.
  template <class Vertex>
  Hindrance lock_reason(const Vertex&) const
  {
    return Hindrance::locked;
  }

  /// Returns why an inner edge is a line: `Hindrance::seam`, or one of the reasons from there to `normals`.
  /// The reduction calls it for edges that are lines, when it ends short of its target.
  template <class Edge>
  Hindrance line_reason(const Edge&) const
  {
    return Hindrance::seam;
  }

  /// Called for each edge that counts in `Simplify_report::hindrances`, with the reason for which it does.
  template <class Edge>
  void on_hindered(const Edge&, Hindrance)
  {
  }

  /// Returns the motions that must be done together with this one, all or none: those of the same vertex in
  /// the other places where its mesh stands. Not called for motions of both ends. Only Selvedge's own loop
  /// does them.
  template <class Halfedge>
  std::vector<Halfedge> companions(const Halfedge& /*moving*/) const
  {
    return {};
  }

  /// Returns whether neither the faces around the source of this motion nor those of any of its companions
  /// come near those of another one of them: the boxes of their stars are disjoint.
  template <class Halfedge>
  bool are_companions_apart(const Halfedge& /*moving*/, const std::vector<Halfedge>& /*companions*/) const
  {
    return true;
  }

  /// Returns whether this edge collapses only as a companion of another one. It then has no cost.
  template <class Halfedge>
  bool is_led(const Halfedge& /*edge*/) const
  {
    return false;
  }

  /// Returns whether there may be motions of which `uv_cost` or `normal_cost` is not 0. Neither is called for
  /// motions onto an end of an edge where the answer is no, which saves time. Not called for a `No_observer`
  /// itself.
  bool adds_to_costs() const { return true; }

  /// Returns how much the motion adds to the displacement of the texture, as squared lengths with the weights
  /// of `relative_face_weight`; not less than 0.
  template <class Halfedge>
  double uv_cost(const Halfedge& /*moving*/) const
  {
    return 0;
  }
  template <class Halfedge, class Point>
  double uv_cost_at(const Halfedge& /*edge*/, const Point& /*place*/) const
  {
    return 0;
  }

  /// Returns how much the motion adds to the turn of normals, in the measure of `uv_cost`.
  template <class Halfedge>
  double normal_cost(const Halfedge& /*moving*/) const
  {
    return 0;
  }
  template <class Halfedge, class Point>
  double normal_cost_at(const Halfedge& /*edge*/, const Point& /*place*/) const
  {
    return 0;
  }
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NO_OBSERVER_H
