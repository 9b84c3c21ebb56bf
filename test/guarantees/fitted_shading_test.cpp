// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Normals are fitted to the shading of the original: a large face shades as what it has replaced.

#include "soup/triangle_normals.h"
#include "support/reduction.h"
#include "support/shading.h"

#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace selvedge;
using selvedge::test::count_of_wrong_sides;
using selvedge::test::hem;
using selvedge::test::mending;
using selvedge::test::reduce;
using selvedge::test::Reduction;
using selvedge::test::to_ratio;

namespace {

using Vector = internal::Vector_of_doubles;

// A sheet in gentle waves.
double height(double x, double y)
{
  return 0.3 * std::sin(1.3 * x) * std::cos(0.9 * y) + 0.05 * std::sin(5 * x + 3 * y);
}

Vector direction(Vector a)
{
  const double length = std::sqrt(internal::dot(a, a));
  for (double& x : a)
    x /= length;
  return a;
}

Vector normal_of_sheet(double x, double y, double steepness = 1)
{
  const double u = -0.39 * std::cos(1.3 * x) * std::cos(0.9 * y) - 0.25 * std::cos(5 * x + 3 * y);
  const double v = 0.27 * std::sin(1.3 * x) * std::sin(0.9 * y) - 0.15 * std::cos(5 * x + 3 * y);
  return direction({steepness * u, steepness * v, 1});
}

Triangle_soup sheet()
{
  constexpr Index columns = 48;
  Triangle_soup soup;
  for (Index i = 0; i <= columns; ++i)
    for (Index j = 0; j <= columns; ++j) {
      const double x = 0.1 * i, y = 0.1 * j;
      soup.points.emplace_back(x, y, height(x, y));
      soup.normals.values.push_back(normal_of_sheet(x, y));
    }
  for (Index i = 0; i < columns; ++i)
    for (Index j = 0; j < columns; ++j) {
      const Index a = (columns + 1) * i + j, b = a + 1, c = a + columns + 1, d = c + 1;
      soup.triangles.push_back({a, c, d});
      soup.triangles.push_back({a, d, b});
    }
  soup.normals.of_triangle = soup.triangles;
  return soup;
}

// Returns the mean angle between the normals with which a result is shaded and those of the sheet above it.
double shading_error(const Triangle_soup& soup, double steepness = 1)
{
  double sum = 0, area = 0;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    std::array<Vector, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& point = soup.points[soup.triangles[t][k]];
      p[k] = {point.x(), point.y(), point.z()};
    }
    const Vector doubled =
        internal::cross(internal::difference(p[1], p[0]), internal::difference(p[2], p[0]));
    constexpr int parts = 6;
    for (int i = 1; i < parts; ++i)
      for (int j = 1; i + j < parts; ++j) {
        const std::array<double, 3> weights{double(i) / parts, double(j) / parts,
                                            double(parts - i - j) / parts};
        Vector place{}, normal{};
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t axis = 0; axis < 3; ++axis) {
            place[axis] += weights[k] * p[k][axis];
            normal[axis] += weights[k] * soup.normals.values[soup.normals.of_triangle[t][k]][axis];
          }
        const double cosine =
            internal::dot(direction(normal), normal_of_sheet(place[0], place[1], steepness));
        sum += doubled[2] * std::acos(std::min(1.0, cosine));
        area += doubled[2];
      }
  }
  return sum / area;
}

Prepare_options fitting()
{
  Prepare_options options;
  options.normals = Normals_choice::automatic;
  return options;
}

// A result beside its original, for what is called after a reduction.
struct Reduced
{
  Triangle_soup original, result;
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
};

Reduced reduced(const Triangle_soup& soup, double ratio)
{
  const Reduction reduction = reduce(soup, to_ratio(ratio), mending());
  const Simplified_soup& simplified = reduction.simplified;
  return {soup, simplified.soup, simplified.triangles, simplified.corners};
}

void append(Triangle_soup& soup, const Triangle_soup& other)
{
  const Index points = Index(soup.points.size()), normals = Index(soup.normals.values.size());
  soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
  soup.normals.values.insert(soup.normals.values.end(), other.normals.values.begin(),
                             other.normals.values.end());
  for (const auto& [a, b, c] : other.triangles)
    soup.triangles.push_back({points + a, points + b, points + c});
  for (const auto& [a, b, c] : other.normals.of_triangle)
    soup.normals.of_triangle.push_back({normals + a, normals + b, normals + c});
}

// The faces are the same, and shade more like the original.
void expect_only_truer_shading(const Simplified_soup& fitted, const Simplified_soup& kept)
{
  EXPECT_GT(fitted.fitted_normals, 0u);
  EXPECT_EQ(fitted.soup.points, kept.soup.points);
  EXPECT_EQ(fitted.soup.triangles, kept.soup.triangles);
  EXPECT_LT(shading_error(fitted.soup), 0.8 * shading_error(kept.soup));
}

} // namespace

TEST(FittedShading, IsNearerToThatOfTheOriginal)
{
  const Triangle_soup soup = sheet();
  for (const Placement placement : {Placement::vertices, Placement::optimal})
    for (const double ratio : {0.1, 0.03}) {
      Simplify_options options = to_ratio(ratio);
      options.placement = placement;
      const Reduction fitted = reduce(soup, options, fitting()), kept = reduce(soup, options, mending());
      EXPECT_EQ(fitted.prepared.normals, Normals_treatment::fitted);
      EXPECT_EQ(kept.simplified.fitted_normals, 0u);
      expect_only_truer_shading(fitted.simplified, kept.simplified);
    }
}

TEST(FittedShading, IsNearerThanThatOfNormalsThatArePicked)
{
  const Triangle_soup soup = sheet();
  Simplify_options options = to_ratio(0.1);
  options.normal_weight = 0;
  Prepare_options loose;
  loose.normals = Normals_choice::loose;
  const Reduction fitted = reduce(soup, options, loose), kept = reduce(soup, options, mending());
  EXPECT_EQ(fitted.prepared.normals, Normals_treatment::picked);
  expect_only_truer_shading(fitted.simplified, kept.simplified);
}

TEST(FittedShading, StaysBitForBitWhereNothingChanges)
{
  const Triangle_soup soup = sheet();
  EXPECT_EQ(reduce(soup, to_ratio(1), fitting()).simplified.soup.normals.values, soup.normals.values);
  const Reduction half = reduce(soup, to_ratio(0.6), fitting());
  const Simplified_soup& result = half.simplified;
  std::set<Index> around_changes; // vertices
  for (Index i = 0; i < result.triangles.size(); ++i)
    if (const Index t = result.triangles[i]; result.corners[i] != Index_triple{3 * t, 3 * t + 1, 3 * t + 2})
      around_changes.insert(result.soup.triangles[i].begin(), result.soup.triangles[i].end());
  std::size_t unchanged = 0;
  for (Index i = 0; i < result.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (around_changes.count(result.soup.triangles[i][k]) == 0) {
        ++unchanged;
        EXPECT_EQ(result.soup.normals.values[result.soup.normals.of_triangle[i][k]],
                  soup.normals.values[soup.normals.of_triangle[result.triangles[i]][k]]);
      }
  EXPECT_GT(unchanged, 100u);
  EXPECT_GT(result.fitted_normals, 0u);
}

TEST(FittedShading, PointsToTheBackOfNoFace)
{
  const Triangle_soup soup = hem();
  for (const double ratio : {0.3, 0.1, 0.02})
    EXPECT_EQ(count_of_wrong_sides(reduce(soup, to_ratio(ratio), fitting()).simplified.soup), 0u) << ratio;
  // The large side of a steep ridge would turn the normals along it to the back of the small side.
  Triangle_soup original;
  original.points = {{0, 0, 0}, {0, 1, 0}, {-0.26, 0.5, -0.97}, {0.026, 0.5, -0.097}};
  original.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}}; // no border
  original.normals = {
      {{-0.97, 0, 0.26}, {0, 0, 1}, {9, 9, 9}}, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {2, 2, 2}}, 2};
  Triangle_soup result = original;
  result.points[2] = {-0.26, 0.51, -0.97};
  result.points[3] = {0.026, 0.51, -0.097};
  result.normals.of_triangle = {{1, 1, 1}, {1, 1, 1}, {2, 2, 2}, {2, 2, 2}};
  EXPECT_GT(fit_normals(result, {0, 1, 2, 3}, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}, original,
                        original.normals),
            0u);
  result.triangles.resize(2);
  EXPECT_EQ(count_of_wrong_sides(result), 0u);
}

// The large side of a peak would turn its normal to the back of the other sides. No edge there is sharp
// enough to become hard.
TEST(FittedShading, PointsToTheBackOfNoSideOfAPeak)
{
  constexpr Index sides = 12;
  Triangle_soup original;
  original.points = {{0, 0, 0}};
  for (Index i = 0; i < sides; ++i) {
    const double angle = 2 * CGAL_PI * i / sides, length = i < 2 ? 20 : 1;
    original.points.emplace_back(length * std::cos(angle), length * std::sin(angle), -1.7 * length);
    original.triangles.push_back({0, i + 1, (i + 1) % sides + 1});
  }
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index i = 0; i < sides; ++i) {
    original.normals.values.push_back(shading::unit_normal(original, i));
    original.normals.of_triangle.push_back({i, i, i});
    triangles.push_back(i);
    corners.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Triangle_soup result = original;
  result.points[0] = {0, 0, 0.01};
  result.normals.values.push_back({0, 0, 1});
  for (Index_triple& normals : result.normals.of_triangle)
    normals[0] = sides;
  EXPECT_EQ(fit_normals(result, triangles, corners, original, original.normals), sides);
  EXPECT_EQ(count_of_wrong_sides(result), 0u);
  const auto& [x, y, z] = result.normals.values[result.normals.of_triangle[0][0]];
  EXPECT_GT(x, 0.1); // it has turned, as far as the others let it
  EXPECT_GT(y, 0);
  EXPECT_GT(z, 0);
}

// A layer that lies nearer than the result is to its original, with quite other normals.
TEST(FittedShading, DoesNotDependOnOtherLayers)
{
  const Triangle_soup upper = sheet();
  Triangle_soup lower = upper;
  for (Point_3& point : lower.points)
    point = {point.x(), point.y(), point.z() - 0.01};
  for (auto& normal : lower.normals.values)
    normal = direction({normal[0] + 0.5, normal[1] - 0.5, normal[2]});
  Reduced alone = reduced(upper, 0.05), both = alone, other = reduced(lower, 0.03);
  append(both.original, lower);
  append(both.result, other.result);
  const Index before = Index(upper.triangles.size());
  for (const Index t : other.triangles)
    both.triangles.push_back(before + t);
  for (const auto& [a, b, c] : other.corners)
    both.corners.push_back({3 * before + a, 3 * before + b, 3 * before + c});
  fit_normals(alone.result, alone.triangles, alone.corners, alone.original, alone.original.normals);
  fit_normals(both.result, both.triangles, both.corners, both.original, both.original.normals);
  for (Index i = 0; i < alone.result.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(both.result.normals.values[both.result.normals.of_triangle[i][k]][axis],
                    alone.result.normals.values[alone.result.normals.of_triangle[i][k]][axis], 1e-3);
}

// The other side of thin cloth is near, or just there, and what it is shaded with means nothing here.
TEST(FittedShading, DoesNotDependOnTheOtherSide)
{
  const Triangle_soup upper = sheet();
  for (const double thickness : {0.002, 0.}) {
    Triangle_soup cloth = upper, back = upper;
    for (Index_triple& triangle : back.triangles)
      std::swap(triangle[1], triangle[2]);
    back.normals.of_triangle = back.triangles;
    for (auto& normal : back.normals.values)
      normal = {-normal[0], -normal[1], -normal[2]};
    for (Index v = 1; v < back.points.size(); ++v) // at least one vertex joins the two sides
      back.points[v] = {back.points[v].x(), back.points[v].y(), back.points[v].z() - thickness};
    append(cloth, back);
    Prepare_options keeping = mending(), options = fitting();
    keeping.defects = options.defects = Defects::descend;
    const Triangle_soup result = reduce(cloth, to_ratio(0.05), options).simplified.soup;
    const Triangle_soup kept = reduce(cloth, to_ratio(0.05), keeping).simplified.soup;
    EXPECT_EQ(count_of_wrong_sides(result), 0u);
    EXPECT_LT(kept.triangles.size(), 500u);
    for (const double side : {1, -1}) {
      // Returns what faces one side, seen from above.
      const auto faces = [&](const Triangle_soup& soup) {
        Triangle_soup seen = soup;
        seen.triangles.clear();
        seen.normals.of_triangle.clear();
        for (Index t = 0; t < soup.triangles.size(); ++t) {
          const Index_triple &triangle = soup.triangles[t], &normals = soup.normals.of_triangle[t];
          if (side * soup.normals.values[normals[0]][2] <= 0)
            continue;
          const auto turned = [&](const Index_triple& triple) {
            return side > 0 ? triple : Index_triple{triple[0], triple[2], triple[1]};
          };
          seen.triangles.push_back(turned(triangle));
          seen.normals.of_triangle.push_back(turned(normals));
        }
        for (auto& normal : seen.normals.values)
          for (double& x : normal)
            x *= side;
        return seen;
      };
      EXPECT_LT(shading_error(faces(result)), 0.8 * shading_error(faces(kept))) << thickness << ' ' << side;
    }
  }
}

// Hard edges stay hard, and seams of the texture, where vertices differ, stay smooth, also if their two sides
// have normals that differ in the last digits.
TEST(FittedShading, KeepsEdgesHardOrSmooth)
{
  Triangle_soup left, right;
  for (const auto& triangle : sheet().triangles)
    (triangle[0] % 49 < 24 ? left : right).triangles.push_back(triangle);
  for (Triangle_soup* const half : {&left, &right}) {
    half->points = sheet().points;
    half->normals = {sheet().normals.values, half->triangles};
  }
  for (const double apart : {0., 1e-4, 0.3}) {
    right.normals.values = left.normals.values;
    if (apart > 0)
      for (auto& normal : right.normals.values)
        normal = direction({normal[0], normal[1] + apart, normal[2]});
    Triangle_soup soup = left;
    append(soup, right);
    const Triangle_soup result = reduce(soup, to_ratio(0.05), fitting()).simplified.soup;
    std::map<std::array<double, 3>, std::set<std::array<double, 3>>> at_seam;
    for (Index t = 0; t < result.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (const Point_3& p = result.points[result.triangles[t][k]]; p.y() == 0.1 * 24)
          at_seam[{p.x(), p.y(), p.z()}].insert(result.normals.values[result.normals.of_triangle[t][k]]);
    EXPECT_GT(at_seam.size(), 3u);
    std::size_t equal = 0;
    for (const auto& [place, normals] : at_seam) {
      equal += normals.size() == 1;
      EXPECT_EQ(internal::dot(*normals.begin(), *normals.rbegin()) > 0.999998, apart < 0.01); // of 0.1°
    }
    // The two ends, on borders, keep what they have.
    EXPECT_EQ(equal, apart == 0 ? at_seam.size() : apart < 0.01 ? at_seam.size() - 2 : 0);
  }
}

// A grid of the places of a profile (x and z), at each of these y.
Triangle_soup extruded(const std::vector<std::array<double, 2>>& profile,
                       const std::vector<std::array<double, 3>>& normals, const std::vector<double>& rows)
{
  Triangle_soup soup;
  const Index columns = Index(profile.size());
  for (const double y : rows)
    for (Index i = 0; i < columns; ++i) {
      soup.points.emplace_back(profile[i][0], y, profile[i][1]);
      soup.normals.values.push_back(direction(normals[i]));
    }
  for (Index j = 0; j + 1 < rows.size(); ++j)
    for (Index i = 0; i + 1 < columns; ++i) {
      const Index a = j * columns + i, b = a + 1, c = b + columns, d = c - 1;
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({a, c, d});
    }
  soup.normals.of_triangle = soup.triangles;
  return soup;
}

// Two planes at a right angle. In the original, a bevel is between them; in the result, it is gone.
TEST(FittedShading, IsHardAgainWhereABevelIsGone)
{
  std::vector<std::array<double, 2>> profile;
  std::vector<std::array<double, 3>> normals;
  const auto add = [&](double x, double z, const std::array<double, 3>& normal) {
    profile.push_back({x, z});
    normals.push_back(normal);
  };
  for (int i = 0; i < 8; ++i)
    add(i, 0, {0, 0, 1});
  add(7.8, 0, {0, 0, 1});
  add(7.9, 0, {1, 0, 1});
  add(8, -0.1, {1, 0, 1});
  add(8, -0.2, {1, 0, 0});
  for (int i = 1; i <= 8; ++i)
    add(8, -i, {1, 0, 0});
  std::vector<double> rows;
  for (int j = 0; j <= 20; ++j)
    rows.push_back(j);
  const Triangle_soup original = extruded(profile, normals, rows);
  Triangle_soup result =
      extruded({{0, 0}, {8, 0}, {8, -8}}, {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {0, 7, 13, 20});
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < result.triangles.size(); ++t) {
    const bool is_above = t / 2 % 2 == 0;
    triangles.push_back(is_above ? 0 : 2 * Index(profile.size() - 2));
    corners.push_back({3 * triangles.back(), 3 * triangles.back() + 1, 3 * triangles.back() + 2});
  }
  EXPECT_GT(fit_normals(result, triangles, corners, original, original.normals), 0u);
  std::size_t found = 0;
  for (Index t = 0; t < result.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& p = result.points[result.triangles[t][k]];
      if (p.x() != 8 || p.z() != 0 || p.y() == 0 || p.y() == 20) // borders stay
        continue;
      ++found;
      EXPECT_GT(internal::dot(shading::unit_normal(result, t),
                              result.normals.values[result.normals.of_triangle[t][k]]),
                0.95)
          << p;
    }
  EXPECT_EQ(found, 12u);
}

// Fits the normals of a result of three strips to an original of `strips`, of which these are the first, that
// of number `middle`, and the last, and expects that the first and the last are shaded as planes.
void expect_planes_beside_middle(const Triangle_soup& original, std::size_t strips, std::size_t middle,
                                 Triangle_soup result)
{
  const std::array<std::size_t, 3> strip_of_original{0, middle, strips - 1};
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < result.triangles.size(); ++t) {
    const std::size_t row = t / 6, strip = t / 2 % 3;
    triangles.push_back(Index(2 * (row * strips + strip_of_original[strip]) + t % 2));
    corners.push_back({3 * triangles.back(), 3 * triangles.back() + 1, 3 * triangles.back() + 2});
  }
  EXPECT_GT(fit_normals(result, triangles, corners, original, original.normals), 0u);
  std::size_t found = 0;
  for (Index t = 0; t < result.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3 && t / 2 % 3 != 1; ++k) {
      const double y = result.points[result.triangles[t][k]].y();
      if (y == 0 || y == 20) // borders stay
        continue;
      ++found;
      EXPECT_GT(internal::dot(shading::unit_normal(result, t),
                              result.normals.values[result.normals.of_triangle[t][k]]),
                0.95);
    }
  EXPECT_EQ(found, 228u);
}

// Between two planes at a right angle, the faces of a bevel are left. They turn the normals along its sides.
// The planes are larger, and are shaded as planes.
TEST(FittedShading, IsThatOfLargeFacesBesideTheBevelThatIsLeft)
{
  const std::array<double, 3> up{0, 0, 1}, between{1, 0, 1}, aside{1, 0, 0};
  std::vector<std::array<double, 2>> profile;
  std::vector<std::array<double, 3>> normals;
  for (int i = 0; i < 8; ++i) {
    profile.push_back({double(i), 0});
    normals.push_back(up);
  }
  profile.insert(profile.end(), {{7.8, 0}, {7.9, 0}, {8, -0.1}, {8, -0.2}});
  normals.insert(normals.end(), {up, between, between, aside});
  for (int i = 1; i <= 8; ++i) {
    profile.push_back({8, double(-i)});
    normals.push_back(aside);
  }
  std::vector<double> rows;
  for (int j = 0; j <= 20; ++j)
    rows.push_back(j);
  const Triangle_soup original = extruded(profile, normals, rows);
  Triangle_soup result =
      extruded({{0, 0}, {7.9, 0}, {8, -0.1}, {8, -8}}, {up, between, between, aside}, rows);
  expect_planes_beside_middle(original, profile.size() - 1, 9, std::move(result));
}

// The rounded edge of a thick cloth, of which one flat face is left. No normal suits both this and a side of
// the cloth, and a mean of the two would shade the whole side as if it were bent.
TEST(FittedShading, IsThatOfASideUpToItsEdgeWhereTheRoundingIsGone)
{
  constexpr int steps = 8; // of the rounding
  std::vector<std::array<double, 2>> profile;
  std::vector<std::array<double, 3>> normals;
  const auto add = [&](double x, double z, const std::array<double, 3>& normal) {
    profile.push_back({x, z});
    normals.push_back(normal);
  };
  for (int i = 0; i < 8; ++i)
    add(i, 0, {0, 0, 1});
  for (int i = 0; i <= steps; ++i) {
    const double angle = CGAL_PI * i / steps;
    add(8 + 0.2 * std::sin(angle), 0.2 * (std::cos(angle) - 1), {std::sin(angle), 0, std::cos(angle)});
  }
  for (int i = 7; i >= 0; --i)
    add(i, -0.4, {0, 0, -1});
  std::vector<double> rows;
  for (int j = 0; j <= 20; ++j)
    rows.push_back(j);
  const Triangle_soup original = extruded(profile, normals, rows);
  const int first = 8 + 2, last = 8 + steps - 2; // vertices of the profile that are left, beside its ends
  Triangle_soup result = extruded({profile.front(), profile[first], profile[last], profile.back()},
                                  {normals.front(), normals[first], normals[last], normals.back()}, rows);
  expect_planes_beside_middle(original, profile.size() - 1, 8 + steps / 2, std::move(result));
}

// So that it goes on in what lies beside, in another file or as the next place of the same mesh.
TEST(FittedShading, StaysBitForBitOnBordersWhereItIsNear)
{
  const Triangle_soup soup = sheet();
  const Simplified_soup result = reduce(soup, to_ratio(0.05), fitting()).simplified;
  std::size_t on_border = 0, changed = 0;
  for (Index i = 0; i < result.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& p = result.soup.points[result.soup.triangles[i][k]];
      const Vector normal = result.soup.normals.values[result.soup.normals.of_triangle[i][k]];
      const bool is_as_it_was =
          normal ==
          soup.normals.values[soup.normals.of_triangle[result.corners[i][k] / 3][result.corners[i][k] % 3]];
      if (std::min(p.x(), p.y()) == 0 || std::max(p.x(), p.y()) == 0.1 * 48) {
        ++on_border;
        EXPECT_TRUE(is_as_it_was) << p;
      } else
        changed += !is_as_it_was;
    }
  EXPECT_GT(on_border, 20u);
  EXPECT_GT(changed, 100u);
}

// A flat cloth with narrow faces along its edge, whose normals turn away. The result has one face in place of
// all, which would be shaded as if it were bent.
TEST(FittedShading, IsThatOfTheClothUpToABorderWhoseNormalsTurnAway)
{
  const std::array<double, 3> up{0, 0, 1}, slightly{0.2, 0, 1}, aside{1, 0, 1};
  const std::vector<double> rows{0, 5, 10, 15, 20};
  const Triangle_soup original =
      extruded({{0, 0}, {0.1, 0}, {4, 0}, {7.9, 0}, {8, 0}}, {slightly, up, up, up, aside}, rows);
  Triangle_soup result = extruded({{0, 0}, {8, 0}}, {slightly, aside}, rows);
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < result.triangles.size(); ++t) {
    triangles.push_back(4 * t);
    corners.push_back({12 * t, 12 * t + 1, 12 * t + 2});
  }
  EXPECT_GT(fit_normals(result, triangles, corners, original, original.normals), 0u);
  for (Index t = 0; t < result.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector normal = result.normals.values[result.normals.of_triangle[t][k]];
      if (result.points[result.triangles[t][k]].x() == 0)
        EXPECT_EQ(normal, direction(slightly)); // one does not see this, and what lies beside may have it
      else
        EXPECT_GT(normal[2], 0.98);
    }
}

TEST(FittedShading, LeavesPartsThatAreKept)
{
  Triangle_soup soup = sheet();
  soup.groups.names = {"rest", "logo"};
  for (const Index_triple& triangle : soup.triangles) {
    const Point_3& p = soup.points[triangle[0]];
    soup.groups.of_triangle.push_back(std::abs(p.x() - 2.4) < 0.8 && std::abs(p.y() - 2.4) < 0.8);
  }
  for (const bool is_locked : {false, true}) {
    Simplify_intent intent;
    (is_locked ? intent.locked : intent.kept) = {"logo"};
    const Prepared_soup prepared = prepare(soup, fitting());
    const Simplified_soup result = simplify_soup(prepared, to_ratio(0.1), intent);
    std::size_t kept = 0;
    for (Index i = 0; i < result.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3 && soup.groups.of_triangle[result.triangles[i]] == 1; ++k) {
        ++kept;
        EXPECT_EQ(result.soup.normals.values[result.soup.normals.of_triangle[i][k]],
                  soup.normals.values[soup.normals.of_triangle[result.triangles[i]][k]]);
      }
    EXPECT_GT(kept, 300u);
    EXPECT_GT(result.fitted_normals, 100u);
  }
}

TEST(FittedShading, LeavesTrianglesWithoutNormals)
{
  Triangle_soup soup = sheet();
  soup.normals.missing = Index(soup.normals.values.size());
  soup.normals.values.push_back({9, 9, 9});
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (soup.points[soup.triangles[t][0]].x() < 1)
      soup.normals.of_triangle[t].fill(*soup.normals.missing);
  const Simplified_soup result = reduce(soup, to_ratio(0.1), fitting()).simplified;
  EXPECT_GT(result.fitted_normals, 100u);
  for (Index i = 0; i < result.triangles.size(); ++i)
    EXPECT_EQ(result.soup.normals.of_triangle[i][0] == result.soup.normals.missing,
              soup.normals.of_triangle[result.triangles[i]][0] == soup.normals.missing);
}

// A morph target adds to the normals what makes those of a steeper sheet, or a flatter one, of those of the
// sheet.
TEST(FittedShading, IsNearerInPosesToo)
{
  const Triangle_soup soup = sheet();
  for (const double steepness : {0.6, 1.7}) {
    const auto posed = [&](Triangle_soup result) {
      Corner_values<3> normals;
      for (Index t = 0; t < result.triangles.size(); ++t) {
        Index_triple& numbers = normals.of_triangle.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
          const Point_3& p = result.points[result.triangles[t][k]];
          Vector normal = result.normals.values[result.normals.of_triangle[t][k]];
          const Vector before = normal_of_sheet(p.x(), p.y()),
                       after = normal_of_sheet(p.x(), p.y(), steepness);
          for (std::size_t axis = 0; axis < 3; ++axis)
            normal[axis] += after[axis] - before[axis];
          numbers[k] = Index(normals.values.size());
          normals.values.push_back(direction(normal));
        }
      }
      result.normals = normals;
      return result;
    };
    const Triangle_soup fitted = posed(reduce(soup, to_ratio(0.05), fitting()).simplified.soup);
    const Triangle_soup kept = posed(reduce(soup, to_ratio(0.05), mending()).simplified.soup);
    EXPECT_LT(shading_error(fitted, steepness), shading_error(kept, steepness)) << steepness;
  }
}

TEST(FittedShading, NeedsNoNormals)
{
  Triangle_soup result = sheet();
  const Triangle_soup original = result;
  result.normals = {};
  EXPECT_EQ(fit_normals(result, {}, {}, original, original.normals), 0u);
}
