// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// `selvedge info`: what it prints of files of every format, and of files that are hardly meshes.

#include "App_run.h"

#include <nlohmann/json.hpp>

namespace selvedge::test {
namespace {

using Json = nlohmann::json;

TEST(App_info, ReadsEveryFormat)
{
  const Workspace folder;
  for (const auto& [ending, format] :
       {std::pair("obj", "OBJ"), std::pair("off", "OFF"), std::pair("ply", "PLY"), std::pair("stl", "STL"),
        std::pair("glb", "GLB"), std::pair("gltf", "glTF")}) {
    const std::string mesh = folder.generate("nested", std::string("mesh.") + ending, 2000, 3);
    const std::size_t files = folder.files();
    const App_result text = run_app({"info", mesh});
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_EQ(text.err, "");
    for (const std::string& line :
         {mesh + ": " + format + ", ", std::string("\nsurfaces: 3, "), std::string("3 closed, of genus 0\n"),
          std::string("\nintersections: none (decided exactly)\n"),
          std::string("\nlayers: the least distance "), std::string("\nfixed: 0 faces (0 %)")})
      EXPECT_NE(text.out.find(line), std::string::npos) << line << text.out;
    const Json report = Json::parse(run_app({"info", mesh, "--json"}).out);
    EXPECT_EQ(report["contents"]["format"], format);
    EXPECT_EQ(report["surfaces"]["closed"], 3);
    EXPECT_EQ(folder.files(), files);
  }
}

TEST(App_info, SaysWhatWouldBeFrozenAndWhy)
{
  const Workspace folder;
  const std::string mesh = folder / "mesh.obj";
  write_text(mesh, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 1\nv 9 9 0\nf 1 2 3\nf 4 5 6\n"
                   "v 0 0 9\nv 1 0 9\nv 2 0 9\nf 7 8 9\n");
  const App_result text = run_app({"info", mesh});
  EXPECT_EQ(text.code, 0) << text.err;
  for (const char* line : {"\nintersections: 2 offending pairs (decided exactly): 1 intersect, ",
                           "(--defects descend)", "\n  a degenerate face stays", "\nfixed: 0 faces"})
    EXPECT_NE(text.out.find(line), std::string::npos) << line << text.out;
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\n";
  write_text(mesh, square + "f 1 4 3\n");
  EXPECT_NE(
      run_app({"info", mesh}).out.find("\norientation: a reduction turns 1 face of 1 piece (1) to agree"),
      std::string::npos);
  write_text(mesh, square + "f 1 3 4\n");
  EXPECT_EQ(run_app({"info", mesh}).out.find("orientation"), std::string::npos);
}

TEST(App_info, WritesTheReportThatItPrints)
{
  const Workspace folder;
  const std::string mesh = folder.generate("skirt", "mesh.obj", 2000), report = folder / "report.json";
  const App_result text = run_app({"info", mesh, "--report", report});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("pieces: "), std::string::npos);
  Json written = Json::parse(contents_of(report)),
       printed = Json::parse(run_app({"info", mesh, "--json"}).out);
  written.erase("memory");
  printed.erase("memory");
  EXPECT_EQ(written, printed);
}

TEST(App_info, NamesThePartsOfMostFacesFirst)
{
  const Workspace folder;
  const std::string mesh = folder / "mesh.obj";
  write_text(mesh,
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 2 0\ng button\nf 1 2 3\ng coat\nf 2 4 3\nf 4 5 3\n");
  EXPECT_NE(run_app({"info", mesh}).out.find("\ngroups: 2 (coat with 2 faces, button with 1)\n"),
            std::string::npos);
}

// Two triangles, each a primitive of its own. Both have _WEAR, in different types, and only one has _HEAT.
void write_primitives_unlike_each_other(const Workspace& folder, const std::string& name)
{
  std::vector<float> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25f, 0.5f, 0.75f};
  write_text(folder / "numbers.bin",
             {reinterpret_cast<const char*>(numbers.data()), sizeof(float) * numbers.size()});
  write_text(name, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "buffers": [{"uri": "numbers.bin", "byteLength": 48}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "SCALAR"},
                  {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_ALL": 1, "_HEAT": 1, "_WEAR": 1}},
                               {"attributes": {"POSITION": 0, "_ALL": 1, "_WEAR": 2}}]}]})");
}

TEST(App_info, ListsAttributesThatNotEveryPrimitiveHas)
{
  const Workspace folder;
  const std::string mesh = folder / "mesh.gltf";
  write_primitives_unlike_each_other(folder, mesh);
  const App_result text = run_app({"info", mesh});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("\nattributes: _ALL, _HEAT of some primitives, _WEAR of different types\n"),
            std::string::npos)
      << text.out;
  const Json contents = Json::parse(run_app({"info", mesh, "--json"}).out)["contents"];
  EXPECT_EQ(contents["attributes"], Json({"_ALL"}));
  EXPECT_EQ(contents["attributes_of_some_primitives"], Json({"_HEAT"}));
  EXPECT_EQ(contents["attributes_of_different_types"], Json({"_WEAR"}));
}

// Vertices that are one for a reduction, because every face has its own, have faces in the file.
TEST(App_info, CountsVerticesWithoutFacesAsTheFileHasThem)
{
  const Workspace folder;
  std::string text = "v 9 9 9\n";
  std::size_t vertex = 1;
  for (int i = 0; i < 100; ++i) {
    for (const char* corner : {" 0 0\n", " 1 0\n", " 0 1\n"})
      text += "v " + std::to_string(i / 2) + corner;
    text += "f";
    for (int k = 0; k < 3; ++k)
      text += ' ' + std::to_string(++vertex);
    text += '\n';
  }
  const std::string mesh = folder / "apart.obj";
  write_text(mesh, text);
  const App_result result = run_app({"info", mesh});
  EXPECT_NE(result.out.find("corners of faces joined"), std::string::npos) << result.out << result.err;
  EXPECT_NE(result.out.find("\n  1 of the vertices belongs to no face\n"), std::string::npos) << result.out;
}

TEST(App_info, RefusesWhatIsNoMesh)
{
  const Workspace folder;
  const std::string mesh = folder / "mesh.obj";
  expect_refused({"info", mesh}, 3, mesh);
  write_text(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  expect_refused({"info", mesh}, 3, mesh);
  write_text(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\n");
  expect_refused({"info", mesh}, 3, mesh + ": every triangle of the mesh has two corners at one position");
  EXPECT_NE(run_app({"info", "--help"}).out.find("or every face has two corners at one position"),
            std::string::npos);
  expect_refused({"info"}, 2, "MESH");
  write_text(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_refused({"info", mesh, "--report", mesh}, 2, "--report");
}

} // namespace
} // namespace selvedge::test
