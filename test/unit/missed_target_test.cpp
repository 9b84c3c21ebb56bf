// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Missed_target.h>
#include <selvedge/generate.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

const Prepared_soup s_nothing; // from which nothing is far

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
  result.report.shares = {{1000, 0, 100, 200, 0}};
  result.report.faces_target = 100;
  result.report.faces_output = 200;
  result.report.faces_to_go = 100;
  result.report.hindrances[Hindrance::seam] = 7;
  result.triangles = {3, 5};
  result.held_by = {Hindrance::seam, Hindrance::error};
  return result;
}

// Returns a result with shares of such targets and faces.
Simplified_soup result_of(const std::vector<std::pair<std::size_t, std::size_t>>& shares)
{
  Simplified_soup result;
  for (const auto& [target, output] : shares) {
    result.report.shares.push_back({1000, 0, target, output, 0});
    result.report.faces_target += target;
    result.report.faces_output += output;
    result.report.faces_to_go += result.report.shares.back().excess();
  }
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
  EXPECT_TRUE(missed.options().least_faces.empty());
  EXPECT_TRUE(missed.advance({{result_above_its_target(), at_most(0.0025), s_nothing}}));
  EXPECT_EQ(missed.options().least_faces, (std::vector<std::size_t>{220}));
  EXPECT_EQ(missed.options().ratio, 0.1);
  EXPECT_FALSE(missed.advance({{result_above_its_target(), at_most(0.0025), s_nothing}}));
  EXPECT_EQ(missed.options().least_faces, (std::vector<std::size_t>{220}));
}

TEST(Missed_target, RepeatsTheCollapsesOfTheFirstReduction)
{
  Missed_target missed(options_for_a_tenth());
  const std::shared_ptr<const internal::Collapse_record> record = missed.options().record;
  EXPECT_TRUE(record);
  EXPECT_FALSE(missed.options().repeated);
  EXPECT_TRUE(missed.advance({{result_above_its_target(), at_most(0.0025), s_nothing}}));
  EXPECT_FALSE(missed.options().record) << "it would record what it repeats";
  EXPECT_EQ(missed.options().repeated, record);
  EXPECT_FALSE(missed.advance({{result_above_its_target(), at_most(0.0025), s_nothing}}));
  EXPECT_FALSE(missed.options().repeated);
  EXPECT_FALSE(Missed_target(Simplify_options()).options().record);
}

TEST(Missed_target, ReportsWhatTheReductionAskedThatIsRepeated)
{
  Simplified_soup first = result_above_its_target();
  first.report.refused.uv = 5;
  first.report.passes = 2;
  first.report.intersections.motions_judged = 50;
  first.refused_by_part = {{first.report.refused}};
  for (std::size_t i = 0; i < 9; ++i)
    first.history.add(double(i), {});
  std::vector<Simplified_soup> second{result_above_its_target()};
  second[0].report.collapses = 8;
  for (const bool is_repeated : {true, false}) {
    Simplify_options options = options_for_a_tenth();
    options.faces_per_cell = is_repeated ? 0 : 100;
    Missed_target missed(options);
    ASSERT_TRUE(missed.advance({{first, at_most(0.0025), s_nothing}}));
    std::vector<Simplified_soup> completed = second;
    missed.complete(completed);
    EXPECT_EQ(completed[0].report.refused.uv, is_repeated ? 5u : 0u);
    EXPECT_EQ(completed[0].report.passes, is_repeated ? 2u : 0u);
    EXPECT_EQ(completed[0].report.intersections.motions_judged, is_repeated ? 50u : 0u);
    EXPECT_EQ(completed[0].refused_by_part.size(), is_repeated ? 1u : 0u);
    EXPECT_EQ(completed[0].history.samples().size(), is_repeated ? 8u : 0u);
  }
}

TEST(Missed_target, RepeatsNothingWhereTheSecondReductionTakesAnotherCourse)
{
  const auto is_repeated = [](const Simplify_options& options, const Simplified_soup& result,
                              const Prepared_soup& original) {
    Missed_target missed(options);
    EXPECT_TRUE(missed.advance({{result, at_most(0.0025), original}}));
    EXPECT_FALSE(missed.options().record);
    return bool(missed.options().repeated);
  };
  const Simplified_soup result = result_above_its_target();
  EXPECT_TRUE(is_repeated(options_for_a_tenth(), result, s_nothing));

  Simplify_options in_cells = options_for_a_tenth();
  in_cells.faces_per_cell = 100;
  EXPECT_FALSE(is_repeated(in_cells, result, s_nothing)) << "cells do not end together";

  Simplified_soup of_two_parts = result;
  of_two_parts.report.shares.push_back(result.report.shares[0]);
  EXPECT_FALSE(is_repeated(options_for_a_tenth(), of_two_parts, s_nothing))
      << "one may go on without the other";

  Prepared_soup posed = s_nothing;
  posed.soup.poses.emplace_back();
  EXPECT_FALSE(is_repeated(options_for_a_tenth(), result, posed))
      << "the judge may find a pose to be guarded";

  Simplified_soup held_by_borders = result;
  held_by_borders.report.hindrances[Hindrance::border_turn] = 10;
  EXPECT_FALSE(is_repeated(options_for_a_tenth(), held_by_borders, s_nothing)) << "borders may turn";
}

// Faces that cannot change keep no shape.
TEST(Missed_target, AsksForATenthMoreOfTheFacesThatCanChange)
{
  Simplified_soup result = result_above_its_target();
  Simplify_report::Share& share = result.report.shares[0];
  share = {2000, 1000, 1100, 1200, 0};
  for (const std::size_t target : {1100, 50}) { // one is below what cannot change
    share.target = target;
    Missed_target missed(options_for_a_tenth());
    EXPECT_TRUE(missed.advance({{result, at_most(0.0025), s_nothing}}));
    EXPECT_EQ(missed.options().least_faces, (std::vector<std::size_t>{1220}));
  }
  share = {2000, 1000, 1100, 1101, 0}; // hardly missed: what nothing holds is flattened all the same
  Missed_target hardly(options_for_a_tenth());
  EXPECT_TRUE(hardly.advance({{result, at_most(0.0025), s_nothing}}));
  EXPECT_EQ(hardly.options().least_faces, (std::vector<std::size_t>{1112}));
  share = {2000, 1000, 1100, 1100, 0};
  EXPECT_FALSE(Missed_target(options_for_a_tenth()).advance({{result, at_most(0.0025), s_nothing}}));
}

TEST(Missed_target, AsksForNothingWhereTheSurfaceWasNotFlattenedForATarget)
{
  using Change = std::function<void(Simplify_options&, Simplified_soup&, Distance&)>;
  const std::vector<Change> changes{
      [](auto&, auto&, Distance& distance) { distance.maximum = 0.0024; },
      [](Simplify_options& options, auto&, auto&) { options.max_error.reset(); },
      [](Simplify_options& options, auto&, auto&) { options.max_error = 0; },
      [](auto&, Simplified_soup& result, auto&) { result.report.is_stopped = true; },
      [](auto&, Simplified_soup& result, auto&) { result.report.shares[0].target = 200; },
      [](auto&, Simplified_soup& result, auto&) { result.report.shares[0].target = 0; },
      [](auto&, Simplified_soup& result, auto&) { result.report.shares[0].input = 239; },
      [](auto&, Simplified_soup& result, auto&) { // a ratio of 0
        result.report.shares[0].fixed = result.report.shares[0].target;
      },
      [](auto&, Simplified_soup& result, auto&) { result.report.shares[0].output = 100; }};
  for (const Change& change : changes) {
    Simplify_options options = options_for_a_tenth();
    Simplified_soup result = result_above_its_target();
    Distance distance = at_most(0.0025);
    change(options, result, distance);
    EXPECT_FALSE(Missed_target(options).advance({{result, distance, s_nothing}}));
  }
}

// Between the ends of the legs of a frame of thin strips, at which the vertices of the result all are.
TEST(Missed_target, AsksForMoreFacesWhereSomethingOpenIsSpanned)
{
  Prepared_soup prepared;
  Triangle_soup& frame = prepared.soup;
  frame.points = {Point_3(0, 0, 0),     Point_3(0.01, 0, 0), Point_3(0, 1, 0),   Point_3(10, 1, 0),
                  Point_3(10, 0.99, 0), Point_3(10, 0, 0),   Point_3(9.99, 0, 0)};
  frame.triangles = {{0, 1, 2}, {2, 4, 3}, {3, 6, 5}};
  Simplified_soup result = result_above_its_target();
  result.soup.points = frame.points;
  for (const auto& [foot, is_due] : {std::pair(5, true), std::pair(1, false)}) {
    result.soup.triangles = {{0, Index(foot), 2}};
    EXPECT_EQ(Missed_target(options_for_a_tenth()).advance({{result, at_most(0), prepared}}), is_due) << foot;
  }
  result.soup.triangles = {{0, 5, 2}};
  result.report.shares[0].output = 100; // its target
  EXPECT_FALSE(Missed_target(options_for_a_tenth()).advance({{result, at_most(0), prepared}}));
}

// What an interrupted reduction has reached is not given up for another one, which would end at once.
TEST(Missed_target, AsksForNothingWhereALaterLevelWasStopped)
{
  const Simplified_soup first = result_above_its_target();
  Simplified_soup second = first;
  EXPECT_TRUE(Missed_target(options_for_a_tenth())
                  .advance({{first, at_most(0.0025), s_nothing}, {second, at_most(0.0025), s_nothing}}));
  second.report.is_stopped = true;
  EXPECT_FALSE(Missed_target(options_for_a_tenth())
                   .advance({{first, at_most(0.0025), s_nothing}, {second, at_most(0.0025), s_nothing}}));
}

TEST(Missed_target, AsksForMoreFacesOfThePartsThatMissedTheirTargets)
{
  Missed_target missed(options_for_a_tenth());
  EXPECT_TRUE(missed.advance({{result_of({{100, 99}, {50, 80}, {50, 50}}), at_most(0.01), s_nothing}}));
  EXPECT_EQ(missed.options().least_faces, (std::vector<std::size_t>{0, 88, 0}));

  std::vector<Simplified_soup> second{result_of({{100, 100}, {88, 87}, {50, 50}})};
  missed.complete(second);
  const Simplify_report& report = second.front().report;
  EXPECT_EQ(report.shares[0].within_reach, 0u);
  EXPECT_EQ(report.shares[1].within_reach, 80u);
  EXPECT_EQ(report.shares[2].within_reach, 0u);
  EXPECT_EQ(report.shares[1].target, 50u);
  EXPECT_EQ(report.faces_within_reach, 229u);
  EXPECT_EQ(report.faces_target, 200u);
  EXPECT_EQ(report.faces_to_go, 37u);
}

// Levels that are within reach stay as they are, and none has fewer faces than a finer one.
TEST(Missed_target, AsksForNoMoreFacesThanTheLevelsThatReachedTheirTargets)
{
  for (const auto& [finer, least] : {std::pair<std::size_t, std::size_t>{500, 220}, {210, 210}}) {
    Missed_target missed(options_for_a_tenth());
    const Simplified_soup reached = result_of({{finer, finer}}), near = result_of({{190, 200}}),
                          missing = result_of({{100, 200}});
    EXPECT_TRUE(missed.advance({{reached, at_most(0.001), s_nothing},
                                {near, at_most(0.01), s_nothing},
                                {missing, at_most(0.01), s_nothing}}));
    EXPECT_EQ(missed.options().least_faces, std::vector<std::size_t>{least});

    std::vector<Simplified_soup> second{result_of({{finer, finer}}), result_of({{least, least}}),
                                        result_of({{least, least}})};
    missed.complete(second);
    EXPECT_TRUE(second[0].report.is_reached());
    EXPECT_EQ(second[0].report.faces_within_reach, 0u);
    EXPECT_EQ(second[1].report.faces_target, 190u);
    for (const std::size_t i : {1, 2}) {
      EXPECT_FALSE(second[i].report.is_reached());
      EXPECT_EQ(second[i].report.faces_within_reach, 200u);
    }
  }
}

TEST(Missed_target, MakesTheSecondResultOneOfTheTargetAskedFor)
{
  Missed_target missed(options_for_a_tenth());
  std::vector<Simplified_soup> first{result_above_its_target()};
  missed.complete(first);
  EXPECT_EQ(first[0].report.faces_within_reach, 0u);
  EXPECT_EQ(first[0].held_by, result_above_its_target().held_by);

  ASSERT_TRUE(missed.advance({{first[0], at_most(0.01), s_nothing}}));
  std::vector<Simplified_soup> second{result_of({{220, 219}})};
  second[0].triangles = {3, 4, 5};
  missed.complete(second);
  EXPECT_EQ(second[0].report.faces_within_reach, 200u);
  EXPECT_EQ(second[0].report.faces_target, 100u);
  EXPECT_EQ(second[0].report.faces_to_go, 119u);
  EXPECT_EQ(second[0].report.outcome(), "border");
  EXPECT_EQ(second[0].held_by,
            (std::vector<Hindrance>{Hindrance::seam, Hindrance::target, Hindrance::error}));
}

// Returns a result above its target of which limits of lines hold one edge of so many.
Simplified_soup result_held_by_lines(std::size_t edges)
{
  Simplified_soup result = result_above_its_target();
  result.report.hindrances = {};
  result.report.hindrances[Hindrance::drift] = 1;
  result.report.hindrances[Hindrance::seam] = edges - 1;
  result.report.hindrances[Hindrance::target] = 1000; // of parts that are not above theirs
  return result;
}

// Lines that keep their course keep faces that the surface needs more.
TEST(Missed_target, LetsBordersTurnWhereTheyHoldEdges)
{
  for (const Hindrance reason : {Hindrance::border_turn, Hindrance::drift}) {
    Simplified_soup first = result_held_by_lines(50);
    std::swap(first.report.hindrances[reason], first.report.hindrances[Hindrance::drift]);
    Missed_target missed(options_for_a_tenth());
    const Simplify_options before = missed.options();
    ASSERT_TRUE(missed.advance({{first, at_most(0.0025), s_nothing}}));
    EXPECT_EQ(missed.options().max_border_turn, 180);
    EXPECT_EQ(missed.options().max_seam_turn, before.max_seam_turn);
    EXPECT_EQ(missed.options().max_border_drift, before.max_border_drift);
    EXPECT_EQ(missed.options().max_normal_change, before.max_normal_change);
    EXPECT_FALSE(first.report.eased_border_turn);

    std::vector<Simplified_soup> second{result_of({{220, 219}})};
    missed.complete(second);
    EXPECT_EQ(second[0].report.eased_border_turn, 180);
  }
}

TEST(Missed_target, KeepsBordersThatHoldHardlyAnEdge)
{
  const Simplified_soup first = result_held_by_lines(51);
  Missed_target missed(options_for_a_tenth());
  ASSERT_TRUE(missed.advance({{first, at_most(0.0025), s_nothing}}));
  EXPECT_EQ(missed.options().max_border_turn, Simplify_options().max_border_turn);
  std::vector<Simplified_soup> second{result_of({{220, 219}})};
  missed.complete(second);
  EXPECT_FALSE(second[0].report.eased_border_turn);
}

TEST(Missed_target, KeepsToATurnOfBordersThatSomebodyHasSet)
{
  const Simplified_soup first = result_held_by_lines(1);
  const auto turn_after = [&](double asked, bool is_set) {
    Simplify_options options = options_for_a_tenth();
    options.max_border_turn = asked;
    Missed_target missed(options, is_set);
    EXPECT_TRUE(missed.advance({{first, at_most(0.0025), s_nothing}}));
    std::vector<Simplified_soup> second{result_of({{220, 219}})};
    missed.complete(second);
    EXPECT_EQ(second[0].report.eased_border_turn.has_value(), missed.options().max_border_turn != asked);
    return missed.options().max_border_turn;
  };
  const double by_default = Simplify_options().max_border_turn;
  EXPECT_EQ(turn_after(by_default, false), 180);
  EXPECT_EQ(turn_after(by_default, true), by_default);
  EXPECT_EQ(turn_after(8, false), 8);
}

// What has reached its target stays what it would be without the others, and what is not to have more faces
// would be reduced further: a part of which hardly a face went, one without a target, a level that has kept
// its shape.
TEST(Missed_target, KeepsBordersWhereALevelOrPartIsNotToHaveMoreFaces)
{
  const Simplified_soup missing = result_held_by_lines(1);
  const auto is_eased = [&](const std::vector<Missed_target::Judged>& levels) {
    Missed_target missed(options_for_a_tenth());
    EXPECT_TRUE(missed.advance(levels));
    return missed.options().max_border_turn == 180;
  };
  EXPECT_TRUE(is_eased({{missing, at_most(0.01), s_nothing}, {missing, at_most(0.01), s_nothing}}));
  const Simplified_soup reached = result_of({{500, 500}});
  EXPECT_FALSE(is_eased({{reached, at_most(0.001), s_nothing}, {missing, at_most(0.01), s_nothing}}));
  Simplified_soup parts = missing;
  parts.report.shares.push_back({1000, 0, 300, 300, 0});
  EXPECT_FALSE(is_eased({{parts, at_most(0.01), s_nothing}}));
  for (const Simplify_report::Share& share :
       {Simplify_report::Share{1000, 0, 100, 900, 0}, Simplify_report::Share{1000, 0, 0, 200, 0}}) {
    parts.report.shares.back() = share;
    EXPECT_FALSE(is_eased({{parts, at_most(0.01), s_nothing}})) << share.target;
  }
  EXPECT_FALSE(is_eased({{missing, at_most(0.001), s_nothing}, {missing, at_most(0.01), s_nothing}}));
  parts.report.shares.back() = {300, 300, 300, 300, 0}; // cannot change
  EXPECT_TRUE(is_eased({{parts, at_most(0.01), s_nothing}}));
}

// A border that turns more may leave the one across a gap.
TEST(Missed_target, KeepsBordersWhereGapsAreHeld)
{
  const Simplified_soup missing = result_held_by_lines(1);
  Prepared_soup tied, facing;
  tied.tied.emplace_back(0, 1);
  facing.facing.push_back(0);
  for (const Prepared_soup* const original : {&tied, &facing}) {
    Missed_target missed(options_for_a_tenth());
    EXPECT_TRUE(missed.advance({{missing, at_most(0.01), *original}}));
    EXPECT_EQ(missed.options().max_border_turn, Simplify_options().max_border_turn);
  }
}

// The fewest faces bound the targets of ratios, of levels and of numbers of faces, and cells do their part.
TEST(Missed_target, ReducesToTheFewestFacesThatAreAllowed)
{
  Generate_options nested;
  nested.faces = 4000;
  const Prepared_soup prepared = prepare(generate("nested", nested));
  Simplify_options options;
  options.least_faces = {prepared.soup.triangles.size() / 2};
  const auto expect_half = [&](const Simplified_soup& result) {
    EXPECT_TRUE(result.report.is_reached());
    EXPECT_EQ(result.report.faces_target, options.least_faces[0]);
    EXPECT_NEAR(double(result.soup.triangles.size()), double(options.least_faces[0]), 2);
  };
  const std::vector<Simplified_soup> levels = simplify_lods(prepared, options, {0.1, 0.75, 0.2});
  expect_half(levels[0]);
  EXPECT_NEAR(double(levels[1].soup.triangles.size()), 1.5 * double(options.least_faces[0]), 2);
  expect_half(levels[2]);
  options.ratio = 0.1;
  expect_half(simplify_soup(prepared, options));
  options.ratio.reset();
  options.faces = 10;
  expect_half(simplify_soup(prepared, options));
  options.faces_per_cell = 1000;
  const Simplified_soup in_cells = simplify_soup(prepared, options);
  expect_half(in_cells);
  EXPECT_GT(in_cells.report.collapses_in_cells, 0u);
}

} // namespace
} // namespace selvedge::test
