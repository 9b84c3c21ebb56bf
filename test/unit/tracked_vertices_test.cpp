// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Tracked_vertices: what it skips changes no distance.

#include "support/mesh_of.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/Tracked_vertices.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

namespace selvedge::test {
namespace {

using Face = Mesh::Face_index;

// Asks every triangle that the collapse of an edge to a place changes about every vertex that the star of the
// edge carries, in a mesh in which nothing was collapsed.
double error_by_brute_force(const Mesh& mesh, Mesh::Halfedge_index h, const Point_3& place)
{
  std::set<Face> star, removed;
  for (const Mesh::Halfedge_index end : {h, mesh.opposite(h)})
    for (const Mesh::Halfedge_index g : mesh.halfedges_around_target(end))
      if (!mesh.is_border(g))
        star.insert(mesh.face(g));
  for (const Mesh::Halfedge_index g : {h, mesh.opposite(h)})
    if (!mesh.is_border(g))
      removed.insert(mesh.face(g));
  double largest = 0;
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    Face carrier = Mesh::null_face();
    for (const Face f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f != Mesh::null_face())
        carrier = (std::min)(carrier, f); // the null face is the largest
    if (star.count(carrier) == 0)
      continue;
    double least = std::numeric_limits<double>::infinity();
    for (const Face f : star) {
      if (removed.count(f) > 0)
        continue;
      std::vector<Point_3> corners;
      for (const Mesh::Vertex_index w : mesh.vertices_around_face(mesh.halfedge(f)))
        corners.push_back(w == mesh.source(h) || w == mesh.target(h) ? place : mesh.point(w));
      const auto point = [](const Point_3& p) {
        return CGAL::Simple_cartesian<double>::Point_3(p.x(), p.y(), p.z());
      };
      least = std::min(least,
                       CGAL::squared_distance(point(mesh.point(v)),
                                              CGAL::Simple_cartesian<double>::Triangle_3(
                                                  point(corners[0]), point(corners[1]), point(corners[2]))));
    }
    largest = std::max(largest, least);
  }
  return std::sqrt(largest);
}

TEST(Tracked_vertices, ErrorIsThatOfTheNearestTriangles)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-0.3, 0.3);
  for (const double width : {1., 1e-3, 1e-7}) { // the last two have needles
    Mesh mesh = mesh_of(mapped(sheet(9, 9), [&](const Point_3& p) {
      return Point_3(p.x() + number(random), width * (p.y() + number(random)), width * number(random));
    }));
    internal::Tracked_vertices<Mesh> tracked(mesh);
    const auto points = get(CGAL::vertex_point, mesh);
    tracked.begin(points, 1);
    std::size_t asked = 0;
    for (const Mesh::Edge_index e : mesh.edges()) {
      const Mesh::Halfedge_index h = mesh.halfedge(e);
      const Kernel traits;
      const internal::Lazy_edge_profile<Mesh, std::decay_t<decltype(points)>, Kernel> profile(h, mesh, points,
                                                                                              traits);
      const Point_3 middle = CGAL::midpoint(profile.p0(), profile.p1());
      const Point_3 place(middle.x() + 0.1 * number(random), middle.y(),
                          middle.z() + 0.1 * width * number(random));
      const double expected = error_by_brute_force(mesh, h, place);
      EXPECT_NEAR(tracked.error_at(profile, place), expected, 1e-6 * expected + 1e-8) << e;
      asked += expected > 0;
    }
    EXPECT_GT(asked, 200u);
  }
}

} // namespace
} // namespace selvedge::test
