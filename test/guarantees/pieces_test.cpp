// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A mesh that is cut into pieces, each reduced by itself, and joined again: the contract of a piece, and what
// follows from it.

#include "support/Temporary_folder.h"
#include "support/meshes.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/cells.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace selvedge::test {
namespace {

using Piece_reduction = std::function<Triangle_soup(Triangle_soup, std::size_t cell)>;

Triangle_soup unchanged(Triangle_soup piece, std::size_t)
{
  return piece;
}

Triangle_soup reduced_piece(const Triangle_soup& piece, double ratio, bool check_intersections = true)
{
  Simplify_options options;
  options.ratio = ratio;
  options.check_intersections = check_intersections;
  Simplify_intent intent;
  intent.kept = {std::string(fixed_property)};
  Prepare_options prepare_options;
  prepare_options.defects = Defects::freeze;
  return simplify_soup(prepare(piece, prepare_options), options, intent).soup;
}

Triangle_soup reduced_to_a_quarter(Triangle_soup piece, std::size_t)
{
  return reduced_piece(piece, 0.25);
}

/// A mesh in pieces, as files.
class Cut
{
public:
  explicit Cut(const Triangle_soup& whole, std::size_t cells = 6, double shift = 0)
  {
    write_mesh(m_folder / "whole.ply", whole);
    Cut_options options;
    options.cells = cells;
    options.shift = shift;
    m_mesh = cut_into_cells(m_folder / "whole.ply", options,
                            [&](std::size_t i) { return m_folder / ("cell_" + std::to_string(i) + ".ply"); });
  }

  const Cut_mesh& mesh() const { return m_mesh; }
  const Cell& cell(std::size_t i) const { return m_mesh.pieces[i].cell; }
  Triangle_soup piece(std::size_t i) const { return read_mesh(m_mesh.pieces[i].file).soup; }
  std::size_t free_faces() const
  {
    std::size_t faces = 0;
    for (const Cell_piece& piece : m_mesh.pieces)
      faces += piece.faces - piece.fixed_faces;
    return faces;
  }

  Triangle_soup join(const Piece_reduction& reduction) const
  {
    std::vector<Cell> cells;
    for (const Cell_piece& piece : m_mesh.pieces)
      cells.push_back(piece.cell);
    Cell_join join(cells);
    for (std::size_t i = 0; i < cells.size(); ++i)
      join.add(i, piece(i), reduction(piece(i), i), "cell_" + std::to_string(i + 1) + ".ply",
               "small_" + std::to_string(i + 1) + ".ply");
    return join.take();
  }

  /// Why the pieces are refused once those of one cell are changed by `change`; empty when they are not.
  std::string refusal(std::size_t cell, const std::function<void(Triangle_soup&)>& change) const
  {
    try {
      join([&](Triangle_soup piece, std::size_t i) {
        if (i == cell)
          change(piece);
        return piece;
      });
      return "";
    } catch (const Input_error& error) {
      return error.what();
    }
  }

  /// The number of the first vertex that belongs, with its neighbours, to free faces alone and is on no
  /// border.
  Index free_vertex(std::size_t i) const
  {
    const Triangle_soup soup = piece(i);
    std::vector<std::size_t> faces(soup.points.size(), 0);
    std::vector<char> is_inner(soup.points.size(), true), has_inner_star = is_inner;
    for (const Index_triple& triangle : soup.triangles)
      for (const Index v : triangle) {
        ++faces[v];
        for (const Index other : triangle)
          is_inner[v] &= cell(i).contains(soup.points[other]);
      }
    for (const Index_triple& triangle : soup.triangles)
      for (const Index v : triangle)
        for (const Index other : triangle)
          has_inner_star[v] &= faces[other] > 4 && is_inner[other];
    return Index(std::find(has_inner_star.begin(), has_inner_star.end(), true) - has_inner_star.begin());
  }

private:
  Temporary_folder m_folder;
  Cut_mesh m_mesh;
};

/// The corners of every face with all that they have, in an order that no numbers decide.
auto faces_of(const Triangle_soup& soup)
{
  using Corner = std::tuple<double, double, double, double, double>;
  std::multimap<std::array<Corner, 3>, int> faces;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point_3& p = soup.points[soup.triangles[t][i]];
      const auto uv =
          soup.uvs.empty() ? std::array<double, 2>{} : soup.uvs.values[soup.uvs.of_triangle[t][i]];
      corners[i] = {p.x(), p.y(), p.z(), uv[0], uv[1]};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    faces.emplace(corners, 0);
  }
  return faces;
}

std::vector<std::tuple<std::size_t, std::size_t, std::size_t, long>>
kinds_of_pieces(const Triangle_soup& soup)
{
  std::vector<std::tuple<std::size_t, std::size_t, std::size_t, long>> kinds;
  for (const Piece& piece : pieces(soup))
    kinds.emplace_back(piece.faces, piece.vertices, piece.boundary_loops, piece.euler_characteristic);
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

TEST(Pieces, GiveTheWholeAgainWhenNothingIsReduced)
{
  for (const Triangle_soup& whole : {skirt(6000, 3), sewn_pieces(1500), sheet(28, 28)})
    for (const double shift : {0.0, 0.5}) {
      const Cut cut(whole, 6, shift);
      EXPECT_EQ(cut.mesh().pieces.size(), shift > 0 ? 7u : 6u);
      EXPECT_GT(cut.free_faces(), whole.triangles.size() / 4);
      EXPECT_LT(cut.free_faces(), whole.triangles.size());
      const Triangle_soup joined = cut.join(unchanged);
      EXPECT_EQ(faces_of(joined), faces_of(whole));
      EXPECT_EQ(kinds_of_pieces(joined), kinds_of_pieces(whole));
    }
}

TEST(Pieces, GivePolygonsAgainEachOnce)
{
  // Quads askew to the axes: one of its two triangles may be away from a wall that the quad touches.
  std::string text;
  const int size = 16;
  for (int i = 0; i <= size; ++i)
    for (int k = 0; k <= size; ++k)
      text += "v " + std::to_string(3 * i + k) + ' ' + std::to_string(3 * k - i) + " 0\n";
  for (int i = 0; i < size; ++i)
    for (int k = 1; k <= size; ++k) {
      const int corner = i * (size + 1) + k;
      text += "f " + std::to_string(corner) + ' ' + std::to_string(corner + size + 1) + ' ' +
              std::to_string(corner + size + 2) + ' ' + std::to_string(corner + 1) + '\n';
    }
  const Triangle_soup whole = read_mesh(text, Mesh_format::obj, "quads").soup;
  ASSERT_EQ(whole.polygons.size(), 256u);
  const Cut cut(whole);
  EXPECT_EQ(cut.mesh().faces, 256u);
  EXPECT_EQ(faces_of(cut.join(unchanged)), faces_of(whole));
}

TEST(Pieces, AreEmbeddedTogetherWhenEachIsReduced)
{
  for (const Triangle_soup& whole :
       {skirt(6000, 3), sewn_pieces(1500), folded_cloth(2000, 6, 1e-6), nested_spheres(6000, 4, 1e-4)}) {
    const Cut cut(whole);
    const Triangle_soup joined = cut.join(reduced_to_a_quarter);
    EXPECT_LT(joined.triangles.size(), whole.triangles.size() - cut.free_faces() / 2);
    EXPECT_TRUE(is_embedded(joined));
    EXPECT_TRUE(match_pieces(joined, whole).is_complete());
    EXPECT_TRUE(topology_differences(pieces(joined), pieces(whole)).empty());
  }
}

TEST(Pieces, AreRefusedWhenLayersWerePierced)
{
  const Cut cut(nested_spheres(6000, 4, 1e-4));
  EXPECT_THROW(cut.join([](Triangle_soup piece, std::size_t) { return reduced_piece(piece, 0.25, false); }),
               Input_error);
}

TEST(Pieces, AreReducedAtFormerWallsInASecondRound)
{
  const Triangle_soup first = Cut(skirt(6000, 3)).join(reduced_to_a_quarter);
  const Cut again(first, 6, 0.5);
  const Triangle_soup second =
      again.join([](Triangle_soup piece, std::size_t) { return reduced_piece(piece, 0.6); });
  EXPECT_LT(second.triangles.size(), first.triangles.size() - again.free_faces() / 4);
  EXPECT_TRUE(is_embedded(second));
}

TEST(Pieces, RefuseAVertexThatHasCrossedTheWall)
{
  const Cut cut(sheet(28, 28), 4);
  const std::size_t i = 1;
  const Index v = cut.free_vertex(i);
  const Triangle_soup piece = cut.piece(i);
  ASSERT_TRUE(cut.cell(i).contains(piece.points[v]));
  const auto move = [&](double by) {
    return cut.refusal(i, [&](Triangle_soup& soup) {
      const Point_3 p = soup.points[v];
      soup.points[v] = Point_3(p.x() + by, p.y() + by, p.z());
    });
  };
  EXPECT_EQ(move(0.25), "");
  for (const double by : {1000.0, -1000.0}) {
    const std::string refusal = move(by);
    EXPECT_EQ(refusal.rfind("small_2.ply: face ", 0), 0u) << refusal;
    EXPECT_NE(refusal.find("reaches out of its cell"), std::string::npos) << refusal;
  }
  // A vertex on the wall is out of the cell.
  const double wall = cut.cell(i).low[0] > -1e9 ? cut.cell(i).low[0] : cut.cell(i).high[0];
  ASSERT_LT(std::abs(wall), 1e9);
  const std::string refusal = cut.refusal(i, [&](Triangle_soup& soup) {
    soup.points[v] = Point_3(wall, soup.points[v].y(), soup.points[v].z() + 1);
  });
  EXPECT_NE(refusal.find("reaches out of its cell"), std::string::npos) << refusal;
}

TEST(Pieces, RefuseAFixedFaceThatIsMissingOrChanged)
{
  const Cut cut(sheet(28, 28), 4);
  const auto is_fixed = [&](const Triangle_soup& soup, Index t) {
    return !std::all_of(soup.triangles[t].begin(), soup.triangles[t].end(),
                        [&](Index v) { return cut.cell(0).contains(soup.points[v]); });
  };
  const auto first_fixed = [&](const Triangle_soup& soup) {
    Index t = 0;
    while (!is_fixed(soup, t))
      ++t;
    return t;
  };
  const std::string missing = cut.refusal(0, [&](Triangle_soup& soup) {
    const Index t = first_fixed(soup);
    soup = Triangle_soup{};
    const Triangle_soup piece = cut.piece(0);
    soup.points = piece.points;
    for (Index i = 0; i < piece.triangles.size(); ++i)
      if (i != t)
        soup.triangles.push_back(piece.triangles[i]);
  });
  EXPECT_NE(missing.find("of the fixed faces of cell_1.ply, 1 are missing"), std::string::npos) << missing;
  const std::string turned = cut.refusal(0, [&](Triangle_soup& soup) {
    std::swap(soup.triangles[first_fixed(soup)][0], soup.triangles[first_fixed(soup)][1]);
  });
  EXPECT_NE(turned.find("is no fixed face of cell_1.ply"), std::string::npos) << turned;
  const std::string twice = cut.refusal(0, [&](Triangle_soup& soup) {
    const Triangle_soup piece = soup;
    soup = Triangle_soup{};
    soup.points = piece.points;
    soup.triangles = piece.triangles;
    soup.triangles.push_back(piece.triangles[first_fixed(piece)]);
  });
  EXPECT_NE(twice.find("is no fixed face of cell_1.ply"), std::string::npos) << twice;
}

TEST(Pieces, RefuseLayersThatIntersectInsideTheCell)
{
  const Cut cut(joined(sheet(28, 28), sheet(28, 28, 0.5)), 4);
  const auto lift = [&](double by) {
    const Index v = cut.free_vertex(0);
    return cut.refusal(0, [&](Triangle_soup& soup) {
      const Point_3 p = soup.points[v];
      soup.points[v] = Point_3(p.x(), p.y(), p.z() + (p.z() == 0 ? by : -by));
    });
  };
  EXPECT_EQ(lift(0.375), "");
  const std::string refusal = lift(0.625);
  EXPECT_NE(refusal.find("pairs of faces offend that did not in cell_1.ply"), std::string::npos) << refusal;
}

TEST(Pieces, RefuseAHoleInsideTheCell)
{
  const Cut cut(sheet(28, 28), 4);
  const Index v = cut.free_vertex(0);
  const std::string refusal = cut.refusal(0, [&](Triangle_soup& soup) {
    const Triangle_soup piece = soup;
    soup = Triangle_soup{};
    soup.points = piece.points;
    for (const Index_triple& triangle : piece.triangles)
      if (std::find(triangle.begin(), triangle.end(), v) == triangle.end())
        soup.triangles.push_back(triangle);
  });
  EXPECT_NE(refusal.find("its connected pieces are not those of cell_1.ply"), std::string::npos) << refusal;
}

// Layers that needles hold together: a reduction leaves the needles out, and is no other mesh for it.
TEST(Pieces, MayLoseWhatHasTwoCornersAtOnePosition)
{
  Triangle_soup whole = joined(sheet(12, 12), moved(sheet(12, 12), 0, 0, 1));
  const Index beyond = Index(whole.points.size() / 2);
  for (Index v = 0; v < beyond; v += 5) {
    whole.points.push_back(whole.points[v]);
    whole.triangles.push_back({v, Index(whole.points.size() - 1), beyond + v});
  }
  EXPECT_EQ(pieces(Cut(whole, 4).join(reduced_to_a_quarter)).size(), 2u);
}

TEST(Pieces, KeepTwoVerticesOfASeamApartAndOneVertexAtAWallOne)
{
  // Twelve quads in a row, sewn by position alone in the middle, and cut across.
  const Triangle_soup whole = joined(sheet(12, 2), moved(sheet(12, 2), 0, 2, 0));
  const Triangle_soup joined_again = Cut(whole, 3).join(unchanged);
  EXPECT_EQ(joined_again.points.size(), whole.points.size());
  EXPECT_EQ(pieces(joined_again).size(), 2u);
}

TEST(Pieces, RefuseAMeshThatIsAPiece)
{
  const Cut cut(sheet(12, 12), 2);
  EXPECT_THROW(Cut(cut.piece(0), 2), Input_error);
}

} // namespace
} // namespace selvedge::test
