// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G4 where a piece is slit: both sides of the slit are sewn, and reduced as one line with what continues it.

#include "support/reduction.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace selvedge::test {
namespace {

/// Two groups meet in the middle of a sheet. Along that line the vertices of some rows have a number on
/// either side, so that the sheet is one piece, with a slit where these are.
Triangle_soup slit_sheet(Index rows, const std::vector<Index>& open_rows)
{
  constexpr Index width = 6, middle = 3;
  Triangle_soup soup = sheet(width, rows);
  soup.groups.names = {"left", "right"};
  for (Index t = 0; t < soup.triangles.size(); ++t)
    soup.groups.of_triangle.push_back(t / 2 % width >= middle);
  for (const Index row : open_rows) {
    const Index vertex = row * (width + 1) + middle, copy = Index(soup.points.size());
    const Point_3 point = soup.points[vertex];
    soup.points.push_back(point);
    for (Index t = 0; t < soup.triangles.size(); ++t)
      if (soup.groups.of_triangle[t] == 1)
        std::replace(soup.triangles[t].begin(), soup.triangles[t].end(), vertex, copy);
  }
  return soup;
}

void expect_slits_stay(const Triangle_soup& soup, std::size_t slits)
{
  const std::vector<Piece> before = pieces(soup);
  ASSERT_EQ(before.size(), 1u);
  ASSERT_EQ(before[0].boundary_loops, 1 + slits);
  for (const double ratio : {0.0, 0.2, 0.4, 0.6, 0.8})
    for (const Simplify_options& options : {to_ratio(ratio), without_limits(to_ratio(ratio))}) {
      SCOPED_TRACE(ratio);
      const Reduction reduction = reduce(soup, options);
      EXPECT_TRUE(reduction.verification.accepted());
      EXPECT_EQ(pieces(reduction.simplified.soup)[0].boundary_loops, 1 + slits);
      EXPECT_LT(reduction.simplified.soup.triangles.size(),
                std::max(40., 1 + ratio * double(soup.triangles.size())));
    }
}

TEST(Slits, DoNotGrowIntoABorder)
{
  expect_slits_stay(slit_sheet(6, {2, 3, 4}), 1);
  expect_slits_stay(slit_sheet(6, {2}), 1);
  expect_slits_stay(slit_sheet(8, {3, 5}), 1);
}

TEST(Slits, DoNotGrowIntoEachOther)
{
  expect_slits_stay(slit_sheet(9, {2, 5}), 2);
  expect_slits_stay(slit_sheet(12, {2, 3, 6, 9, 10}), 3);
}

TEST(Slits, DoNotClose)
{
  expect_slits_stay(slit_sheet(12, {6}), 1);
}

} // namespace
} // namespace selvedge::test
