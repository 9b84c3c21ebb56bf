// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Levels of detail in one glTF file (MSFT_lod).

#include "support/Gltf_document.h"
#include "support/Temporary_folder.h"

#include "soup/selection.h"
#include <selvedge/Error.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

/// What a mesh says, however its vertices and triangles are numbered: for each triangle its corners with all
/// of their values, from the least on, and its names.
std::multiset<std::string> triangles_in_full(const Triangle_soup& soup)
{
  std::multiset<std::string> result;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    std::array<std::string, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = soup.triangles[t][k];
      for (int axis = 0; axis < 3; ++axis)
        put(corners[k], soup.points[v][axis]);
      const auto put_values = [&](const auto& values) {
        if (!values.empty() && values.of_triangle[t][k] != values.missing)
          put(corners[k], values.values[values.of_triangle[t][k]]);
      };
      put_values(soup.uvs);
      put_values(soup.normals);
      for (const Attribute& attribute : soup.vertex_attributes) {
        const std::size_t size = row_size(attribute);
        corners[k].append(reinterpret_cast<const char*>(attribute.rows.data()) + v * size, size);
      }
      for (const Pose& pose : soup.poses)
        for (int axis = 0; axis < 3; ++axis)
          put(corners[k], pose.points[v][axis]);
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    std::string text = corners[0] + corners[1] + corners[2];
    for (const Triangle_labels* labels : {&soup.groups, &soup.materials})
      if (!labels->empty())
        text += labels->names[labels->of_triangle[t]] + '\n';
    result.insert(text);
  }
  return result;
}

std::vector<Triangle_soup> levels_of(const Triangle_soup& soup, const std::vector<double>& ratios,
                                     Instances instances = Instances::apart,
                                     const Simplify_intent& intent = {})
{
  Simplify_options options;
  options.instances = instances;
  std::vector<Triangle_soup> result;
  for (const Simplified_soup& level : simplify_lods(prepare(soup), options, ratios, intent))
    result.push_back(level.soup);
  return result;
}

Mesh_file read_level(const std::filesystem::path& path, std::size_t level)
{
  Read_options options;
  options.level_of_detail = level;
  return read_mesh(path, options);
}

/// Reading each level of a file gives what reading it from a file of its own gives.
void expect_levels(const std::filesystem::path& path, const std::vector<Triangle_soup>& levels,
                   const std::filesystem::path& file_of_one)
{
  std::multiset<std::string> finer;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    write_mesh(file_of_one, levels[level]);
    const std::multiset<std::string> triangles = triangles_in_full(read_level(path, level).soup);
    EXPECT_EQ(triangles.size(), levels[level].triangles.size());
    EXPECT_TRUE(triangles == triangles_in_full(read_mesh(file_of_one).soup)) << "level " << level;
    EXPECT_FALSE(triangles == finer);
    finer = triangles;
  }
  EXPECT_THROW(read_level(path, levels.size()), Input_error);
}

TEST(Gltf_levels, ReadAsTheyDoFromFilesOfTheirOwn)
{
  const Temporary_folder folder;
  const std::vector<Triangle_soup> levels = levels_of(read_glb(everything()).soup, {1, 0.6, 0.3});
  for (const char* name : {"levels.glb", "levels.gltf"}) {
    write_levels_of_detail(folder / name, levels);
    expect_levels(folder / name, levels, folder / "one.glb");
  }
  EXPECT_THROW(write_levels_of_detail(folder / "levels.obj", levels), Argument_error);
  EXPECT_THROW(write_levels_of_detail(folder / "none.glb", {}), Argument_error);
  // Nodes name their levels; all that is not about triangles stands there once.
  const Document before = everything(), after = from_glb(contents(folder / "levels.glb"));
  const Json& nodes = after.json["nodes"];
  ASSERT_EQ(nodes.size(), before.json["nodes"].size() + 6);
  for (const std::size_t n : {1, 2, 3}) {
    Json node = nodes[n];
    EXPECT_EQ(node["extras"]["MSFT_screencoverage"].size(), 3u);
    EXPECT_EQ(node["extras"]["MSFT_screencoverage"][2], 0);
    const Json ids = node["extensions"]["MSFT_lod"]["ids"];
    ASSERT_EQ(ids.size(), 2u);
    for (std::size_t level = 0; level < 2; ++level) {
      Json coarser = nodes[ids[level].get<std::size_t>()];
      EXPECT_EQ(coarser["name"], node["name"].get<std::string>() + "_LOD" + std::to_string(level + 1));
      EXPECT_NE(coarser["mesh"], node["mesh"]);
      for (const char* key : {"name", "mesh"})
        coarser[key] = before.json["nodes"][n][key];
      EXPECT_EQ(coarser, before.json["nodes"][n]);
    }
    for (const char* key : {"extras", "extensions"})
      node.erase(key);
    node["mesh"] = before.json["nodes"][n]["mesh"];
    EXPECT_EQ(node, before.json["nodes"][n]);
  }
  EXPECT_EQ(after.json["extensionsUsed"], Json({"MSFT_lod"}));
  for (const char* key : {"scenes", "materials", "images", "textures", "skins", "animations"})
    EXPECT_EQ(after.json[key], before.json[key]) << key;
}

TEST(Gltf_levels, HaveTheFirstRowsOfFinerOnes)
{
  const Temporary_folder folder;
  for (const bool is_from_gltf : {true, false}) {
    Triangle_soup soup = read_glb(waves<float>(5126)).soup;
    if (!is_from_gltf) {
      write_mesh(folder / "in.obj", soup);
      soup = read_mesh(folder / "in.obj").soup;
      round_to_float32(soup);
    }
    const std::vector<Triangle_soup> levels = levels_of(soup, {1, 0.5, 0.2});
    write_levels_of_detail(folder / "levels.glb", levels);
    expect_levels(folder / "levels.glb", levels, folder / "one.glb");
    const Document after = from_glb(contents(folder / "levels.glb"));
    const auto column = [&](std::size_t mesh, const char* name) -> const Json& {
      return after.json["accessors"]
                       [after.json["meshes"][mesh]["primitives"][0]["attributes"][name].get<std::size_t>()];
    };
    for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0"}) {
      for (const std::size_t mesh : {1, 2}) {
        EXPECT_EQ(column(mesh, name)["bufferView"], column(0, name)["bufferView"]);
        EXPECT_LT(column(mesh, name)["count"], column(mesh - 1, name)["count"]);
      }
      const Json& view = after.json["bufferViews"][column(0, name)["bufferView"].get<std::size_t>()];
      EXPECT_EQ(view["byteStride"].get<std::size_t>() * column(0, name)["count"].get<std::size_t>(),
                view["byteLength"]);
    }
    // Control: levels of a mesh in several poses stay in the order of the vertices, and share nothing.
    std::vector<Triangle_soup> posed = levels;
    for (Triangle_soup& level : posed)
      level.poses = {{"raised", level.points, 0}};
    write_levels_of_detail(folder / "posed.glb", posed);
    for (std::size_t level = 0; level < posed.size(); ++level)
      EXPECT_EQ(read_level(folder / "posed.glb", level).soup.points.size(), levels[level].points.size());
    EXPECT_GT(std::filesystem::file_size(folder / "posed.glb"),
              std::filesystem::file_size(folder / "levels.glb") * 6 / 5);
  }
}

TEST(Gltf_levels, OfPartsThatStayAreTheSameMesh)
{
  const Temporary_folder folder;
  Simplify_intent intent;
  intent.kept = {"arm"};
  const std::vector<Triangle_soup> levels =
      levels_of(read_glb(everything()).soup, {0.6, 0.3}, Instances::apart, intent);
  write_levels_of_detail(folder / "levels.glb", levels);
  expect_levels(folder / "levels.glb", levels, folder / "one.glb");
  const Document after = from_glb(contents(folder / "levels.glb"));
  EXPECT_TRUE(after.json["nodes"][2].contains("extensions"));
  EXPECT_EQ(after.json["nodes"][3], everything().json["nodes"][3]);
  EXPECT_EQ(after.json["meshes"].size(), 6u); // two of two levels, one of both, and points
}

TEST(Gltf_levels, StandBelowNodesThatDoMoreThanShowAMesh)
{
  Document before = everything();
  Json& nodes = before.json["nodes"];
  Json& animation = before.json["animations"][0];
  nodes[2]["children"] = {7}; // a child of its own
  nodes[2]["weights"] = {0.25};
  nodes.push_back({{"name", "button"}});
  animation["channels"][0]["target"]["node"] = 3; // the arm moves
  animation["samplers"].push_back(
      {{"input", animation["samplers"][0]["input"]}, // and so do the targets of left
       {"output", animation["samplers"][0]["input"]}});
  for (const int node : {1, 2})
    animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", node}, {"path", "weights"}}}});
  // What an avatar, and an animation by a pointer, say of the nodes of meshes.
  before.json["extensionsUsed"] = {"VRMC_vrm", "KHR_animation_pointer"};
  Json& avatar = before.json["extensions"]["VRMC_vrm"];
  avatar["expressions"]["preset"]["aa"]["morphTargetBinds"] = {{{"node", 2}, {"index", 0}, {"weight", 1}},
                                                               {{"node", 1}, {"index", 0}, {"weight", 1}}};
  avatar["firstPerson"]["meshAnnotations"] = {{{"node", 2}, {"type", "auto"}}};
  Json pointer = {{"sampler", 1}, {"target", {{"path", "pointer"}}}};
  pointer["target"]["extensions"]["KHR_animation_pointer"]["pointer"] = "/nodes/2/weights";
  before.json["animations"].push_back({{"samplers", animation["samplers"]}, {"channels", {pointer}}});
  const Temporary_folder folder;
  write_bytes(folder / "in.glb", to_glb(before));
  Triangle_soup soup = read_mesh(folder / "in.glb").soup;
  const std::vector<Triangle_soup> levels = levels_of(soup, {0.7, 0.4});
  write_levels_of_detail(folder / "levels.glb", levels);
  expect_levels(folder / "levels.glb", levels, folder / "one.glb");
  const Json after = from_glb(contents(folder / "levels.glb")).json;
  std::map<std::string, std::size_t> number;
  for (std::size_t n = 0; n < after["nodes"].size(); ++n)
    number[after["nodes"][n].value("name", "")] = n; // the last of this name
  for (const std::size_t parent : {2, 3}) {
    const Json& node = after["nodes"][parent];
    EXPECT_FALSE(node.contains("mesh") || node.contains("skin") || node.contains("extensions"));
    const std::size_t child = number.at(node["name"]);
    EXPECT_EQ(node["children"].back(), child);
    EXPECT_TRUE(after["nodes"][child].contains("mesh"));
    EXPECT_EQ(after["nodes"][child]["extensions"]["MSFT_lod"]["ids"],
              Json({number.at(node["name"].get<std::string>() + "_LOD1")}));
    EXPECT_FALSE(after["nodes"][child].contains("translation") || after["nodes"][child].contains("matrix"));
  }
  EXPECT_EQ(after["nodes"][number.at("right_LOD1")]["weights"], Json({0.25}));
  const Json& seen = after["extensions"]["VRMC_vrm"];
  const std::size_t right = number.at("right");
  EXPECT_EQ(seen["expressions"]["preset"]["aa"]["morphTargetBinds"][0]["node"], right);
  EXPECT_EQ(seen["expressions"]["preset"]["aa"]["morphTargetBinds"][1]["node"], 1);
  EXPECT_EQ(seen["firstPerson"]["meshAnnotations"][0]["node"], right);
  EXPECT_EQ(after["animations"][1]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]["pointer"],
            "/nodes/" + std::to_string(right) + "/weights");
  std::set<std::pair<std::size_t, std::string>> moved, expected = {{3, "translation"}};
  for (const Json& channel : after["animations"][0]["channels"])
    EXPECT_TRUE(moved.emplace(channel["target"]["node"], channel["target"]["path"]).second);
  for (const char* name : {"left", "left_LOD1", "right", "right_LOD1"})
    expected.emplace(number.at(name), "weights");
  EXPECT_EQ(moved, expected);
  // Their poses are those of files of their own.
  for (std::size_t level = 0; level < levels.size(); ++level) {
    write_mesh(folder / "one.glb", levels[level]);
    Triangle_soup one = read_mesh(folder / "one.glb").soup,
                  of_levels = read_level(folder / "levels.glb", level).soup;
    for (Triangle_soup* posed : {&one, &of_levels}) {
      posed->poses = animation_poses(*posed, "all", 1, "test");
      const std::vector<Pose> morphs = morph_poses(*posed, "test");
      posed->poses.insert(posed->poses.end(), morphs.begin(), morphs.end());
      EXPECT_EQ(posed->poses.size(), 3u);
    }
    EXPECT_TRUE(triangles_in_full(one) == triangles_in_full(of_levels)) << "level " << level;
  }
}

// A reader calls the parts of a node without a name by its number, which is another one for a child.
TEST(Gltf_levels, HaveTheNamesOfNodesWithoutAny)
{
  const Temporary_folder folder;
  for (const bool have_meshes_names : {false, true}) {
    Document document = everything();
    Json& nodes = document.json["nodes"];
    nodes[2]["children"] = {7};
    nodes.push_back(Json::object());
    for (Json& node : nodes)
      node.erase("name");
    for (Json& mesh : document.json["meshes"]) {
      mesh.erase("name");
      if (have_meshes_names)
        mesh["name"] = "cloth";
    }
    write_bytes(folder / "in.glb", to_glb(document));
    const Triangle_soup soup = read_mesh(folder / "in.glb").soup;
    write_levels_of_detail(folder / "levels.glb", levels_of(soup, {0.7, 0.4}));
    const auto names = [](const Triangle_soup& of) {
      return std::set<std::string>(of.groups.names.begin(), of.groups.names.end());
    };
    for (const std::size_t level : {0, 1})
      EXPECT_EQ(names(read_level(folder / "levels.glb", level).soup), names(soup)) << level;
  }
}

TEST(Gltf_levels, StandBesideThoseOfMaterials)
{
  Document before = everything();
  before.json["extensionsUsed"] = {"MSFT_lod"};
  before.json["materials"][0]["extensions"]["MSFT_lod"]["ids"] = {1};
  const Temporary_folder folder;
  write_levels_of_detail(folder / "levels.glb", levels_of(read_glb(before).soup, {0.7, 0.4}));
  const Json after = from_glb(contents(folder / "levels.glb")).json;
  EXPECT_EQ(after["extensionsUsed"], Json({"MSFT_lod"})) << "glTF does not allow a name twice";
  EXPECT_EQ(after["materials"], before.json["materials"]);
}

TEST(Gltf_levels, OfInstancesAreInstancesWhereAllShareThem)
{
  const Temporary_folder folder;
  const Document before = waves_in_places();
  for (const Instances instances : {Instances::shared, Instances::apart}) {
    const std::vector<Triangle_soup> levels = levels_of(read_glb(before).soup, {0.5, 0.2}, instances);
    write_levels_of_detail(folder / "levels.glb", levels);
    expect_levels(folder / "levels.glb", levels, folder / "one.glb");
    const Json after = from_glb(contents(folder / "levels.glb")).json;
    const bool is_shared = instances == Instances::shared;
    EXPECT_EQ(after["meshes"].size(), is_shared ? 2u : 6u);
    EXPECT_EQ(after["nodes"].size(), is_shared ? 4u : 7u);
    std::size_t instanced = 0;
    for (const Json& node : after["nodes"])
      instanced += node.contains("extensions") && node["extensions"].contains("EXT_mesh_gpu_instancing");
    EXPECT_EQ(instanced, is_shared ? 2u : 0u);
  }
}

TEST(Gltf_levels, GoWhereOneIsRead)
{
  const Temporary_folder folder;
  const std::vector<Triangle_soup> levels = levels_of(read_glb(everything()).soup, {0.8, 0.4});
  write_levels_of_detail(folder / "levels.glb", levels);
  for (const std::size_t level : {0, 1}) {
    const Mesh_file file = read_level(folder / "levels.glb", level);
    EXPECT_EQ(file.notes.remarks.at("levels of detail (MSFT_lod), of which this is number " +
                                    std::to_string(level + 1) + "; the others are left out"),
              1u);
    EXPECT_EQ(file.soup.groups.names, read_glb(everything()).soup.groups.names);
    write_mesh(folder / "again.glb", file.soup);
    write_mesh(folder / "one.glb", levels[level]);
    const Document again = from_glb(contents(folder / "again.glb")),
                   one = from_glb(contents(folder / "one.glb"));
    ASSERT_EQ(again.json["nodes"].size(), one.json["nodes"].size());
    for (std::size_t n = 0; n < one.json["nodes"].size(); ++n) {
      nlohmann::json of_again = again.json["nodes"][n], of_one = one.json["nodes"][n]; // in any order
      of_again.erase("mesh");
      of_one.erase("mesh");
      EXPECT_EQ(of_again, of_one);
    }
    EXPECT_EQ(again.json["meshes"].size(), one.json["meshes"].size());
    EXPECT_FALSE(again.json.contains("extensionsUsed"));
    EXPECT_LE(again.bytes.size(), one.bytes.size() + 200);
  }
  // Levels of materials stay, and so does what they need.
  Document document = everything();
  document.json["materials"][0]["extensions"]["MSFT_lod"]["ids"] = {1};
  document.json["extensionsUsed"] = {"MSFT_lod"};
  write_mesh(folder / "a.glb", read_glb(document).soup);
  const Json after = from_glb(contents(folder / "a.glb")).json;
  EXPECT_EQ(after["materials"], document.json["materials"]);
  EXPECT_EQ(after["extensionsUsed"], document.json["extensionsUsed"]);
}

TEST(Gltf_levels, ThatAreNotThereAreRefused)
{
  const auto with_levels = [](const Json& ids) {
    Document document = one_triangle();
    document.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = ids;
    document.json["nodes"].push_back({{"mesh", 0}});
    return document;
  };
  EXPECT_EQ(read_glb(with_levels({1})).soup.triangles.size(), 1u);
  EXPECT_EQ(read_glb(with_levels(Json::array())).soup.triangles.size(), 1u);
  for (const Json& ids : {Json({2}), Json({-1}), Json({"x"}), Json(1), Json({0.5}), Json()})
    expect_refused(with_levels(ids), "node 0 has levels of detail (MSFT_lod) that are no nodes");
  const auto refuse_level = [](const Document& document, const std::string& word) {
    Read_options options;
    options.level_of_detail = 2;
    try {
      read_mesh(to_glb(document), Mesh_format::glb, "test", options);
      FAIL() << "not refused: " << word;
    } catch (const Input_error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refuse_level(with_levels({1}), "level of detail 3 is asked for, but the file has only levels 1 to 2");
  refuse_level(one_triangle(), "has no levels");
  Read_options options;
  options.level_of_detail = 1;
  EXPECT_THROW(read_mesh("v 0 0 0\n", Mesh_format::obj, "test", options), Input_error);
  // Two nodes name one level, and its children would stand in the scene twice.
  Document twice = with_levels({1});
  twice.json["nodes"][1]["children"] = {2};
  twice.json["nodes"].push_back({{"mesh", 0}});
  twice.json["nodes"].push_back(twice.json["nodes"][0]);
  twice.json["scenes"][0]["nodes"].push_back(3);
  EXPECT_EQ(read_glb(twice).soup.triangles.size(), 2u);
  try {
    read_mesh(R"({"asset": {"version": "2.0"}, "animations": [{"name": "turn"}]})", Mesh_format::gltf,
              "test");
    FAIL() << "a file without nodes";
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("animations and no mesh"), std::string::npos) << error.what();
  }
  Read_options coarser;
  coarser.level_of_detail = 1;
  EXPECT_THROW(read_mesh(to_glb(twice), Mesh_format::glb, "test", coarser), Input_error);
}

TEST(Gltf_levels, OfOtherMeshesAreRefused)
{
  const Temporary_folder folder;
  const Triangle_soup soup = read_glb(one_triangle()).soup;
  EXPECT_THROW(write_levels_of_detail(folder / "a.glb", {soup, read_glb(one_triangle()).soup}),
               Argument_error);
  Triangle_soup plain = soup;
  plain.scene = nullptr;
  plain.scene_vertices.clear();
  EXPECT_THROW(write_levels_of_detail(folder / "a.glb", {soup, plain}), Argument_error);
  Triangle_soup named = plain;
  named.groups.names.front() += "'";
  EXPECT_THROW(write_levels_of_detail(folder / "a.glb", {plain, named}), Argument_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
  write_levels_of_detail(folder / "a.glb", {plain, plain}); // the same twice is two levels
  EXPECT_EQ(read_level(folder / "a.glb", 1).soup.triangles.size(), 1u);
  const Json meshes = from_glb(contents(folder / "a.glb")).json["meshes"];
  ASSERT_EQ(meshes.size(), 2u); // which share all accessors
  EXPECT_EQ(meshes[0], meshes[1]);
}

} // namespace
} // namespace selvedge::test
