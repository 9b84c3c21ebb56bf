// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H

namespace selvedge {

/// What a `Quadric_cost` adds to the planes of the faces of the mesh as it is. The weights are ratios of at
/// least 0.
struct Quadric_cost_options
{
  /// Weight of the plane that stands on a border edge, relative to that of a face whose area is the squared
  /// length of the edge. A line inside the surface has two such planes, with a tenth of this weight each. So
  /// has an edge over which the surface turns by more than 90°, with a half of this weight each where both
  /// sides lie on each other: the hem of a folded sheet keeps its course as one that is cut does.
  double border_weight = 1;

  /// Weight of the squared distance to the original vertices, relative to that of the planes. On flat cloth
  /// the planes alone make every collapse free, so this weight decides: near vertices merge first, and
  /// triangles stay round. It is small enough not to outweigh the planes where there is a shape to keep.
  double stabiliser = 1e-5;

  /// Share of the quadrics that have accumulated since the original, from 0 to 1. At 1, the cost is that of
  /// Garland and Heckbert; at 0, it depends on nothing but the mesh as it is, as that of Lindstrom and Turk.
  double memory = 0.03;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_OPTIONS_H
