// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G5: seams. Borders and seams move along themselves only, within the angle and drift allowed.

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include "verify/Diagonal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

using Coordinates = std::tuple<double, double, double>;

Coordinates coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

// Undirected edges that belong to one triangle only, by vertex number.
std::vector<std::pair<Index, Index>> border_edges(const Triangle_soup& soup)
{
  std::map<std::pair<Index, Index>, int> faces;
  for (const Index_triple& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      ++faces[std::minmax({t[k], t[(k + 1) % 3]})];
  std::vector<std::pair<Index, Index>> result;
  for (const auto& [edge, count] : faces)
    if (count == 1)
      result.push_back(edge);
  return result;
}

TEST(Seams, CoincidentBordersCoincideAtEveryVertexAfterwards)
{
  const Triangle_soup garment = skirt(8000, 2);
  const auto sewn_edges = [](const Triangle_soup& soup) {
    std::map<std::pair<Coordinates, Coordinates>, int> borders;
    for (const auto& [a, b] : border_edges(soup))
      ++borders[std::minmax({coordinates(soup.points[a]), coordinates(soup.points[b])})];
    return std::count_if(borders.begin(), borders.end(), [](const auto& entry) { return entry.second == 2; });
  };
  const auto open_edges = [&](const Triangle_soup& soup) {
    return std::ptrdiff_t(border_edges(soup).size()) - 2 * sewn_edges(soup);
  };
  ASSERT_GT(sewn_edges(garment), 100);
  const Reduction reduction = reduce(garment, to_ratio(0.1));
  EXPECT_GE(reduction.simplified.sewing.seam_edges, std::size_t(sewn_edges(garment)))
      << "texture seams count, too";
  EXPECT_GT(sewn_edges(reduction.simplified.soup), 10);
  EXPECT_LT(sewn_edges(reduction.simplified.soup), sewn_edges(garment) / 2);
  EXPECT_LE(open_edges(reduction.simplified.soup), open_edges(garment)) << "a seam has come apart";
}

TEST(Seams, StraightBordersStayWhereTheyAre)
{
  const Reduction reduction = reduce(sheet(20, 20), to_ratio(0.01));
  const Triangle_soup& result = reduction.simplified.soup;
  EXPECT_LT(result.triangles.size(), 20u);
  for (const auto& [a, b] : border_edges(result)) {
    const Point_3 &p = result.points[a], &q = result.points[b];
    const bool is_on_one_side =
        (p.x() == q.x() && (p.x() == 0 || p.x() == 20)) || (p.y() == q.y() && (p.y() == 0 || p.y() == 20));
    EXPECT_TRUE(is_on_one_side);
  }
}

// A sheet whose border y = 0 is an arc that turns by `degrees` at each vertex.
Triangle_soup sheet_with_bent_border(double degrees)
{
  const Index width = 24;
  Triangle_soup result = sheet(width, 3);
  double x = 0, y = 0, direction = 0;
  for (Index i = 0; i <= width; ++i) {
    result.points[i] = Point_3(x, y, 0);
    x += std::cos(direction);
    y -= std::sin(direction);
    direction += degrees * CGAL_PI / 180;
  }
  return result;
}

// A sheet whose border y = 0 zigzags, and turns by `degrees` at each of its inner vertices.
constexpr Index s_zigzag_edges = 24;
Triangle_soup sheet_with_zigzag_border(double degrees)
{
  Triangle_soup result = sheet(s_zigzag_edges, 3);
  for (Index i = 1; i <= s_zigzag_edges; i += 2)
    result.points[i] = Point_3(i, -std::tan(degrees / 2 * CGAL_PI / 180), 0);
  return result;
}

TEST(Seams, BordersTurnByNoMoreThanAllowed)
{
  Simplify_options options = to_ratio(0);
  options.max_border_drift = 10;
  const auto zigzag_left = [&](double degrees) {
    const Reduction reduction = reduce(sheet_with_zigzag_border(degrees), options);
    EXPECT_TRUE(reduction.verification.embedded());
    const auto edges = border_edges(reduction.simplified.soup);
    const auto is_below = [&](const auto& edge) {
      const std::vector<Point_3>& points = reduction.simplified.soup.points;
      return points[edge.first].y() <= 0 && points[edge.second].y() <= 0;
    };
    return std::count_if(edges.begin(), edges.end(), is_below);
  };
  ASSERT_EQ(options.max_border_turn, 30);
  EXPECT_LT(zigzag_left(29), s_zigzag_edges - 10);
  EXPECT_EQ(zigzag_left(31), s_zigzag_edges);
  options.max_border_turn = 32;
  EXPECT_LT(zigzag_left(31), s_zigzag_edges - 10);
}

TEST(Seams, BordersTurnByMoreAtLowCorners)
{
  Simplify_options options = to_ratio(0);
  options.max_border_drift = 10;
  const auto loses_teeth = [&](double degrees, double share_of_height) {
    const Triangle_soup original = sheet_with_zigzag_border(degrees);
    options.max_corner_height =
        share_of_height * std::abs(original.points[1].y()) / internal::diagonal(original.points);
    const Reduction reduction = reduce(original, options);
    const std::vector<Point_3>& points = reduction.simplified.soup.points;
    return std::count_if(points.begin(), points.end(), [](const Point_3& p) { return p.y() <= 0; }) <=
           s_zigzag_edges;
  };
  EXPECT_TRUE(loses_teeth(49, 1.01));
  EXPECT_FALSE(loses_teeth(49, 0.99)) << "too high";
  EXPECT_FALSE(loses_teeth(49, 0));
  EXPECT_TRUE(loses_teeth(51, 1.01));
  EXPECT_TRUE(loses_teeth(120, 1.01));
  options.max_border_turn = 52;
  EXPECT_TRUE(loses_teeth(51, 0)) << "the control";
}

// What is left of a soup when only one or two of its vertices may go.
std::size_t left_of(const Triangle_soup& soup, const std::vector<Index>& may_go,
                    const Simplify_options& options)
{
  Simplify_intent intent;
  for (Index v = 0; v < soup.points.size(); ++v)
    if (std::find(may_go.begin(), may_go.end(), v) == may_go.end())
      intent.locked_vertices.push_back(v);
  return simplify_soup(prepare(soup), options, intent).soup.points.size();
}

TEST(Seams, ALowCornerIsNearEverythingThatTheBorderWas)
{
  const Triangle_soup strip = strip_with_low_corner();
  const double diagonal = internal::diagonal(strip.points);
  Simplify_options options = without_limits(to_ratio(0));
  options.max_border_turn = 30;
  const auto left = [&](double height, const std::vector<Index>& may_go) {
    options.max_corner_height = height / diagonal;
    return left_of(strip, may_go, options);
  };
  EXPECT_EQ(left(0.6, {2}), 8u);
  EXPECT_EQ(left(0.7, {2}), 7u);
  EXPECT_EQ(left(0.6, {1, 2}), 7u) << "the corner is low enough, but vertex 1 was not";
  EXPECT_EQ(left(0.75, {1, 2}), 6u);

  // In another pose, it is twice as high.
  Triangle_soup posed = strip;
  posed.poses.push_back(
      {"large", mapped(strip, [](const Point_3& p) { return Point_3(2 * p.x(), 2 * p.y(), 0); }).points});
  for (const auto& [height, count] : {std::pair(0.7, 8u), std::pair(1.4, 7u)}) {
    options.max_corner_height = height / diagonal;
    EXPECT_EQ(left_of(posed, {2}, options), count);
  }
}

TEST(Seams, FacesBesideLowCornersTurnByMore)
{
  // A flat sheet with a bump in its middle, √5 above the farthest edges around it.
  Triangle_soup bump = test::sheet(4, 4);
  bump.points[12] = Point_3(2, 2, 2);
  Simplify_options options = without_limits(to_ratio(0));
  options.max_normal_change = 45;
  const auto left = [&](const Triangle_soup& soup, double height) {
    options.max_corner_height = height / internal::diagonal(bump.points);
    return left_of(soup, {12}, options);
  };
  EXPECT_EQ(left(bump, 0), 25u);
  EXPECT_EQ(left(bump, 2.2), 25u);
  EXPECT_EQ(left(bump, 2.3), 24u);
  Triangle_soup posed = bump;
  posed.poses.push_back({"higher", bump.points});
  posed.poses[0].points[12] = Point_3(2, 2, 3);
  EXPECT_EQ(left(posed, 3.1), 25u);
  EXPECT_EQ(left(posed, 3.2), 24u);
}

TEST(Seams, CornersOfSeamsAreNeverLow)
{
  // Another strip below, so that the line lies inside.
  Triangle_soup soup =
      joined(strip_with_low_corner(), test::soup({{0, -5, 0}, {5, -5, 0}, {10, -5, 0}, {10.8, -5, 0}}, {}));
  for (const Index_triple& t :
       {Index_triple{8, 1, 0}, {8, 9, 1}, {9, 2, 1}, {9, 10, 2}, {10, 3, 2}, {10, 11, 3}})
    soup.triangles.push_back(t);
  soup.groups = {std::vector<Index>(12, 0), {"above", "below"}};
  std::fill(soup.groups.of_triangle.begin() + 6, soup.groups.of_triangle.end(), 1);
  Simplify_options options = without_limits(to_ratio(0));
  options.max_border_turn = options.max_seam_turn = 30;
  options.max_corner_height = 10;
  EXPECT_EQ(left_of(soup, {2}, options), soup.points.size());
  options.max_seam_turn = 49;
  EXPECT_EQ(left_of(soup, {2}, options), soup.points.size() - 1) << "the control";
}

TEST(Seams, DriftIsBounded)
{
  const Triangle_soup original = sheet_with_bent_border(2);
  Simplify_options options = to_ratio(0);
  options.max_border_turn = 180;
  std::size_t edges_before = 1000;
  for (const double drift : {0.0002, 0.002, 0.02}) {
    options.max_border_drift = drift;
    const Reduction reduction = reduce(original, options);
    const Triangle_soup& result = reduction.simplified.soup;
    const auto edges = border_edges(result);
    // Every original vertex of the bent border is that near to some border edge of the result.
    for (Index i = 0; i <= 24; ++i) {
      double nearest = 1e300;
      for (const auto& [a, b] : edges)
        nearest =
            std::min(nearest, CGAL::squared_distance(original.points[i],
                                                     Kernel::Segment_3(result.points[a], result.points[b])));
      EXPECT_LE(std::sqrt(nearest), drift * reduction.verification.distances->diagonal * (1 + 1e-12));
    }
    EXPECT_LT(edges.size(), edges_before) << "a looser bound should let the border lose more";
    edges_before = edges.size();
  }
}

} // namespace
} // namespace selvedge::test
