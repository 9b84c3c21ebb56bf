// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The log and the replay: what simplify did is accepted to the last bit, and what must be refused is.

#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"
#include "support/tunnel_scene.h"

#include "verify/Diagonal.h"

#include <selvedge/Error.h>
#include <selvedge/Sha256.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <utility>

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

/// Faces around point 0, above a circle of the other points.
Triangle_soup cone(Index rim)
{
  Triangle_soup result;
  result.points = {Point_3(0, 0, 1)};
  for (Index i = 0; i < rim; ++i) {
    const double angle = 2 * CGAL_PI * i / rim;
    result.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    result.triangles.push_back({0, 1 + i, 1 + (i + 1) % rim});
  }
  return result;
}

// Without limits of lines a vertex may leave a seam. Then the faces beyond it have no value at the place.
TEST(Replay, FacesBeyondASeamThatIsLeftGoAlong)
{
  for (const bool are_vertices_apart : {false, true}) {
    Triangle_soup soup = sheet(4, 4);
    if (are_vertices_apart)
      soup = joined(sheet(2, 4), moved(sheet(2, 4), 2, 0, 0));
    else
      for (const Index_triple& triangle : soup.triangles) {
        const bool is_right =
            std::any_of(triangle.begin(), triangle.end(), [&](Index v) { return v % 5 > 2; });
        soup.uvs.values.push_back({is_right ? 1. : 0., double(soup.uvs.values.size())});
        soup.uvs.of_triangle.push_back({});
        soup.uvs.of_triangle.back().fill(Index(soup.uvs.values.size() - 1));
      }
    const std::string step = are_vertices_apart ? "c 8 7" : "c 12 11";
    const Replay_verdict verdict = replay_text(soup, head_of(soup) + step + "\nresult 1 30 -\n");
    ASSERT_TRUE(verdict.is_accepted());
    const auto has = [&](double x, double y) {
      return std::any_of(
          verdict.soup.triangles.begin(), verdict.soup.triangles.end(), [&](const Index_triple& triangle) {
            return std::any_of(triangle.begin(), triangle.end(),
                               [&](Index v) { return verdict.soup.points[v] == Point_3(x, y, 0); });
          });
    };
    EXPECT_FALSE(has(2, 2)) << "a face has stayed where the vertex was";
    EXPECT_TRUE(has(1, 2));
    EXPECT_TRUE(is_embedded(verdict.soup));
  }
}

// The middle of the lower border bulges out by 0.3 and goes to a new place on the straight border, which the
// limit of 0.35 allows. The second step leads the border away from where it was, up to 0.37.
TEST(Replay, ALineRemembersWhatMovedToANewPlace)
{
  Triangle_soup strip = sheet(10, 2);
  strip.points[5] = Point_3(5, -0.3, 0);
  const auto verdict = [&](const std::string& second_step) {
    return replay_text(strip, "selvedge-log 1\ninput 33 40 -\nlimit border_drift 0.03411\nc 4 5 4.5 0 0\n" +
                                  second_step + "\nresult 2 38 -\n");
  };
  EXPECT_TRUE(verdict("c 3 5 3.8 0 0").is_accepted());
  const Replay_verdict refused = verdict("c 3 5 3.8 0.15 0");
  ASSERT_EQ(refused.violations.size(), 1u);
  EXPECT_EQ(refused.violations[0].kind, Violation_kind::border_drift) << refused.violations[0].message;
  EXPECT_EQ(refused.violations[0].step, 2u);
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

TEST(Replay, AcceptsSnapsOfRealGarments)
{
  const std::filesystem::path folder = std::filesystem::path(SELVEDGE_SHARED_DATA) / "garments";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no real meshes in " << folder;
  for (const auto& [file, distance] : {std::pair{"multilayer_skirt.obj", 0.0001},
                                       {"multilayer_skirt.obj", 0.003},
                                       {"dress_14_pieces_uv.obj", 0.0006}}) {
    SCOPED_TRACE(file + std::string(" at ") + std::to_string(distance));
    const Triangle_soup soup = read_mesh(folder / file).soup;
    Prepare_options snapping;
    snapping.weld_distance = distance;
    const Logged_reduction reduction = reduce_and_log(soup, to_ratio(0.3), snapping);
    const Replay_verdict verdict = replay_text(soup, reduction.log);
    EXPECT_TRUE(verdict.is_accepted())
        << verdict.violations.front().step << ": " << verdict.violations.front().message;
    EXPECT_GT(verdict.snaps, 300u);
    EXPECT_EQ(verdict.limits.weld_distance, distance);
    EXPECT_LE(verdict.largest_snap, distance);
    EXPECT_GE(verdict.largest_way_of_snaps, verdict.largest_snap);
    EXPECT_TRUE(are_same_bits(verdict.soup, reduction.simplified.soup));
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

// The border is straight, and in thirds: a vertex on it lies beside the segment by what rounding adds.
TEST(Replay, AllowsForRoundingWhereNoDriftIsAllowed)
{
  const double third = 2 / 3.0;
  const Triangle_soup strip = soup(
      {{0, 0, 0}, {third - 0x1p-53, 0, 0}, {2 * third + 0x1p-52, 0, 0}, {0, 1, 0}, {third - 0x1p-53, 1, 0}},
      {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}});
  EXPECT_TRUE(
      replay_text(strip, head_of(strip, "limit border_drift 0\n") + "c 1 0\nresult 1 2 -\n").is_accepted());
}

TEST(Replay, LetsBordersTurnByMoreAtLowCorners)
{
  const Triangle_soup strip = strip_with_low_corner();
  const double diagonal = internal::diagonal(strip.points);
  const auto replayed = [&](const Triangle_soup& original, double height, const std::string& collapses) {
    std::ostringstream limits;
    limits << std::setprecision(17) << "limit border_turn 30\nlimit corner_height " << height / diagonal
           << '\n';
    return replay_text(original, head_of(original, limits.str()) + collapses);
  };
  const std::string corner = "c 2 3\nresult 1 5 -\n", both = "c 1 0\nc 2 3\nresult 2 4 -\n";
  EXPECT_TRUE(replayed(strip, 0.7, corner).is_accepted());
  EXPECT_TRUE(replayed(strip, 0.75, both).is_accepted());
  const Replay_verdict high = replayed(strip, 0.6, corner), passed = replayed(strip, 0.6, both);
  ASSERT_EQ(high.violations.size(), 1u);
  EXPECT_EQ(high.violations[0].kind, Violation_kind::border_turn);
  EXPECT_NE(high.violations[0].message.find("by more than 30°, at a corner higher than 0.0"),
            std::string::npos)
      << high.violations[0].message;
  ASSERT_EQ(passed.violations.size(), 1u);
  EXPECT_EQ(passed.violations[0].kind, Violation_kind::border_turn);
  EXPECT_EQ(passed.violations[0].removed, 2u) << "vertex 1 was farther off";
  EXPECT_EQ(kind_of_first(strip, head_of(strip, "limit border_turn 30\n") + corner),
            Violation_kind::border_turn)
      << "a log without the limit is judged as ever";
  Triangle_soup sharp = strip;
  sharp.points[3] = Point_3(10.6, 0.8, 0); // 53° from the level
  EXPECT_TRUE(replayed(sharp, 10, both).is_accepted()) << "however sharp a low corner is";
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
  // The bump is √5 above the farthest edges around it, which is 0.373 of the diagonal.
  EXPECT_EQ(
      kind_of_first(bump, head_of(bump, "limit normal_change 45\nlimit corner_height 0.37\n") + flatten),
      Violation_kind::normal_change);
  EXPECT_TRUE(
      replay_text(bump, head_of(bump, "limit normal_change 45\nlimit corner_height 0.375\n") + flatten)
          .is_accepted());
  EXPECT_EQ(kind_of_first(bump, head_of(bump, "limit aspect_ratio 0.9\n") + flatten),
            Violation_kind::aspect_ratio);

  // Inside a strip between two lines, faces may be thin; at its end, where two of their edges are lines, not.
  const Triangle_soup between_lines = sheet(4, 1);
  const std::string limit = head_of(between_lines, "limit aspect_ratio 0.8\n");
  EXPECT_TRUE(replay_text(between_lines, limit + "c 1 2\nc 2 3\nresult 2 6 -\n").is_accepted());
  EXPECT_EQ(kind_of_first(between_lines, limit + "c 3 2\nresult 1 7 -\n"), Violation_kind::aspect_ratio);
}

Triangle_soup shifted(const Triangle_soup& soup, double x, double y, double z = 0)
{
  return mapped(soup, [=](const Point_3& p) { return Point_3(p.x() + x, p.y() + y, p.z() + z); });
}

/// Sheets of squares of side 1 with a gap of 0.005 between vertices 3, 7, 11, 15 of the one and 16, 20, 24,
/// 28 of the other.
Triangle_soup two_sheets()
{
  return joined(sheet(3, 3), shifted(sheet(3, 3), 3.005, 0));
}

std::string with_snaps(const Triangle_soup& soup, const std::string& distance, const std::string& snaps)
{
  return head_of(soup, distance.empty() ? "" : "limit weld_distance " + distance + '\n') + snaps +
         "result 0 " + std::to_string(soup.triangles.size()) + " -\n";
}

TEST(Replay, RefusesASnapThatIsTooLongOrHasNoLimit)
{
  const Triangle_soup soup = two_sheets();
  EXPECT_TRUE(replay_text(soup, with_snaps(soup, "0.01", "s 7 20\n")).is_accepted());
  EXPECT_EQ(kind_of_first(soup, with_snaps(soup, "0.004", "s 7 20\n")), Violation_kind::weld_distance);
  EXPECT_EQ(kind_of_first(soup, with_snaps(soup, "", "s 7 20\n")), Violation_kind::weld_distance);

  // Nor does any way of setting limits aside do without.
  Replay_options free;
  free.are_limits_judged = false;
  EXPECT_FALSE(replay_text(soup, with_snaps(soup, "", "s 7 20\n"), free).is_accepted());
  EXPECT_FALSE(replay_text(soup, with_snaps(soup, "0.004", "s 7 20\n"), free).is_accepted());
  EXPECT_TRUE(replay_text(soup, with_snaps(soup, "0.01", "s 7 20\n"), free).is_accepted());
  Replay_options imposed;
  imposed.limits = limits_of_seed();
  EXPECT_FALSE(replay_text(soup, with_snaps(soup, "0.01", "s 7 20\n"), imposed).is_accepted());
  imposed.limits->weld_distance = 0.01;
  EXPECT_TRUE(replay_text(soup, with_snaps(soup, "", "s 7 20\n"), imposed).is_accepted());
}

TEST(Replay, RefusesASnapThatIsNotFromABorderToAPartner)
{
  const Triangle_soup soup = two_sheets();
  const auto kind = [](const Triangle_soup& mesh, const std::string& distance, const std::string& snaps) {
    return kind_of_first(mesh, with_snaps(mesh, distance, snaps));
  };
  EXPECT_EQ(kind(soup, "2", "s 6 20\n"), Violation_kind::partner) << "6 is inside";
  EXPECT_EQ(kind(soup, "2", "s 7 21\n"), Violation_kind::partner) << "21 is inside";
  EXPECT_EQ(kind(soup, "3", "s 3 15\n"), Violation_kind::partner)
      << "the border leads from the one to the other";
  EXPECT_EQ(kind(soup, "2", "s 7 11\n"), Violation_kind::no_edge) << "an edge joins them";
  EXPECT_EQ(kind(soup, "0.01", "s 7 20\ns 20 7\n"), Violation_kind::no_edge) << "they are one already";

  const Triangle_soup corners = joined(sheet(3, 3), shifted(sheet(3, 3), 3.005, 3.005));
  EXPECT_EQ(kind(corners, "0.01", "s 15 16\n"), Violation_kind::partner) << "there is no edge to sew";
  Triangle_soup turned = soup;
  for (std::size_t t = turned.triangles.size() / 2; t < turned.triangles.size(); ++t)
    std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  EXPECT_EQ(kind(turned, "0.01", "s 7 20\n"), Violation_kind::partner) << "both borders run the same way";
}

TEST(Replay, RefusesASnapThatMakesAnEdgeOfThreeTriangles)
{
  const Triangle_soup soup = joined(two_sheets(), shifted(sheet(3, 3), 3.005, 0, -0.005));
  const std::string snaps = "s 20 7\ns 36 7\ns 24 11\n";
  EXPECT_TRUE(replay_text(soup, with_snaps(soup, "0.01", snaps)).is_accepted());
  const Replay_verdict verdict = replay_text(soup, with_snaps(soup, "0.01", snaps + "s 40 11\n"));
  ASSERT_EQ(verdict.violations.size(), 1u);
  EXPECT_EQ(verdict.violations[0].kind, Violation_kind::link);
  EXPECT_EQ(verdict.violations[0].step, 4u);
}

TEST(Replay, RefusesASnapThatMakesAnEdgeOfTrianglesThatFaceOppositeWays)
{
  // Two faces at vertex 1: the borders run from 0 to 1 and from 3 to 1, and 4 is near 1.
  const Triangle_soup soup =
      test::soup({{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0.005}, {0, 0, 0.005}}, {{0, 1, 2}, {4, 3, 1}});
  EXPECT_EQ(kind_of_first(soup, with_snaps(soup, "0.01", "s 0 3\n")), Violation_kind::link);
}

TEST(Replay, RefusesASnapThroughWhatLiesInTheGapOrToWhatOffends)
{
  const Triangle_soup hanging =
      joined(two_sheets(), test::soup({{3.002, 0.5, -1}, {3.002, 1.5, -1}, {3.002, 1, 1}}, {{0, 1, 2}}));
  const Violation_kind kind = kind_of_first(hanging, with_snaps(hanging, "0.01", "s 7 20\n"));
  EXPECT_TRUE(kind == Violation_kind::intersection || kind == Violation_kind::tunnelling) << name(kind);
  EXPECT_TRUE(replay_text(hanging, with_snaps(hanging, "0.01", "s 15 28\n")).is_accepted());

  const Triangle_soup pierced =
      joined(two_sheets(), test::soup({{3.2, 1.1, -1}, {3.3, 1.1, -1}, {3.25, 1.15, 1}}, {{0, 1, 2}}));
  ASSERT_FALSE(is_embedded(pierced));
  EXPECT_EQ(kind_of_first(pierced, with_snaps(pierced, "0.01", "s 20 7\n")), Violation_kind::locked);
  EXPECT_EQ(kind_of_first(pierced, with_snaps(pierced, "0.01", "s 7 20\n")), Violation_kind::locked);
  EXPECT_TRUE(replay_text(pierced, with_snaps(pierced, "0.01", "s 15 28\n")).is_accepted());
}

TEST(Replay, JudgesByLimitsOfTheJudgeInPlaceOfTheLogs)
{
  const Triangle_soup soup = mapped(sheet(12, 12), [](const Point_3& p) { // with spikes
    return Point_3(p.x(), p.y(), int(p.x()) % 3 == 1 && int(p.y()) % 3 == 1 ? 6 : 0);
  });
  Simplify_options options = to_ratio(0.1);
  options.max_normal_change = 120;
  const std::string log = reduce_and_log(soup, options).log;
  const Replay_verdict own = replay_text(soup, log);
  EXPECT_TRUE(own.is_accepted());
  EXPECT_EQ(own.limits_source, Limits_source::log);
  EXPECT_EQ(own.limits.normal_change, 120);
  EXPECT_EQ(own.limits.border_drift, options.max_border_drift);

  Replay_options imposed;
  imposed.limits = limits_of(Simplify_options());
  const Replay_verdict verdict = replay_text(soup, log, imposed);
  ASSERT_FALSE(verdict.is_accepted());
  EXPECT_EQ(verdict.violations[0].kind, Violation_kind::normal_change);
  EXPECT_NE(verdict.violations[0].message.find("more than 75°"), std::string::npos)
      << verdict.violations[0].message;
  EXPECT_EQ(verdict.limits_source, Limits_source::judge);
  EXPECT_EQ(verdict.limits.normal_change, 75);
  EXPECT_EQ(verdict.header.limits.normal_change, 120);

  // Nor is anything judged that the log alone declares.
  imposed.limits = Reduction_limits();
  imposed.limits->normal_change = 120;
  EXPECT_TRUE(replay_text(soup, log, imposed).is_accepted());
  const std::string strict = std::string(log).replace(log.find("normal_change 120"), 17, "normal_change 1");
  EXPECT_FALSE(replay_text(soup, strict).is_accepted());
  EXPECT_TRUE(replay_text(soup, strict, imposed).is_accepted());
}

std::vector<std::string> keys_not_judged(const Replay_verdict& verdict)
{
  std::vector<std::string> keys;
  for (const Not_judged& part : not_judged(verdict))
    keys.push_back(part.key);
  return keys;
}

TEST(Replay, SaysWhatItHasNotJudged)
{
  const std::string digest(64, 'a');
  const Triangle_soup soup = skirt(1500);
  std::string log = reduce_and_log(soup, to_ratio(0.5)).log;
  Replay_options options;
  options.sha256_of_original = digest;
  EXPECT_EQ(keys_not_judged(replay_text(soup, log, options)),
            (std::vector<std::string>{"input", "attributes"}))
      << "the log names no file";
  log.replace(log.find(" -\n"), 3, ' ' + digest + '\n');
  const Replay_verdict whole = replay_text(soup, log, options);
  EXPECT_TRUE(whole.is_input_stated && whole.is_result_stated);
  EXPECT_EQ(keys_not_judged(whole), std::vector<std::string>{"attributes"});
  EXPECT_FALSE(replay_text(soup, log).is_input_stated) << "the judge knows no file";
  options.sha256_of_original = std::string(64, 'b');
  EXPECT_THROW(replay_text(soup, log, options), Input_error);

  // A log that says the least that a log can.
  std::string stripped = head_of(soup);
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    stripped += line[0] == 'c' ? line + '\n' : "";
  stripped += log.substr(log.find("result"));
  stripped.replace(stripped.size() - 65, 64, "-");
  const Replay_verdict bare = replay_text(soup, stripped);
  EXPECT_TRUE(bare.is_accepted());
  EXPECT_EQ(keys_not_judged(bare),
            (std::vector<std::string>{"normal_change", "aspect_ratio", "border_turn", "seam_turn",
                                      "border_drift", "lines", "input", "result", "attributes"}));
}

TEST(Replay, SaysThatNoDigestCoversPlaces)
{
  const Triangle_soup flat = sheet(4, 4);
  const auto has_places = [&](const std::string& place) {
    const Replay_verdict verdict = replay_text(flat, head_of(flat) + "c 12 13" + place + "\nresult 1 30 -\n");
    EXPECT_TRUE(verdict.is_accepted());
    const std::vector<std::string> keys = keys_not_judged(verdict);
    return std::find(keys.begin(), keys.end(), "places") != keys.end();
  };
  EXPECT_TRUE(has_places(" 2.5 2 0"));
  EXPECT_FALSE(has_places(""));
}

TEST(Replay, SaysThatAnObstacleOrLimitsOfSnapsWereNotJudged)
{
  const Triangle_soup soup = two_sheets(), below = shifted(sheet(6, 3), 0, 0, -1);
  Prepare_options snapping;
  snapping.weld_distance = 0.01;
  const Replay_verdict verdict =
      replay_text(soup, reduce_and_log(soup, to_ratio(0.5), snapping, false, below).log);
  EXPECT_TRUE(verdict.is_accepted());
  ASSERT_TRUE(verdict.header.obstacle);
  EXPECT_EQ(verdict.header.obstacle->triangles, below.triangles.size());
  EXPECT_EQ(keys_not_judged(verdict),
            (std::vector<std::string>{"limits_of_snaps", "obstacle", "input", "attributes"}));
}

// A tent, whose top, vertex 12 at (2, 2, 1), goes down to its neighbour on the ground.
Triangle_soup tent()
{
  Triangle_soup tent = sheet(4, 4);
  tent.points[12] = Point_3(2, 2, 1);
  return tent;
}

Replay_verdict verdict_beside(const Triangle_soup& obstacle, const std::string& limits = {})
{
  Replay_options options;
  options.obstacle = obstacle;
  return replay_text(tent(), head_of(tent(), limits) + "c 12 13\nresult 1 30 -\n", options);
}

TEST(Replay, RefusesAStepThatMeetsAnObstacle)
{
  const Triangle_soup under = soup({{1.9, 1.9, 0.2}, {2.1, 1.9, 0.2}, {2, 2.1, 0.2}}, {{0, 1, 2}}),
                      through =
                          soup({{9, 9, 9}, {9, 9, 8}, {9, 8, 9}, {2, 2, 0.2}, {1.9, 2, -1}, {2.1, 2, -1}},
                               {{0, 1, 2}, {3, 4, 5}}),
                      at_top = soup({{2, 2, 1}, {2, 3, 3}, {3, 2, 3}}, {{0, 1, 2}}),
                      below = soup({{1.9, 1.9, -0.2}, {2.1, 1.9, -0.2}, {2, 2.1, -0.2}}, {{0, 1, 2}});
  EXPECT_TRUE(replay_text(tent(), head_of(tent()) + "c 12 13\nresult 1 30 -\n").is_accepted())
      << "the control, without an obstacle";
  EXPECT_TRUE(verdict_beside(below).is_accepted());
  EXPECT_TRUE(verdict_beside(below).is_obstacle_judged);

  const auto kind_beside = [](const Triangle_soup& obstacle, const std::string& limits = {}) {
    const Replay_verdict verdict = verdict_beside(obstacle, limits);
    return verdict.is_accepted() ? Violation_kind::result : verdict.violations.front().kind;
  };
  EXPECT_EQ(kind_beside(under), Violation_kind::tunnelling);
  EXPECT_EQ(kind_beside(through), Violation_kind::intersection);
  EXPECT_EQ(kind_beside(at_top), Violation_kind::locked);
  EXPECT_EQ(kind_beside(below, "limit clearance 0.3\n"), Violation_kind::clearance);
  EXPECT_EQ(kind_beside(below, "limit clearance 0.1\n"), Violation_kind::result);

  const Replay_verdict refused = verdict_beside(through);
  ASSERT_EQ(refused.violations.size(), 1u);
  const Violation& violation = refused.violations.front();
  EXPECT_EQ(violation.triangles.back(), 33u) << "after the 32 of the mesh";
  EXPECT_NE(violation.message.find(" and 2 of the obstacle intersect"), std::string::npos)
      << violation.message;
}

TEST(Replay, JudgesPairsThatDescendFromThoseWithAnObstacle)
{
  const Triangle_soup cloth = sheet(12, 12),
                      obstacle = soup({{5, 5, -1}, {8, 5, -1}, {6, 7, 1}}, {{0, 1, 2}});
  std::string log = reduce_and_log(cloth, without_limits(to_ratio(0.2)), {}, false, obstacle).log;
  Replay_options options;
  options.obstacle = obstacle;
  const Replay_verdict verdict = replay_text(cloth, log, options);
  EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
  EXPECT_GT(verdict.collapses, 50u);
  EXPECT_GT(verdict.offending_pairs, 1u);
  log.erase(log.find("defects descend\n"), 16);
  EXPECT_FALSE(replay_text(cloth, log, options).is_accepted()) << "the control";
}

TEST(Replay, RefusesAnotherObstacleThanThatOfTheLog)
{
  const Triangle_soup obstacle = shifted(sheet(6, 3), 0, 0, -1);
  Replay_options options;
  options.obstacle = obstacle;
  options.sha256_of_obstacle = std::string(64, 'a');
  const auto replay_with = [&](const std::string& line) {
    return replay_text(tent(), head_of(tent(), line) + "c 12 13\nresult 1 30 -\n", options);
  };
  const std::string counts = "obstacle 28 36 ";
  EXPECT_TRUE(replay_with(counts + std::string(64, 'a') + "\n").is_obstacle_stated);
  EXPECT_FALSE(replay_with(counts + "-\n").is_obstacle_stated);
  EXPECT_TRUE(replay_with({}).is_obstacle_judged) << "the log need not name it";
  EXPECT_THROW(replay_with(counts + std::string(64, 'b') + "\n"), Input_error);
  EXPECT_THROW(replay_with("obstacle 28 35 -\n"), Input_error);
  EXPECT_THROW(replay_with("obstacle 27 36 -\n"), Input_error);
  options.obstacle->poses.push_back({"other", obstacle.points});
  EXPECT_THROW(replay_with({}), Argument_error) << "the mesh has no pose";
}

TEST(Replay, RefusesWhatIsNoEdgeAFaceThatDegeneratesAndAWrongCount)
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

TEST(Replay, RefusesATouchOfTwoVertices)
{
  // The border of a sheet goes where the tip of another face in its plane is.
  const Triangle_soup flat = joined(sheet(4, 4), soup({{5, 0.5, 0}, {6, 0, 0}, {6, 1, 0}}, {{0, 1, 2}}));
  const auto kind = [&](const std::string& place) {
    return kind_of_first(flat, head_of(flat) + "c 9 4 " + place + "\nresult 1 32 -\n");
  };
  EXPECT_EQ(kind("5 0.5 0"), Violation_kind::intersection);
  EXPECT_TRUE(replay_text(flat, head_of(flat) + "c 9 4 4.9 0.5 0\nresult 1 32 -\n").is_accepted());
}

TEST(Replay, KnowsTheEdgesOfAVertexThatHasMany)
{
  const Triangle_soup soup = cone(200);
  expect_accepted(soup, to_ratio(0.3));
  // A vertex of the border goes to the apex, and leaves a notch. From then on, the apex is on the border.
  for (const Index removed : {1, 2, 63, 64, 65, 66, 100, 199, 200}) {
    const std::string step = "c " + std::to_string(removed) + " 0\n";
    EXPECT_TRUE(replay_text(soup, head_of(soup) + step + "result 1 198 -\n").is_accepted()) << removed;
    EXPECT_EQ(kind_of_first(soup, head_of(soup) + step + "c 150 0\nresult 2 196 -\n"), Violation_kind::link);
  }
}

TEST(Replay, RefusesWhatTheLinkConditionForbids)
{
  // A tube of three sides: around it no triangle joins the three vertices of a ring.
  std::vector<Point_3> points;
  std::vector<Index_triple> triangles;
  for (Index ring = 0; ring < 4; ++ring) {
    points.insert(points.end(), {{0, 0, double(ring)}, {1, 0, double(ring)}, {0, 1, double(ring)}});
    for (Index k = 0; k < 3 && ring > 0; ++k) {
      const Index a = 3 * ring - 3 + k, b = 3 * ring - 3 + (k + 1) % 3;
      triangles.insert(triangles.end(), {{a, b, b + 3}, {a, b + 3, a + 3}});
    }
  }
  const Triangle_soup tube = soup(points, triangles);
  EXPECT_EQ(kind_of_first(tube, head_of(tube) + "c 3 4\nresult 1 16 -\n"), Violation_kind::link);
  // Of a single face nothing would be left.
  const Triangle_soup two = joined(one_triangle(), moved(one_triangle(), 9, 0, 0));
  EXPECT_EQ(kind_of_first(two, head_of(two) + "c 0 1\nresult 1 1 -\n"), Violation_kind::link);
  // Two sheets that meet in a vertex: it stays.
  EXPECT_EQ(kind_of_first(bowtie(), head_of(bowtie()) + "c 0 1\nresult 1 1 -\n"), Violation_kind::locked);
}

TEST(Replay, RefusesToLeaveALineAndToTurnASeamTooFar)
{
  // Two groups meet in a seam that turns by 45 degrees at its middle vertex, 7.
  Triangle_soup soup = sheet(4, 2);
  soup.points[9] = Point_3(4, 3, 0);
  soup.points[8] = Point_3(3, 2, 0);
  soup.points[13] = Point_3(3, 3, 0);
  soup.points[14] = Point_3(4, 4, 0);
  soup.groups.names = {"below", "above"};
  for (Index t = 0; t < soup.triangles.size(); ++t)
    soup.groups.of_triangle.push_back(t < soup.triangles.size() / 2 ? 0 : 1);
  ASSERT_TRUE(is_embedded(soup));
  const std::string along = "c 7 8\nresult 1 14 -\n", off = "c 7 2\nresult 1 14 -\n";
  EXPECT_EQ(kind_of_first(soup, head_of(soup, "limit seam_turn 44\n") + along), Violation_kind::seam_turn);
  EXPECT_EQ(kind_of_first(soup, head_of(soup, "limit seam_turn 44\nlimit corner_height 1\n") + along),
            Violation_kind::seam_turn)
      << "corners of seams are never low";
  EXPECT_TRUE(replay_text(soup, head_of(soup, "limit seam_turn 46\n") + along).is_accepted());
  EXPECT_EQ(kind_of_first(soup, head_of(soup, "limit seam_turn 180\n") + off), Violation_kind::line);
  EXPECT_TRUE(replay_text(soup, head_of(soup) + off).is_accepted()) << "without a limit there is no line";
  // Where a seam ends on the border, the vertex stays.
  EXPECT_EQ(kind_of_first(soup, head_of(soup, "limit seam_turn 180\n") + "c 5 10\nresult 1 15 -\n"),
            Violation_kind::line);
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

TEST(Log, ALineOfTheHeaderThatStandsTwiceOrTooLateIsRefused)
{
  const Triangle_soup flat = sheet(4, 4);
  const auto message = [&](const std::string& lines) -> std::string {
    try {
      replay_text(flat, head_of(flat) + lines + "result 1 30 -\n");
    } catch (const Input_error& error) {
      return error.what();
    }
    return "";
  };
  for (const char* line :
       {"rounding none\n", "normals kept\n", "defects freeze\n", "obstacle 3 1 -\n", "drop_smaller 0.1\n"}) {
    const std::string quoted = "the line '" + std::string(line, std::strchr(line, ' ')) + "' ";
    EXPECT_NE(message(std::string(line) + line).find(quoted + "stands here for the second time"),
              std::string::npos)
        << message(std::string(line) + line);
    EXPECT_NE(message("c 12 13\n" + std::string(line)).find(quoted + "comes too late"), std::string::npos)
        << message("c 12 13\n" + std::string(line));
  }
  for (const char* line : {"limit seam_turn 3\n", "pose one -\n", "dropped uv\n", "drop_part a\n",
                           "drop_smaller 1\n", "may_intersect a b\n"})
    EXPECT_NE(message("c 12 13\n" + std::string(line)).find("comes too late"), std::string::npos) << line;
}

TEST(Log, WhatIsNoLogIsRefusedWithItsLine)
{
  const Triangle_soup flat = sheet(4, 4);
  const std::string head = head_of(flat);
  for (const std::string& text : {std::string(),
                                  std::string("solid\n"),
                                  std::string("selvedge-log 2\n"),
                                  head,
                                  head + "c 1\n",
                                  head + "c 1 99\nresult 0 0 -\n",
                                  head + "c 1 -1\n",
                                  head + "c 1 2 3\n",
                                  head + "c 12 13 1 2 nan\n",
                                  head + "drop_smaller 0\n",
                                  head + "drop_smaller big\n",
                                  head + "drop_part zip\nresult 0 32 -\n",
                                  head + "drop_smaller 99\nresult 0 32 -\n",
                                  head + "q\n",
                                  head + "result 0 32 zz\n",
                                  head + "limit speed 3\n",
                                  head + "limit seam_turn 3\nlimit seam_turn 3\n",
                                  head + "c 12 13\ns 1 2\n",
                                  head + "w 1 2\nresult 0 32 -\n",
                                  head + "result 0 32 -\nc 12 13\n",
                                  head + "obstacle 1 2\n",
                                  head + "pose one - - -\nresult 0 32 -\n",
                                  head + "obstacle 3 1 -\nobstacle 3 1 -\nresult 0 32 -\n"}) {
    SCOPED_TRACE(text);
    EXPECT_THROW(replay_text(flat, text), Input_error);
  }
  EXPECT_THROW(replay_text(sheet(4, 5), head + "result 0 40 -\n"), Input_error) << "another mesh";
}

TEST(Log, WritesAndReadsEveryLimitOfTheTable)
{
  Log_header header;
  header.vertices = 3;
  header.triangles = 1;
  header.obstacle = {5, 2, std::string(64, 'c')};
  header.poses = {{"one", std::string(64, 'd'), std::string(64, 'e')}, {"two", {}, {}}};
  double value = 0.125;
  for (const Limit_description& limit : limit_descriptions)
    header.limits.*limit.value = value++;
  std::stringstream log;
  Log_writer(log, header).write(Log_result{0, 1, {}});
  const Log_reader reader(log, "log");
  value = 0.125;
  for (const Limit_description& limit : limit_descriptions)
    EXPECT_EQ(reader.header().limits.*limit.value, value++) << limit.key;
  ASSERT_TRUE(reader.header().obstacle);
  EXPECT_EQ(reader.header().obstacle->vertices, 5u);
  EXPECT_EQ(reader.header().obstacle->sha256, std::string(64, 'c'));
  ASSERT_EQ(reader.header().poses.size(), 2u);
  EXPECT_EQ(reader.header().poses[0].sha256_of_obstacle, std::string(64, 'e'));
  EXPECT_EQ(reader.header().poses[1].sha256_of_obstacle, "");
}

TEST(Log, LimitsAreReadFromAFileOfTheirLines)
{
  const auto limits = [](const std::string& text) {
    std::istringstream stream(text);
    return read_limits(stream, "limits");
  };
  const Reduction_limits read = limits("# of the house\nlimit border_turn 8\n\nlimit weld_distance 0.5\r\n");
  EXPECT_EQ(read.border_turn, 8);
  EXPECT_EQ(read.weld_distance, 0.5);
  EXPECT_FALSE(read.normal_change || read.aspect_ratio || read.seam_turn || read.border_drift);
  for (const char* text : {"", "# none\n", "border_turn 8\n", "limit border_turn\n", "limit speed 3\n",
                           "limit border_turn 8\nlimit border_turn 9\n", "limit border_turn 8\nc 1 2\n"})
    EXPECT_THROW(limits(text), Input_error) << text;
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
