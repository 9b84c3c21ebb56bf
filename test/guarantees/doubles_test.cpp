// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Doubles: triangles with the same three positions as others, as of double-sided cloth. They are reduced as
// one with their fronts, and keep what is their own.

#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

enum class Vertices { same, own };

/// Adds the other side of the first triangles of a soup: turned over, and with texture coordinates of its
/// own.
Triangle_soup double_sided(Triangle_soup soup, Vertices vertices, std::size_t doubles)
{
  const Index points = vertices == Vertices::own ? Index(soup.points.size()) : 0;
  for (Index v = 0; v < points; ++v)
    soup.points.push_back(Point_3(soup.points[v]));
  const Index values = Index(soup.uvs.values.size());
  for (Index i = 0; i < values; ++i)
    soup.uvs.values.push_back({-soup.uvs.values[i][0], soup.uvs.values[i][1]}); // without rounding
  for (std::size_t t = 0; t < doubles; ++t) {
    const Index_triple v = soup.triangles[t];
    soup.triangles.push_back({points + v[0], points + v[2], points + v[1]});
    for (Triangle_labels* labels : {&soup.groups, &soup.objects, &soup.materials, &soup.smoothing_groups})
      if (!labels->empty())
        labels->of_triangle.push_back(Index(labels->of_triangle[t]));
    if (values > 0) {
      const Index_triple uv = soup.uvs.of_triangle[t];
      soup.uvs.of_triangle.push_back({values + uv[0], values + uv[2], values + uv[1]});
    }
    if (!soup.normals.empty())
      soup.normals.of_triangle.push_back(Index_triple(soup.normals.of_triangle[t]));
  }
  return soup;
}
Triangle_soup double_sided(const Triangle_soup& soup, Vertices vertices)
{
  return double_sided(soup, vertices, soup.triangles.size());
}

/// A wavy sheet.
Triangle_soup wavy_sheet()
{
  return mapped(sheet(30, 30), [](const Point_3& p) {
    const int x = int(p.x()), y = int(p.y());
    return Point_3(p.x(), p.y(), 0.25 * ((x * 7 + y * 3) % 5) + 0.125 * ((x * x + 3 * y) % 3));
  });
}

TEST(Doubles, AreReducedAsOneWithTheirFronts)
{
  const Triangle_soup single = skirt(2000);
  const Index fronts = Index(single.triangles.size());
  for (const Vertices vertices : {Vertices::same, Vertices::own})
    for (const double ratio : {0.3, 0.1}) {
      const Triangle_soup soup = double_sided(single, vertices);
      const Reduction reduction = reduce(soup, to_ratio(ratio)), like = reduce(single, to_ratio(ratio));
      EXPECT_EQ(reduction.prepared.doubles(), fronts);
      EXPECT_TRUE(reduction.verification.accepted());
      EXPECT_TRUE(reduction.verification.same_topology());
      EXPECT_EQ(reduction.simplified.report.faces_output, 2 * like.simplified.report.faces_output);
      EXPECT_EQ(reduction.simplified.report.faces_target, 2 * like.simplified.report.faces_target);
      // The same fronts are left, each with its other side, and with corners of its own side.
      std::vector<Index> expected = like.simplified.triangles;
      std::vector<Index_triple> corners = like.simplified.corners;
      for (const Index t : like.simplified.triangles)
        expected.push_back(fronts + t);
      for (const auto& [a, b, c] : like.simplified.corners) {
        const auto other_side = [&](Index corner) {
          return 3 * (fronts + corner / 3) + (3 - corner % 3) % 3;
        };
        corners.push_back({other_side(a), other_side(c), other_side(b)});
      }
      EXPECT_EQ(reduction.simplified.triangles, expected);
      EXPECT_EQ(reduction.simplified.corners, corners);
    }
  // A control: frozen, none can move.
  const Triangle_soup soup = double_sided(single, Vertices::own);
  EXPECT_EQ(reduce(soup, to_ratio(0.1), with(Defects::freeze)).simplified.triangles.size(), 2 * fronts);
}

TEST(Doubles, MayComeInAnyOrder)
{
  Triangle_soup soup = double_sided(wavy_sheet(), Vertices::own);
  for (std::size_t t = 0, half = soup.triangles.size() / 2; t < half; ++t)
    if (t % 3 == 0)
      std::swap(soup.triangles[t], soup.triangles[half + t]);
  const Reduction reduction = reduce(soup, to_ratio(0.3));
  EXPECT_TRUE(reduction.simplified.report.is_reached());
  EXPECT_TRUE(reduction.verification.accepted() && reduction.verification.same_topology());
  EXPECT_LE(reduction.verification.pairs.size(), reduction.simplified.triangles.size() / 2);
}

TEST(Doubles, OfAPartStayWhereTheyAre)
{
  const Triangle_soup single = sheet(12, 12);
  for (const Vertices vertices : {Vertices::same, Vertices::own}) {
    // Those of the first five rows, of 12 squares each.
    const Triangle_soup soup = double_sided(single, vertices, 2 * 12 * 5);
    const Reduction reduction = reduce(soup, to_ratio(0));
    EXPECT_TRUE(reduction.verification.accepted() && reduction.verification.same_topology());
    EXPECT_LT(reduction.simplified.triangles.size(), soup.triangles.size() / 10);
    double area = 0, area_of_doubles = 0;
    for (std::size_t i = 0; i < reduction.simplified.triangles.size(); ++i) {
      const Triangle_soup& left = reduction.simplified.soup;
      const auto& [a, b, c] = left.triangles[i];
      const bool is_double = reduction.simplified.triangles[i] >= single.triangles.size();
      (is_double ? area_of_doubles : area) +=
          std::sqrt(CGAL::squared_area(left.points[a], left.points[b], left.points[c]));
    }
    EXPECT_NEAR(area, 144, 1e-9);
    EXPECT_NEAR(area_of_doubles, 60, 1e-9);
  }
}

TEST(Doubles, AreAcceptedByTheReplayWithEveryMeans)
{
  const Triangle_soup soup = double_sided(wavy_sheet(), Vertices::own, 900);
  const std::vector<Simplify_options> all = every_means(without_limits(to_ratio(0.1)), 300);
  for (const Simplify_options& options : all) {
    SCOPED_TRACE(&options - all.data());
    const Logged_reduction reduction = reduce_and_log(soup, options);
    EXPECT_TRUE(reduction.simplified.report.is_reached());
    EXPECT_TRUE(verify(reduction.simplified, prepare(soup)).accepted());
    const Replay_verdict verdict = replay_text(soup, reduction.log);
    ASSERT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
    EXPECT_EQ(verdict.soup.triangles, reduction.simplified.soup.triangles);
    // A control: a log that says nothing of descent may not move them.
    std::string frozen = reduction.log;
    const std::string line = "defects descend\n";
    frozen.erase(frozen.find(line), line.size());
    EXPECT_FALSE(replay_text(soup, frozen).is_accepted());
  }
}

// A double offends with its front, and that exempts nothing else, whatever they come to be.
TEST(Doubles, ExemptNothingButEachOther)
{
  // When the hub goes to the third vertex of the rim, two faces and their doubles come to overlap.
  const Triangle_soup before = double_sided(soup({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}, {-1, -1, 0}},
                                                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}),
                                            Vertices::same);
  const Triangle_soup after = soup({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}, {-1, -1, 0}},
                                   {{3, 1, 2}, {3, 4, 1}, {3, 2, 1}, {3, 1, 4}});
  std::map<Offence, std::vector<Offending_pair>> pairs;
  for (const Offending_pair& pair : offending_pairs(after))
    pairs[pair.offence].push_back(pair);
  for (const auto& [offence, number, wrong] :
       {std::tuple(Offence::duplicate, 2, 0), std::tuple(Offence::intersection, 4, 4)}) {
    EXPECT_EQ(int(pairs[offence].size()), number);
    EXPECT_EQ(int(pairs_without_descent(after, pairs[offence], before, offending_pairs(before), {{0, 3}},
                                        {0, 3, 4, 7})
                      .size()),
              wrong);
  }
}

TEST(Doubles, CountAsOftenAsTheyOffend)
{
  // Two sheets through each other, one of them double-sided: each pair is two.
  const Triangle_soup lower = double_sided(wavy_sheet(), Vertices::own);
  const Triangle_soup soup = joined(lower, mapped(wavy_sheet(), [](const Point_3& p) {
                                      return Point_3(p.x() + 0.4, p.y() + 0.3, p.z() + 0.05);
                                    }));
  const Logged_reduction reduction = reduce_and_log(soup, without_limits(to_ratio(0.2)));
  const Verification verification = verify(reduction.simplified, prepare(soup));
  EXPECT_TRUE(verification.accepted() && verification.same_topology());
  EXPECT_LE(verification.pairs.size(), verification.pairs_of_original);
  EXPECT_TRUE(replay_text(soup, reduction.log).is_accepted());
}

TEST(Doubles, CountForTheTargetOfTheirFrontsThatAreTurnedToo)
{
  // A turned front has a double that runs as the face does, and comes before it among the plies.
  Triangle_soup soup = sheet(4, 4);
  soup.triangles.push_back(Index_triple(soup.triangles[9]));
  std::swap(soup.triangles[9][0], soup.triangles[9][1]);
  soup.groups.names = {"outside", "lining"};
  soup.groups.of_triangle.assign(soup.triangles.size(), 0);
  soup.groups.of_triangle.back() = 1;
  Simplify_intent intent;
  intent.kept = {"outside"};
  const Prepared_soup prepared = prepare(soup);
  ASSERT_EQ(prepared.turned_faces(), 1u);
  ASSERT_EQ(prepared.doubles(), 1u);
  const Simplify_report report = simplify_soup(prepared, to_ratio(0), intent).report;
  EXPECT_EQ(report.faces_target, soup.triangles.size());
  EXPECT_TRUE(report.is_reached());
}

TEST(Doubles, StayWhereTheirFrontsHaveAnotherTarget)
{
  const Index fronts = 2 * 12 * 12, doubles = 2 * 12 * 5;
  Triangle_soup soup = double_sided(sheet(12, 12), Vertices::own, doubles);
  soup.groups.names = {"outside", "lining"};
  soup.groups.of_triangle.assign(fronts, 0);
  soup.groups.of_triangle.resize(fronts + doubles, 1);
  const Prepared_soup prepared = prepare(soup);
  const auto doubles_left = [&](const Simplify_intent& intent) {
    const std::vector<Index> left = simplify_soup(prepared, to_ratio(0.25), intent).triangles;
    return std::count_if(left.begin(), left.end(), [&](Index t) { return t >= fronts; });
  };
  Simplify_intent other_target;
  other_target.ratios = {{"lining", 0.5}};
  EXPECT_EQ(doubles_left(other_target), doubles);
  // A control: for one target, they go.
  EXPECT_LE(doubles_left({}), doubles / 2);
}

TEST(Doubles, ThatMeetInOneEdgeDoNotComeApartThere)
{
  // A fan of four triangles around D, with a double of each. The two sides have C, D and the edge between
  // them in common. If D went to C, they would meet in that vertex alone.
  const Triangle_soup soup =
      test::soup({{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {2, 1, 0}, {3, 2, 0}, {0, 0, 0}, {1, 0, 1}, {3, 2, 0}},
                 {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {4, 3, 2}, {3, 6, 5}, {2, 6, 3}, {3, 5, 7}, {7, 2, 3}});
  const Prepared_soup prepared = prepare(soup);
  ASSERT_EQ(prepared.doubles(), 4u);
  Simplify_options options = to_ratio(0);
  options.max_normal_change = 180;
  options.min_aspect_ratio = 0;
  const Simplified_soup result = simplify_soup(prepared, options);
  EXPECT_TRUE(verify(result, prepared).same_topology());
}

TEST(Doubles, HaveBordersOfTheirOwnThatNoSlitMeets)
{
  // A disc with a slit from its border to M, and a hard edge from there on to T in its middle. If M went to
  // T, so would the end of the slit.
  Triangle_soup soup = test::soup({{-2, 0, 0},
                                   {-2, 0, 0},
                                   {-1, 0, 0},
                                   {0, 0, 0},
                                   {-1, 2, 0},
                                   {-1, -2, 0},
                                   {1, -1, 0},
                                   {1, 1, 0},
                                   {3, -2, 0},
                                   {3, 2, 0}},
                                  {{0, 2, 4},
                                   {2, 3, 4},
                                   {3, 7, 4},
                                   {7, 9, 4},
                                   {1, 5, 2},
                                   {2, 5, 3},
                                   {3, 5, 6},
                                   {6, 5, 8},
                                   {3, 6, 7},
                                   {6, 8, 7},
                                   {7, 8, 9}});
  soup.normals.values = {{0, 0, 1}, {0, 0.6, 0.8}};
  for (const Index side : {0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1})
    soup.normals.of_triangle.push_back({side, side, side});
  Simplify_options options = to_ratio(0);
  options.max_normal_change = 180;
  options.min_aspect_ratio = 0;
  Prepare_options keeping_normals;
  keeping_normals.normals = Normals_choice::keep;
  const auto faces_left = [&] {
    const Prepared_soup prepared = prepare(soup, keeping_normals);
    const Simplified_soup result = simplify_soup(prepared, options);
    EXPECT_TRUE(verify(result, prepared).same_topology());
    return result.triangles.size();
  };
  // A control: without doubles, it does.
  EXPECT_LT(faces_left(), 9u);
  // The double has an edge in common with the disc, at T, and a border that begins there.
  soup.points.push_back({1, 1, 0});
  soup.triangles.push_back({3, 10, 6});
  soup.normals.of_triangle.push_back({1, 1, 1});
  EXPECT_EQ(faces_left(), 12u);
}

TEST(Doubles, AreNotAllOfAPieceWhereTheMeshIsCut)
{
  // A strip, two parts of which have doubles with the same outline. One of these parts and its neighbour face
  // opposite ways, so that the mesh is cut between them. If vertex 2 went to 4, the part would vanish there.
  const Triangle_soup strip = test::soup({{11, 8, 0},
                                          {10, 4, 0},
                                          {9, 9, 0},
                                          {8, 5, 0},
                                          {7, 10, 0},
                                          {6, 6, 0},
                                          {5, 2, 0},
                                          {4, 0, 0},
                                          {3, 11, 0},
                                          {2, 7, 0},
                                          {1, 3, 0},
                                          {0, 1, 0},
                                          {8, 5, 0},
                                          {4, 0, 0}},
                                         {{11, 10, 13},
                                          {10, 6, 13},
                                          {4, 5, 8},
                                          {0, 2, 1},
                                          {1, 2, 3},
                                          {2, 4, 3},
                                          {3, 4, 5},
                                          {6, 10, 7},
                                          {7, 10, 11},
                                          {0, 1, 2},
                                          {12, 2, 1},
                                          {12, 4, 2},
                                          {5, 4, 12},
                                          {5, 9, 8},
                                          {10, 5, 6},
                                          {10, 9, 5}});
  Simplify_options options = to_ratio(0);
  options.placement = Placement::optimal;
  Prepare_options prepare_options = with(Defects::descend);
  prepare_options.orient = false;
  const Reduction reduction = reduce(strip, options, prepare_options);
  EXPECT_TRUE(reduction.verification.same_topology());
  EXPECT_EQ(reduction.simplified.soup.triangles.size(), 15u);
}

TEST(Doubles, AreRefusedWhereDefectsAre)
{
  EXPECT_THROW(prepare(double_sided(sheet(2, 2), Vertices::own), with(Defects::refuse)), Input_error);
}

} // namespace
} // namespace selvedge::test
