// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Pieces that a result joins where they meet, or numbers by their positions.

#include "support/matched_pieces.h"
#include "support/reduction.h"

#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace selvedge {
namespace {

using namespace test;

// As files do that have no vertex numbers, or cut a texture's seams: both ways round.
TEST(MatchPieces, ByPositionsWhereVerticesAreNumberedDifferently)
{
  Triangle_soup result = unshared(coarse());
  EXPECT_EQ(way(match_pieces(result, fine())), Matched_by::positions);
  EXPECT_EQ(way(match_pieces(fine(), unshared(fine()))), Matched_by::positions);
  const Piece_matching matching = match_pieces(result, fine());
  EXPECT_EQ(matching.matches.size(), 4u);

  // What is missing there is missing all the same.
  result = unshared(without_piece(coarse(), 2));
  EXPECT_EQ(mismatches(result, fine()), Mismatches{Mismatch::missing});
  result = unshared(coarse());
  result.triangles.erase(result.triangles.begin() + 10);
  const Piece_matching holed = match_pieces(result, fine());
  EXPECT_EQ(mismatches(holed), Mismatches{Mismatch::topology});
}

/// A band of `squares` × 1 squares between heights 8 and 9, on the border of `layer(squares, 0)`.
Triangle_soup band(Index squares)
{
  const double side = 8.0 / squares;
  return mapped(sheet(squares, 1), [&](const Point_3& p) { return Point_3(side * p.x(), 8 + p.y(), 0); });
}

TEST(MatchPieces, OfPiecesThatAreJoinedWhereTheyMeet)
{
  const Triangle_soup original = joined(layer(8, 0), band(8));
  const Triangle_soup apart = joined(layer(4, 0), band(4));
  EXPECT_EQ(way(match_pieces(apart, original)), Matched_by::vertices);
  // The same with one vertex at each position, as an STL file has it.
  Triangle_soup result = layer(4, 0);
  const Triangle_soup upper = band(4);
  for (const Index_triple& triangle : upper.triangles) {
    Index_triple corners;
    for (int place = 0; place < 3; ++place) {
      const Point_3& point = upper.points[triangle[place]];
      const auto found = std::find(result.points.begin(), result.points.end(), point);
      corners[place] = Index(found - result.points.begin());
      if (found == result.points.end())
        result.points.push_back(point);
    }
    result.triangles.push_back(corners);
  }
  ASSERT_EQ(pieces(result).size(), 1u);
  const Piece_matching matching = match_pieces(result, original);
  EXPECT_EQ(way(matching), Matched_by::positions);
  EXPECT_EQ(matching.matches.at(0).of_original, (std::vector<Index>{0, 1}));

  // Without the band the kind of the whole is the same, but a piece is missing.
  EXPECT_EQ(mismatches(layer(4, 0), original), Mismatches{Mismatch::missing});
}

TEST(MatchPieces, OfBordersThatWereJoinedNeedTheDistance)
{
  const double gap = 0.01;
  const Triangle_soup original = joined(layer(8, 0), moved(band(8), 0, gap, 0));
  // The band's lower border went to the layer's; then all was joined where it meets.
  Triangle_soup result = joined(layer(4, 0), band(4));
  for (Index_triple& triangle : result.triangles)
    for (Index& vertex : triangle)
      vertex = Index(std::find(result.points.begin(), result.points.end(), result.points[vertex]) -
                     result.points.begin());
  result = mapped(result, [&](const Point_3& p) { return p.y() == 9 ? Point_3(p.x(), 9 + gap, 0) : p; });
  ASSERT_EQ(pieces(result).size(), 1u);

  const Piece_matching refused = match_pieces(result, original);
  ASSERT_EQ(mismatches(refused), Mismatches{Mismatch::topology});
  EXPECT_NE(refused.mismatches[0].message.find("give the weld distance"), std::string::npos);
  Verify_options options;
  options.weld_distance = 0.02;
  EXPECT_EQ(way(match_pieces(result, original, options)), Matched_by::borders);
  for (const double too_near : {0.004, 0.006, 0.0099}) {
    options.weld_distance = too_near;
    EXPECT_EQ(mismatches(match_pieces(result, original, options)), Mismatches{Mismatch::topology});
  }
  options.weld_distance = 0.02;
  // What else is wrong is found with it as well.
  EXPECT_EQ(mismatches(match_pieces(layer(4, 0), original, options)), Mismatches{Mismatch::missing});
}

// Two faces lie almost on each other, and snapping has moved one of them onto the other.
TEST(MatchPieces, ThatWereSnappedOntoAnotherKeepTheirNames)
{
  const Triangle_soup face = soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const auto with_materials = [](Triangle_soup soup, const std::vector<Index>& of_triangle) {
    soup.materials.names = {"wool", "silk"};
    soup.materials.of_triangle = of_triangle;
    return soup;
  };
  const Triangle_soup original = with_materials(joined(face, moved(face, 0, 0, 1e-4)), {0, 1});
  Triangle_soup snapped = original;
  snapped.points[1] = original.points[4]; // one vertex stays
  snapped.points[2] = original.points[5];
  Verify_options options;
  options.weld_distance = 1e-3;
  for (const bool is_all : {false, true}) {
    if (is_all)
      snapped.points[0] = original.points[3];
    const Piece_matching matching = match_pieces(snapped, original, options);
    ASSERT_TRUE(matching.is_complete());
    for (const Piece_match& match : matching.matches)
      EXPECT_EQ(match.of_result, match.of_original);
    // What is wrong is still found: names that are, and a piece that is gone.
    EXPECT_EQ(mismatches(match_pieces(with_materials(snapped, {0, 0}), original, options)),
              Mismatches{Mismatch::name});
    Triangle_soup one = snapped;
    one.triangles.pop_back();
    one.materials.of_triangle.pop_back();
    EXPECT_FALSE(match_pieces(one, original, options).is_complete());
  }
}

// Three borders in a row come to one: the farthest has gone two ways.
TEST(MatchPieces, OfBordersThatWereJoinedOverAThird)
{
  const double gap = 0.01;
  const auto corner = [](double x, double y, double to_x, double to_y) {
    return soup({{x, y, 0}, {to_x, to_y, 0}, {to_x - to_y, to_y + to_x, 0}}, {{0, 1, 2}});
  };
  const Triangle_soup first = corner(0, 0, 3, 0);
  const Triangle_soup original = joined(joined(first, corner(-gap, 0, -3, 0)), corner(-2 * gap, 0, -3, -4));
  Triangle_soup result = original;
  for (Index_triple& triangle : result.triangles)
    triangle[0] = 0;
  ASSERT_EQ(pieces(result).size(), 1u);
  Verify_options options;
  options.weld_distance = 0.011;
  EXPECT_EQ(way(match_pieces(result, original, options)), Matched_by::borders);
  options.weld_distance = 0.009;
  EXPECT_FALSE(match_pieces(result, original, options).is_complete());
}

// Every border vertex of a strip is in reach of all of the next one. The ways from the first strip to the
// last are too many to take each.
TEST(MatchPieces, OfBordersThatManyWaysLeadTo)
{
  const double gap = 0.01;
  const Triangle_soup strip = stretched(sheet(3, 1), gap / 100);
  Triangle_soup result = strip;
  for (int k = 1; k < 20; ++k)
    result = joined(result, moved(strip, 0, 0, k * gap));
  Verify_options options;
  options.weld_distance = 1.2 * gap;
  const Triangle_soup original = joined(result, moved(strip, 0, 0, 20 * gap));
  EXPECT_EQ(mismatches(match_pieces(result, original, options)), Mismatches{Mismatch::missing});
}

// ---- Pieces without vertices of their own, in files that number vertices by position

/// A closed ring of 12 × 8 squares.
Triangle_soup torus()
{
  constexpr Index around = 12, across = 8;
  Triangle_soup result;
  for (Index x = 0; x < around; ++x)
    for (Index y = 0; y < across; ++y) {
      const double u = 2 * M_PI * x / around, v = 2 * M_PI * y / across, r = 3 + std::cos(v);
      result.points.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
      const Index a = x * across + y, b = x * across + (y + 1) % across;
      const Index c = (x + 1) % around * across + (y + 1) % across, d = (x + 1) % around * across + y;
      result.triangles.push_back({a, c, b});
      result.triangles.push_back({a, d, c});
    }
  return result;
}

/// The same cut into patches of some 2 to 20 faces that grow from random faces, each with vertices of its
/// own.
Triangle_soup in_patches(const Triangle_soup& whole, Index patches, std::mt19937& random)
{
  constexpr Index none = Index(-1);
  std::vector<Index> patch(whole.triangles.size(), none);
  for (Index i = 0; i < patches; ++i)
    patch[random() % patch.size()] = i;
  const auto common = [&](Index t, Index u) {
    const Index_triple &a = whole.triangles[t], &b = whole.triangles[u];
    return std::count_if(a.begin(), a.end(), [&](Index v) { return std::count(b.begin(), b.end(), v) > 0; });
  };
  while (std::count(patch.begin(), patch.end(), none) > 0)
    for (Index t = 0; t < patch.size(); ++t)
      for (Index u = 0; u < patch.size(); ++u)
        if (patch[t] != none && patch[u] == none && common(t, u) == 2 && random() % 4 == 0)
          patch[u] = patch[t];
  Triangle_soup result;
  for (Index i = 0; i < patches; ++i) {
    std::vector<Index> number(whole.points.size(), none);
    for (Index t = 0; t < patch.size(); ++t)
      if (patch[t] == i) {
        Index_triple corners = whole.triangles[t];
        for (Index& v : corners) {
          if (number[v] == none) {
            number[v] = Index(result.points.size());
            result.points.push_back(whole.points[v]);
          }
          v = number[v];
        }
        result.triangles.push_back(corners);
      }
  }
  return result;
}

/// With one vertex at each position, as an STL file has it.
Triangle_soup by_position(const Triangle_soup& soup)
{
  Triangle_soup result;
  for (Index_triple corners : soup.triangles) {
    for (Index& v : corners) {
      const Point_3& point = soup.points[v];
      v = Index(std::find(result.points.begin(), result.points.end(), point) - result.points.begin());
      if (v == result.points.size())
        result.points.push_back(point);
    }
    result.triangles.push_back(corners);
  }
  return result;
}

// Small patches have all of their vertices in common with others, so that no face shows by its corners whose
// it is. All of them are there, and each of them is missed: of a closed surface, of a sheet, at whose border
// a patch may fill a notch, and where a patch lies on another.
TEST(MatchPieces, OfPatchesWithoutVerticesOfTheirOwn)
{
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Triangle_soup original = in_patches(seed % 2 == 0 ? torus() : sheet(8, 8), 10 + random() % 40, random);
    if (seed % 3 == 0) // this one lies on another, and its sides agree
      original = joined(original, in_patches(sheet(2, 2), 1, random));
    EXPECT_EQ(mismatches(by_position(original), original), Mismatches{});
    for (Index i = 0; i < pieces(original).size(); ++i)
      EXPECT_NE(mismatches(by_position(without_piece(original, i)), original), Mismatches{}) << "piece " << i;
  }
}

TEST(MatchPieces, OfReducedPatchesWithoutVerticesOfTheirOwn)
{
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Triangle_soup original = in_patches(torus(), 10 + random() % 40, random);
    const Triangle_soup result = simplify_soup(prepare(original), to_ratio(0.4)).soup;
    EXPECT_LT(result.triangles.size(), original.triangles.size());
    EXPECT_EQ(mismatches(by_position(result), original), Mismatches{});
    for (Index i = 0; i < pieces(result).size(); ++i)
      EXPECT_NE(mismatches(by_position(without_piece(result, i)), original), Mismatches{}) << "piece " << i;
  }
}

// Gaps part the patches, and snapping has closed them before the vertices were numbered by position.
TEST(MatchPieces, OfPatchesWhoseGapsWereClosed)
{
  const double gap = 1e-3;
  Verify_options options;
  options.weld_distance = 2 * gap;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> offset(-gap / 2, gap / 2);
    const Triangle_soup original =
        mapped(in_patches(torus(), 10 + random() % 40, random), [&](const Point_3& p) {
          return Point_3(p.x() + offset(random), p.y() + offset(random), p.z() + offset(random));
        });
    Prepare_options closing;
    closing.weld_distance = options.weld_distance;
    const Triangle_soup result =
        simplify_soup(prepare(original, closing), to_ratio(seed % 2 == 0 ? 1 : 0.4)).soup;
    const auto mismatches_of = [&](const Triangle_soup& soup) {
      return mismatches(match_pieces(by_position(soup), original, options));
    };
    EXPECT_EQ(mismatches_of(result), Mismatches{});
    for (Index i = 0; i < pieces(result).size(); ++i)
      EXPECT_NE(mismatches_of(without_piece(result, i)), Mismatches{}) << "piece " << i;
  }
}

/// Gives corners at one position the first vertex there.
Triangle_soup with_first_vertices(Triangle_soup soup)
{
  for (Index_triple& corners : soup.triangles)
    for (Index& v : corners)
      v = Index(std::find(soup.points.begin(), soup.points.end(), soup.points[v]) - soup.points.begin());
  return soup;
}

/// What is wrong with a result whose vertices are one at each position, where its file has them like this.
Mismatches mismatches_in_file(const Triangle_soup& file, const Triangle_soup& original)
{
  Verify_options options;
  options.triangles_in_file = file.triangles;
  return mismatches(match_pieces(with_first_vertices(file), original, options));
}

/// A sheet of `width` × `depth` squares, of which that from (`x`, 0) is cut along its other diagonal.
Triangle_soup with_other_diagonal(Index width, Index depth, Index x)
{
  Triangle_soup soup = sheet(width, depth);
  const Index a = x, b = x + 1, d = x + width + 1, c = d + 1;
  soup.triangles[2 * x] = {a, b, d};
  soup.triangles[2 * x + 1] = {b, c, d};
  return soup;
}

/// Numbers the vertices of some triangles apart from those of the others.
Triangle_soup with_own_vertices(Triangle_soup soup, std::size_t first, std::size_t beyond)
{
  const Index count = Index(soup.points.size());
  const std::vector<Point_3> points = soup.points;
  soup.points.insert(soup.points.end(), points.begin(), points.end());
  for (std::size_t t = first; t < beyond; ++t)
    for (Index& v : soup.triangles[t])
      v += count;
  return soup;
}

// A small piece lies on a sheet, and has no vertex of its own. Reduced, it is a triangle that the original
// does not have.
TEST(MatchPieces, OfPiecesThatOnlyTheFileNumbersApart)
{
  const Triangle_soup original = joined(sheet(2, 2), sheet(1, 1));
  const Triangle_soup rest = soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Triangle_soup file = joined(sheet(2, 2), rest);
  EXPECT_EQ(mismatches(with_first_vertices(file), original), Mismatches{Mismatch::missing}) << "the control";
  EXPECT_EQ(mismatches_in_file(file, original), Mismatches{});

  EXPECT_EQ(mismatches_in_file(sheet(2, 2), original), Mismatches{Mismatch::missing});

  // One of two that lie there is missed.
  const Triangle_soup with_two = joined(original, sheet(1, 1));
  EXPECT_EQ(mismatches_in_file(joined(file, rest), with_two), Mismatches{});
  EXPECT_NE(mismatches_in_file(file, with_two), Mismatches{});
}

// The file cuts a part off what a piece lay on, which could be taken for it.
TEST(MatchPieces, AreMissedWhereTheFileCutsWhatTheyLayOn)
{
  // It is a triangle of that.
  EXPECT_EQ(mismatches_in_file(with_own_vertices(sheet(1, 1), 0, 1),
                               joined(sheet(1, 1), soup({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}))),
            Mismatches{Mismatch::missing});

  // It is a new triangle, without which a vertex inside would be on the border.
  const std::vector<Point_3> around{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                    {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  const auto fan = [](std::vector<Point_3> points, Index triangles) {
    Triangle_soup result;
    for (Index i = 0; i < triangles; ++i)
      result.triangles.push_back({i, Index((i + 1) % points.size()), Index(points.size())});
    points.emplace_back(1, 1, 0);
    result.points = points;
    return result;
  };
  std::vector<Point_3> fewer = around;
  fewer.erase(fewer.begin() + 1);
  EXPECT_EQ(
      mismatches_in_file(with_own_vertices(fan(fewer, 7), 0, 1), joined(fan(around, 8), fan(around, 2))),
      Mismatches{Mismatch::missing});

  // They are new triangles, without which there would be two pieces.
  const Triangle_soup original = joined(sheet(3, 1), moved(sheet(1, 1), 1, 0, 0));
  EXPECT_EQ(mismatches_in_file(with_own_vertices(with_other_diagonal(3, 1, 1), 2, 4), original),
            Mismatches{Mismatch::missing});
}

// Pieces that were joined elsewhere than at their borders are not.
TEST(MatchPieces, OfLayersThatWereJoinedInside)
{
  Triangle_soup result = coarse();
  result.triangles.push_back({12, 13, 25 + 12});
  Verify_options options;
  options.weld_distance = 1.5;
  EXPECT_EQ(mismatches(match_pieces(result, fine())), Mismatches{Mismatch::topology});
  EXPECT_EQ(mismatches(match_pieces(result, fine(), options)), Mismatches{Mismatch::topology});
}

} // namespace
} // namespace selvedge
