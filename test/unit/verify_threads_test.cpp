// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/generate.h>
#include <selvedge/verify.h>

#include "support/threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
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
