// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"
#include "verify/triangles_of_part.h"

#include <selvedge/Error.h>
#include <selvedge/part_report.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

// A wavy sheet of two groups, left and right, sewn along a line.
Triangle_soup two_groups(Index size = 30)
{
  Triangle_soup soup = mapped(sheet(size, size), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(0.3 * p.x()) * std::cos(0.4 * p.y()));
  });
  soup.groups.names = {"sleeve left", "body"};
  for (const auto& [a, b, c] : soup.triangles)
    soup.groups.of_triangle.push_back(soup.points[a].x() + soup.points[b].x() + soup.points[c].x() >
                                      1.5 * size);
  return soup;
}

using Position = std::array<double, 3>;

std::vector<std::array<Position, 3>> faces_of(const Triangle_soup& soup, Index group)
{
  std::vector<std::array<Position, 3>> faces;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (soup.groups.of_triangle[t] != group)
      continue;
    std::array<Position, 3>& face = faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& p = soup.points[soup.triangles[t][k]];
      face[k] = {p.x(), p.y(), p.z()};
    }
  }
  return faces;
}

Simplify_intent locked(const std::string& name)
{
  Simplify_intent intent;
  intent.locked = {name};
  return intent;
}

Simplify_intent kept(const std::string& name)
{
  Simplify_intent intent;
  intent.kept = {name};
  return intent;
}

TEST(Intent, NoVertexOfALockedGroupMoves)
{
  const Prepared_soup prepared = prepare(two_groups());
  const Simplified_soup result = simplify_soup(prepared, to_ratio(0.6), locked("body"));
  EXPECT_EQ(faces_of(result.soup, 1), faces_of(prepared.soup, 1));
  EXPECT_TRUE(result.report.is_reached());
  EXPECT_TRUE(verify(result, prepared).accepted());

  // The control: without the lock both give way.
  EXPECT_NE(faces_of(simplify_soup(prepared, to_ratio(0.6)).soup, 1), faces_of(prepared.soup, 1));
}

TEST(Intent, ARatioIsOfTheFacesThatCanChangeAndANumberIsOfAll)
{
  const Prepared_soup prepared = prepare(two_groups());
  const std::size_t faces = prepared.soup.triangles.size(), of_body = faces_of(prepared.soup, 1).size();
  const Simplify_report by_ratio = simplify_soup(prepared, to_ratio(0.6), locked("body")).report;
  EXPECT_GE(by_ratio.faces_fixed, of_body);
  EXPECT_LT(by_ratio.faces_fixed, of_body + 10);
  EXPECT_EQ(by_ratio.faces_target,
            by_ratio.faces_fixed + std::size_t(std::llround(0.6 * double(faces - by_ratio.faces_fixed))));
  EXPECT_TRUE(by_ratio.is_reached());
  EXPECT_EQ(simplify_soup(prepared, to_ratio(0.6)).report.faces_fixed, 0u); // the control

  Simplify_options by_number;
  by_number.faces = std::size_t(0.6 * double(faces));
  const Simplify_report report = simplify_soup(prepared, by_number, locked("body")).report;
  EXPECT_EQ(report.faces_target, *by_number.faces);
  EXPECT_TRUE(report.is_reached());
}

TEST(Intent, NoFaceOfAKeptGroupChangesAndTheTargetIsForTheOthers)
{
  const Prepared_soup prepared = prepare(two_groups());
  const Simplified_soup result = simplify_soup(prepared, to_ratio(0.4), kept("body"));
  EXPECT_EQ(faces_of(result.soup, 1), faces_of(prepared.soup, 1));
  const std::size_t others = faces_of(prepared.soup, 0).size();
  EXPECT_EQ(result.report.faces_target,
            faces_of(prepared.soup, 1).size() + std::size_t(std::llround(0.4 * double(others))));
  EXPECT_TRUE(result.report.is_reached());
  EXPECT_LE(faces_of(result.soup, 0).size(), 0.4 * double(others) + 0.5);
}

TEST(Intent, AGroupKeepsItsOwnRatioAndTheOthersGoOn)
{
  const Prepared_soup prepared = prepare(two_groups());
  for (const auto& [own, rest] : {std::pair(0.8, 0.3), std::pair(0.25, 0.7), std::pair(1.0, 0.4)}) {
    SCOPED_TRACE(own);
    Simplify_intent intent;
    intent.ratios = {{"body", own}};
    const Simplified_soup result = simplify_soup(prepared, to_ratio(rest), intent);
    for (const auto& [group, ratio] : {std::pair(Index(1), own), std::pair(Index(0), rest)}) {
      const double target = ratio * double(faces_of(prepared.soup, group).size());
      // The last collapse may take one face more than asked for.
      EXPECT_NEAR(double(faces_of(result.soup, group).size()), target, 1.5) << group;
    }
    EXPECT_TRUE(result.report.is_reached());
    EXPECT_TRUE(verify(result, prepared).accepted());
  }
}

// A large mesh, of which a relaxed order takes one tile after the other.
TEST(Intent, AGroupThatLosesFewFacesLosesThemEverywhere)
{
  constexpr Index size = 320;
  const Triangle_soup soup = two_groups(size);
  Simplify_intent intent;
  intent.ratios = {{"body", 0.98}};
  const Simplified_soup result = simplify_soup(prepare(soup), to_ratio(0.5), intent);
  const auto faces_below_the_middle = [](const Triangle_soup& of) {
    const auto faces = faces_of(of, 1);
    return std::count_if(faces.begin(), faces.end(),
                         [](const auto& face) { return face[0][1] < 0.5 * size; });
  };
  const auto lost_in_all = double(faces_of(soup, 1).size() - faces_of(result.soup, 1).size());
  const auto lost_below = double(faces_below_the_middle(soup) - faces_below_the_middle(result.soup));
  EXPECT_GT(lost_in_all, 1500);
  EXPECT_GT(lost_below, 0.3 * lost_in_all);
  EXPECT_LT(lost_below, 0.7 * lost_in_all);
}

TEST(Intent, EveryPartNamedMustReachItsRatio)
{
  const Prepared_soup prepared = prepare(two_groups());
  Simplify_intent intent;
  intent.ratios = {{"body", 0.5}};
  Simplify_options options = to_ratio(1);
  EXPECT_TRUE(simplify_soup(prepared, options, intent).report.is_reached()); // the control
  options.min_aspect_ratio = 1;
  const Simplified_soup result = simplify_soup(prepared, options, intent);
  EXPECT_FALSE(result.report.is_reached());
  EXPECT_NE(result.report.outcome(), "reached");
}

TEST(Intent, APartIsCalledByItsGroupsItsObjectOrItsMaterial)
{
  Triangle_soup soup = two_groups(8);
  soup.objects = {std::vector<Index>(soup.triangles.size(), 0), {"jacket"}};
  soup.materials = {std::vector<Index>(soup.triangles.size(), 0), {"denim", "not used"}};
  for (const char* const name : {"sleeve left", "sleeve", "left", "body", "jacket", "denim"}) {
    SCOPED_TRACE(name);
    const std::vector<char> named = triangles_named(soup, name);
    EXPECT_GT(std::count(named.begin(), named.end(), true), 0);
  }
  const std::vector<char> body = triangles_named(soup, "body");
  EXPECT_EQ(std::size_t(std::count(body.begin(), body.end(), true)), faces_of(soup, 1).size());
}

TEST(Intent, PartsAreCalledByAPattern)
{
  Triangle_soup soup = two_groups(8);
  const auto expect = [&](const std::string& pattern, std::size_t named) {
    const std::vector<char> is_named = triangles_named(soup, pattern);
    EXPECT_EQ(std::size_t(std::count(is_named.begin(), is_named.end(), true)), named) << pattern;
    EXPECT_EQ(internal::triangles_of_part(soup, pattern), is_named) << "the judge reads " << pattern;
  };
  const std::size_t sleeve = faces_of(soup, 0).size(), body = faces_of(soup, 1).size();
  for (const char* const pattern : {"s*", "sleeve*", "*left", "l?ft", "sleeve?left", "*l*"})
    expect(pattern, sleeve);
  expect("b??y", body);
  expect("*", sleeve + body);
  for (const char* const pattern : {"b?y", "?", "*x*", "ody*"})
    EXPECT_THROW(triangles_named(soup, pattern), Argument_error) << pattern;
  soup.groups.names[1] = "b*y"; // which a pattern may be as well
  expect("b*y", body);
  Simplify_intent intent;
  intent.ratios = {{"sl*", 0.25}};
  intent.kept = {"b?y"};
  const Simplified_soup result = simplify_soup(prepare(soup), Simplify_options(), intent);
  EXPECT_EQ(faces_of(result.soup, 1).size(), body);
  EXPECT_LE(faces_of(result.soup, 0).size(), sleeve / 4 + 1);
}

TEST(Intent, APartIsCalledByAnAttributeThatSaysYesOrNoOfItsTriangles)
{
  Triangle_soup soup = two_groups(8);
  std::vector<unsigned char> rows(soup.triangles.size(), 0);
  soup.triangle_attributes = {{"nowhere", Attribute::Type::uint8, 1, false, rows}};
  rows[3] = rows[5] = 1;
  soup.triangle_attributes.push_back({"fixed", Attribute::Type::uint8, 1, false, rows});
  rows[4] = 2;
  soup.triangle_attributes.push_back({"number", Attribute::Type::uint8, 1, false, rows});
  const std::vector<char> named = triangles_named(soup, "fixed");
  EXPECT_EQ(std::count(named.begin(), named.end(), true), 2);
  EXPECT_TRUE(named[3] && named[5]);
  const std::vector<char> nowhere = triangles_named(soup, "nowhere");
  EXPECT_EQ(std::count(nowhere.begin(), nowhere.end(), true), 0);
  EXPECT_THROW(triangles_named(soup, "number"), Argument_error);
}

TEST(Intent, AnUnknownNameIsRefusedAndTheKnownOnesAreListed)
{
  const Prepared_soup prepared = prepare(two_groups(8));
  Simplify_intent unknown_ratio, unknown_weights;
  unknown_ratio.ratios = {{"collar", 0.5}};
  unknown_weights.weights = "paint";
  for (const Simplify_intent& intent : {locked("collar"), kept("collar"), unknown_ratio}) {
    try {
      simplify_soup(prepared, to_ratio(0.5), intent);
      ADD_FAILURE() << "no refusal";
    } catch (const Argument_error& error) {
      EXPECT_NE(std::string(error.what()).find("body, sleeve left"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(simplify_soup(prepared, to_ratio(0.5), unknown_weights), Argument_error);
  EXPECT_THROW(triangles_named(prepared.soup, ""), Argument_error);
}

void paint(Triangle_soup& soup, double left, double right)
{
  Attribute column{"paint", Attribute::Type::float64, 1, false, {}};
  for (const Point_3& p : soup.points) {
    const double value = p.x() < 15 ? left : right;
    const std::size_t place = column.rows.size();
    column.rows.resize(place + sizeof value);
    std::memcpy(&column.rows[place], &value, sizeof value);
  }
  soup.vertex_attributes = {column};
}

TEST(Intent, PaintedWeightsSayWhereFacesAreKept)
{
  const auto faces_left = [](double left, double right) {
    Triangle_soup soup = two_groups();
    paint(soup, left, right);
    Simplify_intent intent;
    intent.weights = "paint";
    const Simplified_soup result = simplify_soup(prepare(std::move(soup)), to_ratio(0.3), intent);
    return double(faces_of(result.soup, 0).size()) / double(result.soup.triangles.size());
  };
  const double even = faces_left(1, 1); // the control
  EXPECT_GT(faces_left(1, 0.01), even + 0.1);
  EXPECT_LT(faces_left(0.01, 1), even - 0.1);
  EXPECT_EQ(faces_left(7, 7), even); // only what is larger than what matters
  EXPECT_EQ(faces_left(0, 0), even);
  EXPECT_THROW(faces_left(-1, 1), Argument_error);
}

// A flat sheet close under the wavy one, and one that only touches nothing because it lies there.
Triangle_soup body_below(double gap)
{
  return mapped(sheet(10, 10), [&](const Point_3& p) {
    const double x = 3 * p.x(), y = 3 * p.y();
    return Point_3(x, y, std::sin(0.3 * x) * std::cos(0.4 * y) - gap);
  });
}

TEST(Intent, AnObstacleIsSeenNeverChangedAndNotInTheOutput)
{
  Triangle_soup cloth = two_groups(), body = body_below(0.5);
  ASSERT_TRUE(is_embedded(joined(cloth, body)));
  const Prepared_soup prepared = prepare(cloth, {}, body);
  EXPECT_TRUE(prepared.offending_pairs.empty());
  const Simplified_soup result = simplify_soup(prepared, without_limits(to_ratio(0.02)));
  EXPECT_GT(result.report.refused.intersection, 0u);
  EXPECT_EQ(result.report.faces_input, cloth.triangles.size());
  EXPECT_EQ(result.report.faces_output, result.soup.triangles.size());
  EXPECT_LT(result.soup.triangles.size(), cloth.triangles.size() / 2);
  EXPECT_TRUE(is_embedded(joined(result.soup, body)));
  EXPECT_TRUE(verify(result, prepared).accepted());

  // The control: who does not see it goes through it, and the judge who does says so.
  const Simplified_soup blind = simplify_soup(prepare(cloth), without_limits(to_ratio(0.02)));
  EXPECT_FALSE(is_embedded(joined(blind.soup, body)));
  EXPECT_FALSE(verify(blind, prepared).accepted());
}

TEST(Intent, PairsThatOffendBetweenGarmentAndObstacleAreFrozen)
{
  const Triangle_soup cloth = two_groups();
  Triangle_soup pin = soup({{10.3, 10.2, -5}, {10.6, 10.2, 5}, {10.3, 10.6, 5}}, {{0, 1, 2}});
  const Prepared_soup prepared = prepare(cloth, with(Defects::freeze), pin);
  ASSERT_FALSE(prepared.offending_pairs.empty());
  EXPECT_GT(prepared.frozen_faces, 0u);
  const Simplified_soup result = simplify_soup(prepared, to_ratio(0.3));
  const Verification verification = verify(result, prepared);
  EXPECT_EQ(verification.pairs.size(), prepared.offending_pairs.size());
  EXPECT_TRUE(verification.accepted());

  Prepare_options strict;
  strict.defects = Defects::refuse;
  EXPECT_THROW(prepare(cloth, strict, pin), Input_error);
  EXPECT_NO_THROW(prepare(cloth, strict));
}

TEST(Intent, AnObstacleStaysExactWhereTheOutputIsRounded)
{
  Prepare_options options;
  options.round_to_float32 = true;
  const Triangle_soup body = body_below(0.5);
  const Prepared_soup prepared = prepare(two_groups(), options, body);
  EXPECT_GT(prepared.rounding.coordinates, 0u);
  EXPECT_EQ(prepared.obstacle.points, body.points);
  EXPECT_EQ(prepared.obstacle.triangles, body.triangles);
  EXPECT_TRUE(verify(simplify_soup(prepared, to_ratio(0.3)), prepared).accepted());
}

TEST(Report, CountsFacesAndRefusalsOfEveryPieceAndGroup)
{
  const Prepared_soup prepared = prepare(garment("jacket", 6000));
  const Simplified_soup result = simplify_soup(prepared, to_ratio(0.2));
  const std::vector<Part_report> parts = part_reports(result, prepared).parts;
  std::set<Part_kind::Name> kinds;
  for (const Part_report& part : parts)
    kinds.insert(part.kind);
  EXPECT_TRUE(kinds.count(Part_kind::Name::piece));
  EXPECT_TRUE(kinds.count(Part_kind::Name::group));
  for (const Part_kind::Name kind : kinds) {
    SCOPED_TRACE(name(kind));
    std::size_t faces_input = 0, faces_output = 0, parts_of_kind = 0;
    Refusals refused;
    for (const Part_report& part : parts) {
      if (part.kind != kind)
        continue;
      ++parts_of_kind;
      faces_input += part.faces_input;
      faces_output += part.faces_output;
      refused += part.refused;
      EXPECT_TRUE(part.uv_deviation);
      EXPECT_GE(part.distance.maximum, part.distance.root_mean_square);
    }
    EXPECT_GT(parts_of_kind, 1u);
    EXPECT_EQ(faces_input, prepared.soup.triangles.size());
    EXPECT_EQ(faces_output, result.soup.triangles.size());
    EXPECT_EQ(refused.border, result.report.refused.border);
    EXPECT_EQ(refused.aspect_ratio, result.report.refused.aspect_ratio);
    EXPECT_EQ(refused.intersection, result.report.refused.intersection);
  }
}

TEST(Report, APartThatDidNotChangeIsNowhereAway)
{
  const Prepared_soup prepared = prepare(two_groups());
  const Simplified_soup result = simplify_soup(prepared, to_ratio(0.2), kept("body"));
  const Part_reports reports = part_reports(result, prepared);
  for (const Part_report& part : reports.parts) {
    if (part.name == "body") {
      EXPECT_EQ(part.distance.maximum, 0);
      EXPECT_EQ(part.faces_input, part.faces_output);
    } else {
      EXPECT_GT(part.distance.maximum, 0);
      EXPECT_LT(part.faces_output, part.faces_input);
    }
    EXPECT_FALSE(part.uv_deviation);
  }
}

} // namespace
} // namespace selvedge::test
