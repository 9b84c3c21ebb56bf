// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What an obstacle shares with the mesh beside it: vertices, edges, and what is left of that after rounding.

#include "support/logged_reduction.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <vector>

namespace selvedge::test {
namespace {

Prepare_options rounding()
{
  Prepare_options options;
  options.round_to_float32 = true;
  return options;
}

// Every result of one prepared input: of the whole, of cells, and as levels of detail.
std::vector<Simplified_soup> all_ways(const Prepared_soup& prepared, const Simplify_options& options)
{
  Simplify_options in_cells = options;
  in_cells.faces_per_cell = 6;
  Simplify_options lods = options;
  lods.ratio.reset();
  std::vector<Simplified_soup> results = simplify_lods(prepared, lods, {1, 0});
  results.push_back(simplify_soup(prepared, options));
  results.push_back(simplify_soup(prepared, in_cells));
  return results;
}

// A tent of four faces over a leaf, so high up that floats are 2 apart there: rounded, the tent stays as it
// is and the leaf would go to another height. Three vertices of the file lie where the leaf's do.
Triangle_soup tent_with_marks()
{
  const double up = 16777216;
  return soup({{0, 0, up},
               {4, 0, up + 4},
               {0, 4, up + 4},
               {-4, 0, up + 2},
               {0, -4, up + 4},
               {1, -0.25, up + 3},
               {1, 0.25, up + 3},
               {1.5, 0, up + 3}},
              {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
}

Triangle_soup leaf_below_tent()
{
  const Triangle_soup tent = tent_with_marks();
  return soup({tent.points[5], tent.points[6], tent.points[7]}, {{0, 1, 2}});
}

TEST(Obstacle, StaysWhereItIsWhenVerticesAtItsOwnAreRounded)
{
  const Triangle_soup tent = tent_with_marks(), leaf = leaf_below_tent();
  Simplify_options options = to_ratio(0); // with the limits of borders
  options.max_normal_change = 180;
  options.min_aspect_ratio = 0;
  const Prepared_soup prepared = prepare(tent, rounding(), leaf);
  ASSERT_TRUE(prepared.offending_pairs.empty());
  ASSERT_EQ(prepared.rounding.vertices, 3u);
  for (const Simplified_soup& result : all_ways(prepared, options)) {
    EXPECT_EQ(result.soup.triangles.size(), 4u) << "the tent went through the leaf";
    EXPECT_TRUE(verify(result, prepared).accepted());
  }
  EXPECT_EQ(simplify_soup(prepare(tent, {}, leaf), options).soup.triangles.size(), 4u);

  // The control: without the leaf it comes down.
  EXPECT_EQ(simplify_soup(prepare(tent, rounding()), options).soup.triangles.size(), 2u);
}

TEST(Obstacle, SharesPositionsThatAreOneBeforeRoundingAndAfter)
{
  // By vertex of the sheet: one with the obstacle for good; parted from it by rounding; brought to it by
  // that.
  const double tenth = 0.1, rounded = float(tenth);
  const Triangle_soup own = soup({{1, 1, 1}, {tenth, 2, 1}, {tenth, 5, 1}}, {{0, 1, 2}});
  const Triangle_soup obstacle =
      soup({{1, 1, 1}, {tenth, 2, 1}, {rounded, 5, 1}, {tenth, 2, 1}, {3, 3, 9}}, {{0, 1, 4}, {2, 3, 4}});
  const Prepared_soup prepared = prepare(own, rounding(), obstacle);
  EXPECT_EQ(prepared.positions, (std::vector<Index>{0, 1, 2, 0, 4, 5, 4, 7}));
  EXPECT_TRUE(prepared.is_frozen[0]);
  EXPECT_EQ(prepared.frozen_faces, 1u);
  const Prepared_soup unrounded = prepare(own, {}, obstacle);
  EXPECT_EQ(unrounded.positions, (std::vector<Index>{0, 1, 2, 0, 1, 5, 1, 7}));
}

TEST(Obstacle, WhatRoundingBringsToItIsFrozenAndNothingElse)
{
  // A sheet at a height of 1, whose middle comes to a corner of the obstacle when it is rounded.
  Triangle_soup own = sheet(6, 6, 1);
  own.points[24] = Point_3(3, 3, 1 + 1e-12);
  const Triangle_soup obstacle = soup({{3, 3, 1}, {3, 3, 0}, {4, 3, 0}}, {{0, 1, 2}});
  const Prepared_soup prepared = prepare(own, rounding(), obstacle);
  EXPECT_TRUE(prepared.offending_pairs.empty());
  EXPECT_EQ(prepared.frozen_faces, 6u) << "those at the middle";
  EXPECT_NE(prepared.positions[24], prepared.positions[49]);
  for (const Simplified_soup& result : all_ways(prepared, without_limits(to_ratio(0)))) {
    EXPECT_TRUE(verify(result, prepared).accepted());
    EXPECT_EQ(std::count(result.soup.points.begin(), result.soup.points.end(), Point_3(3, 3, 1)), 1);
  }
}

TEST(Obstacle, KeepsItsFacesWhereVerticesAtItsCornersFallTogether)
{
  // Two corners of the obstacle are vertices of the file, too, and those become one when they are rounded.
  const double apart = 1e-12;
  Triangle_soup own = sheet(4, 4, 1);
  own.points.insert(own.points.end(), {{1, 1, 3}, {1, 1, 3 + apart}});
  const Triangle_soup obstacle = soup({{1, 1, 3}, {1, 1, 3 + apart}, {2, 1, 3}}, {{0, 1, 2}});
  const Prepared_soup prepared = prepare(own, rounding(), obstacle);
  EXPECT_EQ(prepared.obstacle.triangles.size(), 1u);
  for (const Simplified_soup& result : all_ways(prepared, to_ratio(0)))
    EXPECT_TRUE(verify(result, prepared).accepted());
}

// Flaps in a row, each hanging at an obstacle by its longest edge alone.
Triangle_soup flaps(std::size_t count)
{
  Triangle_soup own;
  for (std::size_t i = 0; i < count; ++i)
    own = joined(own, soup({{3.0 * i, 0, 0}, {3.0 * i + 1, 0, 0}, {3.0 * i + 0.5, 0.001, 0}}, {{0, 1, 2}}));
  return own;
}

Triangle_soup body_under(const Triangle_soup& flaps)
{
  Triangle_soup body;
  for (const auto& [a, b, c] : flaps.triangles) {
    const Point_3 &p = flaps.points[a], &q = flaps.points[b];
    body = joined(body, soup({q, p, Point_3(p.x() + 0.5, -1, 0)}, {{0, 1, 2}}));
  }
  return body;
}

TEST(Obstacle, NoPieceAlongItVanishes)
{
  const Triangle_soup own = flaps(20);
  const Prepared_soup prepared = prepare(own, {}, body_under(own));
  ASSERT_TRUE(prepared.offending_pairs.empty());
  for (const Simplify_options& options : {to_ratio(0), without_limits(to_ratio(0))})
    for (const Simplified_soup& result : all_ways(prepared, options)) {
      EXPECT_EQ(result.soup.triangles.size(), 20u);
      EXPECT_TRUE(verify(result, prepared).same_topology());
    }
}

// A strip along the x axis, its lower border an arc, its upper one straight.
Triangle_soup arched_strip(Index length)
{
  return mapped(sheet(length, 1), [&](const Point_3& p) {
    const double sag = p.x() * (length - p.x()) / length;
    return Point_3(p.x(), p.y() - (p.y() == 0 ? 0.1 * sag : 0), 0);
  });
}

TEST(Obstacle, BordersAlongItAreBorders)
{
  // Some border edges belong to a triangle of the obstacle, too, which is much larger than the strip. The
  // replay holds the strip to the limits of its borders, by its own size, with the obstacle and without.
  const Triangle_soup own = arched_strip(40);
  Triangle_soup obstacle;
  for (Index x = 0; x < 40; x += 4) {
    const Point_3 &p = own.points[x], &q = own.points[x + 1];
    obstacle = joined(obstacle, soup({q, p, Point_3(p.x() + 0.5, -100, 0)}, {{0, 1, 2}}));
  }
  Simplify_options options = without_limits(to_ratio(0));
  options.max_border_turn = 20;
  options.max_border_drift = 0.0001;
  const Prepared_soup prepared = prepare(own, {}, obstacle);
  ASSERT_TRUE(prepared.offending_pairs.empty());

  const Log_numbering numbering(own, false);
  Log_header header;
  header.vertices = numbering.size();
  header.triangles = own.triangles.size();
  std::ostringstream stream;
  Reduction_log log(stream, header, numbering, prepared, options);
  options.on_collapse = [&](const Soup_collapse& collapse) { log.add_collapse(collapse); };
  const Simplified_soup result = simplify_soup(prepared, options);
  log.finish(result);
  EXPECT_GT(result.report.collapses, 20u);
  EXPECT_TRUE(verify(result, prepared).accepted());
  Replay_options with_obstacle;
  with_obstacle.obstacle = obstacle;
  for (const Replay_options& terms : {Replay_options(), with_obstacle}) {
    const Replay_verdict verdict = replay_text(own, stream.str(), terms);
    EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
  }
}

TEST(Obstacle, FarAwayChangesNothing)
{
  // Limits are shares of the diagonal: of the mesh, not of what lies beside it. (On both sides, so that the
  // middle of both, where costs are most exact, is that of the mesh.)
  const Triangle_soup own = arched_strip(60);
  const double far = 1 << 20;
  const Triangle_soup corner = soup({{0, 0, far}, {far, 0, far}, {0, far, far}}, {{0, 1, 2}});
  const auto at_middle = [](const Triangle_soup& obstacle, double sign) {
    return mapped(obstacle, [&](const Point_3& p) {
      return Point_3(30 + sign * p.x(), -0.25 + sign * p.y(), sign * p.z());
    });
  };
  const Triangle_soup obstacle = joined(at_middle(corner, 1), at_middle(corner, -1));
  Simplify_options options = without_limits(to_ratio(0));
  options.max_border_drift = 0.001;
  options.max_error = 0.001;
  const Simplified_soup alone = simplify_soup(prepare(own), options);
  const Simplified_soup beside = simplify_soup(prepare(own, {}, obstacle), options);
  EXPECT_GT(alone.report.refused.border, 0u);
  EXPECT_EQ(beside.corners, alone.corners);
}

TEST(Obstacle, TakesNoPartInClosingSeams)
{
  // Two sheets with a gap between, and an obstacle as close to the border of one on its other side. The
  // corners of the obstacle are no partners, and no borders.
  const Triangle_soup right =
      mapped(sheet(3, 3), [](const Point_3& p) { return p + Kernel::Vector_3(3.01, 0, 0); });
  const Triangle_soup own = joined(sheet(3, 3), right);
  const Triangle_soup obstacle =
      mapped(sheet(3, 3), [](const Point_3& p) { return p - Kernel::Vector_3(3.01, 0, 0); });
  Prepare_options weld;
  weld.weld_distance = 0.02;
  const Snapping_notes alone = prepare(own, weld).snapping, beside = prepare(own, weld, obstacle).snapping;
  EXPECT_EQ(alone.snapped, 8u);
  EXPECT_EQ(beside.snapped, alone.snapped);
  EXPECT_EQ(beside.partnered, alone.partnered);
  EXPECT_EQ(beside.border_vertices, alone.border_vertices);
  EXPECT_EQ(beside.left_frozen, 0u);
}

} // namespace
} // namespace selvedge::test
