// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "verify/Covering.h"

#include "support/soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace selvedge {
namespace {

using namespace internal;
using namespace test;

constexpr double infinity = std::numeric_limits<double>::infinity();

using Corners = std::array<Point_3, 3>;

std::optional<Covering_search::Farthest> farthest(const Corners& corners, const Triangle_soup& from,
                                                  const Index_triple& near = {0, 0, 0},
                                                  double limit = infinity)
{
  const Surface surface(from, 0);
  const Neighbours neighbours(surface);
  return Covering_search(neighbours).farthest(corners, near, limit);
}

double squared_distance(const Point_3& point, const Surface& surface)
{
  double least = infinity;
  for (Index t = 0; t < surface.triangles.size(); ++t)
    least = std::min(least, CGAL::squared_distance(point, nearest_on_triangle(point, surface.triangle(t))));
  return least;
}

const Corners over_many = {Point_3(0.5, 0.5, 2), Point_3(5.5, 0.75, 2), Point_3(2, 4.5, 2)};

TEST(Covering, IsMadeAcrossSeamsAndWhateverWayFacesRun)
{
  const Triangle_soup flat = sheet(6, 6);
  Triangle_soup turned = unshared(flat);
  for (std::size_t t = 0; t < turned.triangles.size(); t += 3)
    std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  for (const Triangle_soup& soup : {flat, turned}) {
    const auto found = farthest(over_many, soup);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->squared_distance, 4);
  }
}

TEST(Covering, FindsTheValleyUnderATriangle)
{
  const Triangle_soup valley = mapped(
      sheet(6, 6), [](const Point_3& p) { return p.x() == 2 && p.y() == 2 ? p + Vector_3(0, 0, -7) : p; });
  const auto found = farthest(over_many, valley);
  ASSERT_TRUE(found);
  EXPECT_LT(CGAL::squared_distance(found->point, Point_3(2, 2, 2)), 1e-24);
  EXPECT_GE(found->squared_distance, squared_distance(found->point, Surface(valley, 0)));
  EXPECT_GT(found->squared_distance, 4);
  EXPECT_FALSE(farthest(over_many, valley, {0, 0, 0}, found->squared_distance)) << "the limit is not reached";
}

TEST(Covering, FailsOverAHoleABorderAndAFold)
{
  Triangle_soup hole = sheet(6, 6);
  hole.triangles.erase(hole.triangles.begin() + 2 * (2 * 6 + 2)); // at (2, 2)
  EXPECT_FALSE(farthest(over_many, hole));
  EXPECT_FALSE(farthest(over_many, sheet(6, 4)));
  const Triangle_soup fold =
      mapped(sheet(6, 6), [](const Point_3& p) { return p.x() < 5 ? p : Point_3(9 - p.x(), p.y(), 1); });
  EXPECT_FALSE(farthest(over_many, fold));
  EXPECT_FALSE(farthest({Point_3(1, 1, 0), Point_3(2, 2, 0), Point_3(3, 3, 0)}, sheet(6, 6))) << "a segment";
}

// Corners at vertices of the surface, sides along its edges: what only touches the triangle is no matter.
TEST(Covering, EndsAtWhatTouchesTheTriangle)
{
  const auto found =
      farthest({Point_3(0, 0, 0), Point_3(6, 0, 0), Point_3(6, 6, 0)}, sheet(6, 6), {71, 71, 71});
  ASSERT_TRUE(found);
  EXPECT_LT(found->squared_distance, 1e-27);
}

TEST(Covering, IgnoresWhatIsBehindAnEdgeThatTouchesASide)
{
  Triangle_soup hole =
      mapped(sheet(6, 6), [](const Point_3& p) { return p.x() == 4 && p.y() == 3 ? Point_3(4, 2.5, 0) : p; });
  hole.triangles.erase(hole.triangles.begin() + 2 * (2 * 6 + 3) + 1); // from (3, 3) to (4, 2.5) is a border
  EXPECT_TRUE(farthest({Point_3(0.5, 3, 0), Point_3(5.5, 3, 0), Point_3(3, 5, 0)}, hole));
}

// Sheets with bumps, creases, folds, holes, seams, fins and turned faces, and triangles that have their
// corners anywhere, or at vertices of the sheet.
TEST(Covering, BoundsTheDistanceOfEveryPoint)
{
  std::size_t covered = 0, cases = 0;
  for (int seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    const auto one_of = [&](const std::vector<double>& values) { return values[random() % values.size()]; };
    const double height = one_of({0, 0.02, 0.3, 2}), shift = one_of({0, 0.3, 0.6});
    const double crease = one_of({0, 0, 1, 8}), fold = one_of({9, 9, 4});
    const auto wide = [&](double width) { return width * (share(random) - 0.5); };
    constexpr Index width = 6;
    Triangle_soup soup = mapped(sheet(width, width), [&](const Point_3& p) {
      const double x = p.x() + wide(shift), y = p.y() + wide(shift), z = wide(height);
      return Point_3(x < fold ? x : 2 * fold - x, y,
                     z + crease * std::max(0.0, x - 3) + (x < fold ? 0 : 0.1));
    });
    const double angle = 7 * share(random);
    soup = mapped(soup, [&](const Point_3& p) {
      return Point_3(p.x(), std::cos(angle) * p.y() - std::sin(angle) * p.z(),
                     std::sin(angle) * p.y() + std::cos(angle) * p.z());
    });
    for (std::size_t i = one_of({0, 0, 1, 4}); i > 0; --i)
      soup.triangles.erase(soup.triangles.begin() + std::ptrdiff_t(random() % soup.triangles.size()));
    for (std::size_t i = one_of({0, 2}); i > 0; --i) { // fins on edges
      Index_triple fin = soup.triangles[random() % soup.triangles.size()];
      fin[random() % 3] = Index(random() % soup.points.size());
      soup.triangles.push_back(fin);
    }
    for (Index_triple& triangle : soup.triangles)
      if (random() % 8 == 0)
        std::swap(triangle[0], triangle[1]);
    if (random() % 2 == 0)
      soup = unshared(soup);
    const Surface surface(soup, 0);
    const Neighbours neighbours(surface);
    Covering_search search(neighbours);
    for (int i = 0; i < 20; ++i, ++cases) {
      const double off = one_of({0, 0, 0.5});
      Corners corners;
      for (Point_3& corner : corners) {
        const Index t = Index(random() % surface.triangles.size());
        corner = random() % 3 > 0 ? surface.corner(t, 0) : CGAL::centroid(surface.triangle(t));
        corner = corner + off * Vector_3(share(random), share(random), share(random));
      }
      const auto any = [&] { return Index(random() % surface.triangles.size()); };
      const auto found = search.farthest(corners, {any(), any(), any()}, infinity);
      if (!found)
        continue;
      ++covered;
      const double limit = found->squared_distance * (1 + 1e-9) + 1e-24;
      constexpr int steps = 12;
      for (int a = 0; a <= steps; ++a)
        for (int b = 0; a + b <= steps; ++b) {
          const Point_3 point = CGAL::barycenter(corners[0], double(a) / steps, corners[1], double(b) / steps,
                                                 corners[2], double(steps - a - b) / steps);
          ASSERT_LE(squared_distance(point, surface), limit) << point;
        }
    }
  }
  EXPECT_GT(5 * covered, cases) << "of " << cases;
  RecordProperty("covered", int(covered));
}

} // namespace
} // namespace selvedge
