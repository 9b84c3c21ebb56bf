// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/generate.h>
#include <selvedge/verify.h>

#include "support/threads.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace selvedge {

bool operator==(const Offending_pair& a, const Offending_pair& b)
{
  return std::tie(a.first, a.second, a.offence) == std::tie(b.first, b.second, b.offence);
}

namespace {

using test::with_threads;

// Layers, large enough for many tasks, and pushed into one another.
Triangle_soup garment(std::size_t faces)
{
  Generate_options options;
  options.faces = faces;
  return generate("skirt", options);
}

Triangle_soup tangle()
{
  Triangle_soup soup = garment(20'000);
  for (std::size_t v = 0; v < soup.points.size(); v += 7) {
    const Point_3& p = soup.points[v];
    soup.points[v] = Point_3(p.x() * 1.01, p.y() * 1.01, p.z());
  }
  return soup;
}

TEST(VerifyThreads, OffendingPairsDoNotDependOnThem)
{
  const Triangle_soup soup = tangle();
  const auto judge = [&] { return offending_pairs(soup); };
  const std::vector<Offending_pair> alone = with_threads(1, judge);
  ASSERT_GT(alone.size(), 1000u);
  for (const std::size_t threads : {2, 5, 16})
    EXPECT_EQ(with_threads(threads, judge), alone) << threads << " threads";
}

TEST(VerifyThreads, FirstOffenceStopsAll)
{
  const auto is_good = [](const Triangle_soup& soup, std::size_t threads) {
    return with_threads(threads, [&] { return is_embedded(soup); });
  };
  for (const std::size_t threads : {1, 2, 16}) {
    EXPECT_FALSE(is_good(tangle(), threads));
    EXPECT_TRUE(is_good(garment(20'000), threads));
  }
}

TEST(VerifyThreads, PosesDoNotDependOnThemAndStayInOrder)
{
  Triangle_soup before = garment(2'000);
  before.poses = moving_poses(before, 5);
  Triangle_soup after = before; // in each pose, other vertices are pushed into the next layer
  for (std::size_t pose = 0; pose < after.poses.size(); ++pose)
    for (std::size_t v = pose; v < after.points.size(); v += 20) {
      Point_3& p = after.poses[pose].points[v];
      p = Point_3(p.x() * 1.01, p.y() * 1.01, p.z());
    }
  const auto judge = [&] {
    const Verification verification = verify(after, before);
    std::vector<std::tuple<std::string, std::vector<Offending_pair>, std::vector<Offending_pair>>> poses;
    for (const Verification::In_pose& pose : verification.poses)
      poses.emplace_back(pose.name, pose.pairs, pose.new_pairs);
    return poses;
  };
  const auto alone = with_threads(1, judge);
  ASSERT_EQ(alone.size(), 5u);
  for (std::size_t pose = 0; pose < alone.size(); ++pose) {
    Triangle_soup in_pose = after;
    in_pose.points = after.poses[pose].points;
    EXPECT_EQ(std::get<0>(alone[pose]), before.poses[pose].name);
    EXPECT_EQ(std::get<1>(alone[pose]), offending_pairs(in_pose));
    EXPECT_GT(std::get<2>(alone[pose]).size(), 0u);
  }
  for (const std::size_t threads : {2, 5})
    EXPECT_EQ(with_threads(threads, judge), alone) << threads << " threads";
}

TEST(VerifyThreads, DistancesDoNotDependOnThemToTheLastBit)
{
  const Triangle_soup soup = tangle(), other = garment(15'000);
  const auto measure = [&] {
    const Distances d = distances(soup, other);
    return std::make_tuple(d.original_to_result.root_mean_square, d.original_to_result.maximum,
                           d.result_to_original.root_mean_square, d.result_to_original.maximum);
  };
  const auto alone = with_threads(1, measure);
  EXPECT_GT(std::get<0>(alone), 0);
  for (const std::size_t threads : {2, 5, 16})
    EXPECT_EQ(with_threads(threads, measure), alone) << threads << " threads";
}

} // namespace
} // namespace selvedge
