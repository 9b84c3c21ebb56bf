// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Smooth normals in place of those of the input, or where it has none.

#include "support/Temporary_folder.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>
#include <selvedge/replay.h>
#include <selvedge/rounding.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>

namespace selvedge::test {
namespace {

using Normal = std::array<double, 3>;

double height_at(double x, double y)
{
  return std::sin(x / 4) + std::cos(y / 5);
}

// A sheet in waves whose faces have normals of their own.
Triangle_soup flat_waves()
{
  Triangle_soup soup = mapped(
      sheet(40, 40), [](const Point_3& p) { return Point_3(p.x(), p.y(), float(height_at(p.x(), p.y()))); });
  restore_normals(soup, Normals_treatment::flat);
  return soup;
}

// Two halves at an angle, folded along x = 10, without normals.
Triangle_soup fold(double degrees)
{
  const double turn = degrees * std::acos(-1.0) / 180;
  return mapped(sheet(20, 10), [&](const Point_3& p) {
    const double beyond = p.x() - 10;
    return beyond <= 0 ? p : Point_3(10 + beyond * std::cos(turn), p.y(), beyond * std::sin(turn));
  });
}

Normal normal_at(const Triangle_soup& soup, Index t, std::size_t k)
{
  return soup.normals.values[soup.normals.of_triangle[t][k]];
}

std::size_t normals_at_vertex(const Triangle_soup& soup, const Point_3& point)
{
  std::set<Index> numbers;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (soup.points[soup.triangles[t][k]] == point)
        numbers.insert(soup.normals.of_triangle[t][k]);
  return numbers.size();
}

Prepare_options smooth()
{
  Prepare_options options;
  options.normals = Normals_choice::smooth;
  return options;
}

// The greatest angle, in degrees, between the normals of a reduced sheet of waves and those of the waves.
double greatest_turn_from_waves(const Triangle_soup& soup)
{
  double lowest = 1;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& p = soup.points[soup.triangles[t][k]];
      const double u = -std::cos(p.x() / 4) / 4, v = std::sin(p.y() / 5) / 5;
      const Normal normal = normal_at(soup, t, k);
      lowest = std::min(lowest, (normal[0] * u + normal[1] * v + normal[2]) / std::sqrt(u * u + v * v + 1));
    }
  return std::acos(lowest) * 180 / std::acos(-1.0);
}

TEST(Smooth_normals, ShadeASurfaceOfFlatFacesSmooth)
{
  const Triangle_soup soup = flat_waves();
  const Prepared_soup original = prepare(soup, smooth());
  EXPECT_EQ(original.normals, Normals_treatment::smoothed);
  EXPECT_EQ(original.soup.normals.values.size(), soup.points.size());
  const Triangle_soup result = simplify_soup(original, to_ratio(0.1)).soup;
  EXPECT_LE(result.triangles.size(), soup.triangles.size() / 10);
  EXPECT_LT(greatest_turn_from_waves(result), 8);
  Prepare_options automatic;
  automatic.normals = Normals_choice::automatic;
  const Triangle_soup flat = simplify_soup(prepare(soup, automatic), to_ratio(0.1)).soup;
  EXPECT_GT(greatest_turn_from_waves(flat), 12);
  for (const Normal& normal : result.normals.values)
    for (const double coordinate : normal)
      EXPECT_TRUE(is_float32(coordinate)) << coordinate;
}

TEST(Smooth_normals, LeaveEdgesHardThatTurnByMoreThan60Degrees)
{
  Triangle_soup soft = fold(59), hard = fold(61);
  smooth_normals(soft);
  smooth_normals(hard);
  const Point_3 on_fold(10, 5, 0);
  EXPECT_EQ(normals_at_vertex(soft, on_fold), 1u);
  EXPECT_EQ(normals_at_vertex(hard, on_fold), 2u);
  EXPECT_EQ(normals_at_vertex(hard, Point_3(9, 5, 0)), 1u);

  const Triangle_soup result = simplify_soup(prepare(fold(90), smooth()), to_ratio(0.1)).soup;
  EXPECT_LE(result.triangles.size(), 40u);
  for (Index t = 0; t < result.triangles.size(); ++t) {
    double x = 0;
    for (const Index v : result.triangles[t])
      x += result.points[v].x();
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(normal_at(result, t, k)[x < 29.99 ? 2 : 0], x < 29.99 ? 1 : -1, 1e-6);
  }
}

TEST(Smooth_normals, KnowPositionsAloneAndNotVertices)
{
  // As a seam of the texture splits them in PLY and glTF; each triangle has vertices of its own.
  Triangle_soup apart = unshared(fold(30)), shared = fold(30);
  smooth_normals(apart);
  smooth_normals(shared);
  EXPECT_EQ(apart.normals.values, shared.normals.values);
  EXPECT_EQ(apart.normals.of_triangle, shared.normals.of_triangle);
}

TEST(Smooth_normals, PassThroughTrianglesWithoutAnArea)
{
  // Two flat halves with a sliver between them: 0 1 2, 1 0 3, and 0 1 4 where 4 is in the edge.
  Triangle_soup sliver = soup({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}, {1, 0, 0}},
                              {{0, 1, 2}, {1, 0, 4}, {0, 3, 4}, {3, 1, 4}});
  smooth_normals(sliver);
  EXPECT_EQ(normals_at_vertex(sliver, {0, 0, 0}), 1u);
  EXPECT_EQ(sliver.normals.values.front(), (Normal{0, 0, 1}));
  Triangle_soup alone = collinear_triangle();
  smooth_normals(alone);
  EXPECT_EQ(normal_at(alone, 0, 0), (Normal{0, 0, 1}));
}

TEST(Smooth_normals, AreWrittenToFilesThatHadNone)
{
  const Temporary_folder folder;
  Triangle_soup sphere = nested_spheres(2000, 1, 1e-3);
  round_to_float32(sphere);
  Prepare_options float_smooth = smooth();
  float_smooth.round_to_float32 = true;
  for (const std::string name : {"m.glb", "m.gltf", "m.ply", "m.obj"}) {
    write_mesh(folder / name, sphere);
    const Triangle_soup read = read_mesh(folder / name).soup;
    ASSERT_TRUE(read.normals.empty());
    write_mesh(folder / name, simplify_soup(prepare(read, float_smooth), to_ratio(0.4)).soup);
    const Triangle_soup result = read_mesh(folder / name).soup;
    ASSERT_FALSE(result.normals.empty()) << name;
    ASSERT_GT(result.triangles.size(), 100u);
    for (Index t = 0; t < result.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Point_3& p = result.points[result.triangles[t][k]];
        const Normal n = normal_at(result, t, k);
        const double cosine = (n[0] * p.x() + n[1] * p.y() + n[2] * p.z()) /
                              std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
        EXPECT_GT(cosine, 0.98) << name;
      }
  }
}

TEST(Smooth_normals, AreMadeByTheReplayAsWell)
{
  for (const Triangle_soup& soup : {flat_waves(), fold(90)}) {
    const Replay_verdict verdict = replay_text(soup, reduce_and_log(soup, to_ratio(0.3), smooth()).log);
    EXPECT_TRUE(verdict.is_accepted());
    EXPECT_EQ(verdict.header.normals, Logged_normals::smooth);
  }
  // The control: a judge who takes the flat normals of the input sees vertices leave their lines.
  const Triangle_soup soup = flat_waves();
  const std::string log = reduce_and_log(soup, to_ratio(0.3), smooth()).log, line = "normals smooth\n";
  ASSERT_NE(log.find(line), std::string::npos);
  EXPECT_FALSE(replay_text(soup, std::string(log).erase(log.find(line), line.size())).is_accepted());
}

} // namespace
} // namespace selvedge::test
