// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_VERTEX_MOTION_H
#define SELVEDGE_GEOMETRY_VERTEX_MOTION_H

#include <array>
#include <vector>

namespace selvedge {

/// The motion of one vertex of a mesh along a straight segment, with the faces at that vertex.
///
/// A face (from, a, b) is given by its link edge (a, b), counter-clockwise seen from outside. No other vertex
/// lies at `from`. A halfedge collapse has one or two contracted faces as a rule; a motion to a place where
/// there is no vertex has none.
template <class Point>
struct Vertex_motion
{
  Point from;
  Point to;

  /// Link edges of the moving faces: those that do not contain `to`. They end as (to, a, b).
  std::vector<std::array<Point, 2>> moving;

  /// Link edges of the contracted faces: those that contain `to` as a or as b. They vanish at the end.
  std::vector<std::array<Point, 2>> contracted;
};

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_VERTEX_MOTION_H
