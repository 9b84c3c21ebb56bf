// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Whether two faces that stand still offend: the predicate of the filter against the judge.

#include "support/soups.h"

#include <selvedge/geometry/face_pair.h>
#include <selvedge/verify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace selvedge::test {
namespace {

using Corners = std::array<Point_3, 3>;

Corners drawn_corners(std::mt19937& random)
{
  const auto coordinate = [&] { return double(random() % 3); };
  Corners face;
  do {
    for (Point_3& corner : face)
      corner = Point_3(coordinate(), coordinate(), coordinate());
  } while (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]);
  return face;
}

// On a grid so coarse that every degeneracy occurs.
TEST(Face_pair, OffendsWhereTheJudgeSaysSo)
{
  std::mt19937 random(1);
  std::array<std::size_t, 4> offending{}, clear{}; // by the number of common positions
  std::size_t collinear = 0;
  for (int i = 0; i < 60000; ++i) {
    const Corners face = drawn_corners(random), other = drawn_corners(random);
    if (CGAL::collinear(face[0], face[1], face[2]))
      continue;
    Triangle_soup both;
    both.points.assign(face.begin(), face.end());
    both.points.insert(both.points.end(), other.begin(), other.end());
    both.triangles = {{0, 1, 2}, {3, 4, 5}};
    const auto pairs = offending_pairs(both);
    const bool is_offending = std::any_of(
        pairs.begin(), pairs.end(), [](const Offending_pair& pair) { return pair.first != pair.second; });
    ASSERT_EQ(do_faces_offend(face, other), is_offending) << "pair " << i;
    const auto common = std::count_if(other.begin(), other.end(), [&](const Point_3& p) {
      return std::find(face.begin(), face.end(), p) != face.end();
    });
    ++(is_offending ? offending : clear)[std::size_t(common)];
    collinear += CGAL::collinear(other[0], other[1], other[2]);
  }
  for (std::size_t common = 0; common < 3; ++common) {
    EXPECT_GT(offending[common], 50u) << common;
    EXPECT_GT(clear[common], 50u) << common;
  }
  EXPECT_GT(offending[3], 5u);
  EXPECT_EQ(clear[3], 0u);
  EXPECT_GT(collinear, 500u);
}

} // namespace
} // namespace selvedge::test
