// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Texture coordinates of vertices at new places, fitted to those of the original.

#include "soup/fit_texture.h"
#include "soup/number_positions.h"
#include "support/soups.h"

#include <selvedge/prepare.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace selvedge::test {
namespace {

using Uv = std::array<double, 2>;

const auto unrounded = [](Index, const Uv& uv) { return uv; };

/// A sheet of squares with the texture coordinates (x², y).
Triangle_soup stretched_sheet(int size)
{
  Triangle_soup soup = sheet(size, size);
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.x() * p.x(), p.y()});
  soup.uvs.of_triangle = soup.triangles;
  return soup;
}

/// The root mean square displacement of the texture of a sheet in the plane, at points of its faces.
double displacement(const Triangle_soup& result)
{
  double sum = 0, weights = 0;
  constexpr int steps = 48;
  for (Index t = 0; t < result.triangles.size(); ++t) {
    const auto& [a, b, c] = result.triangles[t];
    const double area = std::sqrt(CGAL::squared_area(result.points[a], result.points[b], result.points[c]));
    for (int i = 1; i < steps; ++i)
      for (int j = 1; i + j < steps; ++j) {
        const std::array<double, 3> at = {double(i) / steps, double(j) / steps,
                                          double(steps - i - j) / steps};
        double x = 0, y = 0;
        Uv uv{};
        for (std::size_t k = 0; k < 3; ++k) {
          const Point_3& p = result.points[result.triangles[t][k]];
          x += at[k] * p.x();
          y += at[k] * p.y();
          for (std::size_t axis = 0; axis < 2; ++axis)
            uv[axis] += at[k] * result.uvs.values[result.uvs.of_triangle[t][k]][axis];
        }
        sum += area * (std::pow(uv[0] - x * x, 2) + std::pow(uv[1] - y, 2));
        weights += area;
      }
  }
  return std::sqrt(sum / weights);
}

struct Fan
{
  Triangle_soup original, result;
  std::vector<Index> triangles;
  std::vector<char> is_free;
};

/// A sheet, and what is left of it: four triangles around its middle, which is free.
Fan fan(int size, const Uv& uv_of_middle)
{
  Fan fan{stretched_sheet(size), {}, {}, {}};
  const double n = size;
  fan.result.points = {{0, 0, 0}, {n, 0, 0}, {n, n, 0}, {0, n, 0}, {n / 2, n / 2, 0}};
  fan.result.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  fan.result.uvs.values = {{0, 0}, {n * n, 0}, {n * n, n}, {0, n}, uv_of_middle};
  fan.result.uvs.of_triangle = fan.result.triangles;
  fan.triangles = {0, 1, 2, 3};
  fan.is_free = {0, 0, 0, 0, 1};
  return fan;
}

template <class Stored>
Uv fitted_middle(const Fan& fan, const Stored& stored)
{
  std::vector<Index_triple> corners;
  for (const Index t : fan.triangles)
    corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  const std::vector<Index> positions = number_positions(fan.original.points);
  const Fitted_surface surface(fan.result, fan.triangles, corners, fan.original, positions);
  return fitted_texture(surface, fan.is_free, stored)[4];
}

Uv fitted_middle(const Fan& fan)
{
  return fitted_middle(fan, unrounded);
}

TEST(FitTexture, DisplacesTheTextureLessThanItsValueAtTheVertexDoes)
{
  Fan fan = test::fan(8, {16, 4});
  const double before = displacement(fan.result);
  const Uv fitted = fitted_middle(fan);
  fan.result.uvs.values[4] = fitted;
  EXPECT_LT(displacement(fan.result), 0.9 * before);
  EXPECT_NEAR(fitted[1], 4, 1e-9);
  // The coordinates at the corners are too large everywhere between: those of the middle become smaller.
  EXPECT_LT(fitted[0], 15);
}

TEST(FitTexture, IsTheLeastOfAllDisplacements)
{
  Fan fan = test::fan(32, {256, 16});
  const Uv fitted = fitted_middle(fan);
  const auto displacement_at = [&](double u) {
    fan.result.uvs.values[4] = {u, fitted[1]};
    return displacement(fan.result);
  };
  double best = 256;
  for (double u = 0; u < 512; u += 1)
    if (displacement_at(u) < displacement_at(best))
      best = u;
  // The coordinate that was there counts a little.
  EXPECT_LT(std::abs(fitted[0] - best), 0.15 * std::abs(256 - best));
}

TEST(FitTexture, TurnsNoTriangleOverAndGoesAPartOfTheWay)
{
  for (const double before : {16, 12}) { // which need one halving, and two
    Fan fan = test::fan(8, {before, 4});
    // The original says that the middle belongs beyond the side u = 0.
    for (Uv& uv : fan.original.uvs.values)
      uv[0] = 64 - 96 * std::sin(uv[0] / 64 * 3.141592653589793);
    for (std::size_t v = 0; v < 4; ++v)
      fan.result.uvs.values[v][0] = v == 1 || v == 2 ? 64 : 0;
    const Uv fitted = fitted_middle(fan);
    EXPECT_NE(fitted[0], before);
    EXPECT_GT(fitted[0], 0);
    EXPECT_LT(fitted[0], 64);
  }
}

// A face that is elsewhere now is a sample where it was, though none of its vertices is at a new place.
TEST(FitTexture, AsksFacesThatHaveChanged)
{
  Fan fan = test::fan(8, {16, 4});
  fan.result.points.emplace_back(6, 4, 0);
  fan.result.uvs.values.push_back({36, 4});
  fan.result.triangles[1] = {1, 2, 5};
  fan.result.triangles.insert(fan.result.triangles.end(), {{1, 5, 4}, {5, 2, 4}});
  fan.result.uvs.of_triangle = fan.result.triangles;
  fan.is_free.push_back(false);
  fan.triangles = {0, 1, 2, 3, 4, 5};
  const Uv fitted = fitted_middle(fan);
  EXPECT_NE(fitted, (Uv{16, 4}));
  fan.triangles[1] = 60;
  EXPECT_EQ(fitted_middle(fan), fitted);
}

TEST(FitTexture, StaysInTheRangeOfTheOriginal)
{
  Fan fan = test::fan(8, {16, 4});
  // Triangles without area in the texture do not turn over.
  for (std::size_t v = 0; v < 4; ++v)
    fan.result.uvs.values[v] = {64, 4};
  fan.result.uvs.values[4] = {1, 4};
  for (Uv& uv : fan.original.uvs.values)
    uv = {uv[0] / 4, 4};
  const Uv fitted = fitted_middle(fan);
  EXPECT_GE(fitted[0], 0);
  EXPECT_LE(fitted[0], 16);
}

TEST(FitTexture, DoesNotAskOtherCharts)
{
  Fan fan = test::fan(8, {16, 4});
  const Uv alone = fitted_middle(fan);
  // A second sheet nearby has the texture elsewhere, and none of its triangles is left.
  Triangle_soup sheet = stretched_sheet(8);
  for (Point_3& p : sheet.points)
    p = Point_3(p.x(), p.y(), 0.125);
  const Index points = Index(fan.original.points.size());
  fan.original.points.insert(fan.original.points.end(), sheet.points.begin(), sheet.points.end());
  for (const Uv& uv : sheet.uvs.values)
    fan.original.uvs.values.push_back({uv[0] + 5, uv[1] + 5});
  for (Index_triple triangle : sheet.triangles) {
    for (Index& v : triangle)
      v += points;
    fan.original.triangles.push_back(triangle);
    fan.original.uvs.of_triangle.push_back(triangle);
  }
  EXPECT_EQ(fitted_middle(fan), alone);
}

TEST(FitTexture, DoesNotAskBeyondACut)
{
  Fan fan = test::fan(8, {16, 4});
  // A narrow strip leads to another part of the texture.
  for (std::size_t v = 0; v < fan.original.points.size(); ++v)
    if (fan.original.points[v].x() > 6)
      fan.original.uvs.values[v][0] = 1000;
  const Uv fitted = fitted_middle(fan);
  EXPECT_LT(fitted[0], 15);
  EXPECT_GT(fitted[0], 0);
}

TEST(FitTexture, GivesWhatIsStored)
{
  const Fan fan = test::fan(8, {16, 4});
  const auto whole = [](Index, const Uv& uv) { return Uv{std::nearbyint(uv[0]), std::nearbyint(uv[1])}; };
  const Uv fitted = fitted_middle(fan, whole);
  EXPECT_EQ(fitted, (Uv{std::nearbyint(fitted_middle(fan)[0]), 4}));
}

TEST(FitTexture, IsDoneLaterAsItIsAtOnce)
{
  Triangle_soup soup = stretched_sheet(24);
  for (Point_3& p : soup.points) {
    p = Point_3(p.x(), p.y(), std::sin(p.x()));
    const double slope = std::cos(p.x()), length = std::hypot(slope, 1);
    soup.normals.values.push_back({-slope / length, 0, 1 / length});
  }
  soup.normals.of_triangle = soup.triangles;
  Prepare_options prepare_options;
  prepare_options.normals = Normals_choice::automatic;
  const Prepared_soup prepared = prepare(soup, prepare_options);
  Simplify_options options;
  options.ratio = 0.2;
  options.placement = Placement::optimal;
  const Simplified_soup at_once = simplify_soup(prepared, options);
  options.are_values_fitted = false;
  Simplified_soup later = simplify_soup(prepared, options);
  EXPECT_EQ(later.fitted_texture + later.fitted_normals, 0u);
  EXPECT_NE(later.soup.uvs.values, at_once.soup.uvs.values);
  EXPECT_NE(later.soup.normals.values, at_once.soup.normals.values);
  fit_values(later, prepared);
  EXPECT_GT(later.fitted_texture, 0u);
  EXPECT_GT(later.fitted_normals, 0u);
  EXPECT_EQ(later.fitted_texture, at_once.fitted_texture);
  EXPECT_EQ(later.fitted_normals, at_once.fitted_normals);
  EXPECT_EQ(later.soup.uvs.values, at_once.soup.uvs.values);
  EXPECT_EQ(later.soup.uvs.of_triangle, at_once.soup.uvs.of_triangle);
  EXPECT_EQ(later.soup.normals.values, at_once.soup.normals.values);
  EXPECT_EQ(later.soup.normals.of_triangle, at_once.soup.normals.of_triangle);
}

TEST(FitTexture, IsDoneAtNewPlacesAlone)
{
  const Triangle_soup soup = stretched_sheet(24);
  const Prepared_soup prepared = prepare(soup);
  for (const Placement placement : {Placement::optimal, Placement::vertices}) {
    Simplify_options options;
    options.ratio = 0.1;
    options.placement = placement;
    const Simplified_soup reduced = simplify_soup(prepared, options);
    EXPECT_EQ(reduced.fitted_texture > 0, placement == Placement::optimal);
    EXPECT_LE(reduced.fitted_texture, reduced.placed_vertices);
    std::size_t others = 0;
    for (Index v = 0; v < reduced.soup.points.size(); ++v) {
      const Point_3& p = reduced.soup.points[v];
      const bool is_kept = p.x() == std::floor(p.x()) && p.y() == std::floor(p.y());
      for (Index t = 0; t < reduced.soup.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
          if (reduced.soup.triangles[t][k] == v) {
            const Uv& uv = reduced.soup.uvs.values[reduced.soup.uvs.of_triangle[t][k]];
            if (is_kept && (p.x() == 0 || p.x() == 24 || p.y() == 0 || p.y() == 24)) {
              EXPECT_EQ(uv, (Uv{p.x() * p.x(), p.y()}));
            }
            others += uv != Uv{p.x() * p.x(), p.y()};
          }
    }
    EXPECT_EQ(others > 0, placement == Placement::optimal);
  }
}

} // namespace
} // namespace selvedge::test
