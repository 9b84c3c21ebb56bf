// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The log and the replay: what simplify did is accepted to the last bit, and what must be refused is.

#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/mesh/mesh_files.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace selvedge::test {
namespace {

bool are_same_bits(const Triangle_soup& a, const Triangle_soup& b)
{
  if (a.triangles != b.triangles || a.points.size() != b.points.size() || a.uvs.values != b.uvs.values ||
      a.uvs.of_triangle != b.uvs.of_triangle || a.groups.of_triangle != b.groups.of_triangle)
    return false;
  for (std::size_t v = 0; v < a.points.size(); ++v)
    for (int k = 0; k < 3; ++k) {
      const double x = a.points[v][k], y = b.points[v][k];
      if (std::memcmp(&x, &y, sizeof x) != 0)
        return false;
    }
  return true;
}

void expect_accepted(const Triangle_soup& soup, const Simplify_options& options,
                     const Prepare_options& prepare_options = {}, bool is_stl = false)
{
  const Logged_reduction reduction = reduce_and_log(soup, options, prepare_options, is_stl);
  const Replay_verdict verdict = replay_text(soup, reduction.log, {}, is_stl);
  EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().step << ": "
                                     << verdict.violations.front().message;
  EXPECT_TRUE(verdict.is_result_stated);
  EXPECT_EQ(verdict.collapses, reduction.simplified.report.collapses);
  EXPECT_GT(verdict.collapses, 10u);
  EXPECT_TRUE(are_same_bits(verdict.soup, reduction.simplified.soup));
}

TEST(Replay, AcceptsReductionsOfGeneratedScenesToTheLastBit)
{
  expect_accepted(skirt(3000), to_ratio(0.2));
  expect_accepted(garment("jacket", 3000), to_ratio(0.2));
  expect_accepted(sheets(2000, 3, 1e-4), to_ratio(0.1));
  expect_accepted(nested_spheres(2000, 3, 1e-3), to_ratio(0.1));
  expect_accepted(folded_cloth(2000, 4, 1e-4), to_ratio(0.1));
  expect_accepted(sewn_pieces(300), to_ratio(0.2));
  expect_accepted(flat_grid(300), to_ratio(0.2));
  expect_accepted(skirt(3000), without_limits(to_ratio(0.05)));
}

TEST(Replay, AcceptsReductionsOfRoundedAndOfStlInput)
{
  Prepare_options rounding;
  rounding.round_to_float32 = true;
  expect_accepted(skirt(2000), to_ratio(0.3), rounding);
  Triangle_soup corners = sheets(600, 2, 1e-3);
  expect_accepted(corners, to_ratio(0.3), {}, true);
}

TEST(Replay, AcceptsWhatIsLeftFreeWhereRoundingMergesPositions)
{
  // Two sheets with a common border, a vertex each; and a third that comes to one of them only when it is
  // rounded. All faces at both vertices stand still, not only those at the first.
  const Triangle_soup right =
      mapped(sheet(4, 4, 1), [](const Point_3& p) { return Point_3(p.x() + 4, p.y(), 1); });
  Triangle_soup both = joined(sheet(4, 4, 1), right);
  ASSERT_EQ(both.points[14], both.points[35]);
  both = joined(both, soup({{4, 2, 1 + 1e-12}, {4, 2, 3}, {5, 2, 3}}, {{0, 1, 2}}));
  Prepare_options rounding;
  rounding.round_to_float32 = true;
  expect_accepted(both, without_limits(to_ratio(0)), rounding);
  EXPECT_EQ(prepare(both, rounding).frozen_faces, 7u) << "three at either vertex, and the third's";
}

TEST(Replay, AcceptsSnapsAsMotions)
{
  Triangle_soup gap = sheet(6, 6);
  const Triangle_soup other = sheet(6, 6);
  const Index offset = Index(gap.points.size());
  for (const Point_3& p : other.points)
    gap.points.emplace_back(p.x(), p.y() + 6.001, p.z() + 1e-4);
  for (const auto& [a, b, c] : other.triangles)
    gap.triangles.push_back({a + offset, b + offset, c + offset});
  Prepare_options snapping;
  snapping.weld_distance = 0.01;
  const Logged_reduction reduction = reduce_and_log(gap, to_ratio(0.3), snapping);
  EXPECT_NE(reduction.log.find("\ns "), std::string::npos);
  const Replay_verdict verdict = replay_text(gap, reduction.log);
  EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
  EXPECT_TRUE(are_same_bits(verdict.soup, reduction.simplified.soup));
}

TEST(Replay, AcceptsReductionsOfRealGarments)
{
  const std::filesystem::path folder = std::filesystem::path(SELVEDGE_SHARED_DATA) / "garments";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no real meshes in " << folder;
  for (const char* file : {"dress_14_pieces_uv.obj", "multilayer_skirt.obj", "avatar_in_suit_uv.obj"}) {
    SCOPED_TRACE(file);
    expect_accepted(read_mesh(folder / file).soup, to_ratio(0.3));
  }
}

TEST(Replay, UnguardedReductionIsRefusedAtItsFirstBadStep)
{
  const Triangle_soup soup = sheets(1000, 3, 1e-4);
  const Logged_reduction reduction = reduce_and_log(soup, without_check(to_ratio(0.2)));
  const Replay_verdict first = replay_text(soup, reduction.log);
  ASSERT_EQ(first.violations.size(), 1u);
  Replay_options all;
  all.is_all_wanted = true;
  const Replay_verdict every = replay_text(soup, reduction.log, all);
  ASSERT_GT(every.violations.size(), 10u);
  EXPECT_EQ(every.violations.front().step, first.violations.front().step);
  EXPECT_TRUE(first.violations.front().kind == Violation_kind::intersection ||
              first.violations.front().kind == Violation_kind::tunnelling);
  EXPECT_FALSE(first.violations.front().point.empty());
  EXPECT_NE(first.violations.front().scene.find("o other\n"), std::string::npos);
  EXPECT_TRUE(are_same_bits(every.soup, reduction.simplified.soup)) << "bad steps are taken all the same";

  // Up to the bad step all is well, and with it no longer, says the judge of meshes.
  std::istringstream lines(reduction.log);
  std::string prefix;
  for (std::size_t steps = 0; steps < first.violations.front().step;) {
    std::string line;
    std::getline(lines, line);
    steps += line[0] == 'c';
    prefix += line + '\n';
  }
  if (first.violations.front().kind == Violation_kind::intersection) {
    Replay_options options;
    options.is_all_wanted = true;
    const auto replayed = [&](const std::string& text) {
      return replay_text(soup, text + "result 0 0 -\n", options).soup;
    };
    EXPECT_FALSE(is_embedded(replayed(prefix)));
    EXPECT_TRUE(is_embedded(replayed(prefix.substr(0, prefix.rfind('c')))));
  }
}

std::string head_of(const Triangle_soup& soup, const std::string& limits = {})
{
  return "selvedge-log 1\ninput " + std::to_string(soup.points.size()) + ' ' +
         std::to_string(soup.triangles.size()) + " -\n" + limits;
}

Violation_kind kind_of_first(const Triangle_soup& soup, const std::string& log)
{
  const Replay_verdict verdict = replay_text(soup, log);
  EXPECT_FALSE(verdict.violations.empty());
  return verdict.violations.at(0).kind;
}

TEST(Replay, RefusesACollapseThatTunnels)
{
  const Tunnel_scene scene = tunnel_scene();
  const std::string step = "c " + std::to_string(scene.moving) + ' ' + std::to_string(scene.target) + '\n';
  Replay_options all;
  all.is_all_wanted = true;
  const std::string log = head_of(scene.soup) + step + "result 1 0 -\n";
  EXPECT_EQ(kind_of_first(scene.soup, log), Violation_kind::tunnelling);
  const Replay_verdict verdict = replay_text(scene.soup, log, all);
  EXPECT_TRUE(is_embedded(verdict.soup)) << "the end does not show it";
}

TEST(Replay, RefusesWhatTheDeclaredLimitsForbid)
{
  // A strip whose border turns by 20° at vertex 1.
  Triangle_soup strip;
  const double angle = 20 * 3.14159265358979 / 180;
  strip.points = {{0, 0, 0}, {1, 0, 0}, {1 + std::cos(angle), -std::sin(angle), 0},
                  {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  strip.triangles = {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}};
  const std::string collapse = "c 1 2\nresult 1 3 -\n";
  EXPECT_EQ(kind_of_first(strip, head_of(strip, "limit border_turn 8\n") + collapse),
            Violation_kind::border_turn);
  EXPECT_EQ(kind_of_first(strip, head_of(strip, "limit border_drift 0.01\n") + collapse),
            Violation_kind::border_drift);
  EXPECT_EQ(kind_of_first(strip, head_of(strip, "limit border_turn 30\n") + "c 1 4\nresult 1 2 -\n"),
            Violation_kind::link);
  EXPECT_TRUE(replay_text(strip, head_of(strip, "limit border_turn 30\n") + collapse).is_accepted());
  Replay_options free;
  free.are_limits_judged = false;
  EXPECT_TRUE(replay_text(strip, head_of(strip, "limit border_turn 8\n") + collapse, free).is_accepted());

  // A flat sheet with a bump in its middle, taken to a neighbour.
  Triangle_soup bump = sheet(4, 4);
  bump.points[12] = Point_3(2, 2, 2);
  const std::string flatten = "c 12 13\nresult 1 30 -\n";
  EXPECT_EQ(kind_of_first(bump, head_of(bump, "limit normal_change 45\n") + flatten),
            Violation_kind::normal_change);
  EXPECT_EQ(kind_of_first(bump, head_of(bump, "limit aspect_ratio 0.9\n") + flatten),
            Violation_kind::aspect_ratio);
}

TEST(Replay, RefusesAFoldAndAClosedLink)
{
  // Vertex 12 of a flat sheet, moved two edges away by way of a vertex that is none of its neighbours.
  const Triangle_soup flat = sheet(4, 4);
  EXPECT_EQ(kind_of_first(flat, head_of(flat) + "c 12 14\nresult 1 30 -\n"), Violation_kind::no_edge);
  EXPECT_EQ(kind_of_first(flat, head_of(flat) + "c 12 13 4 4 0\nresult 1 30 -\n"),
            Violation_kind::degenerate);
  EXPECT_EQ(kind_of_first(flat, head_of(flat) + "c 12 13\nc 12 13\nresult 1 30 -\n"),
            Violation_kind::no_edge);
  EXPECT_EQ(kind_of_first(flat, head_of(flat) + "c 12 13\nresult 1 29 -\n"), Violation_kind::result);
}

TEST(Replay, JudgesPlacesThatAreNoVertices)
{
  const Triangle_soup flat = sheet(4, 4);
  for (const char* first : {"", " kept", " removed"}) {
    const std::string step = std::string("c 12 13 2.5 2.125 0.25") + first + "\nresult 1 30 -\n";
    const Replay_verdict verdict = replay_text(flat, head_of(flat) + step);
    ASSERT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
    EXPECT_TRUE(is_embedded(verdict.soup));
    EXPECT_EQ(std::count(verdict.soup.points.begin(), verdict.soup.points.end(), Point_3(2.5, 2.125, 0.25)),
              1);
  }
  EXPECT_TRUE(replay_text(flat, head_of(flat) + "c 12 13 2 2 0\nresult 1 30 -\n").is_accepted())
      << "where 12 is";
}

TEST(Replay, FrozenFacesDoNotMove)
{
  Triangle_soup soup = sheet(6, 6);
  soup.points.insert(soup.points.end(), {{2.1, 2.2, -1}, {2.3, 2.2, -1}, {2.2, 2.3, 1}});
  soup.triangles.push_back({49, 50, 51});
  ASSERT_FALSE(is_embedded(soup));
  EXPECT_EQ(kind_of_first(soup, head_of(soup) + "c 16 17\nresult 1 71 -\n"), Violation_kind::locked);
  EXPECT_TRUE(replay_text(soup, head_of(soup) + "c 40 39\nresult 1 71 -\n").is_accepted());
}

TEST(Log, WhatIsNoLogIsRefusedWithItsLine)
{
  const Triangle_soup flat = sheet(4, 4);
  const std::string head = head_of(flat);
  for (const std::string& text :
       {std::string(), std::string("solid\n"), std::string("selvedge-log 2\n"), head, head + "c 1\n",
        head + "c 1 99\nresult 0 0 -\n", head + "c 1 -1\n", head + "c 1 2 3\n", head + "c 12 13 1 2 nan\n",
        head + "q\n", head + "result 0 32 zz\n", head + "limit speed 3\n",
        head + "limit seam_turn 3\nlimit seam_turn 3\n", head + "c 12 13\ns 1 2\n",
        head + "w 1 2\nresult 0 32 -\n", head + "result 0 32 -\nc 12 13\n"}) {
    SCOPED_TRACE(text);
    EXPECT_THROW(replay_text(flat, text), Input_error);
  }
  EXPECT_THROW(replay_text(sheet(4, 5), head + "result 0 40 -\n"), Input_error) << "another mesh";
}

TEST(Log, DigestIsThatOfTheStandard)
{
  Sha256 sha256;
  sha256.add("a");
  sha256.add("bc");
  EXPECT_EQ(sha256.digest(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

} // namespace
} // namespace selvedge::test
