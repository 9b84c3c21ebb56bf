// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Attributes that are left out, and the vertices that become one then.

#include "support/Temporary_folder.h"
#include "support/reduction.h"
#include "support/soups.h"
#include "support/vertices_used.h"

#include <selvedge/Error.h>
#include <selvedge/attributes.h>
#include <selvedge/inspect.h>
#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

using Json = nlohmann::ordered_json;

// Every face has its own piece of the texture.
Triangle_soup shredded_sheet()
{
  Triangle_soup soup = sheet(12, 12);
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    Index_triple& corners = soup.uvs.of_triangle.emplace_back();
    for (Index k = 0; k < 3; ++k) {
      corners[k] = Index(soup.uvs.values.size());
      soup.uvs.values.push_back({t / 512., k / 4.});
    }
  }
  return soup;
}

// The same with one vertex for each corner, as a file has it that keeps one value for each vertex.
Triangle_soup shredded_by_vertices()
{
  Triangle_soup soup = unshared(sheet(12, 12));
  soup.uvs = shredded_sheet().uvs;
  return soup;
}

void add_attribute(Triangle_soup& soup, const char* name, const std::vector<unsigned char>& values)
{
  Attribute attribute;
  attribute.name = name;
  attribute.type = Attribute::Type::uint8;
  attribute.rows = values;
  soup.vertex_attributes.push_back(attribute);
}

std::string message_of(Triangle_soup soup, const std::string& name)
{
  try {
    drop_attributes(soup, {name});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Attributes, WithoutItsTextureAMeshOfShreddedTextureIsReduced)
{
  for (Triangle_soup soup : {shredded_sheet(), shredded_by_vertices()}) {
    const std::size_t faces = soup.triangles.size();
    EXPECT_EQ(reduce(soup, to_ratio(0.1)).simplified.soup.triangles.size(), faces);
    drop_attributes(soup, {"texture"});
    EXPECT_TRUE(soup.uvs.empty());
    const Reduction reduction = reduce(soup, to_ratio(0.1));
    EXPECT_LE(10 * reduction.simplified.soup.triangles.size(), faces);
    EXPECT_TRUE(reduction.verification.accepted());
  }
}

TEST(Attributes, VerticesThatDifferInNothingElseBecomeTheFirstOfThem)
{
  Triangle_soup soup = shredded_by_vertices();
  const Triangle_soup before = soup;
  const std::size_t positions = vertices_used(sheet(12, 12)), corners = 3 * soup.triangles.size();
  EXPECT_EQ(drop_attributes(soup, {"texture"}), corners - positions);
  EXPECT_EQ(vertices_used(soup), positions);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(soup.triangles[t][k], before.triangles[t][k]);
      EXPECT_EQ(soup.points[soup.triangles[t][k]], before.points[before.triangles[t][k]]);
    }
}

// Two squares that meet in an edge, with vertices of their own, and what each of these has.
class Attributes_of_two_squares : public testing::Test
{
protected:
  Triangle_soup soup = joined(sheet(1, 1), moved(sheet(1, 1), 1, 0, 0));

  std::size_t joined_without(const std::vector<std::string>& names) { return drop_attributes(soup, names); }
};

TEST_F(Attributes_of_two_squares, WhatDiffersInNothingAtAllStaysApart)
{
  add_attribute(soup, "heat", std::vector<unsigned char>(8, 7));
  EXPECT_EQ(joined_without({"heat"}), 0u);
  EXPECT_TRUE(soup.vertex_attributes.empty());
}

TEST_F(Attributes_of_two_squares, WhatDiffersInWhatIsLeftOutIsJoined)
{
  add_attribute(soup, "heat", {1, 1, 1, 1, 2, 2, 2, 2});
  EXPECT_GT(joined_without({"heat"}), 0u);
  EXPECT_EQ(vertices_used(soup), 6u);
}

TEST_F(Attributes_of_two_squares, WhatDiffersInAnotherAttributeStaysApart)
{
  add_attribute(soup, "heat", {1, 1, 1, 1, 2, 2, 2, 2});
  add_attribute(soup, "red", {1, 1, 1, 1, 2, 2, 2, 2});
  Triangle_soup other = soup;
  EXPECT_EQ(joined_without({"heat"}), 0u);
  soup = other;
  EXPECT_EQ(joined_without({"colors"}), 0u);
  soup = other;
  EXPECT_GT(joined_without({"colors", "heat"}), 0u);
}

TEST_F(Attributes_of_two_squares, WhatDiffersInNormalsOrInAPoseStaysApart)
{
  add_attribute(soup, "heat", {1, 1, 1, 1, 2, 2, 2, 2});
  const Triangle_soup other = soup;
  soup.normals.values = {{0, 0, 1}, {0, 1, 0}};
  soup.normals.of_triangle = {{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(joined_without({"heat"}), 0u);
  soup = other;
  soup.poses.push_back({"apart", moved(soup, 0, 0, 0).points});
  for (std::size_t v = 4; v < 8; ++v)
    soup.poses[0].points[v] = Point_3(9, double(v), 9);
  EXPECT_EQ(joined_without({"heat"}), 0u);
}

// In OBJ, pieces lie beside each other that have vertices of their own; so it stays without their texture.
TEST_F(Attributes_of_two_squares, WhatDiffersInTextureCoordinatesWithNumbersOfTheirOwnStaysApart)
{
  const auto with_uvs = [this](std::size_t unused) {
    soup.uvs.values.assign(soup.points.size() + unused, {9, 9});
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      soup.uvs.values[v] = {double(v), 0};
    soup.uvs.of_triangle = soup.triangles;
  };
  const Triangle_soup other = soup;
  with_uvs(1);
  EXPECT_EQ(joined_without({"texture"}), 0u);
  EXPECT_EQ(soup.triangles, other.triangles);
  with_uvs(0);
  EXPECT_GT(joined_without({"texture"}), 0u) << "the control";
}

TEST_F(Attributes_of_two_squares, TextureCoordinatesThatStayAreThoseOfTheVertex)
{
  add_attribute(soup, "heat", {1, 1, 1, 1, 2, 2, 2, 2});
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.x() / 2, p.y()});
  soup.uvs.of_triangle = soup.triangles;
  EXPECT_GT(joined_without({"heat"}), 0u);
  EXPECT_EQ(soup.uvs.of_triangle, soup.triangles); // as a file needs it that has one for each vertex
}

TEST(Attributes, NamesOfNothingAreRefused)
{
  Triangle_soup soup = shredded_sheet();
  add_attribute(soup, "heat", std::vector<unsigned char>(soup.points.size(), 0));
  EXPECT_NE(message_of(soup, "cold").find("no attribute 'cold' to leave out; it has texture, heat"),
            std::string::npos)
      << message_of(soup, "cold");
  EXPECT_NE(message_of(sheet(2, 2), "texture").find("it has none"), std::string::npos);
  EXPECT_NE(message_of(soup, "NORMAL").find("--normals drop"), std::string::npos);
  EXPECT_NE(message_of(soup, "JOINTS_0").find("skins need it"), std::string::npos);
}

TEST(Attributes, OfFacesAreLeftOut)
{
  Triangle_soup soup = sheet(2, 2);
  for (const char* name : {"red", "green", "row"})
    soup.triangle_attributes.push_back(
        {name, Attribute::Type::uint8, 1, false, std::vector<unsigned char>(soup.triangles.size(), 1)});
  drop_attributes(soup, {"colors"});
  ASSERT_EQ(soup.triangle_attributes.size(), 1u);
  EXPECT_EQ(soup.triangle_attributes[0].name, "row");
  drop_attributes(soup, {"row"});
  EXPECT_TRUE(soup.triangle_attributes.empty());
}

TEST(Attributes, SeamsOfTheTextureAreCounted)
{
  const Triangle_soup soup = shredded_sheet();
  const std::size_t inner = (3 * soup.triangles.size() - 4 * 12) / 2;
  const Reduction reduction = reduce(soup, to_ratio(1));
  const auto seams = seams_of_attributes(reduction.prepared);
  EXPECT_EQ(seams.at("texture"), inner);
}

TEST(Attributes, SeamsOfTheTextureOfADoubleSidedSheetAreCountedOnce)
{
  Triangle_soup soup = shredded_sheet();
  for (auto* const triples : {&soup.triangles, &soup.uvs.of_triangle}) {
    const std::vector<Index_triple> fronts = *triples;
    for (const auto& [a, b, c] : fronts)
      triples->push_back({a, c, b});
  }
  const Reduction one = reduce(shredded_sheet(), to_ratio(1)), both = reduce(soup, to_ratio(1));
  EXPECT_EQ(seams_of_attributes(both.prepared), seams_of_attributes(one.prepared));
}

TEST(Attributes, AreNamedWhereTheyAreTheOnlyCauseOfSeams)
{
  Triangle_soup soup = joined(sheet(1, 2), moved(sheet(1, 2), 1, 0, 0));
  const auto seams = [&] {
    const Reduction reduction = reduce(soup, to_ratio(1));
    return seams_of_attributes(reduction.prepared);
  };
  using Counts = std::map<std::string, std::size_t>;
  std::vector<unsigned char> values(soup.points.size(), 0);
  std::fill(values.begin() + std::ptrdiff_t(values.size() / 2), values.end(), 1);
  add_attribute(soup, "red", values);
  EXPECT_EQ(seams(), (Counts{{"red", 2}}));
  add_attribute(soup, "green", values);
  EXPECT_EQ(seams(), (Counts{{"green", 2}, {"red", 2}})); // which are left out together
  std::vector<unsigned char> noise;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    noise.push_back(static_cast<unsigned char>(t));
  soup.triangle_attributes = {{"noise", Attribute::Type::uint8, 1, false, noise}};
  EXPECT_EQ(seams(), (Counts{{"green", 2}, {"red", 2}})); // which makes no lines
  add_attribute(soup, "heat", values);
  EXPECT_EQ(seams(), Counts());
}

TEST(Attributes, OfGltfJoinVerticesWhoseNormalsDifferInTheLastDigits)
{
  Triangle_soup soup = shredded_by_vertices();
  soup.normals.of_triangle = soup.triangles;
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    soup.normals.values.push_back({1e-5 * double(v % 7), 0, 1});
  const Temporary_folder folder;
  write_mesh(folder / "in.glb", soup);
  Triangle_soup mesh = read_mesh(folder / "in.glb").soup;
  EXPECT_EQ(vertices_used(mesh), soup.points.size());
  drop_attributes(mesh, {"texture"});
  EXPECT_EQ(vertices_used(mesh), vertices_used(sheet(12, 12)));
}

// Where a texture ends, a vertex has one normal on the level side, and several on the other.
TEST(Attributes, OfGltfThatShadesFlatJoinVerticesWhateverTheirNormals)
{
  const Triangle_soup roof = mapped(sheet(12, 12), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), p.x() > 6 ? int(p.x() + p.y()) % 2 : 0);
  });
  Triangle_soup soup = unshared(roof);
  soup.normals.of_triangle = soup.uvs.of_triangle = soup.triangles;
  for (const Index_triple& triangle : soup.triangles) {
    const Point_3 &a = soup.points[triangle[0]], &b = soup.points[triangle[1]], &c = soup.points[triangle[2]];
    const auto normal = CGAL::unit_normal(a, b, c);
    const bool is_level = std::max({a.x(), b.x(), c.x()}) <= 6;
    for (const Index v : triangle) {
      soup.normals.values.push_back({normal.x(), normal.y(), normal.z()});
      soup.uvs.values.push_back({soup.points[v].x() / 32 + (is_level ? 0 : 0.5), soup.points[v].y() / 32});
    }
  }
  const Temporary_folder folder;
  write_mesh(folder / "in.glb", soup);
  Triangle_soup mesh = read_mesh(folder / "in.glb").soup;
  EXPECT_EQ(vertices_used(mesh), vertices_used(roof) + 13);
  drop_attributes(mesh, {"texture"});
  EXPECT_EQ(vertices_used(mesh), vertices_used(roof));
  EXPECT_TRUE(has_flat_normals(mesh));
}

// A glTF file in which each face has vertices of its own, with textures of both sets, as JSON and as read.
class Attributes_of_gltf : public testing::Test
{
protected:
  Attributes_of_gltf()
  {
    Triangle_soup soup = shredded_by_vertices();
    add_attribute(soup, "red", std::vector<unsigned char>(soup.points.size(), 9));
    add_attribute(soup, "green", std::vector<unsigned char>(soup.points.size(), 9));
    add_attribute(soup, "blue", std::vector<unsigned char>(soup.points.size(), 9));
    write_mesh(folder / "in.gltf", soup);
    Json json = json_of("in.gltf");
    Json& primitive = json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_1"] = primitive["attributes"]["TEXCOORD_0"];
    primitive["material"] = 0;
    json["textures"] = {{{"source", 0}}};
    json["images"] = {{{"uri", "data:image/png;base64,"}}};
    json["materials"] = Json::parse(R"([{
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0},
      "normalTexture": {"index": 0, "texCoord": 1},
      "emissiveTexture": {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform": {"texCoord": 0}}},
      "extensions": {"KHR_materials_specular": {"specularTexture": {"index": 0}, "specularFactor": 0.5}}}])");
    std::ofstream(folder / "in.gltf") << json;
    mesh = read_mesh(folder / "in.gltf").soup;
  }

  Json json_of(const char* name) const { return Json::parse(std::ifstream(folder / name)); }

  // What the file has that is written without these attributes.
  Json written_without(const std::vector<std::string>& names)
  {
    joined = drop_attributes(mesh, names);
    write_mesh(folder / "out.gltf", mesh);
    return json_of("out.gltf");
  }

  static std::set<std::string> attributes_in(const Json& json)
  {
    std::set<std::string> result;
    for (const auto& entry : json["meshes"][0]["primitives"][0]["attributes"].items())
      result.insert(entry.key());
    return result;
  }

  Temporary_folder folder;
  Triangle_soup mesh;
  std::size_t joined = 0;
};

TEST_F(Attributes_of_gltf, AllSetsOfTheTextureGoAndSoDoTheTexturesOfMaterials)
{
  const Json json = written_without({"texture"});
  EXPECT_EQ(attributes_in(json), (std::set<std::string>{"POSITION", "COLOR_0"}));
  EXPECT_EQ(json["materials"], Json::parse(R"([{
      "pbrMetallicRoughness": {"metallicFactor": 0},
      "extensions": {"KHR_materials_specular": {"specularFactor": 0.5}}}])"));
  EXPECT_GT(joined, 0u);
  EXPECT_EQ(vertices_used(mesh), vertices_used(sheet(12, 12)));
  EXPECT_TRUE(read_mesh(folder / "out.gltf").soup.uvs.empty());
}

TEST_F(Attributes_of_gltf, OneSetGoesWithTheTexturesThatItPlaces)
{
  const Json json = written_without({"TEXCOORD_1"});
  EXPECT_EQ(attributes_in(json), (std::set<std::string>{"POSITION", "TEXCOORD_0", "COLOR_0"}));
  const Json& material = json["materials"][0];
  EXPECT_FALSE(material.contains("normalTexture"));
  EXPECT_TRUE(material["pbrMetallicRoughness"].contains("baseColorTexture"));
  EXPECT_TRUE(material.contains("emissiveTexture")); // its transform says that it lies in the other set
  EXPECT_EQ(joined, 0u);
  EXPECT_FALSE(mesh.uvs.empty());
}

// Five images, of which the first is referred to by nothing and the last is beside the file.
class Images_of_gltf : public Attributes_of_gltf
{
protected:
  Images_of_gltf()
  {
    Json json = json_of("in.gltf");
    json["images"] = {{{"name", "spare"}, {"uri", "spare.png"}},
                      {{"name", "weave"}, {"mimeType", "image/png"}},
                      {{"name", "both"}, {"uri", "both.png"}},
                      {{"name", "shine"}, {"uri", "shine.png"}},
                      {{"name", "packed"}, {"uri", "packed.ktx2"}}};
    json["images"][1]["bufferView"] = json["bufferViews"].size();
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 96}, {"name", "weave"}});
    json["samplers"] = {{{"magFilter", 9728}}, {{"magFilter", 9729}}};
    json["textures"] = {
        {{"source", 1}, {"sampler", 0}},
        {{"source", 2}, {"sampler", 1}},
        {{"source", 2}, {"sampler", 0}},
        {{"source", 3}, {"sampler", 1}, {"extensions", {{"KHR_texture_basisu", {{"source", 4}}}}}}};
    json["extensionsUsed"] = {"KHR_materials_specular", "KHR_texture_basisu", "KHR_texture_transform"};
    json["materials"] = Json::parse(R"([{
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
      "occlusionTexture": {"index": 1},
      "normalTexture": {"index": 2, "texCoord": 1},
      "extensions": {"KHR_materials_specular": {"specularTexture": {"index": 3, "texCoord": 1}}}}])");
    write(json);
  }

  void write(const Json& json)
  {
    std::ofstream(folder / "in.gltf") << json;
    mesh = read_mesh(folder / "in.gltf").soup;
  }

  static std::vector<std::string> images_in(const Json& json)
  {
    std::vector<std::string> names;
    for (const Json& image : json.value("images", Json::array()))
      names.push_back(image["name"]);
    return names;
  }
};

TEST_F(Images_of_gltf, GoWithTheirTexturesAndSamplers)
{
  const Json json = written_without({"texture"});
  EXPECT_FALSE(json.contains("textures"));
  EXPECT_FALSE(json.contains("samplers"));
  EXPECT_EQ(images_in(json), std::vector<std::string>{"spare"}) << "to which nothing has referred before";
  EXPECT_EQ(json.dump().find("weave"), std::string::npos) << "the bytes of an image stay";
}

TEST_F(Images_of_gltf, StayWhereATextureThatStaysShowsThem)
{
  const Json json = written_without({"TEXCOORD_1"});
  EXPECT_EQ(images_in(json), (std::vector<std::string>{"spare", "weave", "both"}));
  ASSERT_EQ(images_in(json).size(), 3u);
  ASSERT_EQ(json["textures"].size(), 2u);
  EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  EXPECT_EQ(json["materials"][0]["occlusionTexture"]["index"], 1);
  EXPECT_EQ(json["images"][json["textures"][1]["source"].get<std::size_t>()]["name"], "both");
  EXPECT_EQ(json["samplers"], (Json{{{"magFilter", 9728}}, {{"magFilter", 9729}}}));
}

TEST_F(Images_of_gltf, OfTexturesThatStayGetOtherNumbers)
{
  Json json = json_of("in.gltf");
  // What was seen by the first set is now seen by the second one, and the other way round.
  json["materials"] = Json::parse(R"([{
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}},
      "occlusionTexture": {"index": 1, "texCoord": 1},
      "extensions": {"KHR_materials_specular": {"specularTexture": {"index": 3}}}}])");
  json["textures"][0]["sampler"] = 0;
  json["textures"].erase(2);
  json["materials"][0]["extensions"]["KHR_materials_specular"]["specularTexture"]["index"] = 2;
  write(json);
  const Json written = written_without({"TEXCOORD_1"});
  EXPECT_EQ(images_in(written), (std::vector<std::string>{"spare", "shine", "packed"}));
  EXPECT_EQ(written["textures"], Json::parse(R"([{"source": 1, "sampler": 0,
      "extensions": {"KHR_texture_basisu": {"source": 2}}}])"));
  EXPECT_EQ(written["samplers"], Json::parse(R"([{"magFilter": 9729}])"));
  EXPECT_EQ(written["materials"][0]["extensions"]["KHR_materials_specular"]["specularTexture"]["index"], 0);
}

TEST_F(Images_of_gltf, StayWhereAnExtensionThatIsNotKnownMayReferToThem)
{
  Json json = json_of("in.gltf");
  json["extensionsUsed"].push_back("ACME_decals");
  json["extensions"] = {{"ACME_decals", {{"texture", 0}}}};
  write(json);
  const Json written = written_without({"texture"});
  EXPECT_EQ(images_in(written).size(), 5u);
  for (const char* list : {"textures", "samplers"})
    EXPECT_EQ(written.value(list, Json()), json[list]);
}

TEST_F(Attributes_of_gltf, NoSetGoesBeforeALaterOne)
{
  try {
    drop_attributes(mesh, {"TEXCOORD_0"});
    ADD_FAILURE() << "a file with TEXCOORD_1 alone is no valid glTF file";
  } catch (const Argument_error& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "attribute 'TEXCOORD_0' cannot be left out without 'TEXCOORD_1': glTF numbers sets without a gap; "
        "leave out both");
  }
  EXPECT_EQ(attributes_in(written_without({"TEXCOORD_0", "TEXCOORD_1"})),
            (std::set<std::string>{"POSITION", "COLOR_0"}));
}

TEST_F(Attributes_of_gltf, ColoursGo)
{
  const Json json = written_without({"colors"});
  EXPECT_EQ(attributes_in(json), (std::set<std::string>{"POSITION", "TEXCOORD_0", "TEXCOORD_1"}));
  EXPECT_TRUE(mesh.vertex_attributes.size() == 1 && mesh.vertex_attributes[0].name == "TEXCOORD_1");
  EXPECT_EQ(json["materials"], json_of("in.gltf")["materials"]);
}

} // namespace
} // namespace selvedge::test
