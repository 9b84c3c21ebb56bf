// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/meshes.h"
#include "support/reduction.h"

#include <selvedge/Error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

void expect_same(const Simplified_soup& level, const Simplified_soup& alone)
{
  EXPECT_EQ(level.soup.points, alone.soup.points);
  EXPECT_EQ(level.soup.triangles, alone.soup.triangles);
  EXPECT_EQ(level.triangles, alone.triangles);
  EXPECT_EQ(level.corners, alone.corners);
  EXPECT_EQ(level.report.faces_input, alone.report.faces_input);
  EXPECT_EQ(level.report.faces_target, alone.report.faces_target);
  EXPECT_EQ(level.report.faces_output, alone.report.faces_output);
  EXPECT_EQ(level.report.faces_to_go, alone.report.faces_to_go);
  EXPECT_EQ(level.report.collapses, alone.report.collapses);
  EXPECT_EQ(level.report.passes, alone.report.passes);
  EXPECT_EQ(level.report.refused.intersection, alone.report.refused.intersection);
  EXPECT_EQ(level.report.outcome(), alone.report.outcome());
}

// A single run that knows its target may take the edges of several tiles in another order. Meshes of up to
// 5,000 faces have one tile.
//
// 0.02 is out of reach; 1 is there from the start; two are the same, and they come in no order.
const std::vector<double> ratios{0.25, 0.5, 0.02, 1, 0.5, 0.1};

TEST(Lods, EachLevelIsWhatARunToItAloneGives)
{
  for (const char* const name : {"jacket", "skirt"}) {
    SCOPED_TRACE(name);
    const Prepared_soup prepared = prepare(garment(name, 5000));
    const std::vector<Simplified_soup> levels = simplify_lods(prepared, {}, ratios);
    ASSERT_EQ(levels.size(), ratios.size());
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      SCOPED_TRACE(ratios[i]);
      expect_same(levels[i], simplify_soup(prepared, to_ratio(ratios[i])));
      EXPECT_TRUE(verify(levels[i], prepared).accepted());
    }
    EXPECT_FALSE(levels[2].report.is_reached());
    EXPECT_TRUE(levels[1].report.is_reached());
    EXPECT_EQ(levels[3].soup.triangles, prepared.soup.triangles);
  }
}

std::vector<Soup_collapse> collapses_to(const Prepared_soup& prepared, Simplify_options options,
                                        const Simplify_intent& intent)
{
  std::vector<Soup_collapse> result;
  options.on_collapse = [&](const Soup_collapse& collapse) { result.push_back(collapse); };
  simplify_soup(prepared, options, intent);
  return result;
}

TEST(Lods, EachHasTheCollapsesOfARunToItAlone)
{
  const Prepared_soup prepared = prepare(garment("jacket", 5000));
  Simplify_options in_cells;
  in_cells.faces_per_cell = 1000;
  Simplify_intent with_ratio;
  with_ratio.ratios = {{prepared.soup.groups.names.front(), 0.6}};
  const std::vector<std::pair<Simplify_options, Simplify_intent>> cases{
      {{}, {}}, {in_cells, {}}, {{}, with_ratio}};
  for (const auto& [options, intent] : cases) {
    const bool is_one = &options == &cases.front().first;
    std::vector<Soup_collapse> all;
    Simplify_options with_collapses = options;
    with_collapses.on_collapse = [&](const Soup_collapse& collapse) { all.push_back(collapse); };
    const std::vector<Simplified_soup> levels = simplify_lods(prepared, with_collapses, ratios, intent);
    std::vector<const Simplified_soup*> results;
    for (const Simplified_soup& level : levels)
      results.push_back(&level);
    const std::vector<Collapses_of_level> shares = collapses_of_levels(results, options, intent);
    ASSERT_EQ(shares.size(), levels.size());
    std::size_t last = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const auto& [reduction, first, count, of_reduction] = shares[i];
      last = std::max(last, first + count);
      EXPECT_EQ(reduction, is_one ? 0 : i);
      EXPECT_EQ(of_reduction, is_one ? all.size() : count);
      ASSERT_LE(first + count, all.size());
      Simplify_options to_level = options;
      to_level.ratio = ratios[i];
      EXPECT_EQ(std::vector<Soup_collapse>(all.begin() + std::ptrdiff_t(first),
                                           all.begin() + std::ptrdiff_t(first + count)),
                collapses_to(prepared, to_level, intent));
    }
    EXPECT_EQ(last, all.size());
  }
}

TEST(Lods, AfterOneThatWasStoppedHaveItsCollapses)
{
  const Prepared_soup prepared = prepare(garment("jacket", 5000));
  Simplify_options options;
  options.faces_per_cell = 1000;
  std::size_t collapses = 0;
  options.on_collapse = [&](const Soup_collapse&) { ++collapses; };
  options.should_stop = [&](const Simplify_progress&) { return collapses > 1500; };
  const std::vector<Simplified_soup> levels = simplify_lods(prepared, options, {0.8, 0.5, 0.2, 0.1});
  ASSERT_TRUE(levels.back().report.is_stopped);
  std::vector<const Simplified_soup*> results;
  for (const Simplified_soup& level : levels)
    results.push_back(&level);
  const std::vector<Collapses_of_level> shares = collapses_of_levels(results, options);
  EXPECT_EQ(shares[0].count, shares[1].first);
  EXPECT_EQ(shares[1].reduction, 1u);
  for (std::size_t i = 2; i < levels.size(); ++i) {
    EXPECT_EQ(shares[i].reduction, shares[1].reduction);
    EXPECT_EQ(shares[i].first, shares[1].first);
    EXPECT_EQ(shares[i].first + shares[i].count, collapses);
  }
}

TEST(Lods, RefuseWhatASingleRunRefuses)
{
  const Prepared_soup prepared = prepare(garment("skirt", 5000));
  Simplify_options unknown_pose, progression;
  unknown_pose.guarded_poses = {3};
  progression.is_progression_recorded = true;
  progression.placement = Placement::optimal;
  for (const Simplify_options& options : {unknown_pose, progression})
    EXPECT_THROW(simplify_lods(prepared, options, ratios), Argument_error);
}

TEST(Lods, ControlARunFromLevelToLevelIsNotTheSame)
{
  // Not a garment that is stuck before the second level: then both runs would end in the same place.
  const Prepared_soup prepared = prepare(nested_spheres(6000, 2, 1e-2));
  const Simplified_soup half = simplify_soup(prepared, to_ratio(0.5));
  const Simplified_soup chained = simplify_soup(prepare(half.soup), to_ratio(0.4));
  const Simplified_soup at_once = simplify_soup(prepared, to_ratio(0.2));
  ASSERT_TRUE(chained.report.is_reached() && at_once.report.is_reached());
  EXPECT_NE(chained.soup.points, at_once.soup.points);
}

TEST(Lods, SoTheyAreWherePartsHaveRatiosOfTheirOwn)
{
  Triangle_soup soup = garment("jacket", 4000);
  ASSERT_FALSE(soup.groups.empty());
  Simplify_intent intent;
  intent.ratios = {{soup.groups.names[soup.groups.of_triangle[0]], 0.7}};
  const Prepared_soup prepared = prepare(std::move(soup));
  const std::vector<Simplified_soup> levels = simplify_lods(prepared, {}, {0.5, 0.2}, intent);
  expect_same(levels[0], simplify_soup(prepared, to_ratio(0.5), intent));
  expect_same(levels[1], simplify_soup(prepared, to_ratio(0.2), intent));
}

TEST(Lods, AnInterruptedRunKeepsTheLevelsThatItHasPassed)
{
  const Prepared_soup prepared = prepare(garment("jacket", 5000));
  Simplify_options options;
  options.should_stop = [](const Simplify_progress& progress) {
    return 4 * progress.faces < 3 * progress.faces_input;
  };
  const std::vector<Simplified_soup> levels = simplify_lods(prepared, options, {0.9, 0.1});
  EXPECT_TRUE(levels[0].report.is_reached());
  EXPECT_FALSE(levels[0].report.is_stopped);
  EXPECT_FALSE(levels[1].report.is_reached());
  EXPECT_EQ(levels[1].report.outcome(), "stopped");
  expect_same(levels[0], simplify_soup(prepared, to_ratio(0.9)));
}

TEST(Lods, NoLevelIsAskedForAndNothingIsDone)
{
  EXPECT_TRUE(simplify_lods(prepare(flat_grid(200)), {}, {}).empty());
}

TEST(Lods, ARatioOutOfRangeAndANumberOfFacesAreRefused)
{
  const Prepared_soup prepared = prepare(flat_grid(200));
  EXPECT_THROW(simplify_lods(prepared, {}, {0.5, 1.5}), Argument_error);
  Simplify_options options;
  options.faces = 10;
  EXPECT_THROW(simplify_lods(prepared, options, {0.5}), Argument_error);
}

} // namespace
} // namespace selvedge::test
