// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "keeps_uv_orientation.h"

#include <array>

namespace selvedge {
namespace {

using Uv = Placed_vertices::Uv;

// Returns the orientation that a triangle would have in the texture with other coordinates at one corner.
CGAL::Orientation uv_orientation(const Placed_vertices& placed, const Index_triple& corners,
                                 unsigned char place, const Uv& uv)
{
  std::array<Kernel::Point_2, 3> points;
  for (unsigned char k = 0; k < 3; ++k) {
    const Uv here = k == place ? uv : placed.uv_at(corners[k]);
    points[k] = {here[0], here[1]};
  }
  return CGAL::orientation(points[0], points[1], points[2]);
}

// Returns whether a triangle keeps its orientation in the texture when one of its corners gets other
// coordinates.
bool keeps_orientation(const Placed_vertices& placed, const Index_triple& corners, unsigned char place,
                       const Uv& uv)
{
  const CGAL::Orientation before = uv_orientation(placed, corners, place, placed.uv_at(corners[place]));
  return before == CGAL::COLLINEAR || uv_orientation(placed, corners, place, uv) == before;
}

} // namespace

bool keeps_uv_orientation(const Corner_mesh& corners, const Placed_vertices& placed,
                          Corner_mesh::Halfedge moving, const Border_rule<Corner_mesh::Mesh>& rule)
{
  if (corners.soup().uvs.empty())
    return true;
  bool is_kept = true;
  corners.for_each_changed_face(moving, rule, [&](Corner_mesh::Halfedge h, Corner_mesh::Halfedge from) {
    const Corner_mesh::Face face = corners.mesh().face(h);
    for (Index i = 0; is_kept && i < corners.ply_count(face); ++i)
      is_kept = keeps_orientation(placed, corners.corners(face, i), corners.place(h),
                                  placed.uv_at(corners.corner_at(from, i)));
  });
  return is_kept;
}

bool keeps_uv_orientation_at(const Corner_mesh& corners, const Placed_vertices& placed,
                             Corner_mesh::Halfedge moving, const Point_3& place)
{
  if (corners.soup().uvs.empty())
    return true;
  const Uv uv = placed.uv_at(moving, place);
  bool is_kept = true;
  corners.for_each_changed_face(moving, [&](Corner_mesh::Halfedge h) {
    is_kept =
        is_kept && keeps_orientation(placed, corners.corners(corners.mesh().face(h)), corners.place(h), uv);
  });
  return is_kept;
}

} // namespace selvedge
