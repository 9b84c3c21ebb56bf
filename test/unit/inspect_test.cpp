// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What `inspect` says of meshes of which all of it is known.

#include "inspect/surface_distances.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/inspect.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

/// A ring of square cross-section around the z axis.
Triangle_soup torus()
{
  Triangle_soup result;
  constexpr Index around = 8, across = 4;
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const double a = 6.283185307179586 * i / around, b = 6.283185307179586 * j / across;
      const double r = 3 + std::cos(b);
      result.points.emplace_back(r * std::cos(a), r * std::sin(a), std::sin(b));
    }
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const auto at = [&](Index k, Index l) { return (i + k) % around * across + (j + l) % across; };
      result.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      result.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  return result;
}

double least_distance(const Triangle_soup& soup)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Connected_surface& surface : inspect(soup).surfaces)
    least = std::min(least, surface.distance);
  return least;
}

TEST(Inspect, TellsSurfacesByTheirTopology)
{
  const Inspection result = inspect(joined(joined(torus(), moved(tetrahedron(), 20, 0, 0)), sheet(2, 2, 9)));
  ASSERT_EQ(result.surfaces.size(), 3u);
  EXPECT_EQ(result.surfaces[0].genus(), 1u);
  EXPECT_EQ(result.surfaces[1].genus(), 0u);
  EXPECT_EQ(result.surfaces[2].genus(), std::nullopt);
  EXPECT_TRUE(result.surfaces[0].is_closed());
  EXPECT_FALSE(result.surfaces[2].is_closed());
  EXPECT_EQ(result.surfaces[2].shape.boundary_loops, 1u);
  EXPECT_EQ(result.border_edges, 8u);
  EXPECT_EQ(result.misoriented_edges, 0u);
}

TEST(Inspect, SewsPiecesToSurfaces)
{
  const Inspection result = inspect(joined(sheet(3, 3), moved(sheet(3, 3), 3, 0, 0)));
  EXPECT_EQ(result.pieces.size(), 2u);
  ASSERT_EQ(result.surfaces.size(), 1u);
  EXPECT_EQ(result.surfaces[0].nearest, std::nullopt);
  EXPECT_EQ(result.seams.edges, 3u);
  EXPECT_EQ(result.seams.by_vertices, 3u);
  EXPECT_EQ(result.seams.by_texture + result.seams.by_normals + result.seams.by_labels, 0u);
  // On the seam, two vertices move along it; where it meets the border, both ends stay.
  EXPECT_EQ(result.movable.ends, 2u);
  EXPECT_EQ(result.movable.on_lines, 2u + 16u);
  EXPECT_EQ(result.movable.free, 8u);
}

TEST(Inspect, MeasuresCornersEdgesAndFaces)
{
  const Triangle_soup face = soup({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}, {{0, 1, 2}});
  const Triangle_soup tip = soup({{0, 0, 2}, {1, 0, 8}, {0, 1, 8}}, {{0, 1, 2}});
  EXPECT_DOUBLE_EQ(least_distance(joined(face, tip)), 2); // a corner above a face
  EXPECT_DOUBLE_EQ(least_distance(joined(tip, face)), 2);
  const Triangle_soup along_x = soup({{-5, 0, 0}, {5, 0, 0}, {0, 0, -5}}, {{0, 1, 2}});
  const Triangle_soup along_y = soup({{0, -5, 0.25}, {0, 5, 0.25}, {0, 0, 6}}, {{0, 1, 2}});
  EXPECT_DOUBLE_EQ(least_distance(joined(along_x, along_y)), 0.25); // two edges
  EXPECT_EQ(least_distance(crossing()), 0);
  EXPECT_EQ(least_distance(vertex_touching_face()), 0);
  EXPECT_GT(least_distance(joined(sheet(3, 3), sheet(3, 3, 1e-300))), 0); // 0 is for those that meet alone
  for (const double gap : {1e-100, 1e-9, 1e9})
    EXPECT_DOUBLE_EQ(least_distance(joined(sheet(3, 3), sheet(3, 3, gap))), gap);
}

TEST(Inspect, FindsTheNearestOfManySurfaces)
{
  // Sheets of different sizes at random places, compared with all pairs of their triangles.
  std::mt19937 random(7);
  const auto number = [&] { return double(random()) / 4294967296.0; };
  for (int round = 0; round < 20; ++round) {
    std::vector<Triangle_soup> sheets;
    Triangle_soup all;
    for (int i = 0; i < 8; ++i) {
      sheets.push_back(
          moved(sheet(1 + random() % 3, 1 + random() % 3), 9 * number(), 9 * number(), 9 * number()));
      all = joined(all, sheets.back());
    }
    const Inspection result = inspect(all);
    ASSERT_EQ(result.surfaces.size(), sheets.size());
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < sheets.size(); ++j)
        if (j != i) // flat boxes, parallel to the axes
          least = std::min(least, [&] {
            double squares = 0;
            for (int axis = 0; axis < 3; ++axis) {
              const auto extent = [&](const Triangle_soup& soup) {
                const auto [low, high] =
                    std::minmax_element(soup.points.begin(), soup.points.end(),
                                        [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
                return std::make_pair((*low)[axis], (*high)[axis]);
              };
              const auto a = extent(sheets[i]), b = extent(sheets[j]);
              const double gap = std::max({a.first - b.second, b.first - a.second, 0.0});
              squares += gap * gap;
            }
            return std::sqrt(squares);
          }());
      EXPECT_NEAR(result.surfaces[i].distance, least, 1e-12);
    }
  }
}

TEST(Inspect, LeavesOutNoNearerTriangleOfAnySlope)
{
  // Triangles of all slopes and thicknesses, many in near-parallel layers, compared with pairs of them, of
  // which nothing is left out.
  std::mt19937 random(3);
  const auto number = [&] { return double(random()) / 4294967296.0 - 0.5; };
  const auto distances = [](const std::vector<Point_3>& points, Index count) {
    std::vector<Index_triple> triangles;
    std::vector<Index> surfaces;
    for (Index t = 0; t < count; ++t) {
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
      surfaces.push_back(t);
    }
    return internal::surface_distances(points, triangles, surfaces, count, {});
  };
  for (int round = 0; round < 50; ++round) {
    constexpr Index count = 24;
    const double thickness = std::pow(10., -double(round % 8)), gap = std::pow(10., -double(round % 5));
    const Kernel::Vector_3 u(number(), number(), number()), v(number(), number(), number());
    const Kernel::Vector_3 up = CGAL::cross_product(u, v);
    std::vector<Point_3> points;
    for (Index t = 0; t < count; ++t) {
      const double height = gap * (round % 2 == 0 ? double(t) : number());
      const double slope = t % 3 == 0 ? 0.1 * gap : 0;
      const double from_u = number(), from_v = number();
      for (int corner = 0; corner < 3; ++corner)
        points.push_back(Point_3(0, 0, 0) + (from_u + number()) * u + (from_v + thickness * number()) * v +
                         (height + slope * number()) * up);
    }
    const auto all = distances(points, count);
    for (Index a = 0; a < count; ++a) {
      double least = std::numeric_limits<double>::infinity();
      for (Index b = 0; b < count; ++b)
        if (b != a) {
          std::vector<Point_3> pair(points.begin() + 3 * a, points.begin() + 3 * a + 3);
          pair.insert(pair.end(), points.begin() + 3 * b, points.begin() + 3 * b + 3);
          least = std::min(least, distances(pair, 2)[0].distance);
        }
      EXPECT_NEAR(all[a].distance, least, 1e-12 * least + 1e-15) << round;
    }
  }
}

TEST(Inspect, SaysWhatIsFrozenAndWhy)
{
  const Inspection crossed = inspect(crossing());
  EXPECT_EQ(crossed.pairs.size(), 1u);
  EXPECT_EQ(crossed.fixed_faces, 0u) << "pairs may descend";
  const Inspection degenerate = inspect(joined(sheet(2, 2, 5), collinear_triangle()));
  EXPECT_EQ(degenerate.pairs.size(), 1u);
  EXPECT_EQ(degenerate.fixed_faces, 0u) << "it might be contracted";

  Triangle_soup turned = sheet(2, 2);
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  const Inspection oriented = inspect(joined(turned, sheet(2, 2, 5)));
  EXPECT_EQ(oriented.turned_faces, 1u);
  EXPECT_EQ(oriented.turned_pieces, std::vector<Index>{0});
  EXPECT_EQ(oriented.misoriented_edges + oriented.movable.misoriented, 0u);
  const Inspection disagreeing = inspect(joined(moebius_band(), sheet(2, 2, 5)));
  EXPECT_EQ(disagreeing.turned_faces, 0u);
  EXPECT_EQ(disagreeing.misoriented_edges, 1u);
  EXPECT_EQ(disagreeing.misoriented_pieces, std::vector<Index>{0});
  EXPECT_EQ(disagreeing.surfaces[0].misoriented_edges, 1u);
  EXPECT_EQ(disagreeing.surfaces[1].misoriented_edges, 0u);
  EXPECT_GT(disagreeing.movable.misoriented, 0u);
  EXPECT_EQ(disagreeing.movable.non_manifold, 0u);

  const Inspection fan = inspect(book());
  EXPECT_GT(fan.movable.non_manifold, 0u);
  EXPECT_EQ(fan.movable.misoriented, 0u);
}

/// Every triangle is followed by one that runs the other way.
Triangle_soup doubled(Triangle_soup mesh)
{
  std::vector<Index_triple> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
    triangles.insert(triangles.end(), {{a, b, c}, {a, c, b}});
  mesh.triangles = triangles;
  return mesh;
}

TEST(Inspect, AgreesWithAReduction)
{
  for (const Triangle_soup& mesh : {skirt(2000), finned_sheet(10, 3), sewn_pieces(1000), moebius_band(),
                                    doubled(finned_sheet(10, 3)), doubled(joined(book(), sheet(9, 9, 5)))}) {
    const Inspection result = inspect(mesh);
    const Reduction reduction = reduce(mesh, to_ratio(0.5));
    EXPECT_EQ(result.fixed_faces, reduction.simplified.report.faces_fixed);
    EXPECT_EQ(result.seams.edges, reduction.simplified.sewing.seam_edges);
    EXPECT_EQ(result.misoriented_edges, reduction.simplified.sewing.misoriented_edges);
    EXPECT_EQ(result.misoriented_pieces.size(), reduction.simplified.sewing.misoriented_pieces);
  }
}

TEST(Inspect, SaysHowFarPartnersAreApart)
{
  const Inspection result = inspect(joined(sheet(30, 3), moved(sheet(30, 3), 30.125, 0, 0)));
  EXPECT_EQ(result.border_gaps.border_vertices, 132u);
  EXPECT_EQ(result.border_gaps.limit, 1);
  EXPECT_EQ(result.border_gaps.lengths, std::vector<double>(8, 0.125));
  EXPECT_EQ(result.border_gaps.clear_length, 0.125);
}

TEST(Inspect, LeavesOutWhatHasTwoCornersAtOnePosition)
{
  Triangle_soup mesh = sheet(2, 2);
  mesh.triangles.push_back({0, 0, 1});
  mesh.points.emplace_back(7, 7, 7);
  const Inspection result = inspect(mesh);
  EXPECT_EQ(result.faces, 8u);
  EXPECT_EQ(result.left_out_faces, 1u);
  EXPECT_EQ(result.unused_vertices, 1u);
  EXPECT_DOUBLE_EQ(result.diagonal, std::sqrt(8));
  EXPECT_THROW(inspect(soup({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}})), Input_error);
}

TEST(Contents, NamesWhatAFileHolds)
{
  Mesh_file file;
  file.soup = sheet(2, 1);
  file.soup.groups = {{0, 0, 2, 2}, {"front", "gone", "back"}};
  file.soup.materials = {{0, 0, 0, 0}, {""}};
  file.soup.vertex_attributes.emplace_back().name = "red";
  const Contents plain = contents_of(file);
  EXPECT_EQ(plain.groups, (std::vector<std::string>{"front", "back"}));
  EXPECT_TRUE(plain.materials.empty());
  EXPECT_EQ(plain.attributes, std::vector<std::string>{"red"});
  EXPECT_EQ(plain.normals, Normals_of_file::none);

  auto& normals = file.soup.normals;
  normals.values = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  normals.of_triangle.assign(4, {0, 0, 0});
  EXPECT_EQ(contents_of(file).normals, Normals_of_file::per_face);
  for (Index t = 0; t < 4; ++t)
    for (Index k = 0; k < 3; ++k)
      normals.of_triangle[t][k] = file.soup.triangles[t][k] % 3;
  EXPECT_EQ(contents_of(file).normals, Normals_of_file::per_vertex);
  normals.of_triangle[3] = {0, 1, 0};
  EXPECT_EQ(contents_of(file).normals, Normals_of_file::per_corner);
}

} // namespace
} // namespace selvedge::test
