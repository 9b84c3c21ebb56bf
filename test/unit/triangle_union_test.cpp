// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Surface_mesh_simplification/internal/Triangle_union.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace selvedge::test {
namespace {

using internal::Triangle_union;
using Triangle = Triangle_union::Triangle;
using Point = Triangle_union::Point;
using Point_2 = std::array<double, 2>;
using Triangle_2 = std::array<Point_2, 3>;

constexpr double rounding = 1e-12;

// Into a plane askew to all axes.
Triangle lifted(const Triangle_2& flat)
{
  Triangle result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [x, y] = flat[i];
    result[i] = {0.3 * x + 0.1 * y, 0.7 * y - 0.2 * x, 0.45 * x + 0.15 * y};
  }
  return result;
}

// Twice the area of the triangle that a point makes with an edge.
double area(const Point_2& a, const Point_2& b, const Point_2& p)
{
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// How far inside a triangle a point is, as the least of three areas: negative when it is outside.
double depth(const Triangle_2& t, const Point_2& p)
{
  const double turn = area(t[0], t[1], t[2]) < 0 ? -1 : 1;
  return std::min({turn * area(t[0], t[1], p), turn * area(t[1], t[2], p), turn * area(t[2], t[0], p)});
}

// The lines through all sides divide the plane into convex cells, each of which has three corners, where
// lines meet, and their mean is inside it. So a cell that nothing covers shows at such a mean.
bool is_covered(const Triangle_2& triangle, const std::vector<Triangle_2>& others)
{
  std::vector<std::array<Point_2, 2>> lines;
  const auto add_sides = [&](const Triangle_2& t) {
    for (std::size_t i = 0; i < 3; ++i)
      lines.push_back({t[i], t[(i + 1) % 3]});
  };
  add_sides(triangle);
  std::for_each(others.begin(), others.end(), add_sides);
  std::vector<Point_2> corners;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto& [a, b] = lines[i];
      const double first = area(lines[k][0], lines[k][1], a), last = area(lines[k][0], lines[k][1], b);
      if (first == last)
        continue;
      const double share = first / (first - last);
      const Point_2 corner = {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
      if (depth(triangle, corner) > -1e-9)
        corners.push_back(corner);
    }
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Point_2 p = {(corners[i][0] + corners[j][0] + corners[k][0]) / 3,
                           (corners[i][1] + corners[j][1] + corners[k][1]) / 3};
        if (depth(triangle, p) > 1e-9 && std::all_of(others.begin(), others.end(), [&](const Triangle_2& t) {
              return depth(t, p) < -1e-9;
            }))
          return false;
      }
  return true;
}

TEST(Triangle_union, CoversWhatNoCellIsLeftOf)
{
  std::mt19937 random(3);
  std::uniform_int_distribution<int> coordinate(0, 3);
  const auto random_triangle = [&] {
    Triangle_2 t;
    do
      for (Point_2& p : t)
        p = {double(coordinate(random)), double(coordinate(random))};
    while (area(t[0], t[1], t[2]) == 0);
    return t;
  };
  int covered = 0, left = 0;
  for (int i = 0; i < 800; ++i) {
    const Triangle_2 triangle = random_triangle();
    std::vector<Triangle_2> others;
    Triangle_union all(rounding);
    for (int k = 0; k < 5; ++k) {
      others.push_back(random_triangle());
      all.add(lifted(others.back()));
    }
    const bool expected = is_covered(triangle, others);
    EXPECT_EQ(all.covers(lifted(triangle)), expected) << i;
    ++(expected ? covered : left);
  }
  EXPECT_GT(covered, 50);
  EXPECT_GT(left, 50);
}

// Triangles around a point inside, some of them needles.
TEST(Triangle_union, CoversWhatItDivides)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 300; ++i) {
    const Triangle whole = lifted({{{number(random), number(random)},
                                    {number(random), number(random)},
                                    {number(random), number(random)}}});
    const double b = std::pow(10, -4 * std::fabs(number(random))), c = (1 - b) * std::fabs(number(random));
    Point inside;
    for (std::size_t k = 0; k < 3; ++k)
      inside[k] = (1 - b - c) * whole[0][k] + b * whole[1][k] + c * whole[2][k];
    Triangle_union all(rounding), two(rounding);
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle part = {whole[k], whole[(k + 1) % 3], inside};
      all.add(part);
      if (k > 0)
        two.add(part);
    }
    EXPECT_TRUE(all.covers(whole)) << i;
    EXPECT_FALSE(two.covers(whole)) << i;
  }
}

TEST(Triangle_union, DoesNotCoverWhatIsBesideItsPlane)
{
  const Triangle triangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const auto moved = [&](double height) {
    Triangle result = triangle;
    result[2][2] += height;
    return result;
  };
  Triangle_union all(1e-3);
  EXPECT_FALSE(all.covers(triangle)) << "nothing covers nothing";
  all.add(triangle);
  EXPECT_TRUE(all.covers(triangle));
  EXPECT_TRUE(all.covers(moved(0.9e-3)));
  EXPECT_FALSE(all.covers(moved(1.1e-3)));
}

} // namespace
} // namespace selvedge::test
