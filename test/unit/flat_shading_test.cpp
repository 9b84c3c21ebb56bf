// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Files that hold one normal for each vertex, and have several vertices where a mesh shades flat.

#include "support/Temporary_folder.h"
#include "support/reduction.h"
#include "support/soups.h"
#include "support/vertices_used.h"

#include "soup/Gltf_scene.h"

#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

using Json = nlohmann::ordered_json;

Triangle_soup flat_hills()
{
  Triangle_soup soup = mapped(sheet(20, 20), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), float(std::sin(p.x() / 4) + std::cos(p.y() / 5)));
  });
  restore_normals(soup, Normals_treatment::flat);
  return soup;
}

// No square of these is flat.
Triangle_soup flat_bumps()
{
  Triangle_soup soup = mapped(sheet(20, 20), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), float(2 * std::sin(p.x() / 3) * std::cos(p.y() / 3)));
  });
  restore_normals(soup, Normals_treatment::flat);
  return soup;
}

std::string written(const Triangle_soup& soup, const char* name)
{
  const Temporary_folder folder;
  write_mesh(folder / name, soup);
  std::ostringstream text;
  text << std::ifstream(folder / name, std::ios::binary).rdbuf();
  return text.str();
}

Triangle_soup through(const Triangle_soup& soup, const char* name)
{
  return read_mesh(written(soup, name), mesh_format(name), name).soup;
}

Reduction reduced(Triangle_soup soup, double ratio, Normals_choice choice = Normals_choice::automatic)
{
  Prepare_options options;
  options.normals = choice;
  return reduce(std::move(soup), to_ratio(ratio), options);
}

// A document of one node, whose transform turns, scales and mirrors.
Triangle_soup in_a_node(const Triangle_soup& soup)
{
  Json json = Json::parse(written(soup, "m.gltf"));
  json["nodes"][0]["matrix"] = {0, 2, 0, 0, 1, 0, 0, 0, 0, 0, 0.5, 0, 3, 4, 5, 1};
  return read_mesh(json.dump(), Mesh_format::gltf, "m.gltf").soup;
}

TEST(Flat_shading, FilesOfSplitVerticesAreReducedLikeAnyOther)
{
  const Triangle_soup soup = flat_hills();
  for (const Triangle_soup& file : {through(soup, "m.ply"), through(soup, "m.glb"), in_a_node(soup)}) {
    EXPECT_EQ(vertices_used(file), soup.points.size());
    EXPECT_GT(file.points.size(), soup.triangles.size()) << "the vertices of the file keep their numbers";
    ASSERT_TRUE(has_flat_normals(file));
    const Reduction result = reduced(file, 0.3);
    EXPECT_TRUE(result.verification.accepted());
    EXPECT_LE(result.simplified.soup.triangles.size(), soup.triangles.size() * 3 / 10);
    // Written again, they are split again, so that no normal is lost.
    const Triangle_soup again = through(result.simplified.soup, file.scene ? "m.glb" : "m.ply");
    EXPECT_EQ(vertices_used(again), vertices_used(result.simplified.soup));
    EXPECT_TRUE(has_flat_normals(again));
    EXPECT_TRUE(verify(again, file).accepted());
  }
  // The control: with normals that are not flat, most vertices stay apart, and hold the mesh together.
  Triangle_soup other = soup;
  for (std::array<double, 3>& normal : other.normals.values)
    normal = {normal[2], normal[0], normal[1]};
  const Triangle_soup file = through(other, "m.glb");
  EXPECT_GT(vertices_used(file), 3 * soup.points.size());
  EXPECT_GT(reduced(file, 0.3).simplified.soup.triangles.size(), soup.triangles.size() / 2);
}

TEST(Flat_shading, WhatIsNotReducedKeepsItsBytes)
{
  for (const char* name : {"m.ply", "m.glb"}) {
    const std::string file = written(through(flat_hills(), name), name);
    const Triangle_soup soup = read_mesh(file, mesh_format(name), name).soup;
    EXPECT_EQ(written(soup, name), file);
    EXPECT_EQ(written(reduced(soup, 1).simplified.soup, name), file);
  }
}

TEST(Flat_shading, NormalsOfFacesThatStayAreThoseOfTheFile)
{
  Triangle_soup soup = flat_bumps();
  for (std::array<double, 3>& normal : soup.normals.values)
    for (double& x : normal)
      x = std::round(1e4 * x) / 1e4; // as text has them
  const Reduction result = reduced(soup, 0.5);
  const Triangle_soup& left = result.simplified.soup;
  std::size_t stayed = 0, unlike = 0;
  for (std::size_t t = 0; t < left.triangles.size(); ++t) {
    const Index from = result.simplified.triangles[t];
    bool is_same = true;
    for (std::size_t k = 0; k < 3; ++k)
      is_same = is_same && left.points[left.triangles[t][k]] == soup.points[soup.triangles[from][k]];
    stayed += is_same;
    unlike += is_same && left.normals.values[left.normals.of_triangle[t][0]] !=
                             soup.normals.values[soup.normals.of_triangle[from][0]];
  }
  EXPECT_GT(stayed, 10u);
  EXPECT_EQ(unlike, 0u);
  for (std::size_t t = 0; t < left.triangles.size(); ++t) {
    const auto& [a, b, c] = left.triangles[t];
    const auto& [x, y, z] = left.normals.values[left.normals.of_triangle[t][0]];
    const Kernel::Vector_3 of_face =
        CGAL::cross_product(left.points[b] - left.points[a], left.points[c] - left.points[a]);
    EXPECT_LT(CGAL::approximate_angle(of_face, Kernel::Vector_3(x, y, z)), 0.2) << "degrees, at face " << t;
  }
  // The control: on request, all are made anew.
  EXPECT_NE(reduced(soup, 1, Normals_choice::recompute).simplified.soup.normals.values, soup.normals.values);
}

// Both triangles of a square have its normal, so that they share the vertices of their diagonal.
TEST(Flat_shading, FilesOfSquaresLoseVerticesWithTheirFaces)
{
  Triangle_soup soup = flat_bumps();
  const std::vector<std::array<double, 3>> of_triangle = soup.normals.values;
  for (std::size_t t = 0; t < of_triangle.size(); t += 2) {
    std::array<double, 3>& normal = soup.normals.values[t];
    for (std::size_t i = 0; i < 3; ++i)
      normal[i] = float((of_triangle[t][i] + of_triangle[t + 1][i]) / 2);
    soup.normals.values[t + 1] = normal;
  }
  const auto vertices = [](const Triangle_soup& squares, double ratio) {
    const Triangle_soup file = through(squares, "m.glb");
    return double(through(reduced(file, ratio).simplified.soup, "m.glb").points.size());
  };
  EXPECT_EQ(vertices(soup, 1), 2 * soup.triangles.size()) << "four for each square";
  EXPECT_LT(vertices(soup, 0.9), 0.95 * vertices(soup, 1)); // 0.99 if squares that bend got two normals
}

TEST(Flat_shading, GltfGetsTheNormalsOfTheResult)
{
  const Triangle_soup scene = in_a_node(flat_hills());
  const Triangle_soup result = reduced(scene, 0.3).simplified.soup, file = through(result, "m.glb");
  ASSERT_EQ(file.triangles.size(), result.triangles.size());
  for (std::size_t t = 0; t < file.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(file.normals.values[file.normals.of_triangle[t][0]][i],
                  result.normals.values[result.normals.of_triangle[t][0]][i], 1e-6);
  EXPECT_TRUE(through(reduced(scene, 0.3, Normals_choice::drop).simplified.soup, "m.glb").normals.empty());
}

TEST(Flat_shading, VerticesThatDifferInMoreStayApart)
{
  const std::string text = written(flat_hills(), "m.gltf");
  const auto used_with = [&](const char* attribute, bool is_target) {
    Json json = Json::parse(text);
    // Every normal is that of one face, so that these rows differ where normals do.
    Json& primitive = json["meshes"][0]["primitives"][0];
    const Json normals = primitive["attributes"]["NORMAL"];
    if (is_target)
      primitive["targets"] = {{{attribute, normals}}};
    else
      primitive["attributes"][attribute] = normals;
    return vertices_used(read_mesh(json.dump(), Mesh_format::gltf, "m.gltf").soup);
  };
  EXPECT_EQ(used_with("NORMAL", false), flat_hills().points.size()); // the control
  EXPECT_GT(used_with("_ID", false), flat_hills().triangles.size());
  EXPECT_GT(used_with("POSITION", true), flat_hills().triangles.size());

  Triangle_soup soup = through(flat_hills(), "m.ply"); // a colour for each vertex of the file
  Attribute red{"red", Attribute::Type::uint16, 1, false, {}};
  soup.triangles = soup.normals.of_triangle;
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    red.rows.insert(red.rows.end(), {static_cast<unsigned char>(v), static_cast<unsigned char>(v >> 8)});
  soup.vertex_attributes.push_back(red);
  EXPECT_EQ(vertices_used(through(soup, "m.ply")), soup.points.size());
}

/// Two curved slopes that meet in a ridge along x = 10, where each has its own smooth normals.
Triangle_soup ridge()
{
  const auto height = [](double x, double y) { return float(x / 4 + x * x / 40 + std::sin(y / 3) / 2); };
  Triangle_soup soup = joined(
      mapped(sheet(10, 20), [&](const Point_3& p) { return Point_3(p.x(), p.y(), height(p.x(), p.y())); }),
      mapped(sheet(10, 20),
             [&](const Point_3& p) { return Point_3(10 + p.x(), p.y(), height(10 - p.x(), p.y())); }));
  soup.normals.of_triangle = soup.triangles; // one normal for each vertex
  soup.normals.values.resize(soup.points.size());
  restore_normals(soup, Normals_treatment::smooth);
  return soup;
}

TEST(Dropped_normals, LeaveNoVerticesThatDifferInThemAlone)
{
  const std::size_t apart = 2 * 11 * 21, together = 21 * 21;
  for (const char* name : {"m.ply", "m.glb", "m.gltf"}) {
    const Triangle_soup before = std::string(name) == "m.gltf" ? in_a_node(ridge()) : through(ridge(), name);
    ASSERT_FALSE(has_flat_normals(before));
    ASSERT_EQ(vertices_used(before), apart);
    Triangle_soup file = before;
    EXPECT_GT(share_vertices_without_normals(file), 21u);
    EXPECT_EQ(vertices_used(file), together);
    const std::vector<Piece> whole = pieces(file);
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(whole[0].boundary_loops, 1u);

    const Triangle_soup result = reduced(file, 1, Normals_choice::drop).simplified.soup;
    EXPECT_EQ(through(result, name).points.size(), together);
    // What is left of the ridge is an edge like any other: it may turn as it likes, and vertices leave it.
    const Reduction few = reduced(file, 0.1, Normals_choice::drop);
    EXPECT_TRUE(few.verification.accepted());
    EXPECT_LE(few.simplified.soup.triangles.size(), 80u);
    EXPECT_TRUE(verify(through(few.simplified.soup, name), before).accepted());
    // The control: nobody has joined them.
    EXPECT_EQ(through(reduced(before, 1, Normals_choice::drop).simplified.soup, name).points.size(), apart);
  }
}

TEST(Loose_normals, BringTheirTangentsAlong)
{
  Json json = Json::parse(written(ridge(), "m.gltf"));
  Json& primitive = json["meshes"][0]["primitives"][0];
  const Json normals = primitive["attributes"]["NORMAL"]; // as numbers that tell which row it was
  primitive["attributes"]["TANGENT"] = normals;
  primitive["targets"] = {{{"POSITION", primitive["attributes"]["POSITION"]}, {"NORMAL", normals}}};
  Triangle_soup file = read_mesh(json.dump(), Mesh_format::gltf, "m.gltf").soup;
  std::set<std::string> of_file;
  const Gltf_scene::Block& block_of_file = file.scene->blocks.at(0);
  for (Index row = 0; row < block_of_file.size; ++row)
    of_file.emplace(block_of_file.normals()->row(row));
  share_vertices_without_normals(file);
  const Simplified_soup result = reduced(file, 0.5, Normals_choice::loose).simplified;
  EXPECT_EQ(result.mended_normals, 0u);
  const Triangle_soup out = through(result.soup, "m.gltf");
  std::set<std::pair<double, double>> places;
  for (const Point_3& p : out.points)
    places.emplace(p.x(), p.y());
  EXPECT_GT(out.points.size(), places.size()); // the ridge is hard where it is left
  const Gltf_scene::Block& block = out.scene->blocks.at(0);
  std::size_t of_both_sides = 0;
  for (Index row = 0; row < block.size; ++row) {
    const std::string_view normal = block.normals()->row(row);
    if (of_file.count(std::string(normal)) == 0)
      continue; // it is fitted
    of_both_sides += std::count(out.points.begin(), out.points.end(), out.points[row]) > 1;
    for (const Gltf_scene::Column& column : block.attributes)
      if (column.name == "TANGENT") {
        EXPECT_EQ(column.row(row), normal);
      }
    for (const Gltf_scene::Column& column : block.targets.at(0))
      if (column.name == "NORMAL") {
        EXPECT_EQ(column.row(row), normal);
      }
  }
  EXPECT_GT(of_both_sides, 5u);
}

TEST(Dropped_normals, JoinNothingThatDiffersInMore)
{
  const std::string text = written(ridge(), "m.gltf");
  const auto used_with = [&](const char* attribute, bool is_target) {
    Json json = Json::parse(text);
    Json& primitive = json["meshes"][0]["primitives"][0];
    const Json normals = primitive["attributes"]["NORMAL"]; // which differ at the ridge
    if (is_target)
      primitive["targets"] = {{{"POSITION", primitive["attributes"]["POSITION"]}, {attribute, normals}}};
    else
      primitive["attributes"][attribute] = normals;
    Triangle_soup soup = read_mesh(json.dump(), Mesh_format::gltf, "m.gltf").soup;
    share_vertices_without_normals(soup);
    return vertices_used(soup);
  };
  const std::size_t apart = 2 * 11 * 21, together = 21 * 21;
  EXPECT_EQ(used_with("NORMAL", false), together);
  EXPECT_EQ(used_with("NORMAL", true), together) << "means nothing without the others";
  EXPECT_EQ(used_with("_ID", false), apart);

  Triangle_soup posed = through(ridge(), "m.ply");
  posed.poses = {{"apart", posed.points, 0}};
  for (std::size_t v = posed.points.size() / 2; v < posed.points.size(); ++v)
    posed.poses[0].points[v] = Point_3(posed.points[v].x() + 1, posed.points[v].y(), posed.points[v].z());
  EXPECT_EQ(share_vertices_without_normals(posed), 0u);

  Triangle_soup pieces = joined(ridge(), moved(ridge(), 20, 0, 0)); // alike where they meet, in normals too
  pieces.normals.of_triangle = pieces.triangles;
  pieces.normals.values.assign(pieces.points.size(), {0, 0.6, 0.8});
  Triangle_soup file = through(pieces, "m.ply");
  EXPECT_EQ(share_vertices_without_normals(file), 0u);

  Triangle_soup corners = ridge(); // as OBJ has them: a vertex has several
  corners.normals.of_triangle[0][0] = corners.normals.of_triangle[1][2];
  corners.normals.values.push_back({1, 0, 0});
  corners.normals.of_triangle[0][0] = Index(corners.normals.values.size() - 1);
  EXPECT_EQ(share_vertices_without_normals(corners), 0u);
}

/// A sheet that shades smoothly, in two halves whose normals differ along x = 10 by an angle in degrees.
/// Along it, vertices are there twice.
Triangle_soup halves(double degrees)
{
  const auto bent = [](Triangle_soup half) {
    return mapped(half, [](const Point_3& p) { return Point_3(p.x(), p.y(), float(std::sin(p.x() / 4))); });
  };
  Triangle_soup soup = joined(bent(sheet(10, 20)), bent(moved(sheet(10, 20), 10, 0, 0)));
  soup.normals.of_triangle = soup.triangles;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const double turn = v < soup.points.size() / 2 ? 0 : degrees * CGAL_PI / 180;
    const double angle = std::atan(std::cos(soup.points[v].x() / 4) / 4) + turn;
    soup.normals.values.push_back({float(-std::sin(angle)), 0, float(std::cos(angle))});
  }
  return soup;
}

TEST(Near_normals, VerticesThatDifferInTheirLastDigitsAreOne)
{
  for (const char* name : {"m.ply", "m.glb", "m.gltf"}) {
    const auto read = [&](double degrees) {
      return std::string(name) == "m.gltf" ? in_a_node(halves(degrees)) : through(halves(degrees), name);
    };
    const Triangle_soup file = read(1e-4);
    ASSERT_FALSE(has_flat_normals(file));
    EXPECT_EQ(vertices_used(file), 21u * 21);
    EXPECT_EQ(file.points.size(), 22u * 21) << "the vertices of the file keep their numbers";
    const Reduction result = reduced(file, 0.1);
    EXPECT_EQ(result.prepared.normals, Normals_treatment::fitted);
    EXPECT_TRUE(result.verification.accepted());
    EXPECT_LE(result.simplified.soup.triangles.size(), file.triangles.size() / 10);
    const Triangle_soup written = through(result.simplified.soup, name);
    EXPECT_EQ(written.points.size(), vertices_used(result.simplified.soup));
    EXPECT_TRUE(verify(written, file).accepted());
    // The controls: normals that differ by more, and those that are to be kept, bit for bit.
    EXPECT_EQ(vertices_used(read(1)), 22u * 21);
    const Triangle_soup kept = reduced(file, 1, Normals_choice::keep).simplified.soup;
    EXPECT_EQ(through(kept, name).points.size(), 22u * 21);
  }
  // The others can be joined as well when there are to be no normals.
  Triangle_soup both = joined(halves(1), moved(halves(1e-4), 50, 0, 0));
  const std::vector<std::array<double, 3>> others = halves(1e-4).normals.values;
  both.normals.values.insert(both.normals.values.end(), others.begin(), others.end());
  both.normals.of_triangle = both.triangles;
  Triangle_soup partly = through(both, "m.ply");
  ASSERT_EQ(vertices_used(partly), 43u * 21);
  share_vertices_without_normals(partly);
  EXPECT_EQ(vertices_used(partly), 42u * 21);
  // Vertices that differ in nothing at all are those of pieces.
  EXPECT_EQ(vertices_used(through(halves(0), "m.ply")), 22u * 21);
}

TEST(Near_normals, VerticesThatDifferInNothingAreOneWhereTheyHaveTexture)
{
  for (const char* name : {"m.ply", "m.glb"})
    for (const bool is_moved : {false, true}) {
      Triangle_soup soup = halves(0);
      for (std::size_t v = 0; v < soup.points.size(); ++v)
        soup.uvs.values.push_back({soup.points[v].x() / 32, soup.points[v].y() / 32});
      if (is_moved)
        for (std::size_t v = 0; v < soup.points.size() / 2; ++v)
          soup.uvs.values[v][1] += 0.25;
      soup.uvs.of_triangle = soup.triangles;
      const Triangle_soup file = through(soup, name);
      EXPECT_EQ(vertices_used(file), is_moved ? 22u * 21 : 21u * 21) << name;
      const Reduction result = reduced(file, 0.1);
      EXPECT_TRUE(result.verification.accepted()) << name;
      EXPECT_TRUE(verify(through(result.simplified.soup, name), file).accepted()) << name;
    }
}

TEST(Flat_shading, PiecesBesideEachOtherStayPieces)
{
  Triangle_soup pieces = joined(sheet(5, 5), moved(sheet(5, 5), 5, 0, 0));
  restore_normals(pieces, Normals_treatment::flat);
  ASSERT_TRUE(has_flat_normals(pieces));
  EXPECT_EQ(vertices_used(through(pieces, "m.ply")), pieces.points.size());
  EXPECT_EQ(vertices_used(through(pieces, "m.glb")), pieces.points.size());
}

// What a morph target adds is that of the vertex, whatever its normal is now, and turns with this normal.
TEST(Fitted_normals, KeepWhatMorphTargetsAdd)
{
  Json json = Json::parse(written(ridge(), "m.gltf"));
  Json& primitive = json["meshes"][0]["primitives"][0];
  const Json positions = primitive["attributes"]["POSITION"]; // as numbers that tell which row it was
  primitive["targets"] = {{{"POSITION", positions}, {"NORMAL", positions}}};
  const Triangle_soup file = read_mesh(json.dump(), Mesh_format::gltf, "m.gltf").soup;
  const Simplified_soup result = reduced(file, 0.2).simplified;
  EXPECT_GT(result.fitted_normals, 50u);
  const Triangle_soup out = through(result.soup, "m.gltf");
  EXPECT_EQ(out.points.size(), vertices_used(result.soup));
  const Gltf_scene::Block& block = out.scene->blocks.at(0);
  const auto length = [](std::string_view row) {
    std::array<float, 3> numbers;
    std::memcpy(numbers.data(), row.data(), sizeof numbers);
    return std::hypot(numbers[0], numbers[1], numbers[2]);
  };
  ASSERT_EQ(block.targets.at(0).size(), 2u);
  for (const Gltf_scene::Column& column : block.targets.at(0))
    for (Index row = 0; row < block.size; ++row) {
      const std::string_view position = block.attributes.front().row(row);
      if (column.name == "POSITION")
        EXPECT_EQ(column.row(row), position);
      else
        EXPECT_NEAR(length(column.row(row)), length(position), 1e-5) << "vertex " << row;
    }
}

} // namespace
} // namespace selvedge::test
