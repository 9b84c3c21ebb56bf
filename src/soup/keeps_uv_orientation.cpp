// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "keeps_uv_orientation.h"

namespace selvedge {
namespace {

using Uv = Placed_vertices::Uv;

// Returns whether a triangle keeps its orientation in the texture when one of its corners gets other
// coordinates.
bool keeps_orientation(const Placed_vertices& placed, const Index_triple& corners, unsigned char place,
                       const Uv& uv)
{
  const auto point = [](const Uv& at) { return Kernel::Point_2(at[0], at[1]); };
  const Kernel::Point_2 ahead = point(placed.uv_at(corners[(place + 1) % 3])),
                        behind = point(placed.uv_at(corners[(place + 2) % 3]));
  const CGAL::Orientation before = CGAL::orientation(point(placed.uv_at(corners[place])), ahead, behind);
  return before == CGAL::COLLINEAR || CGAL::orientation(point(uv), ahead, behind) == before;
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
