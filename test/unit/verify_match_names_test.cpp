// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Names of groups, objects and materials that faces of a result have where the original has others.

#include "support/matched_pieces.h"

#include <selvedge/verify.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace selvedge {
namespace {

using namespace test;

TEST(MatchPieces, FindExchangedNames)
{
  const std::vector<std::string> names{"shell", "interlining", "lining", "button"};
  const Triangle_soup original = named(fine(), names);
  const Piece_matching right = match_pieces(named(coarse(), names), original);
  EXPECT_EQ(way(right), Matched_by::vertices);
  EXPECT_EQ(right.names_compared, std::vector<std::string>{"group"});

  const Piece_matching wrong =
      match_pieces(named(coarse(), {"lining", "interlining", "shell", "button"}), original);
  EXPECT_EQ(mismatches(wrong), (Mismatches{Mismatch::name, Mismatch::name}));
  EXPECT_EQ(
      wrong.mismatches[0].message,
      "the group of 32 faces of piece 1 ('lining', 32 faces around (4, 4, 0)) of the result is 'lining', "
      "where the original has 'shell'");
  EXPECT_EQ(mismatches(named(coarse(), {"shell", "interlining", "lining", ""}), original),
            Mismatches{Mismatch::name});
}

TEST(MatchPieces, FindExchangedNamesOfObjectsAndMaterialsToo)
{
  const Triangle_soup original = named(fine(), {"a", "b", "c", "d"});
  for (Triangle_labels Triangle_soup::*labels : {&Triangle_soup::objects, &Triangle_soup::materials}) {
    Triangle_soup before = fine(), now = coarse();
    before.*labels = original.groups;
    now.*labels = named(coarse(), {"a", "c", "b", "d"}).groups;
    EXPECT_EQ(mismatches(now, before), (Mismatches{Mismatch::name, Mismatch::name}));
  }
}

// Two halves of one piece.
TEST(MatchPieces, FindExchangedNamesWithinAPiece)
{
  const auto halves = [](Index squares, const std::string& left, const std::string& right) {
    Triangle_soup soup = layer(squares, 0);
    soup.groups.names = {left, right};
    for (const Index_triple& triangle : soup.triangles) {
      const Point_3 centre =
          CGAL::centroid(soup.points[triangle[0]], soup.points[triangle[1]], soup.points[triangle[2]]);
      soup.groups.of_triangle.push_back(centre.x() > 4);
    }
    return soup;
  };
  const Triangle_soup original = halves(8, "left", "right");
  EXPECT_TRUE(mismatches(halves(4, "left", "right"), original).empty());
  EXPECT_TRUE(mismatches(moved(halves(4, "left", "right"), 0, 0, 0.125), original).empty());
  EXPECT_EQ(mismatches(halves(4, "right", "left"), original), (Mismatches{Mismatch::name, Mismatch::name}));
  EXPECT_EQ(mismatches(moved(halves(4, "right", "left"), 0, 0, 0.125), original),
            (Mismatches{Mismatch::name, Mismatch::name}));
  EXPECT_EQ(mismatches(halves(4, "left", "left"), original), (Mismatches{Mismatch::name}));
}

TEST(MatchPieces, DemandNoNamesThatOnlyOneHas)
{
  const Triangle_soup with_names = named(fine(), {"a", "b", "c", "d"});
  for (const auto& [result, original] :
       {std::pair(coarse(), with_names), std::pair(named(coarse(), {"x", "y", "x", "y"}), fine()),
        std::pair(named(coarse(), {"x", "y", "x", "y"}), with_names)}) {
    const Piece_matching matching = match_pieces(result, original);
    EXPECT_TRUE(matching.is_complete());
    EXPECT_TRUE(matching.names_compared.empty());
    EXPECT_EQ(matching.names_not_compared, std::vector<std::string>{"group"});
  }
}

/// A piece of which the left `half` of the columns has one name, and the right half another.
Triangle_soup in_halves(Triangle_soup soup, Index half, const std::string& left, const std::string& right)
{
  soup.groups.names = {left, right};
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    soup.groups.of_triangle.push_back(t >= 2 * half);
  return soup;
}

// An arch at the end of a strip that runs under it. Reduced with new places, it is flat, and its faces lie
// nearest to the strip.
TEST(MatchPieces, HaveTheNameOfWhatTheyAreLikeNotOfWhatIsNearest)
{
  const Triangle_soup original = mapped(sheet(16, 1), [](const Point_3& p) {
    if (p.x() <= 8)
      return Point_3(40 - 5 * p.x(), 8 * p.y(), 0);
    const double angle = (p.x() - 8) * std::atan(0.5);
    return Point_3(4 - 4 * std::cos(angle), 8 * p.y(), 4 * std::sin(angle) + (p.x() - 8) / 16);
  });
  const double x[] = {39.9, 0.1, 7.9}, z[] = {0, 0.01, 0.5};
  const Triangle_soup result = mapped(
      sheet(2, 1), [&](const Point_3& p) { return Point_3(x[int(p.x())], 0.01 + 8 * p.y(), z[int(p.x())]); });
  const Triangle_soup before = in_halves(original, 8, "strip", "arch");
  const Piece_matching right = match_pieces(in_halves(result, 1, "strip", "arch"), before);
  EXPECT_TRUE(right.is_complete()) << right.mismatches.front().message;
  EXPECT_EQ(right.names_compared, std::vector<std::string>{"group"});
  EXPECT_NE(mismatches(in_halves(result, 1, "arch", "strip"), before), Mismatches{});
  EXPECT_EQ(mismatches(in_halves(result, 1, "strip", "strip"), before), Mismatches{Mismatch::name});
  EXPECT_EQ(mismatches(in_halves(result, 1, "arch", "arch"), before), Mismatches{Mismatch::name});
}

} // namespace
} // namespace selvedge
