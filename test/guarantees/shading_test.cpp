// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A face whose normals point to its front keeps them there: no hem is shaded as its inside.

#include "support/reduction.h"

#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace selvedge;
using selvedge::test::reduce;
using selvedge::test::Reduction;
using selvedge::test::to_ratio;

namespace {

// A hem: cloth that goes down, around a thin rim of three edges, and up again on its inside, with waves along
// it, and the normals of smooth shading.
Triangle_soup hem()
{
  const std::array<std::array<double, 2>, 12> profile{{{1, 0.02}, // outside
                                                       {0.75, 0.02},
                                                       {0.5, 0.02},
                                                       {0.25, 0.02},
                                                       {0, 0.02},
                                                       {-0.01, 0.012}, // the rim
                                                       {-0.01, -0.012},
                                                       {0, -0.02}, // inside
                                                       {0.25, -0.02},
                                                       {0.5, -0.02},
                                                       {0.75, -0.02},
                                                       {1, -0.02}}};
  constexpr Index columns = 40;
  Triangle_soup soup;
  for (Index i = 0; i <= columns; ++i)
    for (const auto& [y, z] : profile)
      soup.points.emplace_back(0.1 * i, y, z + 0.05 * std::sin(0.7 * i) * (1.5 + y));
  const Index rows = Index(profile.size());
  for (Index i = 0; i < columns; ++i)
    for (Index j = 0; j + 1 < rows; ++j) {
      const Index a = rows * i + j, b = a + 1, c = a + rows, d = c + 1;
      soup.triangles.push_back({a, b, d});
      soup.triangles.push_back({a, d, c});
    }
  soup.normals.values = {{0, 0, 1}};
  soup.normals.of_triangle.assign(soup.triangles.size(), {0, 0, 0});
  restore_normals(soup, Normals_treatment::smooth);
  return soup;
}

// Returns how many triangles have a corner where the normal of this number points to their back, or has none
// of its own.
std::size_t count_of_wrong_sides(const Triangle_soup& soup, const Triangle_soup& with_normals,
                                 const std::vector<Index_triple>& corners)
{
  std::size_t count = 0;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    std::array<internal::Vector_of_doubles, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& point = soup.points[soup.triangles[t][k]];
      p[k] = {point.x(), point.y(), point.z()};
    }
    const auto front = internal::cross(internal::difference(p[1], p[0]), internal::difference(p[2], p[0]));
    count += std::any_of(corners[t].begin(), corners[t].end(), [&](Index corner) {
      const Corner_values<3>& normals = with_normals.normals;
      return internal::dot(front, normals.values[normals.of_triangle[corner / 3][corner % 3]]) < 0;
    });
  }
  return count;
}

// Every triangle with its own three corners.
std::vector<Index_triple> own_corners(const Triangle_soup& soup)
{
  std::vector<Index_triple> corners;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  return corners;
}

std::size_t count_of_wrong_sides(const Triangle_soup& soup)
{
  return count_of_wrong_sides(soup, soup, own_corners(soup));
}

} // namespace

TEST(Shading, NoNormalComesToPointToTheBackOfAFace)
{
  const Triangle_soup soup = hem();
  ASSERT_EQ(count_of_wrong_sides(soup), 0u);
  for (const Placement placement : {Placement::vertices, Placement::optimal})
    for (const double ratio : {0.3, 0.1, 0.02})
      for (const std::size_t faces_per_cell : {0, 200}) {
        Simplify_options options = to_ratio(ratio);
        options.placement = placement;
        options.faces_per_cell = faces_per_cell;
        const Reduction reduction = reduce(soup, options);
        EXPECT_TRUE(reduction.verification.accepted());
        EXPECT_LT(reduction.simplified.soup.triangles.size(), soup.triangles.size() / 2);
        EXPECT_EQ(count_of_wrong_sides(reduction.simplified.soup), 0u) << ratio;
      }
}

// The control: with the same collapses as without normals, some would.
TEST(Shading, WouldBeThatOfTheBackOtherwise)
{
  const Triangle_soup soup = hem();
  Prepare_options without_normals;
  without_normals.normals = Normals_choice::drop;
  const Reduction reduction = reduce(soup, to_ratio(0.1), without_normals);
  EXPECT_GT(count_of_wrong_sides(reduction.simplified.soup, soup, reduction.simplified.corners), 5u);
  EXPECT_EQ(reduction.simplified.report.refused.shading, 0u);
}

TEST(Shading, ThatIsInsideOutStaysSo)
{
  Triangle_soup soup = hem();
  for (auto& normal : soup.normals.values)
    for (double& x : normal)
      x = -x;
  const Reduction reduction = reduce(soup, to_ratio(0.1));
  EXPECT_EQ(count_of_wrong_sides(reduction.simplified.soup), reduction.simplified.soup.triangles.size());
  EXPECT_GT(reduction.simplified.report.refused.shading, 0u);
}

TEST(Shading, NamesWhatHoldsBackAndGivesWayToNewNormals)
{
  const Triangle_soup soup = hem();
  const Reduction kept = reduce(soup, to_ratio(0.02));
  EXPECT_GT(kept.simplified.report.hindrances[Hindrance::shading], 0u);
  Prepare_options anew;
  anew.normals = Normals_choice::recompute;
  const Reduction made = reduce(soup, to_ratio(0.02), anew);
  EXPECT_EQ(made.simplified.report.hindrances[Hindrance::shading], 0u);
  EXPECT_LT(made.simplified.soup.triangles.size(), kept.simplified.soup.triangles.size());
}
