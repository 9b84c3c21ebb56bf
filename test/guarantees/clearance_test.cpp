// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Pieces keep a distance from each other, or at least the one that they have.

#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace selvedge::test {
namespace {

// Between the layers, along the vertical; the waves make it less.
constexpr double layer_gap = 2e-4;

Triangle_soup wavy_sheet(std::size_t faces)
{
  const Triangle_soup one = sheets(faces, 1, 1e-3);
  Triangle_soup sheet;
  sheet.points = one.points;
  sheet.triangles = one.triangles;
  return sheet;
}

Triangle_soup wavy_layers(std::size_t faces)
{
  const Triangle_soup sheet = wavy_sheet(faces / 2);
  return joined(sheet, moved(sheet, 0, 0, layer_gap));
}

Simplify_options with_clearance(Simplify_options options, double distance)
{
  options.clearance = distance;
  return options;
}

/// What the judge says of a result for which no distance was kept.
Clearance_verdict judged(const Triangle_soup& result, const Triangle_soup& original, double distance)
{
  Verify_options options;
  options.clearance = distance;
  return *verify(result, original, options).clearance;
}

TEST(Clearance_of_pieces, IsKeptByEveryMeans)
{
  const Triangle_soup soup = wavy_layers(1200);
  const std::vector<Simplify_options> all = every_means(without_limits(to_ratio(0.2)));
  for (const Simplify_options& options : all)
    for (const double distance : {0.9 * layer_gap, 2 * layer_gap}) {
      SCOPED_TRACE(testing::Message() << "means " << &options - all.data() << ", distance " << distance);
      const Simplified_soup control = reduce(soup, options).simplified;
      EXPECT_EQ(judged(control.soup, soup, distance).too_near(), 1u) << "the control";

      const Reduction guarded = reduce(soup, with_clearance(options, distance));
      EXPECT_TRUE(guarded.verification.accepted());
      ASSERT_TRUE(guarded.verification.clearance);
      EXPECT_EQ(guarded.verification.clearance->too_near(), 0u);
      EXPECT_EQ(judged(guarded.simplified.soup, soup, distance).too_near(), 0u);
      EXPECT_GE(guarded.verification.clearance->least.upper,
                std::min(distance, guarded.verification.clearance->least_of_original->lower));
      EXPECT_GT(guarded.simplified.report.collapses, 100u);
      EXPECT_GT(guarded.simplified.report.refused.clearance, 0u);
      EXPECT_EQ(control.report.refused.clearance, 0u);
    }
}

TEST(Clearance_of_pieces, IsKeptInEveryPose)
{
  Triangle_soup soup = wavy_layers(800);
  Pose nearer{"nearer", soup.points};
  for (std::size_t v = soup.points.size() / 2; v < soup.points.size(); ++v)
    nearer.points[v] = Point_3(soup.points[v].x(), soup.points[v].y(), soup.points[v].z() - 0.5 * layer_gap);
  soup.poses.push_back(nearer);
  const double distance = 0.4 * layer_gap;
  Simplify_options options = with_clearance(without_limits(to_ratio(0.2)), distance);
  options.guarded_poses = std::vector<std::size_t>();
  const Reduction in_first = reduce(soup, options);
  EXPECT_EQ(in_first.verification.clearance->too_near(), 0u);
  ASSERT_TRUE(in_first.verification.poses[0].clearance);
  EXPECT_GT(in_first.verification.poses[0].clearance->too_near(), 0u) << "the control";
  EXPECT_FALSE(in_first.verification.is_clearance_kept());
  EXPECT_FALSE(in_first.verification.accepted());

  options.guarded_poses.reset();
  const Reduction guarded = reduce(soup, options);
  EXPECT_TRUE(guarded.verification.accepted());
  EXPECT_EQ(guarded.verification.poses[0].clearance->too_near(), 0u);
  EXPECT_GT(guarded.simplified.report.collapses, 100u);
}

TEST(Clearance_of_pieces, IsKeptFromAnObstacle)
{
  const Triangle_soup sheet = wavy_sheet(1000), below = moved(sheet, 0, 0, -layer_gap);
  const auto result_of = [&](const Simplify_options& options) {
    const Prepared_soup prepared = prepare(sheet, {}, below);
    Simplified_soup result = simplify_soup(prepared, options);
    result.clearance = 0.9 * layer_gap; // the control is judged by it as well
    return verify(result, prepared).clearance->too_near();
  };
  const Simplify_options options = without_limits(to_ratio(0.2));
  EXPECT_EQ(result_of(options), 1u) << "the control";
  EXPECT_EQ(result_of(with_clearance(options, 0.9 * layer_gap)), 0u);
}

// An obstacle has a corner at a vertex of either sheet. If it connected the two, they would be one piece,
// which may come together as near as it likes.
TEST(Clearance_of_pieces, IsKeptBetweenPiecesThatShareVerticesWithAnObstacle)
{
  const Triangle_soup soup = wavy_layers(1000);
  const Point_3 &below = soup.points.front(), &above = soup.points[soup.points.size() / 2];
  const Triangle_soup obstacle = test::soup(
      {{below.x(), below.y(), below.z()}, {above.x(), above.y(), above.z()}, {below.x() - 1, below.y(), 0}},
      {{0, 1, 2}});
  const double distance = 0.9 * layer_gap;
  const Simplify_options options = without_limits(to_ratio(0.2));
  const auto judged_pair = [&](const Simplified_soup& result) { return judged(result.soup, soup, distance); };
  const Simplified_soup control = reduce_and_log(soup, options, {}, false, obstacle).simplified;
  EXPECT_EQ(judged_pair(control).too_near(), 1u) << "the control";

  const Logged_reduction guarded =
      reduce_and_log(soup, with_clearance(options, distance), {}, false, obstacle);
  EXPECT_EQ(judged_pair(guarded.simplified).too_near(), 0u);
  EXPECT_GT(guarded.simplified.report.collapses, 100u);
  Replay_options options_of_replay;
  options_of_replay.obstacle = obstacle;
  EXPECT_TRUE(replay_text(soup, guarded.log, options_of_replay).is_accepted());
  options_of_replay.limits.emplace();
  options_of_replay.limits->clearance = distance;
  EXPECT_FALSE(replay_text(soup, reduce_and_log(soup, options, {}, false, obstacle).log, options_of_replay)
                   .is_accepted());

  // The judge, too, has three pieces: the control brings the sheets too near to each other.
  const Prepared_soup prepared = prepare(soup, {}, obstacle);
  Simplified_soup by_control = control;
  by_control.clearance = distance;
  EXPECT_EQ(verify(by_control, prepared).clearance->too_near(), 1u);
  EXPECT_EQ(verify(guarded.simplified, prepared).clearance->too_near(), 0u);
}

TEST(Clearance_of_pieces, IsJudgedByReplay)
{
  const Triangle_soup soup = wavy_layers(600);
  const double distance = 0.5 * layer_gap;
  const Simplify_options options = without_limits(to_ratio(0.2));
  const Logged_reduction guarded = reduce_and_log(soup, with_clearance(options, distance)),
                         control = reduce_and_log(soup, options);
  EXPECT_TRUE(replay_text(soup, guarded.log).is_accepted());
  EXPECT_EQ(replay_text(soup, guarded.log).limits.clearance, distance) << "the log declares it";

  Replay_options imposed;
  imposed.limits.emplace();
  imposed.limits->clearance = distance;
  EXPECT_TRUE(replay_text(soup, guarded.log, imposed).is_accepted());
  const Replay_verdict verdict = replay_text(soup, control.log, imposed);
  ASSERT_FALSE(verdict.violations.empty()) << "the control";
  EXPECT_EQ(verdict.violations.front().kind, Violation_kind::clearance);
}

TEST(Clearance_of_pieces, IsExactToTheLastBit)
{
  const Triangle_soup soup = joined(joined(sheet(2, 2, 0), sheet(2, 2, 0.25)), sheet(2, 2, 8));
  Verify_options options;
  options.clearance = 0.25;
  EXPECT_TRUE(verify(soup, options).clearance->near.empty());
  options.clearance = std::nextafter(0.25, 1.);
  const Clearance_verdict verdict = *verify(soup, options).clearance;
  ASSERT_EQ(verdict.near.size(), 1u);
  EXPECT_TRUE(verdict.near[0].is_too_near);
  EXPECT_EQ(verdict.near[0].first, 0u);
  EXPECT_EQ(verdict.near[0].second, 8u);
  EXPECT_LE(verdict.least.lower, 0.25);
  EXPECT_GE(verdict.least.upper, 0.25);
  EXPECT_LT(verdict.least.upper - verdict.least.lower, 1e-12);
  EXPECT_EQ(judged(soup, soup, 1).too_near(), 0u) << "no nearer than they were";

  // The second sheet comes nearer by one bit.
  Triangle_soup nearer = soup;
  for (std::size_t v = 9; v < 18; ++v)
    nearer.points[v] = Point_3(nearer.points[v].x(), nearer.points[v].y(), std::nextafter(0.25, 0.));
  EXPECT_EQ(judged(nearer, soup, 1).too_near(), 1u);
}

// Needles that hold the sheets together; a reduction leaves them out, and then keeps the sheets apart.
TEST(Clearance_of_pieces, IsJudgedBetweenPiecesThatNeedlesConnect)
{
  const Triangle_soup apart = joined(sheet(2, 2), sheet(2, 2, 0.25));
  Triangle_soup connected = apart;
  connected.points.push_back(connected.points[4]);
  connected.triangles.insert(connected.triangles.begin(), {4, 18, 13});
  Triangle_soup nearer = apart;
  nearer.points[13] = Point_3(1, 1, 0.125);

  const Clearance_verdict verdict = judged(nearer, connected, 1);
  ASSERT_EQ(verdict.near.size(), 1u);
  EXPECT_TRUE(verdict.near[0].is_too_near);
  EXPECT_EQ(verdict.near[0].before.lower, judged(nearer, apart, 1).near[0].before.lower);
  EXPECT_EQ(judged(apart, connected, 1).too_near(), 0u);
  EXPECT_EQ(judged(connected, apart, 1).too_near(), 0u);

  Verify_options options;
  options.clearance = 1;
  const Clearance_verdict alone = *verify(connected, options).clearance;
  ASSERT_EQ(alone.near.size(), 1u);
  EXPECT_EQ(alone.near[0].first, 1u);
  EXPECT_EQ(alone.near[0].now.lower, verify(apart, options).clearance->near[0].now.lower);

  // In a pose in which a face is such a needle, it is a face of its piece as before.
  Triangle_soup posed = apart, nearer_in_pose = apart;
  posed.poses = {{"flat", apart.points, 0}};
  posed.poses[0].points[0] = posed.poses[0].points[1];
  nearer_in_pose.poses = posed.poses;
  nearer_in_pose.poses[0].points[13] = Point_3(1, 1, 0.125);
  const auto near_in_pose = [&](const Triangle_soup& result) {
    return verify(result, posed, options).poses[0].clearance->near;
  };
  EXPECT_EQ(near_in_pose(posed).size(), 1u);
  EXPECT_FALSE(near_in_pose(posed)[0].is_too_near);
  ASSERT_EQ(near_in_pose(nearer_in_pose).size(), 1u);
  EXPECT_TRUE(near_in_pose(nearer_in_pose)[0].is_too_near);
}

TEST(Clearance_of_pieces, IsRefusedWhereItCannotBeKept)
{
  const Prepared_soup prepared = prepare(wavy_layers(400), {});
  Simplify_options options = with_clearance(to_ratio(0.5), layer_gap);
  options.faces_per_cell = 100;
  EXPECT_THROW(simplify_soup(prepared, options), Argument_error);
  EXPECT_THROW(simplify_soup(prepared, without_check(with_clearance(to_ratio(0.5), layer_gap))),
               Argument_error);
  EXPECT_THROW(simplify_soup(prepared, with_clearance(to_ratio(0.5), 0)), Argument_error);
  EXPECT_THROW(simplify_soup(prepared, with_clearance(to_ratio(0.5), HUGE_VAL)), Argument_error);
  EXPECT_THROW(judged(prepared.soup, prepared.soup, -1), Argument_error);
}

} // namespace
} // namespace selvedge::test
