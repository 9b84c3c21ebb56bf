// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/verify.h>

#include "support/soups.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace selvedge {
namespace {

using namespace test;

std::vector<Offending_pair> new_pairs_of(const Triangle_soup& result, const Triangle_soup& original)
{
  return new_pairs(result, offending_pairs(result), original, offending_pairs(original));
}

/// Other numbers for the vertices and triangles, other corners first, other orientations: the same positions.
Triangle_soup disguised(const Triangle_soup& soup)
{
  Triangle_soup result = unshared(soup);
  std::reverse(result.triangles.begin(), result.triangles.end());
  for (auto& [a, b, c] : result.triangles) {
    std::swap(a, b);
    std::swap(b, c);
  }
  std::swap(result.triangles[0][0], result.triangles[0][1]);
  return mapped(result, [](const Point_3& p) {
    const auto flip_zero = [](double c) { return c == 0 ? -c : c; };
    return Point_3(flip_zero(p.x()), flip_zero(p.y()), flip_zero(p.z()));
  });
}

const std::vector<Triangle_soup> offending_soups = {
    vertex_touching_face(), crossing(),    coplanar_overlap(),   opposite_duplicate(),
    t_junction(),           folded_over(), collinear_triangle(), edge_touching_edge()};

TEST(NewPairs, AreNoneOfThoseOfTheOriginal)
{
  for (const Triangle_soup& soup : offending_soups) {
    EXPECT_FALSE(offending_pairs(soup).empty());
    EXPECT_TRUE(new_pairs_of(soup, soup).empty());
    EXPECT_TRUE(new_pairs_of(disguised(soup), soup).empty());
    EXPECT_TRUE(new_pairs_of(soup, disguised(soup)).empty());
    EXPECT_TRUE(new_pairs_of({}, soup).empty());
  }
}

TEST(NewPairs, AreAllThatTheOriginalHasNot)
{
  for (const Triangle_soup& soup : offending_soups) {
    const std::size_t count = offending_pairs(soup).size();
    EXPECT_EQ(new_pairs_of(soup, {}).size(), count);
    // One triangle moved by the least that a double can: no pair with it is an old one.
    Triangle_soup moved = soup;
    Point_3& p = moved.points.back();
    p = Point_3(p.x(), std::nextafter(p.y(), 100), p.z());
    EXPECT_EQ(new_pairs_of(moved, soup).size(), offending_pairs(moved).size());
    EXPECT_EQ(new_pairs_of(joined(soup, moved), soup).size(),
              offending_pairs(joined(soup, moved)).size() - count);
  }
}

TEST(NewPairs, NameThePairsOfTheResult)
{
  const Triangle_soup result = joined(
      mapped(crossing(), [](const Point_3& p) { return Point_3(p.x() + 50, p.y(), p.z()); }), crossing());
  const std::vector<Offending_pair> pairs = new_pairs_of(result, crossing());
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first, 0u);
  EXPECT_EQ(pairs[0].second, 1u);
  EXPECT_EQ(pairs[0].offence, Offence::intersection);
}

// The same pair three times over where it was once: two are new, though each one of the three looks old.
TEST(NewPairs, AreCounted)
{
  Triangle_soup thrice = collinear_triangle();
  thrice.triangles.resize(3, thrice.triangles[0]);
  Triangle_soup once = collinear_triangle();
  const std::vector<Offending_pair> pairs = new_pairs_of(thrice, once);
  const auto count = [&](Offence offence) {
    return std::count_if(pairs.begin(), pairs.end(),
                         [&](const Offending_pair& p) { return p.offence == offence; });
  };
  EXPECT_EQ(count(Offence::degenerate), 2);
  EXPECT_EQ(count(Offence::duplicate), 3);
  EXPECT_TRUE(new_pairs_of(once, thrice).empty());
  EXPECT_TRUE(new_pairs_of(thrice, disguised(thrice)).empty());
}

} // namespace
} // namespace selvedge
