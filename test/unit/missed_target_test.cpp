// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Missed_target.h>

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

Simplify_options options_for_a_tenth()
{
  Simplify_options options;
  options.ratio = 0.1;
  options.max_error = 0.01;
  return options;
}

// Returns a result of 200 faces whose target was 100.
Simplified_soup result_above_its_target()
{
  Simplified_soup result;
  result.report.faces_target = 100;
  result.report.faces_output = 200;
  result.report.faces_to_go = 100;
  result.report.hindrances[Hindrance::seam] = 7;
  result.triangles = {3, 5};
  result.held_by = {Hindrance::seam, Hindrance::error};
  return result;
}

Distance at_most(double maximum)
{
  Distance distance;
  distance.maximum = maximum;
  return distance;
}

TEST(Missed_target, AsksForATenthMoreFacesOnce)
{
  Missed_target missed(options_for_a_tenth());
  EXPECT_FALSE(missed.options().faces);
  EXPECT_TRUE(missed.advance(result_above_its_target(), at_most(0.0025)));
  EXPECT_EQ(missed.options().faces, 220u);
  EXPECT_FALSE(missed.advance(result_above_its_target(), at_most(0.0025)));
  EXPECT_EQ(missed.options().faces, 220u);
}

TEST(Missed_target, AsksForNothingWhereTheSurfaceWasNotFlattenedForATarget)
{
  using Change = std::function<void(Simplify_options&, Simplified_soup&, Distance&)>;
  const std::vector<Change> changes{
      [](auto&, auto&, Distance& distance) { distance.maximum = 0.0024; },
      [](Simplify_options& options, auto&, auto&) { options.max_error.reset(); },
      [](Simplify_options& options, auto&, auto&) { options.max_error = 0; },
      [](auto&, Simplified_soup& result, auto&) { result.report.is_stopped = true; },
      [](auto&, Simplified_soup& result, auto&) { result.report.faces_to_go = 0; },
      [](auto&, Simplified_soup& result, auto&) { result.report.faces_target = 0; },
      [](auto&, Simplified_soup& result, auto&) { result.report.faces_output = 110; }};
  for (const Change& change : changes) {
    Simplify_options options = options_for_a_tenth();
    Simplified_soup result = result_above_its_target();
    Distance distance = at_most(0.0025);
    change(options, result, distance);
    EXPECT_FALSE(Missed_target(options).advance(result, distance));
  }
}

TEST(Missed_target, MakesTheSecondResultOneOfTheTargetAskedFor)
{
  Missed_target missed(options_for_a_tenth());
  Simplified_soup first = result_above_its_target();
  missed.complete(first);
  EXPECT_EQ(first.report.faces_within_reach, 0u);
  EXPECT_EQ(first.held_by, result_above_its_target().held_by);

  ASSERT_TRUE(missed.advance(first, at_most(0.01)));
  Simplified_soup second;
  second.report.faces_target = 220;
  second.report.faces_output = 219;
  second.triangles = {3, 4, 5};
  missed.complete(second);
  EXPECT_EQ(second.report.faces_within_reach, 200u);
  EXPECT_EQ(second.report.faces_target, 100u);
  EXPECT_EQ(second.report.faces_to_go, 119u);
  EXPECT_EQ(second.report.outcome(), "border");
  EXPECT_EQ(second.held_by, (std::vector<Hindrance>{Hindrance::seam, Hindrance::target, Hindrance::error}));
}

} // namespace
} // namespace selvedge::test
