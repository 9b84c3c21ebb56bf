// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Who is a partner of whom, who goes, and what is refused, on sheets of squares of side 1.

#include "soup/number_positions.h"
#include "support/reduction.h"
#include "support/soups.h"

#include "weld/snapping.h"

#include <selvedge/merge.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

namespace selvedge::test {
namespace {

constexpr double s_distance = 0.01;

Triangle_soup shifted(const Triangle_soup& soup, double x, double y, double z = 0)
{
  return mapped(soup, [=](const Point_3& p) { return Point_3(p.x() + x, p.y() + y, p.z() + z); });
}

/// Two sheets side by side, with a gap of 0.005 along x = width.
Triangle_soup two_sheets(Index width = 3, Index depth = 3)
{
  return joined(sheet(width, depth), shifted(sheet(width, depth), width + 0.005, 0));
}

struct Snapped
{
  Triangle_soup soup;
  std::vector<Index> positions;
  Snapping_notes notes;
  Gaps_left left;
};

Snapped snap(Triangle_soup soup, const std::set<Index>& frozen = {}, double distance = s_distance)
{
  std::vector<Index> positions = number_positions(soup.points);
  std::vector<char> is_frozen(soup.triangles.size(), false);
  for (const Index t : frozen)
    is_frozen[t] = true;
  Snapped_borders snapped = snap_borders(soup, positions, is_frozen, distance);
  EXPECT_EQ(positions, number_positions(soup.points));
  return {std::move(soup), std::move(positions), std::move(snapped.notes), std::move(snapped.left)};
}

Border_gaps gaps_of(const Triangle_soup& soup)
{
  return find_open_seams(soup, number_positions(soup.points)).gaps;
}

TEST(Border_gaps, AreTheLeastDistancesAtWhichPartnersSnap)
{
  // The gap between the two sheets is 0.005 wide at its ends, and wider and wider in between.
  const Triangle_soup sheets = mapped(
      two_sheets(3, 8), [](const Point_3& p) { return p.x() > 3 ? Point_3(p.x(), p.y(), p.y() / 64) : p; });
  const Border_gaps gaps = gaps_of(sheets);
  EXPECT_EQ(gaps.border_vertices, 44u);
  ASSERT_EQ(gaps.lengths.size(), 18u); // nine on either side
  EXPECT_TRUE(std::is_sorted(gaps.lengths.begin(), gaps.lengths.end()));
  EXPECT_EQ(snap(sheets, {}, std::nextafter(gaps.lengths.front(), 0)).notes.partnered, 0u);
  for (const double length : gaps.lengths) {
    const std::size_t within = std::count_if(gaps.lengths.begin(), gaps.lengths.end(),
                                             [&](double other) { return other <= length; });
    EXPECT_EQ(snap(sheets, {}, length).notes.partnered, within) << length;
  }
  EXPECT_DOUBLE_EQ(gaps.limit, 1);
  // Nothing is found beyond the limit, nor on a border that is alone.
  EXPECT_TRUE(gaps_of(joined(sheet(3, 3), moved(sheet(3, 3), 4.25, 0, 0))).lengths.empty());
  EXPECT_TRUE(gaps_of(sheet(3, 3)).lengths.empty());
}

TEST(Border_gaps, AreClearWhereSeamsEndAndNothingElseBegins)
{
  const auto clear_length = [](double gap, double other_gap) {
    const auto pair_of_sheets = [](Index depth, double between) {
      return joined(sheet(1, depth), moved(sheet(1, depth), 1 + between, 0, 0));
    };
    return gaps_of(joined(pair_of_sheets(8, gap), moved(pair_of_sheets(3, other_gap), 9, 0, 0))).clear_length;
  };
  EXPECT_EQ(clear_length(0.125, 3), 0.125);
  EXPECT_EQ(clear_length(0.125, 0.25), 0.25) << "two seams";
  EXPECT_EQ(clear_length(0.125, 0.625), 0.125) << "distances of more than half an edge are no gaps";
  EXPECT_EQ(clear_length(0.375, 0.625), std::nullopt) << "nor are those just below";
  EXPECT_EQ(clear_length(0.625, 3), std::nullopt);

  // Two layers, of which one faces down: their borders run opposite ways, but neither surface continues the
  // other.
  Triangle_soup below = sheet(3, 3, -0.125);
  for (Index_triple& triangle : below.triangles)
    std::swap(triangle[0], triangle[1]);
  const Border_gaps layers = gaps_of(joined(sheet(3, 3), below));
  EXPECT_EQ(layers.lengths, std::vector<double>(24, 0.125));
  EXPECT_EQ(layers.clear_length, std::nullopt);
}

// The search begins within a small share of an edge, which is less than the smallest number here.
TEST(Border_gaps, AreFoundAmongTheSmallestNumbers)
{
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const Triangle_soup sheets =
      mapped(joined(sheet(1, 3), moved(sheet(1, 3), 1.125, 0, 0)),
             [](const Point_3& p) { return Point_3(8 * smallest * p.x(), 8 * smallest * p.y(), 1); });
  const Border_gaps gaps = gaps_of(sheets);
  EXPECT_EQ(gaps.limit, 8 * smallest);
  EXPECT_EQ(gaps.lengths, std::vector<double>(8, smallest));
}

// Borders that meet here and part in some pose, as lips do, lie at distance 0 and are no one position.
TEST(Border_gaps, AreClearBesideBordersThatPartInSomePoseAlone)
{
  const auto clear_length = [](const Triangle_soup& soup) {
    std::vector<Index> positions(soup.points.size());
    std::iota(positions.begin(), positions.end(), 0);
    return find_open_seams(soup, positions).gaps.clear_length;
  };
  const Triangle_soup lips = joined(sheet(1, 8), moved(sheet(1, 8), 1, 0, 0)),
                      seam = joined(sheet(1, 3), moved(sheet(1, 3), 1.125, 0, 0));
  EXPECT_EQ(clear_length(joined(lips, moved(seam, 9, 0, 0))), 0.125);
  EXPECT_EQ(clear_length(lips), 0);
}

/// Two sheets side by side along which the left one has 25 vertices and the right one 33.
Triangle_soup uneven_sheets(double gap, Index left_width = 8, Index right_width = 8, double along = 0)
{
  return joined(sheet(left_width, 24), mapped(sheet(right_width, 32), [=](const Point_3& p) {
                  return Point_3(left_width + gap + p.x(), along + 0.75 * p.y(), 0);
                }));
}

TEST(Border_gaps, AreMeasuredToEdgesWhereTheSidesHaveOtherNumbersOfVertices)
{
  const Border_gaps gaps = gaps_of(uneven_sheets(0.125));
  EXPECT_EQ(gaps.clear_length, std::nullopt);
  EXPECT_EQ(gaps.clear_length_to_edges, 0.125);
  EXPECT_EQ(gaps.within_clear_length_to_edges, 25u + 33);
  EXPECT_EQ(gaps_of(uneven_sheets(0.625)).clear_length_to_edges, std::nullopt);
  EXPECT_EQ(gaps_of(uneven_sheets(0x1p-20)).clear_length_to_edges, 0x1p-12) << "they all but touch";

  // Beside a seam that has a clear length, and is narrower.
  const Triangle_soup both = joined(joined(sheet(8, 70), moved(sheet(8, 70), 8 + 1 / 64., 0, 0)),
                                    moved(uneven_sheets(0.125), 30, 0, 0));
  const Open_borders open = find_open_seams(both, number_positions(both.points));
  EXPECT_EQ(open.gaps.clear_length, 1 / 64.);
  EXPECT_EQ(open.gaps.clear_length_to_edges, 0.125);
  EXPECT_EQ(open.gaps.within_clear_length_to_edges, 25u + 33);
  EXPECT_EQ(open.left.tied.size(), 71u);
  EXPECT_EQ(open.left.facing.size(), 25u + 33);
  const Triangle_soup even = joined(sheet(8, 24), moved(sheet(8, 24), 8.125, 0, 0));
  EXPECT_EQ(gaps_of(even).clear_length, 0.125);
  EXPECT_EQ(gaps_of(even).clear_length_to_edges, std::nullopt) << "nothing is left";
}

TEST(Border_gaps, ToEdgesAreNoneBetweenWhatIsNoSeam)
{
  const auto to_edges = [](const Triangle_soup& soup) { return gaps_of(soup).clear_length_to_edges; };
  EXPECT_EQ(to_edges(joined(uneven_sheets(0.125, 1, 2), moved(sheet(8, 8), 30, 0, 0))), std::nullopt)
      << "cards of hair have little inside";
  EXPECT_EQ(to_edges(uneven_sheets(0.125, 1, 8)), 0.125) << "a band at a panel";
  EXPECT_EQ(to_edges(uneven_sheets(0.125, 8, 8, 22.9)), std::nullopt) << "only three vertices face the other";
  EXPECT_EQ(to_edges(uneven_sheets(0.125, 8, 8, 20)), 0.125);

  const auto turned = [](Triangle_soup soup) {
    for (Index_triple& triangle : soup.triangles)
      std::swap(triangle[0], triangle[1]);
    return soup;
  };
  const auto squeezed = [](const Triangle_soup& soup, double factor, double height) {
    return mapped(soup, [=](const Point_3& p) { return Point_3(p.x(), factor * p.y(), height); });
  };
  EXPECT_EQ(to_edges(joined(sheet(8, 24), turned(moved(squeezed(sheet(8, 32), 0.75, 0), 8.125, 0, 0)))),
            std::nullopt)
      << "the borders run the same way";
  EXPECT_EQ(to_edges(joined(sheet(8, 24), turned(squeezed(sheet(8, 32), 0.75, 0.125)))), std::nullopt)
      << "the two sides of a double layer";
}

TEST(Border_gaps, PairsBeyondTheClearLengthAreTiedWhereEdgesFindASeam)
{
  // Of two seams equally wide, one has as many vertices on both sides.
  const Triangle_soup even = joined(sheet(8, 24), moved(sheet(8, 24), 8.25, 0, 0));
  const Triangle_soup both = joined(even, moved(uneven_sheets(0.25), 30, 0, 0));
  const Open_borders open = find_open_seams(both, number_positions(both.points));
  EXPECT_EQ(open.gaps.clear_length, std::nullopt);
  EXPECT_EQ(open.gaps.clear_length_to_edges, 0.25);
  ASSERT_EQ(open.left.tied.size(), 25u);
  for (const auto& [a, b] : open.left.tied)
    EXPECT_EQ(both.points[a].y(), both.points[b].y());
  EXPECT_EQ(open.left.facing.size(), 25u + 33);

  // Beside the seam, two layers, and two panels along each other for three vertices.
  Triangle_soup layer = sheet(8, 24, 0.125);
  for (Index_triple& triangle : layer.triangles)
    std::swap(triangle[0], triangle[1]);
  const Triangle_soup others =
      joined(joined(sheet(8, 24), layer), moved(uneven_sheets(0.125, 8, 8, 22.9), 30, 0, 0));
  const Triangle_soup beside = joined(uneven_sheets(0.25), moved(others, 30, 0, 0));
  const Gaps_left left = find_open_seams(beside, number_positions(beside.points)).left;
  EXPECT_EQ(left.tied.size(), 0u);
  EXPECT_EQ(left.facing.size(), 25u + 33);
}

TEST(Border_gaps, BetweenCardsOfHairAreNotHeld)
{
  const auto gaps = [](const Triangle_soup& soup) {
    const Open_borders open = find_open_seams(soup, number_positions(soup.points));
    EXPECT_EQ(open.gaps.clear_length, 0.125);
    return std::pair(open.left.tied.size(), open.left.facing.size());
  };
  using Gaps = std::pair<std::size_t, std::size_t>;
  // Where a vertex of the left one is elsewhere, four face edges.
  const auto lower = [](const Point_3& p) { return p.y() == 1 ? Point_3(p.x(), 0.5, p.z()) : p; };
  const auto beside = [&](const Triangle_soup& card, const Triangle_soup& other) {
    return joined(mapped(card, lower), moved(other, 1.125, 0, 0));
  };
  EXPECT_EQ(gaps(joined(sheet(1, 8), moved(sheet(1, 8), 1.125, 0, 0))), Gaps(0, 0));
  EXPECT_EQ(gaps(joined(sheet(1, 8), moved(sheet(2, 8), 1.125, 0, 0))), Gaps(9, 0)) << "a card at a panel";
  EXPECT_EQ(gaps(beside(sheet(1, 8), sheet(2, 8))).second, 4u);
  EXPECT_EQ(gaps(beside(sheet(1, 8), sheet(1, 8))), Gaps(0, 0));
  // A cuff that is not closed.
  const double step = std::asin(1 / 16.);
  const Triangle_soup cuff = mapped(sheet(1, 12), [&](const Point_3& p) {
    const double angle = step + (CGAL_PI - step) * p.y() / 6;
    return Point_3(p.x() / 4, std::sin(angle), p.y() == 12 ? std::cos(step) : std::cos(angle));
  });
  const Open_borders open = find_open_seams(cuff, number_positions(cuff.points));
  EXPECT_NEAR(open.gaps.clear_length.value_or(0), 0.125, 1e-12);
  EXPECT_EQ(open.left.tied.size(), 2u);
}

TEST(Snapping_rules, TwoSheets)
{
  const Snapped result = snap(two_sheets());
  EXPECT_EQ(result.notes.border_vertices, 24u);
  EXPECT_EQ(result.notes.partnered, 8u);
  EXPECT_EQ(result.notes.snapped, 8u);
  EXPECT_EQ(result.notes.snaps.size(), 4u);
  EXPECT_EQ(result.notes.seam_edges, 3u);
  EXPECT_TRUE(is_embedded(result.soup));
}

TEST(Snapping_rules, NothingIsNearEnough)
{
  const Snapped result = snap(two_sheets(), {}, 0.004);
  EXPECT_EQ(result.notes.partnered, 0u);
  EXPECT_EQ(result.soup.points, two_sheets().points);
}

TEST(Snapping_rules, FewerFacesGo)
{
  // Corners of a sheet have one face or two; which one is the other's partner's opposite.
  const Triangle_soup before = two_sheets(1, 1);
  const Snapped result = snap(before);
  ASSERT_EQ(result.notes.snaps.size(), 2u);
  const auto faces = [&](Index v) {
    return std::count_if(before.triangles.begin(), before.triangles.end(),
                         [v](const Index_triple& t) { return std::count(t.begin(), t.end(), v) > 0; });
  };
  for (const Snap& snap : result.notes.snaps)
    EXPECT_LT(faces(snap.from), faces(snap.to));
}

TEST(Snapping_rules, FourPiecesMeetInOnePosition)
{
  // The corner of the fourth is near the others' only one after another.
  const Triangle_soup left = joined(sheet(2, 2), shifted(sheet(2, 2), 2.004, 0.001));
  const Triangle_soup right = joined(shifted(sheet(2, 2), 0.001, 2.005), shifted(sheet(2, 2), 2.006, 2.007));
  const Snapped result = snap(joined(left, right));
  EXPECT_EQ(result.notes.snapped, 4u + 4u * 4u)
      << "a corner of each, and four seams of two more vertices on each side";
  EXPECT_EQ(result.notes.seam_edges, 8u);
  const Point_3 corner = result.soup.points[8];
  EXPECT_EQ(std::count(result.soup.points.begin(), result.soup.points.end(), corner), 4);
  EXPECT_TRUE(is_embedded(result.soup));
}

TEST(Snapping_rules, VerticesAtOnePositionGoTogether)
{
  // Two pieces that meet in a corner already, and a fan of more faces opposite: both corners go.
  const Triangle_soup corners =
      soup({{0, 0.005, 0}, {2, 0.005, 0}, {1, 2, 0}, {0, 0.005, 0}, {-1, 2, 0}, {-2, 0.005, 0}},
           {{0, 1, 2}, {3, 4, 5}});
  const Triangle_soup fan = soup({{0, 0, 0}, {2, 0, 0}, {-2, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}},
                                 {{0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}});
  const Snapped result = snap(joined(corners, fan));
  EXPECT_EQ(result.notes.snaps.size(), 3u);
  EXPECT_EQ(result.notes.seam_edges, 2u);
  EXPECT_EQ(result.soup.points[0], Point_3(0, 0, 0));
  EXPECT_EQ(result.soup.points[3], Point_3(0, 0, 0));
  EXPECT_TRUE(is_embedded(result.soup));
}

TEST(Snapping_rules, FrozenVerticesDoNotSnap)
{
  const Triangle_soup soup = two_sheets();
  const Snapped result = snap(soup, {4}); // the face of vertices 2, 3 and 7
  EXPECT_EQ(result.notes.partnered, 8u);
  EXPECT_EQ(result.notes.left_frozen, 4u);
  EXPECT_EQ(result.notes.snapped, 4u);
  EXPECT_EQ(result.soup.points[3], soup.points[3]);
  EXPECT_EQ(result.soup.points[7], soup.points[7]);
  EXPECT_EQ(result.soup.points[16], soup.points[16]);
  EXPECT_EQ(result.notes.seam_edges, 1u);
  EXPECT_EQ(result.left.tied, (std::vector<std::pair<Index, Index>>{{3, 16}, {7, 20}})) << "frozen or not";
}

TEST(Snapping_rules, OnlyUnderOneTransform)
{
  Triangle_soup soup = two_sheets();
  std::vector<Index> positions = number_positions(soup.points);
  const std::vector<char> is_frozen(soup.triangles.size(), false);
  std::vector<Index> transforms(soup.points.size(), 7);
  std::fill(transforms.begin() + 16, transforms.end(), Index(8));
  const Snapped_borders apart = snap_borders(soup, positions, is_frozen, s_distance, transforms);
  EXPECT_EQ(apart.notes.left_foreign, 8u);
  EXPECT_TRUE(apart.notes.snaps.empty());
  EXPECT_TRUE(apart.left.tied.empty());
  EXPECT_TRUE(apart.left.facing.empty());
  EXPECT_EQ(soup.points, two_sheets().points);
  std::fill(transforms.begin() + 16, transforms.end(), Index(7));
  EXPECT_EQ(snap_borders(soup, positions, is_frozen, s_distance, transforms).notes.snapped, 8u);
}

TEST(Snapping_rules, WhatLiesInTheGapIsNotPassed)
{
  // A sheet that hangs in the gap, between two of the partners.
  const Triangle_soup hanging = soup({{3.002, 0.5, -1}, {3.002, 1.5, -1}, {3.002, 1, 1}}, {{0, 1, 2}});
  const Snapped result = snap(joined(two_sheets(), hanging));
  EXPECT_EQ(result.notes.left_blocked, 2u);
  EXPECT_EQ(result.notes.snapped, 6u);
  EXPECT_TRUE(is_embedded(result.soup));
  EXPECT_EQ(snap(two_sheets()).notes.left_blocked, 0u) << "the control";
}

TEST(Snapping_rules, LayersAreNotSewnToEachOther)
{
  const Snapped result = snap(joined(sheet(3, 3), shifted(sheet(3, 3), 0, 0, 0.005)));
  EXPECT_TRUE(result.notes.snaps.empty());
  EXPECT_EQ(result.notes.partnered, 0u);
  EXPECT_EQ(result.notes.near_without_edge, 24u);
}

TEST(Snapping_rules, CornersThatComeNearAreNotSewn)
{
  const Snapped result = snap(joined(sheet(1, 1), shifted(sheet(1, 1), 1.004, 1.004)));
  EXPECT_TRUE(result.notes.snaps.empty());
  EXPECT_EQ(result.notes.near_without_edge, 2u);
}

// A vertex in the middle of the other side's edge has no partner and stays.
TEST(Snapping_rules, TJunctionIsKept)
{
  const Triangle_soup coarse = soup({{0, -1, 0}, {2, -1, 0}, {0, 0, 0}, {2, 0, 0}}, {{0, 1, 3}, {0, 3, 2}});
  const Triangle_soup fine = shifted(sheet(2, 1), 0, 0.005);
  const Snapped result = snap(joined(coarse, fine));
  EXPECT_EQ(result.notes.snaps.size(), 0u) << "no edge of one side is an edge of the other";
  EXPECT_TRUE(is_embedded(result.soup));
}

/// A square whose right side is cut open to its middle, vertex 4, by 2 × `half_width`.
Triangle_soup cut_open(double half_width)
{
  return soup(
      {{0, 0, 0}, {2, 0, 0}, {2, 1 - half_width, 0}, {2, 1 + half_width, 0}, {1, 1, 0}, {0, 2, 0}, {2, 2, 0}},
      {{0, 1, 4}, {1, 2, 4}, {4, 3, 6}, {4, 6, 5}, {0, 4, 5}});
}

TEST(Snapping_rules, DartCloses)
{
  const Snapped result = snap(cut_open(0.004));
  EXPECT_EQ(result.notes.seam_edges, 1u);
  EXPECT_EQ(result.soup.points[2], result.soup.points[3]);
  EXPECT_TRUE(is_embedded(result.soup));
  EXPECT_TRUE(snap(cut_open(0.4), {}, 1).notes.snaps.empty() == false);
  // The border from 2 over 4 to 3 is not longer than twice this.
  EXPECT_TRUE(snap(cut_open(0.4), {}, 1.1).notes.snaps.empty());
}

TEST(Snapping_rules, AnEdgeGetsNoThirdFace)
{
  // The gap in the square is closed already by a strip that shares its edges.
  Triangle_soup filled = cut_open(0.004);
  filled.triangles.push_back({2, 3, 4});
  const Snapped alone = snap(filled);
  EXPECT_TRUE(alone.notes.snaps.empty()) << "the two are joined by an edge";
}

// A sheet whose corner is between two partners goes to the nearer one, which is too far from the other: there
// is no edge any more that the vertex beside it could have in common with the other sheet.
TEST(Snapping_rules, PartnersThatAnotherSnapHasPartedStay)
{
  const Triangle_soup above = shifted(sheet(2, 1), 0, 1.006), beside = shifted(sheet(1, 1), 1.009, -0.003);
  const Snapped apart = snap(joined(joined(sheet(1, 1), above), beside));
  EXPECT_EQ(apart.notes.snaps.size(), 2u);
  EXPECT_EQ(apart.notes.seam_edges, 1u);
  EXPECT_EQ(snap(joined(sheet(1, 1), beside)).notes.snaps.size(), 2u) << "the control";
}

TEST(Snapping_rules, AnInnerEdgeGetsNoThirdFace)
{
  // Two faces at the edge from 0 to 1, and two that hang on vertex 0 and come near vertices 1 and 2.
  const Snapped result =
      snap(soup({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, -1, 0}, {1, 0, 0.005}, {1, 1, 0.005}, {0.7, 0.3, 1}},
                {{0, 1, 2}, {1, 0, 3}, {4, 6, 5}, {4, 0, 6}}));
  EXPECT_EQ(result.notes.left_unmanifold, 2u);
  EXPECT_EQ(result.notes.snaps.size(), 1u);
}

TEST(Snapping_rules, NoFaceTurnsOver)
{
  // The first face would have to pass through its own longest edge.
  const Snapped result =
      snap(soup({{0, 0.003, 0}, {-1, 0, 0}, {1, 0, 0}, {-1, -0.004, 0}, {0, -0.003, 0}, {-0.5, -1, 0}},
                {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(result.notes.left_folding, 2u);
  EXPECT_EQ(result.notes.snaps.size(), 1u);
}

TEST(Snapping_rules, WhatHasSnappedIsInTheWay)
{
  // One face above the gap and one below it: their snaps, which come first, draw one of them across it.
  const Triangle_soup faces = soup({{3.004, 0.8, 0.002},
                                    {3.004, 1.5, 0.002},
                                    {3.004, 1.2, 1},
                                    {3.004, 0.8, -0.001},
                                    {3.004, 1.5, -0.001},
                                    {3.004, 1.2, -1}},
                                   {{0, 1, 2}, {4, 3, 5}});
  const Triangle_soup sheets = joined(sheet(3, 3), shifted(sheet(3, 3), 3.008, 0));
  const Snapped result = snap(joined(sheets, faces));
  EXPECT_EQ(result.notes.left_blocked, 2u);
  EXPECT_EQ(result.notes.snaps.size(), 5u);
  EXPECT_TRUE(is_embedded(result.soup));
  EXPECT_EQ(snap(sheets).notes.left_blocked, 0u) << "the control";
}

// Distances as large as the faces ask for what would degenerate, fold or pierce: it is refused.
TEST(Snapping_rules, AnyDistanceLeavesTheMeshEmbedded)
{
  const Triangle_soup tilted =
      mapped(sheet(3, 3), [](const Point_3& p) { return Point_3(p.x(), p.y(), 0.1 + 0.2 * p.y()); });
  const Triangle_soup scene = joined(joined(two_sheets(), cut_open(0.3)), shifted(tilted, 0.4, 0.3));
  std::set<Index> frozen;
  for (const Offending_pair& pair : offending_pairs(scene))
    frozen.insert({pair.first, pair.second});
  std::size_t refused = 0;
  for (const double distance : {0.1, 0.3, 0.6, 0.9, 1.2, 1.7, 3.0}) {
    SCOPED_TRACE(distance);
    const Snapped result = snap(scene, frozen, distance);
    EXPECT_TRUE(new_pairs(result.soup, offending_pairs(result.soup), scene, offending_pairs(scene)).empty());
    refused += result.notes.left_blocked + result.notes.left_folding + result.notes.left_unmanifold;
  }
  EXPECT_GT(refused, 0u);
}

TEST(Joined_at_positions, PiecesHangTogether)
{
  const Triangle_soup apart = joined(sheet(2, 2), shifted(sheet(2, 2), 2, 0));
  ASSERT_EQ(pieces(apart).size(), 2u);
  const Triangle_soup one = merged_at_positions(apart);
  EXPECT_EQ(one.points.size(), 15u);
  ASSERT_EQ(pieces(one).size(), 1u);
  EXPECT_EQ(pieces(one).front().boundary_loops, 1u);
  for (Index t = 0; t < one.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(one.points[one.triangles[t][k]], apart.points[apart.triangles[t][k]]);
}

TEST(Joined_at_positions, WhatIsApartInAPoseStaysApart)
{
  Triangle_soup apart = joined(sheet(2, 2), shifted(sheet(2, 2), 2, 0));
  apart.poses.push_back({"together", apart.points});
  EXPECT_EQ(merged_at_positions(apart).points.size(), 15u);
  apart.poses.push_back({"apart", joined(sheet(2, 2), shifted(sheet(2, 2), 3, 0)).points});
  EXPECT_EQ(merged_at_positions(apart).points.size(), 18u);
}

TEST(Joined_at_positions, WhatDiffersInAttributesStaysApart)
{
  Triangle_soup apart = joined(sheet(1, 1), shifted(sheet(1, 1), 1, 0));
  Attribute quality;
  quality.name = "quality";
  quality.type = Attribute::Type::uint8;
  quality.rows = {0, 1, 2, 3, 1, 5, 9, 7}; // 1 and 4 are at one position, and so are 3 and 6
  apart.vertex_attributes.push_back(quality);
  const Triangle_soup one = merged_at_positions(apart);
  EXPECT_EQ(one.points.size(), 7u);
  ASSERT_EQ(one.vertex_attributes.size(), 1u);
  EXPECT_EQ(one.vertex_attributes[0].rows, (std::vector<unsigned char>{0, 1, 2, 3, 5, 9, 7}));
}

} // namespace
} // namespace selvedge::test
