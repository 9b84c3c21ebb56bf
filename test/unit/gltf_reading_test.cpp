// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// glTF files as they are read: where vertices lie, what is noted, and what is refused.

#include "support/Gltf_document.h"
#include "support/Temporary_folder.h"
#include "verify/triangles_of_part.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

TEST(Gltf, BuffersInFilesOfTheirOwnAreRead)
{
  const Temporary_folder folder;
  Document document = everything();
  document.json["buffers"] = {{{"byteLength", document.bytes.size()}, {"uri", "the%20buffer.bin"}}};
  write_bytes(folder / "a.gltf", document.json.dump());
  write_bytes(folder / "the buffer.bin", document.bytes);
  EXPECT_EQ(read_mesh(folder / "a.gltf").soup.points, read_glb(everything()).soup.points);
  std::filesystem::remove(folder / "the buffer.bin");
  try {
    read_mesh(folder / "a.gltf");
    ADD_FAILURE() << "it is read without its numbers";
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("the buffer.bin, is not beside it"), std::string::npos);
  }
}

TEST(Gltf, WorldPositionsAreTheDocumentedFormula)
{
  const Document document = everything();
  const Mesh_file file = read_glb(document);
  const std::vector<std::string> rows =
      rows_of(document, document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
  // (0, 0.6, 0, 0.8), by hand, entry by entry.
  const double y = 0.6, w = 0.8;
  const double m00 = (1 - 2 * (y * y + 0)) * 1.5, m02 = 2 * (0 + y * w) * 0.7, m11 = (1 - 2 * 0.0) * 2.0,
               m20 = 2 * (0 - y * w) * 1.5, m22 = (1 - 2 * (0 + y * y)) * 0.7;
  const double tx = -3.3 + 10.1, ty = 0.1 + 20.2, tz = 0.2 + 30.3;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double px = get<float>(rows[i], 0), py = get<float>(rows[i], 4), pz = get<float>(rows[i], 8);
    EXPECT_EQ(file.soup.points[i],
              Point_3(m00 * px + m02 * pz + tx, m11 * py + ty, m20 * px + m22 * pz + tz));
    EXPECT_EQ(file.soup.points[i + rows.size()],
              Point_3(-px + (5.5 + 10.1), py + (0.25 + 20.2), pz + (0.125 + 30.3)));
    // A skinned mesh is where its joints are, wherever its node is.
    EXPECT_EQ(file.soup.points[i + 2 * rows.size()],
              Point_3(px + 10.1, py + 20.2, double(float(get<float>(rows[i], 8) + 0.125f)) + 30.3));
  }
}

TEST(Gltf, MirroredNodesFaceTheSameWay)
{
  const Mesh_file file = read_glb(everything());
  // All sheets look to +z in their own node; left is turned by 73.74 degrees, right is mirrored in x.
  for (std::size_t t = 0; t < file.soup.triangles.size(); ++t) {
    const auto& [a, b, c] = file.soup.triangles[t];
    const auto normal = CGAL::cross_product(file.soup.points[b] - file.soup.points[a],
                                            file.soup.points[c] - file.soup.points[a]);
    EXPECT_GT(normal.z(), 0);
    if (!file.soup.normals.empty() && file.soup.normals.of_triangle[t][0] != file.soup.normals.missing) {
      const auto& n = file.soup.normals.values[file.soup.normals.of_triangle[t][0]];
      EXPECT_GT(n[0] * normal.x() + n[1] * normal.y() + n[2] * normal.z(), 0);
      EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-6);
    }
  }
}

TEST(Gltf, GroupsMaterialsAndNotes)
{
  const Mesh_file file = read_glb(everything());
  EXPECT_EQ(file.soup.groups.names,
            (std::vector<std::string>{"left/0", "left/1", "right/0", "right/1", "arm"}));
  EXPECT_EQ(file.soup.materials.names, (std::vector<std::string>{"denim", "silk", ""}));
  const std::vector<std::string> notes = describe(file.notes);
  const auto says = [&](const std::string& word) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(word) != std::string::npos; });
  };
  for (const char* word : {"several nodes or instances share", "bind pose", "morph targets",
                           "points or lines", "files of their own"})
    EXPECT_TRUE(says(word)) << word;
}

TEST(Gltf, NodesNameAllTheirPrimitives)
{
  Triangle_soup soup = read_glb(everything()).soup;
  const auto named = [&soup](const std::string& name) {
    std::set<std::string> groups;
    const std::vector<char> is_named = triangles_named(soup, name);
    for (std::size_t t = 0; t < is_named.size(); ++t)
      if (is_named[t])
        groups.insert(soup.groups.names[soup.groups.of_triangle[t]]);
    EXPECT_EQ(internal::triangles_of_part(soup, name), is_named) << "the judge reads " << name;
    return groups;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(named("left"), (Names{"left/0", "left/1"}));
  EXPECT_EQ(named("left/1"), Names{"left/1"});
  EXPECT_EQ(named("arm"), Names{"arm"});
  for (const char* name : {"lef", "left/", "eft", "/0"})
    EXPECT_THROW(named(name), Argument_error) << name;
  soup.scene = nullptr;
  EXPECT_THROW(named("left"), Argument_error) << "slashes in other files mean nothing";
}

TEST(Gltf, WhatNotEveryVertexHasIsNamedWhereItIsToWeigh)
{
  const Prepared_soup prepared = prepare(read_glb(everything()).soup);
  Simplify_options options;
  options.ratio = 0.5;
  Simplify_intent intent;
  for (const auto& [name, attribute] : {std::pair("red", "COLOR_0"), std::pair("TEXCOORD_1", "TEXCOORD_1")}) {
    intent.weights = name;
    try {
      simplify_soup(prepared, options, intent);
      ADD_FAILURE() << name;
    } catch (const Argument_error& error) {
      EXPECT_EQ(error.what(), "attribute " + std::string(attribute) +
                                  ", which not every vertex has, cannot weigh vertices");
    }
  }
  intent.weights = "_ID";
  EXPECT_NO_THROW(simplify_soup(prepared, options, intent)) << "the control";
}

TEST(Gltf, ColoursOfDifferentTypesAreOne)
{
  Document document = one_triangle();
  Json& primitives = document.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives.push_back(primitives[0]);
  primitives[0]["attributes"]["COLOR_0"] = add_rows<std::uint8_t>(
      document, 3, 3, 5121, [](std::size_t, std::size_t k) { return 51 * k; }, true);
  primitives[1]["attributes"]["COLOR_0"] = add_rows<std::uint16_t>(
      document, 3, 4, 5123, [](std::size_t, std::size_t k) { return 13107 * k; }, true);
  primitives[2]["attributes"]["COLOR_0"] =
      add_rows<float>(document, 3, 4, 5126, [](std::size_t, std::size_t k) { return 0.25 * double(k); });
  const Triangle_soup soup = read_glb(document).soup;
  EXPECT_EQ(not_carried(soup, Mesh_format::ply),
            (std::vector<std::string>{"groups", "nodes and their transforms"}));
  ASSERT_EQ(soup.vertex_attributes.size(), 4u);
  const float expected[4][3] = {{0, 0, 0}, {0.2f, 0.2f, 0.25f}, {0.4f, 0.4f, 0.5f}, {1, 0.6f, 0.75f}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Attribute& colour = soup.vertex_attributes[k];
    EXPECT_EQ(colour.name, (std::array{"red", "green", "blue", "alpha"}[k]));
    EXPECT_EQ(colour.type, Attribute::Type::float32);
    ASSERT_EQ(colour.rows.size(), 9 * sizeof(float));
    const std::string rows(colour.rows.begin(), colour.rows.end());
    for (std::size_t v = 0; v < 9; ++v)
      EXPECT_EQ(get<float>(rows, v * sizeof(float)), expected[k][v / 3]) << k << ' ' << v;
  }
  const Temporary_folder folder;
  write_mesh(folder / "out.glb", soup);
  const Document written = from_glb(contents(folder / "out.glb"));
  for (std::size_t p = 0; p < 3; ++p) {
    const std::size_t before = primitives[p]["attributes"]["COLOR_0"];
    const std::size_t after =
        written.json["meshes"][0]["primitives"][p]["attributes"]["COLOR_0"].get<std::size_t>();
    EXPECT_EQ(rows_of(written, after), rows_of(document, before)) << p;
  }
}

TEST(Gltf, LayersInDifferentNodesSeeEachOther)
{
  // Two triangles that cross each other only through the transform of one node.
  Document document = one_triangle();
  document.json["nodes"] = {
      {{"mesh", 0}}, {{"mesh", 0}, {"rotation", {1.0, 0.0, 0.0, 0.0}}, {"translation", {0.1, 0.3, 0.0}}}};
  document.json["scenes"][0]["nodes"] = {0, 1};
  EXPECT_FALSE(offending_pairs(read_glb(document).soup).empty());
  document.json["nodes"][1]["translation"] = {0.1, 0.3, 0.1};
  EXPECT_TRUE(offending_pairs(read_glb(document).soup).empty());
}

TEST(Gltf, StripsAndFansBecomeTriangles)
{
  Document document = one_triangle();
  const auto corners = [](std::size_t i, std::size_t k) {
    return k == 0 ? float(i / 2) : k == 1 ? float(i % 2) : 0.f;
  };
  document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      add_rows<float>(document, 5, 3, 5126, corners);
  document.json["meshes"][0]["primitives"][0]["mode"] = 5;
  using Triangles = std::vector<Index_triple>;
  EXPECT_EQ(read_glb(document).soup.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  document.json["meshes"][0]["primitives"][0]["mode"] = 6;
  EXPECT_EQ(read_glb(document).soup.triangles, (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  const Temporary_folder folder;
  write_mesh(folder / "a.glb", read_glb(document).soup);
  EXPECT_FALSE(from_glb(contents(folder / "a.glb")).json["meshes"][0]["primitives"][0].contains("mode"));
  EXPECT_EQ(read_mesh(folder / "a.glb").soup.triangles, (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(Gltf, VerticesWithoutIndicesAreOneWhereTheyAgree)
{
  Document document = one_triangle();
  Json& primitive = document.json["meshes"][0]["primitives"][0];
  const float places[][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
  primitive["attributes"]["POSITION"] = add_rows<float>(
      document, 6, 3, 5126, [&](std::size_t i, std::size_t k) { return k < 2 ? places[i][k] : 0.f; });
  EXPECT_EQ(read_glb(document).soup.triangles, (std::vector<Index_triple>{{0, 1, 2}, {2, 1, 5}}));
  primitive["attributes"]["_SIDE"] =
      add_rows<float>(document, 6, 1, 5126, [](std::size_t i, std::size_t) { return i / 3; });
  EXPECT_EQ(read_glb(document).soup.triangles, (std::vector<Index_triple>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(Gltf, RefusesWhatItCannotRead)
{
  Document packed = one_triangle();
  packed.json["extensionsRequired"] = {"KHR_meshopt_compression"};
  expect_refused(packed, "KHR_meshopt_compression");
  Document unknown = one_triangle();
  unknown.json["extensionsUsed"] = {"ACME_unknown"};
  EXPECT_NO_THROW(read_glb(unknown));
  unknown.json["extensionsRequired"] = {"KHR_texture_transform"};
  EXPECT_NO_THROW(read_glb(unknown));
  unknown.json["extensionsRequired"] = {"ACME_unknown"};
  expect_refused(unknown, "ACME_unknown");
}

TEST(Gltf, WhatIsPackedInAnotherWayIsReadFromBesideIt)
{
  const char* const name = "KHR_meshopt_compression";
  Document document = one_triangle();
  const std::vector<Index_triple> triangles = read_glb(document).soup.triangles;
  document.json["extensionsUsed"] = {name};
  document.json["bufferViews"][0]["extensions"][name] = {{"buffer", 1},     {"byteOffset", 0},
                                                         {"byteLength", 8}, {"byteStride", 4},
                                                         {"count", 3},      {"mode", "ATTRIBUTES"}};
  const Mesh_file file = read_glb(document);
  EXPECT_EQ(file.soup.triangles, triangles);
  EXPECT_TRUE(std::any_of(file.notes.remarks.begin(), file.notes.remarks.end(),
                          [&](const auto& remark) { return remark.first.find(name) != std::string::npos; }));
  const Temporary_folder folder;
  write_mesh(folder / "a.glb", file.soup);
  EXPECT_EQ(contents(folder / "a.glb").find(name), std::string::npos) << "refers to bytes that are gone";
  document.json["buffers"] = {{{"byteLength", document.bytes.size()}}}; // stands for what is to be decoded
  try {
    read_mesh(document.json.dump(), Mesh_format::gltf, "dummy");
    ADD_FAILURE() << "nothing is uncompressed";
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
  }
}

TEST(Gltf, RefusesWhatIsBroken)
{
  EXPECT_NO_THROW(read_glb(one_triangle()));
  const auto refused = [](const std::string& word, const std::function<void(Json&)>& change) {
    SCOPED_TRACE(word);
    Document document = one_triangle();
    change(document.json);
    expect_refused(document, word);
  };
  refused("version", [](Json& json) { json["asset"]["version"] = "1.0"; });
  refused("no triangles", [](Json& json) { json["nodes"][0].erase("mesh"); });
  refused("points or lines and no triangles",
          [](Json& json) { json["meshes"][0]["primitives"][0]["mode"] = 1; });
  refused("animations and no mesh", [](Json& json) {
    json.erase("meshes");
    json["nodes"][0].erase("mesh");
    json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
  });
  const auto with_instances = [&](const std::string& word, const std::function<void(Json&)>& change) {
    refused(word, [&](Json& json) {
      Json& instancing = json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"];
      instancing["attributes"]["TRANSLATION"] = 0;
      change(json);
    });
  };
  with_instances("not there", [](Json& json) {
    json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 7;
  });
  with_instances("another type", [](Json& json) {
    json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = 0;
  });
  with_instances("no buffer view", [](Json& json) {
    json["accessors"].push_back({{"componentType", 5126}, {"count", 1000000000}, {"type", "VEC3"}});
    json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 1;
  });
  with_instances("skin", [](Json& json) { json["nodes"][0]["skin"] = 0; });
  refused("mesh 7", [](Json& json) { json["nodes"][0]["mesh"] = 7; });
  refused("node 9", [](Json& json) { json["scenes"][0]["nodes"] = {9}; });
  refused("twice", [](Json& json) { json["nodes"][0]["children"] = {0}; });
  refused("twice", [](Json& json) { json["scenes"][0]["nodes"] = {0, 0}; });
  refused("scene is number", [](Json& json) { json["scene"] = 3; });
  refused("wrong length", [](Json& json) { json["nodes"][0]["scale"] = {1, 2}; });
  refused("last row", [](Json& json) { json["nodes"][0]["matrix"] = std::vector<double>(16, 1); });
  refused("finite", [](Json& json) {
    json["nodes"][0]["scale"] = {1e308, 1e308, 1e308};
    json["nodes"][0]["rotation"] = {1e9, 0, 0, 1};
  });
  refused("accessor", [](Json& json) { json["accessors"][0]["count"] = 4000000000u; });
  refused("accessor", [](Json& json) { json["accessors"][0]["byteOffset"] = 4; });
  refused("buffer view", [](Json& json) { json["bufferViews"][0]["byteLength"] = 1000; });
  refused("32-bit floats", [](Json& json) { json["accessors"][0]["componentType"] = 5125; });
  refused("multiple of three", [](Json& json) { json["accessors"][0]["count"] = 2; });
  refused("accessor", [](Json& json) { json["accessors"][0]["count"] = 0; });
  refused("nowhere", [](Json& json) { json["accessors"][0].erase("bufferView"); });
  refused("accessor", [](Json& json) { json["meshes"][0]["primitives"][0]["indices"] = 7; });
  refused("accessor", [](Json& json) {
    json["accessors"].push_back({{"componentType", 5125}, {"count", 4000000000u}, {"type", "SCALAR"}});
    json["meshes"][0]["primitives"][0]["indices"] = 1;
  });
  refused("rows", [](Json& json) {
    json["accessors"].push_back(json["accessors"][0]);
    json["accessors"][1]["count"] = 2;
    json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1;
  });
  refused("material", [](Json& json) { json["meshes"][0]["primitives"][0]["material"] = 3; });
  refused("levels", [](Json& json) {
    Json deep = 1;
    for (int i = 0; i < 200; ++i)
      deep = Json::array({deep});
    json["extras"] = deep;
  });
}

// Whatever becomes of the bytes of a file, it is read or refused.
TEST(Gltf, DamagedFilesAreReadOrRefused)
{
  const std::string glb = to_glb(everything());
  std::mt19937 random(seed);
#ifdef NDEBUG
  constexpr int rounds = 1500;
#else
  constexpr int rounds = 300;
#endif
  const Temporary_folder folder;
  const std::size_t json_end = 20 + get<std::uint32_t>(glb, 12);
  std::size_t read = 0, refused = 0;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
    std::string damaged = glb;
    const auto at = [&] { return random() % (random() % 8 == 0 ? glb.size() : json_end); };
    switch (random() % 4) {
    case 0:
      damaged.resize(at());
      break;
    case 1:
      damaged[at()] = char(random());
      break;
    case 2: // a digit, which keeps the document's grammar
      for (std::size_t i = 20 + random() % (json_end - 20); i < json_end; ++i)
        if (damaged[i] >= '0' && damaged[i] <= '9') {
          damaged[i] = char('0' + random() % 10);
          break;
        }
      break;
    default: // a name or a value of another kind
      for (std::size_t i = 20 + random() % (json_end - 20); i + 1 < json_end; ++i)
        if (damaged[i] == ':') {
          damaged[i + 1] = "[{\"-9tfn"[random() % 8];
          break;
        }
    }
    try {
      const Mesh_file file = read_mesh(damaged, Mesh_format::glb, "damaged");
      ++read;
      write_mesh(folder / "a.glb", file.soup);
      EXPECT_EQ(read_mesh(folder / "a.glb").soup.triangles.size(), file.soup.triangles.size());
    } catch (const Input_error&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 0u);
  EXPECT_GT(refused, 0u);
}

} // namespace
} // namespace selvedge::test
