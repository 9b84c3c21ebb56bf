// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The smooth normals that count in the cost of a mesh without normals.

#include "soup/Sewn_mesh.h"
#include "soup/Value_wedges.h"
#include "soup/texture.h"
#include "soup/vertex_normals.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/internal/Value_quadric.h>
#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/normals.h>
#include <selvedge/prepare.h>
#include <selvedge/simplify.h>

#include <CGAL/Kernel/global_functions.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

Vertex_normals vertex_normals_of(const Prepared_soup& prepared)
{
  return vertex_normals(prepared.soup, prepared.positions, prepared.is_turned, prepared.fronts);
}

double cosine_to(const std::array<double, 3>& normal, const Point_3& p)
{
  return (normal[0] * p.x() + normal[1] * p.y() + normal[2] * p.z()) /
         std::sqrt(CGAL::squared_distance(p, Point_3(0, 0, 0)));
}

TEST(VertexNormals, OfASpherePointAwayFromItsCentre)
{
  const Prepared_soup prepared = prepare(nested_spheres(4000, 1, 1e-2));
  const Vertex_normals normals = vertex_normals_of(prepared);
  ASSERT_EQ(normals.size(), prepared.soup.points.size());
  for (std::size_t v = 0; v < normals.size(); ++v)
    EXPECT_GT(cosine_to(normals[v], prepared.soup.points[v]), 0.99);
}

TEST(VertexNormals, DoNotEndAtSeams)
{
  // Two halves of a sheet that is bent there, each with vertices of its own.
  const auto bent = [](const Point_3& p) { return Point_3(p.x(), p.y(), std::abs(p.x() - 3)); };
  const Triangle_soup half = sheet(3, 4);
  const Prepared_soup prepared = prepare(mapped(joined(half, moved(half, 3, 0, 0)), bent));
  const Vertex_normals normals = vertex_normals_of(prepared);
  std::size_t on_seam = 0;
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (prepared.soup.points[v].x() == 3) {
      EXPECT_GT(std::abs(normals[v][2]), 0.99);
      ++on_seam;
    }
  EXPECT_EQ(on_seam, 10U);
}

// An obstacle has positions behind those of the mesh, some of them in common.
TEST(VertexNormals, AreThoseOfTheMeshAlone)
{
  const Triangle_soup mesh = sheet(3, 3),
                      wall =
                          mapped(sheet(3, 3), [](const Point_3&p) { return Point_3(p.x(), -p.z(), -p.y()); });
  const Prepared_soup prepared = prepare(mesh, {}, wall);
  ASSERT_GT(prepared.positions.size(), mesh.points.size());
  const Vertex_normals normals = vertex_normals_of(prepared);
  ASSERT_EQ(normals.size(), mesh.points.size());
  for (const std::array<double, 3>& normal : normals)
    EXPECT_EQ(std::abs(normal[2]), 1);
  Simplify_options options = to_ratio(0.5);
  EXPECT_NO_THROW(simplify_soup(prepared, options));
}

TEST(VertexNormals, CountTurnedFacesAsTurnedAndDoublesOnce)
{
  Triangle_soup soup = sheet(4, 4);
  const Index count = Index(soup.triangles.size());
  for (Index t = 0; t < count; ++t) { // both sides, of which one would cancel the other
    const auto [a, b, c] = soup.triangles[t];
    if (t == 5)
      soup.triangles[t] = {a, c, b};
    soup.triangles.push_back({c, b, a});
  }
  const Prepared_soup prepared = prepare(soup);
  ASSERT_GT(prepared.doubles(), 0U);
  const Vertex_normals normals = vertex_normals_of(prepared);
  for (const std::array<double, 3>& normal : normals)
    EXPECT_EQ(std::abs(normal[2]), 1);
  for (const std::array<double, 3>& normal : normals)
    EXPECT_EQ(normal, normals.front());
}

TEST(VertexNormals, OfAVertexWhoseOnlyFaceIsTurnedAreThoseOfTheSheet)
{
  Triangle_soup soup = sheet(4, 4);
  std::vector<int> faces_at(soup.points.size());
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle)
      ++faces_at[v];
  for (auto& [a, b, c] : soup.triangles)
    if (faces_at[a] == 1 || faces_at[b] == 1 || faces_at[c] == 1)
      std::swap(b, c);
  Prepare_options options;
  options.orient = true;
  const Prepared_soup prepared = prepare(soup, options);
  ASSERT_GT(prepared.turned_faces(), 0U);
  for (const std::array<double, 3>& normal : vertex_normals_of(prepared))
    EXPECT_EQ(normal[2], vertex_normals_of(prepared).front()[2]);
}

// The same normals, at the corners of the soup and by its vertices.
TEST(VertexNormals, CostWhatTheyCostAtCorners)
{
  const Prepared_soup bare = prepare(nested_spheres(4000, 1, 1e-2));
  const Vertex_normals normals = vertex_normals_of(bare);
  Triangle_soup with_normals = bare.soup;
  with_normals.normals.values = normals;
  with_normals.normals.of_triangle = with_normals.triangles;
  const auto sewn = [&](const Triangle_soup& soup) {
    return Sewn_mesh(soup, bare.positions, bare.is_frozen, bare.obstacle, bare.scale, bare.is_turned,
                     bare.fronts);
  };
  const double unit = normal_unit(bare.soup, bare.scale, &normals);
  EXPECT_GT(unit, 0);
  EXPECT_EQ(normal_unit(with_normals, bare.scale), unit);
  const Sewn_mesh without = sewn(bare.soup), with = sewn(with_normals);
  const Shading_wedges by_vertex(without, bare.scale, without.constraints(), unit, &normals);
  const Shading_wedges by_corner(with, bare.scale, with.constraints(), unit);
  std::size_t dear = 0;
  for (const auto h : without.mesh().halfedges()) {
    EXPECT_EQ(by_vertex.cost(h), by_corner.cost(h));
    dear += by_vertex.cost(h) > 0;
  }
  EXPECT_GT(2 * dear, without.mesh().number_of_halfedges());
}

TEST(ValueQuadric, MovesItsValueWhereTheDisplacementIsLeast)
{
  using Quadric = Value_quadric<3>;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return std::array<double, 3>{number(random), number(random), number(random)}; };
  for (int i = 0; i < 100; ++i) {
    Quadric quadric({vector(), vector(), vector()}, {vector(), vector(), vector()}, 1);
    quadric += Quadric({vector(), vector(), vector()}, {vector(), vector(), vector()}, 2)
                   .moved_by(vector(), vector());
    const std::array<double, 3> best = quadric.best_value_motion();
    EXPECT_NEAR(quadric({0, 0, 0}, best), quadric.least({0, 0, 0}), 1e-4);
    for (int k = 0; k < 10; ++k) {
      std::array<double, 3> other = vector();
      for (std::size_t j = 0; j < 3; ++j)
        other[j] += best[j];
      EXPECT_LT(quadric({0, 0, 0}, best), quadric({0, 0, 0}, other));
    }
  }
  EXPECT_EQ(Quadric().best_value_motion(), (std::array<double, 3>{0, 0, 0}));
}

// The mean angle, in radians, between the smooth normals in the middle of faces of a result and those of the
// original at the vertex that is nearest.
double shading_error(const Triangle_soup& result, const Triangle_soup& original)
{
  const Prepared_soup now = prepare(result), before = prepare(original);
  const Vertex_normals normals_now = vertex_normals_of(now), normals_before = vertex_normals_of(before);
  double sum = 0, area = 0;
  for (const auto& [a, b, c] : now.soup.triangles) {
    const std::vector<Point_3>& p = now.soup.points;
    const Point_3 middle = CGAL::centroid(p[a], p[b], p[c]);
    std::array<double, 3> normal;
    for (std::size_t i = 0; i < 3; ++i)
      normal[i] = normals_now[a][i] + normals_now[b][i] + normals_now[c][i];
    std::size_t nearest = 0;
    for (std::size_t v = 1; v < before.soup.points.size(); ++v)
      if (CGAL::compare_distance_to_point(middle, before.soup.points[v], before.soup.points[nearest]) ==
          CGAL::SMALLER)
        nearest = v;
    const auto& [x, y, z] = normals_before[nearest];
    const double cosine = cosine_to(normal, Point_3(x, y, z)) / std::sqrt(internal::dot(normal, normal));
    const double weight = std::sqrt(CGAL::squared_area(p[a], p[b], p[c]));
    sum += weight * std::acos(std::clamp(cosine, -1.0, 1.0));
    area += weight;
  }
  return sum / area;
}

Triangle_soup with_normal_weight(const Triangle_soup& soup, double normal_weight)
{
  Simplify_options options = to_ratio(0.1);
  options.placement = Placement::optimal;
  options.normal_weight = normal_weight;
  Prepare_options prepare_options;
  prepare_options.normals = Normals_choice::automatic;
  return reduce(soup, options, prepare_options).simplified.soup;
}

TEST(VertexNormals, CountInTheCostOfAMeshThatKeepsNone)
{
  // A sheet in waves, with low ridges.
  const Triangle_soup bare = mapped(sheet(60, 60), [](const Point_3& p) {
    const double ridge = std::fmod(p.x() + 0.5 * p.y(), 20) < 2 ? 0.8 : 0;
    return Point_3(p.x(), p.y(), 3 * std::sin(p.x() / 5) * std::cos(p.y() / 6) + ridge);
  });
  const double weight = Simplify_options().normal_weight;
  const double with = shading_error(with_normal_weight(bare, weight), bare),
               without = shading_error(with_normal_weight(bare, 0), bare);
  EXPECT_LT(with, 0.97 * without);
}

TEST(VertexNormals, DoNotCountInAMeshThatIsShadedFlat)
{
  Triangle_soup flat = skirt(3000);
  restore_normals(flat, Normals_treatment::flat);
  const Triangle_soup with = with_normal_weight(flat, 0.1), without = with_normal_weight(flat, 0);
  EXPECT_EQ(with.points, without.points);
  EXPECT_EQ(with.triangles, without.triangles);
  flat.normals = {};
  EXPECT_NE(with_normal_weight(flat, 0.1).points, with_normal_weight(flat, 0).points);
}

} // namespace
} // namespace selvedge::test
