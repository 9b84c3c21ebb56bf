// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_GEOMETRY_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_GEOMETRY_H

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

namespace selvedge {
namespace internal {

/// The two vertices of a profile's edge and where each goes when the merged vertex is placed at a point.
template <class Profile, class Point>
bool is_v0_moved(const Profile& profile, const Point& placement)
{
  return placement != profile.p0();
}
template <class Profile, class Point>
bool is_v1_moved(const Profile& profile, const Point& placement)
{
  return placement != profile.p1();
}

/// The halfedge along which a vertex moves when the placement is an end of the edge.
template <class Profile, class Point>
auto moving_halfedge(const Profile& profile, const Point& placement)
{
  return is_v0_moved(profile, placement) ? profile.v0_v1() : profile.v1_v0();
}

/// Calls `is_fine(before, after, a, b)` for every face (v, a, b), counter-clockwise, that a collapse changes
/// but keeps, where `before` is the position of v, `after` that of the merged vertex; stops at the first
/// false.
///
/// Walks halfedges rather than `Profile::triangles()`, which gathers the faces of both ends into vectors
/// first.
template <class Profile, class Point, class Predicate>
bool all_of_changed_faces(const Profile& profile, const Point& placement, Predicate&& is_fine)
{
  const auto& mesh = profile.surface_mesh();
  const auto points = profile.vertex_point_map();
  const auto are_fine_around = [&](auto vertex, auto other, const Point& before) {
    for (const auto h : CGAL::halfedges_around_target(halfedge(vertex, mesh), mesh)) {
      if (CGAL::is_border(h, mesh))
        continue;
      const auto a = target(next(h, mesh), mesh);
      const auto b = source(h, mesh);
      if (a != other && b != other && !is_fine(before, placement, get(points, a), get(points, b)))
        return false;
    }
    return true;
  };
  return (!is_v0_moved(profile, placement) || are_fine_around(profile.v0(), profile.v1(), profile.p0())) &&
         (!is_v1_moved(profile, placement) || are_fine_around(profile.v1(), profile.v0(), profile.p1()));
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_GEOMETRY_H
