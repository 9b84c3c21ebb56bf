// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A mesh multiplied by a power of two is the same mesh: it takes the same steps, is judged alike, and has the
// same figures, from subnormal coordinates up to the largest.

#include "support/logged_reduction.h"
#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/compare.h>
#include <selvedge/internal/Scale.h>
#include <selvedge/mesh_files.h>
#include <selvedge/part_report.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

constexpr double s_smallest = std::numeric_limits<double>::denorm_min();

Point_3 multiplied(const Point_3& p, int exponent)
{
  return {std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent)};
}

Triangle_soup multiplied(const Triangle_soup& soup, int exponent)
{
  return mapped(soup, [&](const Point_3& p) {
    const Point_3 result = multiplied(p, exponent);
    EXPECT_EQ(multiplied(result, -exponent), p) << "digits were lost, so this says nothing";
    return result;
  });
}

/// With coordinates that are multiples of 2^-26 below 2^27, so that some more powers of two are exact.
Triangle_soup rounded(const Triangle_soup& soup)
{
  return mapped(soup, [](const Point_3& p) {
    const auto nearest = [](double x) { return std::ldexp(std::nearbyint(std::ldexp(x, 26)), -26); };
    return Point_3(nearest(p.x()), nearest(p.y()), nearest(p.z()));
  });
}

struct Scene
{
  Triangle_soup soup;
  Simplify_options options;
  double weld_distance = 0;
  Triangle_soup obstacle = {};

  Scene at(int exponent) const
  {
    return {multiplied(soup, exponent), options, std::ldexp(weld_distance, exponent),
            multiplied(obstacle, exponent)};
  }

  Logged_reduction run() const
  {
    Prepare_options prepare_options;
    prepare_options.weld_distance = weld_distance;
    return reduce_and_log(soup, options, prepare_options, false, obstacle);
  }
};

// Limits that are lengths may differ.
std::string steps_of(const std::string& log)
{
  std::istringstream lines(log);
  std::string steps;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("limit", 0) != 0)
      steps += line + '\n';
  return steps;
}

std::array<std::size_t, 6> counts_of(const Refusals& refused)
{
  return {refused.border,        refused.error, refused.aspect_ratio,
          refused.normal_change, refused.uv,    refused.intersection};
}

void expect_same(const Scene& scene, const std::vector<int>& exponents)
{
  const Logged_reduction expected = scene.run();
  EXPECT_GT(expected.simplified.report.collapses, 20u) << "there is nothing to compare";
  for (const int exponent : exponents) {
    SCOPED_TRACE("times 2^" + std::to_string(exponent));
    const Scene multiple = scene.at(exponent);
    const Logged_reduction found = multiple.run();
    EXPECT_EQ(steps_of(found.log), steps_of(expected.log));
    EXPECT_EQ(found.simplified.triangles, expected.simplified.triangles);
    EXPECT_EQ(found.simplified.soup.triangles, expected.simplified.soup.triangles);
    EXPECT_EQ(found.simplified.soup.points, multiplied(expected.simplified.soup, exponent).points);
    EXPECT_EQ(counts_of(found.simplified.report.refused), counts_of(expected.simplified.report.refused));

    const Replay_verdict verdict = replay_text(found.original, found.log);
    EXPECT_TRUE(verdict.is_accepted()) << (verdict.violations.empty() ? "" : verdict.violations[0].message);
    Verify_options options;
    options.weld_distance = multiple.weld_distance;
    options.are_shapes_judged = false; // limits see to these
    EXPECT_TRUE(verify(found.simplified.soup, found.original, options).accepted());
  }
}

const std::vector<int> s_exponents{-900, -300, -81, 1, 300, 900};

Simplify_options with_close_limits(double ratio)
{
  Simplify_options options = to_ratio(ratio);
  options.max_normal_change = 12;
  options.min_aspect_ratio = 0.3;
  options.max_border_drift = 0.0004;
  options.max_error = 0.02;
  return options;
}

Scene garment_scene()
{
  return {garment("skirt", 600, 2), with_close_limits(0.1)};
}

TEST(Scale, TakesTheSameStepsWithEveryLimitAtWork)
{
  Scene scene = garment_scene();
  scene.options.uv_weight = 1;
  const Refusals refused = scene.run().simplified.report.refused;
  EXPECT_GT(refused.border, 0u);
  EXPECT_GT(refused.normal_change, 0u);
  EXPECT_GT(refused.aspect_ratio, 0u);
  EXPECT_GT(refused.error, 0u);
  Scene without_drift = scene, without_texture = scene;
  without_drift.options.max_border_drift = 10;
  EXPECT_NE(steps_of(without_drift.run().log), steps_of(scene.run().log));
  without_texture.options.uv_weight = 0;
  EXPECT_NE(steps_of(without_texture.run().log), steps_of(scene.run().log));

  expect_same(scene, {-900, -450, -250, 81, 240, 450, 900});
}

TEST(Scale, TakesTheSameStepsAtSeams)
{
  Simplify_options options = to_ratio(0.2);
  options.max_border_drift = 0.001;
  expect_same({sewn_pieces(300), options}, s_exponents);
}

TEST(Scale, TakesTheSameStepsWithTheClusteredIndex)
{
  Scene scene = garment_scene();
  scene.options.index = Face_index::clusters;
  scene.options.faces_per_cluster = 20;
  expect_same(scene, s_exponents);
}

TEST(Scale, TakesTheSameStepsWithEverythingAtOnce)
{
  Triangle_soup left = sheet(8, 4), right = mapped(sheet(8, 4), [](const Point_3&p) {
                                      return Point_3(p.x() + 8 + 0x1p-7, p.y() + 0x1p-6, p.z() + 0x1p-5);
                                    });
  const Triangle_soup layer = joined(left, right);
  const auto at_height = [&](double z) {
    return mapped(layer, [&](const Point_3& p) { return Point_3(p.x(), p.y(), p.z() + z); });
  };
  Scene scene{joined(layer, at_height(0.25)), to_ratio(0.2)};
  scene.obstacle = at_height(0.125);
  scene.options.faces_per_cell = 40;
  scene.options.max_border_drift = 0.01;
  scene.weld_distance = 0.05;
  const Logged_reduction run = scene.run();
  EXPECT_NE(run.log.find("\ns "), std::string::npos) << "nothing was closed";
  EXPECT_GT(run.simplified.report.collapses_in_cells, 20u);
  expect_same(scene, {-1000, -900, -300, -81, 1, 300, 900, 1000});
}

TEST(Scale, TakesTheSameStepsUpToTheEndsOfTheDoubles)
{
  Scene scene = garment_scene();
  scene.soup = rounded(scene.soup);
  expect_same(scene, {-1048, -1000, 1020});
}

TEST(Scale, TakesTheSameStepsWithCoordinatesOfAllSizes)
{
  // Where the largest coordinates become small, such as these vanish: only exact predicates know them.
  Scene scene{mapped(sheet(8, 8),
                     [](const Point_3& p) {
                       return Point_3(p.x(), p.y(), s_smallest * (int(5 * p.x() + 3 * p.y()) % 4));
                     }),
              to_ratio(0.2)};
  expect_same(scene, {1, 40, 300, 700, 1000});
}

TEST(Scale, AMeshOfTheCallerTakesTheSameStepsInTheRangeStatedAndIsRefusedOutside)
{
  const auto reduced = [](const Triangle_soup& soup) {
    Mesh mesh = mesh_of(soup);
    Simplify_options options = to_ratio(0.1);
    options.max_normal_change = 15;
    options.max_error = 0.01;
    const Simplify_report report = simplify_mesh(mesh, options);
    EXPECT_GT(report.refused.border, 0u);
    EXPECT_GT(report.refused.normal_change, 0u);
    EXPECT_GT(report.refused.error, 0u);
    return soup_of(mesh).triangles;
  };
  const Triangle_soup soup =
      mapped(sheet(12, 12), [](const Point_3& p) { return Point_3(p.x(), p.y(), std::sin(p.x() * p.y())); });
  const std::vector<Index_triple> expected = reduced(soup);
  for (const int exponent : {-204, -100, 100, 195}) { // the diagonal is from 2^4 to 2^5
    SCOPED_TRACE(exponent);
    EXPECT_EQ(reduced(multiplied(soup, exponent)), expected);
  }
  for (const int exponent : {-900, -300, -205, 196, 300, 900, 1018}) {
    SCOPED_TRACE(exponent);
    Mesh mesh = mesh_of(multiplied(soup, exponent));
    try {
      simplify_mesh(mesh, to_ratio(0.1));
      ADD_FAILURE() << "it was not refused";
    } catch (const Argument_error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("bounding box"), std::string::npos) << message;
      EXPECT_NE(message.find(exponent < 0 ? "too small" : "too large"), std::string::npos) << message;
      EXPECT_NE(message.find("power of two"), std::string::npos) << message;
    }
    EXPECT_EQ(mesh.number_of_faces(), soup.triangles.size());
  }
}

TEST(Scale, DividesWithoutTheLossOfADigit)
{
  const double most = std::numeric_limits<double>::max();
  const auto with_corner = [](double x) { return soup({{0, 0, 0}, {x, 0, 0}, {0, x, 0}}, {{0, 1, 2}}); };
  // The largest coordinate comes into [1/2, 1).
  for (const double x : {s_smallest, 3 * s_smallest, 0x1p-1022, 1e-300, 0.3, 1.0, -77.7, 1e300, most}) {
    const Scale scale(with_corner(x));
    EXPECT_GE(std::abs(scale(x)), 0.5) << x;
    EXPECT_LT(std::abs(scale(x)), 1) << x;
    EXPECT_EQ(scale.undone(scale(x)), x);
  }
  // As near as digits, or an obstacle, allow.
  EXPECT_EQ(Scale(joined(with_corner(8), with_corner(s_smallest)))(8.0), 8);
  EXPECT_EQ(Scale(joined(with_corner(8), with_corner(0x1p-1072)))(8.0), 2);
  EXPECT_EQ(Scale(with_corner(0x1p-20), with_corner(s_smallest))(0x1p-20), 0.5);
  EXPECT_EQ(Scale(with_corner(0x1p-20), with_corner(0x1p1010))(0x1p-20), 0x1p-7);
  EXPECT_EQ(Scale(with_corner(0x1p-20), with_corner(most))(0x1p-20), 0x1p-20);

  EXPECT_EQ(Scale()(8.0), 8);
  EXPECT_EQ(Scale(Triangle_soup())(8.0), 8);
  EXPECT_EQ(Scale(with_corner(0))(8.0), 8);
  Triangle_soup with_unused = with_corner(8);
  with_unused.points.emplace_back(s_smallest, 0x1p1010, 0);
  EXPECT_EQ(Scale(with_unused)(8.0), 0.5);
}

TEST(Scale, IsRefusedWhereCoordinatesAreTooFarApart)
{
  const auto message = [](const Triangle_soup& own, const Triangle_soup& obstacle) -> std::string {
    try {
      prepare(own, {}, obstacle);
    } catch (const Input_error& error) {
      return error.what();
    }
    return "";
  };
  const Triangle_soup own = sheet(2, 2);
  const auto with_height = [&](double z) {
    Triangle_soup result = own;
    result.points[0] = Point_3(0, 0, z);
    return result;
  };
  EXPECT_EQ(message(with_height(s_smallest), {}), "");
  EXPECT_EQ(message(multiplied(own, 130), with_height(s_smallest)), "");
  EXPECT_EQ(message(own, multiplied(own, 1020)), "");
  EXPECT_NE(message(mapped(with_height(s_smallest),
                           [](const Point_3& p) {
                             return Point_3(std::ldexp(p.x(), 300), std::ldexp(p.y(), 300), p.z());
                           }),
                    {})
                .find("round the smallest coordinates"),
            std::string::npos);
  EXPECT_NE(message(multiplied(own, -300), multiplied(own, 900)).find("one unit"), std::string::npos);
}

// The judge
// ------------------------------------------------------------------------------------------------------------

/// A log that keeps no limit, with the limits of another.
std::string unlimited_log_with_limits(const Scene& scene)
{
  Scene unlimited = scene;
  unlimited.options = without_limits(without_check(scene.options));
  unlimited.options.max_error.reset();
  std::istringstream limited_lines(scene.run().log), lines(unlimited.run().log);
  std::string log, limits;
  for (std::string line; std::getline(limited_lines, line);)
    if (line.rfind("limit", 0) == 0)
      limits += line + '\n';
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("limit", 0) != 0)
      log += line + '\n';
    if (line.rfind("rounding", 0) == 0)
      log += limits;
  }
  return log;
}

TEST(Scale, ReplayFindsTheSameStepsBad)
{
  const Scene scene{mapped(sheet(9, 9),
                           [](const Point_3& p) {
                             return Point_3(p.x(), p.y() + 0.1 * std::sin(p.x()), std::sin(p.x() * p.y()));
                           }),
                    with_close_limits(0.3)};
  const std::string log = unlimited_log_with_limits(scene);
  Replay_options all;
  all.is_all_wanted = true;
  const auto violations = [&](const Triangle_soup& original) {
    std::vector<std::pair<std::size_t, Violation_kind>> found;
    for (const Violation& violation : replay_text(original, log, all).violations)
      found.emplace_back(violation.step, violation.kind);
    return found;
  };
  const auto expected = violations(scene.soup);
  for (const Violation_kind kind :
       {Violation_kind::border_drift, Violation_kind::normal_change, Violation_kind::aspect_ratio})
    EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](const auto& violation) {
      return violation.second == kind;
    })) << name(kind);
  for (const int exponent : s_exponents) {
    SCOPED_TRACE(exponent);
    EXPECT_EQ(violations(multiplied(scene.soup, exponent)), expected);
  }
}

void expect_equal(const Distance& found, const Distance& expected)
{
  EXPECT_EQ(found.root_mean_square, expected.root_mean_square);
  EXPECT_EQ(found.maximum, expected.maximum);
}

void expect_equal(const Bounds& found, const Bounds& expected)
{
  EXPECT_EQ(found.lower, expected.lower);
  EXPECT_EQ(found.upper, expected.upper);
}

void expect_equal(const Line_comparison& found, const Line_comparison& expected)
{
  for (const auto line : {&Line_comparison::original_to_result, &Line_comparison::result_to_original}) {
    expect_equal((found.*line).of_ends, (expected.*line).of_ends);
    expect_equal((found.*line).maximum, (expected.*line).maximum);
  }
}

TEST(Scale, FiguresAreTheSame)
{
  Scene scene = garment_scene();
  scene.soup = rounded(scene.soup);
  const Reduction reduction = reduce(scene.soup, scene.options);
  const Comparison expected = compare(reduction.simplified.soup, scene.soup);
  const Distances expected_distances = distances(reduction.simplified.soup, scene.soup);
  const Part_reports expected_reports = part_reports(reduction.simplified, reduction.prepared);
  const std::vector<Part_report>& expected_parts = expected_reports.parts;
  EXPECT_EQ(expected_reports.uv_deviation->mean,
            uv_deviation(reduction.simplified, reduction.prepared)->mean);
  EXPECT_GT(expected.normals.maximum, 0);
  EXPECT_GT(expected.layers.compared, 0u);
  EXPECT_GT(expected_parts.front().uv_deviation->maximum, 0);
  for (const int exponent : {-900, -300, 300, 900, 1020}) {
    SCOPED_TRACE(exponent);
    const Triangle_soup original = multiplied(scene.soup, exponent);
    const Reduction multiple = reduce(original, scene.options);
    const Triangle_soup& result = multiple.simplified.soup;

    const Distances found_distances = distances(result, original);
    expect_equal(found_distances.original_to_result, expected_distances.original_to_result);
    expect_equal(found_distances.result_to_original, expected_distances.result_to_original);
    EXPECT_EQ(found_distances.diagonal, std::ldexp(expected_distances.diagonal, exponent));

    const Comparison found = compare(result, original);
    EXPECT_EQ(found.diagonal, std::ldexp(expected.diagonal, exponent));
    expect_equal(found.distances.original_to_result, expected.distances.original_to_result);
    expect_equal(found.distances.result_to_original, expected.distances.result_to_original);
    expect_equal(found.borders, expected.borders);
    expect_equal(found.seams, expected.seams);
    EXPECT_EQ(found.normals.mean, expected.normals.mean);
    EXPECT_EQ(found.normals.maximum, expected.normals.maximum);
    EXPECT_EQ(found.layers.lines, expected.layers.lines);
    EXPECT_EQ(found.layers.compared, expected.layers.compared);

    const std::vector<Part_report> parts = part_reports(multiple.simplified, multiple.prepared).parts;
    ASSERT_EQ(parts.size(), expected_parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      expect_equal(parts[i].distance, expected_parts[i].distance);
      EXPECT_EQ(parts[i].uv_deviation->mean, expected_parts[i].uv_deviation->mean);
      EXPECT_EQ(parts[i].uv_deviation->maximum, expected_parts[i].uv_deviation->maximum);
    }
  }
}

TEST(Scale, GapsAreTheSame)
{
  // Two halves of a sheet that have come apart.
  const auto halves = [](double gap) {
    return joined(sheet(4, 4), mapped(sheet(4, 4), [&](const Point_3& p) {
                    return Point_3(p.x() + 4 + gap, p.y(), p.z());
                  }));
  };
  const Triangle_soup original = halves(0), result = halves(0.25);
  const Gaps expected = compare(result, original).gaps;
  EXPECT_GT(expected.width, 0);
  for (const int exponent : {-1000, -400, 400, 1000}) {
    const Gaps found = compare(multiplied(result, exponent), multiplied(original, exponent)).gaps;
    EXPECT_EQ(found.open_edges, expected.open_edges);
    EXPECT_EQ(found.length, expected.length);
    EXPECT_EQ(found.width, expected.width);
  }
}

// Files
// ------------------------------------------------------------------------------------------------------------

TEST(Scale, PolygonsAreCutTheSame)
{
  // Seen along y and z it is a line, so that the view has to be chosen.
  const auto triangles = [](int exponent) {
    std::ostringstream text;
    text.precision(17);
    for (const Point_3& p :
         {Point_3(0, 0, 0), Point_3(0, 4, 0), Point_3(0, 4, 4), Point_3(0, 3, 1), Point_3(0, 0, 4)}) {
      const Point_3 q = multiplied(p, exponent);
      text << "v " << q.x() << ' ' << q.y() << ' ' << q.z() << '\n';
    }
    text << "f 1 2 3 4 5\n";
    return read_mesh(text.str(), Mesh_format::obj, "five.obj").soup.triangles;
  };
  for (const int exponent : {-1000, -600, 600, 1000})
    EXPECT_EQ(triangles(exponent), triangles(0)) << exponent;
}

// Its scale is that of its coordinates.
TEST(Scale, RefusesAMeshThatIsTooSmallForWhereItLies)
{
  const auto far_away = [](int exponent) {
    return mapped(sheet(4, 4),
                  [=](const Point_3& p) { return Point_3(std::ldexp(1, exponent), p.y(), p.x()); });
  };
  EXPECT_EQ(reduce(far_away(150), to_ratio(0.5)).simplified.report.faces_output, 16u);
  EXPECT_THROW(prepare(far_away(250)), Input_error);
}

} // namespace
} // namespace selvedge::test
