// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G5: seams. Borders and seams move along themselves only, within the angle and drift allowed.

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

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
