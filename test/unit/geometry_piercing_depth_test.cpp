// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Triangle_soup.h>
#include <selvedge/geometry/internal/piercing_depth.h>

#include <gtest/gtest.h>

#include <array>

namespace selvedge::test {
namespace {

TEST(Piercing_depth, IsTheLengthOfAShortTranslationThatParts)
{
  using Triangle = std::array<Point_3, 3>;
  const auto depth = [](const Triangle& f, const Triangle& g) { return internal::piercing_depth(f, g); };
  const Triangle flat{Point_3(0, 0, 0), Point_3(8, 0, 0), Point_3(0, 8, 0)};
  const Triangle tip{Point_3(2, 2, -0.25), Point_3(1, 2, 3), Point_3(3, 2, 3)};
  EXPECT_EQ(depth(flat, tip), 0.25);
  EXPECT_EQ(depth(tip, flat), 0.25);
  const Triangle near_side{Point_3(4, 0.125, -3), Point_3(3, 0.125, 3), Point_3(5, 0.125, 3)};
  EXPECT_EQ(depth(flat, near_side), 0.125) << "it goes off sideways";
  const Triangle apart{Point_3(2, 2, 1), Point_3(1, 2, 3), Point_3(3, 2, 3)};
  EXPECT_EQ(depth(flat, apart), 0);
  const Triangle crossing_edges{Point_3(4, 0.25, -0.25), Point_3(4, -4, 4), Point_3(4, 0, 8)};
  EXPECT_GT(depth(flat, crossing_edges), 0);
  EXPECT_LT(depth(flat, crossing_edges), 0.25) << "across an edge of each";
  const Triangle line{Point_3(1, 1, -1), Point_3(1, 1, 1), Point_3(1, 1, 2)};
  EXPECT_EQ(depth(flat, line), 0) << "a degenerate one";
}

} // namespace
} // namespace selvedge::test
