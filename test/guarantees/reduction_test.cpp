// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G4 to G8: topology, seams, attributes, stop, determinism.

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace selvedge::test {
namespace {

using Coordinates = std::tuple<double, double, double>;

Coordinates coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

TEST(Topology, OfEveryPieceIsKept)
{
  for (const Triangle_soup& soup :
       {skirt(6000), sheets(3000, 3, 1e-4), nested_spheres(3000, 3, 1e-3), sewn_pieces(2000)}) {
    const Reduction reduction = reduce(soup, without_limits(to_ratio(0.02)));
    EXPECT_TRUE(reduction.verification.same_topology());
    EXPECT_LT(reduction.simplified.soup.triangles.size(), soup.triangles.size() / 4);
  }
}

TEST(Topology, AClosedSurfaceIsNotCollapsedAway)
{
  const Reduction reduction = reduce(nested_spheres(500, 1, 1e-3), without_limits(to_ratio(0)));
  EXPECT_GE(reduction.simplified.soup.triangles.size(), 4u);
  EXPECT_EQ(reduction.verification.pieces.front().euler_characteristic, 2);
}

// Undirected edges that belong to one triangle only, by vertex number.
std::vector<std::pair<Index, Index>> border_edges(const Triangle_soup& soup)
{
  std::map<std::pair<Index, Index>, int> faces;
  for (const Index_triple& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      ++faces[std::minmax({t[k], t[(k + 1) % 3]})];
  std::vector<std::pair<Index, Index>> result;
  for (const auto& [edge, count] : faces)
    if (count == 1)
      result.push_back(edge);
  return result;
}

TEST(Seams, CoincidentBordersCoincideAtEveryVertexAfterwards)
{
  const Triangle_soup garment = skirt(8000, 2);
  const auto sewn_edges = [](const Triangle_soup& soup) {
    std::map<std::pair<Coordinates, Coordinates>, int> borders;
    for (const auto& [a, b] : border_edges(soup))
      ++borders[std::minmax({coordinates(soup.points[a]), coordinates(soup.points[b])})];
    return std::count_if(borders.begin(), borders.end(), [](const auto& entry) { return entry.second == 2; });
  };
  const auto open_edges = [&](const Triangle_soup& soup) {
    return std::ptrdiff_t(border_edges(soup).size()) - 2 * sewn_edges(soup);
  };
  ASSERT_GT(sewn_edges(garment), 100);
  const Reduction reduction = reduce(garment, to_ratio(0.1));
  EXPECT_GE(reduction.simplified.sewing.seam_edges, std::size_t(sewn_edges(garment)))
      << "texture seams count, too";
  EXPECT_GT(sewn_edges(reduction.simplified.soup), 10);
  EXPECT_LT(sewn_edges(reduction.simplified.soup), sewn_edges(garment) / 2);
  EXPECT_LE(open_edges(reduction.simplified.soup), open_edges(garment)) << "a seam has come apart";
}

TEST(Seams, StraightBordersStayWhereTheyAre)
{
  const Reduction reduction = reduce(sheet(20, 20), to_ratio(0.01));
  const Triangle_soup& result = reduction.simplified.soup;
  EXPECT_LT(result.triangles.size(), 20u);
  for (const auto& [a, b] : border_edges(result)) {
    const Point_3 &p = result.points[a], &q = result.points[b];
    const bool is_on_one_side =
        (p.x() == q.x() && (p.x() == 0 || p.x() == 20)) || (p.y() == q.y() && (p.y() == 0 || p.y() == 20));
    EXPECT_TRUE(is_on_one_side);
  }
}

// A sheet whose border y = 0 is an arc that turns by `degrees` at each vertex.
Triangle_soup sheet_with_bent_border(double degrees)
{
  const Index width = 24;
  Triangle_soup result = sheet(width, 3);
  double x = 0, y = 0, direction = 0;
  for (Index i = 0; i <= width; ++i) {
    result.points[i] = Point_3(x, y, 0);
    x += std::cos(direction);
    y -= std::sin(direction);
    direction += degrees * CGAL_PI / 180;
  }
  return result;
}

// A sheet whose border y = 0 zigzags, and turns by `degrees` at each of its inner vertices.
constexpr Index s_zigzag_edges = 24;
Triangle_soup sheet_with_zigzag_border(double degrees)
{
  Triangle_soup result = sheet(s_zigzag_edges, 3);
  for (Index i = 1; i <= s_zigzag_edges; i += 2)
    result.points[i] = Point_3(i, -std::tan(degrees / 2 * CGAL_PI / 180), 0);
  return result;
}

TEST(Seams, BordersTurnByNoMoreThanAllowed)
{
  Simplify_options options = to_ratio(0);
  options.max_border_drift = 10;
  const auto zigzag_left = [&](double degrees) {
    const Reduction reduction = reduce(sheet_with_zigzag_border(degrees), options);
    EXPECT_TRUE(reduction.verification.embedded());
    const auto edges = border_edges(reduction.simplified.soup);
    const auto is_below = [&](const auto& edge) {
      const std::vector<Point_3>& points = reduction.simplified.soup.points;
      return points[edge.first].y() <= 0 && points[edge.second].y() <= 0;
    };
    return std::count_if(edges.begin(), edges.end(), is_below);
  };
  ASSERT_EQ(options.max_border_turn, 8);
  EXPECT_LT(zigzag_left(7), s_zigzag_edges - 10);
  EXPECT_EQ(zigzag_left(9), s_zigzag_edges);
  options.max_border_turn = 10;
  EXPECT_LT(zigzag_left(9), s_zigzag_edges - 10);
}

TEST(Seams, DriftIsBounded)
{
  const Triangle_soup original = sheet_with_bent_border(2);
  Simplify_options options = to_ratio(0);
  options.max_border_turn = 180;
  std::size_t edges_before = 1000;
  for (const double drift : {0.0002, 0.002, 0.02}) {
    options.max_border_drift = drift;
    const Reduction reduction = reduce(original, options);
    const Triangle_soup& result = reduction.simplified.soup;
    const auto edges = border_edges(result);
    // Every original vertex of the bent border is that near to some border edge of the result.
    for (Index i = 0; i <= 24; ++i) {
      double nearest = 1e300;
      for (const auto& [a, b] : edges)
        nearest =
            std::min(nearest, CGAL::squared_distance(original.points[i],
                                                     Kernel::Segment_3(result.points[a], result.points[b])));
      EXPECT_LE(std::sqrt(nearest), drift * reduction.verification.distances->diagonal * (1 + 1e-12));
    }
    EXPECT_LT(edges.size(), edges_before) << "a looser bound should let the border lose more";
    edges_before = edges.size();
  }
}

// What a corner of a soup carries: position, texture coordinate, group.
using Corner = std::tuple<Coordinates, double, double, std::string>;

std::set<Corner> corners(const Triangle_soup& soup)
{
  std::set<Corner> result;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto& uv = soup.uvs.values[soup.uvs.of_triangle[t][k]];
      result.insert({coordinates(soup.points[soup.triangles[t][k]]), uv[0], uv[1],
                     soup.groups.names[soup.groups.of_triangle[t]]});
    }
  return result;
}

TEST(Attributes, EveryCornerIsOneOfTheInput)
{
  for (const char* name : {"skirt", "jacket", "seams"}) {
    Generate_options options;
    options.faces = 6000;
    const Triangle_soup garment = generate(name, options);
    const Reduction reduction = reduce(garment, to_ratio(0.1));
    const std::set<Corner> before = corners(garment), after = corners(reduction.simplified.soup);
    EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end())) << name;
    EXPECT_LT(after.size(), before.size() * 3 / 4);
  }
}

TEST(Attributes, EveryVertexOfTheResultIsOneOfTheInputInItsOrder)
{
  const Triangle_soup garment = skirt(4000);
  const Triangle_soup result = reduce(garment, to_ratio(0.2)).simplified.soup;
  std::size_t next = 0;
  for (const Point_3& p : result.points) {
    while (next < garment.points.size() && garment.points[next] != p)
      ++next;
    ASSERT_LT(next, garment.points.size()) << "not an original vertex, or out of order";
    ++next;
  }
}

TEST(Stop, TargetIsReachedOrTheReportSaysWhatHeldItBack)
{
  const Reduction reached = reduce(nested_spheres(4000, 2, 1e-2), to_ratio(0.3));
  EXPECT_TRUE(reached.simplified.report.is_reached());
  EXPECT_EQ(reached.simplified.report.outcome(), "reached");
  EXPECT_GE(reached.simplified.soup.triangles.size() + 2, reached.simplified.report.faces_target);

  const Reduction stuck = reduce(sheet(8, 8), to_ratio(0));
  EXPECT_FALSE(stuck.simplified.report.is_reached());
  EXPECT_EQ(stuck.simplified.report.outcome(), "border");
  EXPECT_GT(stuck.simplified.report.refused_in_last_pass.border, 0u);
}

TEST(Stop, TheLargerOfTwoTargetsCounts)
{
  Simplify_options options = to_ratio(0.5);
  options.faces = 10;
  EXPECT_EQ(reduce(sheet(10, 10), options).simplified.report.faces_target, 100u);
  options.faces = 150;
  EXPECT_EQ(reduce(sheet(10, 10), options).simplified.report.faces_target, 150u);
}

TEST(Stop, AnErrorBoundEndsTheReduction)
{
  const Triangle_soup sphere = nested_spheres(4000, 1, 1e-2);
  Simplify_options options;
  std::size_t faces_before = sphere.triangles.size();
  for (const double error : {1e-4, 1e-3, 1e-2}) {
    options.max_error = error;
    const Reduction reduction = reduce(sphere, options);
    EXPECT_LT(reduction.simplified.soup.triangles.size(), faces_before);
    EXPECT_LT(reduction.verification.distances->original_to_result.root_mean_square, 2 * error);
    EXPECT_GT(reduction.simplified.report.refused.error, 0u);
    faces_before = reduction.simplified.soup.triangles.size();
  }
}

TEST(Stop, TheHookStopsAtAConsistentState)
{
  Simplify_options options = to_ratio(0.1);
  std::size_t calls = 0;
  options.should_stop = [&](const Simplify_progress& progress) {
    EXPECT_EQ(progress.faces_target, progress.faces_input / 10);
    EXPECT_GE(progress.faces, progress.faces_target);
    return ++calls == 3;
  };
  const Reduction reduction = reduce(nested_spheres(8000, 2, 1e-2), options);
  EXPECT_TRUE(reduction.simplified.report.is_stopped);
  EXPECT_EQ(reduction.simplified.report.outcome(), "stopped");
  EXPECT_TRUE(reduction.verification.accepted());
  EXPECT_GT(reduction.simplified.report.faces_output, 1000u);
}

TEST(Stop, RefusedEdgesAreTriedAgainOnceTheyHaveBecomePossible)
{
  Simplify_options options = to_ratio(0.0);
  options.loop = Collapse_loop::cgal;
  EXPECT_GT(reduce(sheets(6000, 6, 1e-5), options).simplified.report.passes, 2u);
  // The own loop does so at once: the second pass finds nothing.
  options.loop = Collapse_loop::own;
  EXPECT_EQ(reduce(sheets(6000, 6, 1e-5), options).simplified.report.passes, 2u);
}

TEST(Determinism, SameInputAndOptionsGiveTheSameBytes)
{
  const Triangle_soup garment = skirt(6000);
  const Triangle_soup first = reduce(garment, to_ratio(0.2)).simplified.soup;
  const Triangle_soup second = reduce(garment, to_ratio(0.2)).simplified.soup;
  EXPECT_EQ(first.triangles, second.triangles);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.uvs.values, second.uvs.values);
}

TEST(Determinism, TheIndexDoesNotChangeTheResult)
{
  const Triangle_soup garment = skirt(6000);
  Simplify_options options = to_ratio(0.2);
  const Triangle_soup reference = reduce(garment, options).simplified.soup;
  options.index = Face_index::clusters;
  for (const std::size_t size : {1, 10, 100, 100000}) {
    options.faces_per_cluster = size;
    EXPECT_EQ(reduce(garment, options).simplified.soup.triangles, reference.triangles);
  }
}

TEST(Topology, ASlitDoesNotReachTheBorder)
{
  // A sheet with a slit from below, each side of which has its own vertices in the same places, and from its
  // end on a line between two groups up to the border. Where the line ends, the slit must not: the piece
  // would hang together by a single vertex.
  Triangle_soup slit = sheet(4, 3);
  slit.points.insert(slit.points.end(), {slit.points[2], slit.points[7]});
  slit.groups.names = {"left", "right"};
  for (std::size_t t = 0; t < slit.triangles.size(); ++t) {
    const bool is_right = t % 8 >= 4;
    slit.groups.of_triangle.push_back(is_right);
    for (Index& v : slit.triangles[t])
      if (is_right && (v == 2 || v == 7))
        v = v == 2 ? 20 : 21;
  }
  const Reduction reduction = reduce(slit, without_limits(to_ratio(0)));
  EXPECT_GT(reduction.simplified.report.collapses, 3u);
  EXPECT_TRUE(reduction.verification.accepted());
}

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
  expect_refused([](Simplify_options& o) { o.max_seam_turn = std::nan(""); });
  expect_refused([](Simplify_options& o) { o.max_border_drift = -1; });
  expect_refused([](Simplify_options& o) { o.faces_per_cluster = 0; });
  expect_refused([](Simplify_options& o) { o.uv_weight = -1; });
  expect_refused([](Simplify_options& o) { o.uv_weight = std::numeric_limits<double>::infinity(); });
  expect_refused([](Simplify_options& o) { o.cost.border_weight = -1; });
  expect_refused([](Simplify_options& o) { o.cost.stabiliser = std::nan(""); });
}

TEST(Refusal, NothingToReduce)
{
  EXPECT_THROW(prepare(Triangle_soup()), Input_error);
  EXPECT_THROW(prepare(soup({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}})), Input_error);
}

TEST(Prepare, StrictRefusesByTheNumbersOfTheInput)
{
  Prepare_options strict;
  strict.is_strict = true;
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
    EXPECT_TRUE(
        contains(refusal(fine, crossing()), "triangles 1 of the obstacle and 2 of the obstacle intersect;"));
    EXPECT_TRUE(contains(refusal(fine, aside), " of the obstacle intersect, and "));
  }
  // What only rounding makes intersect is not the input's own.
  const double third = 1 / 3.0;
  const Triangle_soup close = joined(sheet(2, 2, third), sheet(2, 2, std::nextafter(third, 1)));
  strict.round_to_float32 = true;
  EXPECT_EQ(refusal(close), "");
  EXPECT_GT(prepare(close, strict).pairs_by_rounding, 0u);
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
  const Prepared_soup rounded = prepare(input, options);
  EXPECT_EQ(rounded.rounding.vertices, 9u);
  EXPECT_GE(rounded.pairs_by_rounding, 8u);
  EXPECT_EQ(rounded.pairs_by_rounding + 1, rounded.offending_pairs.size());
  EXPECT_EQ(rounded.frozen_faces, rounded.soup.triangles.size());
  EXPECT_NE(rounded.positions[0], rounded.positions[9]) << "what only rounding made equal is not welded";
}

} // namespace
} // namespace selvedge::test
