// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// glTF files as they are written back: what is carried, bit for bit, and new places.

#include "support/Gltf_document.h"
#include "support/Temporary_folder.h"

#include "soup/selection.h"
#include "soup/transforms_of_vertices.h"
#include <selvedge/Error.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/internal/base64.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

std::vector<std::size_t> indices_of(const Document& document, const Json& primitive)
{
  std::vector<std::size_t> result;
  for (const std::string& row : rows_of(document, primitive["indices"])) {
    std::size_t index = 0;
    for (std::size_t k = 0; k < row.size(); ++k)
      index |= std::size_t(static_cast<unsigned char>(row[k])) << 8 * k;
    result.push_back(index);
  }
  return result;
}

/// Every vertex of a primitive has, in every attribute and target, the bits of the vertex of the same _ID in
/// the other.
void expect_rows_of(const Document& after, const Json& primitive, const Document& before,
                    const Json& original)
{
  ASSERT_EQ(primitive["attributes"].size(), original["attributes"].size());
  const std::vector<std::string> ids = rows_of(after, primitive["attributes"]["_ID"]);
  const auto expect_same = [&](std::size_t accessor, std::size_t from) {
    for (const char* key : {"componentType", "type", "normalized", "name", "extras"})
      ASSERT_EQ(after.json["accessors"][accessor].value(key, Json()),
                before.json["accessors"][from].value(key, Json()));
    const std::vector<std::string> rows = rows_of(after, accessor), expected = rows_of(before, from);
    ASSERT_EQ(rows.size(), ids.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      ASSERT_EQ(rows[i], expected.at(std::size_t(get<float>(ids[i], 0)))) << "row " << i;
  };
  for (const auto& [name, accessor] : original["attributes"].items())
    expect_same(primitive["attributes"][name], accessor);
  ASSERT_EQ(primitive.value("targets", Json()).size(), original.value("targets", Json()).size());
  for (std::size_t k = 0; k < original.value("targets", Json()).size(); ++k)
    for (const auto& [name, accessor] : original["targets"][k].items())
      expect_same(primitive["targets"][k][name], accessor);
  for (const std::size_t index : indices_of(after, primitive))
    ASSERT_LT(index, ids.size());
}

/// What is not about vertices and triangles says the same.
void expect_same_rest(const Document& after, const Document& before, bool is_reduced)
{
  for (const char* key :
       {"asset", "scene", "scenes", "extras", "materials", "images", "textures", "skins", "animations"})
    EXPECT_EQ(after.json[key], before.json[key]) << key;
  const auto view = [](const Document& document, std::size_t number) {
    const Json& json = document.json["bufferViews"][number];
    return document.bytes.substr(json["byteOffset"], json["byteLength"]);
  };
  const std::size_t image = before.json["images"][0]["bufferView"];
  EXPECT_EQ(view(after, image), view(before, image));
  for (const std::size_t accessor :
       {before.json["skins"][0]["inverseBindMatrices"], before.json["animations"][0]["samplers"][0]["input"],
        before.json["animations"][0]["samplers"][0]["output"]})
    EXPECT_EQ(rows_of(after, accessor), rows_of(before, accessor));
  // Where it has been reduced otherwise, the node that shared its mesh has its own now.
  Json nodes = after.json["nodes"];
  if (is_reduced) {
    EXPECT_EQ(nodes[2]["mesh"], 3);
    nodes[2]["mesh"] = 0;
  }
  EXPECT_EQ(nodes, before.json["nodes"]);
  ASSERT_EQ(after.json["meshes"].size(), is_reduced ? 4u : 3u);
  // Points are as they were.
  EXPECT_EQ(after.json["meshes"][2], before.json["meshes"][2]);
  const std::size_t marks = before.json["meshes"][2]["primitives"][0]["attributes"]["POSITION"];
  EXPECT_EQ(rows_of(after, marks), rows_of(before, marks));
}

void expect_everything_kept(const Document& after, const Document& before, bool is_reduced = true)
{
  expect_same_rest(after, before, is_reduced);
  std::map<std::size_t, std::size_t> from = {{0, 0}, {1, 1}};
  if (is_reduced)
    from[3] = 0;
  for (const auto& [mesh, original] : from) {
    Json rest = after.json["meshes"][mesh], rest_before = before.json["meshes"][original];
    for (std::size_t p = 0; p < rest["primitives"].size(); ++p) {
      if (rest["primitives"][p].contains("indices"))
        expect_rows_of(after, rest["primitives"][p], before, rest_before["primitives"][p]);
      for (const char* key : {"attributes", "indices", "targets"}) {
        rest["primitives"][p].erase(key);
        rest_before["primitives"][p].erase(key);
      }
    }
    EXPECT_EQ(rest, rest_before);
  }
}

/// The numbers of a row of floats, or of other numbers.
template <class Number = float>
std::vector<double> numbers(const std::string& row)
{
  std::vector<double> result;
  for (std::size_t at = 0; at < row.size(); at += sizeof(Number))
    result.push_back(get<Number>(row, at));
  return result;
}

template <class Weight>
void expect_interpolated(int weight_type)
{
  const Temporary_folder folder;
  const Document before = waves<Weight>(weight_type);
  const Simplified_soup reduced =
      reduce(read_mesh(to_glb(before), Mesh_format::glb, "waves").soup, 0.3, Placement::optimal);
  write_mesh(folder / "a.glb", reduced.soup);
  const Document after = from_glb(contents(folder / "a.glb"));
  const Json& primitive = after.json["meshes"][0]["primitives"][0];
  const auto rows = [&](const char* name) { return rows_of(after, primitive["attributes"][name]); };
  const auto points = rows("POSITION"), normals = rows("NORMAL"), tangents = rows("TANGENT"),
             uvs = rows("TEXCOORD_0"), joints = rows("JOINTS_0"), weights = rows("WEIGHTS_0"),
             shifts = rows_of(after, primitive["targets"][0]["POSITION"]);
  const auto known = rows_of(before, before.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
  const double whole = weight_type == 5126 ? 1 : double(std::numeric_limits<Weight>::max());
  std::size_t placed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::find(known.begin(), known.end(), points[i]) != known.end())
      continue;
    ++placed;
    const std::vector<double> p = numbers(points[i]), uv = numbers<std::uint16_t>(uvs[i]),
                              normal = numbers(normals[i]), tangent = numbers(tangents[i]),
                              joint = numbers<std::uint8_t>(joints[i]), weight = numbers<Weight>(weights[i]),
                              shift = numbers(shifts[i]);
    EXPECT_NEAR(uv[0] / 65535, p[0], 0.02);
    EXPECT_NEAR(uv[1] / 65535, p[1], 0.02);
    EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1, 1e-6);
    EXPECT_NEAR(std::hypot(tangent[0], tangent[1], tangent[2]), 1, 1e-6);
    EXPECT_EQ(std::abs(tangent[3]), 1); // which is a side, and not mixed
    EXPECT_NEAR(shift[0], 0.5 * p[0], 0.02);
    EXPECT_NEAR(shift[2], -0.25 * p[1], 0.02);
    ASSERT_EQ(joint[0] + joint[1], 7);
    EXPECT_NEAR(weight[joint[0] == 3 ? 0 : 1] / whole, p[0], 0.02);
    EXPECT_EQ(joint[2] + joint[3] + weight[2] + weight[3], 0);
    EXPECT_NEAR(weight[0] + weight[1], whole, whole == 1 ? 1e-6 : 0);
  }
  EXPECT_EQ(placed, reduced.placed_vertices);
  EXPECT_GT(placed, 50u);
}

TEST(Gltf, RoundTripKeepsEverything)
{
  const Temporary_folder folder;
  const Document before = everything();
  const Mesh_file file = read_glb(before);
  EXPECT_EQ(file.soup.triangles.size(), 3u * 2 * (side - 1) * (side - 1));
  write_mesh(folder / "a.glb", file.soup);
  const Document after = from_glb(contents(folder / "a.glb"));
  expect_everything_kept(after, before, false);
  EXPECT_EQ(after.json["accessors"].size(), before.json["accessors"].size() + 1)
      << "what was shared is no more; only the positions that points use as well stay beside those written";
  const Json& target =
      after.json["accessors"]
                [after.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"].get<std::size_t>()];
  EXPECT_TRUE(target.contains("sparse"));
  EXPECT_FALSE(target.contains("bufferView")) << "a sparse target became a full one";
  for (std::size_t p = 0; p < 2; ++p)
    EXPECT_EQ(indices_of(after, after.json["meshes"][0]["primitives"][p]).size(),
              indices_of(before, before.json["meshes"][0]["primitives"][p]).size());
  const Mesh_file again = read_mesh(folder / "a.glb");
  EXPECT_EQ(again.soup.triangles.size(), file.soup.triangles.size());
  EXPECT_EQ(again.soup.groups.names, file.soup.groups.names);
  EXPECT_EQ(again.soup.materials.of_triangle, file.soup.materials.of_triangle);
  for (std::size_t t = 0; t < file.soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_EQ(again.soup.points[again.soup.triangles[t][k]], file.soup.points[file.soup.triangles[t][k]]);
  write_mesh(folder / "b.glb", again.soup);
  EXPECT_EQ(contents(folder / "a.glb"), contents(folder / "b.glb"));
}

TEST(Gltf, ReducedKeepsTheBitsOfEverySurvivingVertex)
{
  const Temporary_folder folder;
  const Document before = everything();
  const Mesh_file file = read_glb(before);
  for (const Instances instances : {Instances::shared, Instances::apart}) {
    const Simplified_soup reduced = reduce(file.soup, 0.4, Placement::vertices, instances);
    ASSERT_LT(reduced.soup.triangles.size(), file.soup.triangles.size() / 2);
    EXPECT_FALSE(needs_float32(reduced.soup, Mesh_format::glb));
    EXPECT_TRUE(needs_float32(reduced.soup, Mesh_format::stl));
    write_mesh(folder / "a.glb", reduced.soup);
    const Document after = from_glb(contents(folder / "a.glb"));
    expect_everything_kept(after, before, instances == Instances::apart);
    // What was judged is what stands in the file.
    const Mesh_file again = read_mesh(folder / "a.glb");
    ASSERT_EQ(again.soup.triangles.size(), reduced.soup.triangles.size());
    std::multiset<std::array<Point_3, 3>> judged, written;
    for (const Index_triple& t : reduced.soup.triangles)
      judged.insert({reduced.soup.points[t[0]], reduced.soup.points[t[1]], reduced.soup.points[t[2]]});
    for (const Index_triple& t : again.soup.triangles)
      written.insert({again.soup.points[t[0]], again.soup.points[t[1]], again.soup.points[t[2]]});
    EXPECT_TRUE(judged == written);
    EXPECT_TRUE(not_carried(reduced.soup, Mesh_format::glb).empty());
    write_mesh(folder / "all.glb", file.soup);
    EXPECT_LT(after.bytes.size(), from_glb(contents(folder / "all.glb")).bytes.size())
        << "vertices that are gone are still in the file";
  }
}

// Three corners of each triangle are listed, where a strip lists one.
TEST(Gltf, SaysWhatTheInputHeldInLessSpace)
{
  const Temporary_folder folder;
  Document document = waves<float>(5126);
  EXPECT_TRUE(write_mesh(folder / "a.glb", read_glb(document).soup).empty()) << "the control";
  document.json["meshes"][0]["primitives"][0]["mode"] = 5;
  const Write_notes notes = write_mesh(folder / "a.glb", read_glb(document).soup);
  EXPECT_EQ(notes, (Write_notes{{"strips and fans, from now on lists of triangles", 1}}));
}

TEST(Gltf, TextFormHoldsTheSame)
{
  const Temporary_folder folder;
  const Document before = everything();
  const Mesh_file file = read_glb(before);
  write_mesh(folder / "a.gltf", file.soup);
  const Mesh_file again = read_mesh(folder / "a.gltf");
  EXPECT_EQ(again.soup.points, file.soup.points);
  EXPECT_EQ(again.soup.triangles, file.soup.triangles);
  write_mesh(folder / "a.glb", again.soup);
  expect_everything_kept(from_glb(contents(folder / "a.glb")), before, false);
}

TEST(Gltf, ImagesInDataAddressesGoIntoTheBufferOfGlb)
{
  const Temporary_folder folder;
  Document before = everything();
  const Json inside = before.json["images"][0];
  const Json& view = before.json["bufferViews"][inside["bufferView"].get<std::size_t>()];
  const std::string png = before.bytes.substr(view["byteOffset"], view["byteLength"]);
  const std::string address = "data:image/png;base64," + internal::base64(png);
  Json& images = before.json["images"];
  images.push_back({{"uri", address}, {"name", "data"}});
  images.push_back({{"uri", address + "?"}});
  images.push_back({{"uri", "data:application/octet-stream;base64," + internal::base64(png)}});
  images.push_back({{"uri", "data:image/png;base64,"}});
  const Triangle_soup soup = read_glb(before).soup;
  write_mesh(folder / "a.glb", soup);
  const Document after = from_glb(contents(folder / "a.glb"));
  const Json& embedded = after.json["images"][2];
  EXPECT_EQ(embedded["name"], "data");
  EXPECT_EQ(embedded["mimeType"], "image/png");
  EXPECT_FALSE(embedded.contains("uri"));
  const Json& its_view = after.json["bufferViews"].at(embedded["bufferView"].get<std::size_t>());
  EXPECT_EQ(after.bytes.substr(its_view["byteOffset"], its_view["byteLength"]), png);
  for (const std::size_t kept : {1, 3, 4, 5})
    EXPECT_EQ(after.json["images"][kept], images[kept]);
  write_mesh(folder / "a.gltf", soup);
  EXPECT_EQ(Json::parse(contents(folder / "a.gltf"))["images"][2], images[2]);
  // Levels have it in common, and it stays where it is.
  write_levels_of_detail(folder / "levels.glb",
                         {soup, reduce(soup, 0.4, Placement::vertices, Instances::shared).soup});
  const std::string levels = contents(folder / "levels.glb");
  const std::size_t first = levels.find(png.substr(0, 40)),
                    second = levels.find(png.substr(0, 40), first + 1);
  EXPECT_NE(second, std::string::npos);
  EXPECT_EQ(levels.find(png.substr(0, 40), second + 1), std::string::npos);
  write_mesh(folder / "b.glb", read_mesh(folder / "a.glb").soup);
  EXPECT_EQ(contents(folder / "b.glb"), contents(folder / "a.glb"));
}

// What the extension says about expressions names meshes, nodes and morph targets by their numbers.
TEST(Gltf, AvatarsAreReducedUnderTheirOwnNames)
{
  const Temporary_folder folder;
  for (const char* extension : {"VRM", "VRMC_vrm"}) {
    Document before = everything();
    before.json["extensionsUsed"].push_back(extension);
    before.json["extensions"][extension] = {{"expressions", {{"node", 1}, {"index", 0}, {"weight", 1}}}};
    const Simplified_soup reduced =
        reduce(read_glb(before).soup, 0.4, Placement::vertices, Instances::shared);
    write_mesh(folder / "small.vrm", reduced.soup);
    const Document after = from_glb(contents(folder / "small.vrm"));
    expect_everything_kept(after, before, false);
    for (const char* key : {"extensions", "extensionsUsed"})
      EXPECT_EQ(after.json[key], before.json[key]);
    EXPECT_TRUE(read_mesh(folder / "small.vrm").soup.triangles == reduced.soup.triangles);
    EXPECT_NO_THROW(write_levels_of_detail(folder / "levels.vrm", {reduced.soup}));
  }
}

// VRM 0 says of meshes what holds for every node that shows them.
TEST(Gltf, CopiesOfAMeshHaveTheExpressionsThatItHad)
{
  const Temporary_folder folder;
  Document before = everything();
  Json& avatar = before.json["extensions"]["VRM"];
  avatar["firstPerson"]["meshAnnotations"] = {{{"mesh", 0}, {"firstPersonFlag", "Auto"}}};
  avatar["blendShapeMaster"]["blendShapeGroups"] = {
      {{"name", "A"}, {"binds", {{{"mesh", 0}, {"index", 0}, {"weight", 100}}}}}};
  for (const Instances instances : {Instances::shared, Instances::apart}) {
    write_mesh(folder / "a.glb", reduce(read_glb(before).soup, 0.4, Placement::vertices, instances).soup);
    const Json after = from_glb(contents(folder / "a.glb")).json;
    std::set<Json> shown = {after["nodes"][1]["mesh"], after["nodes"][2]["mesh"]}, bound, annotated;
    ASSERT_EQ(shown.size(), instances == Instances::shared ? 1u : 2u);
    const Json& now = after["extensions"]["VRM"];
    for (const Json& bind : now["blendShapeMaster"]["blendShapeGroups"][0]["binds"]) {
      EXPECT_EQ(bind["weight"], 100);
      EXPECT_TRUE(bound.insert(bind["mesh"]).second);
    }
    for (const Json& annotation : now["firstPerson"]["meshAnnotations"])
      EXPECT_TRUE(annotated.insert(annotation["mesh"]).second);
    EXPECT_EQ(bound, shown);
    EXPECT_EQ(annotated, shown);
  }
}

TEST(Gltf, AnimationsByPointersFollowTheirMeshes)
{
  const Temporary_folder folder;
  Document before = everything();
  before.json["extensionsUsed"] = {"KHR_animation_pointer"};
  const auto pointing = [](const std::string& pointer) {
    Json channel = {{"sampler", 0}, {"target", {{"path", "pointer"}}}};
    channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"] = pointer;
    return channel;
  };
  Json& channels = before.json["animations"][0]["channels"];
  const Json first = channels[0];
  for (const char* pointer : {"/meshes/2/weights/0", "/meshes/0/weights", "/meshes/1/weights",
                              "/materials/0/emissiveFactor", "/meshes/", "/meshes/x/weights"})
    channels.push_back(pointing(pointer));
  const Triangle_soup soup = read_glb(before).soup;
  const auto channels_of = [&](const Triangle_soup& written) {
    write_mesh(folder / "a.glb", written);
    return from_glb(contents(folder / "a.glb")).json["animations"][0]["channels"];
  };
  EXPECT_EQ(channels_of(soup), channels) << "the control";
  Json expected = channels;
  expected.insert(expected.begin() + 3, pointing("/meshes/3/weights")); // the copy in another node
  EXPECT_EQ(channels_of(reduce(soup, 0.4, Placement::vertices, Instances::apart).soup), expected);
  // Without the arm, the points move up.
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (soup.groups.of_triangle[t] == 0) {
      triangles.push_back(t);
      corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
  expected = {first,
              pointing("/meshes/1/weights/0"),
              pointing("/meshes/0/weights"),
              pointing("/materials/0/emissiveFactor"),
              pointing("/meshes/"),
              pointing("/meshes/x/weights")};
  EXPECT_EQ(channels_of(selected(soup, triangles, corners)), expected);
}

TEST(Gltf, NumbersOfFeaturesAreNotMixedAtNewPlaces)
{
  const Temporary_folder folder;
  for (const char* const name : {"_FEATURE_ID_0", "_BATCHID", "_ID"}) {
    Document before = everything();
    for (Json& primitive : before.json["meshes"][0]["primitives"]) {
      primitive["attributes"][name] = primitive["attributes"]["_ID"];
      if (name != std::string("_ID"))
        primitive["attributes"].erase("_ID");
    }
    const Simplified_soup reduced = reduce(read_glb(before).soup, 0.4, Placement::optimal, Instances::apart);
    ASSERT_GT(reduced.placed_vertices, 0u);
    write_mesh(folder / "a.glb", reduced.soup);
    const Document after = from_glb(contents(folder / "a.glb"));
    std::size_t between = 0;
    for (const std::string& row :
         rows_of(after, after.json["meshes"][0]["primitives"][0]["attributes"][name]))
      between += get<float>(row, 0) != std::floor(get<float>(row, 0));
    EXPECT_EQ(between > 0, name == std::string("_ID")) << name << ": " << between;
  }
}

TEST(Gltf, ExtensionsThatNumberVerticesAreDroppedAndNamed)
{
  const Temporary_folder folder;
  Document before = everything();
  Json& json = before.json;
  json["extensionsUsed"] = {"CESIUM_primitive_outline", "EXT_mesh_manifold", "FB_ngon_encoding",
                            "KHR_materials_variants"};
  Json& coat = json["meshes"][0];
  coat["extensions"]["EXT_mesh_manifold"]["manifoldPrimitive"]["indices"] = coat["primitives"][0]["indices"];
  Json& extensions = coat["primitives"][1]["extensions"];
  extensions["KHR_materials_variants"]["mappings"] = {{{"material", 0}, {"variants", {0}}}};
  const Json kept = extensions;
  extensions["CESIUM_primitive_outline"]["indices"] = coat["primitives"][1]["indices"];
  // What is not reduced keeps what it has.
  json["meshes"][2]["extensions"]["FB_ngon_encoding"] = Json::object();
  const Mesh_file file = read_glb(before);
  EXPECT_EQ(file.notes.ignored.at("numbers of vertices or triangles (EXT_mesh_manifold)"), 1u);
  EXPECT_EQ(file.notes.ignored.at("numbers of vertices or triangles (CESIUM_primitive_outline)"), 1u);
  write_mesh(folder / "a.glb", file.soup);
  const Json after = from_glb(contents(folder / "a.glb")).json;
  EXPECT_EQ(after["extensionsUsed"], Json({"FB_ngon_encoding", "KHR_materials_variants"}));
  EXPECT_FALSE(after["meshes"][0].contains("extensions"));
  EXPECT_EQ(after["meshes"][0]["primitives"][1]["extensions"], kept);
  EXPECT_EQ(after["meshes"][2], json["meshes"][2]);
}

TEST(Gltf, NothingElseIsWrittenUnderTheNameOfAnAvatar)
{
  const Temporary_folder folder;
  const Triangle_soup soup = read_glb(everything()).soup;
  Triangle_soup bare = soup;
  bare.scene = nullptr;
  bare.scene_vertices.clear();
  for (const char* name : {"a.vrm", "a.VRM.gz"}) {
    for (const Triangle_soup& mesh : {soup, bare})
      EXPECT_THROW(write_mesh(folder / name, mesh), Argument_error);
    EXPECT_THROW(write_levels_of_detail(folder / name, {soup}), Argument_error);
    bare.poses = {{"one", bare.points}};
    EXPECT_THROW(write_gltf_poses(folder / name, bare), Argument_error);
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  }
  EXPECT_NO_THROW(write_mesh(folder / "a.glb", soup)) << "the control";
}

TEST(Gltf, PrimitivesThatAreGoneLeaveAValidFile)
{
  const Temporary_folder folder;
  Document document = everything();
  const auto of_meshes = [](std::initializer_list<int> meshes) {
    Json list = Json::array();
    for (const int mesh : meshes)
      list.push_back({{"mesh", mesh}, {"index", 0}});
    return Json{
        {"firstPerson", {{"meshAnnotations", list}}},
        {"blendShapeMaster", {{"blendShapeGroups", {{{"name", "A"}, {"binds", list}}, {{"name", "B"}}}}}}};
  };
  document.json["extensions"]["VRM"] = of_meshes({2, 1, 0, -1});
  const Mesh_file file = read_glb(document);
  std::vector<Index> triangles;
  std::vector<Index_triple> corners;
  for (Index t = 0; t < file.soup.triangles.size(); ++t)
    if (file.soup.groups.of_triangle[t] == 0) {
      triangles.push_back(t);
      corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
  write_mesh(folder / "a.glb", selected(file.soup, triangles, corners));
  const Mesh_file again = read_mesh(folder / "a.glb");
  EXPECT_EQ(again.soup.triangles.size(), triangles.size());
  const Document after = from_glb(contents(folder / "a.glb"));
  EXPECT_FALSE(after.json["nodes"][3].contains("mesh"));
  EXPECT_FALSE(after.json["nodes"][3].contains("skin"));
  EXPECT_FALSE(after.json["nodes"][2].contains("mesh"));
  EXPECT_EQ(after.json["nodes"][6]["mesh"], 1) << "the points have moved up";
  EXPECT_EQ(document.json["nodes"][6]["mesh"], 2);
  EXPECT_EQ(after.json["extensions"]["VRM"], of_meshes({1, 0, -1}));
}

TEST(Gltf, PositionsThatTheFileDoesNotHaveAreRefused)
{
  const Temporary_folder folder;
  Triangle_soup soup = read_glb(everything()).soup;
  const Point_3 own = soup.points[5], other = soup.points[6], mirrored = soup.points[side * side + 6];
  soup.points[5] = other; // of the same node: its local coordinates are known
  write_mesh(folder / "a.glb", soup);
  EXPECT_EQ(read_mesh(folder / "a.glb").soup.points[5], other);
  const std::vector<Index> transforms = transforms_of_vertices(soup);
  EXPECT_EQ(transforms[5], transforms[6]);
  EXPECT_NE(transforms[5], transforms[side * side + 6]);
  soup.points[5] = mirrored; // of another node
  EXPECT_THROW(write_mesh(folder / "a.glb", soup), Argument_error);
  soup.points[5] = Point_3(own.x() + 1, own.y(), own.z());
  EXPECT_THROW(write_mesh(folder / "a.glb", soup), Argument_error);
}

TEST(Gltf, ValuesAtNewPlacesAreInterpolated)
{
  expect_interpolated<float>(5126);
  expect_interpolated<std::uint8_t>(5121);
  expect_interpolated<std::uint16_t>(5123);
}

// The scene has colours in fractions of integers, which the soup has as well, and others that it has alone.
TEST(Gltf, ColoursAtNewPlacesAreFitted)
{
  const Temporary_folder folder;
  Document before = waves<float>(5126);
  Json& primitive = before.json["meshes"][0]["primitives"][0];
  Json& attributes = primitive["attributes"];
  const std::vector<std::string> points = rows_of(before, attributes["POSITION"]);
  const auto colour = [&](std::size_t i, std::size_t k) {
    return 0.5 + 0.4 * std::sin(double(k + 2) * 6 * get<float>(points[i], 0) + get<float>(points[i], 4));
  };
  attributes["COLOR_0"] = add_rows<std::uint16_t>(
      before, points.size(), 3, 5123,
      [&](std::size_t i, std::size_t k) { return std::lround(65535 * colour(i, k)); }, true);
  attributes["COLOR_1"] = add_rows<float>(before, points.size(), 4, 5126, colour);
  const Triangle_soup soup = read_glb(before).soup;
  std::vector<std::array<std::vector<std::string>, 4>> rows; // fitted, and not
  for (const bool are_fitted : {true, false}) {
    Simplify_options options;
    options.ratio = 0.3;
    options.placement = Placement::optimal;
    options.are_values_fitted = are_fitted;
    const Simplified_soup result = simplify_soup(prepare(soup), options);
    EXPECT_EQ(result.fitted_attributes > 10, are_fitted);
    write_mesh(folder / "a.glb", result.soup);
    const Triangle_soup again = read_mesh(folder / "a.glb").soup;
    ASSERT_EQ(again.triangles, result.soup.triangles);
    ASSERT_EQ(again.vertex_attributes.size(), result.soup.vertex_attributes.size());
    for (std::size_t i = 0; i < again.vertex_attributes.size(); ++i)
      if (const Attribute& written = result.soup.vertex_attributes[i]; written.name != "TANGENT") {
        EXPECT_EQ(again.vertex_attributes[i].rows, written.rows) << written.name;
      }
    const Document after = from_glb(contents(folder / "a.glb"));
    const Json& now = after.json["meshes"][0]["primitives"][0]["attributes"];
    rows.push_back({rows_of(after, now["COLOR_0"]), rows_of(after, now["COLOR_1"]),
                    rows_of(after, now["WEIGHTS_0"]), rows_of(after, now["TANGENT"])});
  }
  EXPECT_NE(rows[0][0], rows[1][0]);
  EXPECT_NE(rows[0][1], rows[1][1]);
  EXPECT_EQ(rows[0][2], rows[1][2]);
  EXPECT_EQ(rows[0][3], rows[1][3]);
  for (std::size_t i = 0; i < rows[0][0].size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(get<std::uint16_t>(rows[0][0][i], 2 * k) / 65535., get<float>(rows[0][1][i], 4 * k), 2e-5);
}

// The weight of a joint that few vertices have is lost where it is mixed with others and rounded.
TEST(Gltf, JointsThatLoseTheirWeightAreZero)
{
  const Temporary_folder folder;
  Document before = waves<std::uint8_t>(5121);
  Json& attributes = before.json["meshes"][0]["primitives"][0]["attributes"];
  const auto old_joints = rows_of(before, attributes["JOINTS_0"]),
             old_weights = rows_of(before, attributes["WEIGHTS_0"]),
             known = rows_of(before, attributes["POSITION"]);
  const auto is_rare = [](std::size_t i) { return i % 7 == 0; };
  attributes["JOINTS_0"] =
      add_rows<std::uint8_t>(before, known.size(), 4, 5121, [&](std::size_t i, std::size_t k) {
        return k == 2 && is_rare(i) ? 9 : k == 3 ? 5 : int(old_joints[i][k]);
      });
  attributes["WEIGHTS_0"] = add_rows<std::uint8_t>(
      before, known.size(), 4, 5121,
      [&](std::size_t i, std::size_t k) {
        const int weight = static_cast<unsigned char>(old_weights[i][k]);
        const std::size_t larger = static_cast<unsigned char>(old_weights[i][0]) > 127 ? 0 : 1;
        return is_rare(i) && k == larger ? weight - 1 : is_rare(i) && k == 2 ? 1 : weight;
      },
      true);
  const auto joints_before = rows_of(before, attributes["JOINTS_0"]),
             weights_before = rows_of(before, attributes["WEIGHTS_0"]);
  write_mesh(folder / "a.glb", reduce(read_glb(before).soup, 0.3, Placement::optimal).soup);
  const Document after = from_glb(contents(folder / "a.glb"));
  const Json& now = after.json["meshes"][0]["primitives"][0]["attributes"];
  const auto points = rows_of(after, now["POSITION"]), joints = rows_of(after, now["JOINTS_0"]),
             weights = rows_of(after, now["WEIGHTS_0"]);
  std::size_t kept = 0, placed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto found = std::find(known.begin(), known.end(), points[i]);
    if (found != known.end()) {
      const auto row = std::size_t(found - known.begin());
      EXPECT_EQ(joints[i], joints_before[row]) << "5 has no weight in the file either";
      EXPECT_EQ(weights[i], weights_before[row]);
      ++kept;
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_TRUE(weights[i][k] != 0 || joints[i][k] == 0)
          << "vertex " << i << ", joint " << int(joints[i][k]);
    ++placed;
  }
  EXPECT_GT(kept, 10u);
  EXPECT_GT(placed, 50u);
}

// In nodes that share a mesh, under transforms that round.
TEST(Gltf, NewPlacesAreWrittenAsTheyWereJudged)
{
  const Temporary_folder folder;
  const Document before = everything();
  const Triangle_soup soup = read_glb(before).soup;
  const Simplified_soup reduced = reduce(soup, 0.3, Placement::optimal);
  EXPECT_TRUE(verify(reduced, prepare(soup)).accepted());
  write_mesh(folder / "a.glb", reduced.soup);
  const Triangle_soup again = read_mesh(folder / "a.glb").soup;
  ASSERT_EQ(again.triangles.size(), reduced.soup.triangles.size());
  const auto expect_same_values = [](const auto& read, const auto& written, std::size_t t, std::size_t k) {
    const Index number = read.of_triangle[t][k], expected = written.of_triangle[t][k];
    ASSERT_EQ(number == read.missing, expected == written.missing);
    if (number != read.missing) {
      ASSERT_EQ(read.values[number], written.values[expected]);
    }
  };
  for (std::size_t t = 0; t < again.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(again.points[again.triangles[t][k]], reduced.soup.points[reduced.soup.triangles[t][k]]);
      expect_same_values(again.uvs, reduced.soup.uvs, t, k);
      expect_same_values(again.normals, reduced.soup.normals, t, k);
    }

  // Rows of vertices in the places of the input are the input's, bit for bit.
  const Document after = from_glb(contents(folder / "a.glb"));
  expect_same_rest(after, before, true);
  std::size_t kept = 0, placed = 0;
  std::set<std::size_t> accessors; // which primitives of a mesh share
  for (const auto& [mesh, original] : std::map<std::size_t, std::size_t>{{0, 0}, {1, 1}, {3, 0}})
    for (std::size_t p = 0; p < before.json["meshes"][original]["primitives"].size(); ++p) {
      const Json &now = after.json["meshes"][mesh]["primitives"][p],
                 &then = before.json["meshes"][original]["primitives"][p];
      if (!accessors.insert(now["attributes"]["POSITION"].get<std::size_t>()).second)
        continue;
      const auto known = rows_of(before, then["attributes"]["POSITION"]);
      const auto points = rows_of(after, now["attributes"]["POSITION"]);
      const auto expect_same_row = [&](std::size_t accessor, std::size_t from, std::size_t i,
                                       std::size_t row) {
        ASSERT_EQ(rows_of(after, accessor)[i], rows_of(before, from)[row]);
      };
      std::size_t placed_here = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t row = std::size_t(std::find(known.begin(), known.end(), points[i]) - known.begin());
        ++(row == known.size() ? placed_here : kept);
        if (row == known.size())
          continue;
        for (const auto& [name, accessor] : then["attributes"].items())
          expect_same_row(now["attributes"][name], accessor, i, row);
        for (std::size_t k = 0; k < then.value("targets", Json()).size(); ++k)
          expect_same_row(now["targets"][k]["POSITION"], then["targets"][k]["POSITION"], i, row);
      }
      EXPECT_GT(placed_here, 10u) << "mesh " << mesh;
      placed += placed_here;
    }
  EXPECT_EQ(placed, reduced.placed_vertices);
  EXPECT_EQ(placed + kept, reduced.soup.points.size());
}

} // namespace
} // namespace selvedge::test
