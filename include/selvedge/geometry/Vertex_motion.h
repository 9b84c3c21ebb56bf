// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_VERTEX_MOTION_H
#define SELVEDGE_GEOMETRY_VERTEX_MOTION_H

#include <array>
#include <vector>

namespace selvedge {

/// One vertex of a mesh that goes along a straight segment, and the faces that it takes along.
///
/// A face (from, a, b) is named by its link edge (a, b), counter-clockwise seen from outside; `from` has no
/// twin. A halfedge collapse has one or two contracted faces as a rule; a motion to a place that is no vertex
/// has none.
template <class Point>
struct Vertex_motion
{
  Point from;
  Point to;

  /// Link edges of the moving faces: those that do not contain `to`, and end as (to, a, b).
  std::vector<std::array<Point, 2>> moving;

  /// Link edges of the contracted faces: those that contain `to` as a or as b, and vanish at the end.
  std::vector<std::array<Point, 2>> contracted;
};

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_VERTEX_MOTION_H
