// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Spokes: edges across which corners differ at one end only, their pole. They bind the pole and not the ring
// around it or the end of a cut, and what is left of them stays a line (G4, G5, G6).

#include "soup/Working_mesh.h"
#include "support/logged_reduction.h"
#include "support/polar_sphere.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Surface_mesh_simplification/Border_rule.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

TEST(Spokes, RingsAroundPolesGoAndEveryCornerIsOneOfTheInput)
{
  for (const int cell_faces : {0, 150}) {
    const Triangle_soup sphere = polar_sphere(32, 24, false);
    ASSERT_EQ(faces_at_poles(sphere), 64u);
    Simplify_options options = to_ratio(0.2);
    options.faces_per_cell = std::size_t(cell_faces);
    const Logged_reduction reduction = reduce_and_log(sphere, options);
    const Triangle_soup& result = reduction.simplified.soup;
    EXPECT_LE(reduction.simplified.report.faces_output, sphere.triangles.size() / 5);
    EXPECT_LT(faces_at_poles(result), 40u);
    const auto before = facts_of_corners(sphere), after = facts_of_corners(result);
    EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
    const Replay_verdict verdict = replay_text(sphere, reduction.log);
    EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
    EXPECT_TRUE(verify(reduction.simplified, prepare(sphere)).accepted());
  }
}

// A control: with a vertex for each triangle, the edges at a pole are borders of the piece, and stay.
TEST(Spokes, StayAroundAHoleOfThePiece)
{
  const Triangle_soup sphere = polar_sphere(32, 24, true);
  const Reduction reduction = reduce(sphere, to_ratio(0.2));
  EXPECT_EQ(faces_at_poles(reduction.simplified.soup), 64u);
  EXPECT_TRUE(reduction.verification.accepted());
}

TEST(Spokes, EverythingGoesThatMayWithoutLimits)
{
  Simplify_options options = without_limits(to_ratio(0));
  options.max_error.reset();
  options.check_uv_orientation = false;
  const Triangle_soup sphere = polar_sphere(12, 8, false);
  for (const Placement placement : {Placement::vertices, Placement::optimal}) {
    options.placement = placement;
    const Logged_reduction reduction = reduce_and_log(sphere, options);
    EXPECT_LE(reduction.simplified.soup.triangles.size(), 12u);
    const Replay_verdict verdict = replay_text(sphere, reduction.log);
    EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
    EXPECT_TRUE(verify(reduction.simplified, prepare(sphere)).accepted());
  }
}

/// A disc of triangles around vertex 0, in a ring of twice as many, with these values at the centre.
Triangle_soup disc(const std::vector<Index>& of_triangle)
{
  Triangle_soup result;
  result.points = {Point_3(0, 0, 0)};
  const Index n = Index(of_triangle.size());
  const double step = 2 * CGAL_PI / n;
  for (const double radius : {1., 2.})
    for (Index i = 0; i < n; ++i) {
      const double angle = step * (radius > 1 ? i - 0.2 : i);
      result.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
  for (Index i = 0; i < n; ++i) {
    const Index a = 1 + i, b = 1 + (i + 1) % n;
    result.triangles.push_back({0, a, b});
    result.triangles.push_back({a, n + a, n + b});
    result.triangles.push_back({a, n + b, b});
  }
  for (const Point_3& p : result.points)
    result.uvs.values.push_back({p.x(), p.y()});
  result.uvs.of_triangle = result.triangles;
  const Index first = Index(result.uvs.values.size());
  for (Index i = 0; i < n; ++i) {
    result.uvs.values.push_back({0.01 * i, 0});
    result.uvs.of_triangle[3 * i][0] = first + of_triangle[i];
  }
  return result;
}

/// The kind of the first violation of steps, under a limit that makes lines matter; none if there is none.
std::optional<Violation_kind> first_violation(const Triangle_soup& soup, const std::string& steps,
                                              std::size_t count,
                                              const std::string& limit = "limit seam_turn 180\n")
{
  std::ostringstream log;
  log << head_of(soup, limit) << steps << "result " << count << ' ' << soup.triangles.size() - 2 * count
      << " -\n";
  const Replay_verdict verdict = replay_text(soup, log.str());
  return verdict.is_accepted() ? std::nullopt : std::optional(verdict.violations.front().kind);
}

TEST(Spokes, ReplayKnowsThem)
{
  const Triangle_soup six = disc({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(first_violation(six, "c 1 2\n", 1), std::nullopt);
  EXPECT_EQ(first_violation(six, "c 1 0\n", 1), Violation_kind::line) << "along a spoke to its pole";
  EXPECT_EQ(first_violation(six, "c 0 1\n", 1), Violation_kind::line) << "a pole with six spokes";
  const Triangle_soup three = disc({0, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2});
  EXPECT_EQ(first_violation(three, "c 1 2\n", 1), std::nullopt);
  EXPECT_EQ(first_violation(three, "c 1 2\nc 2 3\n", 2), Violation_kind::line) << "one line would be left";
  EXPECT_EQ(first_violation(three, "c 1 2\nc 0 2\nc 3 2\n", 3), std::nullopt) << "a line is left of the pole";
  const Triangle_soup two = disc({0, 0, 0, 1, 1, 1});
  EXPECT_EQ(first_violation(two, "c 1 2\n", 1), std::nullopt) << "the end of a cut";
  EXPECT_EQ(first_violation(two, "c 1 0\n", 1), Violation_kind::line);
  EXPECT_EQ(first_violation(two, "c 0 1\n", 1), std::nullopt) << "the cut is gone";
}

/// Such a disc in two groups: all of a sector has that of its triangle at the centre, or the triangle alone.
Triangle_soup disc_in_groups(const std::vector<Index>& of_triangle, const std::vector<Index>& groups,
                             bool has_sectors)
{
  Triangle_soup result = disc(of_triangle);
  result.groups.names = {"one", "other"};
  for (const Index group : groups)
    for (int k = 0; k < 3; ++k)
      result.groups.of_triangle.push_back(k == 0 || has_sectors ? group : 0);
  return result;
}

/// Whether the rule of a reduction lets a vertex go to another, by their numbers, for those inside a disc.
std::map<std::pair<Index, Index>, bool> moves_inside(const Triangle_soup& soup)
{
  const Prepared_soup prepared = prepare(soup);
  const Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen, prepared.obstacle);
  const auto& mesh = working.mesh();
  Border_rule_options options;
  options.max_seam_turn = 180;
  options.max_drift = 10;
  Border_rule<Working_mesh::Mesh> rule(mesh, options);
  for (const auto e : working.constraints().line_edges)
    rule.mark(e);
  for (const auto spoke : working.constraints().spokes)
    rule.mark_at_target(spoke);
  const std::vector<Index> of_soup = working.vertices_of_soup(prepared.obstacle);
  const Index first_outside = Index(soup.points.size() / 2 + 1);
  std::map<std::pair<Index, Index>, bool> result;
  for (const auto h : mesh.halfedges()) {
    const Index mover = of_soup[mesh.source(h)], goal = of_soup[mesh.target(h)];
    if (mover < first_outside && goal < first_outside)
      result[{mover, goal}] = rule.may_move(h);
  }
  return result;
}

// The line 1 – 0 – 4 parts two groups. At its vertex 0, a cut through the texture ends.
TEST(Spokes, APoleOnALineStays)
{
  const std::vector<Index> groups = {0, 0, 0, 1, 1, 1};
  const Triangle_soup without = disc_in_groups({0, 0, 0, 0, 0, 0}, groups, true),
                      with_one = disc_in_groups({0, 1, 1, 0, 0, 0}, groups, true),
                      with_two = disc_in_groups({0, 1, 1, 1, 1, 0}, groups, true);
  EXPECT_EQ(first_violation(without, "c 0 1\n", 1), std::nullopt);
  for (const Triangle_soup& soup : {with_one, with_two}) {
    EXPECT_EQ(first_violation(soup, "c 0 1\n", 1), Violation_kind::line);
    EXPECT_EQ(first_violation(soup, "c 0 2\n", 1), Violation_kind::line);
    EXPECT_EQ(first_violation(soup, "c 2 0\n", 1), Violation_kind::line) << "along a spoke to its pole";
    EXPECT_EQ(first_violation(soup, "c 1 0\n", 1), std::nullopt) << "along the line to the pole";
    EXPECT_EQ(first_violation(soup, "c 2 1\n", 1), std::nullopt) << "the spoke becomes a part of the line";
  }
  EXPECT_EQ(first_violation(with_one, "c 2 1\nc 0 1\n", 2), std::nullopt) << "a vertex of the line is left";
  EXPECT_EQ(first_violation(with_two, "c 2 1\nc 0 1\n", 2), Violation_kind::line) << "a spoke is left";
  for (const Triangle_soup& soup : {without, with_one, with_two})
    for (const auto& [move, may_move] : moves_inside(soup)) {
      const std::string step = "c " + std::to_string(move.first) + ' ' + std::to_string(move.second) + '\n';
      EXPECT_EQ(may_move, first_violation(soup, step, 1) != Violation_kind::line) << step;
    }
}

// The line 0 – 1 – 2 – 3 – 0 goes around two triangles at the centre, between which the texture may be cut.
TEST(Spokes, NoFaceBetweenTwoLinesAndASpokeVanishes)
{
  const std::vector<Index> groups = {1, 1, 0, 0, 0, 0};
  const Triangle_soup without = disc_in_groups({0, 0, 0, 0, 0, 0}, groups, false),
                      with = disc_in_groups({0, 1, 0, 0, 0, 0}, groups, false);
  for (const auto& move : {std::pair<Index, Index>(1, 0), {1, 2}, {3, 0}, {3, 2}}) {
    EXPECT_TRUE(moves_inside(without).at(move)) << move.first << ' ' << move.second;
    EXPECT_FALSE(moves_inside(with).at(move)) << move.first << ' ' << move.second;
  }
}

/// A bumpy sheet of 24 × 24 squares with cuts of four edges into its texture, along x = 4, 8, … 20, and the
/// positions of their ends. The vertices inside the cuts are two each if they are split.
struct Cut_sheet
{
  explicit Cut_sheet(bool is_split)
  {
    constexpr Index size = 24;
    const auto at = [](Index x, Index y) { return y * (size + 1) + x; };
    soup = mapped(sheet(size, size), [](const Point_3& p) {
      return Point_3(p.x(), p.y(), 0.4 * std::sin(0.9 * p.x()) * std::cos(0.7 * p.y()));
    });
    for (const Point_3& p : soup.points)
      soup.uvs.values.push_back({p.x(), p.y()});
    soup.uvs.of_triangle = soup.triangles;
    for (Index x = 4; x < size; x += 4)
      for (Index y = 2; y < size; y += 8) {
        ends.push_back(soup.points[at(x, y)]);
        ends.push_back(soup.points[at(x, y + 4)]);
        for (Index inside = y + 1; inside < y + 4; ++inside)
          cut(at(x, inside), is_split);
      }
  }

  // Parts the corners on the right of a vertex from those on its left.
  void cut(Index v, bool is_split)
  {
    const double x = soup.points[v].x();
    soup.uvs.values.push_back({x + 100, soup.points[v].y()});
    if (is_split)
      soup.points.push_back(Point_3(soup.points[v]));
    for (Index t = 0; t < soup.triangles.size(); ++t) {
      const Index_triple corners = soup.triangles[t];
      const bool is_right = std::any_of(corners.begin(), corners.end(),
                                        [&](Index corner) { return soup.points[corner].x() > x; });
      for (std::size_t k = 0; k < 3; ++k)
        if (is_right && corners[k] == v) {
          soup.uvs.of_triangle[t][k] = Index(soup.uvs.values.size() - 1);
          if (is_split)
            soup.triangles[t][k] = Index(soup.points.size() - 1);
        }
    }
  }

  Triangle_soup soup;
  std::vector<Point_3> ends;
};

TEST(Spokes, EndsOfCutsMoveAndPiecesStayAsTheyAre)
{
  for (const bool is_split : {false, true}) {
    const Cut_sheet cuts(is_split);
    for (const double max_drift : {0.002, 0.01}) {
      Simplify_options options = to_ratio(0.25);
      options.max_border_drift = max_drift;
      options.check_uv_orientation = false;
      for (Simplify_options means : every_means(options, 150)) {
        const Logged_reduction reduction = reduce_and_log(cuts.soup, means);
        const std::vector<Point_3>& points = reduction.simplified.soup.points;
        const auto left = std::count_if(cuts.ends.begin(), cuts.ends.end(), [&](const Point_3& end) {
          return std::find(points.begin(), points.end(), end) != points.end();
        });
        EXPECT_LT(std::size_t(left), cuts.ends.size() * 2 / 3);
        const Replay_verdict verdict = replay_text(cuts.soup, reduction.log);
        EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
        EXPECT_TRUE(verify(reduction.simplified, prepare(cuts.soup)).accepted());
      }
    }
  }
}

// As many ends of cuts as there are stay apart, and away from the border of the piece.
TEST(Spokes, NoCutJoinsAnotherOrTheBorder)
{
  for (const bool is_split : {false, true}) {
    Simplify_options options = without_limits(to_ratio(0));
    options.check_uv_orientation = false;
    for (const Simplify_options& means : every_means(options, 150)) {
      const Logged_reduction reduction = reduce_and_log(Cut_sheet(is_split).soup, means);
      const Replay_verdict verdict = replay_text(reduction.original, reduction.log);
      EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
      EXPECT_TRUE(verify(reduction.simplified, prepare(reduction.original)).accepted());
    }
  }
}

// A cut along x = 2, from y = 0 to y = 4 in a sheet that is 4 × 6: what it has passed stays near it when its
// end moves.
TEST(Spokes, WhatACutHasPassedStaysNearIt)
{
  Cut_sheet cuts(false);
  cuts.soup = with_own_uvs_at(sheet(4, 6), 0);
  for (const Index v : {2, 7, 12, 17})
    cuts.cut(v, false);
  const std::string passes = "c 17 12\n", moves = passes + "c 22 21\n";
  EXPECT_EQ(first_violation(cuts.soup, passes, 1, "limit border_drift 0.01\n"), std::nullopt);
  EXPECT_EQ(first_violation(cuts.soup, moves, 2, "limit border_drift 0.05\n"), Violation_kind::border_drift);
  EXPECT_EQ(first_violation(cuts.soup, moves, 2, "limit border_drift 0.07\n"), std::nullopt);
}

// Marks the lines at vertex 0 of a disc as spokes, and says whether the first may go to the second.
TEST(Spokes, ARuleLetsThemGoWhileTwoAreLeft)
{
  const Prepared_soup prepared = prepare(disc({0, 1, 2, 3, 4, 5}));
  const Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen, prepared.obstacle);
  ASSERT_EQ(working.constraints().spokes.size(), 6u);
  EXPECT_TRUE(working.constraints().line_edges.empty());
  const auto& mesh = working.mesh();
  const auto rule_with = [&](std::size_t count) {
    Border_rule<Working_mesh::Mesh> rule(mesh);
    for (std::size_t i = 0; i < count; ++i)
      rule.mark_at_target(working.constraints().spokes[i]);
    return rule;
  };
  const Border_rule<Working_mesh::Mesh> all = rule_with(6);
  for (const auto spoke : working.constraints().spokes) {
    EXPECT_TRUE(all.is_free(mesh.source(spoke)));
    EXPECT_FALSE(all.is_free(mesh.target(spoke)));
    EXPECT_FALSE(all.is_line(mesh.edge(spoke)));
    EXPECT_TRUE(all.is_line_at_target(spoke));
    EXPECT_FALSE(all.is_line_at_target(mesh.opposite(spoke)));
    EXPECT_EQ(all.refusal(spoke), Line_refusal::line_end);
    EXPECT_EQ(all.refusal(mesh.opposite(spoke)), Line_refusal::line_end);
    EXPECT_TRUE(all.may_move(mesh.opposite(mesh.prev(spoke)))) << "along the ring";
  }
  // Where two are left, a vertex between them may not take one.
  for (const std::size_t count : {2, 3}) {
    const Border_rule<Working_mesh::Mesh> rule = rule_with(count);
    std::size_t between = 0, allowed = 0;
    for (const auto h : mesh.halfedges()) {
      if (mesh.is_border(h) || !rule.is_line_at_target(mesh.next(h)) ||
          !rule.is_line_at_target(mesh.opposite(mesh.prev(h))))
        continue;
      ++between;
      allowed += rule.may_move(h);
    }
    EXPECT_GT(between, 0u);
    EXPECT_EQ(allowed, count == 3 ? between : 0u);
  }
}

} // namespace
} // namespace selvedge::test
