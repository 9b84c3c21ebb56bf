// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/verify.h>

#include "support/soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <tuple>

namespace selvedge {
namespace {

using namespace test;

auto key(const Piece& piece)
{
  return std::tuple(piece.faces, piece.vertices, piece.border_edges, piece.non_manifold_edges,
                    piece.boundary_loops, piece.euler_characteristic);
}

using Key = decltype(key(Piece()));

Key only_piece(const Triangle_soup& soup)
{
  const std::vector<Piece> all = pieces(soup);
  EXPECT_EQ(all.size(), 1u);
  return all.empty() ? Key() : key(all[0]);
}

Triangle_soup without_squares(Triangle_soup sheet, std::vector<Index> squares)
{
  std::sort(squares.rbegin(), squares.rend());
  for (const Index square : squares)
    sheet.triangles.erase(sheet.triangles.begin() + 2 * square, sheet.triangles.begin() + 2 * square + 2);
  return sheet;
}

/// A sheet of 5 × 3 squares whose vertices are then identified: a ring, a Möbius strip or a torus, by number
/// alone.
template <class Function>
Triangle_soup glued(Function vertex_of)
{
  Triangle_soup result = sheet(5, 3);
  for (Index_triple& triangle : result.triangles)
    for (Index& vertex : triangle)
      vertex = vertex_of(vertex % 6, vertex / 6);
  return result;
}

TEST(Pieces, AreCountedByTheirShape)
{
  EXPECT_TRUE(pieces({}).empty());
  EXPECT_TRUE(pieces(soup({{0, 0, 0}}, {})).empty());
  EXPECT_EQ(only_piece(one_triangle()), Key(1, 3, 3, 0, 1, 1));
  EXPECT_EQ(only_piece(tetrahedron()), Key(4, 4, 0, 0, 0, 2));
  EXPECT_EQ(only_piece(sheet(5, 3)), Key(30, 24, 16, 0, 1, 1));
  EXPECT_EQ(only_piece(without_squares(sheet(3, 3), {4})), Key(16, 16, 16, 0, 2, 0));
  const auto ring = glued([](Index x, Index y) { return y * 6 + x % 5; });
  EXPECT_EQ(only_piece(ring), Key(30, 20, 10, 0, 2, 0));
  const auto moebius = glued([](Index x, Index y) { return x == 5 ? (3 - y) * 6 : y * 6 + x; });
  EXPECT_EQ(only_piece(moebius), Key(30, 20, 10, 0, 1, 0));
  const auto torus = glued([](Index x, Index y) { return y % 3 * 6 + x % 5; });
  EXPECT_EQ(only_piece(torus), Key(30, 15, 0, 0, 0, 0));
}

TEST(Pieces, AreToldApartByVertexNumbers)
{
  const Triangle_soup apart = unshared(sheet(2, 1));
  const std::vector<Piece> all = pieces(joined(apart, tetrahedron()));
  ASSERT_EQ(all.size(), 5u);
  for (Index i = 0; i < 4; ++i) {
    EXPECT_EQ(all[i].first_triangle, i);
    EXPECT_EQ(key(all[i]), Key(1, 3, 3, 0, 1, 1));
  }
  EXPECT_EQ(all[4].first_triangle, 4u);
  EXPECT_EQ(key(all[4]), Key(4, 4, 0, 0, 0, 2));
}

TEST(Pieces, KeepLoopsApartThatOnlyTouch)
{
  EXPECT_EQ(only_piece(bowtie()), Key(2, 5, 6, 0, 2, 1));
  // Two holes with a corner in common are one hole of the surface, which passes that corner twice; the corner
  // still counts once.
  EXPECT_EQ(only_piece(without_squares(sheet(4, 4), {5, 10})), Key(28, 25, 24, 0, 2, -1));
}

TEST(Pieces, MayBeNonManifold)
{
  EXPECT_EQ(only_piece(book()), Key(3, 5, 6, 1, 1, 1));
}

TEST(Pieces, HaveOneFaceBetweenThreeVertices)
{
  EXPECT_EQ(only_piece(opposite_duplicate()), Key(2, 3, 3, 0, 1, 1));
}

TEST(Pieces, LeaveOutTrianglesThatNameAVertexTwice)
{
  Triangle_soup soup = sheet(5, 3);
  soup.triangles.insert(soup.triangles.begin(), {0, 0, 7});
  soup.points.emplace_back(9, 9, 9);
  soup.triangles.push_back({24, 24, 24});
  EXPECT_EQ(only_piece(soup), Key(30, 24, 16, 0, 1, 1));
  EXPECT_EQ(pieces(soup)[0].first_triangle, 1u);
}

// A bridge between two sheets, and a needle in a slit of one: without them, the sheets are two, and one has
// the slit.
TEST(Pieces, AreNotConnectedByTrianglesWithTwoCornersAtOnePosition)
{
  Triangle_soup soup = joined(sheet(5, 3), moved(sheet(2, 2), 9, 0, 0));
  const std::vector<Piece> apart = pieces(soup);
  soup.points.push_back(soup.points[5]);
  soup.triangles.insert(soup.triangles.begin(), {5, Index(soup.points.size() - 1), 24});
  ASSERT_EQ(pieces(soup).size(), 2u);
  EXPECT_EQ(pieces(soup)[0].first_triangle, 1u);
  for (Index i = 0; i < 2; ++i)
    EXPECT_EQ(key(pieces(soup)[i]), key(apart[i]));

  // The first face gets a vertex of its own, so that a slit leads along two of its sides.
  Triangle_soup slit = tetrahedron();
  const auto [a, b, c] = slit.triangles[0];
  slit.points.push_back(slit.points[a]);
  slit.triangles[0] = {4, b, c};
  const Key open = only_piece(slit);
  EXPECT_EQ(open, Key(4, 5, 4, 0, 1, 1));
  slit.triangles.push_back({a, b, 4});
  slit.triangles.push_back({c, a, 4});
  EXPECT_EQ(only_piece(slit), open);
}

TEST(Pieces, DoNotDependOnAnyOrder)
{
  const Triangle_soup soup = joined(joined(without_squares(sheet(6, 6), {7, 14, 20}), book()), bowtie());
  std::vector<Key> expected;
  for (const Piece& piece : pieces(soup))
    expected.push_back(key(piece));
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(expected.size(), 3u);

  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Triangle_soup shuffled = soup;
    std::vector<Index> number(soup.points.size());
    std::iota(number.begin(), number.end(), Index(0));
    std::shuffle(number.begin(), number.end(), random);
    for (Index v = 0; v < number.size(); ++v)
      shuffled.points[number[v]] = soup.points[v];
    for (Index_triple& triangle : shuffled.triangles) {
      for (Index& vertex : triangle)
        vertex = number[vertex];
      std::shuffle(triangle.begin(), triangle.end(), random);
    }
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), random);
    std::vector<Key> found;
    for (const Piece& piece : pieces(shuffled))
      found.push_back(key(piece));
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(TopologyDifferences, AreNoneForTheSameKindsInAnyOrder)
{
  const Triangle_soup disk_and_sphere = joined(sheet(5, 3), tetrahedron());
  const Triangle_soup sphere_and_disk = joined(tetrahedron(), one_triangle());
  EXPECT_TRUE(topology_differences(pieces(sphere_and_disk), pieces(disk_and_sphere)).empty());
}

TEST(TopologyDifferences, ListKindsWithBothCounts)
{
  const Triangle_soup original = joined(joined(sheet(5, 3), sheet(2, 2)), tetrahedron());
  const Triangle_soup result = joined(sheet(5, 3), without_squares(sheet(3, 3), {4}));
  const auto differences = topology_differences(pieces(result), pieces(original));
  std::vector<std::tuple<std::size_t, long, std::size_t, std::size_t>> found;
  for (const auto& d : differences)
    found.emplace_back(d.boundary_loops, d.euler_characteristic, d.pieces_of_original, d.pieces_of_result);
  // The sphere went, of the two disks one did, and a ring came.
  const decltype(found) expected = {{0, 2, 1, 0}, {1, 1, 2, 1}, {2, 0, 0, 1}};
  EXPECT_EQ(found, expected);
}

} // namespace
} // namespace selvedge
