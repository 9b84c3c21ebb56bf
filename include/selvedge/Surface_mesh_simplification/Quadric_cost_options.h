// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H

namespace selvedge {

/// The weights of what a `Quadric_cost` adds to the planes of the faces. Both are ratios of at least 0.
struct Quadric_cost_options
{
  /// Weight of the plane that stands on a border edge, relative to that of a face whose area is the squared
  /// length of the edge. A line inside the surface has two such planes, with a tenth of this weight each.
  double border_weight = 1;

  /// Weight of the squared distance to the original vertices, relative to that of the planes. On flat cloth
  /// the planes alone make every collapse free, so this weight decides: near vertices merge first, and
  /// triangles stay round. It is small enough not to outweigh the planes where there is a shape to keep.
  double stabiliser = 1e-5;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H
