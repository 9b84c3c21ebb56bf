// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Vertices at new places, and the values that they have there.

#include "soup/Working_mesh.h"
#include "support/soups.h"

#include <selvedge/prepare.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <gtest/gtest.h>

#include <array>

namespace selvedge::test {
namespace {

using Uv = std::array<double, 2>;

/// Merges two vertices of a sheet at a place, and returns the texture coordinates there. Before, the third
/// corner of the face of this place may move, and the place may be judged.
Uv uv_at_new_place(bool is_judged, bool has_moved)
{
  Triangle_soup soup = sheet(6, 6);
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.x() * p.x(), p.x() * p.y()});
  soup.uvs.of_triangle = soup.triangles;
  const Prepared_soup prepared = prepare(soup);
  Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen, prepared.obstacle);
  working.allow_new_places(false);
  const Border_rule<Working_mesh::Mesh> rule(working.mesh(), Border_rule_options());
  Working_mesh::Mesh& mesh = working.mesh();
  const auto vertex_at = [&](const Point_3& p) {
    for (const auto v : mesh.vertices())
      if (mesh.point(v) == p)
        return v;
    return Working_mesh::Mesh::null_vertex();
  };
  const auto merge = [&](auto moving, const Point_3& place) {
    mesh.point(CGAL::Euler::collapse_edge(mesh.edge(moving), mesh)) = place;
  };

  const auto edge = mesh.halfedge(vertex_at(Point_3(2, 2, 0)), vertex_at(Point_3(3, 2, 0)));
  const auto third = mesh.target(mesh.next(edge));
  const Point_3 place = CGAL::centroid(Point_3(2, 2, 0), Point_3(3, 2, 0), mesh.point(third));
  if (is_judged)
    working.keeps_uv_orientation_at(edge, place);
  if (has_moved) {
    const Point_3& from = mesh.point(third);
    const Point_3 goal(from.x() + 1, from.y(), from.z());
    const auto moving = mesh.halfedge(third, vertex_at(goal));
    working.before_collapse(moving, rule);
    merge(moving, goal);
  }
  working.before_placement(edge, place, true);
  merge(edge, place);

  const Triangle_soup result = working.result().soup;
  for (Index t = 0; t < result.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (result.points[result.triangles[t][k]] == place)
        return result.uvs.values[result.uvs.of_triangle[t][k]];
  ADD_FAILURE() << "no vertex at the new place";
  return {};
}

TEST(Placed_vertices, HaveTheValuesOfTheFacesThatAreThereThen)
{
  EXPECT_EQ(uv_at_new_place(true, false), uv_at_new_place(false, false));
  EXPECT_EQ(uv_at_new_place(true, true), uv_at_new_place(false, true));
  EXPECT_NE(uv_at_new_place(false, true), uv_at_new_place(false, false)) << "the control";
}

} // namespace
} // namespace selvedge::test
