// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Normals that would point to the back of a face are mended: no hem is shaded as its inside. Loose ones are
// picked anew for each face.

#include "support/reduction.h"
#include "support/shading.h"

#include <selvedge/normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

using namespace selvedge;
using selvedge::test::count_of_wrong_sides;
using selvedge::test::hem;
using selvedge::test::mending;
using selvedge::test::reduce;
using selvedge::test::Reduction;
using selvedge::test::to_ratio;

TEST(Shading, NoNormalPointsToTheBackOfAFace)
{
  const Triangle_soup soup = hem();
  ASSERT_EQ(count_of_wrong_sides(soup), 0u);
  for (const Placement placement : {Placement::vertices, Placement::optimal})
    for (const double ratio : {0.3, 0.1, 0.02})
      for (const std::size_t faces_per_cell : {0, 200}) {
        Simplify_options options = to_ratio(ratio);
        options.placement = placement;
        options.faces_per_cell = faces_per_cell;
        const Reduction reduction = reduce(soup, options, mending());
        EXPECT_TRUE(reduction.verification.accepted());
        EXPECT_EQ(count_of_wrong_sides(reduction.simplified.soup), 0u) << ratio;
      }
}

// The control: some of those that are kept bit for bit do, and more when the turn of normals costs nothing.
TEST(Shading, IsThatOfTheBackWhereAllNormalsAreKept)
{
  Simplify_options options = to_ratio(0.1);
  options.normal_weight = 0;
  const Reduction kept = reduce(hem(), options), mended = reduce(hem(), options, mending());
  EXPECT_LT(count_of_wrong_sides(reduce(hem(), to_ratio(0.1)).simplified.soup),
            count_of_wrong_sides(kept.simplified.soup));
  EXPECT_GT(count_of_wrong_sides(kept.simplified.soup), 5u);
  EXPECT_EQ(kept.simplified.mended_normals, 0u);
  EXPECT_GE(mended.simplified.mended_normals, count_of_wrong_sides(kept.simplified.soup));
  EXPECT_EQ(mended.simplified.soup.triangles, kept.simplified.soup.triangles);
}

TEST(Shading, OfAFaceThatIsInsideOutStaysSo)
{
  Triangle_soup soup = hem();
  for (auto& normal : soup.normals.values)
    for (double& x : normal)
      x = -x;
  const Reduction reduction = reduce(soup, to_ratio(0.1), mending());
  EXPECT_EQ(count_of_wrong_sides(reduction.simplified.soup), reduction.simplified.soup.triangles.size());
  EXPECT_GT(reduction.simplified.mended_normals, 0u);
}

// Cloth in pleats, each side of them nearly flat, with normals of its own at its corners.
Triangle_soup pleats()
{
  constexpr Index columns = 60, rows = 20;
  Triangle_soup soup;
  for (Index i = 0; i <= columns; ++i)
    for (Index j = 0; j <= rows; ++j)
      soup.points.emplace_back(i, j, i % 3 == 0 ? 0.3 : 0);
  for (Index i = 0; i < columns; ++i)
    for (Index j = 0; j < rows; ++j) {
      const Index a = (rows + 1) * i + j, b = a + 1, c = a + rows + 1, d = c + 1;
      const Index number = 2 * (i % 3) + j % 2, next = 2 * (i % 3) + (j + 1) % 2;
      soup.triangles.push_back({a, d, b});
      soup.normals.of_triangle.push_back({number, next, next});
      soup.triangles.push_back({a, c, d});
      soup.normals.of_triangle.push_back({number, number, next});
    }
  soup.normals.values = {{0.3, 0.1, 1}, {0.3, -0.1, 1}, {0, 0.1, 1},
                         {0, -0.1, 1},  {-0.3, 0.1, 1}, {-0.3, -0.1, 1}};
  return soup;
}

TEST(Shading, HoldsNoEdgesWhereNormalsAreLoose)
{
  const Triangle_soup soup = pleats();
  Prepare_options options;
  options.normals = Normals_choice::loose;
  const Reduction loose = reduce(soup, to_ratio(0.03), options), kept = reduce(soup, to_ratio(0.03));
  EXPECT_TRUE(loose.verification.accepted());
  EXPECT_TRUE(loose.simplified.report.is_reached());
  EXPECT_FALSE(kept.simplified.report.is_reached());
  // Where the pleats are still there, their sides shade as they did.
  const Triangle_soup half = reduce(soup, to_ratio(0.3), options).simplified.soup;
  for (Index t = 0; t < half.triangles.size(); ++t) {
    const auto& [a, b, c] = half.triangles[t];
    const double left = std::min({half.points[a].x(), half.points[b].x(), half.points[c].x()});
    for (const Index number : half.normals.of_triangle[t]) {
      const auto& [x, y, z] = half.normals.values[number];
      EXPECT_NEAR(x / z, soup.normals.values[2 * (std::size_t(left) % 3)][0], 0.1);
    }
  }
}

TEST(Shading, IsThatOfTheNearestNormalAtAVertex)
{
  Triangle_soup original = pleats();
  std::swap(original.normals.of_triangle[1000], original.normals.of_triangle[1040]); // of another side
  Triangle_soup result = original;
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < original.triangles.size(); ++t) {
    triangles.push_back(t);
    corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  // The first triangle has moved to the flat side beside its own.
  const Index flat = 40;
  ASSERT_EQ(original.points[original.triangles[flat][0]].x(), 1);
  result.triangles[0] = original.triangles[flat];
  corners[0] = corners[flat];
  result.normals = {};
  Triangle_soup without_normals = original;
  without_normals.normals = {};
  pick_normals(result, triangles, corners, without_normals, original.normals);
  for (Index t = 0; t < original.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(result.normals.values[result.normals.of_triangle[t][k]],
                original.normals.values[original.normals.of_triangle[t == 0 ? flat : t][k]]);
  // Fans of one normal leave a corner the one that it has.
  result.normals = original.normals;
  result.normals.of_triangle[0] = original.normals.of_triangle[1040];
  pick_normals(result, triangles, corners, original, original.normals);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(result.normals.values[result.normals.of_triangle[0][k]],
              original.normals.values[original.normals.of_triangle[1040][k]]);
}

// Normals that are off in the original are not mended for that.
TEST(Shading, StaysAsItIsWhereNothingChanges)
{
  Triangle_soup soup = hem();
  for (auto& normal : soup.normals.values)
    normal = {normal[0] + 0.9, normal[1], normal[2]};
  Triangle_soup result = soup;
  std::vector<Index> triangles;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    triangles.push_back(t);
  EXPECT_EQ(mend_normals(result, triangles, soup, soup.normals), 0u);
  EXPECT_EQ(result.normals.values, soup.normals.values);
}

// Faces that meet at a mended vertex have one normal there, also across a seam of the texture.
TEST(Shading, IsSmoothWhereNormalsAreMended)
{
  Triangle_soup original;
  original.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}, {-1, 0, 0}, {0, -1, 0.1}, {0, 0, 0}};
  original.triangles = {{0, 1, 2}, {5, 2, 3}, {5, 3, 4}, {0, 4, 1}};
  original.normals = {{{0, 0, 1}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  Triangle_soup result = original;
  result.normals = {{{0, 0, 1}, {0, 0, -1}}, {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}};
  EXPECT_EQ(mend_normals(result, {0, 1, 2, 3}, original, original.normals), 3u);
  const auto normal = [&](std::size_t t) { return result.normals.values[result.normals.of_triangle[t][0]]; };
  EXPECT_EQ(normal(0), normal(1));
  EXPECT_EQ(normal(0), normal(2));
  EXPECT_EQ(normal(3), (std::array<double, 3>{0, 0, 1}));
  EXPECT_NE(normal(0), normal(3));
  EXPECT_EQ(result.normals.values.size(), 2u); // without that of the back
  EXPECT_EQ(count_of_wrong_sides(result), 0u);
}

// Where two of four faces around a vertex come to lie so that its normal is none of theirs, the others go
// with them, but for one that has not changed.
TEST(Shading, HasNoCreaseWhereSomeNormalsAreMended)
{
  Triangle_soup original;
  original.points = {{0, 0, 0}, {1, 0, 0.1}, {0, 1, 0.1}, {-1, 0, 0.1}, {0, -1, 0.1}};
  original.triangles = {{0, 1, 2}, {0, 4, 1}, {0, 2, 3}, {0, 3, 4}};
  original.normals = {{{0.8, 0, 0.6}}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  for (const bool is_one_left : {false, true}) {
    Triangle_soup result = original;
    result.points[1] = {1, 0, 0.5}; // the first two are wrong
    result.points[2] = {0, 1, 0};
    if (!is_one_left)
      result.points[3] = {-1, 0, 0};
    EXPECT_GT(mend_normals(result, {0, 1, 2, 3}, original, original.normals), 2u);
    const auto normal = [&](std::size_t t) {
      return result.normals.values[result.normals.of_triangle[t][0]];
    };
    EXPECT_LT(normal(0)[0], 0);
    EXPECT_EQ(normal(0), normal(1));
    EXPECT_EQ(normal(0), normal(2));
    EXPECT_EQ(normal(3), is_one_left ? original.normals.values[0] : normal(0));
  }
}

// A small face on a rim may have a normal of its back before, and become large.
TEST(Shading, IsMendedWhereOneNormalWasOfTheBackBefore)
{
  Triangle_soup original;
  original.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  original.triangles = {{0, 1, 2}};
  original.normals = {{{0, 0.1, 1}, {0.8, 0, 0.6}, {0, 1, -0.1}}, {{0, 1, 2}}};
  for (const double side : {1, -1}) {
    for (auto& normal : original.normals.values)
      normal[2] = side * std::abs(normal[2]);
    original.normals.values[2][2] *= -1;
    Triangle_soup result = original;
    EXPECT_EQ(mend_normals(result, {0}, original, original.normals), 0u);
    result.normals.values[1] = {1, 0, -0.05 * side}; // no farther than the farthest was
    EXPECT_EQ(mend_normals(result, {0}, original, original.normals), 0u);
    result.normals.values[1] = {1, 0, -0.5 * side};
    EXPECT_EQ(mend_normals(result, {0}, original, original.normals), 1u);
    const auto normal = [&](std::size_t k) {
      return result.normals.values[result.normals.of_triangle[0][k]];
    };
    EXPECT_EQ(normal(1), (std::array<double, 3>{0, 0, side}));
    EXPECT_EQ(normal(2), original.normals.values[2]);
  }
}

TEST(Shading, OfFacesThatHaveNoMeanIsTheirOwn)
{
  // Two faces of a roof as steep as this have no common normal that is near to both.
  Triangle_soup original;
  original.points = {{0, 0, 0}, {0, 1, 0}, {-1, 0, -100}, {1, 0, -100}};
  original.triangles = {{0, 1, 2}, {1, 0, 3}};
  original.normals = {{{-1, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {1, 1, 1}}};
  Triangle_soup result = original;
  result.points[2] = {-1, 0, 100};
  result.points[3] = {1, 0, 100};
  result.normals = {{{0, 0, -1}}, {{0, 0, 0}, {0, 0, 0}}};
  mend_normals(result, {0, 1}, original, original.normals);
  for (Index t = 0; t < 2; ++t)
    for (const Index number : result.normals.of_triangle[t])
      EXPECT_NEAR(result.normals.values[number][0], t == 0 ? 1 : -1, 0.001);
}

// A large face, and two slivers that fold back under it, each so little from the last that they are one fan.
// Its mean is nearly the normal of the large face, which is the back of the last sliver.
TEST(Shading, OfAFaceFarFromTheMeanIsItsOwn)
{
  Triangle_soup original;
  original.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.06, 1, -0.08}, {-0.032, 1, -0.176}};
  original.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}; // 53° from the first to the second, and on
  original.normals = {{{0, 0, 1}, {-0.8, 0, 0.6}, {-0.96, 0, -0.28}}, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}};
  Triangle_soup result = original;
  for (auto& normal : result.normals.values)
    normal = {-normal[0], 0, -normal[2]};
  EXPECT_EQ(mend_normals(result, {0, 1, 2}, original, original.normals), 9u);
  EXPECT_EQ(count_of_wrong_sides(result), 0u);
  const auto normal = [&](std::size_t t) { return result.normals.values[result.normals.of_triangle[t][0]]; };
  EXPECT_EQ(normal(0), normal(1)); // the control: they have one
  EXPECT_LT(normal(2)[2], 0);
}

TEST(Shading, NeedsNoNormals)
{
  Triangle_soup result = hem();
  const Triangle_soup original = result;
  EXPECT_EQ(mend_normals(result, std::vector<Index>(original.triangles.size()), original, original.normals),
            0u);
  result.normals = {};
  EXPECT_EQ(mend_normals(result, {}, original, {}), 0u);
}
