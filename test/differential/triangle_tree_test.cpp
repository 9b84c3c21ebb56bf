// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "verify/Triangle_tree.h"

#include "support/soups.h"

#include <selvedge/verify.h>

#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <random>
#include <set>
#include <utility>

namespace selvedge {
namespace {

using namespace test;
using Sliver_pairs = std::set<std::pair<Index, Index>>;

Sliver_pairs pairs_in_tree(const Triangle_soup& soup)
{
  Sliver_pairs pairs;
  std::mutex mutex;
  Triangle_tree(soup.points, soup.triangles, Triangle_tree::Search::pairs)
      .for_each_pair([&](Index i, Index j) {
        const std::lock_guard<std::mutex> lock(mutex);
        EXPECT_TRUE(pairs.insert(std::minmax(i, j)).second) << i << ' ' << j;
      });
  return pairs;
}

/// Slivers of width up to `width` along a direction that all share, but for `spread` at random. Some start
/// where others have a corner, and some are reflected at a corner of another, so that only rounding keeps
/// capsules around the two from being tangent.
Triangle_soup random_slivers(unsigned seed, Index count, double width, double spread)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) {
    const double x = unit(random), y = unit(random), z = unit(random);
    return Kernel::Vector_3(size * x, size * y, size * z);
  };
  const Kernel::Vector_3 direction = vector(1);
  Triangle_soup result;
  for (Index i = 0; i < count; ++i) {
    if (i % 8 == 6) {
      const Point_3 *q = &result.points[3 * i - 3], apex = q[2];
      result.points.insert(result.points.end(), {apex + (apex - q[0]), apex + (apex - q[1]), apex});
      result.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      continue;
    }
    const Point_3 start = i % 8 == 7 ? result.points[random() % result.points.size()]
                                     : Point_3(0, 0, 0) + vector(i % 2 == 0 ? 1 : 4 * width);
    const Kernel::Vector_3 along = direction + vector(spread);
    const Point_3 apex = start + (unit(random) + 1) / 2 * along + vector(width);
    result.points.insert(result.points.end(), {start, start + along, apex});
    result.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return result;
}

// Parallel ribbons of two layers, each of `segments` long quads, or such ribbons bent to an arc.
Triangle_soup fringe(Index ribbons, Index segments, double bend)
{
  const Kernel::Vector_3 along(1, 1.01, 0.99), across(1, -1, 0), up(0.3, 0.4, -0.7);
  const double step = 1.0 / ribbons;
  Triangle_soup result;
  for (Index i = 0; i < ribbons; ++i)
    for (Index k = 0; k <= segments; ++k) {
      const double t = double(k) / segments;
      const Point_3 p =
          Point_3(0, 0, 0) + 10 * t * along + (i * step) * across + (i % 2 * step + bend * t * t) * up;
      const Index first = Index(result.points.size());
      result.points.push_back(p);
      result.points.push_back(p + 0.8 * step * across);
      if (k < segments) {
        result.triangles.push_back({first, first + 1, first + 3});
        result.triangles.push_back({first, first + 3, first + 2});
      }
    }
  return result;
}

TEST(TriangleTree, FindsAllSliversThatMeet)
{
  std::size_t meeting = 0, boxes = 0, found = 0;
  for (unsigned seed = 0; seed < 240; ++seed) {
    SCOPED_TRACE(seed);
    const double width = std::ldexp(1, -3 - int(seed % 12)), spread = seed % 3 == 0 ? 1 : 4 * width;
    Triangle_soup soup = random_slivers(seed, 96, width, spread);
    if (seed % 4 == 1)
      soup = moved(soup, 1e6, -3e5, 2e7);
    else if (const int exponent = seed % 4 == 2 ? -150 : seed % 4 == 3 ? 150 : 0; exponent != 0)
      soup = mapped(soup, [&](const Point_3& p) {
        return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
      });
    const Sliver_pairs pairs = pairs_in_tree(soup);
    found += pairs.size();
    const auto triangle = [&](Index i) {
      const auto& [a, b, c] = soup.triangles[i];
      return Kernel::Triangle_3(soup.points[a], soup.points[b], soup.points[c]);
    };
    for (Index j = 0; j < soup.triangles.size(); ++j)
      for (Index i = 0; i < j; ++i) {
        boxes += CGAL::do_overlap(triangle(i).bbox(), triangle(j).bbox());
        if (triangle(i).is_degenerate() || triangle(j).is_degenerate() ||
            !CGAL::do_intersect(triangle(i), triangle(j)))
          continue;
        ++meeting;
        EXPECT_EQ(pairs.count({i, j}), 1U) << i << ' ' << j;
      }
  }
  EXPECT_GT(meeting, 5000U);
  EXPECT_GT(boxes, 2 * found); // capsules leave out most of the others
}

TEST(TriangleTree, FindsFewPairsInAFringeOfAnySize)
{
  for (const Index ribbons : {125U, 250U, 500U, 1000U, 2000U})
    for (const double bend : {0.0, 8.0}) {
      const Triangle_soup soup = fringe(ribbons, 4, bend);
      EXPECT_LT(pairs_in_tree(soup).size(), 20 * soup.triangles.size()) << ribbons << ' ' << bend;
    }
}

/// Triangles that share a corner, point 0. On a grid, many of them lie in one plane, on one line, or twice at
/// one place; in a plane, some lie so near to others that only exact arithmetic tells whether they overlap.
enum class Fan_kind { anywhere, on_grid, in_plane };

Triangle_soup random_fan(unsigned seed, Index count, Fan_kind kind)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] {
    if (kind == Fan_kind::on_grid)
      return Point_3(int(random() % 5) - 2, int(random() % 5) - 2, int(random() % 5) - 2);
    const double x = unit(random), y = unit(random), z = unit(random);
    return Point_3(x, y, kind == Fan_kind::in_plane ? 0 : z);
  };
  const Point_3 apex = any();
  Triangle_soup result;
  result.points = {apex};
  for (Index i = 0; i < count; ++i) {
    Point_3 a = any(), b = kind == Fan_kind::on_grid ? any() : a + 0.1 * (any() - apex);
    if (kind != Fan_kind::on_grid && i % 2 == 1) // where the one before ends, seen from the apex
      a = apex + (unit(random) + 1.5) / 3 * (result.points[2 * i] - apex);
    result.points.insert(result.points.end(), {a, b});
    result.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  }
  return result;
}

TEST(TriangleTree, FindsAllThatMeetBeyondTheCornerOfAFan)
{
  std::size_t left_out = 0;
  for (unsigned seed = 0; seed < 96; ++seed) {
    SCOPED_TRACE(seed);
    Triangle_soup soup = random_fan(seed, 64, Fan_kind(seed % 3));
    if (seed % 2 == 1) // a second fan through the first
      soup = joined(soup, random_fan(seed + 1000, 90, Fan_kind(seed % 3)));
    // Differences of coordinates and their quotients are too large or too small for normal numbers.
    const int size = seed / 3 % 4, exponent = size == 1 ? -1070 : size == 2 ? 1022 : 0;
    soup = mapped(soup, [&](const Point_3& p) {
      return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), size == 3 ? -1060 : exponent),
                     std::ldexp(p.z(), exponent));
    });
    const Sliver_pairs pairs = pairs_in_tree(soup);
    for (Index j = 0; j < soup.triangles.size(); ++j)
      for (Index i = 0; i < j; ++i) {
        if (pairs.count({i, j}) == 1)
          continue;
        ++left_out;
        for (const Offending_pair& pair :
             offending_pairs(test::soup(soup.points, {soup.triangles[i], soup.triangles[j]})))
          EXPECT_EQ(pair.offence, Offence::degenerate) << i << ' ' << j;
      }
  }
  EXPECT_GT(left_out, 100000U);
}

/// A fan around point 0, whose other points lie above a circle; `z` gives the height at an angle.
template <class Function>
Triangle_soup fan(Index count, const Point_3& apex, const Function& z)
{
  Triangle_soup result;
  result.points = {apex};
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * CGAL_PI * i / count;
    result.points.emplace_back(std::cos(angle), std::sin(angle), z(angle));
    result.triangles.push_back({0, i + 1, (i + 1) % count + 1});
  }
  return result;
}

TEST(TriangleTree, FindsFewPairsInAFanOfAnySize)
{
  const auto flat = [](double) { return 0.0; };
  for (const Index count : {500U, 10000U}) {
    const Triangle_soup disc = fan(count, Point_3(0, 0, 0), flat);
    const Triangle_soup polygon = fan(count, Point_3(-1, 0, 0), flat);
    const Triangle_soup cone = fan(count, Point_3(0, 0, 1), flat);
    const Triangle_soup saddle =
        fan(count, Point_3(0, 0, 0), [](double angle) { return std::cos(2 * angle); });
    // Two sheets at one position, and ordinary triangles around and between.
    const Triangle_soup sheets = joined(fan(count, Point_3(0, 0, 0), [](double) { return -0.5; }), saddle);
    const Triangle_soup among = joined(moved(sheet(80, 80, 1.5), -40.5, -40.25, 0), joined(cone, saddle));
    for (const Triangle_soup* soup : {&disc, &polygon, &cone, &saddle, &sheets, &among})
      EXPECT_LT(pairs_in_tree(*soup).size(), 20 * soup->triangles.size()) << count;
  }
}

// The squared distance of a query from all triangles, and how many were asked, from a first guess.
std::pair<double, std::size_t> approached(const Triangle_tree& tree, const Triangle_soup& soup,
                                          const Point_3& query, double squared_bound)
{
  std::size_t asked = 0;
  tree.approach(query, squared_bound, [&](Index i) {
    ++asked;
    const auto& [a, b, c] = soup.triangles[i];
    const Kernel::Triangle_3 triangle(soup.points[a], soup.points[b], soup.points[c]);
    squared_bound = (std::min)(squared_bound, CGAL::squared_distance(query, triangle));
  });
  return {squared_bound, asked};
}

TEST(TriangleTree, FindsTheSliverThatIsNearest)
{
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const double width = std::ldexp(1, -3 - int(seed % 12));
    Triangle_soup soup = random_slivers(seed, 96, width, seed % 3 == 0 ? 1 : 4 * width);
    if (seed % 2 == 1)
      soup = moved(soup, 1e6, -3e5, 2e7);
    const Triangle_tree tree(soup.points, soup.triangles);
    Triangle_soup far = soup;
    far.points[0] = far.points[0] + Kernel::Vector_3(1e3, 1e3, 1e3);
    for (const Triangle_soup* queries : {&soup, &far})
      for (std::size_t k = 0; k < soup.points.size(); ++k) {
        const Point_3 query = CGAL::midpoint(queries->points[0], queries->points[k]);
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : soup.triangles)
          least =
              std::min(least, CGAL::squared_distance(
                                  query, Kernel::Triangle_3(soup.points[a], soup.points[b], soup.points[c])));
        EXPECT_EQ(approached(tree, soup, query, std::numeric_limits<double>::infinity()).first, least);
      }
  }
}

// Numbers that are one in single precision.
TEST(TriangleTree, FindsTheNearestOfPointsThatAreHardlyApart)
{
  for (const double size : {1.0, 0x1p400, 0x1p-400})
    for (int place = 0; place < 200; ++place) {
      SCOPED_TRACE(place);
      Triangle_soup points;
      for (Index i = 0; i < 64; ++i) {
        const double x = (1 + place * 0.001 + (i * 37 % 64) * 0x1p-45) * size;
        points.points.emplace_back(place % 2 == 0 ? x : -x, 0, 0);
        points.triangles.push_back({i, i, i});
      }
      points.points.emplace_back(-8 * size, 5 * size, 0);
      points.triangles.push_back({64, 64, 64});
      const Triangle_tree tree(points.points, points.triangles);
      const Point_3 query(0, 0.25 * size, 0);
      double least = std::numeric_limits<double>::infinity();
      for (const Point_3& p : points.points)
        least = std::min(least, CGAL::squared_distance(query, p));
      for (Index i = 0; i < 64; ++i) { // a guess, from which a search starts
        double bound = CGAL::squared_distance(query, points.points[i]);
        tree.approach(query, bound, [&](Index k) {
          bound = std::min(bound, CGAL::squared_distance(query, points.points[k]));
        });
        EXPECT_EQ(bound, least) << i;
      }
    }
}

TEST(TriangleTree, VisitsEveryTriangleWhoseBoxIsTouched)
{
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Triangle_soup soup = random_slivers(seed, 96, 0.1, 1);
    if (seed % 4 == 1)
      soup = moved(soup, 1e6, -3e5, 2e7);
    else if (seed % 4 > 1)
      soup = mapped(soup, [&](const Point_3& p) {
        const int exponent = seed % 4 == 2 ? -1060 : 1018;
        return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
      });
    const Triangle_tree tree(soup.points, soup.triangles);
    for (Index i = 0; i < soup.triangles.size(); ++i) {
      const auto& [a, b, c] = soup.triangles[i];
      const CGAL::Bbox_3 box = soup.points[a].bbox() + soup.points[b].bbox() + soup.points[c].bbox();
      for (const Point_3& corner :
           {Point_3(box.xmin(), box.ymin(), box.zmin()), Point_3(box.xmax(), box.ymax(), box.zmax())}) {
        std::set<Index> visited;
        tree.visit([&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(corner.bbox(), other); },
                   [&](Index k) { EXPECT_TRUE(visited.insert(k).second); });
        EXPECT_EQ(visited.count(i), 1U) << i;
      }
    }
  }
}

TEST(TriangleTree, AsksFewTrianglesOfAFringeOfAnySizeForTheirDistance)
{
  for (const Index ribbons : {250U, 2000U}) {
    const Triangle_soup soup = fringe(ribbons, 4, 8.0);
    const Triangle_tree tree(soup.points, soup.triangles);
    std::size_t asked = 0;
    for (const Point_3& point : soup.points)
      asked += approached(tree, soup, point, 0.25 / ribbons / ribbons).second;
    EXPECT_LT(asked, 20 * soup.points.size()) << ribbons;
  }
}

} // namespace
} // namespace selvedge
