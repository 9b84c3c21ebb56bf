// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes that intersect already: what intersects in the result descends from what did, and is never more.

#include "support/filter_verdict.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/geometry/internal/piercing_depth.h>

#include <CGAL/Bbox_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

/// Two wavy sheets, one moved into the other.
Triangle_soup sheets_through_each_other(std::size_t faces, double share = 1)
{
  const Triangle_soup sheet = sheets(faces, 1, 1e-3);
  Triangle_soup lower;
  lower.points = sheet.points;
  lower.triangles = sheet.triangles;
  return joined(lower, mapped(lower, [share](const Point_3& p) {
                  return Point_3(p.x() + 0.013 * share, p.y() + 0.007 * share, p.z() + 0.002 * share);
                }));
}

/// A sheet of 6 × 6 squares, and a needle that stands in it: a triangle that meets it between two points.
Triangle_soup sheet_with_needle(double from, double to, double y)
{
  const double middle = (from + to) / 2, half = to - from;
  return joined(sheet(6, 6),
                soup({{middle - half, y, -1}, {middle + half, y, -1}, {middle, y, 1}}, {{0, 1, 2}}));
}
// The needle stands in the face of vertices 16, 17 and 24 alone, which the collapse of 16 onto 17 removes.
// Then it stands in one other face, or in two.
const Triangle_soup s_narrow = sheet_with_needle(2.5, 2.7, 2.2), s_wide = sheet_with_needle(2.5, 2.95, 2.2);

const std::string s_descend = "defects descend\n";

TEST(Descent, ReachesWhatFreezingDoesNot)
{
  const Triangle_soup soup = sheets_through_each_other(3000);
  const Reduction frozen = reduce(soup, to_ratio(0.1), with(Defects::freeze));
  const std::size_t before = frozen.prepared.offending_pairs.size();
  ASSERT_GT(before, 100u);
  EXPECT_EQ(frozen.verification.pairs.size(), before);
  const Reduction descended = reduce(soup, to_ratio(0.1), with(Defects::descend));
  EXPECT_TRUE(descended.simplified.report.is_reached());
  EXPECT_LT(2 * descended.simplified.soup.triangles.size(), frozen.simplified.soup.triangles.size());
  EXPECT_TRUE(descended.verification.accepted());
  EXPECT_TRUE(descended.verification.same_topology());
  EXPECT_LT(descended.verification.pairs.size(), before);
  EXPECT_EQ(descended.prepared.frozen_faces, 0u);
}

TEST(Descent, HoldsWithEveryMeans)
{
  const Triangle_soup soup = sheets_through_each_other(1500);
  const std::vector<Simplify_options> all = every_means(without_limits(to_ratio(0.05)), 300);
  for (const Simplify_options& options : all) {
    SCOPED_TRACE(&options - all.data());
    const Prepared_soup prepared = prepare(soup, with(Defects::descend));
    const Logged_reduction reduction = reduce_and_log(soup, options, with(Defects::descend));
    const Verification verification = verify(reduction.simplified, prepared);
    EXPECT_TRUE(verification.accepted());
    EXPECT_LE(verification.pairs.size(), prepared.offending_pairs.size());
    EXPECT_TRUE(reduction.simplified.report.is_reached());
    const Replay_verdict verdict = replay_text(soup, reduction.log);
    EXPECT_TRUE(verdict.is_accepted())
        << verdict.violations.front().step << ": " << verdict.violations.front().message;
    EXPECT_EQ(options.faces_per_cell > 0, reduction.simplified.report.collapses_in_cells > 0);
  }
}

TEST(Descent, DoesNotDependOnTheIndex)
{
  Simplify_options options = without_limits(to_ratio(0.02));
  const Triangle_soup soup = sheets_through_each_other(1000);
  const Reduction packed = reduce(soup, options, with(Defects::descend));
  options.index = Face_index::clusters;
  const Reduction clusters = reduce(soup, options, with(Defects::descend));
  EXPECT_GT(packed.simplified.report.intersections.refused_by_descent, 0u);
  EXPECT_EQ(packed.simplified.collapses, clusters.simplified.collapses);
}

TEST(Descent, SpreadsNoDefect)
{
  for (const Triangle_soup& defective :
       {bowtie(), book(), vertex_touching_face(), edge_touching_edge(), crossing(), coplanar_overlap(),
        coplanar_inside(), duplicate(), opposite_duplicate(), t_junction(), folded_over(),
        collinear_triangle(), moebius_band(), fan_of_three()}) {
    const Reduction reduction =
        reduce(joined(sheet(6, 6, 50), defective), without_limits(to_ratio(0.01)), with(Defects::descend));
    EXPECT_TRUE(reduction.verification.accepted());
    EXPECT_LE(reduction.verification.pairs.size(), reduction.prepared.offending_pairs.size());
    EXPECT_TRUE(reduction.verification.same_topology());
    EXPECT_GT(reduction.simplified.report.collapses, 20u);
  }
}

TEST(Descent, OfDegenerateFacesIsThatOfOneThatHasNotChanged)
{
  const Triangle_soup before = joined(collinear_triangle(), sheet(1, 1, 5));
  Triangle_soup after = before;
  after.points[0] = Point_3(-1, 0, 0);
  const auto pairs = offending_pairs(before);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_TRUE(pairs_without_descent(before, pairs, before, pairs, {}, {0, 1, 2}).empty());
  EXPECT_EQ(pairs_without_descent(after, pairs, before, pairs, {}, {0, 1, 2}).size(), 1u) << "it has moved";
  const std::vector<Offending_pair> claimed{{1, 1, Offence::degenerate}};
  EXPECT_EQ(pairs_without_descent(before, claimed, before, pairs, {}, {0, 1, 2}).size(), 1u)
      << "it is another";
}

Triangle_soup sheet_with_needles()
{
  Triangle_soup soup = mapped(
      sheet(8, 8), [](const Point_3& p) { return Point_3(p.x(), p.y(), 0.125 * (int(p.x() * p.y()) % 3)); });
  const std::size_t faces = soup.triangles.size();
  for (std::size_t t = 0; t < faces; t += 4)
    add_needle(soup, t, 2); // a diagonal
  return soup;
}

TEST(Descent, LetsDegenerateFacesGo)
{
  const Triangle_soup soup = sheet_with_needles();
  const auto pairs = offending_pairs(soup);
  ASSERT_EQ(std::count_if(pairs.begin(), pairs.end(),
                          [](const Offending_pair& pair) { return pair.first == pair.second; }),
            32);
  const std::vector<Simplify_options> all = every_means(without_limits(to_ratio(0.05)), 50);
  for (const Simplify_options& options : all) {
    SCOPED_TRACE(&options - all.data());
    const Logged_reduction reduction = reduce_and_log(soup, options, with(Defects::descend));
    const Verification verification = verify(reduction.simplified, prepare(soup, with(Defects::descend)));
    EXPECT_TRUE(verification.accepted());
    EXPECT_EQ(verification.pairs.size(), 0u);
    EXPECT_TRUE(reduction.simplified.report.is_reached());
    EXPECT_TRUE(replay_text(soup, reduction.log).is_accepted());
  }
  const Reduction frozen = reduce(soup, all[0], with(Defects::freeze));
  EXPECT_FALSE(frozen.simplified.report.is_reached());
  EXPECT_EQ(frozen.verification.pairs.size(), pairs.size());
}

TEST(Descent, LeavesADegenerateFaceThatIsAPieceOfItsOwn)
{
  const Triangle_soup soup = joined(sheet(4, 4, 50), collinear_triangle());
  const Reduction reduction = reduce(soup, without_limits(to_ratio(0)), with(Defects::descend));
  EXPECT_EQ(reduction.prepared.frozen_faces, 0u);
  EXPECT_EQ(reduction.simplified.triangles.back(), soup.triangles.size() - 1);
  EXPECT_EQ(reduction.verification.pairs.size(), 1u);
}

// The control of the judge: without the collapses, the pairs of the result are as new as any.
TEST(Descent, IsNotGrantedWithoutItsCollapses)
{
  const Reduction reduction = reduce(sheets_through_each_other(1000), to_ratio(0.1), with(Defects::descend));
  ASSERT_TRUE(reduction.verification.accepted());
  ASSERT_GT(reduction.verification.pairs.size(), 0u);
  Simplified_soup result = reduction.simplified;
  result.collapses.clear();
  EXPECT_EQ(verify(result, reduction.prepared).new_pairs.size(), reduction.verification.pairs.size());
}

TEST(Descent, IsOfPairsAndNotOfFaces)
{
  // Each of three triangles crosses the next one. The first and the third never met.
  const auto crossing_at = [](double x) {
    return soup({{x, 0, 0}, {x + 1.5, 0, 0}, {x, 1, 1}}, {{0, 1, 2}});
  };
  const Triangle_soup before = joined(joined(crossing_at(0), crossing_at(1)), crossing_at(2));
  const auto pairs = offending_pairs(before);
  ASSERT_EQ(pairs.size(), 2u);
  const std::vector<Offending_pair> claimed{{0, 1, Offence::intersection}, {0, 2, Offence::intersection}};
  const auto without = pairs_without_descent(before, claimed, before, pairs, {}, {0, 1, 2});
  ASSERT_EQ(without.size(), 1u);
  EXPECT_EQ(without[0].second, 2u);
}

TEST(Descent, NeverIsOfMorePairsThanThereWere)
{
  const Triangle_soup before = crossing();
  const auto pairs = offending_pairs(before);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_TRUE(pairs_without_descent(before, pairs, before, pairs, {}, {0, 1}).empty());
  const std::vector<Offending_pair> twice{pairs[0], pairs[0]};
  EXPECT_EQ(pairs_without_descent(before, twice, before, pairs, {}, {0, 1}).size(), 1u);
}

// What the filter says of the collapse of one vertex onto another.
bool is_accepted(const Triangle_soup& soup, bool is_exempt, Index target = 17, Index mover = 16,
                 double shallow = std::numeric_limits<double>::infinity())
{
  return is_collapse_accepted(soup, mover, target, [&](const Intersection_filter<Filtered_mesh>& filter) {
    if (!is_exempt)
      return;
    std::vector<std::pair<Filtered_mesh::Face_index, Filtered_mesh::Face_index>> pairs;
    for (const Offending_pair& pair : offending_pairs(soup))
      pairs.emplace_back(pair.first, pair.second);
    filter.exempt(pairs, {}, shallow);
  });
}

TEST(Descent, PassesFromFacesThatAreRemoved)
{
  EXPECT_TRUE(is_accepted(s_narrow, true));
  EXPECT_FALSE(is_accepted(s_narrow, false)) << "no pair is exempt by default";
}

TEST(Descent, RefusesAStepToMorePairs)
{
  EXPECT_FALSE(is_accepted(s_wide, true));
}

// A needle that stands in a slope of the sheet, 0.4 high there, which the collapse of 16 onto 17 flattens.
Triangle_soup slope_with_needle(double height)
{
  Triangle_soup slope = sheet(6, 6);
  slope.points[16] = Point_3(2, 2, 1);
  return joined(slope, soup({{2.55, 2.2, -1}, {2.65, 2.2, -1}, {2.6, 2.2, height}}, {{0, 1, 2}}));
}

TEST(Descent, RefusesAStepFromAShallowPairToADeepOne)
{
  const Triangle_soup shallow = slope_with_needle(0.45);
  ASSERT_EQ(offending_pairs(shallow).size(), 1u);
  EXPECT_TRUE(is_accepted(shallow, true)) << "by default there is no limit";
  EXPECT_TRUE(is_accepted(shallow, true, 17, 16, 0.5));
  EXPECT_FALSE(is_accepted(shallow, true, 17, 16, 0.1));
  const Triangle_soup deep = slope_with_needle(0.8);
  ASSERT_EQ(offending_pairs(deep).size(), 1u);
  EXPECT_TRUE(is_accepted(deep, true, 17, 16, 0.1)) << "it is deep already";
}

double deepest_pair(const Triangle_soup& soup)
{
  const auto triangle = [&](Index t) {
    const auto [a, b, c] = soup.triangles[t];
    return std::array<Point_3, 3>{soup.points[a], soup.points[b], soup.points[c]};
  };
  double deepest = 0;
  for (const Offending_pair& pair : offending_pairs(soup))
    deepest = std::max(deepest, internal::piercing_depth(triangle(pair.first), triangle(pair.second)));
  return deepest;
}

TEST(Descent, KeepsShallowPairsShallow)
{
  const Triangle_soup sheets = sheets_through_each_other(3000, 0.1);
  const CGAL::Bbox_3 box = CGAL::bbox_3(sheets.points.begin(), sheets.points.end());
  const double shallow = Simplify_constraints<Filtered_mesh>::s_share_of_shallow_pairs *
                         std::hypot(box.x_span(), box.y_span(), box.z_span());
  const double before = deepest_pair(sheets);
  EXPECT_GT(before, 0);
  ASSERT_LE(before, shallow);
  // The control: beside something far away, all these pairs are shallow, however deep.
  const Triangle_soup small_sheets =
      joined(sheets, soup({{100, 0, 0}, {101, 0, 0}, {100, 1, 0}}, {{0, 1, 2}}));
  const auto deepest_after = [](const Triangle_soup& scene, double ratio) {
    const Reduction reduction = reduce(scene, without_limits(to_ratio(ratio)), with(Defects::descend));
    return deepest_pair(reduction.simplified.soup);
  };
  for (const double ratio : {0.1, 0.02}) {
    EXPECT_LE(deepest_after(sheets, ratio), shallow) << ratio;
    EXPECT_GT(deepest_after(small_sheets, ratio), 2 * shallow) << ratio;
  }
}

TEST(Descent, MovesNoDegenerateFaceInTheFilter)
{
  Triangle_soup bent = sheet(6, 6);
  bent.points[16] = Point_3(2.5, 2, 0);
  EXPECT_TRUE(is_accepted(bent, true));
  bent.points[16] = Point_3(3, 2.5, 0); // between the two other corners of a face
  const auto pairs = offending_pairs(bent);
  ASSERT_TRUE(std::any_of(pairs.begin(), pairs.end(),
                          [](const Offending_pair& pair) { return pair.offence == Offence::degenerate; }));
  EXPECT_FALSE(is_accepted(bent, true, 15));
  EXPECT_TRUE(is_accepted(bent, true)) << "it may be contracted";
}

// The collapse contracts a degenerate face, and a face that another one crosses, so that there is room for a
// pair. Two of the faces that move would cross: nothing exempts them.
TEST(Descent, ExemptsNothingForADegenerateFace)
{
  const Triangle_soup star =
      soup({{3, 2.5, 0}, {3, 2, 0}, {3, 3, 0}, {2, 3, 0}, {2.8, 2.4, 1}, {2.8, 2.4, -1}, {2, 1, 0}},
           {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}});
  const Triangle_soup both =
      joined(star, soup({{2.7, 1.9, -0.1}, {2.71, 1.9, -0.1}, {2.7, 1.9, 0.1}}, {{0, 1, 2}}));
  ASSERT_EQ(offending_pairs(both).size(), 2u);
  EXPECT_FALSE(is_accepted(both, true, 1, 0));
  Triangle_soup farther = both;
  for (const Index v : {4, 5})
    farther.points[v] = Point_3(2, 2, both.points[v].z());
  ASSERT_EQ(offending_pairs(farther).size(), 2u);
  EXPECT_TRUE(is_accepted(farther, true, 1, 0)) << "they are out of each other's way";
}

TEST(Replay, ADegenerateFaceMayBeContractedAndNotMoved)
{
  Triangle_soup bent = sheet(6, 6);
  bent.points[16] = Point_3(3, 2.5, 0); // between vertices 17 and 24
  EXPECT_TRUE(replay_text(bent, head_of(bent, s_descend) + "c 16 17\nresult 1 70 -\n").is_accepted());
  for (const char* const moving : {"c 16 15\n", "c 16 17 3 2.25 0\n"}) {
    const auto verdict = replay_text(bent, head_of(bent, s_descend) + moving + "result 1 70 -\n");
    ASSERT_EQ(verdict.violations.size(), 1u);
    EXPECT_EQ(verdict.violations[0].kind, Violation_kind::degenerate);
  }
}

TEST(Replay, PairsMayDescendFromFacesThatAreRemoved)
{
  EXPECT_TRUE(replay_text(s_narrow, head_of(s_narrow, s_descend) + "c 16 17\nresult 1 71 -\n").is_accepted());
}

TEST(Replay, PairsMayNotDescendUnlessTheLogSaysSo)
{
  for (const char* const line : {"", "defects freeze\n"}) {
    const auto verdict = replay_text(s_narrow, head_of(s_narrow, line) + "c 16 17\nresult 1 71 -\n");
    ASSERT_EQ(verdict.violations.size(), 1u);
    EXPECT_EQ(verdict.violations[0].kind, Violation_kind::locked);
  }
}

TEST(Replay, PairsMayDescendButNotBecomeMore)
{
  const auto verdict = replay_text(s_wide, head_of(s_wide, s_descend) + "c 16 17\nresult 1 71 -\n");
  ASSERT_EQ(verdict.violations.size(), 1u);
  EXPECT_EQ(verdict.violations[0].kind, Violation_kind::intersection);
  EXPECT_NE(verdict.violations[0].message.find("more pairs"), std::string::npos);
}

// A second triangle, under a bump of the sheet beside the needle, offends with nothing. The collapse flattens
// the bump.
TEST(Replay, PairsMayDescendOnlyFromPairsThatOffended)
{
  const Triangle_soup second = soup({{1.95, 2.1, 0.1}, {2.05, 2.1, 0.1}, {2, 2.1, 0.2}}, {{0, 1, 2}});
  Triangle_soup both = joined(s_narrow, second);
  both.points[16] = Point_3(2, 2, 0.5);
  ASSERT_EQ(offending_pairs(both).size(), 1u);
  const auto verdict = replay_text(both, head_of(both, s_descend) + "c 16 17\nresult 1 72 -\n");
  ASSERT_EQ(verdict.violations.size(), 1u);
  EXPECT_EQ(verdict.violations[0].kind, Violation_kind::tunnelling);
  EXPECT_EQ(verdict.violations[0].triangles.back(), 73u) << verdict.violations[0].message;
}

TEST(Replay, PairsMayDescendWithWhatALogDoesNotHold)
{
  const Triangle_soup obstacle = mapped(sheet(2, 2), [](const Point_3& p) {
    return Point_3(p.z() + 0.51, 0.6 * p.x() + 0.21, 0.3 * p.y() - 0.31);
  });
  Triangle_soup garment = sheets_through_each_other(800);
  const Logged_reduction reduction =
      reduce_and_log(garment, without_limits(to_ratio(0.05)), with(Defects::descend), false, obstacle);
  const Prepared_soup prepared = prepare(garment, with(Defects::descend), obstacle);
  const Index own = Index(garment.triangles.size());
  ASSERT_TRUE(std::any_of(prepared.offending_pairs.begin(), prepared.offending_pairs.end(),
                          [&](const Offending_pair& pair) { return pair.second >= own; }));
  EXPECT_TRUE(verify(reduction.simplified, prepared).accepted());
  const auto verdict = replay_text(garment, reduction.log);
  EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
  const auto open = not_judged(verdict);
  EXPECT_TRUE(
      std::any_of(open.begin(), open.end(), [](const Not_judged& what) { return what.key == "pairs"; }));
}

TEST(Log, StatesThePolicyForDefectsOnce)
{
  const Triangle_soup soup = sheet(2, 2);
  for (const char* const line : {"defects\n", "defects refuse\n", "defects descend\ndefects descend\n"})
    EXPECT_THROW(replay_text(soup, head_of(soup, line) + "result 0 8 -\n"), Input_error) << line;
  EXPECT_TRUE(replay_text(soup, head_of(soup, s_descend) + "result 0 8 -\n").is_accepted());
}

} // namespace
} // namespace selvedge::test
