// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What says that the points of a grid are near a surface: nearest points of triangles, grids, and the
// original.

#include <selvedge/Surface_mesh_simplification/internal/Original_surface.h>
#include <selvedge/Surface_mesh_simplification/internal/Triangle_grid.h>
#include <selvedge/internal/nearest_on_triangle.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace selvedge::test {
namespace {

using Doubles = CGAL::Simple_cartesian<double>;
using Double_point = Doubles::Point_3;
using Point_grid = internal::Triangle_grid;

class Random_points
{
public:
  double number(double size = 1) { return size * m_unit(m_random); }
  Doubles::Vector_3 vector(double size)
  {
    const double x = number(size), y = number(size), z = number(size);
    return {x, y, z};
  }
  Double_point point(double size) { return CGAL::ORIGIN + vector(size); }
  std::size_t below(std::size_t count) { return m_random() % count; }

  // A triangle, or now and then a needle, one without area, or a point.
  Point_grid::Triangle triangle()
  {
    const Double_point a = point(1);
    const Doubles::Vector_3 along = vector(1);
    const double share = (1 + number()) / 2;
    switch (below(5)) {
    case 0:
      return {a, a + share * along + vector(1e-6), a + along};
    case 1:
      return {a, a + along, a + along};
    case 2:
      return {a, a, a};
    default:
      return {a, a + along, a + vector(1)};
    }
  }

private:
  std::mt19937 m_random{1};
  std::uniform_real_distribution<double> m_unit{-1, 1};
};

TEST(NearestOnTriangle, IsTheNearestPoint)
{
  Random_points random;
  for (int i = 0; i < 20000; ++i) {
    const Point_grid::Triangle corners = random.triangle();
    const Double_point p = i % 3 == 0   ? CGAL::barycenter(corners[0], 0.5, corners[1], 0.3, corners[2], 0.2)
                           : i % 3 == 1 ? corners[random.below(3)] + random.vector(0.1)
                                        : random.point(2);
    const auto vector = [](const Double_point& q) {
      return internal::Vector_of_doubles{q.x(), q.y(), q.z()};
    };
    const internal::Nearest_on_triangle nearest = internal::nearest_on_triangle(
        {vector(corners[0]), vector(corners[1]), vector(corners[2])}, vector(p));
    const Double_point found(nearest.point[0], nearest.point[1], nearest.point[2]);
    const auto& weights = nearest.weights;
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-12);
    EXPECT_GE(*std::min_element(weights.begin(), weights.end()), -1e-9);
    const Double_point mixed =
        CGAL::barycenter(corners[0], weights[0], corners[1], weights[1], corners[2], weights[2]);
    EXPECT_NEAR(CGAL::squared_distance(mixed, found), 0, 1e-24);
    EXPECT_NEAR(nearest.squared_distance, CGAL::squared_distance(p, found), 1e-15);

    double least = CGAL::squared_distance(p, corners[0]);
    for (std::size_t k = 0; k < 3; ++k)
      if (corners[k] != corners[(k + 1) % 3])
        least =
            std::min(least, CGAL::squared_distance(p, Doubles::Segment_3(corners[k], corners[(k + 1) % 3])));
    const Doubles::Vector_3 normal = CGAL::cross_product(corners[1] - corners[0], corners[2] - corners[0]);
    if (normal.squared_length() > 1e-8)
      least =
          std::min(least, CGAL::squared_distance(p, Doubles::Triangle_3(corners[0], corners[1], corners[2])));
    EXPECT_NEAR(std::sqrt(nearest.squared_distance), std::sqrt(least), 1e-6);
  }
}

std::vector<Double_point> points_of_grid(const Point_grid& grid)
{
  std::vector<Double_point> result;
  grid.all_of([&](const Double_point& p) {
    result.push_back(p);
    return true;
  });
  return result;
}

// By barycentric coordinates in parts, as the definition has it.
std::vector<Double_point> points_by_definition(const Point_grid::Triangle& corners, int parts,
                                               const std::array<bool, 3>& sides)
{
  std::vector<Double_point> result;
  for (int a = 0; a < parts; ++a)
    for (int b = 0; b < parts && a + b <= parts; ++b) {
      const int c = parts - a - b;
      if (c == parts || (c == 0 && !sides[0]) || (a == 0 && !sides[1]) || (b == 0 && !sides[2]))
        continue;
      result.push_back(CGAL::barycenter(corners[0], double(a) / parts, corners[1], double(b) / parts,
                                        corners[2], double(c) / parts));
    }
  return result;
}

bool is_any_at(const std::vector<Double_point>& points, const Double_point& p)
{
  return std::any_of(points.begin(), points.end(),
                     [&](const Double_point& q) { return CGAL::squared_distance(p, q) < 1e-24; });
}

TEST(TriangleGrid, HasThePointsOfItsDefinition)
{
  Random_points random;
  for (int parts = 1; parts <= Point_grid::s_most_parts; ++parts)
    for (unsigned choice = 0; choice < 8; ++choice) {
      const std::array<bool, 3> sides{(choice & 1) != 0, (choice & 2) != 0, (choice & 4) != 0};
      const Point_grid::Triangle corners{random.point(1), random.point(1), random.point(1)};
      const std::vector<Double_point> points = points_of_grid(Point_grid(corners, parts, sides)),
                                      expected = points_by_definition(corners, parts, sides);
      EXPECT_EQ(points.size(), expected.size());
      for (const Double_point& p : expected)
        EXPECT_TRUE(is_any_at(points, p));
    }
  EXPECT_TRUE(points_of_grid(Point_grid()).empty());
}

TEST(TriangleGrid, PartsAreAsShortAsAsked)
{
  const Point_grid::Triangle corners{Double_point(0, 0, 0), Double_point(3, 0, 0), Double_point(0, 4, 0)};
  EXPECT_EQ(Point_grid::parts_of(corners, 5), 1);
  EXPECT_EQ(Point_grid::parts_of(corners, 4.99), 2);
  EXPECT_EQ(Point_grid::parts_of(corners, 1), 5);
  EXPECT_EQ(Point_grid::parts_of(corners, 1, 3), 3);
  EXPECT_EQ(Point_grid::parts_of(corners, 0), Point_grid::s_most_parts);
}

// A point removes the point of the grid that is nearest to it, and no point that is not near.
TEST(TriangleGrid, OnlyNearPointsAreRemoved)
{
  Random_points random;
  std::size_t removed = 0, kept = 0;
  for (int i = 0; i < 5000; ++i) {
    const Point_grid::Triangle corners = random.triangle();
    const int parts = 1 + int(random.below(Point_grid::s_most_parts));
    Point_grid grid(corners, parts, {true, true, true});
    std::vector<Double_point> left = points_of_grid(grid);
    for (int k = 0; k < 6; ++k) {
      const bool has_area =
          CGAL::cross_product(corners[1] - corners[0], corners[2] - corners[0]).squared_length() > 1e-4;
      const Double_point p =
          left.empty() || k % 2 == 0 ? random.point(1) : left[random.below(left.size())] + random.vector(0.1);
      const double squared = std::pow(10, -2 + random.number());
      grid.remove_near(p, squared);
      const std::vector<Double_point> now = points_of_grid(grid);
      const auto distance = [&](const Double_point& a) { return CGAL::squared_distance(p, a); };
      for (const Double_point& q : left) {
        const bool is_left = std::find(now.begin(), now.end(), q) != now.end();
        EXPECT_TRUE(is_left || distance(q) <= squared);
        ++(is_left ? kept : removed);
      }
      if (has_area && k == 1 && !left.empty()) {
        const Double_point nearest =
            *std::min_element(left.begin(), left.end(), [&](const Double_point& a, const Double_point& b) {
              return distance(a) < distance(b);
            });
        const double step = CGAL::squared_distance(corners[0], corners[1]) / (parts * parts);
        if (distance(nearest) < std::min(squared, 0.01 * step)) {
          EXPECT_EQ(std::find(now.begin(), now.end(), nearest), now.end());
        }
      }
      left = now;
    }
  }
  EXPECT_GT(removed, 1000u);
  EXPECT_GT(kept, 1000u);
}

// Triangles anywhere, of which many are slivers; or a curved sheet, in which each has neighbours, without
// some triangles.
std::vector<std::array<std::uint32_t, 3>> surface_scene(int number, Random_points& random,
                                                        std::vector<Double_point>& points)
{
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const Doubles::Vector_3 off(number, 0, 0);
  if (number % 2 == 0) {
    for (std::uint32_t i = 0; i < 100; ++i) {
      const Double_point start = random.point(1) + off;
      const Doubles::Vector_3 along = random.vector(1);
      const double share = i % 4 == 0 ? 0 : i % 4 == 1 ? 1 : (1 + random.number()) / 2;
      points.insert(points.end(),
                    {start, start + along, start + share * along + random.vector(i % 2 == 0 ? 0.01 : 0.5)});
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return triangles;
  }
  constexpr std::uint32_t width = 8;
  for (std::uint32_t i = 0; i < width; ++i)
    for (std::uint32_t j = 0; j < width; ++j)
      points.push_back(Double_point(0.25 * i - 1, 0.25 * j - 1, 0.2 * std::sin(i + 0.5 * j)) + off);
  for (std::uint32_t i = 0; i + 1 < width; ++i)
    for (std::uint32_t j = 0; j + 1 < width; ++j) {
      const std::uint32_t a = width * i + j;
      triangles.push_back({a, a + width, a + 1});
      if (random.below(8) > 0)
        triangles.push_back({a + 1, a + width, a + width + 1});
    }
  std::shuffle(triangles.begin(), triangles.end(), std::mt19937(1));
  return triangles;
}

TEST(OriginalSurface, IsNearWhatAnyTriangleIsNear)
{
  Random_points random;
  std::size_t near = 0, far = 0, beside = 0;
  for (int number = 0; number < 30; ++number) {
    std::vector<Double_point> points;
    const auto triangles = surface_scene(number, random, points);
    internal::Original_surface surface(points);
    for (const auto& triangle : triangles)
      surface.add(triangle);
    const auto triangle = [&](std::size_t i) {
      const auto& [a, b, c] = triangles[i];
      return Doubles::Triangle_3(points[a], points[b], points[c]);
    };
    const auto is_near_triangle = [&](const Double_point& p, double squared, std::size_t i) {
      return CGAL::squared_distance(p, triangle(i)) <= squared;
    };
    for (int i = 0; i < 2000; ++i) {
      // On triangles, at their corners, and anywhere.
      const std::size_t at = random.below(triangles.size());
      const Doubles::Triangle_3 t = triangle(at);
      const double a = (1 + random.number()) / 2, b = (1 - a) * (1 + random.number()) / 2;
      const Double_point query =
          i % 8 == 0 ? t[i / 8]
                     : t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]) + random.vector(i % 2 == 0 ? 0.02 : 0.2);
      const double squared = std::pow(10, (i % 16 == 0 ? -8 : -3) + random.number());
      bool is_near = false;
      for (std::size_t k = 0; k < triangles.size(); ++k)
        is_near |= is_near_triangle(query, squared, k);
      // What is found is a point of the surface, and near.
      const auto expect_near = [&](const std::optional<Double_point>& found) {
        if (!found)
          return;
        EXPECT_LE(CGAL::squared_distance(query, *found), squared * (1 + 1e-9));
        bool is_of_surface = false;
        for (std::size_t k = 0; k < triangles.size() && !is_of_surface; ++k)
          is_of_surface = CGAL::squared_distance(*found, triangle(k)) < 1e-20;
        EXPECT_TRUE(is_of_surface);
      };
      if (i % 4 == 0)
        surface.start_at(std::uint32_t(at));
      const std::optional<Double_point> found_beside = surface.near_point_beside(query, squared);
      beside += found_beside.has_value();
      expect_near(found_beside);
      const std::optional<Double_point> found = surface.near_point(query, squared);
      EXPECT_EQ(found.has_value(), is_near);
      expect_near(found);
      EXPECT_EQ(surface.near_point(query, squared, std::uint32_t(at)).has_value(),
                is_near_triangle(query, squared, at));
      ++(is_near ? near : far);
    }
    EXPECT_TRUE(surface.has_index());
  }
  EXPECT_GT(near, 10000u);
  EXPECT_GT(far, 1000u);
  EXPECT_GT(beside, 5000u);
}

// In a sheet, a walk from any triangle reaches another that is not far.
TEST(OriginalSurface, NeighboursAreFound)
{
  std::vector<Double_point> points;
  internal::Original_surface surface(points);
  constexpr std::uint32_t width = 40;
  for (std::uint32_t i = 0; i < width; ++i)
    for (std::uint32_t j = 0; j < width; ++j)
      points.emplace_back(i, j, 0);
  for (std::uint32_t i = 0; i + 1 < width; ++i)
    for (std::uint32_t j = 0; j + 1 < width; ++j) {
      const std::uint32_t a = width * i + j;
      surface.add({a, a + width, a + 1});
      surface.add({a + 1, a + width, a + width + 1});
    }
  // Far points let it find neighbours.
  for (int i = 0; i < 100; ++i)
    surface.near_point(Double_point(0, 0, 100), 1);
  for (std::uint32_t i = 0; i + 3 < width; ++i)
    for (std::uint32_t j = 0; j + 3 < width; ++j) {
      surface.start_at(2 * ((width - 1) * i + j));
      EXPECT_TRUE(surface.near_point_beside(Double_point(i + 2.4, j + 1.3, 0), 1e-6));
    }
}

} // namespace
} // namespace selvedge::test
