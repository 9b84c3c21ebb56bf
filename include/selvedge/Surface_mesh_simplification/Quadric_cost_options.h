// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H

namespace selvedge {

/// The weights of what a `Quadric_cost` adds to the planes of the faces. Both are ratios of at least 0.
struct Quadric_cost_options
{
  /// Weight of the plane that stands on a border edge, per squared length of the edge. (The plane of a face
  /// has the area of the face as its weight.)
  double border_weight = 1;

  /// Weight of the squared distance to the original vertices, per area. On flat cloth the planes alone make
  /// every collapse free, so this weight decides: near vertices merge first, and triangles stay round. It is
  /// small enough not to outweigh the planes where there is a shape to keep.
  double stabiliser = 1e-5;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H
