// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/matched_pieces.h"

#include <selvedge/rounding.h>
#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace selvedge {
namespace {

using namespace test;

TEST(MatchPieces, OneToOneByTheirVertices)
{
  const Piece_matching matching = match_pieces(coarse(), fine());
  EXPECT_EQ(way(matching), Matched_by::vertices);
  ASSERT_EQ(matching.matches.size(), 4u);
  for (const Piece_match& match : matching.matches) {
    EXPECT_EQ(match.of_original, match.of_result);
    EXPECT_EQ(match.distance, 0);
    EXPECT_EQ(match.turned, 0);
  }
  // Whatever order they come in.
  const Triangle_soup other =
      joined(joined(moved(tetrahedron(), 20, 0, 0), layer(4, 2)), joined(layer(4, 0), layer(4, 1)));
  const Piece_matching turned_round = match_pieces(other, fine());
  EXPECT_EQ(way(turned_round), Matched_by::vertices);
  const std::vector<Index> places{2, 3, 1, 0};
  for (const Piece_match& match : turned_round.matches)
    EXPECT_EQ(match.of_result.at(0), places.at(match.of_original.at(0)));
}

TEST(MatchPieces, NameAMissingPiece)
{
  const Piece_matching matching = match_pieces(without_piece(coarse(), 1), fine());
  ASSERT_EQ(mismatches(matching), Mismatches{Mismatch::missing});
  EXPECT_EQ(matching.mismatches[0].of_original, std::vector<Index>{1});
  EXPECT_TRUE(matching.mismatches[0].of_result.empty());
  EXPECT_EQ(matching.mismatches[0].message,
            "piece 2 (128 faces around (4, 4, 1)) of the original is not in the result");
}

// All that a count of pieces and kinds can see is the same as in the original.
TEST(MatchPieces, FindAPieceReplacedByATriangleElsewhere)
{
  const Triangle_soup result = joined(without_piece(coarse(), 1), moved(one_triangle(), 30, 30, 30));
  EXPECT_TRUE(topology_differences(pieces(result), pieces(fine())).empty()) << "the control";
  EXPECT_EQ(mismatches(result, fine()), (Mismatches{Mismatch::missing, Mismatch::added}));
}

TEST(MatchPieces, FindAPieceReplacedByATriangleOfItsOwn)
{
  Triangle_soup result = coarse();
  result.triangles.erase(result.triangles.begin() + 1, result.triangles.begin() + 32);
  EXPECT_TRUE(topology_differences(pieces(result), pieces(fine())).empty()) << "the control";
  EXPECT_EQ(mismatches(result, fine()), Mismatches{Mismatch::far});
}

// A patch has all its vertices in common with the sheet, which has none left of its own.
TEST(MatchPieces, GoByTrianglesWhereVerticesTellWrongly)
{
  const Triangle_soup patch = soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}),
                      original = joined(sheet(4, 4), patch),
                      result = joined(mapped(sheet(1, 1),
                                             [](const Point_3&p) {
                                               return Point_3(0.5 + 3 * p.x(), 0.5 + 3 * p.y(), 0);
                                             }),
                                      patch);
  EXPECT_FALSE(match_pieces(result, original).is_complete()) << "the control";
  Verify_options options;
  options.are_shapes_judged = false;
  options.triangles_of_original = {0, 17, 32};
  const Piece_matching matching = match_pieces(result, original, options);
  EXPECT_TRUE(matching.is_complete());
  ASSERT_EQ(matching.matches.size(), 2U);
  for (const Piece_match& match : matching.matches)
    EXPECT_EQ(match.of_original, match.of_result);
}

// A button may become a triangle of its own, as a reduction to 1 % of the diagonal allows; but no other one.
TEST(MatchPieces, OfWhichLittleIsLeftAreRightWhereTheyAreSmall)
{
  const auto with_button = [](const Triangle_soup& layers, const Triangle_soup& button) {
    return joined(layers, mapped(button, [](const Point_3& p) {
                    return Point_3(30 + p.x() / 64, p.y() / 64, p.z() / 64);
                  }));
  };
  const Triangle_soup original = with_button(fine(), layer(8, 0));
  const Triangle_soup corner = soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Piece_matching matching = match_pieces(with_button(coarse(), corner), original);
  EXPECT_EQ(mismatches(matching), Mismatches{});
  EXPECT_GT(matching.matches.back().distance, 0.25) << "the control";
  EXPECT_NE(mismatches(with_button(coarse(), moved(corner, 0.01, 0, 0)), original), Mismatches{});
  const Triangle_soup placed =
      soup({{0, 0, 0}, {1.1, 0, 0}, {0.1, 0.9, 0}}, {{0, 1, 2}}); // --placement optimal
  EXPECT_EQ(mismatches(with_button(coarse(), placed), original), Mismatches{});
  EXPECT_EQ(mismatches(moved(with_button(coarse(), corner), 1e-6, 2e-6, 3e-6), original), Mismatches{});
}

TEST(MatchPieces, FindACopyOfAnotherInThePlaceOfOne)
{
  const Triangle_soup result = joined(without_piece(coarse(), 1), layer(4, 0.001));
  EXPECT_EQ(mismatches(result, fine()), (Mismatches{Mismatch::missing, Mismatch::added}));
}

TEST(MatchPieces, FindADoubledPiece)
{
  const Piece_matching matching = match_pieces(joined(coarse(), layer(2, 2)), fine());
  ASSERT_EQ(mismatches(matching), Mismatches{Mismatch::added});
  EXPECT_EQ(matching.mismatches[0].message,
            "piece 5 (8 faces around (4, 4, 2)) of the result is no piece of the original");
}

TEST(MatchPieces, FindAnotherTopology)
{
  Triangle_soup holed = coarse();
  holed.triangles.erase(holed.triangles.begin() + 10);
  const Piece_matching matching = match_pieces(holed, fine());
  ASSERT_EQ(mismatches(matching), Mismatches{Mismatch::topology});
  EXPECT_EQ(
      matching.mismatches[0].message,
      "piece 1 (128 faces around (4, 4, 0)) of the original is piece 1 (31 faces around (4, 4, 0)) of the "
      "result, which has 2 boundary loops and Euler characteristic 0 instead of 1 boundary loop and "
      "Euler characteristic 1");
}

// Its border meets that of the layer, so that there are as many loops, and the Euler characteristic stays.
TEST(MatchPieces, FindAFinOnAnInnerEdge)
{
  Triangle_soup result = coarse();
  result.points.emplace_back(1, 1, 0.5);
  const Index top = Index(result.points.size() - 1);
  ASSERT_EQ(result.triangles[0], (Index_triple{0, 1, 6}));
  result.triangles.push_back({0, 6, top});
  EXPECT_TRUE(topology_differences(pieces(result), pieces(fine())).empty()) << "the control";
  EXPECT_EQ(mismatches(result, fine()), Mismatches{Mismatch::topology});
}

// A ring lost its hole, and a sheet got one: the counts of kinds are the same.
TEST(MatchPieces, FindKindsThatWereExchanged)
{
  Triangle_soup original = fine(), result = coarse();
  original.triangles.erase(original.triangles.begin() + 36, original.triangles.begin() + 38);
  result.triangles.erase(result.triangles.begin() + 32 + 10, result.triangles.begin() + 32 + 12);
  EXPECT_TRUE(topology_differences(pieces(result), pieces(original)).empty()) << "the control";
  EXPECT_EQ(mismatches(result, original), (Mismatches{Mismatch::topology, Mismatch::topology}));
}

TEST(MatchPieces, OfAResultThatWasRounded)
{
  const auto odd = [](const Triangle_soup& soup) {
    return mapped(soup, [](const Point_3& p) { return Point_3(p.x() / 3, p.y() / 7, p.z() + 0.1); });
  };
  Triangle_soup result = odd(coarse());
  round_to_float32(result);
  ASSERT_NE(result.points[2], odd(coarse()).points[2]);
  EXPECT_EQ(way(match_pieces(result, odd(fine()))), Matched_by::vertices);
}

// One row of a band of two is on 32-bit floats, and the other so near that rounding leaves no area between.
TEST(MatchPieces, OfAResultThatHasFloatsByChance)
{
  const double below = std::nextafter(1., 0.);
  const Triangle_soup original =
      soup({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 0, below}, {4, 0, below}, {4, 4, below}},
           {{0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}});
  Triangle_soup result = original;
  result.triangles = {{0, 1, 2}};
  Verify_options options;
  EXPECT_EQ(mismatches(match_pieces(result, original, options)), Mismatches{Mismatch::added});
  options.may_be_rounded = false;
  EXPECT_EQ(mismatches(match_pieces(result, original, options)), Mismatches{});
  EXPECT_TRUE(verify(result, original, offending_pairs(original), options).matching.is_complete());

  Prepared_soup prepared;
  prepared.soup = original;
  Simplified_soup simplified;
  simplified.soup = result;
  EXPECT_TRUE(verify(simplified, prepared).matching.is_complete());
}

// As programs leave them that place vertices where they like.
TEST(MatchPieces, ByDistanceWhereNoVertexIsTheOriginals)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  const auto shaken = [&](const Triangle_soup& soup) {
    return mapped(soup, [&](const Point_3& p) {
      return Point_3(p.x() + noise(random), p.y() + noise(random), p.z() + noise(random));
    });
  };
  const Piece_matching matching = match_pieces(shaken(coarse()), fine());
  EXPECT_EQ(way(matching), Matched_by::distance);
  for (const Piece_match& match : matching.matches)
    EXPECT_EQ(match.of_original, match.of_result);
  EXPECT_EQ(
      way(match_pieces(
          unshared(mapped(coarse(), [](const Point_3& p) { return Point_3(p.x() + 0.01, p.y(), p.z()); })),
          fine())),
      Matched_by::positions);

  EXPECT_EQ(mismatches(shaken(without_piece(coarse(), 0)), fine()), Mismatches{Mismatch::missing});
  EXPECT_EQ(mismatches(shaken(joined(coarse(), layer(4, 1))), fine()), Mismatches{Mismatch::added});
}

// Layers lie closer together than the original lies to any layer of the result.
TEST(MatchPieces, ByDistanceWhereLayersAreClose)
{
  const auto layered = [](Index squares) {
    Triangle_soup result;
    for (int i = 0; i < 3; ++i)
      result = joined(result, layer(squares, 0.05 * i));
    return mapped(result, [&](const Point_3& p) {
      return Point_3(p.x(), p.y(), p.z() + std::sin(p.x()) * std::sin(p.y()));
    });
  };
  const Triangle_soup result =
      mapped(layered(8), [](const Point_3& p) { return Point_3(p.x(), p.y(), p.z() + 1e-6); });
  const Piece_matching matching = match_pieces(result, layered(64));
  EXPECT_EQ(way(matching), Matched_by::distance);
  for (const Piece_match& match : matching.matches)
    EXPECT_EQ(match.of_original, match.of_result);
}

/// All coordinates as a file has them that was written with few digits.
Triangle_soup with_digits(int digits, const Triangle_soup& soup)
{
  const auto printed = [&](double coordinate) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, coordinate);
    return std::strtod(text, nullptr);
  };
  return mapped(soup,
                [&](const Point_3& p) { return Point_3(printed(p.x()), printed(p.y()), printed(p.z())); });
}

/// Three layers of a wavy cloth that lie close together, in which the middle one may have larger triangles.
Triangle_soup close_layers(Index squares, Index squares_of_middle)
{
  const Triangle_soup flat =
      joined(joined(layer(squares, 0), layer(squares_of_middle, 0.02)), layer(squares, 0.04));
  return mapped(flat, [](const Point_3& p) {
    return Point_3(p.x() / 3, p.y() / 3, p.z() + std::sin(p.x()) * std::sin(p.y()));
  });
}

// The vertices of the middle layer of the original are nearer to the other two layers of the result, which
// have kept all of theirs, than to their own.
TEST(MatchPieces, ThatLieCloseWhereTheResultHasFewDigits)
{
  const std::vector<std::string> names{"shell", "interlining", "lining"};
  const Triangle_soup original = named(close_layers(32, 32), names), result = close_layers(32, 8);
  ASSERT_EQ(way(match_pieces(named(result, names), original)), Matched_by::vertices);
  for (const int digits : {6, 9, 15}) {
    SCOPED_TRACE(digits);
    const Triangle_soup written = with_digits(digits, result);
    ASSERT_NE(written.points, result.points);
    const Piece_matching matching = match_pieces(named(written, names), original);
    EXPECT_EQ(way(matching), Matched_by::distance);
    for (const Piece_match& match : matching.matches)
      EXPECT_EQ(match.of_original, match.of_result);

    // What is wrong is found all the same: exchanged names, and a piece that is missing, doubled, or moved to
    // another layer.
    const auto only = [&](Index piece) {
      return without_piece(without_piece(written, piece == 2 ? 1 : 2), piece == 0 ? 1 : 0);
    };
    EXPECT_EQ(mismatches(named(written, {"shell", "lining", "interlining"}), original),
              (Mismatches{Mismatch::name, Mismatch::name}));
    for (const Index piece : {0, 1, 2}) {
      const Triangle_soup fewer = without_piece(written, piece);
      EXPECT_EQ(mismatches(fewer, original), Mismatches{Mismatch::missing});
      const Mismatches wrong{Mismatch::missing, Mismatch::added};
      for (const Index other : {(piece + 1) % 3, (piece + 2) % 3})
        EXPECT_EQ(mismatches(joined(fewer, moved(only(other), 0, 0, 1e-7)), original), wrong)
            << "piece " << piece << " is piece " << other << " once more";
    }
    EXPECT_EQ(mismatches(joined(written, moved(only(1), 0, 0, 1e-7)), original), Mismatches{Mismatch::added});
  }
}

// Two sheets have one border, and one of them has lost all vertices elsewhere: what is left of it lies on
// both, up to rounding.
TEST(MatchPieces, OnABorderOfAnotherWhereTheResultHasFewDigits)
{
  const auto bump = [](Index squares, double height) {
    return mapped(layer(squares, 0), [&](const Point_3& p) {
      const auto wave = [](double x) { return x == 8 ? 0 : std::sin(x * M_PI / 8); };
      return Point_3(p.x() / 3 + 0.1, p.y() / 7, p.x() / 9 + height * wave(p.x()) * wave(p.y()));
    });
  };
  const Triangle_soup original = named(joined(bump(8, 1), bump(8, 0.8)), {"upper", "lower"});
  const Triangle_soup result = joined(bump(8, 0.8), bump(1, 1));
  for (const int digits : {6, 7, 9}) {
    SCOPED_TRACE(digits);
    const Triangle_soup written = with_digits(digits, result);
    EXPECT_EQ(way(match_pieces(named(written, {"lower", "upper"}), original)), Matched_by::distance);
    EXPECT_EQ(mismatches(named(written, {"upper", "lower"}), original),
              (Mismatches{Mismatch::name, Mismatch::name}));
    EXPECT_EQ(mismatches(without_piece(written, 0), original), Mismatches{Mismatch::missing});
  }
}

TEST(MatchPieces, FindAPieceThatIsElsewhere)
{
  const Triangle_soup result = joined(without_piece(coarse(), 2), layer(4, 9));
  EXPECT_EQ(mismatches(result, fine()), (Mismatches{Mismatch::missing, Mismatch::added}));
}

TEST(MatchPieces, FindAPieceThatIsTurnedInsideOut)
{
  Triangle_soup result = coarse();
  for (Index t = 0; t < 32; ++t)
    std::swap(result.triangles[t][0], result.triangles[t][1]);
  EXPECT_EQ(mismatches(result, fine()), Mismatches{Mismatch::turned});
  Verify_options options;
  options.are_shapes_judged = false;
  EXPECT_TRUE(match_pieces(result, fine(), options).is_complete());
}

// The nearest triangles of the original are those around the mouth, whose outsides look away from it.
TEST(MatchPieces, OfABagThatIsDrawnFlatToItsMouthAreNotTurned)
{
  constexpr Index corners = 6, top = 2 * corners;
  Triangle_soup bag;
  for (const double level : {0, 1})
    for (Index i = 0; i < corners; ++i)
      bag.points.emplace_back((1 + level) * std::cos(i * M_PI / 3), (1 + level) * std::sin(i * M_PI / 3),
                              level);
  bag.points.emplace_back(0, 0, 1.2);
  for (Index i = 0; i < corners; ++i) {
    const Index next = (i + 1) % corners;
    bag.triangles.push_back({i, next, corners + next});
    bag.triangles.push_back({i, corners + next, corners + i});
    bag.triangles.push_back({corners + i, corners + next, top});
  }
  Triangle_soup flat;
  flat.points = {bag.points[0], bag.points[2], bag.points[4]};
  flat.triangles = {{0, 1, 2}};
  const Piece_matching matching = match_pieces(flat, bag);
  EXPECT_TRUE(matching.is_complete()) << matching.mismatches.front().message;
  EXPECT_EQ(matching.matches.at(0).turned, 1) << "the control";

  Triangle_soup turned = bag;
  for (Index_triple& triangle : turned.triangles)
    std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(mismatches(turned, bag), Mismatches{Mismatch::turned});
}

// Its two sides have different diagonals, and lie in one place.
TEST(MatchPieces, OfAFlatTetrahedronAreNotTurned)
{
  Triangle_soup original, result;
  original.points = result.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  original.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  result.triangles = {{0, 3, 1}, {1, 3, 2}, {0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(match_pieces(result, original).matches.at(0).turned, 0);
}

// A stitch of cargo pants that intersects itself. Its sides are 0.05 apart where it is flat, and exchange
// their places when a vertex moves by less than 0.2: no face turns by more than 12°, but nine tenths of the
// area are nearer to what was the other side.
TEST(MatchPieces, WhoseSidesAreNearerToEachOtherAreNotTurned)
{
  const Triangle_soup stitch =
      soup({{0, 0, 0},
            {1.688, -15.19, 1.687},
            {2.25, -14.06, 1.687},
            {-2.25, 0, 0},
            {0, -12.94, 0.5625},
            {-1.125, 2.25, 0}},
           {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {4, 1, 3}, {2, 4, 5}, {5, 4, 3}, {2, 5, 0}, {0, 5, 3}});
  Triangle_soup result = soup({{0, 0, 0}, {1.5, -14.13, 1.401}, {-1.125, 2.25, 0}, {-2.25, 0, 0}},
                              {{1, 0, 3}, {2, 1, 3}, {1, 2, 0}, {0, 2, 3}});
  const Piece_matching matching = match_pieces(result, stitch);
  EXPECT_TRUE(matching.is_complete()) << matching.mismatches.front().message;
  EXPECT_GT(matching.matches.at(0).turned, 0.9) << "the control";

  Triangle_soup turned = stitch;
  for (Index_triple& triangle : turned.triangles)
    std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(mismatches(turned, stitch), Mismatches{Mismatch::turned});
}

TEST(MatchPieces, ThatAreNotFlatAreTurnedThoughTheyHaveLostMore)
{
  // A prism that is 0.05 thick. Its fourth corners are gone, which were 0.28 away from what is left.
  Triangle_soup prism, result;
  for (const double z : {0.0, 0.05})
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.7, 0.7}, {0.0, 1.0}})
      prism.points.emplace_back(x, y, z);
  result.points = prism.points;
  prism.triangles = {{4, 5, 6}, {4, 6, 7}, {0, 2, 1}, {0, 3, 2}};
  result.triangles = {{4, 5, 7}, {0, 3, 1}};
  const auto add_side = [](Triangle_soup& soup, Index from, Index to) {
    soup.triangles.push_back({from, to, to + 4});
    soup.triangles.push_back({from, to + 4, from + 4});
  };
  for (const Index i : {0, 1, 2, 3})
    add_side(prism, i, (i + 1) % 4);
  for (const auto& [from, to] : {std::pair(0, 1), {1, 3}, {3, 0}})
    add_side(result, Index(from), Index(to));
  EXPECT_TRUE(match_pieces(result, prism).is_complete()) << "the control";
  for (Index_triple& triangle : result.triangles)
    std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(mismatches(result, prism), Mismatches{Mismatch::turned});
}

// A flat box, and one within it whose sides lie so near to the middle that both sides of the box are nearly
// as near. But they are farther from each other than the two boxes are.
TEST(MatchPieces, WhoseSidesAreFartherFromEachOtherAreTurned)
{
  const auto box = [](double bottom, double top) {
    return soup({{0, 0, bottom},
                 {1, 0, bottom},
                 {1, 1, bottom},
                 {0, 1, bottom},
                 {0, 0, top},
                 {1, 0, top},
                 {1, 1, top},
                 {0, 1, top}},
                {{0, 2, 1},
                 {0, 3, 2},
                 {4, 5, 6},
                 {4, 6, 7},
                 {0, 1, 5},
                 {0, 5, 4},
                 {1, 2, 6},
                 {1, 6, 5},
                 {2, 3, 7},
                 {2, 7, 6},
                 {3, 0, 4},
                 {3, 4, 7}});
  };
  Triangle_soup result = box(0.018, 0.022);
  EXPECT_TRUE(match_pieces(result, box(0, 0.04)).is_complete()) << "the control";
  for (Index_triple& triangle : result.triangles)
    std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(mismatches(result, box(0, 0.04)), Mismatches{Mismatch::turned});
}

// What is left of a lid on a robot's arm, and the box below it. A wall of this that is nearly as near as the
// one that faces the other way stands at a right angle, and shows nothing.
TEST(MatchPieces, OfALidThatIsTakenForItsBoxIsTurned)
{
  const Triangle_soup box =
      soup({{0, 0.2, 0},
            {2.9, 0, 0},
            {2.9, 0, 3.2},
            {2.54, 5.64, 0},
            {2.54, 5.64, 3.2},
            {0, 0.2, 3.2},
            {0.37, 5.78, 0.1},
            {0.37, 5.78, 3.2}},
           {{0, 1, 2}, {1, 3, 4}, {5, 2, 4}, {0, 6, 3}, {5, 0, 2}, {2, 1, 4}, {7, 5, 4}, {1, 0, 3}});
  Triangle_soup lid;
  lid.points = {box.points[4], box.points[3], box.points[0]};
  lid.triangles = {{0, 1, 2}};
  EXPECT_EQ(mismatches(lid, box), (Mismatches{Mismatch::far, Mismatch::turned}));
}

TEST(MatchPieces, ThatCoincide)
{
  const Triangle_soup twice = joined(layer(4, 0), layer(4, 0));
  EXPECT_EQ(way(match_pieces(twice, twice)), Matched_by::vertices);
  const std::vector<std::string> ab{"a", "b"}, ba{"b", "a"};
  EXPECT_TRUE(match_pieces(named(twice, ba), named(twice, ab)).is_complete()) << "there is no way to tell";
  EXPECT_EQ(mismatches(layer(4, 0), twice), Mismatches{Mismatch::missing});
}

TEST(MatchPieces, ThatCoincideAreMatchedByAllTheirNames)
{
  // Both have faces of the first name, and their first faces have it.
  Triangle_soup original = joined(layer(4, 0), layer(4, 0));
  original.materials.names = {"silk", "wool"};
  original.materials.of_triangle.assign(64, 0);
  std::fill(original.materials.of_triangle.begin() + 48, original.materials.of_triangle.end(), 1);
  Triangle_soup result = original; // the second piece comes first
  std::rotate(result.triangles.begin(), result.triangles.begin() + 32, result.triangles.end());
  std::rotate(result.materials.of_triangle.begin(), result.materials.of_triangle.begin() + 32,
              result.materials.of_triangle.end());
  const Piece_matching matching = match_pieces(result, original);
  EXPECT_TRUE(matching.is_complete()) << matching.mismatches.front().message;
  ASSERT_EQ(matching.matches.size(), 2u);
  EXPECT_EQ(matching.matches[0].of_original, std::vector<Index>{1});
  EXPECT_EQ(matching.matches[1].of_original, std::vector<Index>{0});
}

// The pieces of the result come in another order, as Draco may write them.
TEST(MatchPieces, OfADoubledSheetHaveTheirSides)
{
  Triangle_soup back = layer(8, 0), coarse_back = layer(4, 0);
  for (Triangle_soup* sheet : {&back, &coarse_back})
    for (Index_triple& triangle : sheet->triangles)
      std::swap(triangle[0], triangle[1]);
  const Piece_matching matching = match_pieces(joined(coarse_back, layer(4, 0)), joined(layer(8, 0), back));
  EXPECT_TRUE(matching.is_complete()) << matching.mismatches.front().message;
  EXPECT_EQ(way(matching), Matched_by::vertices);
  EXPECT_EQ(mismatches(joined(coarse_back, coarse_back), joined(layer(8, 0), back)),
            Mismatches{Mismatch::turned});
}

// All vertices of a cap are vertices of its tube too, which a seam cuts open: both are discs.
TEST(MatchPieces, OfATubeAndItsCap)
{
  constexpr Index sides = 16;
  const auto on_circle = [](Index i, double z) {
    const double angle = (i % sides) * (8 * std::atan(1.0) / sides);
    return Point_3(std::cos(angle), std::sin(angle), z);
  };
  const Triangle_soup tube =
      mapped(sheet(sides, 1), [&](const Point_3& p) { return on_circle(Index(p.x()), 20 * p.y()); });
  Triangle_soup cap;
  for (Index i = 0; i < sides; ++i)
    cap.points.push_back(on_circle(i, 20));
  for (Index i = 2; i < sides; ++i)
    cap.triangles.push_back({0, i - 1, i});
  const Piece_matching matching = match_pieces(joined(cap, tube), joined(tube, cap));
  EXPECT_TRUE(matching.is_complete()) << matching.mismatches.front().message;
  EXPECT_EQ(way(matching), Matched_by::vertices);
}

// All vertices of a lid are vertices of its box too. A seventh of its area lies nearer to the walls, which
// stand upright on it, than to the bottom, which faces the other way. Of the box, half of the vertices are
// new.
TEST(MatchPieces, OfABoxAndItsLid)
{
  constexpr Index sides = 8;
  const auto on_circle = [](Index i, double radius, double z) {
    const double angle = (i % sides) * (8 * std::atan(1.0) / sides);
    return Point_3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  const auto box = [&](double radius_below) {
    Triangle_soup result;
    for (Index i = 0; i < 2 * sides; ++i)
      result.points.push_back(i < sides ? on_circle(i, 1, 0) : on_circle(i, radius_below, -0.2));
    for (Index i = 0, next = 1; i < sides; ++i, next = (i + 1) % sides) {
      result.triangles.push_back({i, sides + i, sides + next});
      result.triangles.push_back({i, sides + next, next});
      if (i >= 2)
        result.triangles.push_back({sides, sides + i, sides + i - 1});
    }
    return result;
  };
  Triangle_soup lid;
  for (Index i = 0; i < sides; ++i) {
    lid.points.push_back(on_circle(i, 1, 0));
    if (i >= 2)
      lid.triangles.push_back({0, i - 1, i});
  }
  const Piece_matching matching = match_pieces(joined(lid, box(0.99)), joined(box(1), lid));
  EXPECT_TRUE(matching.is_complete()) << matching.mismatches.front().message;
  ASSERT_EQ(matching.matches.size(), 2u);
  for (const Piece_match& match : matching.matches)
    EXPECT_EQ(match.of_original.at(0), 1 - match.of_result.at(0));
}

// The first piece of the result could be either of the original's, the second only the one that the first
// would take.
TEST(MatchPieces, GivesWayWhereAnotherHasNoChoice)
{
  const Triangle_soup original = joined(
      soup({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, -4, 0}, {8, 0, 0}}, {{0, 3, 1}, {3, 4, 1}, {1, 4, 2}}),
      soup({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}, {{0, 1, 2}}));
  const Triangle_soup result = joined(soup({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}, {{0, 1, 2}}),
                                      soup({{0, -4, 0}, {8, 0, 0}, {4, 1, 1}}, {{0, 1, 2}}));
  Verify_options options;
  options.are_shapes_judged = false;
  const Piece_matching matching = match_pieces(result, original, options);
  EXPECT_EQ(way(matching), Matched_by::vertices);
  ASSERT_EQ(matching.matches.size(), 2u);
  EXPECT_EQ(matching.matches[0].of_original, std::vector<Index>{1});
  EXPECT_EQ(matching.matches[1].of_original, std::vector<Index>{0});
}

TEST(MatchPieces, OfNothing)
{
  EXPECT_TRUE(match_pieces({}, {}).is_complete());
  EXPECT_EQ(mismatches({}, one_triangle()), Mismatches{Mismatch::missing});
  EXPECT_EQ(mismatches(one_triangle(), {}), Mismatches{Mismatch::added});
  // Triangles with two corners at one position are no piece.
  const Triangle_soup needle = soup({{5, 5, 5}, {5, 5, 5}, {6, 6, 6}}, {{0, 1, 2}});
  EXPECT_TRUE(match_pieces(one_triangle(), joined(one_triangle(), needle)).is_complete());
  EXPECT_TRUE(match_pieces(joined(one_triangle(), needle), one_triangle()).is_complete());
  EXPECT_TRUE(match_pieces(needle, needle).is_complete());
}

// What another program leaves of quantised meshes: a reduction leaves the needles out, so that they cannot be
// what holds pieces together.
TEST(MatchPieces, WhateverTrianglesWithTwoCornersAtOnePositionConnect)
{
  Triangle_soup needles = fine();
  const std::vector<Piece> all = pieces(needles);
  const auto first_corner = [&](Index piece) { return needles.triangles[all[piece].first_triangle][0]; };
  for (const Index piece : {1, 2, 3}) {
    needles.points.push_back(needles.points[first_corner(0)]);
    needles.triangles.push_back({first_corner(0), Index(needles.points.size() - 1), first_corner(piece)});
  }
  EXPECT_EQ(way(match_pieces(coarse(), needles)), Matched_by::vertices);
  EXPECT_EQ(way(match_pieces(needles, fine())), Matched_by::vertices);
  EXPECT_TRUE(verify(coarse(), needles).same_topology());
  EXPECT_EQ(mismatches(without_piece(coarse(), 1), needles), Mismatches{Mismatch::missing});
}

// More pieces at one position than are looked at.
TEST(MatchPieces, ManyAtOnePosition)
{
  Triangle_soup fan;
  for (int i = 0; i < 200; ++i)
    fan = joined(fan, soup({{0, 0, 0},
                            {std::cos(i * 0.03), std::sin(i * 0.03), 0},
                            {std::cos(i * 0.03 + 0.01), std::sin(i * 0.03 + 0.01), 0}},
                           {{0, 1, 2}}));
  EXPECT_EQ(way(match_pieces(fan, fan)), Matched_by::vertices);
  EXPECT_EQ(mismatches(without_piece(fan, 77), fan), Mismatches{Mismatch::missing});
}

} // namespace
} // namespace selvedge
