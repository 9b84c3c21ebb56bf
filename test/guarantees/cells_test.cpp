// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A reduction in cells: every guarantee holds as without, and threads change nothing.

#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

Simplify_options in_cells(Simplify_options options, std::size_t faces_per_cell)
{
  options.faces_per_cell = faces_per_cell;
  return options;
}

Triangle_soup bare(const Triangle_soup& soup)
{
  Triangle_soup result;
  result.points = soup.points;
  result.triangles = soup.triangles;
  return result;
}

class Cell_scenes : public testing::TestWithParam<const char*>
{
protected:
  static Triangle_soup scene()
  {
    const std::string name = GetParam();
    if (name == "sheets")
      return sheets(6000, 5, 1e-5);
    if (name == "folded")
      return folded_cloth(2000, 6, 1e-6);
    if (name == "spheres")
      return nested_spheres(6000, 4, 1e-4);
    if (name == "sewn")
      return sewn_pieces(1500);
    if (name == "flat") // whole rows of vertices lie in the walls of cells
      return sheet(28, 28);
    return skirt(8000, 3);
  }
};

INSTANTIATE_TEST_SUITE_P(Cells, Cell_scenes,
                         testing::Values("sheets", "folded", "spheres", "sewn", "flat", "skirt"));

TEST_P(Cell_scenes, AreEmbeddedAndLegalOnTheWay)
{
  for (const Collapse_loop loop : {Collapse_loop::own, Collapse_loop::cgal}) {
    if (loop == Collapse_loop::cgal && GetParam() != std::string("spheres"))
      continue;
    Simplify_options options = in_cells(to_ratio(0.3), scene().triangles.size() / 5);
    options.loop = loop;
    const Logged_reduction reduction = reduce_and_log(scene(), options);
    const Simplify_report& report = reduction.simplified.report;
    EXPECT_GE(report.cells, 4u);
    EXPECT_GT(report.collapses_in_cells, report.collapses / 6) << "of " << report.collapses;
    EXPECT_LT(report.collapses_in_cells, report.collapses);
    EXPECT_LT(report.refused.by_loop, report.collapses);
    EXPECT_EQ(report.is_reached(), reduce(scene(), to_ratio(0.3)).simplified.report.is_reached());

    const Verification verification = verify(reduction.simplified.soup, reduction.original);
    EXPECT_TRUE(verification.embedded()) << verification.pairs.size() << " pairs";
    EXPECT_TRUE(verification.same_topology());

    const Replay_verdict verdict = replay_text(reduction.original, reduction.log);
    EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.size() << ": " << verdict.violations[0].message;
    EXPECT_TRUE(verdict.is_result_stated);
    EXPECT_EQ(verdict.collapses, report.collapses);
    EXPECT_EQ(verdict.soup.triangles, reduction.simplified.soup.triangles);
    EXPECT_EQ(verdict.soup.points, reduction.simplified.soup.points);
  }
}

TEST_P(Cell_scenes, DoNotDependOnThreads)
{
  std::set<std::string> logs;
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    logs.insert(reduce_and_log(scene(), in_cells(to_ratio(0.2), scene().triangles.size() / 9)).log);
  }
  EXPECT_EQ(logs.size(), 1u);
}

#ifdef NDEBUG // with CGAL's expensive checks it takes longer than ten minutes
// As good as without: the cost at which cells stop is one for all, and all that they have gathered goes on.
TEST(Cells, AreAsTrueToTheOriginalAsTheWhole)
{
  const Triangle_soup original = skirt(40000, 2);
  const auto deviation = [&](const Simplify_options& options) {
    const Reduction reduction = reduce(original, options);
    EXPECT_TRUE(reduction.simplified.report.is_reached());
    return reduction.verification.distances->original_to_result.root_mean_square;
  };
  EXPECT_LT(deviation(in_cells(to_ratio(0.3), 20000)), 1.03 * deviation(to_ratio(0.3)));
}
#endif

// A rough sheet beside a flat one of more vertices, each in a cell: the flat one alone reaches the target.
TEST(Cells, AllStopAtTheCostThatHalfOfThemHaveReached)
{
  const Triangle_soup flat = sheet(26, 24);
  const Triangle_soup rough = mapped(sheet(24, 24), [](const Point_3& p) {
    return Point_3(p.x() + 30, p.y(), std::sin(5 * p.x() + 7 * p.y()));
  });
  const Triangle_soup both = joined(flat, rough);
  const Reduction reduction = reduce(both, in_cells(to_ratio(0.6), both.triangles.size() - 100));
  EXPECT_EQ(reduction.simplified.report.cells, 2u);
  EXPECT_GT(reduction.simplified.report.collapses_in_cells, 100u);
  const auto is_rough = [&](Index t) { return t >= flat.triangles.size(); };
  const auto& left = reduction.simplified.triangles;
  EXPECT_EQ(std::size_t(std::count_if(left.begin(), left.end(), is_rough)), rough.triangles.size());
}

// A flat sheet beside two rough ones, each in a cell: the flat one does more than its share, so that the
// rough ones, of which one alone would go to theirs, keep nearly all.
TEST(Cells, DoMoreWhereCollapsesCostLess)
{
  const Triangle_soup flat = sheet(40, 40);
  const auto rough = [&](double from) {
    return mapped(flat, [=](const Point_3& p) {
      return Point_3(p.x() + from, p.y(), std::sin(5 * p.x() + 7 * p.y()));
    });
  };
  const Triangle_soup all = joined(joined(flat, rough(50)), rough(100));
  const Reduction reduction = reduce(all, in_cells(to_ratio(0.7), flat.triangles.size() + 100));
  EXPECT_EQ(reduction.simplified.report.cells, 4u);
  EXPECT_GT(reduction.simplified.report.collapses_in_cells, 1000u); // of 1,440
  const auto& left = reduction.simplified.triangles;
  const auto is_rough = [&](Index t) { return t >= flat.triangles.size(); };
  EXPECT_GT(double(std::count_if(left.begin(), left.end(), is_rough)),
            0.9 * 2 * double(flat.triangles.size()));
}

// So that the result is even, one cell is not done and the other left out.
TEST(Cells, AreAllDoneToTheWholeWhoeverWantsToStopMeanwhile)
{
  const Prepared_soup prepared = prepare(sheet(100, 100));
  Simplify_options options = in_cells(to_ratio(0.1), 4000);
  const std::size_t found = simplify_soup(prepared, options).report.collapses_in_cells;
  std::size_t done = 0, wishes = 0;
  options.on_collapse = [&](const Soup_collapse&) { ++done; };
  options.should_stop = [&](const Simplify_progress&) {
    wishes += done > 0;
    return done > 0;
  };
  const Simplify_report report = simplify_soup(prepared, options).report;
  EXPECT_TRUE(report.is_stopped);
  EXPECT_EQ(wishes, 1u);
  EXPECT_EQ(report.collapses_in_cells, found);
  EXPECT_EQ(report.collapses, found);
}

// Partners may lie in two cells, and no cell knows the limits there.
TEST(Cells, LeaveGapsToTheWhole)
{
  constexpr double gap = 1 / 64.;
  const auto curved = [](double from, double stretch) {
    return [=](const Point_3& p) {
      const double y = stretch * p.y();
      return Point_3(from + p.x(), y, 0.02 * y * y);
    };
  };
  for (const Index rows : {40, 27}) { // as many vertices on both sides of the gap, or fewer on one
    const Triangle_soup soup =
        joined(mapped(sheet(13, 40), curved(0, 1)), mapped(sheet(27, rows), curved(13 + gap, 40. / rows)));
    Prepare_options of_soup;
    if (rows == 40)
      of_soup.open_seams = Open_seams::hold;
    else
      of_soup.weld_distance = 1.5 * gap;
    const Prepared_soup prepared = prepare(soup, of_soup);
    std::set<Index> at_gap(prepared.facing.begin(), prepared.facing.end()); // positions
    for (const auto& [a, b] : prepared.tied)
      at_gap.insert({a, b});
    EXPECT_EQ(prepared.tied.size(), rows == 40 ? 41u : 0u);
    EXPECT_GT(at_gap.size(), 60u);

    std::vector<bool> are_at_gap; // the vertices that go
    Simplify_options options = in_cells(to_ratio(0.1), 900);
    options.on_collapse = [&](const Soup_collapse& collapse) {
      are_at_gap.push_back(at_gap.count(prepared.positions[collapse.removed]) > 0);
    };
    const Simplify_report report = simplify_soup(prepared, options).report;
    EXPECT_GT(report.collapses_in_cells, 300u);
    EXPECT_EQ(report.left_alone, 0u);
    const auto end_of_cells = are_at_gap.begin() + std::ptrdiff_t(report.collapses_in_cells);
    EXPECT_EQ(std::count(are_at_gap.begin(), end_of_cells, true), 0);
    EXPECT_GT(std::count(end_of_cells, are_at_gap.end(), true), 0);
  }
}

// The control of the replay: what has no cells but layers, each reduced as if the other were not there, is
// not legal when put together.
TEST(Cells, WouldNotBeLegalIfTheyWereNotConvex)
{
  const Triangle_soup layer = bare(sheets(2000, 1, 1e-5));
  const Triangle_soup both =
      joined(layer, mapped(layer, [](const Point_3& p) { return Point_3(p.x(), p.y(), p.z() + 1e-5); }));
  std::vector<Soup_collapse> collapses;
  Simplify_options options = to_ratio(0.2);
  options.on_collapse = [&](const Soup_collapse& collapse) { collapses.push_back(collapse); };
  ASSERT_TRUE(prepare(both).offending_pairs.empty());
  simplify_soup(prepare(layer), options);

  const Log_numbering numbering(both, false);
  Log_header header;
  header.vertices = numbering.size();
  header.triangles = both.triangles.size();
  std::ostringstream log;
  Log_writer writer(log, header);
  for (const Soup_collapse& collapse : collapses) {
    Log_step step;
    step.removed = Index(collapse.removed);
    step.kept = Index(collapse.kept);
    writer.write(step);
  }
  Log_result result;
  result.collapses = collapses.size();
  result.triangles = both.triangles.size() - 2 * collapses.size();
  writer.write(result);
  const Replay_verdict verdict = replay_text(both, log.str());
  ASSERT_FALSE(verdict.violations.empty());
  EXPECT_TRUE(verdict.violations[0].kind == Violation_kind::intersection ||
              verdict.violations[0].kind == Violation_kind::tunnelling)
      << name(verdict.violations[0].kind);
}

// Two groups, left and right, with a texture, and weights for every vertex.
Triangle_soup painted_sheet()
{
  Triangle_soup soup = mapped(sheet(60, 60), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(0.3 * p.x()) * std::cos(0.4 * p.y()));
  });
  soup.groups.names = {"left", "right"};
  for (const auto& [a, b, c] : soup.triangles) {
    soup.groups.of_triangle.push_back(soup.points[a].x() + soup.points[b].x() + soup.points[c].x() > 90);
    soup.uvs.of_triangle.push_back({a, b, c});
  }
  Attribute weight;
  weight.name = "weight";
  weight.type = Attribute::Type::uint8;
  for (const Point_3& p : soup.points) {
    soup.uvs.values.push_back({p.x() / 60, p.y() / 60});
    weight.rows.push_back(p.y() > 30 ? 250 : 25);
  }
  soup.vertex_attributes.push_back(weight);
  return soup;
}

TEST(Cells, RespectLocksKeptPartsWeightsTextureAndObstacle)
{
  const Triangle_soup soup = painted_sheet();
  const Triangle_soup obstacle =
      mapped(soup, [](const Point_3& p) { return Point_3(p.x() + 0.01, p.y() + 0.02, p.z() - 0.05); });
  const Prepared_soup prepared = prepare(soup, {}, obstacle);
  ASSERT_TRUE(prepared.offending_pairs.empty());
  const auto faces_right = [](const Triangle_soup& of) {
    std::size_t count = 0;
    for (const Index group : of.groups.of_triangle)
      count += group == 1;
    return count;
  };
  for (const bool is_kept : {false, true}) {
    SCOPED_TRACE(is_kept);
    Simplify_intent intent;
    (is_kept ? intent.kept : intent.locked) = {"right"};
    intent.weights = "weight";
    const Simplify_options options = in_cells(to_ratio(0.6), 900);
    const Simplified_soup result = simplify_soup(prepared, options, intent);
    EXPECT_GT(result.report.collapses_in_cells, 100u);
    EXPECT_EQ(faces_right(result.soup), faces_right(soup));
    EXPECT_TRUE(verify(result, prepared).accepted());
    EXPECT_EQ(result.report.is_reached(), simplify_soup(prepared, to_ratio(0.6), intent).report.is_reached());
  }
}

// Left and right of a zigzag of right angles, along which nothing can move, a sheet differs in one thing, of
// which the cells have to know.
TEST(Cells, KeepLinesOfEveryKind)
{
  constexpr Index width = 40;
  const Triangle_soup plain = mapped(sheet(width, width), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(0.3 * p.x()) * std::cos(0.4 * p.y()));
  });
  std::vector<Index> sides; // of triangles
  std::set<Index> zigzag;
  for (Index y = 0; y < width; ++y)
    for (Index x = 0; x < width; ++x) {
      const Index line = width / 2 + y % 2;
      sides.insert(sides.end(), 2, x >= line);
      for (const Index row : {y, y + 1})
        zigzag.insert(row * (width + 1) + line);
    }

  const auto labelled = [&](Triangle_labels Triangle_soup::*labels) {
    Triangle_soup soup = plain;
    soup.*labels = {sides, {"left", "right"}};
    return soup;
  };
  const auto valued = [&](auto values) {
    Triangle_soup soup = plain;
    for (const Index side : sides)
      (soup.*values).of_triangle.push_back({side, side, side});
    (soup.*values).values.resize(2);
    (soup.*values).values[1][0] = 1;
    return soup;
  };
  Triangle_soup cut = joined(plain, plain);
  cut.triangles = plain.triangles;
  for (std::size_t t = 0; t < sides.size(); ++t)
    for (Index& v : cut.triangles[t])
      v += sides[t] * Index(plain.points.size());

  const auto vanished = [&](const Triangle_soup& soup) {
    const Simplified_soup result = reduce(soup, in_cells(to_ratio(0.3), 400)).simplified;
    EXPECT_GT(result.report.collapses_in_cells, 300u);
    const std::set<Point_3> left(result.soup.points.begin(), result.soup.points.end());
    return std::count_if(zigzag.begin(), zigzag.end(),
                         [&](Index v) { return left.count(plain.points[v]) == 0; });
  };
  EXPECT_GT(vanished(plain), 20);
  EXPECT_EQ(vanished(labelled(&Triangle_soup::groups)), 0);
  EXPECT_EQ(vanished(labelled(&Triangle_soup::objects)), 0);
  EXPECT_EQ(vanished(labelled(&Triangle_soup::materials)), 0);
  EXPECT_EQ(vanished(valued(&Triangle_soup::uvs)), 0);
  EXPECT_EQ(vanished(valued(&Triangle_soup::normals)), 0);
  EXPECT_EQ(vanished(cut), 0);
}

TEST(Cells, LeaveOffendingPairsAsTheyAre)
{
  const Triangle_soup lower = bare(sheets(3000, 1, 1e-3));
  const Triangle_soup both = joined(lower, mapped(lower, [](const Point_3& p) {
                                      return Point_3(p.x() + 0.013, p.y() + 0.007, p.z() + 0.002);
                                    }));
  const Reduction reduction = reduce(both, in_cells(to_ratio(0.3), 700), with(Defects::freeze));
  EXPECT_GT(reduction.prepared.frozen_faces, 100u);
  EXPECT_GT(reduction.simplified.report.collapses_in_cells, 20u);
  EXPECT_EQ(reduction.verification.pairs.size(), reduction.prepared.offending_pairs.size());
  EXPECT_TRUE(reduction.verification.new_pairs.empty());
}

TEST(Cells, GoAsFarAsAnErrorAllows)
{
  Simplify_options options = in_cells({}, 1500);
  options.max_error = 1e-3;
  const Reduction reduction = reduce(skirt(8000, 2), options);
  EXPECT_TRUE(reduction.verification.accepted());
  EXPECT_LE(reduction.verification.distances->original_to_result.maximum, 1e-3 * (1 + 1e-9));
  options.faces_per_cell = 0;
  // In a cell too the error is a share of the whole, not of the cell.
  EXPECT_GT(double(reduction.simplified.report.collapses_in_cells),
            0.4 * double(reduction.simplified.report.collapses));
  const std::size_t faces = reduction.simplified.soup.triangles.size();
  const std::size_t faces_without = reduce(skirt(8000, 2), options).simplified.soup.triangles.size();
  EXPECT_LT(faces, 6000u);
  EXPECT_NEAR(double(faces), double(faces_without), 0.05 * double(faces_without));
}

TEST(Cells, GiveEachLevelAsAloneAndNoPartARatioOfItsOwn)
{
  const Prepared_soup prepared = prepare(painted_sheet());
  const Simplify_options options = in_cells({}, 900);
  const std::vector<Simplified_soup> levels = simplify_lods(prepared, options, {0.3, 0.6});
  for (const auto& [level, ratio] : {std::pair(0, 0.3), std::pair(1, 0.6)})
    EXPECT_EQ(levels[level].corners, simplify_soup(prepared, in_cells(to_ratio(ratio), 900)).corners);
  Simplify_intent intent;
  intent.ratios = {{"left", 0.5}};
  EXPECT_THROW(simplify_soup(prepared, in_cells(to_ratio(0.3), 900), intent), Argument_error);
}

TEST(Cells, AskOneAtATimeWhetherToStopAndStop)
{
  const Prepared_soup prepared = prepare(skirt(20000, 2));
  Simplify_options options = in_cells(to_ratio(0.1), 2000);
  std::atomic<int> inside = 0;
  int asked = 0, overlaps = 0;
  options.should_stop = [&](const Simplify_progress& progress) {
    overlaps += ++inside != 1;
    EXPECT_EQ(progress.faces_input, prepared.soup.triangles.size());
    EXPECT_LE(progress.faces, progress.faces_input);
    --inside;
    return ++asked == 40; // once: it is not to be asked again
  };
  const Simplified_soup result = simplify_soup(prepared, options);
  EXPECT_EQ(overlaps, 0);
  EXPECT_EQ(asked, 40);
  EXPECT_TRUE(result.report.is_stopped);
  EXPECT_GT(result.soup.triangles.size(), 4000u);
  EXPECT_LT(result.soup.triangles.size(), prepared.soup.triangles.size());
  EXPECT_TRUE(verify(result, prepared).accepted());
}

TEST(Cells, AskWhetherToStopWhileTheirCollapsesAreDoneToTheWhole)
{
  const Prepared_soup prepared = prepare(sheet(100, 100));
  Simplify_options options = in_cells(to_ratio(0.1), 4000);
  std::size_t since_asked = 0, most = 0, asked = 0;
  options.on_collapse = [&](const Soup_collapse&) { most = std::max(most, ++since_asked); };
  options.should_stop = [&](const Simplify_progress& progress) {
    EXPECT_LE(progress.faces, progress.faces_input - (since_asked > 0));
    since_asked = 0;
    ++asked;
    return false;
  };
  EXPECT_GT(simplify_soup(prepared, options).report.collapses_in_cells, 4096u + 2000);
  EXPECT_LE(most, 4096u);

  // Whenever somebody wishes it, it stops, and asks no more.
  const std::size_t asks = asked;
  std::set<std::size_t> collapses;
  for (std::size_t wish = 1; wish < asks; wish += 1 + asks / 6) {
    options.on_collapse = {};
    asked = 0;
    options.should_stop = [&](const Simplify_progress&) { return ++asked >= wish; };
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const Simplified_soup result = simplify_soup(prepared, options);
    EXPECT_TRUE(result.report.is_stopped);
    EXPECT_EQ(asked, wish);
    EXPECT_TRUE(verify(result, prepared).accepted());
    collapses.insert(result.report.collapses);
  }
  EXPECT_EQ(*collapses.begin(), 0u);
  EXPECT_GT(collapses.size(), 3u);
}

TEST(Cells, ReportThatTheyWereStoppedWhereTheTargetIsReached)
{
  const Prepared_soup prepared = prepare(sheet(20, 20));
  Simplify_options options = in_cells(to_ratio(1), 100);
  bool is_asked = false;
  options.should_stop = [&](const Simplify_progress&) { return is_asked = true; };
  const Simplified_soup result = simplify_soup(prepared, options);
  EXPECT_TRUE(is_asked);
  EXPECT_TRUE(result.report.is_reached());
  EXPECT_TRUE(result.report.is_stopped);
}

TEST(Cells, AreNoneWhereOneWouldHoldAll)
{
  const Prepared_soup prepared = prepare(skirt(3000, 1));
  const Simplified_soup alone = simplify_soup(prepared, to_ratio(0.3));
  const Simplified_soup result = simplify_soup(prepared, in_cells(to_ratio(0.3), 100000));
  EXPECT_EQ(result.report.collapses_in_cells, 0u);
  EXPECT_EQ(result.corners, alone.corners);
}

} // namespace
} // namespace selvedge::test
