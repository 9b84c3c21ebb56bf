// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Lines of normals that nobody sees as edges hold no vertices.

#include "soup/flat_shading.h"
#include "support/soups.h"

#include <selvedge/suited_normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

using namespace selvedge;
using selvedge::test::sheet;

namespace {

constexpr Index s_squares = 12;

// A sheet whose normals turn by an angle from one column of squares to the next but one, and all the way
// along a column by a little, as on a surface that bends.
Triangle_soup creased(double degrees)
{
  const double tangent = std::tan(degrees * std::acos(-1) / 180);
  Triangle_soup soup = sheet(s_squares, s_squares);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    double least = s_squares;
    for (const Index v : soup.triangles[t])
      least = std::min(least, soup.points[v].x());
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& p = soup.points[soup.triangles[t][k]];
      soup.normals.values.push_back({std::size_t(least) % 4 < 2 ? 0 : tangent, 0.01 * p.y(), 1});
    }
    const Index first = Index(3 * t);
    soup.normals.of_triangle.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// Gives every other triangle normals that differ from those around it.
Triangle_soup tangled(double degrees)
{
  const double tangent = std::tan(degrees * std::acos(-1) / 180);
  Triangle_soup soup = creased(0);
  for (std::size_t t = 0; t < soup.triangles.size(); t += 2)
    for (const Index number : soup.normals.of_triangle[t])
      soup.normals.values[number][0] = tangent;
  return soup;
}

// The lines from x = 6 on are hard, and those before are not.
Triangle_soup creased_twice(double degrees = 5)
{
  Triangle_soup soup = creased(degrees);
  const Triangle_soup hard = creased(80);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto is_before = [&](Index v) { return soup.points[v].x() < 6; };
    const Index_triple &corners = soup.triangles[t], &numbers = soup.normals.of_triangle[t];
    if (std::none_of(corners.begin(), corners.end(), is_before))
      for (const Index number : numbers)
        soup.normals.values[number] = hard.normals.values[number];
  }
  return soup;
}

bool are_lines_soft(const Triangle_soup& soup)
{
  return suited_to(soup, Normals_choice::automatic) == Normals_choice::loose;
}

} // namespace

TEST(Soft_lines, AreThoseAcrossWhichNormalsDifferLittle)
{
  EXPECT_TRUE(are_lines_soft(creased(5)));
  EXPECT_TRUE(are_lines_soft(creased(18)));
  EXPECT_FALSE(are_lines_soft(creased(22)));
  EXPECT_FALSE(are_lines_soft(creased(80)));
}

TEST(Soft_lines, AreTanglesUnlessNormalsDifferByMuch)
{
  EXPECT_TRUE(are_lines_soft(tangled(30)));
  EXPECT_FALSE(are_lines_soft(tangled(60)));
}

TEST(Soft_lines, AreOneOrTwoEdges)
{
  Triangle_soup soup = creased(0);
  soup.normals.values[soup.normals.of_triangle[100][0]] = {5, 0, 1};
  EXPECT_TRUE(are_lines_soft(soup));
}

// Such triangles fill the gap between the vertices of the two sides.
TEST(Soft_lines, AreSeenThroughTrianglesWithTwoCornersAtOnePosition)
{
  for (const double degrees : {5, 80}) {
    Triangle_soup soup = creased(degrees);
    const std::size_t count = soup.triangles.size();
    for (std::size_t t = 0; t < count; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = soup.triangles[t][k], b = soup.triangles[t][(k + 1) % 3];
        soup.triangles.push_back({a, b, Index(soup.points.size())});
        soup.points.push_back(Point_3(soup.points[a]));
        const Index_triple numbers = soup.normals.of_triangle[t];
        soup.normals.of_triangle.push_back({numbers[k], numbers[(k + 1) % 3], numbers[k]});
      }
    EXPECT_EQ(are_lines_soft(soup), degrees == 5);
  }
}

TEST(Soft_lines, AreLoosenedBesideHardOnes)
{
  Triangle_soup soup = creased_twice();
  EXPECT_EQ(suited_to(soup, Normals_choice::automatic), Normals_choice::soft);
  const std::vector<char> is_soft = are_on_soft_lines(soup);
  ASSERT_EQ(is_soft.size(), soup.points.size());
  for (Index v = 0; v < is_soft.size(); ++v)
    EXPECT_EQ(is_soft[v] != 0, soup.points[v].x() == 2 || soup.points[v].x() == 4) << v;
  loosen_soft_lines(soup);
  std::set<std::pair<Index, Index>> normals; // of a vertex
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      normals.emplace(soup.triangles[t][k], soup.normals.of_triangle[t][k]);
  for (Index v = 0; v < is_soft.size(); ++v) {
    const auto first = normals.lower_bound({v, 0}), last = normals.lower_bound({v + 1, 0});
    const double x = soup.points[v].x();
    EXPECT_EQ(std::distance(first, last), x == 6 || x == 8 || x == 10 ? 2 : 1) << v;
  }
}

// At an angle of 0.15 degrees, all normals of a vertex are near to their mean.
TEST(Soft_lines, LeaveNoNormalThatTheFileDoesNotHave)
{
  for (const double degrees : {5.0, 0.15}) {
    const Triangle_soup soup = creased_twice(degrees);
    Triangle_soup original = soup;
    loosen_soft_lines(original);
    ASSERT_GT(original.normals.values.size(), soup.normals.values.size());
    Triangle_soup result = original;
    std::vector<Index> triangles(soup.triangles.size());
    std::iota(triangles.begin(), triangles.end(), Index(0));
    std::map<Index, Index> last; // corner, by vertex
    std::map<Index, std::set<std::array<double, 3>>> normals;
    for (Index corner = 0; corner < 3 * soup.triangles.size(); ++corner) {
      const Index vertex = soup.triangles[corner / 3][corner % 3];
      last[vertex] = corner;
      normals[vertex].insert(soup.normals.values[soup.normals.of_triangle[corner / 3][corner % 3]]);
    }
    std::vector<Index_triple> corners;
    for (const auto& [a, b, c] : soup.triangles)
      corners.push_back({last[a], last[b], last[c]});
    pick_normals(result, triangles, corners, original, soup.normals);
    for (Index t = 0; t < soup.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(
            normals[soup.triangles[t][k]].count(result.normals.values[result.normals.of_triangle[t][k]]), 1u);
  }
}

TEST(Soft_lines, AreTheSameOnAMeshOfAnySize)
{
  for (const double size : {std::ldexp(1, 906), std::ldexp(1, -906)}) {
    Triangle_soup soup = creased_twice();
    const std::vector<char> is_soft = are_on_soft_lines(soup);
    for (Point_3& p : soup.points)
      p = Point_3(size * p.x(), size * p.y(), size * p.z());
    EXPECT_EQ(are_on_soft_lines(soup), is_soft);
  }
}

TEST(Soft_lines, AreNoneWhereTheTextureHasASeam)
{
  Triangle_soup soup = creased(5);
  soup.uvs.of_triangle = soup.normals.of_triangle;
  for (std::size_t i = 0; i < soup.normals.values.size(); ++i)
    soup.uvs.values.push_back({double(i), 0});
  EXPECT_FALSE(are_lines_soft(soup));
}

// There, vertices stay on the line in any case.
TEST(Soft_lines, AreLeftWhereHardOnesLieBetweenGroups)
{
  Triangle_soup soup = creased(80);
  soup.normals.values[soup.normals.of_triangle[100][0]] = {-5, 0, 1};
  EXPECT_FALSE(are_lines_soft(soup));
  soup.groups.names = {"even", "odd"};
  for (const Index_triple& numbers : soup.normals.of_triangle)
    soup.groups.of_triangle.push_back(soup.normals.values[numbers[1]][0] > 0);
  EXPECT_TRUE(are_lines_soft(soup));
}

TEST(Soft_lines, HoldNoVerticesApartThatDifferInTheirNormalsAlone)
{
  const auto suited = [](Normals_choice choice, bool has_normals_of_vertices) {
    Triangle_soup soup = split_by_normals(creased(5));
    const std::vector<Index_triple> before = soup.triangles;
    const Suited_normals result = suit_normals(soup, choice, has_normals_of_vertices);
    EXPECT_EQ(result.joined_corners, corners_changed(before, soup.triangles));
    return result;
  };
  EXPECT_EQ(suited(Normals_choice::automatic, true).choice, Normals_choice::loose);
  EXPECT_GT(suited(Normals_choice::automatic, true).joined_corners, 0u);
  EXPECT_GT(suited(Normals_choice::drop, true).joined_corners, 0u);
  EXPECT_EQ(suited(Normals_choice::automatic, false).choice, Normals_choice::loose);
  EXPECT_EQ(suited(Normals_choice::automatic, false).joined_corners, 0u);
  EXPECT_EQ(suited(Normals_choice::keep, true).joined_corners, 0u);
}

TEST(Soft_lines, LetOtherChoicesStay)
{
  for (const Normals_choice choice : {Normals_choice::keep, Normals_choice::mend, Normals_choice::recompute,
                                      Normals_choice::smooth, Normals_choice::drop})
    EXPECT_EQ(suited_to(creased(5), choice), choice);
  EXPECT_FALSE(are_lines_soft(sheet(s_squares, s_squares)));
  EXPECT_FALSE(are_lines_soft(creased(0)));
}
