// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// glTF files that are compressed or quantised are decoded on the way in, and written as they came.

#include "support/Temporary_folder.h"
#include "support/vertices_used.h"

#include "soup/Gltf_scene.h"
#include "soup/selection.h"
#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/prepare.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#ifdef SELVEDGE_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#ifdef SELVEDGE_HAS_DRACO
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t s_side = 20, s_vertices = s_side * s_side;

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers)
{
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

/// A wavy sheet of s_side × s_side vertices.
struct Sheet
{
  Sheet()
  {
    for (std::uint32_t i = 0; i < s_vertices; ++i) {
      const float x = float(i % s_side), y = float(i / s_side);
      positions.insert(positions.end(), {x / 7, y / 7, std::sin(x) / 10});
      normals.insert(normals.end(), {0.6f, 0, 0.8f});
    }
    for (std::uint32_t y = 0; y + 1 < s_side; ++y)
      for (std::uint32_t x = 0; x + 1 < s_side; ++x) {
        const auto a = std::uint16_t(y * s_side + x), b = std::uint16_t(a + s_side);
        for (const int corner : {int(a), a + 1, b + 1, int(a), b + 1, int(b)})
          indices.push_back(std::uint16_t(corner));
      }
  }

  std::vector<float> positions, normals;
  std::vector<std::uint16_t> indices;
};

/// A glTF file in the making: a mesh of one primitive.
class Document_of_sheet
{
public:
  Document_of_sheet()
  {
    json = {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"mesh", 0}}}},
            {"buffers", Json::array({{{"byteLength", 0}}})},
            {"bufferViews", Json::array()},
            {"accessors", Json::array()},
            {"meshes", {{{"primitives", {{{"attributes", Json::object()}}}}}}}};
  }

  std::size_t add_view(const std::string& contents)
  {
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", contents.size()}});
    bytes += contents;
    return json["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(const Json& view, std::size_t count, int component_type, const char* type)
  {
    Json accessor = {{"componentType", component_type}, {"count", count}, {"type", type}};
    if (!view.is_null())
      accessor["bufferView"] = view;
    json["accessors"].push_back(accessor);
    return json["accessors"].size() - 1;
  }

  void use(const char* extension)
  {
    json["extensionsUsed"].push_back(extension);
    json["extensionsRequired"].push_back(extension);
  }

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }

  std::string glb() const
  {
    Json complete = json;
    complete["buffers"][0]["byteLength"] = bytes.size();
    std::string text = complete.dump(), body = bytes;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    body.resize((body.size() + 3) / 4 * 4, '\0');
    const auto number = [](std::size_t value) {
      return bytes_of(std::vector<std::uint32_t>{std::uint32_t(value)});
    };
    return "glTF" + number(2) + number(28 + text.size() + body.size()) + number(text.size()) + "JSON" + text +
           number(body.size()) + std::string("BIN\0", 4) + body;
  }

  Json json;
  std::string bytes;
};

Document_of_sheet plain_sheet()
{
  const Sheet sheet;
  Document_of_sheet document;
  Json& attributes = document.primitive()["attributes"];
  attributes["POSITION"] =
      document.add_accessor(document.add_view(bytes_of(sheet.positions)), s_vertices, 5126, "VEC3");
  attributes["NORMAL"] =
      document.add_accessor(document.add_view(bytes_of(sheet.normals)), s_vertices, 5126, "VEC3");
  document.primitive()["indices"] =
      document.add_accessor(document.add_view(bytes_of(sheet.indices)), sheet.indices.size(), 5123, "SCALAR");
  return document;
}

Mesh_file read(const Document_of_sheet& document)
{
  return read_mesh(document.glb(), Mesh_format::glb, "sheet");
}

/// The corners of every triangle as points, with the least first: what a codec may not change.
std::multiset<std::array<std::array<double, 3>, 3>> triangles_of(const Triangle_soup& soup)
{
  std::multiset<std::array<std::array<double, 3>, 3>> result;
  for (const Index_triple& triangle : soup.triangles) {
    std::array<std::array<double, 3>, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Point_3& p = soup.points[triangle[k]];
      corners[k] = {p.x(), p.y(), p.z()};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.insert(corners);
  }
  return result;
}

Json json_of(const std::string& glb)
{
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, sizeof size);
  return Json::parse(glb.substr(20, size));
}

/// Writes a mesh, and expects a plain file that reads as the same.
std::string expect_written_plain(const Mesh_file& file)
{
  const Temporary_folder folder;
  write_mesh(folder / "m.glb", file.soup);
  const std::string glb = read_file(folder / "m.glb");
  const Json json = json_of(glb);
  EXPECT_FALSE(json.contains("extensionsUsed")) << json["extensionsUsed"];
  EXPECT_FALSE(json.contains("extensionsRequired"));
  EXPECT_EQ(json.dump().find("\"extensions\""), std::string::npos);
  const Mesh_file again = read_mesh(folder / "m.glb");
  EXPECT_EQ(triangles_of(again.soup), triangles_of(file.soup));
  EXPECT_EQ(again.notes.remarks.size(), 0u);
  return glb;
}

using Names = std::set<std::string>;

/// Writes a mesh, and expects a file that needs these extensions alone and reads as the same.
std::string expect_written_by(const Mesh_file& file, const Names& extensions)
{
  const Temporary_folder folder;
  write_mesh(folder / "m.glb", file.soup);
  const std::string glb = read_file(folder / "m.glb");
  EXPECT_EQ(json_of(glb)["extensionsUsed"].get<Names>(), extensions);
  EXPECT_EQ(json_of(glb)["extensionsRequired"].get<Names>(), extensions);
  const Mesh_file again = read_mesh(folder / "m.glb");
  EXPECT_EQ(triangles_of(again.soup), triangles_of(file.soup));
  EXPECT_EQ(std::set(again.soup.normals.values.begin(), again.soup.normals.values.end()),
            std::set(file.soup.normals.values.begin(), file.soup.normals.values.end()));
  return glb;
}

/// Writes the mesh, half of it and this half again as levels of one file, and expects each to be compressed
/// once and to read as it was.
void expect_levels_written_by(const Mesh_file& file, Names extensions)
{
  const Temporary_folder folder;
  Triangle_soup half = file.soup;
  std::vector<Index> first_half(half.triangles.size() / 2);
  std::iota(first_half.begin(), first_half.end(), Index(0));
  keep_triangles(half, first_half);
  const std::vector<Triangle_soup> levels = {file.soup, half, half};
  write_levels_of_detail(folder / "m.glb", levels);
  const Json json = json_of(read_file(folder / "m.glb"));
  EXPECT_EQ(json["extensionsRequired"].get<Names>(), extensions);
  extensions.insert("MSFT_lod");
  EXPECT_EQ(json["extensionsUsed"].get<Names>(), extensions);
  ASSERT_EQ(json["meshes"].size(), 3u);
  EXPECT_NE(json["meshes"][0], json["meshes"][1]);
  EXPECT_EQ(json["meshes"][1], json["meshes"][2]);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    Read_options options;
    options.level_of_detail = level;
    EXPECT_EQ(triangles_of(read_mesh(folder / "m.glb", options).soup), triangles_of(levels[level]));
  }
}

/// Changes bytes of the compressed part, some hundred all over it, each in turn: the file is read or refused.
void expect_damage_is_survived(const Document_of_sheet& document, std::size_t first, std::size_t last)
{
  std::size_t refused = 0;
  for (std::size_t at = first; at < last; at += 1 + (last - first) / 250)
    for (const int change : {1, 0x80, 0xff}) {
      Document_of_sheet damaged = document;
      damaged.bytes[at] = char(damaged.bytes[at] ^ change);
      try {
        read(damaged);
      } catch (const Input_error&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, 0u);
}

bool has_remark(const Mesh_file& file, const std::string& what)
{
  return std::any_of(file.notes.remarks.begin(), file.notes.remarks.end(),
                     [&](const auto& remark) { return remark.first.find(what) != std::string::npos; });
}

TEST(Gltf_indices, AreOfALargerTypeWhereVerticesSplitByTheirNormalsAreTooMany)
{
  const Sheet sheet;
  constexpr std::size_t vertices = 12 * s_side, corners = 11 * (s_side - 1) * 6;
  Document_of_sheet document;
  Json& attributes = document.primitive()["attributes"];
  for (const auto& [name, rows] : {std::pair("POSITION", sheet.positions), {"NORMAL", sheet.normals}})
    attributes[name] = document.add_accessor(
        document.add_view(bytes_of(std::vector(rows.begin(), rows.begin() + 3 * vertices))), vertices, 5126,
        "VEC3");
  const std::vector<std::uint8_t> indices(sheet.indices.begin(), sheet.indices.begin() + corners);
  document.primitive()["indices"] =
      document.add_accessor(document.add_view(bytes_of(indices)), corners, 5121, "SCALAR");
  Mesh_file file = read(document);
  const auto type_written = [&] {
    const Json json = json_of(expect_written_plain(file));
    const std::size_t number = json["meshes"][0]["primitives"][0]["indices"];
    return json["accessors"][number]["componentType"];
  };
  EXPECT_EQ(type_written(), 5121);
  file.soup.normals = {};
  for (std::size_t t = 0; t < file.soup.triangles.size(); ++t) {
    file.soup.normals.values.push_back({std::sin(double(t)), std::cos(double(t)), 0});
    file.soup.normals.of_triangle.push_back({Index(t), Index(t), Index(t)});
  }
  EXPECT_EQ(type_written(), 5123);
  const Temporary_folder folder;
  const Write_notes notes = write_mesh(folder / "m.glb", file.soup);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes.begin()->first.find("vertices beyond those of the input"), 0u);
  EXPECT_EQ(notes.begin()->second, read_mesh(folder / "m.glb").soup.points.size() - vertices);
}

/// Two sheets, one above the other, in two buffer views: one of positions and normals, one of indices.
Document_of_sheet sheets_in_two_views()
{
  const Sheet sheet;
  Document_of_sheet document;
  std::vector<float> rows;
  for (const float height : {0.f, 1.f})
    for (std::size_t i = 0; i < sheet.positions.size(); i += 3) {
      rows.insert(rows.end(), &sheet.positions[i], &sheet.positions[i] + 3);
      rows.back() += height;
      rows.insert(rows.end(), &sheet.normals[i], &sheet.normals[i] + 3);
      rows[rows.size() - 2] = height; // so that no column is the same in both
    }
  std::vector<std::uint16_t> indices = sheet.indices;
  indices.insert(indices.end(), sheet.indices.begin(), sheet.indices.end());
  const std::size_t vertices = document.add_view(bytes_of(rows)),
                    corners = document.add_view(bytes_of(indices));
  document.json["bufferViews"][vertices]["byteStride"] = 24;
  const auto add = [&](std::size_t view, std::size_t offset, std::size_t count, int type, const char* name) {
    const std::size_t accessor = document.add_accessor(view, count, type, name);
    document.json["accessors"][accessor]["byteOffset"] = offset;
    return accessor;
  };
  document.json["meshes"][0]["primitives"].push_back(document.primitive());
  for (const std::size_t i : {0, 1}) {
    Json& primitive = document.json["meshes"][0]["primitives"][i];
    primitive["attributes"] = {{"POSITION", add(vertices, 24 * i * s_vertices, s_vertices, 5126, "VEC3")},
                               {"NORMAL", add(vertices, 24 * i * s_vertices + 12, s_vertices, 5126, "VEC3")}};
    primitive["indices"] = add(corners, 2 * i * sheet.indices.size(), sheet.indices.size(), 5123, "SCALAR");
  }
  return document;
}

/// Returns the buffer view of an attribute of a primitive.
std::size_t view_of(const Json& json, std::size_t mesh, std::size_t primitive, const char* attribute)
{
  const Json& attributes = json["meshes"][mesh]["primitives"][primitive]["attributes"];
  return json["accessors"][attributes[attribute].get<std::size_t>()]["bufferView"];
}

TEST(Gltf_views, AreSharedByTheColumnsThatSharedThemInTheFile)
{
  Mesh_file file = read(sheets_in_two_views());
  for (const bool is_half : {false, true}) {
    if (is_half) {
      std::vector<Index> half;
      for (Index t = 0; t < file.soup.triangles.size(); t += 2)
        half.push_back(t);
      keep_triangles(file.soup, half);
    }
    const Json json = json_of(expect_written_plain(file));
    EXPECT_EQ(json["bufferViews"].size(), 2u);
    for (const std::size_t i : {0, 1})
      for (const char* attribute : {"POSITION", "NORMAL"})
        EXPECT_EQ(view_of(json, 0, i, attribute), view_of(json, 0, 0, "POSITION"));
    EXPECT_EQ(json["bufferViews"][view_of(json, 0, 0, "POSITION")]["byteStride"], 24);
  }
  Document_of_sheet apart = plain_sheet();
  EXPECT_EQ(json_of(expect_written_plain(read(apart)))["bufferViews"].size(), 3u);
}

TEST(Gltf_views, AreNotInterleavedWhereLevelsOfDetailShareTheFirstRows)
{
  const Mesh_file file = read(sheets_in_two_views());
  Triangle_soup coarse = file.soup;
  std::vector<Index> first_quarter(coarse.triangles.size() / 4);
  std::iota(first_quarter.begin(), first_quarter.end(), Index(0));
  keep_triangles(coarse, first_quarter);
  for (Index_triple& triple : coarse.normals.of_triangle)
    triple.fill(Index(coarse.normals.values.size()));
  coarse.normals.values.push_back({1, 0, 0});
  const std::vector<Triangle_soup> levels = {file.soup, coarse};
  const Temporary_folder folder;
  write_levels_of_detail(folder / "m.glb", levels);
  const Json json = json_of(read_file(folder / "m.glb"));
  EXPECT_EQ(view_of(json, 1, 0, "POSITION"), view_of(json, 0, 0, "POSITION"));
  for (std::size_t level = 0; level < levels.size(); ++level) {
    Read_options options;
    options.level_of_detail = level;
    const Triangle_soup again = read_mesh(folder / "m.glb", options).soup;
    EXPECT_EQ(triangles_of(again), triangles_of(levels[level]));
    const auto normals_of = [](const Triangle_soup& soup) {
      std::vector<std::array<double, 3>> result;
      for (const Index_triple& triple : soup.normals.of_triangle)
        result.push_back(soup.normals.values[triple[0]]);
      return result;
    };
    EXPECT_TRUE(normals_of(again) == normals_of(levels[level]));
  }
}

TEST(Gltf_dead_views, AreNotWrittenUnlessSomethingUnknownMayReferToThem)
{
  const Temporary_folder folder;
  Document_of_sheet document = plain_sheet();
  write_mesh(folder / "plain.glb", read(document).soup);
  const std::size_t size = read_file(folder / "plain.glb").size();
  const std::size_t dead = document.add_view(std::string(100'000, 'x'));
  document.add_accessor(document.add_view(std::string(40'000, 'y')), 10'000, 5126, "SCALAR");
  const std::string glb = expect_written_plain(read(document));
  EXPECT_LT(glb.size(), size + 1000);
  EXPECT_LT(glb.size(), document.glb().size());
  // A view that an image needs stays.
  document.json["images"] = {{{"bufferView", dead}, {"mimeType", "image/png"}}};
  write_mesh(folder / "image.glb", read(document).soup);
  EXPECT_GT(read_file(folder / "image.glb").size(), size + 100'000);
  document.json.erase("images");
  document.json["extensionsUsed"] = {"ACME_reads_views"};
  write_mesh(folder / "unknown.glb", read(document).soup);
  EXPECT_GT(read_file(folder / "unknown.glb").size(), size + 140'000);
}

/// A sheet of whole numbers: positions and normals that are fractions, texture coordinates that are not, and
/// one morph target.
Document_of_sheet quantised_sheet()
{
  const Sheet sheet;
  Document_of_sheet document;
  std::vector<std::int16_t> positions;
  std::vector<std::int8_t> normals, displacements;
  std::vector<std::uint16_t> uvs;
  for (std::uint32_t i = 0; i < s_vertices; ++i) {
    for (int k = 0; k < 3; ++k)
      positions.push_back(std::int16_t(std::lround(sheet.positions[3 * i + k] * 10'000)));
    positions.push_back(0); // rows begin at multiples of four bytes
    for (const int number : {76, 0, 102, 0})
      normals.push_back(std::int8_t(number));
    for (const int number : {0, 0, int(i % 5) - 2, 0})
      displacements.push_back(std::int8_t(number));
    uvs.push_back(std::uint16_t(i % s_side));
    uvs.push_back(std::uint16_t(i / s_side));
  }
  positions[0] = -32768;
  Json& attributes = document.primitive()["attributes"];
  const auto add = [&](const std::string& bytes, int component_type, const char* type, bool is_normalized) {
    const std::size_t view = document.add_view(bytes);
    document.json["bufferViews"][view]["byteStride"] = bytes.size() / s_vertices;
    const std::size_t accessor = document.add_accessor(view, s_vertices, component_type, type);
    document.json["accessors"][accessor]["normalized"] = is_normalized;
    return accessor;
  };
  attributes["POSITION"] = add(bytes_of(positions), 5122, "VEC3", true);
  attributes["NORMAL"] = add(bytes_of(normals), 5120, "VEC3", true);
  attributes["TEXCOORD_0"] = add(bytes_of(uvs), 5123, "VEC2", false);
  document.primitive()["targets"][0]["POSITION"] = add(bytes_of(displacements), 5120, "VEC3", true);
  document.json["accessors"][0]["min"] = {-32768, 0, -1000};
  document.json["accessors"][0]["max"] = {32767, 32767, 1000};
  document.primitive()["indices"] =
      document.add_accessor(document.add_view(bytes_of(sheet.indices)), sheet.indices.size(), 5123, "SCALAR");
  document.json["nodes"][0]["scale"] = {2, 2, 2};
  document.use("KHR_mesh_quantization");
  return document;
}

/// Returns the accessors of the only primitive, by the names of its attributes; that of its target is
/// "target".
Json accessors_of(const Json& json)
{
  const Json& primitive = json["meshes"][0]["primitives"][0];
  Json result;
  for (const auto& [name, accessor] : primitive["attributes"].items())
    result[name] = json["accessors"][accessor.get<std::size_t>()];
  result["target"] = json["accessors"][primitive["targets"][0]["POSITION"].get<std::size_t>()];
  return result;
}

// Reduces a sheet such that vertices get new places. Expects that no column has become one of floats.
void expect_new_places_held(const Document_of_sheet& document, bool are_values_fitted = true)
{
  Simplify_options options;
  options.ratio = 0.3;
  options.placement = Placement::optimal;
  options.are_values_fitted = are_values_fitted;
  const Simplified_soup reduced = simplify_soup(prepare(read(document).soup), options);
  EXPECT_GT(reduced.placed_vertices, 20u);
  const Temporary_folder folder;
  for (const auto& [note, count] : write_mesh(folder / "m.glb", reduced.soup))
    EXPECT_EQ(note.find("floats"), std::string::npos) << note;
  const Triangle_soup again = read_mesh(folder / "m.glb").soup;
  EXPECT_EQ(std::set<Point_3>(again.points.begin(), again.points.end()),
            std::set<Point_3>(reduced.soup.points.begin(), reduced.soup.points.end()));
  EXPECT_EQ(std::set(again.uvs.values.begin(), again.uvs.values.end()),
            std::set(reduced.soup.uvs.values.begin(), reduced.soup.uvs.values.end()));
}

TEST(Gltf_quantised, HasNewPlacesInItsWholeNumbers)
{
  expect_new_places_held(quantised_sheet());
}

TEST(Gltf_quantised, IsReadAsFloatsOfTheSameValues)
{
  const Document_of_sheet document = quantised_sheet();
  std::vector<std::int16_t> positions(4 * s_vertices);
  std::memcpy(positions.data(), document.bytes.data(), 2 * positions.size());
  const Mesh_file file = read(document);
  EXPECT_TRUE(has_remark(file, "KHR_mesh_quantization"));
  EXPECT_EQ(file.soup.points[0].x(), -2);
  for (std::uint32_t i = 1; i < s_vertices; ++i)
    EXPECT_EQ(file.soup.points[i].x(), 2 * double(float(positions[4 * i] / 32767.0)));
  EXPECT_EQ(file.soup.uvs.values[s_vertices - 1],
            (std::array<double, 2>{s_side - 1.0, 1.0 - (s_side - 1.0)}));
}

TEST(Gltf_quantised, IsWrittenInTheNumbersThatItCameIn)
{
  const Document_of_sheet document = quantised_sheet();
  const Mesh_file file = read(document);
  const std::string glb = expect_written_by(file, {"KHR_mesh_quantization"});
  EXPECT_LE(glb.size(), document.glb().size() + 100);
  const Json json = json_of(glb), before = accessors_of(document.json), after = accessors_of(json);
  for (const auto& [name, accessor] : after.items()) {
    for (const char* key : {"componentType", "normalized", "type"})
      EXPECT_EQ(accessor[key], before[name][key]) << name;
    EXPECT_EQ(json["bufferViews"][accessor["bufferView"].get<std::size_t>()].value("byteStride", 4u) % 4, 0u)
        << name;
  }
  EXPECT_EQ(after["POSITION"]["max"], Json({27143, 27143, 991}));
  EXPECT_EQ(read_mesh(glb, Mesh_format::glb, "again").soup.uvs.values, file.soup.uvs.values);
}

TEST(Gltf_quantised, BecomesFloatsInAColumnThatHasANewNumber)
{
  Mesh_file file = read(quantised_sheet());
  file.soup.points[5] = Point_3(0.5, 0.25, 0.125);
  const Temporary_folder folder;
  EXPECT_TRUE(write_mesh(folder / "m.glb", read(quantised_sheet()).soup).empty());
  const Write_notes notes = write_mesh(folder / "m.glb", file.soup);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes.begin()->first.find("attributes held as floats"), 0u);
  EXPECT_EQ(notes.begin()->second, 1u);
  EXPECT_EQ(read_mesh(folder / "m.glb").soup.points, file.soup.points);
  const Json accessors = accessors_of(json_of(read_file(folder / "m.glb")));
  EXPECT_EQ(accessors["POSITION"]["componentType"], 5126);
  EXPECT_FALSE(accessors["POSITION"].contains("normalized"));
  EXPECT_EQ(accessors["NORMAL"]["componentType"], 5120);
  EXPECT_EQ(accessors["TEXCOORD_0"]["componentType"], 5123);
}

// Vertices whose new normals are the same in the file are one vertex there.
TEST(Gltf_quantised, HasNewNormalsAsTheFileCanHoldThem)
{
  const std::array<double, 3> made = {0.6, float(0.001), 0.8}, near = {0.6, float(-0.001), 0.8};
  const auto written = [&](const Document_of_sheet& document) {
    Mesh_file file = read(document);
    Corner_values<3>& normals = file.soup.normals;
    for (std::size_t t = 0; t < 100; ++t)
      normals.of_triangle[t].fill(Index(normals.values.size() + t % 2));
    normals.values.insert(normals.values.end(), {made, near});
    const Temporary_folder folder;
    write_mesh(folder / "m.glb", file.soup);
    return read_file(folder / "m.glb");
  };
  const Json quantised = accessors_of(json_of(written(quantised_sheet())))["NORMAL"];
  EXPECT_EQ(quantised["componentType"], 5120);
  EXPECT_LT(quantised["count"], s_vertices + 30);
  // A file of floats has them as they are.
  const Triangle_soup plain = read_mesh(written(plain_sheet()), Mesh_format::glb, "plain").soup;
  EXPECT_GT(plain.points.size(), s_vertices + 30);
  EXPECT_NE(std::find(plain.normals.values.begin(), plain.normals.values.end(),
                      std::array<double, 3>{float(0.6), float(0.001), float(0.8)}),
            plain.normals.values.end());
}

// What morph targets add turns with the normals, and is cut off where the file has no such numbers.
TEST(Gltf_quantised, HasTurnedTargetsAsTheFileCanHoldThem)
{
  Document_of_sheet document = quantised_sheet();
  std::vector<std::int8_t> added;
  for (std::uint32_t i = 0; i < s_vertices; ++i)
    added.insert(added.end(), {std::int8_t(i == 0 ? 0 : -127), 0, std::int8_t(i == 0 ? 0 : -127), 0});
  const std::size_t view = document.add_view(bytes_of(added));
  document.json["bufferViews"][view]["byteStride"] = 4;
  const std::size_t accessor = document.add_accessor(view, s_vertices, 5120, "VEC3");
  document.json["accessors"][accessor]["normalized"] = true;
  document.primitive()["targets"][0]["NORMAL"] = accessor;
  Mesh_file file = read(document);
  for (std::array<double, 3>& normal : file.soup.normals.values)
    normal = {1, 0, 0};
  const Temporary_folder folder;
  EXPECT_TRUE(write_mesh(folder / "m.glb", file.soup).empty()) << "none of them has become floats";
  const Triangle_soup written = read_mesh(folder / "m.glb").soup;
  const std::vector<Gltf_scene::Column>& target = written.scene->blocks.at(0).targets.at(0);
  const auto normals = std::find_if(target.begin(), target.end(),
                                    [](const Gltf_scene::Column& column) { return column.name == "NORMAL"; });
  ASSERT_NE(normals, target.end());
  for (std::uint32_t i = 0; i < s_vertices; ++i) {
    EXPECT_EQ(component(*normals, i, 0), i == 0 ? 0 : -1); // where it would be -1.4
    EXPECT_EQ(component(*normals, i, 1), 0);
    EXPECT_NEAR(component(*normals, i, 2), i == 0 ? 0 : 0.2, 0.5 / 127 + 1e-3);
  }
}

TEST(Gltf_quantised, NeedsNoExtensionWhereNothingIsQuantisedAnyMore)
{
  Document_of_sheet document = quantised_sheet();
  document.primitive().erase("targets");
  document.primitive()["attributes"].erase("TEXCOORD_0");
  document.primitive()["attributes"].erase("NORMAL");
  Mesh_file file = read(document);
  file.soup.points[5] = Point_3(0.5, 0.25, 0.125);
  expect_written_plain(file);
  // What is kept as it is keeps the extension.
  document.json["meshes"].push_back(document.json["meshes"][0]);
  Mesh_file kept = read(document);
  kept.soup.points[5] = Point_3(0.5, 0.25, 0.125);
  const Temporary_folder folder;
  write_mesh(folder / "kept.glb", kept.soup);
  EXPECT_EQ(json_of(read_file(folder / "kept.glb"))["extensionsRequired"], Json({"KHR_mesh_quantization"}));
}

#ifdef SELVEDGE_HAS_MESHOPTIMIZER
std::string encoded_vertices(const void* rows, std::size_t count, std::size_t stride)
{
  std::string result(meshopt_encodeVertexBufferBound(count, stride), '\0');
  result.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(result.data()), result.size(),
                                           rows, count, stride));
  return result;
}

/// The sheet with all views compressed, over a buffer that is not there.
Document_of_sheet meshopt_sheet(const char* mode_of_indices, bool is_filtered)
{
  const Sheet sheet;
  Document_of_sheet document;
  std::size_t fallback_size = 0;
  const auto add_view = [&](const std::string& encoded, std::size_t count, std::size_t stride,
                            const char* mode, const char* filter) {
    const std::size_t view = document.add_view(encoded);
    Json& json = document.json["bufferViews"][view];
    json["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", json["byteOffset"]},
                                                     {"byteLength", encoded.size()},
                                                     {"byteStride", stride},
                                                     {"count", count},
                                                     {"mode", mode},
                                                     {"filter", filter}};
    json["buffer"] = 1;
    json["byteOffset"] = fallback_size;
    json["byteLength"] = count * stride;
    fallback_size += count * stride;
    return view;
  };
  Json& attributes = document.primitive()["attributes"];
  attributes["POSITION"] =
      document.add_accessor(add_view(encoded_vertices(sheet.positions.data(), s_vertices, 12), s_vertices, 12,
                                     "ATTRIBUTES", "NONE"),
                            s_vertices, 5126, "VEC3");
  if (is_filtered) {
    std::vector<float> four;
    for (std::uint32_t i = 0; i < s_vertices; ++i) { // by turns of up to 10 degrees
      const float angle = std::atan2(0.6f, 0.8f) + std::sin(float(7 * i)) / 6;
      four.insert(four.end(), {std::sin(angle), 0, std::cos(angle), 0});
    }
    std::vector<std::int8_t> rows(4 * s_vertices);
    meshopt_encodeFilterOct(rows.data(), s_vertices, 4, 8, four.data());
    attributes["NORMAL"] = document.add_accessor(
        add_view(encoded_vertices(rows.data(), s_vertices, 4), s_vertices, 4, "ATTRIBUTES", "OCTAHEDRAL"),
        s_vertices, 5120, "VEC3");
    document.json["accessors"].back()["normalized"] = true;
    document.json["bufferViews"].back()["byteStride"] = 4;
    document.use("KHR_mesh_quantization");
  } else {
    attributes["NORMAL"] =
        document.add_accessor(add_view(encoded_vertices(sheet.normals.data(), s_vertices, 12), s_vertices, 12,
                                       "ATTRIBUTES", "NONE"),
                              s_vertices, 5126, "VEC3");
  }
  const std::vector<unsigned> indices(sheet.indices.begin(), sheet.indices.end());
  std::string encoded(10 * indices.size() + 100, '\0');
  auto* const data = reinterpret_cast<unsigned char*>(encoded.data());
  encoded.resize(std::string(mode_of_indices) == "TRIANGLES"
                     ? meshopt_encodeIndexBuffer(data, encoded.size(), indices.data(), indices.size())
                     : meshopt_encodeIndexSequence(data, encoded.size(), indices.data(), indices.size()));
  document.primitive()["indices"] = document.add_accessor(
      add_view(encoded, indices.size(), 2, mode_of_indices, "NONE"), indices.size(), 5123, "SCALAR");
  document.json["buffers"].push_back(
      {{"byteLength", fallback_size}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  document.use("EXT_meshopt_compression");
  return document;
}

TEST(Gltf_meshopt, IsReadAsThePlainFileAndWrittenAsItCame)
{
  const Mesh_file plain = read(plain_sheet());
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    const Mesh_file file = read(meshopt_sheet(mode, false));
    EXPECT_TRUE(has_remark(file, "EXT_meshopt_compression"));
    EXPECT_EQ(file.soup.points, plain.soup.points);
    EXPECT_EQ(file.soup.normals.values, plain.soup.normals.values);
    EXPECT_EQ(triangles_of(file.soup), triangles_of(plain.soup));
    Document_of_sheet without_fallback = meshopt_sheet(mode, false);
    without_fallback.json["buffers"][1].erase("extensions");
    EXPECT_EQ(read(without_fallback).soup.points, plain.soup.points);
    EXPECT_LE(expect_written_by(file, {"EXT_meshopt_compression"}).size(),
              plain_sheet().glb().size() * 3 / 4);
    EXPECT_FALSE(has_remark(file, "requires it"));
    Document_of_sheet optional = meshopt_sheet(mode, false);
    optional.json.erase("extensionsRequired");
    EXPECT_TRUE(has_remark(read(optional), "requires it"));
    expect_written_by(read(optional), {"EXT_meshopt_compression"});
  }
  const Mesh_file filtered = read(meshopt_sheet("INDICES", true));
  EXPECT_EQ(filtered.soup.points, plain.soup.points);
  for (const auto& normal : filtered.soup.normals.values) {
    EXPECT_NEAR(normal[0], 0.6, 0.2);
    EXPECT_NEAR(normal[2], 0.8, 0.2);
  }
  const std::string glb = expect_written_by(filtered, {"EXT_meshopt_compression", "KHR_mesh_quantization"});
  EXPECT_NE(glb.find("OCTAHEDRAL"), std::string::npos);
  expect_levels_written_by(filtered, {"EXT_meshopt_compression", "KHR_mesh_quantization"});
}

TEST(Gltf_meshopt, KeepsTheBytesOfWhatIsKept)
{
  Document_of_sheet document = meshopt_sheet("TRIANGLES", true);
  document.json["meshes"].push_back(document.json["meshes"][0]); // outside the scene
  const Temporary_folder folder;
  write_mesh(folder / "m.glb", read(document).soup);
  const std::string glb = read_file(folder / "m.glb");
  for (const std::size_t view : {0, 1, 2}) {
    const Json before = document.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
    Json after = json_of(glb)["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
    after["byteOffset"] = before["byteOffset"];
    EXPECT_EQ(after, before);
    EXPECT_NE(glb.find(document.bytes.substr(before["byteOffset"], before["byteLength"])), std::string::npos);
  }
}

TEST(Gltf_meshopt, IsRefusedWhereItIsBroken)
{
  const Document_of_sheet document = meshopt_sheet("TRIANGLES", true);
  expect_damage_is_survived(document, 0, document.bytes.size());
  const std::pair<const char*, Json> changes[] = {{"count", 1u << 30},
                                                  {"count", 0},
                                                  {"count", -1},
                                                  {"byteStride", 3},
                                                  {"byteStride", 512},
                                                  {"buffer", 7},
                                                  {"byteLength", 1u << 30},
                                                  {"byteOffset", 1u << 30},
                                                  {"mode", "OTHER"},
                                                  {"filter", "QUATERNION"}};
  for (const auto& [key, value] : changes) {
    Document_of_sheet changed = document;
    changed.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    EXPECT_THROW(read(changed), Input_error) << key << " " << value;
  }
  Document_of_sheet bomb = document;
  bomb.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 1u << 30;
  try {
    read(bomb);
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("more than 256 times its size"), std::string::npos)
        << error.what();
  }
}
#else
TEST(Gltf_meshopt, IsRefusedWithTheNameOfWhatIsMissing)
{
  Document_of_sheet document = plain_sheet();
  document.use("EXT_meshopt_compression");
  try {
    read(document);
    ADD_FAILURE();
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("built without meshoptimizer"), std::string::npos);
  }
}
#endif

#ifdef SELVEDGE_HAS_DRACO
/// The sheet compressed by Draco, without loss, or quantised as exporters do it; with one normal in a box, or
/// with normals as directions.
Document_of_sheet draco_sheet(bool is_edgebreaker, bool is_quantised = false, bool has_directions = false)
{
  const Sheet sheet;
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(int(sheet.indices.size() / 3));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int normal = builder.AddAttribute(has_directions ? draco::GeometryAttribute::NORMAL
                                                         : draco::GeometryAttribute::GENERIC,
                                          3, draco::DT_FLOAT32);
  std::vector<float> normals = sheet.normals;
  for (std::uint32_t v = 0; v < s_vertices && has_directions; ++v) {
    const float x = float(v % s_side), y = float(v / s_side), length = std::hypot(std::cos(x), y / 9, 1.f);
    normals[3 * v] = -std::cos(x) / length;
    normals[3 * v + 1] = y / 9 / length;
    normals[3 * v + 2] = 1 / length;
  }
  for (std::uint32_t t = 0; t < sheet.indices.size() / 3; ++t) {
    const auto at = [&](const std::vector<float>& rows, int k) {
      return &rows[3 * sheet.indices[3 * t + k]];
    };
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(t), at(sheet.positions, 0),
                                      at(sheet.positions, 1), at(sheet.positions, 2));
    builder.SetAttributeValuesForFace(normal, draco::FaceIndex(t), at(normals, 0), at(normals, 1),
                                      at(normals, 2));
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::ExpertEncoder encoder(*mesh);
  encoder.SetEncodingMethod(is_edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                           : draco::MESH_SEQUENTIAL_ENCODING);
  if (is_quantised) {
    encoder.SetAttributeQuantization(position, 14);
    encoder.SetAttributeQuantization(normal, 10);
  }
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());

  Document_of_sheet document;
  Json& primitive = document.primitive();
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", document.add_view({buffer.data(), buffer.size()})},
      {"attributes",
       {{"POSITION", mesh->attribute(position)->unique_id()},
        {"NORMAL", mesh->attribute(normal)->unique_id()}}}};
  primitive["attributes"]["POSITION"] =
      document.add_accessor(nullptr, encoder.num_encoded_points(), 5126, "VEC3");
  primitive["attributes"]["NORMAL"] =
      document.add_accessor(nullptr, encoder.num_encoded_points(), 5126, "VEC3");
  primitive["indices"] = document.add_accessor(nullptr, sheet.indices.size(), 5123, "SCALAR");
  document.use("KHR_draco_mesh_compression");
  // Without the number that the encoder counts: every vertex of the sheet is a point.
  for (int accessor : {0, 1})
    document.json["accessors"][accessor]["count"] = s_vertices;
  return document;
}

constexpr const char* s_draco = "KHR_draco_mesh_compression";

TEST(Gltf_draco, IsWrittenAsItCameBitForBit)
{
  for (const bool is_quantised : {false, true}) {
    const Document_of_sheet document = draco_sheet(true, is_quantised);
    EXPECT_LE(expect_written_by(read(document), {s_draco}).size(),
              document.glb().size() + 120); // the bounds of positions are new
    expect_levels_written_by(read(document), {s_draco});
  }
}

/// Returns how Draco has put the first primitive of a file: 1 stands for edgebreaker, 0 for the order given.
int draco_method(const std::string& glb)
{
  return glb.at(glb.find("DRACO") + 8);
}

TEST(Gltf_draco, HasItsOwnOrderAlsoWhereFansOfFacesMeet)
{
  Mesh_file file = read(draco_sheet(true));
  // Of two squares that touch at a vertex.
  const auto is_of_squares = [&](const Index_triple& triangle) {
    double x = 0, y = 0;
    for (const Index v : triangle) {
      x += file.soup.points[v].x() * 7 / 3;
      y += file.soup.points[v].y() * 7 / 3;
    }
    return (x < 10) == (y < 10);
  };
  std::vector<Index> kept;
  for (std::size_t t = 0; t < file.soup.triangles.size(); ++t)
    if (is_of_squares(file.soup.triangles[t]))
      kept.push_back(Index(t));
  keep_triangles(file.soup, kept);
  const std::size_t used = vertices_used(file.soup);
  const std::string glb = expect_written_by(file, {s_draco});
  const Triangle_soup again = read_mesh(glb, Mesh_format::glb, "again").soup;
  EXPECT_EQ(again.points.size(), used + 1);
  const Json json = json_of(glb);
  const Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(json["accessors"][attributes["POSITION"].get<int>()]["count"], again.points.size());
  EXPECT_EQ(draco_method(glb), 1);

  // In the order of the vertices, none is split.
  file.soup.poses = {{"raised", file.soup.points, 0}};
  const std::string in_order = expect_written_by(file, {s_draco});
  EXPECT_EQ(draco_method(in_order), 0);
  EXPECT_EQ(read_mesh(in_order, Mesh_format::glb, "again").soup.points.size(), used);
}

TEST(Gltf_draco, KeepsVerticesApartThatDifferInNothing)
{
  Mesh_file file = read(draco_sheet(true));
  const std::size_t triangles = file.soup.triangles.size() / 2;
  std::vector<Index> twin(file.soup.points.size());
  for (Index v = 0; v < twin.size(); ++v) {
    twin[v] = Index(file.soup.points.size());
    file.soup.points.push_back(Point_3(file.soup.points[v]));
    file.soup.scene_vertices.push_back(file.soup.scene_vertices[v]);
  }
  for (std::size_t t = triangles; t < file.soup.triangles.size(); ++t)
    for (Index& corner : file.soup.triangles[t])
      corner = twin[corner];
  const std::size_t used = vertices_used(file.soup);
  EXPECT_GT(used, s_vertices);
  const std::string glb = expect_written_by(file, {s_draco});
  EXPECT_EQ(draco_method(glb), 1);
  EXPECT_EQ(read_mesh(glb, Mesh_format::glb, "again").soup.points.size(), used);
}

TEST(Gltf_draco, KeepsPlacesThatItsQuantisationDoesNotHave)
{
  Mesh_file file = read(draco_sheet(true, true));
  file.soup.points[7] = Point_3(0.3f, 0.71f, 0.0123f);
  expect_written_by(file, {s_draco});
  const Temporary_folder folder;
  const Write_notes notes = write_mesh(folder / "m.glb", file.soup);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes.begin()->first.find("attributes that Draco holds as floats"), 0u);
  EXPECT_EQ(notes.begin()->second, 1u);
}

// Draco and whole numbers hold new places, texture coordinates and displacements in as few bytes as old ones.
TEST(Gltf_draco, HasNewPlacesInTheStepsOfItsQuantisation)
{
  expect_new_places_held(draco_sheet(true, true));
}

// What is interpolated is no direction that Draco has, and is not always fitted.
TEST(Gltf_draco, HasNormalsOfNewPlacesInTheDirectionsOfItsQuantisation)
{
  expect_new_places_held(draco_sheet(true, true, true), false);
}

TEST(Gltf_draco, HasNewNormalsInTheBoxOfItsQuantisation)
{
  const auto is_held_as_floats = [](const std::array<double, 3>& normal) {
    Mesh_file file = read(draco_sheet(true, true)); // whose box goes from (0.6, 0, 0.8) to (1.6, 1, 1.8)
    file.soup.normals.values[7] = normal;
    const Temporary_folder folder;
    const Write_notes notes = write_mesh(folder / "m.glb", file.soup);
    double nearest = 1;
    for (const auto& [x, y, z] : read_mesh(folder / "m.glb").soup.normals.values)
      nearest = std::min(nearest, std::hypot(x - normal[0], y - normal[1], z - normal[2]));
    EXPECT_LT(nearest, 1e-3);
    return std::any_of(notes.begin(), notes.end(), [](const auto& note) {
      return note.first.find("attributes that Draco holds as floats") == 0;
    });
  };
  EXPECT_FALSE(is_held_as_floats({0.6, 0.17, 0.8}));
  EXPECT_TRUE(is_held_as_floats({0, 0, 1}));
}

TEST(Gltf_draco, KeepsTheOrderOfAMeshInSeveralPoses)
{
  Mesh_file file = read(draco_sheet(true, true));
  file.soup.poses = {{"raised", file.soup.points, 0}};
  const Triangle_soup again = read_mesh(expect_written_by(file, {s_draco}), Mesh_format::glb, "again").soup;
  EXPECT_EQ(again.points, file.soup.points);
  EXPECT_EQ(again.triangles, file.soup.triangles);
  const Temporary_folder folder;
  const Write_notes notes = write_mesh(folder / "m.glb", file.soup);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes.begin()->first.find("primitives whose vertices Draco holds in order"), 0u);
}

// As older encoders write attributes of one value. What is not a step would be NaN, at which Draco crashes.
TEST(Gltf_draco, IsWrittenWhereTheRangeOfAQuantisedAttributeIsZero)
{
  const auto box = [](float range) {
    const float numbers[] = {0.6f, 0, 0.8f, range}; // all normals are (0.6, 0, 0.8)
    return std::string(reinterpret_cast<const char*>(numbers), sizeof numbers);
  };
  Document_of_sheet document = draco_sheet(true, true);
  const std::size_t place = document.bytes.find(box(1));
  ASSERT_NE(place, std::string::npos);
  document.bytes.replace(place, box(0).size(), box(0));
  const Mesh_file file = read(document);
  for (const auto& value : file.soup.normals.values)
    EXPECT_EQ(value, (std::array<double, 3>{0.6f, 0, 0.8f}));
  expect_written_by(file, {s_draco});
}

TEST(Gltf_draco, IsReadAsThePlainFile)
{
  const Mesh_file plain = read(plain_sheet());
  for (const bool is_edgebreaker : {false, true}) {
    const Mesh_file file = read(draco_sheet(is_edgebreaker));
    EXPECT_TRUE(has_remark(file, "KHR_draco_mesh_compression"));
    EXPECT_EQ(triangles_of(file.soup), triangles_of(plain.soup));
    EXPECT_EQ(file.soup.points.size(), plain.soup.points.size());
    for (const auto& value : file.soup.normals.values)
      EXPECT_EQ(value, plain.soup.normals.values.front());
  }
}

// Draco splits and joins vertices, and some exporters leave the numbers from before.
TEST(Gltf_draco, HasAsManyRowsAsItsDataWhateverItsAccessorsSay)
{
  const Mesh_file plain = read(plain_sheet());
  for (const bool is_edgebreaker : {false, true})
    for (const int accessor : {0, 1, 2})
      for (const int count : {3, 500}) {
        Document_of_sheet document = draco_sheet(is_edgebreaker);
        document.json["accessors"][accessor]["count"] = count;
        const Mesh_file file = read(document);
        EXPECT_EQ(triangles_of(file.soup), triangles_of(plain.soup));
        const Json json = json_of(expect_written_by(file, {s_draco}));
        for (const auto& [name, number] : json["meshes"][0]["primitives"][0]["attributes"].items())
          EXPECT_EQ(json["accessors"][number.get<std::size_t>()]["count"], s_vertices) << name;
      }
  // What is not compressed has the vertices from before.
  Document_of_sheet document = draco_sheet(true);
  document.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"].erase("NORMAL");
  document.json["accessors"][1]["count"] = s_vertices - 1;
  EXPECT_THROW(read(document), Input_error);
}

// Blender joins accessors that are equal, and then compresses each mesh by itself.
TEST(Gltf_draco, IsReadWherePrimitivesShareAccessorsAndNotTheirData)
{
  Document_of_sheet document = draco_sheet(true);
  const Document_of_sheet other = draco_sheet(false); // with its vertices in another order
  Json second = document.primitive(), third = document.primitive();
  const std::size_t view =
      document.add_view(other.bytes.substr(0, other.json["bufferViews"][0]["byteLength"]));
  Json& mesh = document.json["meshes"][0];
  for (Json* const primitive : {&second, &third}) {
    (*primitive)["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = view;
    mesh["primitives"].push_back(*primitive);
  }
  const Mesh_file file = read(document), plain = read(plain_sheet());
  auto expected = triangles_of(plain.soup);
  const auto once = expected;
  for (int i = 0; i < 2; ++i)
    expected.insert(once.begin(), once.end());
  EXPECT_EQ(triangles_of(file.soup), expected);
  const Json primitives = json_of(expect_written_by(file, {s_draco}))["meshes"][0]["primitives"];
  EXPECT_NE(primitives[0]["indices"], primitives[1]["indices"]);
  EXPECT_NE(primitives[0]["attributes"]["POSITION"], primitives[1]["attributes"]["POSITION"]);
}

TEST(Gltf_draco, IsRefusedWhereItIsBroken)
{
  for (const bool is_edgebreaker : {false, true}) {
    const Document_of_sheet document = draco_sheet(is_edgebreaker);
    expect_damage_is_survived(document, 0, std::min<std::size_t>(document.bytes.size(), 400));
    for (const int accessor : {0, 1, 2})
      for (const std::uint64_t count : {std::uint64_t(1) << 30, std::uint64_t(1) << 60}) {
        Document_of_sheet changed = document;
        changed.json["accessors"][accessor]["count"] = count;
        EXPECT_THROW(read(changed), Input_error) << accessor << " " << count;
      }
    const std::pair<const char*, Json> changes[] = {
        {"bufferView", 9}, {"bufferView", -1}, {"bufferView", nullptr}};
    for (const auto& [key, value] : changes) {
      Document_of_sheet changed = document;
      changed.primitive()["extensions"]["KHR_draco_mesh_compression"][key] = value;
      EXPECT_THROW(read(changed), Input_error) << value;
    }
    Document_of_sheet no_attribute = document;
    no_attribute.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 77;
    EXPECT_THROW(read(no_attribute), Input_error);
    Document_of_sheet cut = document;
    cut.json["bufferViews"][0]["byteLength"] = document.bytes.size() / 2;
    EXPECT_THROW(read(cut), Input_error);
  }
}
#else
TEST(Gltf_draco, IsRefusedWithTheNameOfWhatIsMissing)
{
  Document_of_sheet document = plain_sheet();
  document.use("KHR_draco_mesh_compression");
  try {
    read(document);
    ADD_FAILURE();
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("built without Draco"), std::string::npos);
  }
}
#endif

} // namespace
} // namespace selvedge::test
