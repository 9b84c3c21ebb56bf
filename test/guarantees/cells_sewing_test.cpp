// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Cells where several sheets meet: what is one vertex is decided by the whole, and by no cell.

#include "support/logged_reduction.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <set>
#include <string>

namespace selvedge::test {
namespace {

Simplify_options in_small_cells(double ratio, std::size_t faces_per_cell)
{
  Simplify_options options = to_ratio(ratio);
  options.faces_per_cell = faces_per_cell;
  return options;
}

/// The sheet in two pieces, whose texture and groups meet along a line, and every fin a piece of its own.
Triangle_soup finned_pieces(Index size, unsigned seed)
{
  Triangle_soup soup = finned_sheet(size, seed);
  const Index squares = 2 * size * size, vertices = Index(soup.points.size());
  soup.groups.names = {"left", "right"};
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.x(), p.y()});
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    Index_triple& triangle = soup.triangles[t];
    soup.uvs.of_triangle.push_back(triangle);
    const bool is_right = t < squares && t % (2 * size) >= size + t % 3;
    soup.groups.of_triangle.push_back(is_right);
    if (t < squares && t / (2 * size) < size / 2)
      continue;
    for (Index& v : triangle)
      if (v < vertices && (t >= squares || v / (size + 1) == size / 2)) {
        const Point_3 point = soup.points[v];
        v = Index(soup.points.size());
        soup.points.push_back(point);
      }
  }
  return soup;
}

class Finned_cells : public testing::TestWithParam<bool>
{
};
INSTANTIATE_TEST_SUITE_P(Cells, Finned_cells, testing::Bool());

TEST_P(Finned_cells, AreLegalAndWhatTheirLogSays)
{
  std::size_t in_cells = 0;
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const double ratio : {0.0, 0.4, 0.7}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", ratio " << ratio);
      const Triangle_soup soup = GetParam() ? finned_pieces(24, seed) : finned_sheet(24, seed);
      ASSERT_TRUE(prepare(soup).offending_pairs.empty());
      const Logged_reduction reduction = reduce_and_log(soup, in_small_cells(ratio, 20 + 10 * seed));
      const Verification verification = verify(reduction.simplified.soup, soup);
      ASSERT_TRUE(verification.embedded());
      ASSERT_TRUE(verification.same_topology());
      const Replay_verdict verdict = replay_text(soup, reduction.log);
      ASSERT_TRUE(verdict.is_accepted()) << verdict.violations[0].message;
      ASSERT_EQ(verdict.soup.triangles, reduction.simplified.soup.triangles);
      ASSERT_EQ(verdict.soup.points, reduction.simplified.soup.points);
      in_cells += reduction.simplified.report.collapses_in_cells;
    }
  EXPECT_GT(in_cells, 1000u);
}

TEST_P(Finned_cells, DoNotDependOnThreads)
{
  const Triangle_soup soup = GetParam() ? finned_pieces(40, 1) : finned_sheet(40, 1);
  std::set<std::string> logs;
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    logs.insert(reduce_and_log(soup, in_small_cells(0.3, 150)).log);
  }
  EXPECT_EQ(logs.size(), 1u);
}

} // namespace
} // namespace selvedge::test
