// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Two parts that may intersect do; every other pair of parts is kept apart as always.

#include "support/filter_verdict.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

constexpr Index s_skin = 0, s_cloth = 1, s_belt = 2;

/// Wavy sheets close above each other, skin, cloth and belt; where `is_crossed`, the belt intersects both.
Triangle_soup layered(std::size_t faces, bool is_crossed = false)
{
  const Triangle_soup sheet = sheets(faces / 3, 1, 1e-3);
  Triangle_soup plain;
  plain.points = sheet.points;
  plain.triangles = sheet.triangles;
  Triangle_soup result = joined(joined(plain, moved(plain, 0, 0, 2e-4)),
                                is_crossed ? moved(plain, 0.013, 0.007, 0.0025) : moved(plain, 0, 0, 4e-4));
  result.objects.names = {"bare skin", "cloth", "belt"};
  for (Index part : {s_skin, s_cloth, s_belt})
    result.objects.of_triangle.insert(result.objects.of_triangle.end(), plain.triangles.size(), part);
  return result;
}

Prepare_options with_permission(std::vector<std::pair<std::string, std::string>> parts = {{"skin", "cloth"}})
{
  Prepare_options options;
  options.may_intersect = std::move(parts);
  return options;
}

/// How many pairs of the result lie between two parts, as the judge sees them who knows of no permission.
std::size_t pairs_between(const Triangle_soup& soup, Index first, Index second)
{
  const std::vector<Offending_pair> pairs = offending_pairs(soup);
  return std::size_t(std::count_if(pairs.begin(), pairs.end(), [&](const Offending_pair& pair) {
    const Index a = soup.objects.of_triangle[pair.first], b = soup.objects.of_triangle[pair.second];
    return std::minmax(a, b) == std::minmax(first, second);
  }));
}

std::string without_line(std::string log, const std::string& start)
{
  const std::size_t first = log.find("\n" + start);
  return log.erase(first, log.find('\n', first + 1) - first);
}

TEST(May_intersect, TheTwoPartsAloneDo)
{
  const std::vector<Simplify_options> all = every_means(without_limits(to_ratio(0.1)));
  for (const bool is_crossed : {false, true}) {
    const Triangle_soup soup = layered(2400, is_crossed);
    const std::size_t skin_before = pairs_between(soup, s_skin, s_belt),
                      cloth_before = pairs_between(soup, s_cloth, s_belt);
    EXPECT_EQ(cloth_before > 0, is_crossed);
    for (const Simplify_options& options : all) {
      SCOPED_TRACE(&options - all.data());
      const Reduction guarded = reduce(soup, options);
      EXPECT_EQ(pairs_between(guarded.simplified.soup, s_skin, s_cloth), 0u) << "the control";
      EXPECT_TRUE(guarded.verification.permitted.empty());

      const Prepared_soup prepared = prepare(soup, with_permission());
      const Logged_reduction free = reduce_and_log(soup, options, with_permission());
      const Triangle_soup& result = free.simplified.soup;
      const std::size_t permitted = pairs_between(result, s_skin, s_cloth);
      EXPECT_GT(permitted, 0u);
      EXPECT_LE(pairs_between(result, s_skin, s_belt), skin_before);
      EXPECT_LE(pairs_between(result, s_cloth, s_belt), cloth_before);
      const Verification verification = verify(free.simplified, prepared);
      EXPECT_TRUE(verification.accepted());
      ASSERT_EQ(verification.permitted.size(), 1u);
      EXPECT_EQ(verification.permitted[0].pairs, permitted);
      const Replay_verdict verdict = replay_text(soup, free.log);
      EXPECT_TRUE(verdict.is_accepted())
          << verdict.violations.front().step << ": " << verdict.violations.front().message;

      // The controls of the judges: nobody who does not know of the permission accepts.
      Prepared_soup unknowing = prepared;
      unknowing.may_intersect.clear();
      EXPECT_EQ(verify(free.simplified, unknowing).new_pairs.size(), permitted);
      EXPECT_FALSE(replay_text(soup, without_line(free.log, "may_intersect")).is_accepted());
    }
  }
  const Triangle_soup soup = layered(2400);
  EXPECT_GT(pairs_between(reduce(soup, without_check(all[0])).simplified.soup, s_cloth, s_belt), 0u)
      << "the control: nothing else keeps the others apart";
}

TEST(May_intersect, PairsOfTheInputAreNeitherRefusedNorFrozen)
{
  const Triangle_soup soup = layered(1200, true);
  Prepare_options options = with_permission({{"belt", "cloth"}, {"skin", "belt"}});
  for (const Defects defects : {Defects::descend, Defects::freeze, Defects::refuse}) {
    options.defects = defects;
    const Prepared_soup prepared = prepare(soup, options);
    EXPECT_EQ(prepared.permitted_pairs,
              (std::vector{pairs_between(soup, s_cloth, s_belt), pairs_between(soup, s_skin, s_belt)}));
    EXPECT_TRUE(prepared.offending_pairs.empty());
    EXPECT_EQ(prepared.frozen_faces, 0u);
  }
  options.may_intersect.clear();
  EXPECT_THROW(prepare(soup, options), Input_error);
}

TEST(May_intersect, NoPartIntersectsItself)
{
  Triangle_soup soup = layered(300, true);
  soup.objects.of_triangle.assign(soup.triangles.size(), s_skin);
  EXPECT_THROW(prepare(soup, with_permission({{"bare", "skin"}})), Argument_error);
  Verify_options options;
  options.may_intersect = {{"bare", "skin"}, {"skin", "skin"}};
  EXPECT_FALSE(verify(soup, options).pairs.empty());
  EXPECT_TRUE(are_between({1, 0}, {0, 1}, 1, 0));
  EXPECT_FALSE(are_between({1, 1}, {1, 1}, 1, 0)) << "by which layers may change places as well";
}

TEST(May_intersect, IsNotForPartsThatAreJoined)
{
  Triangle_soup soup = sheet(6, 1);
  soup.groups.names = {"left", "middle", "right"};
  for (Index t = 0; t < soup.triangles.size(); ++t)
    soup.groups.of_triangle.push_back(t / 4);
  EXPECT_NO_THROW(prepare(soup, with_permission({{"left", "right"}})));
  for (const char* const other : {"middle", "left", "nowhere"})
    EXPECT_THROW(prepare(soup, with_permission({{"left", other}})), Argument_error) << other;
  const std::string head = "selvedge-log 1\ninput 14 12 -\nmay_intersect left ", tail = "\nresult 0 12 -\n";
  EXPECT_TRUE(replay_text(soup, head + "right" + tail).is_accepted());
  for (const char* const other : {"middle", "left", "nowhere", "%6", "%zz", "a\x01", "right right", ""})
    EXPECT_THROW(replay_text(soup, head + other + tail), Input_error) << other;

  Simplify_options in_cells = to_ratio(0.5);
  in_cells.faces_per_cell = 100;
  EXPECT_THROW(simplify_soup(prepare(soup, with_permission({{"left", "right"}})), in_cells), Argument_error);

  // A snap may join what was apart.
  Triangle_soup gaping = joined(sheet(3, 3), moved(sheet(3, 3), 3.01, 0, 0));
  gaping.groups.names = {"left", "right"};
  gaping.groups.of_triangle.assign(18, 0);
  gaping.groups.of_triangle.resize(36, 1);
  Prepare_options options = with_permission({{"left", "right"}});
  EXPECT_NO_THROW(prepare(gaping, options));
  options.weld_distance = 0.1;
  EXPECT_THROW(prepare(gaping, options), Argument_error);
}

using Strip_faces = std::vector<Filtered_mesh::Face_index>;
using Strip_parts = std::vector<std::pair<Strip_faces, Strip_faces>>;

/// What the filter says of the collapse of vertex 1 onto 2 in a strip of three squares, which begins a soup.
bool is_strip_collapse_accepted(const Triangle_soup& soup, const Strip_parts& parts)
{
  return is_collapse_accepted(
      soup, 1, 2, [&](const Intersection_filter<Filtered_mesh>& filter) { filter.let_intersect(parts); });
}

const Strip_faces s_first{Filtered_mesh::Face_index(0), Filtered_mesh::Face_index(1)},
    s_middle{Filtered_mesh::Face_index(2), Filtered_mesh::Face_index(3)},
    s_last{Filtered_mesh::Face_index(4), Filtered_mesh::Face_index(5)},
    s_both{Filtered_mesh::Face_index(0), Filtered_mesh::Face_index(1), Filtered_mesh::Face_index(2),
           Filtered_mesh::Face_index(3)},
    s_other{Filtered_mesh::Face_index(6)};

TEST(May_intersect, FilterNeverJoinsTheTwoParts)
{
  const Triangle_soup strip = sheet(3, 1);
  EXPECT_TRUE(is_strip_collapse_accepted(strip, {}));
  EXPECT_TRUE(is_strip_collapse_accepted(strip, {{s_first, {}}}));
  EXPECT_FALSE(is_strip_collapse_accepted(strip, {{s_first, s_last}}));
  EXPECT_FALSE(is_strip_collapse_accepted(strip, {{s_last, s_first}}));
  EXPECT_THROW(is_strip_collapse_accepted(strip, {{s_first, s_middle}}), Argument_error);
  EXPECT_THROW(is_strip_collapse_accepted(strip, {{s_first, s_first}}), Argument_error);
  EXPECT_THROW(is_strip_collapse_accepted(strip, Strip_parts(33)), Argument_error);
}

// Strip_faces of the first and of the middle square move.
TEST(May_intersect, FilterAsksEveryFaceOfAStarForItself)
{
  const Triangle_soup needle_in_first =
      joined(sheet(3, 1), soup({{0.5, 0.2, -1}, {0.6, 0.2, -1}, {0.55, 0.2, 1}}, {{0, 1, 2}}));
  EXPECT_FALSE(is_strip_collapse_accepted(needle_in_first, {}));
  EXPECT_TRUE(is_strip_collapse_accepted(needle_in_first, {{s_first, s_other}}));
  EXPECT_TRUE(is_strip_collapse_accepted(needle_in_first, {{s_last, {}}, {s_other, s_first}}));
  EXPECT_FALSE(is_strip_collapse_accepted(needle_in_first, {{s_middle, s_other}}));

  // Under the edge of the two, which the collapse flattens.
  Triangle_soup bump =
      joined(sheet(3, 1), soup({{0.9, 0.5, 0.2}, {1.5, 0.5, 0.2}, {1, 0.55, 0.2}}, {{0, 1, 2}}));
  bump.points[1] = Point_3(1, 0, 1);
  EXPECT_FALSE(is_strip_collapse_accepted(bump, {{s_first, s_other}}));
  EXPECT_FALSE(is_strip_collapse_accepted(bump, {{s_middle, s_other}}));
  EXPECT_TRUE(is_strip_collapse_accepted(bump, {{s_both, s_other}}));
  EXPECT_TRUE(is_strip_collapse_accepted(bump, {{s_first, s_other}, {s_middle, s_other}}));
  Strip_faces one = s_both;
  one.push_back(s_other[0]);
  EXPECT_FALSE(is_strip_collapse_accepted(bump, {{one, {}}})) << "a part may not intersect itself";
}

TEST(Log, NamesOfPartsKeepTheirBytes)
{
  Log_header header;
  header.may_intersect = {{"a b%20", "\xc3\xa4\t\n"}, {"#", "x"}};
  std::stringstream log;
  Log_writer(log, header).write(Log_result{});
  EXPECT_NE(log.str().find("\nmay_intersect a%20b%2520 %c3%a4%09%0a\n"), std::string::npos) << log.str();
  EXPECT_EQ(Log_reader(log, "log").header().may_intersect, header.may_intersect);
}

} // namespace
} // namespace selvedge::test
