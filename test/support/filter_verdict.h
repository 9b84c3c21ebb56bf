// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_FILTER_VERDICT_H
#define SELVEDGE_TEST_SUPPORT_FILTER_VERDICT_H

#include <selvedge/Surface_mesh_simplification/Intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Triangle_soup.h>

#include <CGAL/Surface_mesh.h>

namespace selvedge::test {

using Filtered_mesh = CGAL::Surface_mesh<Point_3>;

/// Returns what an intersection filter says of the collapse of one vertex onto another. Calls
/// `set_up(filter)` before.
template <class Function>
bool is_collapse_accepted(const Triangle_soup& soup, Index mover, Index target, const Function& set_up)
{
  using Vertex = Filtered_mesh::Vertex_index;
  using Points = Filtered_mesh::Property_map<Vertex, Point_3>;
  using Profile = internal::Lazy_edge_profile<Filtered_mesh, Points, Kernel>;
  Filtered_mesh mesh;
  for (const Point_3& p : soup.points)
    mesh.add_vertex(p);
  for (const auto& [a, b, c] : soup.triangles)
    mesh.add_face(Vertex(a), Vertex(b), Vertex(c));
  const Intersection_filter<Filtered_mesh> filter(mesh);
  set_up(filter);
  filter.visitor().OnStarted(mesh);
  const Points points = mesh.points();
  const Kernel kernel;
  const Profile profile(mesh.halfedge(Vertex(mover), Vertex(target)), mesh, points, kernel);
  return filter.accepts(internal::Collapse<Profile>(profile, mesh.point(Vertex(target))));
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_FILTER_VERDICT_H
