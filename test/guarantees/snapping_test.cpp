// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What snapping.h promises, on garments whose pieces are pulled apart by a hair, and on real ones.

#include "soup/number_positions.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include "verify/Diagonal.h"
#include "weld/snapping.h"
#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/spatial/Brute_force_index.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace selvedge::test {
namespace {

using Coordinates = std::tuple<double, double, double>;

Coordinates coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

constexpr double s_hair = 4e-5; // a garment's cloth is 5e-4 thick
constexpr unsigned s_seed = 20261;

/// Every vertex on a border of its piece goes into its piece by up to half a hair; the mesh stays embedded.
Triangle_soup pulled_apart(const Triangle_soup& soup, unsigned seed, double hair = s_hair)
{
  std::map<std::pair<Index, Index>, int> uses;
  for (const Index_triple& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  std::set<Index> on_border;
  for (const auto& [edge, count] : uses)
    if (count == 1)
      on_border.insert({edge.first, edge.second});
  std::map<Index, std::vector<Index>> neighbours; // of border vertices, once per face
  for (const Index_triple& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      if (on_border.count(t[k]))
        neighbours[t[k]].insert(neighbours[t[k]].end(), {t[(k + 1) % 3], t[(k + 2) % 3]});

  Triangle_soup result = soup;
  std::mt19937 random(seed);
  for (const auto& [v, around] : neighbours) {
    Kernel::Vector_3 inwards(0, 0, 0);
    for (const Index w : around)
      inwards = inwards + (soup.points[w] - soup.points[v]) / double(around.size());
    const double length = std::sqrt(inwards.squared_length());
    const double share = 0.1 + 0.35 * (random() / 4294967296.0); // portable, unlike <random>'s distributions
    result.points[v] = soup.points[v] + inwards * (share * hair / length);
  }
  return result;
}

Prepared_soup snapped(const Triangle_soup& soup, double distance)
{
  Prepare_options options;
  options.weld_distance = distance;
  return prepare(soup, options);
}

/// Which pieces have a vertex at a position, by their numbers in the original.
using Pieces_at = std::map<Coordinates, std::set<Index>>;

std::vector<Index> piece_of_vertex(const Triangle_soup& soup)
{
  std::vector<Index> piece(soup.points.size());
  for (Index v = 0; v < piece.size(); ++v)
    piece[v] = v;
  const auto root = [&](Index v) {
    while (piece[v] != v)
      v = piece[v] = piece[piece[v]];
    return v;
  };
  for (const auto& [a, b, c] : soup.triangles) {
    piece[root(b)] = root(a);
    piece[root(c)] = root(a);
  }
  for (Index v = 0; v < piece.size(); ++v)
    piece[v] = root(v);
  return piece;
}

Pieces_at pieces_at(const Triangle_soup& soup, const std::vector<Index>& piece_of_triangle)
{
  Pieces_at result;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    for (const Index v : soup.triangles[t])
      result[coordinates(soup.points[v])].insert(piece_of_triangle[t]);
  return result;
}

/// At how many positions of the result pieces meet; expects that at each the same pieces meet as before, so
/// that every border vertex of one side has its partner on the other, at distance zero.
std::size_t expect_partners_kept(const Prepared_soup& prepared, const Simplified_soup& result)
{
  const std::vector<Index> piece_of = piece_of_vertex(prepared.soup);
  std::vector<Index> before, after;
  for (const Index_triple& t : prepared.soup.triangles)
    before.push_back(piece_of[t[0]]);
  for (const Index t : result.triangles)
    after.push_back(before[t]);
  const Pieces_at expected = pieces_at(prepared.soup, before);
  std::size_t meetings = 0, gaps = 0;
  for (const auto& [position, pieces] : pieces_at(result.soup, after)) {
    meetings += pieces.size() > 1;
    gaps += pieces != expected.at(position);
  }
  EXPECT_EQ(gaps, 0u) << "positions at which a piece has lost its partner";
  return meetings;
}

std::size_t left(const Snapping_notes& notes)
{
  return notes.left_ambiguous + notes.left_frozen + notes.left_foreign + notes.left_unmanifold +
         notes.left_folding + notes.left_blocked;
}

std::vector<std::pair<std::string, Triangle_soup>> garments()
{
  return {{"skirt", skirt(6000, 2)},
          {"jacket", garment("jacket", 6000, 2)},
          {"shorts", garment("shorts", 6000, 2)}};
}

TEST(Snapping, FindsEverySeamThatWasPulledApart)
{
  for (const auto& [name, original] : garments()) {
    SCOPED_TRACE(name + ", seed " + std::to_string(s_seed));
    const Triangle_soup apart = pulled_apart(original, s_seed);
    ASSERT_TRUE(is_embedded(apart));
    const std::vector<Index> positions = number_positions(original.points);
    std::set<Index> seams; // positions where vertices were one
    std::size_t vanished = 0;
    for (Index v = 0; v < positions.size(); ++v)
      if (positions[v] != v) {
        ++vanished;
        seams.insert(positions[v]);
      }
    ASSERT_GT(seams.size(), 50u);

    const Prepared_soup prepared = snapped(apart, s_hair);
    EXPECT_EQ(prepared.positions, positions) << "what was one is one again, and nothing else is";
    EXPECT_EQ(prepared.snapping.snaps.size(), vanished);
    EXPECT_EQ(prepared.snapping.snapped, seams.size() + vanished);
    EXPECT_EQ(left(prepared.snapping), 0u);
    EXPECT_LE(prepared.snapping.largest_distance, s_hair);

    const Prepared_soup control = snapped(apart, 0);
    EXPECT_TRUE(control.snapping.snaps.empty());
    EXPECT_NE(control.positions, positions);
  }
}

TEST(Snapping, SeamsStayClosedAtEveryRatio)
{
  for (const auto& [name, original] : garments()) {
    const Prepared_soup prepared = snapped(pulled_apart(original, s_seed + 1), s_hair);
    for (const double ratio : {0.3, 0.1, 0.05}) {
      SCOPED_TRACE(name + " at " + std::to_string(ratio) + ", seed " + std::to_string(s_seed + 1));
      const Simplified_soup result = simplify_soup(prepared, to_ratio(ratio));
      EXPECT_GT(expect_partners_kept(prepared, result), 10u);
      const Verification verification = verify(result.soup, prepared.soup, prepared.offending_pairs);
      EXPECT_TRUE(verification.embedded());
      EXPECT_TRUE(verification.same_topology()) << "pieces are separate again as they came";
    }
  }
}

// The control of the test above: where nothing was sewn, vertices go whose partners stay.
// Two curved sheets with a narrow gap in which a third stands. One is smooth, the other has ripples.
Triangle_soup seam_that_stays_open()
{
  const auto height = [](const Point_3& p) { return 0.02 * p.y() * p.y(); };
  const auto curved = [&](const Point_3& p) { return Point_3(p.x(), p.y(), height(p)); };
  const auto rippled = [&](const Point_3& p) {
    return Point_3(p.x(), p.y(), height(p) + (p.x() > 3.5 ? 0.1 * std::sin(2 * p.y()) : 0));
  };
  const Triangle_soup between =
      soup({{3.0625, -50, -50}, {3.0625, 100, -50}, {3.0625, 25, 100}}, {{0, 1, 2}});
  return joined(joined(mapped(sheet(3, 40), curved), mapped(moved(sheet(3, 40), 3.125, 0, 0), rippled)),
                between);
}

TEST(Snapping, SidesThatStayApartLeaveTogether)
{
  Prepared_soup prepared = snapped(seam_that_stays_open(), 0.125);
  EXPECT_EQ(prepared.snapping.snapped, 0u);
  EXPECT_EQ(prepared.snapping.left_blocked, 82u);
  EXPECT_EQ(prepared.tied.size(), 41u);
  const auto sides = [&](const Simplify_options& options) {
    const Simplified_soup result = simplify_soup(prepared, options);
    EXPECT_EQ(result.report.left_alone, 0u);
    EXPECT_TRUE(is_embedded(result.soup));
    std::array<std::set<double>, 2> places; // along the seam
    for (const Point_3& p : result.soup.points)
      for (const int side : {0, 1})
        if (p.x() == (side == 0 ? 3 : 3.125))
          places[side].insert(p.y());
    return places;
  };
  Simplify_options options = to_ratio(0.2);
  Simplify_options in_cells = options;
  in_cells.faces_per_cell = 100;
  for (const Simplify_options& each : {options, in_cells}) {
    const auto [left, right] = sides(each);
    EXPECT_LT(left.size(), 35u);
    EXPECT_EQ(left, right);
  }
  prepared.tied.clear();
  const auto [left, right] = sides(options);
  EXPECT_NE(left, right) << "as strangers, they go their own ways";
}

/// The same without the sheet in the gap, which is from x = 3 to 3.125.
Triangle_soup open_seam()
{
  Triangle_soup soup = seam_that_stays_open();
  soup.triangles.pop_back();
  return soup;
}

Prepare_options with_seams(Open_seams open_seams)
{
  Prepare_options options;
  options.open_seams = open_seams;
  return options;
}

/// Returns the vertices in a plane of constant x, along y.
std::vector<Point_3> chain_at(const Triangle_soup& soup, double x)
{
  std::vector<Point_3> chain;
  std::copy_if(soup.points.begin(), soup.points.end(), std::back_inserter(chain),
               [&](const Point_3& p) { return p.x() == x; });
  std::sort(chain.begin(), chain.end(), [](const auto& p, const auto& q) { return p.y() < q.y(); });
  return chain;
}

double distance_to_chain(const Point_3& p, const std::vector<Point_3>& chain)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < chain.size(); ++i)
    least = std::min(least, CGAL::squared_distance(p, Kernel::Segment_3(chain[i - 1], chain[i])));
  return std::sqrt(least);
}

/// Returns how far vertices at the plane x = left are at most from the border at x = right, and the other way
/// round.
double width_of_gap(const Triangle_soup& soup, double left, double right)
{
  const std::vector<Point_3> sides[] = {chain_at(soup, left), chain_at(soup, right)};
  double widest = 0;
  for (const int side : {0, 1})
    for (const Point_3& p : sides[side])
      widest = std::max(widest, distance_to_chain(p, sides[1 - side]));
  return widest;
}

TEST(Snapping, OpenSeamsThatAreHeldGetNoWider)
{
  constexpr double gap = 0.125;
  for (const double ratio : {0.2, 0.1}) {
    const Prepared_soup held = prepare(open_seam(), with_seams(Open_seams::hold));
    EXPECT_EQ(held.tied.size(), 41u);
    EXPECT_EQ(held.snapping.distance, 0);
    EXPECT_EQ(held.soup.points, open_seam().points);
    const Simplified_soup result = simplify_soup(held, to_ratio(ratio));
    EXPECT_EQ(result.report.left_alone, 0u);
    EXPECT_LE(width_of_gap(result.soup, 3, 3.125), gap * (1 + 1e-12));
    const Prepared_soup ignored = prepare(open_seam(), with_seams(Open_seams::ignore));
    EXPECT_TRUE(ignored.tied.empty());
    EXPECT_GT(width_of_gap(simplify_soup(ignored, to_ratio(ratio)).soup, 3, 3.125), gap);
  }
}

TEST(Snapping, BordersDriftLessWhereTheyFaceEdges)
{
  // The sides of the gap have 41 and 28 vertices.
  const double gap = 1 / 64.;
  const auto curved = [&](double from, double stretch) {
    return [=](const Point_3& p) {
      const double y = stretch * p.y();
      return Point_3(from + p.x(), y, 0.02 * y * y);
    };
  };
  const Triangle_soup soup =
      joined(mapped(sheet(3, 40), curved(0, 1)), mapped(sheet(3, 27), curved(3 + gap, 40 / 27.)));
  Prepared_soup prepared = snapped(soup, 1.5 * gap);
  EXPECT_EQ(prepared.tied.size(), 0u);
  EXPECT_EQ(prepared.facing.size(), 41u + 28 - 1)
      << "all but a corner from which both surfaces lead the same way";
  const Simplify_options options = to_ratio(0);
  const auto width = [&](double max_border_drift) {
    Simplify_options limited = options;
    limited.max_border_drift = max_border_drift;
    return width_of_gap(simplify_soup(prepared, limited).soup, 3, 3 + gap);
  };
  const double drift = 0.1 * options.max_border_drift * internal::diagonal(soup.points);
  EXPECT_LE(width(options.max_border_drift), 2 * gap + 2 * drift);
  prepared.facing.clear();
  EXPECT_GT(width(options.max_border_drift), 2 * gap + 2 * drift);
}

TEST(Snapping, PairsGoByWhatBothCost)
{
  // The left sheet is flat. The right one has ripples in its upper half.
  const auto rippled = [](const Point_3& p) {
    return Point_3(p.x(), p.y(), p.y() > 20 ? 0.1 * std::sin(2 * p.y()) : 0);
  };
  const Triangle_soup soup = joined(sheet(3, 40), mapped(moved(sheet(3, 40), 3.125, 0, 0), rippled));
  const Prepared_soup prepared = prepare(soup, with_seams(Open_seams::hold));
  ASSERT_EQ(prepared.tied.size(), 41u);
  const Simplified_soup result = simplify_soup(prepared, to_ratio(0.6));
  std::array<std::size_t, 2> left{0, 0}; // of the 20 lower and 20 upper ones
  for (const Point_3& p : result.soup.points)
    if (p.x() == 3 && p.y() != 20)
      ++left[p.y() > 20];
  EXPECT_LT(left[0], 15u);
  EXPECT_GE(left[1], 18u) << "ten, if the cheaper side decides";
}

// Whichever vertex the mesh keeps of the two that merge.
TEST(Snapping, TheLimitOfDriftStaysWithThePlaceOfItsVertex)
{
  const Triangle_soup soup =
      mapped(sheet(3, 40), [](const Point_3& p) { return Point_3(p.x(), p.y(), 0.02 * p.y() * p.y()); });
  Prepared_soup prepared = prepare(soup);
  for (Index v = 0; v < soup.points.size(); ++v)
    if (soup.points[v].x() == 3 && std::fmod(soup.points[v].y(), 8) < 4)
      prepared.facing.push_back(v);
  const Simplify_options options = to_ratio(0);
  const auto border = chain_at(simplify_soup(prepared, options).soup, 3);
  double of_facing = 0, of_others = 0;
  for (const Point_3& p : chain_at(soup, 3)) {
    double& largest = std::fmod(p.y(), 8) < 4 ? of_facing : of_others;
    largest = std::max(largest, distance_to_chain(p, border));
  }
  const double limit = 0.1 * options.max_border_drift * internal::diagonal(soup.points);
  EXPECT_LE(of_facing, limit * (1 + 1e-9));
  EXPECT_GT(of_others, limit);
}

// Moves a sheet along x, stretches it along y, and lays it in waves.
auto waved(double from, double stretch)
{
  return [=](const Point_3& p) {
    const double y = stretch * p.y();
    return Point_3(from + p.x(), y, 0.8 * std::sin(y / 2));
  };
}

TEST(Snapping, BordersDriftLessWherePartnersDoNotFaceEachOther)
{
  // The sides of the gap have 41 and 44 vertices: partners are up to half an edge apart along the seam.
  const double gap = 1 / 64.;
  const Triangle_soup soup =
      joined(mapped(sheet(3, 40), waved(0, 1)), mapped(sheet(3, 43), waved(3 + gap, 40 / 43.)));
  Prepared_soup prepared = prepare(soup, with_seams(Open_seams::hold));
  EXPECT_EQ(prepared.tied.size(), 41u);
  for (const auto& [a, b] : prepared.tied) {
    const double apart = std::sqrt(CGAL::squared_distance(prepared.soup.points[a], prepared.soup.points[b]));
    for (const Index v : {a, b})
      EXPECT_EQ(std::count(prepared.facing.begin(), prepared.facing.end(), v), apart > 2.2 * gap) << apart;
  }
  const auto width = [&] {
    double widest = 0;
    for (const double ratio : {0.3, 0.2, 0.15, 0.1, 0.05})
      widest = std::max(widest, width_of_gap(simplify_soup(prepared, to_ratio(ratio)).soup, 3, 3 + gap));
    return widest;
  };
  const double drift = 0.1 * Simplify_options().max_border_drift * internal::diagonal(soup.points);
  EXPECT_LE(width(), gap + 2 * drift);
  prepared.facing.clear();
  EXPECT_GT(width(), gap + 2 * drift);
}

TEST(Snapping, SeamsWithOtherNumbersOfVerticesAreHeldByTheirEdges)
{
  const double gap = 1 / 64.;
  const Triangle_soup soup =
      joined(mapped(sheet(8, 39), waved(0, 1)), mapped(sheet(8, 52), waved(8 + gap, 39 / 52.)));
  const auto width = [&](const Prepared_soup& prepared) {
    double widest = 0;
    for (const double ratio : {0.3, 0.2, 0.1, 0.05, 0.03})
      widest = std::max(widest, width_of_gap(simplify_soup(prepared, to_ratio(ratio)).soup, 8, 8 + gap));
    return widest;
  };
  const double drift = 0.1 * Simplify_options().max_border_drift * internal::diagonal(soup.points);
  Prepared_soup prepared = prepare(soup, with_seams(Open_seams::hold));
  EXPECT_EQ(prepared.border_gaps.clear_length, std::nullopt);
  EXPECT_EQ(prepared.facing.size() + 2 * prepared.tied.size(), 40u + 53);
  const double wide = width_of_gap(soup, 8, 8 + gap);
  EXPECT_LE(width(prepared), wide + 2 * drift);
  EXPECT_GT(width(prepare(soup)), wide + 2 * drift);
}

TEST(Snapping, GapsAreHeldOrClosedUpToALengthThatIsEitherFoundOrGiven)
{
  for (const Open_seams open_seams : {Open_seams::hold, Open_seams::weld}) {
    Prepare_options options = with_seams(open_seams);
    options.weld_distance = 0.125;
    EXPECT_THROW(prepare(open_seam(), options), Argument_error);
  }
  EXPECT_TRUE(prepare(open_seam(), with_seams(Open_seams::measure)).tied.empty());
  EXPECT_EQ(prepare(open_seam(), with_seams(Open_seams::measure)).border_gaps.within_clear_length, 82u);
  EXPECT_GT(prepare(open_seam(), with_seams(Open_seams::weld)).snapping.snapped, 0u);
}

TEST(Snapping, WhatIsHeldIsKnownToTheMeshItselfAndTheOwnLoopOnly)
{
  const auto gaps = [](const Triangle_soup& soup, const Triangle_soup& obstacle = {}) {
    const Prepared_soup prepared = prepare(soup, with_seams(Open_seams::hold), obstacle);
    return std::pair(prepared.tied.size(), prepared.facing.size());
  };
  using Gaps = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(gaps(joined(sheet(3, 40), moved(sheet(3, 40), 3.125, 0, 0))), Gaps(41, 0));
  EXPECT_EQ(gaps(joined(sheet(3, 40), moved(sheet(3, 40), 3.75, 0, 0))), Gaps(0, 0)) << "no clear length";
  EXPECT_EQ(gaps(sheet(3, 40), moved(sheet(3, 40), 3.125, 0, 0)), Gaps(0, 0)) << "an obstacle has no seams";

  Triangle_soup posed = open_seam();
  posed.poses.push_back({"later", moved(posed, 0, 0, 1).points});
  EXPECT_EQ(gaps(posed), Gaps(41, 0));
  EXPECT_THROW(prepare(posed, with_seams(Open_seams::weld)), Argument_error);

  Prepared_soup prepared = prepare(open_seam(), with_seams(Open_seams::hold));
  Simplify_options options = to_ratio(0.1);
  options.loop = Collapse_loop::cgal;
  const Simplified_soup held = simplify_soup(prepared, options);
  EXPECT_EQ(held.report.left_alone, 0u);
  prepared.tied.clear();
  EXPECT_EQ(simplify_soup(prepared, options).soup.triangles, held.soup.triangles);
}

TEST(Snapping, WhatHoldsAGapIsAReasonOfItsOwn)
{
  Prepared_soup prepared = prepare(open_seam(), with_seams(Open_seams::hold));
  const auto held_back = [&] {
    return simplify_soup(prepared, to_ratio(0)).report.hindrances[Hindrance::gap];
  };
  EXPECT_EQ(held_back(), 0u);
  const auto tied = prepared.tied;
  for (std::size_t i = 0; i < tied.size(); ++i) // so that partners of neighbours are none
    prepared.tied[i].second = tied[2 * i % tied.size()].second;
  EXPECT_GT(held_back(), 0u);
}

TEST(Snapping, ATiedVertexStaysWhereItsPartnerCannotFollow)
{
  Prepared_soup prepared = snapped(seam_that_stays_open(), 0.125);
  auto& tied = prepared.tied;
  std::set<double> places; // along the seam, of every second pair: their neighbours are free
  for (std::size_t i = tied.size(); i-- > 0;)
    if (const double y = prepared.soup.points[tied[i].first].y(); std::fmod(y, 2) == 0)
      places.insert(y);
    else
      tied.erase(tied.begin() + i);
  ASSERT_EQ(places.size(), tied.size());
  const Simplified_soup result = simplify_soup(prepared, to_ratio(0.15));
  EXPECT_LE(result.report.left_alone, 1u)
      << "one partner is refused by the guard; without ties, ten stay alone";
  std::size_t left = 0;
  for (const Point_3& p : result.soup.points)
    left += p.x() == 3 && places.count(p.y()) != 0;
  EXPECT_LT(left, places.size()) << "pairs go where both can";
}

TEST(Snapping, WithoutItSeamsGape)
{
  const Triangle_soup original = skirt(6000, 2);
  const std::vector<Index> positions = number_positions(original.points);
  const auto count_lone = [&](double distance) {
    const Prepared_soup prepared = snapped(pulled_apart(original, s_seed + 1), distance);
    const Simplified_soup result = simplify_soup(prepared, to_ratio(0.1));
    std::vector<std::set<Index>> left_at(positions.size());
    for (const Index_triple& corners : result.corners)
      for (const Index corner : corners) {
        const Index v = original.triangles[corner / 3][corner % 3];
        left_at[positions[v]].insert(v);
      }
    std::vector<std::size_t> were_at(positions.size(), 0);
    for (const Index position : positions)
      ++were_at[position];
    std::size_t lone = 0;
    for (Index position = 0; position < were_at.size(); ++position)
      lone += !left_at[position].empty() && left_at[position].size() < were_at[position];
    return lone;
  };
  EXPECT_EQ(count_lone(s_hair), 0u);
  EXPECT_GT(count_lone(0), 10u);
}

TEST(Snapping, StaysEmbeddedAfterEverySnap)
{
  const Triangle_soup apart = pulled_apart(garment("shorts", 1500, 1), s_seed + 2);
  const Prepared_soup prepared = snapped(apart, s_hair);
  std::vector<Index> positions = number_positions(apart.points);
  Triangle_soup soup = apart;
  ASSERT_GT(prepared.snapping.snaps.size(), 20u);
  std::size_t count = 0;
  for (const Snap& snap : prepared.snapping.snaps) {
    const Point_3 place = soup.points[snap.to];
    for (Index v = 0; v < positions.size(); ++v)
      if (positions[v] == snap.from) {
        soup.points[v] = place;
        positions[v] = snap.to;
      }
    ASSERT_TRUE(is_embedded(soup)) << "after snap " << ++count << ", seed " << s_seed + 2;
  }
  for (Index v = 0; v < soup.points.size(); ++v)
    EXPECT_EQ(soup.points[v], prepared.soup.points[v]);
}

TEST(Snapping, IndexDoesNotMatter)
{
  for (const auto& [name, original] : garments()) {
    SCOPED_TRACE(name + ", seed " + std::to_string(s_seed + 3));
    Triangle_soup fast = pulled_apart(original, s_seed + 3), slow = fast;
    // Far enough to reach other seams and the next layer, so that much is refused.
    for (const double distance : {0.5 * s_hair, 1e-3, 1e-2}) {
      std::vector<Index> fast_positions = number_positions(fast.points), slow_positions = fast_positions;
      const std::vector<char> is_frozen(fast.triangles.size(), false);
      const Snapping_notes a = snap_borders(fast, fast_positions, is_frozen, distance).notes;
      const Snapping_notes b =
          snap_borders<Brute_force_index>(slow, slow_positions, is_frozen, distance).notes;
      ASSERT_EQ(a.snaps.size(), b.snaps.size());
      for (std::size_t i = 0; i < a.snaps.size(); ++i) {
        EXPECT_EQ(a.snaps[i].from, b.snaps[i].from);
        EXPECT_EQ(a.snaps[i].to, b.snaps[i].to);
      }
      EXPECT_EQ(fast_positions, slow_positions);
      EXPECT_EQ(fast.points, slow.points);
      EXPECT_EQ(left(a), left(b));
      EXPECT_EQ(a.left_blocked, b.left_blocked);
      EXPECT_EQ(a.near_without_edge, b.near_without_edge);
      EXPECT_TRUE(is_embedded(fast)) << "at " << distance;
    }
  }
}

TEST(Snapping, MakesNoNewPosition)
{
  const Triangle_soup apart = pulled_apart(skirt(3000, 2), s_seed + 4);
  const Prepared_soup prepared = snapped(apart, s_hair);
  std::set<Coordinates> known;
  for (const Point_3& point : apart.points)
    known.insert(coordinates(point));
  std::size_t moved = 0;
  for (Index v = 0; v < apart.points.size(); ++v) {
    EXPECT_TRUE(known.count(coordinates(prepared.soup.points[v])));
    moved += prepared.soup.points[v] != apart.points[v];
  }
  EXPECT_EQ(moved, prepared.snapping.snaps.size()) << "no two vertices shared a position";
  EXPECT_EQ(prepared.soup.triangles, apart.triangles);
  EXPECT_EQ(prepared.soup.uvs.of_triangle, apart.uvs.of_triangle);
  EXPECT_EQ(prepared.soup.uvs.values, apart.uvs.values);
}

// Coordinates that are floats before are floats afterwards.
TEST(Snapping, AfterRounding)
{
  const Triangle_soup apart = pulled_apart(skirt(3000, 2), s_seed + 5);
  Prepare_options options;
  options.round_to_float32 = true;
  options.weld_distance = s_hair;
  const Prepared_soup prepared = prepare(apart, options);
  EXPECT_GT(prepared.snapping.snapped, 50u);
  EXPECT_TRUE(is_embedded(prepared.soup));
  for (const Point_3& p : prepared.soup.points)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(double(float(p[axis])), p[axis]);
}

TEST(Snapping, WhatTheUserKeepsStays)
{
  Triangle_soup soup = joined(sheet(6, 6), moved(sheet(6, 6), 6 + 0x1p-10, 0, 0));
  soup.groups.names = {"a", "b"};
  soup.groups.of_triangle.assign(soup.triangles.size(), 0);
  std::fill(soup.groups.of_triangle.begin() + std::ptrdiff_t(soup.triangles.size() / 2),
            soup.groups.of_triangle.end(), 1);
  const std::size_t half = soup.points.size() / 2;
  const auto snaps = [&](const Simplify_intent& intent) {
    Prepare_options options;
    options.weld_distance = 0x1p-9;
    keep_from_snapping(options, intent);
    const Prepared_soup prepared = prepare(soup, options);
    return std::pair(prepared.snapping.snaps.size(),
                     std::equal(soup.points.begin() + std::ptrdiff_t(half), soup.points.end(),
                                prepared.soup.points.begin() + std::ptrdiff_t(half)));
  };
  EXPECT_GT(snaps({}).first, 0u) << "the control";
  Simplify_intent kept, locked, vertex;
  kept.kept = {"b"};
  locked.locked = {"b"};
  for (Index v = Index(half); v < soup.points.size(); ++v)
    vertex.locked_vertices.push_back(v);
  for (const Simplify_intent& intent : {kept, locked, vertex})
    EXPECT_TRUE(snaps(intent).second);
  Prepare_options unknown;
  unknown.vertices_that_stay = {Index(soup.points.size())};
  EXPECT_THROW(prepare(soup, unknown), Argument_error);
}

TEST(Snapping, DistanceIsChecked)
{
  for (const double distance : {-1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(snapped(sheet(2, 2), distance), Error) << distance;
}

struct Real
{
  std::string file;
  double distance; // as data/README.md says: 1 % and 8 % of the median edge
};

void PrintTo(const Real& real, std::ostream* stream)
{
  *stream << real.file;
}

class Real_garment : public testing::TestWithParam<Real>
{
};

TEST_P(Real_garment, SeamsCloseAndStayClosed)
{
  const std::string path = std::string(SELVEDGE_SHARED_DATA "/garments/") + GetParam().file;
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "not there: " << path;
  const Triangle_soup original = read_mesh(path).soup;
  const Prepared_soup prepared = snapped(original, GetParam().distance);
  const Snapping_notes& notes = prepared.snapping;
  EXPECT_GT(notes.snapped, notes.border_vertices / 4);
  EXPECT_EQ(notes.snapped + left(notes), notes.partnered);
  const std::vector<Offending_pair> before = offending_pairs(original);
  EXPECT_TRUE(new_pairs(prepared.soup, offending_pairs(prepared.soup), original, before).empty());
  for (const double ratio : {0.3, 0.1, 0.05}) {
    SCOPED_TRACE(ratio);
    const Simplified_soup result = simplify_soup(prepared, to_ratio(ratio));
    EXPECT_GT(expect_partners_kept(prepared, result), 10u);
    EXPECT_TRUE(is_embedded(result.soup));
  }
}

INSTANTIATE_TEST_SUITE_P(Snapping, Real_garment,
                         testing::Values(Real{"multilayer_skirt.obj", 1.1e-4},
                                         Real{"dress_14_pieces_uv.obj", 5.6e-4}),
                         [](const auto& real) {
                           return real.param.file.substr(0, real.param.file.find('.'));
                         });

} // namespace
} // namespace selvedge::test
