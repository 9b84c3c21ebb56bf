// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Faces of more than three corners come out as they were where nothing has changed, and G3 holds for them:
// what is read back is the triangles that were judged.

#include "support/Temporary_folder.h"

#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

constexpr unsigned s_polygons_seed = 20261123;
constexpr Mesh_format s_formats[] = {Mesh_format::obj, Mesh_format::off, Mesh_format::ply};
const char* const s_files[] = {"m.obj", "m.off", "m.ply"};

/// A sheet of quads with a bump in the middle, flat elsewhere, as an OBJ file: 7/8 wide for eight vertices to
/// a side, moved by `offset`, behind `vertices_above`.
std::string bumped_quads(int side, double height, bool has_uvs = false, double offset = 0,
                         int vertices_above = 0)
{
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < side * side; ++i) {
    const double x = double(i % side) / side - 0.5, y = double(i / side) / side - 0.5;
    text << "v " << x + offset << ' ' << y << ' ' << height * std::exp(-60 * (x * x + y * y)) << '\n';
    if (has_uvs)
      text << "vt " << x + 0.5 << ' ' << y + 0.5 << '\n';
  }
  for (int y = 0; y + 1 < side; ++y)
    for (int x = 0; x + 1 < side; ++x) {
      text << 'f';
      const int a = vertices_above + y * side + x + 1;
      for (const int v : {a, a + 1, a + side + 1, a + side})
        text << ' ' << v << (has_uvs ? '/' + std::to_string(v) : "");
      text << '\n';
    }
  return text.str();
}

Triangle_soup soup_of_text(const std::string& text)
{
  return read_mesh(text, Mesh_format::obj, "text").soup;
}

/// The faces of an OBJ text as lists of the positions of their corners.
using Faces = std::multiset<std::vector<std::array<double, 3>>>;
Faces polygons_of(const std::string& text)
{
  std::vector<std::array<double, 3>> points;
  Faces faces;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v") {
      std::array<double, 3>& p = points.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if (keyword == "f") {
      std::vector<std::array<double, 3>> corners;
      for (std::string corner; words >> corner;)
        corners.push_back(points[std::stoul(corner) - 1]);
      if (corners.size() > 3)
        faces.insert(corners);
    }
  }
  return faces;
}

/// Writes a soup to each format with polygons, and expects the same triangles back. Returns the polygons.
std::array<std::size_t, 3> expect_read_back(const Triangle_soup& soup)
{
  const Temporary_folder folder;
  std::array<std::size_t, 3> polygons = {};
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(s_files[i]);
    write_mesh(folder / s_files[i], soup);
    const Mesh_file again = read_mesh(folder / s_files[i]);
    EXPECT_EQ(again.soup.points, soup.points);
    EXPECT_TRUE(again.soup.triangles == soup.triangles);
    polygons[std::size_t(i)] = written_polygons(soup, s_formats[i]);
    EXPECT_EQ(again.notes.polygons_cut, polygons[std::size_t(i)]);
    for (std::size_t t = 0; t < soup.triangles.size() && i == 0 && !soup.uvs.empty(); ++t)
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(again.soup.uvs.values[again.soup.uvs.of_triangle[t][k]],
                  soup.uvs.values[soup.uvs.of_triangle[t][k]]);
  }
  return polygons;
}

Simplified_soup reduction_of(const Triangle_soup& soup, double ratio,
                             Placement placement = Placement::vertices, double weld_distance = 0)
{
  Prepare_options prepare_options;
  prepare_options.weld_distance = weld_distance;
  Simplify_options options;
  options.ratio = ratio;
  options.placement = placement;
  return simplify_soup(prepare(soup, prepare_options), options);
}

TEST(Polygons, OfEveryShapeComeBackAsTheyWere)
{
  std::mt19937 random(s_polygons_seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::ostringstream text;
  text.precision(17);
  std::size_t vertices = 0;
  for (int i = 0; i < 300; ++i) {
    // Star-shaped, with reflex corners; some are not flat, and some not simple.
    const int corners = 3 + int(random() % 9);
    for (int k = 0; k < corners; ++k) {
      const double angle = 6.283 * k / corners, radius = 0.3 + std::abs(number(random));
      text << "v " << 3 * i + radius * std::cos(angle) << ' ' << radius * std::sin(angle) << ' '
           << (i % 3 == 0 ? number(random) : 0.0) << '\n';
    }
    text << 'f';
    std::vector<std::size_t> order;
    for (int k = 0; k < corners; ++k)
      order.push_back(++vertices);
    if (i % 10 == 9)
      std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t v : order)
      text << ' ' << v;
    text << '\n';
  }
  const Triangle_soup soup = soup_of_text(text.str());
  const std::array<std::size_t, 3> polygons = expect_read_back(soup);
  EXPECT_EQ(polygons[0], soup.polygons.size());
  const Temporary_folder folder;
  write_mesh(folder / "m.obj", soup);
  EXPECT_EQ(polygons_of(read_file(folder / "m.obj")), polygons_of(text.str()));
}

TEST(Polygons, ThatAReductionLeavesAreThoseOfTheInput)
{
  for (const bool has_uvs : {false, true})
    for (const Placement placement : {Placement::vertices, Placement::optimal}) {
      const std::string text = bumped_quads(24, 0.2, has_uvs);
      const Simplified_soup result = reduction_of(soup_of_text(text), 0.8, placement);
      const std::array<std::size_t, 3> polygons = expect_read_back(result.soup);
      EXPECT_GT(polygons[0], 10u);
      EXPECT_LT(polygons[0], 23u * 23u);
      EXPECT_EQ(polygons[0], polygons[2]);
      const Temporary_folder folder;
      write_mesh(folder / "m.obj", result.soup);
      const Faces before = polygons_of(text), after = polygons_of(read_file(folder / "m.obj"));
      EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
      EXPECT_EQ(after.size(), polygons[0]);
    }
}

/// Two sides of a sheet of quads, the back with vertices of its own or those of the front, and with its quads
/// backwards, each from the corner `first` on.
std::string two_sides(bool has_own_vertices, std::size_t first)
{
  const std::string front = bumped_quads(8, 0.2, true);
  std::istringstream lines(front);
  std::string back;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> corners;
    words >> line;
    for (std::string corner; line == "f" && words >> corner;)
      corners.push_back(std::to_string(std::stoi(corner) + (has_own_vertices ? 64 : 0)));
    if (corners.empty())
      continue;
    std::reverse(corners.begin(), corners.end());
    std::rotate(corners.begin(), corners.begin() + std::ptrdiff_t(first), corners.end());
    back += 'f';
    for (const std::string& corner : corners)
      back += ' ' + corner + '/' + corner;
    back += '\n';
  }
  return front + (has_own_vertices ? bumped_quads(8, 0.2, true).substr(0, front.find('f')) : "") + back;
}

TEST(Polygons, OfTheTwoSidesOfAClothAreCutAlike)
{
  for (const bool has_own_vertices : {false, true})
    for (const std::size_t first : {0, 1, 2, 3}) {
      const Triangle_soup soup = soup_of_text(two_sides(has_own_vertices, first));
      ASSERT_EQ(soup.triangles.size(), 2u * 98u);
      const auto points_of = [&](std::size_t triangle) {
        std::set<Point_3> points;
        for (const Index v : soup.triangles[triangle])
          points.insert(soup.points[v]);
        return points;
      };
      std::multiset<std::set<Point_3>> front, back;
      for (std::size_t t = 0; t < 98; ++t) {
        front.insert(points_of(t));
        back.insert(points_of(98 + t));
        for (std::size_t k = 0; k < 3; ++k) // texture coordinates stay with their corners
          EXPECT_EQ(soup.uvs.values[soup.uvs.of_triangle[98 + t][k]][0] - 0.5,
                    soup.points[soup.triangles[98 + t][k]].x());
      }
      EXPECT_EQ(front, back);
      EXPECT_EQ(expect_read_back(soup), (std::array<std::size_t, 3>{98, 98, 98}));
      // A side without the other comes back as well, and is not cut from its own first corner.
      Triangle_soup alone = soup;
      alone.triangles.erase(alone.triangles.begin(), alone.triangles.begin() + 98);
      alone.uvs.of_triangle.erase(alone.uvs.of_triangle.begin(), alone.uvs.of_triangle.begin() + 98);
      alone.polygons.erase(alone.polygons.begin(), alone.polygons.begin() + 49);
      for (Cut_polygon& polygon : alone.polygons)
        polygon.first_triangle -= 98;
      EXPECT_EQ(expect_read_back(alone), (std::array<std::size_t, 3>{49, 49, 49}));
      // Nearly all of it is reduced, because the sides do not touch but where they coincide.
      EXPECT_LE(reduction_of(soup, 0.3).soup.triangles.size(), 59u);
    }
}

TEST(Polygons, OfTwoSidesThatAreCutOtherwiseAreSplit)
{
  Triangle_soup soup = soup_of_text(bumped_quads(6, 0.2));
  for (int i = 0; i < 25; ++i) { // each quad again, along its other diagonal
    const auto [a, b, c] = soup.triangles[2 * i];
    const Index d = soup.triangles[2 * i + 1][2];
    soup.polygons.push_back({Index(soup.triangles.size()), 4, 0});
    soup.triangles.push_back({b, c, d});
    soup.triangles.push_back({b, d, a});
  }
  EXPECT_EQ(expect_read_back(soup), (std::array<std::size_t, 3>{25, 25, 25}));
}

TEST(Polygons, WithAMovedVertexAreSplit)
{
  // Two sheets of quads beside each other, whose borders snap together.
  const Triangle_soup soup = soup_of_text(bumped_quads(8, 0) + bumped_quads(8, 0, false, 0.8751, 64));
  const Prepared_soup apart = prepare(soup), joined = [&] {
    Prepare_options options;
    options.weld_distance = 0.001;
    return prepare(soup, options);
  }();
  EXPECT_EQ(apart.soup.polygons.size(), 98u);
  ASSERT_GT(joined.snapping.snapped, 0u);
  EXPECT_LT(joined.soup.polygons.size(), 98u);
  for (const Cut_polygon& polygon : joined.soup.polygons)
    for (Index t = polygon.first_triangle; t < polygon.first_triangle + 2; ++t)
      for (const Index v : joined.soup.triangles[t])
        EXPECT_EQ(joined.soup.points[v], soup.points[v]);
}

TEST(Polygons, AreNotWrittenWhereThatWouldChangeATriangle)
{
  const Triangle_soup whole = soup_of_text(bumped_quads(6, 0));
  ASSERT_EQ(expect_read_back(whole), (std::array<std::size_t, 3>{25, 25, 25}));
  // Other triangles than the rule cuts: the other diagonal, another first corner, another order.
  Triangle_soup other = whole;
  const auto [a, b, c] = whole.triangles[0];
  const Index d = whole.triangles[1][2];
  other.triangles[0] = {a, b, d};
  other.triangles[1] = {b, c, d};
  other.triangles[2] = {whole.triangles[2][1], whole.triangles[2][2], whole.triangles[2][0]};
  std::swap(other.triangles[4], other.triangles[5]);
  EXPECT_EQ(expect_read_back(other)[0], 22u);
  // A point has moved, so that the quad is cut along its other diagonal.
  Triangle_soup moved = whole;
  moved.points[whole.triangles[24][1]] = Point_3(-0.12, -0.05, 0); // beyond the line between its neighbours
  EXPECT_LT(expect_read_back(moved)[0], 25u);
  // A list that has nothing to do with the triangles.
  std::mt19937 random(s_polygons_seed);
  for (int i = 0; i < 40; ++i) {
    Triangle_soup wrong = whole;
    for (Cut_polygon& polygon : wrong.polygons)
      if (random() % 3 == 0)
        polygon = {Index(random() % 60), Index(random() % 9), Index(random() % 12)};
    wrong.polygons.push_back({Index(-1), Index(-1), Index(-1)});
    EXPECT_LE(expect_read_back(wrong)[0], 25u);
  }
  // Different labels, attributes, or texture coordinates within a quad.
  Triangle_soup labelled = whole;
  labelled.groups.names = {"a", "b"};
  labelled.groups.of_triangle.assign(50, 0);
  labelled.groups.of_triangle[7] = 1;
  EXPECT_EQ(expect_read_back(labelled)[0], 24u);
  Triangle_soup attributed = whole;
  attributed.triangle_attributes.push_back(
      {"part", Attribute::Type::uint8, 1, false, std::vector<unsigned char>(50, 1)});
  attributed.triangle_attributes[0].rows[9] = 2;
  EXPECT_EQ(expect_read_back(attributed)[2], 24u);
  Triangle_soup textured = soup_of_text(bumped_quads(6, 0, true));
  textured.uvs.values.push_back({5, 5});
  textured.uvs.of_triangle[3][0] = Index(textured.uvs.values.size() - 1);
  EXPECT_EQ(expect_read_back(textured)[0], 24u);
}

TEST(Polygons, OfManyCornersAreSplitWherePlyCannotHoldThem)
{
  for (const int corners : {127, 128, 255, 256, 1000})
    for (const bool has_uvs : {false, true}) {
      std::ostringstream text;
      text.precision(17);
      for (int k = 0; k < corners; ++k)
        text << "v " << std::cos(6.283 * k / corners) << ' ' << std::sin(6.283 * k / corners) << " 0\nvt "
             << k << " 0\n";
      text << 'f';
      for (int k = 1; k <= corners; ++k)
        text << ' ' << k << (has_uvs ? '/' + std::to_string(k) : "");
      const std::array<std::size_t, 3> polygons = expect_read_back(soup_of_text(text.str() + '\n'));
      EXPECT_EQ(polygons, (std::array<std::size_t, 3>{1, 1, corners <= (has_uvs ? 127 : 255) ? 1u : 0u}))
          << corners;
    }
}

TEST(Polygons, OfFlatShadingHaveOneNormal)
{
  // A sheet whose quads are tilted, each flat, with a normal for each.
  std::string text;
  std::ostringstream faces;
  for (int i = 0; i < 60; ++i) {
    const double slope = std::sin(i * 0.7);
    std::ostringstream part;
    part.precision(17);
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.1}, {0.9, 1.1}, {-0.1, 1.0}})
      part << "v " << x + 3 * i << ' ' << y << ' ' << slope * x + 0.3 * y << '\n';
    const double length = std::sqrt(slope * slope + 0.09 + 1);
    part << "vn " << -slope / length << ' ' << -0.3 / length << ' ' << 1 / length << '\n';
    text += part.str();
    faces << 'f';
    for (int k = 1; k <= 4; ++k)
      faces << ' ' << 4 * i + k << "//" << i + 1;
    faces << '\n';
  }
  Prepare_options prepare_options;
  prepare_options.normals = Normals_choice::automatic;
  Simplify_options options;
  options.ratio = 1;
  const Prepared_soup prepared = prepare(soup_of_text(text + faces.str()), prepare_options);
  ASSERT_EQ(prepared.normals, Normals_treatment::flat);
  const Simplified_soup result = simplify_soup(prepared, options);
  EXPECT_EQ(result.soup.normals.values.size(), 60u);
  EXPECT_EQ(written_polygons(result.soup, Mesh_format::obj), 60u);
}

} // namespace
} // namespace selvedge::test
