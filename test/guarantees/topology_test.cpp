// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// G4: topology. The pieces, their borders and their holes stay.

#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <gtest/gtest.h>

namespace selvedge::test {
namespace {

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

// A control: the judge of these tests sees a hole that is closed, a piece that is gone, and one that comes
// apart.
TEST(Topology, ThatIsNotKeptIsSeen)
{
  const Prepared_soup original = prepare(joined(sheet(4, 4), tetrahedron()));
  const auto keeps_topology = [&](const auto& changed) {
    Simplified_soup result = simplify_soup(original, to_ratio(1));
    changed(result.soup.triangles);
    changed(result.triangles);
    return verify(result, original).same_topology();
  };
  EXPECT_TRUE(keeps_topology([](auto&) {}));
  EXPECT_FALSE(keeps_topology([](auto& triangles) { triangles.pop_back(); })) << "a hole";
  EXPECT_FALSE(keeps_topology([](auto& triangles) { triangles.resize(triangles.size() - 4); })) << "gone";
  EXPECT_FALSE(keeps_topology([](auto& triangles) {
    triangles.erase(triangles.begin() + 8, triangles.begin() + 16); // a row of the sheet
  })) << "two pieces of one";
}

} // namespace
} // namespace selvedge::test
