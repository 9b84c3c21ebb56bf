// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Sheets that meet along a line, as at the non-manifold edges of a T-junction: the line is reduced with them,
// and they stay joined.

#include "support/logged_reduction.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace selvedge::test {
namespace {

constexpr Index s_size = 16;

/// Where a point of a page is: so far from the axis, so high above the page, so far along the axis.
Point_3 in_page(int page, double radius, double height, double z)
{
  const double x = std::cos(2.0 * page + 0.3), y = std::sin(2.0 * page + 0.3);
  return {radius * x - height * y, radius * y + height * x, z};
}

double height_at(double radius, double z)
{
  return int(radius) % 2 == 1 && int(z) % 2 == 1 ? 0.2 : 0;
}

/// Three square sheets with bumps that meet in the z-axis, by the numbers of vertices, each with a texture of
/// its own. The second runs the other way.
Triangle_soup three_pages()
{
  Triangle_soup pages;
  for (int i = 0; i < 3; ++i) {
    Triangle_soup page = mapped(sheet(s_size, s_size), [&](const Point_3& p) {
      return in_page(i, p.x(), height_at(p.x(), p.y()), p.y());
    });
    if (i == 1)
      for (Index_triple& triangle : page.triangles)
        std::swap(triangle[1], triangle[2]);
    pages = joined(std::move(pages), page);
  }
  std::map<double, Index> axis;
  for (std::size_t t = 0; t < pages.triangles.size(); ++t) {
    const double page = double(t / (pages.triangles.size() / 3));
    Index_triple uvs;
    for (std::size_t k = 0; k < 3; ++k) {
      Index& v = pages.triangles[t][k];
      const Point_3& p = pages.points[v];
      uvs[k] = Index(pages.uvs.values.size());
      pages.uvs.values.push_back({2 * page + std::hypot(p.x(), p.y()) / s_size, p.z() / s_size});
      if (p.x() == 0 && p.y() == 0)
        v = axis.emplace(p.z(), v).first->second;
    }
    pages.uvs.of_triangle.push_back(uvs);
  }
  return pages;
}

bool is_on_axis(const Point_3& p)
{
  return p.x() == 0 && p.y() == 0;
}

/// The number of faces at each edge of the axis.
std::map<std::pair<double, double>, int> edges_of_axis(const Triangle_soup& soup)
{
  std::map<std::pair<double, double>, int> edges;
  for (const Index_triple& triangle : soup.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3 &a = soup.points[triangle[k]], &b = soup.points[triangle[(k + 1) % 3]];
      if (is_on_axis(a) && is_on_axis(b))
        ++edges[std::minmax(a.z(), b.z())];
    }
  return edges;
}

/// Reduces pages around the axis, and expects fewer edges there, each with as many faces as before.
void expect_sheets_stay_joined(const Triangle_soup& pages, const Simplify_options& options,
                               int faces_at_each_edge)
{
  const Reduction reduction = reduce(pages, options);
  EXPECT_TRUE(reduction.verification.accepted());
  EXPECT_TRUE(reduction.simplified.report.is_reached());
  const auto edges = edges_of_axis(reduction.simplified.soup);
  EXPECT_LT(edges.size(), s_size / 2);
  for (const auto& [ends, faces] : edges)
    EXPECT_EQ(faces, faces_at_each_edge) << ends.first << " to " << ends.second;
}

Simplify_options to_a_tenth(Placement placement)
{
  Simplify_options options = to_ratio(0.1);
  options.placement = placement;
  return options;
}

TEST(NonManifold, SheetsStayJoinedAlongALineThatIsReduced)
{
  const Triangle_soup pages = three_pages();
  for (const Placement placement : {Placement::vertices, Placement::optimal})
    expect_sheets_stay_joined(pages, to_a_tenth(placement), 3);
}

/// Three pages without texture, the last of which has a back: its faces turned, with the same vertices.
Triangle_soup three_pages_one_with_a_back()
{
  Triangle_soup pages = three_pages();
  pages.uvs = {};
  const std::size_t all = pages.triangles.size();
  for (std::size_t t = 2 * all / 3; t < all; ++t)
    pages.triangles.push_back({pages.triangles[t][0], pages.triangles[t][2], pages.triangles[t][1]});
  return pages;
}

// As where two walls of a model have come to lie in one place.
TEST(NonManifold, ASheetWithABackGoesAlongTheLine)
{
  const Triangle_soup pages = three_pages_one_with_a_back();
  for (const Placement placement : {Placement::vertices, Placement::optimal}) {
    const Simplify_options options = to_a_tenth(placement);
    expect_sheets_stay_joined(pages, options, 4);
    const Logged_reduction logged = reduce_and_log(pages, options);
    EXPECT_TRUE(replay_text(logged.original, logged.log).is_accepted());
  }
}

// A front that has vertices of its own on the axis, and a back that one vertex joins to the other sheets.
TEST(NonManifold, ABackWithOtherVerticesThanItsFrontStays)
{
  Triangle_soup pages = three_pages_one_with_a_back();
  constexpr double middle = s_size / 2;
  std::map<Index, Index> of_front, of_back;
  const auto copy = [&](std::map<Index, Index>& copies, Index v) {
    const auto [found, is_new] = copies.emplace(v, Index(pages.points.size()));
    if (is_new)
      pages.points.push_back(Point_3(pages.points[v]));
    return found->second;
  };
  const std::size_t page = pages.triangles.size() / 4;
  for (std::size_t t = 2 * page; t < 4 * page; ++t)
    for (Index& v : pages.triangles[t]) {
      const bool is_joined = is_on_axis(pages.points[v]) && pages.points[v].z() == middle;
      if (t < 3 * page)
        v = is_on_axis(pages.points[v]) ? copy(of_front, v) : v;
      else
        v = is_joined ? v : copy(of_back, v);
    }
  const Reduction reduction = reduce(pages, to_ratio(0.05));
  EXPECT_TRUE(reduction.verification.accepted()) << "pieces keep their topology";
  EXPECT_EQ(edges_of_axis(reduction.simplified.soup).size(), s_size);
}

// CGAL's loop does one collapse at a time.
TEST(NonManifold, ControlVerticesThatDoNotMoveTogetherStay)
{
  Simplify_options options = to_ratio(0.1);
  options.loop = Collapse_loop::cgal;
  EXPECT_EQ(edges_of_axis(reduce(three_pages(), options).simplified.soup).size(), s_size);
}

// One line of the log moves all sheets, each with its own texture.
TEST(NonManifold, ALineOfTheLogMovesAllSheets)
{
  const Logged_reduction reduction = reduce_and_log(three_pages(), to_ratio(0.1));
  const Replay_verdict verdict = replay_text(reduction.original, reduction.log);
  EXPECT_TRUE(verdict.is_accepted());
  const Triangle_soup &replayed = verdict.soup, &result = reduction.simplified.soup;
  ASSERT_EQ(replayed.triangles, result.triangles);
  EXPECT_EQ(replayed.uvs.of_triangle, result.uvs.of_triangle);
  EXPECT_EQ(replayed.uvs.values, result.uvs.values);
}

// Small triangles lie where a face of the first sheet would pass if its corner went along the axis.
TEST(NonManifold, NoSheetPassesThroughAnythingWhenAllMove)
{
  Triangle_soup pages = three_pages();
  pages.uvs = {};
  for (Index z = 1; z + 1 < s_size; ++z)
    for (const double other : {z - 1.0, z + 1.0}) { // the middle of what a face at height z sweeps
      const double height = (height_at(1, z) + height_at(1, z + 1)) / 4, middle = (3 * z + other + 1) / 4;
      pages =
          joined(std::move(pages), soup({in_page(0, 0.5, height, middle), in_page(0, 0.501, height, middle),
                                         in_page(0, 0.5, height + 0.001, middle)},
                                        {{0, 1, 2}}));
    }
  ASSERT_TRUE(prepare(pages).offending_pairs.empty());
  const Logged_reduction reduction = reduce_and_log(pages, without_limits(to_ratio(0.1)));
  EXPECT_LT(edges_of_axis(reduction.simplified.soup).size(), s_size);
  const Replay_verdict verdict = replay_text(reduction.original, reduction.log);
  EXPECT_TRUE(verdict.is_accepted());
}

// At one end of the line, a sheet has a vertex of its own: the piece of the other two ends there.
TEST(NonManifold, ASheetThatIsJoinedByOtherVerticesStaysSo)
{
  Triangle_soup pages = three_pages();
  pages.uvs = {};
  const Index own = Index(pages.points.size());
  const double height = s_size / 2;
  pages.points.push_back({0, 0, height});
  for (std::size_t t = 0; t < pages.triangles.size() / 3; ++t)
    for (Index& v : pages.triangles[t])
      if (is_on_axis(pages.points[v]) && pages.points[v].z() == height)
        v = own;
  const Reduction reduction = reduce(pages, to_ratio(0.05));
  EXPECT_TRUE(reduction.verification.accepted()) << "pieces keep their topology";
  std::set<double> heights;
  for (const auto& [ends, faces] : edges_of_axis(reduction.simplified.soup))
    heights.insert({ends.first, ends.second});
  EXPECT_TRUE(heights.count(height - 1) > 0 && heights.count(height) > 0 && heights.count(height + 1) > 0);
}

} // namespace
} // namespace selvedge::test
