// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/geometry/sweep.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

bool is_clear(const std::array<Point, 4>& sweep, const std::array<Point, 3>& face)
{
  return selvedge::is_sweep_clear<Kernel>(sweep[0], sweep[1], sweep[2], sweep[3], face[0], face[1], face[2]);
}

// Which sides of a plane the points of the sweep and of the face keep to, apart from those they share.
// A test that knows only planes through three of the given points has to choose what to do when all is
// coplanar.
bool has_separating_plane(const std::array<Point, 4>& sweep, const std::array<Point, 3>& face,
                          bool is_touching_allowed)
{
  std::array<Point, 7> all;
  std::copy(sweep.begin(), sweep.end(), all.begin());
  std::copy(face.begin(), face.end(), all.begin() + 4);
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        if (CGAL::collinear(all[i], all[j], all[k]))
          continue;
        std::array<int, 2> lowest{1, 1}, highest{-1, -1};
        for (std::size_t l = 0; l < 7; ++l) {
          const bool is_shared = std::count(all.begin(), all.end(), all[l]) > 1;
          const int side = CGAL::orientation(all[i], all[j], all[k], all[l]);
          if (is_shared)
            continue;
          lowest[l / 4] = std::min(lowest[l / 4], side);
          highest[l / 4] = std::max(highest[l / 4], side);
        }
        const int gap = std::max(lowest[0] - highest[1], lowest[1] - highest[0]);
        const bool is_weak = (lowest[0] >= 0 && highest[1] <= 0) || (lowest[1] >= 0 && highest[0] <= 0);
        if (is_touching_allowed ? is_weak : is_weak && gap > 0)
          return true;
      }
    }
  }
  return false;
}

// A flat grid of unit squares, where m = (1 1) goes to t = (2 1): nearly every face around is coplanar with
// the sweep.
const std::array<Point, 4> flat_sweep{Point(1, 1, 0), Point(2, 1, 0), Point(0, 1, 0), Point(0, 0, 0)};

TEST(Sweep, FlatGridIsClear)
{
  EXPECT_TRUE(is_clear(flat_sweep, {Point(0, 0, 0), Point(0, 1, 0), Point(-1, 0, 0)}));
  EXPECT_TRUE(is_clear(flat_sweep, {Point(0, 1, 0), Point(1, 2, 0), Point(0, 2, 0)}));
  EXPECT_TRUE(is_clear(flat_sweep, {Point(2, 1, 0), Point(3, 1, 0), Point(3, 2, 0)}));
  EXPECT_TRUE(is_clear(flat_sweep, {Point(5, 5, 0), Point(6, 5, 0), Point(5, 6, 0)}));
}

TEST(Sweep, FlatFoldIsNotClear)
{
  // The same plane, but the face lies under the moving one: sharing nothing, a, and the edge ab.
  EXPECT_FALSE(is_clear(flat_sweep, {Point(0.2, 0.5, 0), Point(0.4, 0.6, 0), Point(0.3, 0.7, 0)}));
  EXPECT_FALSE(is_clear(flat_sweep, {Point(0, 1, 0), Point(1, 0.9, 0), Point(1, 0.8, 0)}));
  EXPECT_FALSE(is_clear(flat_sweep, {Point(0, 1, 0), Point(0, 0, 0), Point(3, 3, 0)}));
}

TEST(Sweep, PlanesAloneCannotTell)
{
  // Negative controls. Without planar questions there is no right rule for planes in which both sides have
  // points: forbidding contact refuses the flat grid, allowing it accepts a fold.
  const std::array<Point, 3> legal{Point(0, 0, 0), Point(0, 1, 0), Point(-1, 0, 0)};
  EXPECT_TRUE(is_clear(flat_sweep, legal));
  EXPECT_FALSE(has_separating_plane(flat_sweep, legal, false));

  const std::array<Point, 3> fold{Point(0, 1, 0), Point(0, 0, 0), Point(3, 3, 0)};
  EXPECT_FALSE(is_clear(flat_sweep, fold));
  EXPECT_TRUE(has_separating_plane(flat_sweep, fold, true));
}

TEST(Sweep, ConvexSurfaceIsClear)
{
  // m is the tip of an octahedron and goes to the corner t; the face below shares t and a, or a and b.
  const std::array<Point, 4> sweep{Point(0, 0, 1), Point(1, 0, 0), Point(0, 1, 0), Point(-1, 0, 0)};
  EXPECT_TRUE(is_clear(sweep, {Point(0, 1, 0), Point(1, 0, 0), Point(0, 0, -1)}));
  EXPECT_TRUE(is_clear(sweep, {Point(-1, 0, 0), Point(0, 1, 0), Point(0, 0, -1)}));
}

TEST(Sweep, StraightBorderIsClear)
{
  // m and t on the line y = 0, a straight border: b is on it too, and the face behind b has its border edge
  // in line.
  const std::array<Point, 4> sweep{Point(1, 0, 0), Point(2, 0, 0), Point(0, 1, 0), Point(0, 0, 0)};
  EXPECT_TRUE(is_clear(sweep, {Point(0, 0, 0), Point(0, 1, 0), Point(-1, 0, 0)}));
  // Another sheet that only touches this border, at a point of it.
  EXPECT_FALSE(is_clear(sweep, {Point(1.5, 0, 0), Point(1, -1, 0), Point(2, -1, 0)}));
}

TEST(Sweep, TJunctionIsNotClear)
{
  // A vertex of the face lies inside the edge ab, which stands still.
  const std::array<Point, 4> sweep{Point(0, 1, 0), Point(0, 2, 0), Point(-1, 0, 0), Point(1, 0, 0)};
  EXPECT_FALSE(is_clear(sweep, {Point(0, 0, 0), Point(-1, -1, 0), Point(1, -1, 0)}));
  EXPECT_FALSE(is_clear(sweep, {Point(-1, 0, 0), Point(0, 0, 0), Point(0, -1, 0)}));
}

TEST(Sweep, ThinSheetInTheWayIsNotClear)
{
  // Before and after, the moving face is apart from the sheet z = 1, which it passes through on the way.
  const std::array<Point, 4> sweep{Point(0, 0, 2), Point(0.1, 0.1, -1), Point(4, 0, 3), Point(0, 4, 3)};
  EXPECT_FALSE(is_clear(sweep, {Point(-1, -1, 1), Point(3, -1, 1), Point(-1, 3, 1)}));
  EXPECT_TRUE(is_clear(sweep, {Point(-1, -1, -2), Point(3, -1, -2), Point(-1, 3, -2)}));
}

TEST(Sweep, FaceInsideTheSweepIsNotClear)
{
  // Wholly inside, so that no edge of the one meets a face of the other.
  const std::array<Point, 4> sweep{Point(0, 0, 0), Point(9, 0, 0), Point(0, 9, 0), Point(0, 0, 9)};
  EXPECT_FALSE(is_clear(sweep, {Point(1, 1, 1), Point(2, 1, 1), Point(1, 2, 1)}));
  EXPECT_FALSE(is_clear(sweep, {Point(1, 1, 1), Point(2, 1, 1), Point(3, 1, 1)}));
}

TEST(Sweep, FaceInsideAFacetOfTheSweepIsNotClear)
{
  // Facet k is opposite to corner k. No edge of the face leaves its plane, and no corner of the sweep is in
  // the face.
  const std::array<Point, 4> sweep{Point(0, 0, 0), Point(8, 0, 0), Point(0, 8, 0), Point(0, 0, 8)};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::array<Point, 3> corners{sweep[k ^ 1], sweep[k ^ 2], sweep[k ^ 3]};
    std::array<Point, 3> face;
    for (std::size_t i = 0; i < 3; ++i)
      face[i] = CGAL::barycenter(corners[i], 6, corners[(i + 1) % 3], 1, corners[(i + 2) % 3], 1);
    EXPECT_FALSE(is_clear(sweep, face)) << k;
    EXPECT_FALSE(
        selvedge::Sweep_test<Kernel>(sweep[0], sweep[1], sweep[2], sweep[3]).is_clear(face[0], face[1]))
        << k;
  }
}

TEST(Sweep, SmallestGapsAndContactsAreTold)
{
  // The sheet one step of a double below the lowest point of the sweep, and at it.
  const double below = std::nextafter(1.0, 0.0);
  const std::array<Point, 4> sweep{Point(0, 0, 2), Point(0, 0, 1), Point(1, 0, 2), Point(0, 1, 2)};
  EXPECT_TRUE(is_clear(sweep, {Point(-1, -1, below), Point(3, -1, below), Point(-1, 3, below)}));
  EXPECT_FALSE(is_clear(sweep, {Point(-1, -1, 1), Point(3, -1, 1), Point(-1, 3, 1)}));
}

TEST(Sweep, NegativeZeroIsZero)
{
  const std::array<Point, 4> sweep{Point(0, 0, 1), Point(1, 0, 0), Point(0, 1, 0), Point(-1, 0, 0)};
  EXPECT_TRUE(is_clear(sweep, {Point(-1, -0.0, -0.0), Point(-0.0, 1, -0.0), Point(-0.0, 0, -1)}));
}

TEST(Sweep, TheFaceOnWhichTheMovingOneEndsIsNotClear)
{
  EXPECT_FALSE(is_clear(flat_sweep, {flat_sweep[2], flat_sweep[1], flat_sweep[3]}));
}

TEST(Sweep, CollinearFaceIsASegment)
{
  // On the line of the edge ab: within it, beyond it, and as a chord of the sweep.
  const std::array<Point, 4> sweep{Point(0, 0, 1), Point(1, 0, 0), Point(0, 2, 0), Point(0, -2, 0)};
  EXPECT_TRUE(is_clear(sweep, {Point(0, 2, 0), Point(0, -2, 0), Point(0, 1, 0)}));
  EXPECT_TRUE(is_clear(sweep, {Point(0, 2, 0), Point(0, -2, 0), Point(0, 5, 0)}));
  EXPECT_FALSE(is_clear(sweep, {Point(0, 2, 0), Point(0, 1, 0), Point(0, 5, 0)}));
  EXPECT_TRUE(is_clear(sweep, {Point(0, 2, 0), Point(0, 3, 0), Point(0, 5, 0)}));
}

TEST(Sweep, SegmentsAreJudgedToo)
{
  const selvedge::Sweep_test<Kernel> sweep(Point(0, 0, 1), Point(1, 0, 0), Point(0, 2, 0), Point(0, -2, 0));
  EXPECT_TRUE(sweep.is_clear(Point(0, 2, 0), Point(0, -2, 0)));
  EXPECT_TRUE(sweep.is_clear(Point(0, 2, 0), Point(0, 3, 0)));
  EXPECT_FALSE(sweep.is_clear(Point(0, 2, 0), Point(0, 1, 0)));
  EXPECT_FALSE(sweep.is_clear(Point(0.1, 0, -1), Point(0.1, 0, 3)));
  EXPECT_TRUE(sweep.is_clear(Point(-0.1, 0, -1), Point(-0.1, 0, 3)));
}

} // namespace
