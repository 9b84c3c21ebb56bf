// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Poles in glTF files, which hold a vertex for each pair of texture coordinates there: they are read as one
// vertex, and each corner is written with the row that it had (G3, G4, G6).

#include "support/Gltf_document.h"
#include "support/Temporary_folder.h"
#include "support/logged_reduction.h"
#include "support/polar_sphere.h"
#include "support/reduction.h"

#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>
#include <selvedge/progressive.h>
#include <selvedge/rounding.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace selvedge::test {
namespace {

Triangle_soup written_and_read(const Triangle_soup& soup)
{
  const Temporary_folder folder;
  write_mesh(folder / "a.glb", soup);
  return read_mesh(folder / "a.glb").soup;
}

/// A sphere of 1,472 triangles as a glTF file holds it, with a vertex for each of the 32 triangles at a pole.
Triangle_soup sphere_of_gltf(Triangle_soup sphere = polar_sphere(32, 24, false))
{
  round_to_float32(sphere);
  return written_and_read(sphere);
}

std::set<Index> vertices_at_poles(const Triangle_soup& soup)
{
  std::set<Index> result;
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle)
      if (is_pole(soup.points[v]))
        result.insert(v);
  return result;
}

bool are_facts_kept(const Triangle_soup& before, const Triangle_soup& after)
{
  const auto all = facts_of_corners(before), left = facts_of_corners(after);
  return std::includes(all.begin(), all.end(), left.begin(), left.end());
}

TEST(Gltf_poles, AreOneVertexThatIsWrittenAsItWas)
{
  const Temporary_folder folder;
  Triangle_soup sphere = polar_sphere(32, 24, false);
  round_to_float32(sphere);
  write_mesh(folder / "a.glb", sphere);
  const Mesh_file file = read_mesh(folder / "a.glb");
  EXPECT_EQ(vertices_at_poles(file.soup).size(), 2u);
  EXPECT_EQ(file.soup.points.size(), 23u * 33 + 64) << "all rows of the file keep their numbers";
  EXPECT_EQ(file.notes.remarks.size(), 1u);
  write_mesh(folder / "b.glb", file.soup);
  EXPECT_EQ(facts_of_corners(read_mesh(folder / "b.glb").soup), facts_of_corners(file.soup));
  EXPECT_EQ(contents(folder / "b.glb").size(), contents(folder / "a.glb").size());
}

TEST(Gltf_poles, AreReducedAndReadBackAsTheyAreInTheResult)
{
  const Triangle_soup sphere = sphere_of_gltf();
  for (const Placement placement : {Placement::vertices, Placement::optimal})
    for (const std::size_t cell_faces : {0, 150}) {
      Simplify_options options = to_ratio(0.15);
      options.placement = placement;
      options.faces_per_cell = cell_faces;
      const Logged_reduction reduction = reduce_and_log(sphere, options);
      const Triangle_soup& result = reduction.simplified.soup;
      EXPECT_TRUE(reduction.simplified.report.is_reached());
      EXPECT_LT(faces_at_poles(result), 40u);
      EXPECT_EQ(vertices_at_poles(result).size(), 2u);
      EXPECT_TRUE(placement == Placement::optimal || are_facts_kept(sphere, result));
      const Triangle_soup again = written_and_read(result);
      EXPECT_EQ(facts_of_corners(again), facts_of_corners(result));
      const Replay_verdict verdict = replay_text(sphere, reduction.log);
      EXPECT_TRUE(verdict.is_accepted()) << verdict.violations.front().message;
      EXPECT_TRUE(verify(reduction.simplified, prepare(sphere)).accepted());
    }
}

// A control: where one edge differs at one end, at the end of a seam, vertices stay apart; so do those of a
// cut of two edges, and those that differ in colours.
TEST(Gltf_poles, AreNoneAtCutsNorOfSeveralColours)
{
  // Four triangles around vertex 0, which has so many texture coordinates; or one where a seam comes to it.
  const auto vertices_at_centre = [](Index values, bool has_colours) {
    Triangle_soup soup;
    soup.points = {Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(-1, 0, 0),
                   Point_3(0, -1, 0)};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
    for (Index i = 0; i < 9; ++i)
      soup.uvs.values.push_back({0.125 * i, 0});
    soup.uvs.of_triangle = soup.triangles;
    for (Index t = 0; t < 4; ++t)
      soup.uvs.of_triangle[t][0] = 5 + std::min(t, values - 1);
    if (values == 1) {
      soup.uvs.of_triangle[2][0] = soup.uvs.of_triangle[3][0] = 6;
      soup.uvs.of_triangle[3][2] = 7;
    }
    const Triangle_soup read = sphere_of_gltf(soup);
    if (!has_colours)
      return vertices_at_poles(read).size();
    // Back to a vertex for each row of the file, with a colour of its own.
    Triangle_soup coloured;
    coloured.points = read.points;
    coloured.triangles = read.uvs.of_triangle;
    coloured.uvs = read.uvs;
    for (const char* const name : {"red", "green", "blue"}) {
      Attribute colour = {name, Attribute::Type::uint8, 1, true, {}};
      for (std::size_t v = 0; v < coloured.points.size(); ++v)
        colour.rows.push_back(static_cast<unsigned char>(v));
      coloured.vertex_attributes.push_back(colour);
    }
    return vertices_at_poles(written_and_read(coloured)).size();
  };
  EXPECT_EQ(vertices_at_centre(4, false), 1u);
  EXPECT_EQ(vertices_at_centre(4, true), 4u);
  EXPECT_EQ(vertices_at_centre(3, false), 1u);
  EXPECT_EQ(vertices_at_centre(2, false), 2u);
  EXPECT_EQ(vertices_at_centre(1, false), 2u);
}

/// Six triangles around a centre, which has a row for each; the last number of its texture coordinates is 0
/// and -0 in turn, which are one texture coordinate of the soup, and what a morph target adds to normals
/// differs. All rows of the centre have few first ones.
Document disc_with_signed_zeros(std::size_t first_numbers)
{
  constexpr std::size_t sides = 6;
  Document document;
  document.json = {
      {"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};
  const auto position = [](std::size_t i, std::size_t k) {
    const double angle = 2 * CGAL_PI * double(i) / sides;
    return i >= sides || k == 2 ? 0 : float(k == 0 ? std::cos(angle) : std::sin(angle));
  };
  const auto uv = [&](std::size_t i, std::size_t k) {
    if (k == 0)
      return double(i % first_numbers) / 8;
    return i < sides ? 1. : i % 2 == 0 ? 0. : -0.;
  };
  std::string indices;
  for (std::size_t i = 0; i < sides; ++i)
    for (const std::size_t v : {sides + i, i, (i + 1) % sides})
      put(indices, std::uint16_t(v));
  Json primitive;
  primitive["attributes"]["POSITION"] = add_rows<float>(document, 2 * sides, 3, 5126, position);
  set_bounds(document, primitive["attributes"]["POSITION"], 2 * sides, position);
  primitive["attributes"]["TEXCOORD_0"] = add_rows<float>(document, 2 * sides, 2, 5126, uv);
  primitive["attributes"]["NORMAL"] =
      add_rows<float>(document, 2 * sides, 3, 5126, [](std::size_t, std::size_t k) { return k == 2; });
  primitive["targets"] = {{{"NORMAL", add_rows<float>(document, 2 * sides, 3, 5126, [](auto i, auto k) {
                              return k == 0 ? 0.01 * double(i) : 0;
                            })}}};
  primitive["indices"] = add_accessor(document, indices, 3 * sides, 5123, "SCALAR");
  document.json["meshes"] = {{{"primitives", {primitive}}}};
  return document;
}

// What corners know of a row must tell it from the others, so that each gets its own row again.
TEST(Gltf_poles, AreNoneOfRowsThatCornersCannotTellApart)
{
  const Temporary_folder folder;
  const auto values_at_corners = [&](const char* name) {
    const Document document = from_glb(contents(folder / name));
    const Json& primitive = document.json["meshes"][0]["primitives"][0];
    const std::vector<std::string> uvs = rows_of(document, primitive["attributes"]["TEXCOORD_0"]),
                                   turns = rows_of(document, primitive["targets"][0]["NORMAL"]);
    std::vector<std::string> result;
    for (const std::string& index : rows_of(document, primitive["indices"]))
      result.push_back(uvs[get<std::uint16_t>(index, 0)] + turns[get<std::uint16_t>(index, 0)]);
    return result;
  };
  for (const std::size_t first_numbers : {6, 3}) {
    std::ofstream(folder / "a.glb", std::ios::binary) << to_glb(disc_with_signed_zeros(first_numbers));
    const Triangle_soup soup = read_mesh(folder / "a.glb").soup;
    EXPECT_EQ(vertices_at_poles(soup).size(), first_numbers == 6 ? 1u : 6u);
    write_mesh(folder / "b.glb", soup);
    EXPECT_EQ(values_at_corners("b.glb"), values_at_corners("a.glb"));
  }
}

// A file whose normals cut the faces around a pole apart is whole again without them.
TEST(Gltf_poles, AreWholeWithoutNormals)
{
  constexpr std::size_t segments = 16;
  Triangle_soup sphere = polar_sphere(segments, 8, false);
  // Two faces at a pole have one texture coordinate, also where normals cut them apart.
  for (std::size_t s = 2; s < 2 * segments; s += 2)
    if (s != segments) {
      const std::size_t t = sphere.triangles.size() - 2 * segments + s;
      sphere.uvs.of_triangle[t][0] = sphere.uvs.of_triangle[t - 1][0];
    }
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t) {
    const Index value = Index(sphere.normals.values.size());
    const double height = CGAL::to_double(sphere.points[sphere.triangles[t][1]].y());
    // Two halves, and a normal for each face of one of them.
    sphere.normals.values.push_back(height > 0.01 ? std::array<double, 3>{0, 0, 1}
                                                  : std::array<double, 3>{0, 1, double(t)});
    sphere.normals.of_triangle.push_back({value, value, value});
  }
  Triangle_soup read = sphere_of_gltf(sphere);
  const std::size_t with_normals = vertices_at_poles(read).size();
  EXPECT_GT(with_normals, 2u);
  EXPECT_LT(with_normals, 2 * segments);
  EXPECT_GT(share_vertices_without_normals(read), 0u);
  EXPECT_EQ(vertices_at_poles(read).size(), 2u);
  EXPECT_EQ(share_vertices_without_normals(read), 0u);
  EXPECT_EQ(vertices_at_poles(read).size(), 2u) << "once more";
  EXPECT_EQ(facts_of_corners(read), facts_of_corners(sphere_of_gltf(sphere)));
}

// Many programs read texture coordinates of vertices alone from PLY files.
TEST(Gltf_poles, LeaveVerticesTheirTextureCoordinatesInPly)
{
  const Temporary_folder folder;
  const Triangle_soup result = reduce(sphere_of_gltf(), to_ratio(0.15)).simplified.soup;
  write_mesh(folder / "a.ply", result);
  const Triangle_soup read = read_mesh(folder / "a.ply").soup;
  EXPECT_EQ(read.uvs.of_triangle, read.triangles);
  EXPECT_EQ(facts_of_corners(read), facts_of_corners(result));
}

TEST(Gltf_poles, AreInEveryLevelOfAProgressiveFile)
{
  const Temporary_folder folder;
  const Triangle_soup sphere = sphere_of_gltf();
  const Prepared_soup prepared = prepare(sphere);
  Simplify_options options = to_ratio(0.15);
  options.is_progression_recorded = true;
  const Simplified_soup simplified = simplify_soup(prepared, options);
  write_progressive(folder / "a.glb", prepared.soup, simplified.progression);
  const Progressive_mesh mesh = read_progressive(folder / "a.glb");
  for (const std::size_t faces : {1472u, 700u, 220u}) {
    const Triangle_soup at = level(mesh, steps_to_faces(mesh, faces));
    EXPECT_LT(vertices_at_poles(at).size(), faces_at_poles(at) / 2);
    EXPECT_TRUE(are_facts_kept(sphere, at));
    EXPECT_EQ(facts_of_corners(written_and_read(at)), facts_of_corners(at));
  }
}

TEST(Gltf_poles, AreInEveryLevelOfDetailOfOneFile)
{
  const Temporary_folder folder;
  const Triangle_soup sphere = sphere_of_gltf();
  const std::vector<Simplified_soup> levels = simplify_lods(prepare(sphere), {}, {0.5, 0.15});
  write_levels_of_detail(folder / "a.glb", {sphere, levels[0].soup, levels[1].soup});
  for (std::size_t i = 0; i < 3; ++i) {
    Read_options options;
    options.level_of_detail = i;
    const Triangle_soup read = read_mesh(folder / "a.glb", options).soup;
    EXPECT_EQ(facts_of_corners(read), facts_of_corners(i == 0 ? sphere : levels[i - 1].soup));
    EXPECT_EQ(vertices_at_poles(read).size(), 2u);
  }
}

} // namespace
} // namespace selvedge::test
