// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/geometry/star.h>

#include <support/Exact_oracle.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Motion = selvedge::Vertex_motion<Point>;
using selvedge::Star_verdict;

/// The collapse of `from` into `to`, one of the link vertices, which are given counter-clockwise.
Motion collapse(const Point& from, const Point& to, const std::vector<Point>& link, bool is_closed)
{
  Motion motion{from, to, {}, {}};
  for (std::size_t i = 0; i + (is_closed ? 0 : 1) < link.size(); ++i) {
    const Point &a = link[i], &b = link[(i + 1) % link.size()];
    (a == to || b == to ? motion.contracted : motion.moving).push_back({a, b});
  }
  return motion;
}

Star_verdict judge(const Motion& motion)
{
  return selvedge::judge_star_motion<Kernel>(motion);
}

/// Negative control: looks at the end only. For small integer coordinates.
bool is_clear_at_the_end(const Motion& motion)
{
  using Integer = std::int64_t;
  const auto to_integer = [](const Point& p) {
    return selvedge::oracle::Point<Integer>{Integer(p.x()), Integer(p.y()), Integer(p.z())};
  };
  std::vector<std::array<selvedge::oracle::Point<Integer>, 2>> link;
  for (const auto& edge : motion.moving)
    link.push_back({to_integer(edge[0]), to_integer(edge[1])});
  return selvedge::oracle::is_star_embedded(to_integer(motion.to), link);
}

/// Negative control: the pairs of faces, but not whether each face stays a triangle.
bool is_clear_without_degeneracy(const Motion& motion)
{
  for (const auto& edge : motion.moving) {
    const selvedge::Sweep_test<Kernel> sweep(motion.from, motion.to, edge[0], edge[1]);
    for (const auto* others : {&motion.moving, &motion.contracted}) {
      for (const auto& other : *others) {
        if (&other != &edge && !sweep.is_clear(other[0], other[1]))
          return false;
      }
    }
  }
  return true;
}

TEST(Star, FlatGridIsClear)
{
  const std::vector<Point> link{Point(2, 1, 0), Point(2, 2, 0), Point(1, 2, 0),
                                Point(0, 1, 0), Point(0, 0, 0), Point(1, 0, 0)};
  for (const Point& to : link)
    EXPECT_EQ(judge(collapse(Point(1, 1, 0), to, link, true)), Star_verdict::clear_by_view);
}

TEST(Star, ConvexSurfaceIsClear)
{
  const std::vector<Point> link{Point(1, 0, 0), Point(0, 1, 0), Point(-1, 0, 0), Point(0, -1, 0)};
  for (const Point& to : link)
    EXPECT_EQ(judge(collapse(Point(0, 0, 1), to, link, true)), Star_verdict::clear_by_view);
}

TEST(Star, StraightBorderIsClear)
{
  // The star is open, and the collapse goes along the border y = 0.
  const std::vector<Point> link{Point(2, 0, 0), Point(2, 1, 0), Point(1, 1, 0), Point(0, 0, 0)};
  EXPECT_EQ(judge(collapse(Point(1, 0, 0), Point(2, 0, 0), link, false)), Star_verdict::clear_by_pairs);
  EXPECT_EQ(judge(collapse(Point(1, 0, 0), Point(0, 0, 0), link, false)), Star_verdict::clear_by_pairs);
}

TEST(Star, ConcaveFlatStarIsJudgedInThePlane)
{
  // An L-shaped link. Its inner corner sees all of it, its far corners do not.
  const std::vector<Point> link{Point(0, 0, 0), Point(4, 0, 0), Point(4, 2, 0),
                                Point(2, 2, 0), Point(2, 4, 0), Point(0, 4, 0)};
  const Point from(1, 1, 0);
  EXPECT_EQ(judge(collapse(from, Point(2, 2, 0), link, true)), Star_verdict::clear_by_view);
  EXPECT_EQ(judge(collapse(from, Point(4, 2, 0), link, true)), Star_verdict::refused);
  EXPECT_EQ(judge(collapse(from, Point(2, 4, 0), link, true)), Star_verdict::refused);
}

TEST(Star, FaceThatEndsCollinearIsRefused)
{
  // t lies on the line of the link edge from (2 0) to (3 0), which moves.
  const std::vector<Point> link{Point(0, 0, 0), Point(2, 0, 0), Point(3, 0, 0), Point(3, 3, 0),
                                Point(0, 3, 0)};
  EXPECT_EQ(judge(collapse(Point(1, 1, 0), Point(0, 0, 0), link, true)), Star_verdict::refused);
  EXPECT_EQ(judge(collapse(Point(1, 1, 0), Point(0, 3, 0), link, true)), Star_verdict::clear_by_view);
}

TEST(Star, FaceThatTurnsOverInItsPlaneIsRefused)
{
  // The only moving face turns over while m crosses its link edge. No pair of faces shows that.
  const Motion motion =
      collapse(Point(0, 0, 0), Point(3, 2, 0), {Point(3, 2, 0), Point(1, 1, 0), Point(-1, 1, 0)}, false);
  EXPECT_EQ(judge(motion), Star_verdict::refused);
  EXPECT_TRUE(is_clear_without_degeneracy(motion));
  EXPECT_TRUE(is_clear_at_the_end(motion));
}

TEST(Star, PassingThroughItselfOnTheWayIsRefused)
{
  // At a quarter of the way the common edge of the two moving faces has let one of them turn flat onto the
  // other; before and after they are apart.
  const Motion open = collapse(Point(0, 0, 2), Point(0, 1, 2),
                               {Point(0, 1, 2), Point(1, 1, 3), Point(1, 0, 1), Point(3, 1, 2)}, false);
  EXPECT_EQ(judge(open), Star_verdict::refused);
  EXPECT_TRUE(is_clear_at_the_end(open));

  const Motion closed = collapse(Point(0, 0, 3), Point(1, 0, 1),
                                 {Point(1, 0, 1), Point(1, 1, 1), Point(1, 3, 0), Point(3, 1, 1)}, true);
  EXPECT_EQ(judge(closed), Star_verdict::refused);
  EXPECT_TRUE(is_clear_at_the_end(closed));
}

TEST(Star, AnotherPlacementIsJudgedToo)
{
  Motion motion{Point(1, 1, 1),
                Point(1.5, 1.25, 0.5),
                {{Point(0, 0, 0), Point(3, 0, 0)},
                 {Point(3, 0, 0), Point(3, 3, 0)},
                 {Point(3, 3, 0), Point(0, 3, 0)},
                 {Point(0, 3, 0), Point(0, 0, 0)}},
                {}};
  EXPECT_EQ(judge(motion), Star_verdict::clear_by_view);
  // Through the bottom of the tent: all four faces turn over one after the other, and never meet.
  motion.to = Point(1.5, 1.25, -1);
  EXPECT_TRUE(selvedge::is_star_motion_clear<Kernel>(motion));
  // Out of the tent's outline, at the height of its link.
  motion.to = Point(5, 1, 0);
  EXPECT_EQ(judge(motion), Star_verdict::refused);
}

TEST(Star, LinkThatWindsTwiceIsNotJudgedByView)
{
  // Two fans of three faces around the same line, one above the other, joined at twins of the link: seen from
  // above, all faces keep turning the same way, and yet one fan passes through the other.
  const Point twin(2, 0, 0);
  const std::vector<Point> link{twin, Point(-1, 2, 0), Point(-1, -2, 0),
                                twin, Point(-1, 2, 1), Point(-1, -2, 1)};
  const Motion motion = collapse(Point(0, 0, 5), Point(0, 2, 4), link, true);
  const Point above = *selvedge::internal::find_viewpoint(motion);
  for (const auto& edge : motion.moving) {
    EXPECT_EQ(CGAL::orientation(above, motion.from, edge[0], edge[1]), CGAL::NEGATIVE);
    EXPECT_EQ(CGAL::orientation(above, motion.to, edge[0], edge[1]), CGAL::NEGATIVE);
  }
  EXPECT_EQ(judge(motion), Star_verdict::refused);
}

} // namespace
