// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/key_poses.h>

#include <gtest/gtest.h>

#include <vector>

namespace selvedge {
namespace {

using Numbers = std::vector<std::size_t>;

// A triangle, and poses in which it is shifted along the x axis.
Triangle_soup shifted_triangle(const std::vector<double>& shifts)
{
  const auto at = [](double x) { return std::vector<Point_3>{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}; };
  Triangle_soup soup;
  soup.points = at(0);
  soup.triangles = {{0, 1, 2}};
  for (const double shift : shifts) {
    Pose pose;
    pose.points = at(shift);
    soup.poses.push_back(pose);
  }
  return soup;
}

TEST(Key_poses, AreTheFarthestFromThoseChosenBefore)
{
  const Triangle_soup soup = shifted_triangle({1, 10, 11, -4});
  EXPECT_EQ(key_poses(soup, 1), Numbers({2}));
  EXPECT_EQ(key_poses(soup, 2), Numbers({2, 3}));    // 10 is farther from the mesh, and near to 11
  EXPECT_EQ(key_poses(soup, 3), Numbers({0, 2, 3})); // 1 and 10 are as far from others; the first is taken
}

TEST(Key_poses, AreAllWhereThereAreNoMore)
{
  const Triangle_soup soup = shifted_triangle({3, 3, 0});
  EXPECT_EQ(key_poses(soup, 3), Numbers({0, 1, 2}));
  EXPECT_EQ(key_poses(soup, 100), Numbers({0, 1, 2}));
  EXPECT_TRUE(key_poses(soup, 0).empty());
  EXPECT_TRUE(key_poses(shifted_triangle({}), 5).empty());
}

} // namespace
} // namespace selvedge
