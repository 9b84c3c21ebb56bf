// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Progressive files: every state of a reduction, from one file.

#include "support/Temporary_folder.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include "progressive/lists.h"
#include "soup/Gltf_scene.h"
#include "soup/selection.h"
#include <selvedge/Error.h>
#include <selvedge/generate.h>
#include <selvedge/normals.h>
#include <selvedge/progressive.h>
#include <selvedge/rounding.h>
#include <selvedge/verify.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

using Json = nlohmann::ordered_json;

Prepared_soup prepared_as_floats(Triangle_soup soup)
{
  Prepare_options options;
  options.round_to_float32 = true;
  options.normals = Normals_choice::automatic;
  return prepare(std::move(soup), options);
}

Simplified_soup simplify_recorded(const Prepared_soup& prepared, double ratio = 0)
{
  Simplify_options options = to_ratio(ratio);
  options.is_progression_recorded = true;
  return simplify_soup(prepared, options);
}

Triangle_soup read_back(const Triangle_soup& soup)
{
  const Temporary_folder folder;
  write_mesh(folder / "a.glb", soup);
  return read_mesh(folder / "a.glb").soup;
}

std::string progressive_file(const Triangle_soup& soup, const Progression& progression,
                             const Progressive_notes& notes = {})
{
  const Temporary_folder folder;
  write_progressive(folder / "a.glb", soup, progression, notes);
  return read_file(folder / "a.glb");
}

Progressive_mesh read_again(const Triangle_soup& soup, const Progression& progression,
                            const Progressive_notes& notes = {})
{
  return read_progressive(progressive_file(soup, progression, notes), Mesh_format::glb, "a.glb");
}

// What one corner has, and the labels of its triangle.
std::string corner(const Triangle_soup& soup, std::size_t t, std::size_t k)
{
  const Index v = soup.triangles[t][k];
  std::string result = soup.materials.empty() ? "" : soup.materials.names[soup.materials.of_triangle[t]];
  result += '/' + soup.groups.names[soup.groups.of_triangle[t]] + '/';
  const auto add = [&](const auto& numbers) {
    result.append(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  };
  add(std::array{soup.points[v].x(), soup.points[v].y(), soup.points[v].z()});
  if (!soup.uvs.empty())
    add(soup.uvs.values[soup.uvs.of_triangle[t][k]]);
  if (!soup.normals.empty())
    add(soup.normals.values[soup.normals.of_triangle[t][k]]);
  for (const Attribute& attribute : soup.vertex_attributes)
    result.append(reinterpret_cast<const char*>(attribute.rows.data()) + v * row_size(attribute),
                  row_size(attribute));
  return result;
}

void expect_same(const Triangle_soup& a, const Triangle_soup& b)
{
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  EXPECT_EQ(a.uvs.empty(), b.uvs.empty());
  EXPECT_EQ(a.normals.empty(), b.normals.empty());
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_EQ(corner(a, t, k), corner(b, t, k)) << "triangle " << t;
}

TEST(Progressive, EachLevelIsWhatARunToItAloneGives)
{
  for (const char* const name : {"jacket", "skirt", "shorts"}) {
    SCOPED_TRACE(name);
    const Prepared_soup prepared = prepared_as_floats(garment(name, 2400, 2));
    const Simplified_soup least = simplify_recorded(prepared);
    const Progressive_mesh mesh = read_again(prepared.soup, least.progression);
    ASSERT_EQ(mesh.step_count(), least.progression.steps.size());
    EXPECT_EQ(mesh.faces.back(), least.soup.triangles.size());
    expect_same(read_back(level(mesh, mesh.step_count())), read_back(least.soup));
    for (const double ratio : {1.0, 0.7, 0.3}) {
      SCOPED_TRACE(ratio);
      const Simplified_soup alone = simplify_soup(prepared, to_ratio(ratio));
      const Triangle_soup soup = level(mesh, steps_to_faces(mesh, alone.soup.triangles.size()));
      expect_same(read_back(soup), read_back(alone.soup));
      EXPECT_TRUE(is_embedded(soup));
    }
  }
}

TEST(Progressive, ControlAStepToAnotherVertexPierces)
{
  const Prepared_soup prepared = prepared_as_floats(nested_spheres(1200, 3, 1e-2));
  Progressive_mesh mesh = read_again(prepared.soup, simplify_recorded(prepared, 0.3).progression);
  ASSERT_TRUE(is_embedded(level(mesh, mesh.step_count())));
  // A vertex of the innermost sphere goes to one of the outermost, or the other way round.
  const auto last = std::find_if(mesh.steps.rbegin(), mesh.steps.rend(),
                                 [](Index step) { return step != Progressive_mesh::never; });
  const Index v = Index(mesh.steps.rend() - last) - 1;
  const auto size = [&](Index i) {
    const Point_3& p = mesh.soup.points[i];
    return p.x() * p.x() + p.y() * p.y() + p.z() * p.z();
  };
  Index other = 0;
  for (Index i = 0; i < v; ++i)
    if (mesh.steps[i] == Progressive_mesh::never &&
        std::abs(size(i) - size(v)) > std::abs(size(other) - size(v)))
      other = i;
  mesh.merges_into[v] = other;
  const std::vector<Index> now = progressive::vertices_after(mesh, mesh.step_count());
  mesh.faces.back() = Index(std::count_if(mesh.soup.triangles.begin(), mesh.soup.triangles.end(),
                                          [&](const Index_triple& triangle) {
                                            const auto& [a, b, c] = triangle;
                                            return now[a] != now[b] && now[b] != now[c] && now[c] != now[a];
                                          }));
  EXPECT_FALSE(is_embedded(level(mesh, mesh.step_count())));
}

TEST(Progressive, TheVerticesOfALevelAreTheFirstOfEachBuffer)
{
  const Prepared_soup prepared = prepared_as_floats(garment("jacket", 2400, 2));
  const Progressive_mesh mesh = read_again(prepared.soup, simplify_recorded(prepared).progression);
  const std::size_t steps = mesh.step_count() / 2;
  const Triangle_soup soup = level(mesh, steps);
  std::vector<Point_3> expected;
  for (Index v = 0; v < mesh.soup.points.size(); ++v)
    if (mesh.steps[v] > steps)
      expected.push_back(mesh.soup.points[v]);
  EXPECT_EQ(soup.points, expected);
  EXPECT_LT(expected.size(), mesh.soup.points.size());
}

TEST(Progressive, IndexBuffersOfLevelsUseTheFirstVertices)
{
  const Prepared_soup prepared = prepared_as_floats(garment("jacket", 2000, 2));
  const Progression progression = simplify_recorded(prepared, 0.3).progression;
  Progressive_notes notes;
  notes.levels = {1500, 800};
  const Temporary_folder folder;
  write_progressive(folder / "a.gltf", prepared.soup, progression, notes);
  const Progressive_mesh mesh = read_progressive(folder / "a.gltf");
  const Json json = Json::parse(read_file(folder / "a.gltf"));
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& of_level = json["extras"]["selvedge_progressive"]["levels"][i];
    EXPECT_EQ(of_level["step"], steps_to_faces(mesh, notes.levels[i]));
    std::size_t corners = 0;
    for (const Json& of_mesh : json["meshes"])
      for (const Json& primitive : of_mesh["primitives"])
        if (const Json& accessor = primitive["extras"]["selvedge_progressive"]["levels"][i];
            !accessor.is_null())
          corners += json["accessors"][accessor.get<std::size_t>()]["count"].get<std::size_t>();
    EXPECT_EQ(corners, 3 * level(mesh, of_level["step"].get<std::size_t>()).triangles.size());
  }
}

TEST(Progressive, EveryStateIsThatOfTheReduction)
{
  // The triangles that the levels of one run have, by their numbers and vertices.
  const Prepared_soup prepared = prepare(garment("shorts", 1500, 2));
  const Progression progression = simplify_recorded(prepared).progression;
  std::vector<Index> vertex_of;
  for (std::size_t t = 0; t < progression.wedges.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      vertex_of.resize(std::max<std::size_t>(vertex_of.size(), progression.wedges[t][k] + 1));
      vertex_of[progression.wedges[t][k]] = prepared.soup.triangles[t][k];
    }
  for (const std::size_t steps : {std::size_t(1), progression.steps.size() / 3, progression.steps.size()}) {
    const std::vector<Wedge_triangle> left = triangles_after(progression, steps);
    Simplify_options options;
    options.faces = left.size();
    const Simplified_soup alone = simplify_soup(prepared, options);
    ASSERT_EQ(alone.triangles.size(), left.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      ASSERT_EQ(alone.triangles[i], left[i].triangle);
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(prepared.soup.triangles[alone.corners[i][k] / 3][alone.corners[i][k] % 3],
                  vertex_of[left[i].wedges[k]]);
    }
  }
}

// glTF has vertices of its own for every face that shades flat.
TEST(Progressive, FacesThatShadeFlatHangTogether)
{
  Triangle_soup soup = mapped(sheet(6, 6), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(p.x() / 2) + std::cos(p.y() / 3));
  });
  restore_normals(soup, Normals_treatment::flat);
  Prepare_options options;
  options.round_to_float32 = true;
  options.normals = Normals_choice::keep;
  const Prepared_soup prepared = prepare(soup, options);
  const Simplified_soup least = simplify_recorded(prepared);
  const Progressive_mesh mesh = read_again(prepared.soup, least.progression);
  EXPECT_GT(pieces(mesh.soup).size(), 1u) << "the control";
  const Triangle_soup finest = level(mesh, 0);
  EXPECT_EQ(pieces(finest).size(), 1u);
  expect_same(read_back(finest), read_back(prepared.soup));
}

// Reading joins the vertices of such faces, so that a corner may have the normal of another row. What a node
// turns cannot be turned back without rounding: the row itself has to go into the file.
TEST(Progressive, FacesThatShadeFlatKeepTheirNormalsInATurnedNode)
{
  Triangle_soup soup = mapped(sheet(12, 12), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(p.x() / 2) + std::cos(p.y() / 3));
  });
  restore_normals(soup, Normals_treatment::flat);
  round_to_float32(soup);
  const Temporary_folder folder;
  write_mesh(folder / "a.gltf", soup);
  Json json = Json::parse(read_file(folder / "a.gltf"));
  json["nodes"][0]["rotation"] = {0, 0, 0.6, 0.8};
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive["targets"] = {{{"NORMAL", primitive["attributes"]["NORMAL"]}}}; // goes with the normals
  write_file(folder / "a.gltf", json.dump());
  Prepare_options options;
  options.normals = Normals_choice::keep;
  const Prepared_soup prepared = prepare(read_mesh(folder / "a.gltf").soup, options);
  ASSERT_EQ(pieces(prepared.soup).size(), 1u);
  const Simplified_soup least = simplify_recorded(prepared, 0.5);
  const Progressive_mesh mesh = read_again(prepared.soup, least.progression);
  expect_same(level(mesh, 0), read_back(prepared.soup));
  expect_same(level(mesh, mesh.step_count()), read_back(least.soup));
  const Gltf_scene::Block& block = mesh.soup.scene->blocks.at(0);
  EXPECT_EQ(block.targets.at(0).at(0).rows, block.normals()->rows);
}

TEST(Progressive, PosesGoWithTheirVertices)
{
  Triangle_soup soup = garment("skirt", 4000, 2);
  soup.poses = moving_poses(soup, 2);
  for (Pose& pose : soup.poses)
    for (Point_3& p : pose.points)
      p = Point_3(nearest_float32(p.x()), nearest_float32(p.y()), nearest_float32(p.z()));
  const Prepared_soup prepared = prepared_as_floats(std::move(soup));
  for (const auto& pairs : prepared.offending_pairs_in_poses)
    ASSERT_TRUE(pairs.empty());
  const Simplified_soup least = simplify_recorded(prepared, 0.4);
  Progressive_notes notes;
  notes.guarded_poses = {0, 1};
  const Progressive_mesh mesh = read_again(prepared.soup, least.progression, notes);
  EXPECT_EQ(mesh.is_pose_guarded, (std::vector<char>{true, true}));
  const Triangle_soup half = level(mesh, steps_to_faces(mesh, least.soup.triangles.size() * 2));
  ASSERT_EQ(half.poses.size(), 2u);
  ASSERT_LT(half.triangles.size(), prepared.soup.triangles.size());
  for (const Triangle_soup& at : {half, level(mesh, mesh.step_count())})
    for (const Pose& pose : at.poses) {
      Triangle_soup posed = at;
      posed.points = pose.points;
      EXPECT_TRUE(is_embedded(posed)) << pose.name;
    }
  // In the second pose, the corners of the last level are those of the result.
  const auto corners = [](const Triangle_soup& of) {
    std::vector<Point_3> result;
    for (const Index_triple& triangle : of.triangles)
      for (const Index v : triangle)
        result.push_back(of.poses[1].points[v]);
    std::sort(result.begin(), result.end());
    return result;
  };
  EXPECT_EQ(corners(level(mesh, mesh.step_count())), corners(least.soup));
}

// A mesh in three places of a scene is reduced in all alike, in one step each.
TEST(Progressive, AMeshInSeveralPlacesIsTheSameInAll)
{
  const Temporary_folder folder;
  write_mesh(folder / "a.gltf", flat_grid(300));
  Json json = Json::parse(read_file(folder / "a.gltf"));
  json["nodes"] = {{{"mesh", 0}},
                   {{"mesh", 0}, {"translation", {0, 0, 9}}},
                   {{"mesh", 0}, {"scale", {-1, 1, 2}}, {"translation", {0, 0, -9}}}};
  json["scenes"][0]["nodes"] = {0, 1, 2};
  const Prepared_soup prepared = prepare(read_mesh(json.dump(), Mesh_format::gltf, "test").soup);
  const Simplified_soup least = simplify_recorded(prepared);
  ASSERT_EQ(least.shared_places, 3u);
  const Progressive_mesh mesh = read_again(prepared.soup, least.progression);
  expect_same(read_back(level(mesh, mesh.step_count())), read_back(least.soup));
  for (const Index faces : mesh.faces)
    EXPECT_EQ(faces % 3, 0u);
}

TEST(Progressive, DoublesGoWithTheirFronts)
{
  Triangle_soup soup = flat_grid(200);
  soup.uvs = {};
  soup.normals = {};
  const std::vector<Index_triple> front = soup.triangles;
  for (const auto& [a, b, c] : front)
    soup.triangles.push_back({a, c, b});
  for (auto* labels : {&soup.groups, &soup.objects, &soup.materials, &soup.smoothing_groups})
    *labels = {};
  soup.triangle_attributes.clear();
  soup.polygons.clear();
  const Prepared_soup prepared = prepared_as_floats(std::move(soup));
  ASSERT_GT(prepared.doubles(), 0u);
  const Simplified_soup least = simplify_recorded(prepared);
  const Progressive_mesh mesh = read_again(prepared.soup, least.progression);
  expect_same(read_back(level(mesh, mesh.step_count())), read_back(least.soup));
}

TEST(Progressive, AnOrdinaryReaderSeesTheFinestMeshAndKeepsNoList)
{
  const Prepared_soup prepared = prepared_as_floats(garment("jacket", 2000, 2));
  const std::string file = progressive_file(prepared.soup, simplify_recorded(prepared, 0.5).progression);
  const Triangle_soup soup = read_mesh(file, Mesh_format::glb, "a.glb").soup;
  expect_same(soup, read_back(prepared.soup));
  const Temporary_folder folder;
  write_mesh(folder / "b.gltf", soup);
  const std::string written = read_file(folder / "b.gltf");
  EXPECT_EQ(written.find("selvedge_progressive"), std::string::npos);
  EXPECT_NE(file.find("selvedge_progressive"), std::string::npos);
  EXPECT_THROW(read_progressive(written, Mesh_format::gltf, "b.gltf"), Input_error);
}

TEST(Progressive, WhateverIsChangedIsRefused)
{
  const Prepared_soup prepared = prepared_as_floats(flat_grid(120));
  const std::string file = progressive_file(prepared.soup, simplify_recorded(prepared, 0.5).progression);
  const auto expect_refused = [](const std::string& damaged) {
    EXPECT_THROW(read_progressive(damaged, Mesh_format::glb, "a.glb"), Input_error);
  };
  for (const std::size_t size : {std::size_t(0), std::size_t(11), file.size() / 2, file.size() - 1})
    expect_refused(file.substr(0, size));
  // The lists are at the beginning of the buffer.
  const std::size_t buffer = file.find("BIN") + 4;
  for (std::size_t i = 0; i < 400; i += 4) {
    std::string damaged = file;
    damaged[buffer + i] = char(damaged[buffer + i] ^ 1);
    expect_refused(damaged);
  }
  std::string renamed = file;
  renamed.replace(renamed.find("\"steps\":"), 8, "\"stops\":");
  expect_refused(renamed);
}

TEST(Progressive, WhatAFileCannotHoldIsRefused)
{
  const Prepared_soup prepared = prepare(garment("jacket", 2000, 2));
  Simplify_options optimal = to_ratio(0.5);
  optimal.placement = Placement::optimal;
  optimal.is_progression_recorded = true;
  EXPECT_THROW(simplify_soup(prepared, optimal), Argument_error);
  const Progression progression = simplify_recorded(prepared, 0.5).progression;
  const Temporary_folder folder;
  EXPECT_THROW(write_progressive(folder / "a.glb", prepared.soup, progression), Argument_error); // doubles
  EXPECT_THROW(write_progressive(folder / "a.obj", prepared.soup, progression), Argument_error);
  EXPECT_THROW(write_progressive(folder / "a.glb", prepared_as_floats(flat_grid(20)).soup, progression),
               Argument_error);
}

} // namespace
} // namespace selvedge::test
