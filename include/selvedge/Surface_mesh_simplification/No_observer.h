// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NO_OBSERVER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NO_OBSERVER_H

#include <selvedge/Surface_mesh_simplification/Refusals.h>

namespace selvedge {

/// Watches nothing, and has nothing that hangs on the mesh. What `simplify` accepts as an observer derives
/// from this and has functions of its own in place of some of these.
///
/// In all of them the source of `moving` goes to its target and merges with it; the rule is a `Border_rule`,
/// which knows what is a line now.
struct No_observer
{
  template <class Halfedge, class Rule>
  void before_collapse(const Halfedge& /*moving*/, const Rule&)
  {
  }

  /// The motion was refused; one count is 1, the others are 0.
  template <class Halfedge>
  void on_refused(const Halfedge& /*moving*/, const Refusals&)
  {
  }

  /// Does every piece keep its topology, where pieces are finer than the mesh? Asked of what the rule allows.
  template <class Halfedge, class Rule>
  bool keeps_pieces(const Halfedge& /*moving*/, const Rule&) const
  {
    return true;
  }

  /// Does every triangle of the texture keep its orientation?
  template <class Halfedge, class Rule>
  bool keeps_uv_orientation(const Halfedge& /*moving*/, const Rule&) const
  {
    return true;
  }

  /// How far the texture is displaced, as area × squared length.
  template <class Halfedge>
  double uv_cost(const Halfedge& /*moving*/) const
  {
    return 0;
  }
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NO_OBSERVER_H
