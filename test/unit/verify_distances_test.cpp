// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/verify.h>

#include "support/soups.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace selvedge {
namespace {

using namespace test;

Triangle_soup random_soup(std::mt19937& random, int triangles)
{
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Point_3(coordinate(random), coordinate(random), coordinate(random)); };
  Triangle_soup soup;
  for (int i = 0; i < triangles; ++i) {
    const Point_3 p = point();
    const double size = std::pow(10, 2 * coordinate(random) - 2);
    const Index first = static_cast<Index>(soup.points.size());
    for (int k = 0; k < 3; ++k)
      soup.points.push_back(p + size * (point() - CGAL::ORIGIN));
    // Every eighth is a segment, every other eighth a point.
    soup.triangles.push_back(
        {first, i % 8 == 3 ? first : first + 1, i % 8 == 3 || i % 8 == 7 ? first : first + 2});
  }
  return soup;
}

/// Constructed exactly and over all pairs.
double exact_maximum_distance(const Triangle_soup& from, const Triangle_soup& to, double& root_mean_square)
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  const auto exact = [](const Point_3& p) { return Exact::Point_3(p.x(), p.y(), p.z()); };
  std::vector<bool> used(from.points.size());
  for (const Index_triple& triangle : from.triangles)
    for (const Index vertex : triangle)
      used[vertex] = true;
  double sum = 0, maximum = 0;
  for (std::size_t v = 0; v < from.points.size(); ++v) {
    if (!used[v])
      continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : to.triangles) {
      const Exact::Point_3 p = exact(to.points[a]), q = exact(to.points[b]), r = exact(to.points[c]);
      const Exact::Point_3 x = exact(from.points[v]);
      const Exact::FT squared = !CGAL::collinear(p, q, r)
                                    ? CGAL::squared_distance(x, Exact::Triangle_3(p, q, r))
                                : p != r ? CGAL::squared_distance(x, Exact::Segment_3(p, r))
                                : p != q ? CGAL::squared_distance(x, Exact::Segment_3(p, q))
                                         : CGAL::squared_distance(x, p);
      nearest = std::min(nearest, CGAL::to_double(squared));
    }
    sum += nearest;
    maximum = std::max(maximum, nearest);
  }
  root_mean_square = std::sqrt(sum / static_cast<double>(std::count(used.begin(), used.end(), true)));
  return std::sqrt(maximum);
}

TEST(Distance, IsThatOfExactConstructions)
{
  for (int seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Triangle_soup from = random_soup(random, 30), to = random_soup(random, 60);
    double root_mean_square = 0;
    const double maximum = exact_maximum_distance(from, to, root_mean_square);
    ASSERT_GT(maximum, 0.01);
    const Distance found = distance(from, to);
    EXPECT_NEAR(found.maximum, maximum, 1e-14);
    EXPECT_NEAR(found.root_mean_square, root_mean_square, 1e-14);
  }
}

// All pages of a book share one edge, so that every box holds most others.
TEST(Distance, IsThatOfExactConstructionsBetweenThePagesOfABook)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Triangle_soup book = soup({{0, 0, -1}, {0, 0, 1}}, {});
  for (int page = 0; page < 100; ++page) {
    const double angle = 0.0628318 * page, width = 1.5 + coordinate(random) / 2;
    book.points.emplace_back(width * std::cos(angle), width * std::sin(angle), coordinate(random));
    book.triangles.push_back({0, 1, Index(2 + page)});
  }
  for (int i = 0; i < 50; ++i) {
    const Point_3 p(coordinate(random), coordinate(random), coordinate(random));
    double root_mean_square = 0;
    const Triangle_soup from = soup({p}, {{0, 0, 0}});
    EXPECT_NEAR(distance(from, book).maximum, exact_maximum_distance(from, book, root_mean_square), 1e-15);
  }
}

TEST(Distance, IsThatOfAPointOnEverySide)
{
  const Triangle_soup target = one_triangle();
  const auto distance_of = [&](const Point_3& p) { return distance(soup({p}, {{0, 0, 0}}), target).maximum; };
  EXPECT_EQ(distance_of({1, 1, 3}), 3);     // over its inside
  EXPECT_EQ(distance_of({1, -2, 0}), 2);    // beside an edge
  EXPECT_EQ(distance_of({-3, -4, 0}), 5);   // off a corner
  EXPECT_EQ(distance_of({4, 0, 0}), 0);     // on a corner
  EXPECT_EQ(distance_of({1, 0.5, 0}), 0);   // within
  EXPECT_EQ(distance_of({-3, -4, 12}), 13); // off a corner, in all three directions
}

TEST(Distance, LooksAtUsedVerticesOnly)
{
  Triangle_soup from = one_triangle(), to = one_triangle();
  from.points.emplace_back(0, 0, 100);
  EXPECT_EQ(distance(from, to).maximum, 0);
  std::swap(from, to);
  from.points.emplace_back(0, 0, 100);
  from.triangles.push_back({0, 1, 3});
  EXPECT_EQ(distance(from, to).maximum, 100);
  EXPECT_EQ(distance(from, to).root_mean_square, 50); // one vertex of four
}

TEST(Distance, IsNotThatOfUnusedVerticesOfTheOther)
{
  Triangle_soup to = one_triangle();
  to.points.emplace_back(0, 0, 100);
  EXPECT_EQ(distance(soup({{0, 0, 100}}, {{0, 0, 0}}), to).maximum, 100);
}

// Vertices of both are looked up, and the surface is searched for the others alone.
TEST(Distance, IsZeroWhereTheOtherHasAVertexAndNowhereElse)
{
  Triangle_soup to, from;
  for (int i = 0; i < 4096; ++i) {
    const Point_3 p(i % 16 - 8, i / 16 % 16 - 8, i / 256 - 8.0);
    to.points.push_back(p);
    to.triangles.push_back({Index(i), Index(i), Index(i)});
    from.points.emplace_back(p.x() == 0 ? -0.0 : p.x(), p.y(), p.z());
  }
  from.triangles = to.triangles;
  EXPECT_EQ(distance(from, to).maximum, 0);
  for (Index i = 0; i < from.points.size(); i += 5)
    from.points[i] = Point_3(from.points[i].x(), from.points[i].y(), from.points[i].z() + 0x1p-40);
  const std::vector<double> distances = vertex_distances(from, to);
  for (Index i = 0; i < distances.size(); ++i)
    EXPECT_EQ(distances[i], i % 5 == 0 ? 0x1p-40 : 0) << i;
}

TEST(Distance, IsTheLargestOfThoseOfTheVertices)
{
  std::mt19937 random(7);
  const Triangle_soup from = random_soup(random, 20), to = random_soup(random, 20);
  const std::vector<double> distances = vertex_distances(from, to);
  const Distance all = distance(from, to);
  ASSERT_EQ(distances.size(), from.points.size());
  EXPECT_EQ(*std::max_element(distances.begin(), distances.end()), all.maximum);
  EXPECT_EQ(distances[all.farthest], all.maximum);
}

TEST(Distance, IsZeroFromNothingAndInfiniteToNothing)
{
  EXPECT_EQ(distance({}, {}).maximum, 0);
  EXPECT_EQ(distance({}, one_triangle()).root_mean_square, 0);
  EXPECT_EQ(distance(one_triangle(), {}).root_mean_square, std::numeric_limits<double>::infinity());
}

TEST(Distance, IsTheSameAtEveryScale)
{
  std::mt19937 random(1);
  const Triangle_soup from = random_soup(random, 30), to = random_soup(random, 60);
  const Distance expected = distance(from, to);
  for (const int exponent : {-900, -300, 300, 900}) {
    SCOPED_TRACE(exponent);
    const auto scaled = [&](const Point_3& p) {
      return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
    };
    const Distance found = distance(mapped(from, scaled), mapped(to, scaled));
    EXPECT_EQ(found.maximum, std::ldexp(expected.maximum, exponent));
    EXPECT_EQ(found.root_mean_square, std::ldexp(expected.root_mean_square, exponent));
  }
}

// A needle whose plane, in doubles, is anything: the distance is still that of a point of the needle.
TEST(Distance, IsNotMisledByNeedles)
{
  const double hair = std::ldexp(1, -52);
  const Triangle_soup needle = soup({{1, 1, 1}, {2, 2, 2}, {1.5, 1.5, 1.5 + hair}}, {{0, 1, 2}});
  for (const Point_3& p :
       {Point_3(1.5, 1.5, 4.5), Point_3(2, 1, 1.5), Point_3(0, 0, 0), Point_3(1.6, 1.6, 1.6)}) {
    double root_mean_square = 0;
    const Triangle_soup from = soup({p}, {{0, 0, 0}});
    EXPECT_NEAR(distance(from, needle).maximum, exact_maximum_distance(from, needle, root_mean_square),
                1e-15);
  }
}

// So far from zero that a coordinate is a few units in the last place apart.
TEST(Distance, IsAccurateFarFromZero)
{
  const auto far_away = [](double y, double z) { return Point_3(0, y * 0x1p-51, 1 + z * 0x1p-51); };
  const Triangle_soup triangle = soup({far_away(0, -1), far_away(1, 1), far_away(2, 0)}, {{1, 2, 0}});
  EXPECT_EQ(distance(soup({far_away(1, 0)}, {{0, 0, 0}}), triangle).maximum, 0); // within
  EXPECT_EQ(distance(soup({far_away(1, 3)}, {{0, 0, 0}}), triangle).maximum, 0x1p-50);
}

TEST(Distances, AreRelativeToTheDiagonalOfTheOriginal)
{
  // A sheet of 3 × 4 and a smaller one, twelve above a corner of it.
  const Distances found = distances(sheet(1, 1, 12), sheet(3, 4));
  EXPECT_EQ(found.diagonal, 5);
  EXPECT_DOUBLE_EQ(found.result_to_original.maximum, 12 / 5.0);
  EXPECT_DOUBLE_EQ(found.result_to_original.root_mean_square, 12 / 5.0);
  EXPECT_DOUBLE_EQ(found.original_to_result.maximum, std::sqrt(2 * 2 + 3 * 3 + 12 * 12) / 5);

  const Triangle_soup point = soup({{0, 0, 0}}, {{0, 0, 0}});
  EXPECT_EQ(distances(sheet(1, 1, 12), point).diagonal, 0);
  EXPECT_EQ(distances(sheet(1, 1, 12), point).original_to_result.maximum, 12);
}

} // namespace
} // namespace selvedge
