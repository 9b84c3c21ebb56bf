// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/internal/Value_quadric.h>
#include <selvedge/mesh_files.h>
#include <selvedge/part_report.h>

#include <CGAL/Kernel/global_functions.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <random>

namespace selvedge::test {
namespace {

CGAL::Orientation uv_orientation(const Triangle_soup& soup, Index triangle)
{
  const auto point = [&](std::size_t k) {
    const auto& [u, v] = soup.uvs.values[soup.uvs.of_triangle[triangle][k]];
    return Kernel::Point_2(u, v);
  };
  return CGAL::orientation(point(0), point(1), point(2));
}

// Triangles of the texture that have another orientation than the triangle of the original that they were.
std::size_t turned_over(const Reduction& reduction)
{
  std::size_t turned = 0;
  for (Index i = 0; i < reduction.simplified.triangles.size(); ++i) {
    const CGAL::Orientation before =
        uv_orientation(reduction.prepared.soup, reduction.simplified.triangles[i]);
    turned += before != CGAL::COLLINEAR && uv_orientation(reduction.simplified.soup, i) != before;
  }
  return turned;
}

// A flat sheet whose texture is a whirl: where the sheet is flat for every rule, the texture is not.
Triangle_soup whirl(bool is_mirrored = false)
{
  Triangle_soup soup = sheet(40, 40);
  for (const Point_3& p : soup.points) {
    const double x = p.x() - 20, y = p.y() - 20, angle = 3 * std::exp(-(x * x + y * y) / 60);
    const double u = x * std::cos(angle) - y * std::sin(angle), v = x * std::sin(angle) + y * std::cos(angle);
    soup.uvs.values.push_back({(is_mirrored ? -u : u) / 60, v / 60});
  }
  soup.uvs.of_triangle = soup.triangles;
  return soup;
}

Simplify_options to_ratio_with(double ratio, bool check, double uv_weight)
{
  Simplify_options options = to_ratio(ratio);
  options.check_uv_orientation = check;
  options.uv_weight = uv_weight;
  return options;
}

TEST(Uv, NoTriangleOfTheTextureTurnsOver)
{
  for (const bool is_mirrored : {false, true}) {
    SCOPED_TRACE(is_mirrored);
    const Reduction guarded = reduce(whirl(is_mirrored), to_ratio_with(0.1, true, 0));
    EXPECT_EQ(turned_over(guarded), 0u);
    EXPECT_GT(guarded.simplified.report.refused.uv, 0u);
    EXPECT_TRUE(guarded.verification.accepted());
  }
}

TEST(Uv, ControlWithoutTheFilterTheyDo)
{
  const Reduction unguarded = reduce(whirl(), to_ratio_with(0.1, false, 0));
  EXPECT_GT(turned_over(unguarded), 0u);
  EXPECT_EQ(unguarded.simplified.report.refused.uv, 0u);
}

TEST(Uv, NoTriangleTurnsOverOnGarments)
{
  const Reduction garment_reduced = reduce(garment("jacket", 6000), to_ratio(0.1));
  ASSERT_FALSE(garment_reduced.prepared.soup.uvs.empty());
  EXPECT_EQ(turned_over(garment_reduced), 0u);

  for (const char* const name : {"dress_14_pieces_uv.obj", "avatar_in_suit_uv.obj"}) {
    const std::filesystem::path path = std::filesystem::path(SELVEDGE_SHARED_DATA) / "garments" / name;
    if (!std::filesystem::exists(path))
      GTEST_SKIP() << path << " is absent";
    SCOPED_TRACE(name);
    const Reduction reduction = reduce(read_mesh(path).soup, to_ratio(0.1));
    EXPECT_EQ(turned_over(reduction), 0u);
    EXPECT_TRUE(reduction.verification.accepted());
  }
}

TEST(Uv, StretchInTheCostMakesTheTextureSwimLess)
{
  const auto swims = [](double uv_weight) {
    const Reduction reduction = reduce(whirl(), to_ratio_with(0.2, true, uv_weight));
    return uv_deviation(reduction.simplified, reduction.prepared)->mean;
  };
  EXPECT_LT(swims(1), 0.7 * swims(0)); // the control is the weight 0
}

TEST(Uv, WithoutATextureItsWeightChangesNothing)
{
  Triangle_soup soup = skirt(4000);
  soup.uvs = {};
  const auto triangles_left = [&](double uv_weight) {
    Simplify_options options = to_ratio(0.3);
    options.uv_weight = uv_weight;
    return simplify_soup(prepare(soup), options).triangles;
  };
  EXPECT_EQ(triangles_left(0), triangles_left(100));
}

TEST(Uv, TheQuadricOfAnAffineTextureDoesNotGrowWhereTheTextureGoesOn)
{
  const auto change = [](const Uv_quadric::Vector& motion) {
    return Uv_quadric::Value{2 * motion[0] - motion[1], motion[0] + 4 * motion[1]};
  };
  const Uv_quadric::Vector a{0, 0, 0}, b{1, 0, 0}, c{0.25, 1, 0}, far{7, -3, 0};
  const Uv_quadric quadric({a, b, c}, {change(a), change(b), change(c)}, 1);
  EXPECT_NEAR(quadric(far, change(far)), 0, 1e-3);
  EXPECT_NEAR(quadric.least(far), 0, 1e-3);
  EXPECT_GT(quadric(far, {0, 0}), 100);
}

TEST(Uv, AQuadricSaysTheSameFromAnyOrigin)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 100; ++i) {
    const auto point = [&] { return Uv_quadric::Vector{number(random), number(random), number(random)}; };
    const auto uv = [&] { return Uv_quadric::Value{number(random), number(random)}; };
    Uv_quadric quadric({point(), point(), point()}, {uv(), uv(), uv()}, 1);
    // The next triangle has another place, and another texture coordinate there.
    quadric += Uv_quadric({point(), point(), point()}, {uv(), uv(), uv()}, 1).moved_by(point(), uv());
    const Uv_quadric::Vector to = point(), x = point();
    const Uv_quadric::Value uv_to = uv(), s = uv();
    const double first_part = quadric(to, uv_to), rest = quadric.moved_by(to, uv_to)(x, s),
                 whole =
                     quadric({to[0] + x[0], to[1] + x[1], to[2] + x[2]}, {uv_to[0] + s[0], uv_to[1] + s[1]});
    EXPECT_NEAR(first_part + rest, whole, 1e-5 * (std::abs(first_part) + std::abs(rest) + std::abs(whole)));
    EXPECT_LE(quadric.least(x), quadric(x, s) + 1e-5 * std::abs(quadric(x, s)));
    // A control: from another origin, it is another function.
    EXPECT_GT(std::abs(quadric(x, s) - rest), 1e-5 * std::abs(rest));
  }
}

TEST(Uv, AQuadricIsFiniteForTheSmallestTriangles)
{
  const double tiny = 1e-60;
  const Uv_quadric quadric({{{0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}}}, {{{0, 0}, {1, 0}, {0, 1}}}, 1);
  EXPECT_GT(quadric({tiny, 0, 0}, {0, 0}), 0);
  const double far = quadric({1, 0, 0}, {0, 0});
  EXPECT_TRUE(std::isfinite(far));
  EXPECT_GT(far, 1e30);
}

TEST(Uv, DeviationIsZeroWhereNothingSwims)
{
  Reduction flat = reduce(whirl(), to_ratio(1));
  EXPECT_NEAR(uv_deviation(flat.simplified, flat.prepared)->mean, 0, 1e-12);

  // All coordinates of the result shifted by a known distance.
  const double shift = 0.125;
  for (auto& value : flat.simplified.soup.uvs.values)
    value[0] += shift;
  const double diagonal = std::hypot(40.0, 40.0);
  const double unit = uv_deviation(flat.simplified, flat.prepared)->mean * diagonal / shift;
  EXPECT_GT(unit, 30); // a texture of 40 / 60 of its square on a sheet of 40: 60, but for the whirl
  EXPECT_LT(unit, 70);
}

} // namespace
} // namespace selvedge::test
