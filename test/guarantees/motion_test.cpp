// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G2: nothing passes through anything on the way; the order of layers is kept.

#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"
#include "support/tunnel_scene.h"

#include <selvedge/generate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace selvedge::test {
namespace {

// The mesh after one collapse, whatever anybody says against it.
Triangle_soup collapsed(Triangle_soup soup, Index moving, Index target)
{
  std::vector<Index_triple> kept;
  for (Index_triple triangle : soup.triangles) {
    std::replace(triangle.begin(), triangle.end(), moving, target);
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      kept.push_back(triangle);
  }
  soup.triangles = kept;
  return soup;
}

// An open fan around m that comes back to a position: the faces (m, a, b) and (m, a2, d), with a2 where a is,
// lie one above the other, and share an edge by position alone. As m goes to c, far below, the first turns up
// about that edge and, when d lies low enough, through the second.
bool is_fan_collapse_accepted(double height_of_d)
{
  Mesh mesh;
  const auto m = mesh.add_vertex({0, 0, 0}), a = mesh.add_vertex({2, 0, 0}), b = mesh.add_vertex({-1, 2, 0}),
             c = mesh.add_vertex({-1, -2, -0.3}), a2 = mesh.add_vertex({2, 0, 0}),
             d = mesh.add_vertex({1, 1, height_of_d}), x = mesh.add_vertex({0, 0, -5});
  for (const auto& [u, v, w] :
       {std::array{m, a, b}, {m, b, c}, {m, c, a2}, {m, a2, d}, {c, b, x}, {a2, c, x}})
    EXPECT_NE(mesh.add_face(u, v, w), Mesh::null_face());
  EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
  const Intersection_filter<Mesh> filter(mesh);
  filter.visitor().OnStarted(mesh); // as a loop does
  const auto points = mesh.points();
  const Kernel kernel;
  const internal::Lazy_edge_profile<Mesh, Mesh::Property_map<Mesh::Vertex_index, Point_3>, Kernel> profile(
      mesh.halfedge(m, c), mesh, points, kernel);
  return bool(filter(profile, internal::Optional<Point_3>(mesh.point(c))));
}

TEST(Motion, FacesOfOneFanDoNotPassThroughEachOther)
{
  EXPECT_FALSE(is_fan_collapse_accepted(0.01));
  EXPECT_TRUE(is_fan_collapse_accepted(1)); // high enough
}

TEST(Motion, CollapseThroughThinSheetIsRejected)
{
  const Tunnel_scene scene = tunnel_scene();
  const Reduction reduction = reduce(scene.soup, to_ratio(0.0));
  EXPECT_EQ(reduction.simplified.report.collapses, 0u);
  EXPECT_GT(reduction.simplified.report.intersections.refused_by_sweep, 0u);
}

// The negative controls: a check of the end state alone lets it pass, and nothing but the filter stops it.
TEST(Motion, CollapseThroughThinSheetIsEmbeddedAtItsEnd)
{
  const Tunnel_scene scene = tunnel_scene();
  EXPECT_TRUE(is_embedded(scene.soup));
  EXPECT_TRUE(is_embedded(collapsed(scene.soup, scene.moving, scene.target)));

  const Reduction unguarded = reduce(scene.soup, without_check(to_ratio(0.0)));
  EXPECT_EQ(unguarded.simplified.report.collapses, 1u);
  EXPECT_TRUE(unguarded.verification.embedded()) << "which is why looking at the result is not enough";
}

// The same for a point that crosses a face exactly: coordinates are small integers, and so is the answer.
TEST(Motion, TouchingOnTheWayIsRejected)
{
  // A pyramid without its base; its apex would move onto a base corner past a triangle inside.
  const auto scene = [](double height) {
    return joined(soup({{0, 0, 8}, {-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}},
                       {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}),
                  soup({{1, 1, height}, {2, 1, height}, {1, 2, height}}, {{0, 1, 2}}));
  };
  for (const double height : {1.0, 2.0, 3.0}) {
    const Reduction reduction = reduce(scene(height), without_limits(to_ratio(0.0)));
    EXPECT_EQ(reduction.simplified.report.intersections.refused_by_sweep > 0, true) << height;
    EXPECT_TRUE(reduction.verification.embedded());
  }
}

// Which of two sheets is the upper one, at every vertex of the lower that is left.
TEST(Motion, OrderOfLayersIsKept)
{
  Generate_options options;
  options.faces = 8000;
  options.layers = 2;
  options.gap = 1e-4;
  options.seed = 3;
  const Triangle_soup sheets = generate("sheets", options);
  ASSERT_EQ(sheets.groups.names.size(), 2u);

  const auto layer = [](const Triangle_soup& soup, Index group) {
    Triangle_soup result;
    result.points = soup.points;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      if (soup.groups.of_triangle[t] == group)
        result.triangles.push_back(soup.triangles[t]);
    return result;
  };
  // On which side of the other layer, seen along z, the triangles of a layer have their centres: +1 or -1
  // when all agree.
  const auto signs = [](const Triangle_soup& below, const Triangle_soup& above) {
    int sum = 0, count = 0;
    for (const Index_triple& t : below.triangles) {
      const Point_3 p = CGAL::centroid(below.points[t[0]], below.points[t[1]], below.points[t[2]]);
      for (const Index_triple& u : above.triangles) {
        const Point_3 &a = above.points[u[0]], &b = above.points[u[1]], &c = above.points[u[2]];
        const auto side = [&](const Point_3& q, const Point_3& r) {
          return CGAL::orientation(Kernel::Point_2(q.x(), q.y()), Kernel::Point_2(r.x(), r.y()),
                                   Kernel::Point_2(p.x(), p.y()));
        };
        const CGAL::Orientation turn = side(a, b);
        if (turn == CGAL::COLLINEAR || side(b, c) != turn || side(c, a) != turn)
          continue;
        sum += CGAL::orientation(a, b, c, p) * turn;
        ++count;
      }
    }
    EXPECT_GT(count, 20);
    return std::abs(sum) == count ? sum / count : 0;
  };

  const auto order = [&](const Triangle_soup& soup) { return signs(layer(soup, 0), layer(soup, 1)); };
  const int before = order(sheets);
  ASSERT_NE(before, 0);
  // Layers that are reduced alike stay apart by themselves; these are not.
  Simplify_intent unlike;
  unlike.ratios = {{"sheet_0", 0.1}};
  const Prepared_soup prepared = prepare(sheets);
  EXPECT_EQ(order(simplify_soup(prepared, to_ratio(0.3), unlike).soup), before);
  EXPECT_EQ(order(simplify_soup(prepared, without_check(to_ratio(0.3)), unlike).soup), 0) << "the control";
}

} // namespace
} // namespace selvedge::test
