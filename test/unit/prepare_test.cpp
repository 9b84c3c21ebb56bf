// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Preparing a soup, and the inputs and options that are refused.

#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace selvedge::test {
namespace {

TEST(Refusal, OptionsOutOfRange)
{
  const auto expect_refused = [](auto&& change) {
    Simplify_options options = to_ratio(0.5);
    change(options);
    EXPECT_THROW(reduce(sheet(3, 3), options), Argument_error);
  };
  expect_refused([](Simplify_options& o) { o.ratio = -0.1; });
  expect_refused([](Simplify_options& o) { o.ratio = 1.1; });
  expect_refused([](Simplify_options& o) { o.ratio = std::nan(""); });
  expect_refused([](Simplify_options& o) { o.max_error = -1; });
  expect_refused([](Simplify_options& o) { o.max_normal_change = 181; });
  expect_refused([](Simplify_options& o) { o.min_aspect_ratio = 1.5; });
  expect_refused([](Simplify_options& o) { o.max_border_turn = -1; });
  expect_refused([](Simplify_options& o) { o.max_corner_height = -1; });
  expect_refused([](Simplify_options& o) { o.max_seam_turn = std::nan(""); });
  expect_refused([](Simplify_options& o) { o.max_border_drift = -1; });
  expect_refused([](Simplify_options& o) { o.faces_per_cluster = 0; });
  expect_refused([](Simplify_options& o) { o.uv_weight = -1; });
  expect_refused([](Simplify_options& o) { o.normal_weight = -1; });
  expect_refused([](Simplify_options& o) { o.uv_weight = std::numeric_limits<double>::infinity(); });
  expect_refused([](Simplify_options& o) { o.cost.border_weight = -1; });
  expect_refused([](Simplify_options& o) { o.cost.stabiliser = std::nan(""); });
  expect_refused([](Simplify_options& o) { o.cost.memory = std::nan(""); });
  expect_refused([](Simplify_options& o) { o.cost.memory = -0.1; });
  expect_refused([](Simplify_options& o) { o.cost.memory = 1.1; });
}

TEST(Refusal, NothingToReduce)
{
  EXPECT_THROW(prepare(Triangle_soup()), Input_error);
  EXPECT_THROW(prepare(soup({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}})), Input_error);
}

// A small mesh far from the origin, as surveys make them.
TEST(Refusal, NothingLeftInFloats)
{
  const Triangle_soup small = mapped(
      sheet(3, 3), [](const Point_3& p) { return Point_3(1e6 + 1e-4 * p.x(), 1e6 + 1e-4 * p.y(), 0); });
  EXPECT_EQ(prepare(small).soup.triangles.size(), small.triangles.size());
  Prepare_options options;
  options.round_to_float32 = true;
  try {
    prepare(small, options);
    ADD_FAILURE() << "not refused";
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("32-bit floats"), std::string::npos) << error.what();
  }
}

TEST(Refusal, SoupsThatBreakTheirPreconditions)
{
  const auto expect_refused = [](const std::string& words, auto&& change) {
    Triangle_soup input = sheet(3, 3);
    input.uvs = {{{0, 0}}, std::vector<Index_triple>(input.triangles.size(), Index_triple{0, 0, 0})};
    input.groups = {std::vector<Index>(input.triangles.size(), 0), {"sheet"}};
    input.vertex_attributes = {{"quality", Attribute::Type::float32, 2, false, {}}};
    input.vertex_attributes[0].rows.resize(8 * input.points.size());
    EXPECT_NO_THROW(prepare(input));
    const Triangle_soup sound = input;
    change(input);
    try {
      prepare(input);
      ADD_FAILURE() << words;
    } catch (const Argument_error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    EXPECT_THROW(prepare(sound, {}, input), Argument_error) << words;
  };
  expect_refused("triangle 2 (counted from 0) refers to number 99", [](auto& s) { s.triangles[2][1] = 99; });
  expect_refused("vertex 1 ", [](auto& s) { s.points[1] = Point_3(0, std::nan(""), 0); });
  expect_refused("uvs.of_triangle has 17 entries", [](auto& s) { s.uvs.of_triangle.pop_back(); });
  expect_refused("number 1 of the 1 uvs", [](auto& s) { s.uvs.of_triangle[0][0] = 1; });
  expect_refused("groups.of_triangle", [](auto& s) { s.groups.of_triangle.push_back(0); });
  expect_refused("among the groups", [](auto& s) { s.groups.names.clear(); });
  expect_refused("'quality'", [](auto& s) { s.vertex_attributes[0].rows.pop_back(); });
  expect_refused("polygon 0 (counted from 0) has 3 corners", [](auto& s) { s.polygons = {{0, 3, 0}}; });
  expect_refused("2 from triangle 99 on", [](auto& s) { s.polygons = {{99, 4, 0}}; });
  expect_refused("polygon 1 (counted from 0) has triangles", [](auto& s) {
    s.polygons = {{0, 4, 0}, {1, 4, 0}};
  });
  expect_refused("starts at corner 6", [](auto& s) { s.polygons = {{0, 4, 6}}; });
}

TEST(Prepare, StrictRefusesByTheNumbersOfTheInput)
{
  Prepare_options strict;
  strict.defects = Defects::refuse;
  const auto refusal = [&](const Triangle_soup& input, const Triangle_soup& obstacle = {}) -> std::string {
    try {
      prepare(input, strict, obstacle);
    } catch (const Input_error& error) {
      return error.what();
    }
    return "";
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const Triangle_soup clean = sheet(2, 2, 5);
  for (const bool is_rounded : {false, true}) {
    SCOPED_TRACE(is_rounded ? "rounded" : "not rounded");
    strict.round_to_float32 = is_rounded;
    // Thirds are no floats: rounding has something to do.
    const Triangle_soup fine =
        mapped(clean, [](const Point_3& p) { return Point_3(p.x() / 3, p.y(), p.z()); });
    const Triangle_soup aside =
        mapped(fine, [](const Point_3& p) { return Point_3(p.x() + 0.125, p.y() + 0.125, p.z()); });
    EXPECT_EQ(refusal(fine), "");
    EXPECT_TRUE(contains(refusal(joined(fine, crossing())), "triangles 9 and 10 intersect;"));
    EXPECT_TRUE(contains(refusal(joined(fine, collinear_triangle())), "triangle 9 is degenerate;"));
    Triangle_soup twice = fine;
    twice.triangles.insert(twice.triangles.begin(), {0, 0, 1});
    EXPECT_TRUE(
        contains(refusal(joined(twice, crossing())), "triangle 1 is degenerate, and 1 more such pair"));
    EXPECT_TRUE(contains(refusal(fine, crossing()), "triangles 1 and 2 of the obstacle intersect;"));
    EXPECT_TRUE(contains(refusal(fine, aside), " and triangle 1 of the obstacle intersect, and "));
  }
  // What only rounding makes intersect is not the input's own.
  const double third = 1 / 3.0;
  const Triangle_soup close = joined(sheet(2, 2, third), sheet(2, 2, std::nextafter(third, 1)));
  strict.round_to_float32 = true;
  EXPECT_EQ(refusal(close), "");
  EXPECT_GT(prepare(close, strict).pairs_by_rounding, 0u);
  Triangle_soup in_pose = joined(sheet(2, 2, 1), sheet(2, 2, 2));
  in_pose.poses = {{"close", close.points}};
  EXPECT_EQ(refusal(in_pose), "");
  in_pose.poses[0].points = joined(sheet(2, 2, third), sheet(2, 2, third)).points;
  EXPECT_TRUE(contains(refusal(in_pose), "not embedded in the pose 'close': triangles 1 and 9 "));
}

TEST(Prepare, TrianglesWithTwoCornersAtOnePositionAreLeftOutAndCounted)
{
  Triangle_soup input = sheet(2, 2);
  input.triangles.push_back({0, 0, 1});
  input.points.push_back(input.points[4]);
  input.triangles.push_back({4, 9, 5});
  const Prepared_soup prepared = prepare(input);
  EXPECT_EQ(prepared.left_out_faces, 2u);
  EXPECT_EQ(prepared.soup.triangles, sheet(2, 2).triangles);
}

TEST(Prepare, RoundingIsCountedApartFromTheInputsOwnDefects)
{
  // Two sheets so close that floats cannot tell them apart, and one pair that crosses by itself.
  const double gap = 1e-12;
  Triangle_soup input =
      joined(joined(sheet(2, 2, 1), sheet(2, 2, 1 + gap)),
             mapped(crossing(), [](const Point_3& p) { return Point_3(p.x() + 100, p.y(), p.z()); }));
  EXPECT_EQ(prepare(input).offending_pairs.size(), 1u);
  Prepare_options options;
  options.round_to_float32 = true;
  options.defects = Defects::freeze;
  const Prepared_soup rounded = prepare(input, options);
  EXPECT_EQ(rounded.rounding.vertices, 9u);
  EXPECT_GE(rounded.pairs_by_rounding, 8u);
  EXPECT_EQ(rounded.pairs_by_rounding + 1, rounded.offending_pairs.size());
  EXPECT_EQ(rounded.frozen_faces, rounded.soup.triangles.size());
  EXPECT_NE(rounded.positions[0], rounded.positions[9]) << "what only rounding made equal is not welded";
}

} // namespace
} // namespace selvedge::test
