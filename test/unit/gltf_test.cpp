// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// glTF files: what is carried, bit for bit, and what is refused.

#include "support/Temporary_folder.h"

#include "soup/selection.h"
#include "soup/transforms_of_vertices.h"
#include <selvedge/Error.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/mesh_files.h>
#include <selvedge/rounding.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <sstream>

using namespace selvedge;
using selvedge::test::Temporary_folder;
using Json = nlohmann::ordered_json;

namespace {

constexpr unsigned seed = 20261121;
constexpr int side = 14; // vertices along a sheet

template <class Number>
void put(std::string& bytes, Number number)
{
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

template <class Number>
Number get(const std::string& bytes, std::size_t at)
{
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

struct Document
{
  Json json;
  std::string bytes;
};

std::string to_glb(Document document)
{
  document.json["buffers"] = {{{"byteLength", document.bytes.size()}, {"name", "all"}}};
  std::string json = document.json.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  document.bytes.resize((document.bytes.size() + 3) / 4 * 4, '\0');
  std::string glb = "glTF";
  put(glb, std::uint32_t(2));
  put(glb, std::uint32_t(28 + json.size() + document.bytes.size()));
  put(glb, std::uint32_t(json.size()));
  glb += "JSON" + json;
  put(glb, std::uint32_t(document.bytes.size()));
  return glb + std::string("BIN\0", 4) + document.bytes;
}

Document from_glb(const std::string& glb)
{
  const std::size_t size = get<std::uint32_t>(glb, 12);
  return {Json::parse(glb.substr(20, size)), glb.substr(28 + size, get<std::uint32_t>(glb, 20 + size))};
}

std::string contents(const std::filesystem::path& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t add_view(Document& document, const std::string& bytes, std::size_t stride = 0)
{
  document.bytes.resize((document.bytes.size() + 3) / 4 * 4, '\xee');
  Json view = {{"buffer", 0}, {"byteOffset", document.bytes.size()}, {"byteLength", bytes.size()}};
  if (stride != 0)
    view["byteStride"] = stride;
  document.bytes += bytes;
  document.json["bufferViews"].push_back(view);
  return document.json["bufferViews"].size() - 1;
}

std::size_t add_accessor(Document& document, const std::string& bytes, std::size_t count, int component_type,
                         const char* type, bool is_normalized = false, std::size_t stride = 0)
{
  Json accessor = {{"bufferView", add_view(document, bytes, stride)},
                   {"componentType", component_type},
                   {"count", count},
                   {"type", type}};
  if (is_normalized)
    accessor["normalized"] = true;
  document.json["accessors"].push_back(accessor);
  return document.json["accessors"].size() - 1;
}

/// Rows of any numbers, as a column of an accessor.
template <class Number, class Value>
std::size_t add_rows(Document& document, std::size_t count, std::size_t components, int component_type,
                     const Value& value, bool is_normalized = false)
{
  const std::size_t stride = (components * sizeof(Number) + 3) / 4 * 4;
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < components; ++k)
      put(bytes, Number(value(i, k)));
    bytes.resize((i + 1) * stride, '\xdd');
  }
  const char* const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return add_accessor(document, bytes, count, component_type, types[components - 1], is_normalized,
                      stride == components * sizeof(Number) ? 0 : stride);
}

void set_bounds(Document& document, std::size_t accessor, std::size_t count,
                const std::function<float(std::size_t, std::size_t)>& value)
{
  for (std::size_t k = 0; k < 3; ++k) {
    float low = value(0, k), high = low;
    for (std::size_t i = 0; i < count; ++i) {
      low = std::min(low, value(i, k));
      high = std::max(high, value(i, k));
    }
    document.json["accessors"][accessor]["min"].push_back(low);
    document.json["accessors"][accessor]["max"].push_back(high);
  }
}

/// Two sheets, a wavy one of two materials and a flat one, with everything on them, in four nodes.
Document everything()
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> real(0, 1);
  Document document;
  Json& json = document.json;
  json = {{"asset", {{"version", "2.0"}, {"generator", "hand"}}},
          {"scene", 0},
          {"extras", {{"studio", {1, 2.5, "x"}}}}};
  constexpr std::size_t count = side * side;
  std::vector<std::array<float, 3>> points;
  for (std::size_t i = 0; i < count; ++i) {
    const float u = float(i % side), v = float(i / side);
    points.push_back(
        {u * 0.1f + 0.01f * real(random), v * 0.1f + 0.01f * real(random), 0.01f * real(random)});
  }
  const auto position = [&](std::size_t i, std::size_t k) { return points[i][k]; };
  Json attributes;
  attributes["POSITION"] = add_rows<float>(document, count, 3, 5126, position);
  set_bounds(document, attributes["POSITION"], count, position);
  attributes["NORMAL"] = add_rows<float>(document, count, 3, 5126, [](std::size_t i, std::size_t k) {
    const double a = 0.001 * double(i);
    return k == 0 ? std::sin(a) : k == 1 ? 0 : std::cos(a);
  });
  attributes["TANGENT"] = add_rows<float>(document, count, 4, 5126, [](std::size_t i, std::size_t k) {
    const double a = 0.001 * double(i);
    return k == 0 ? std::cos(a) : k == 1 ? 0 : k == 2 ? -std::sin(a) : 1;
  });
  attributes["TEXCOORD_0"] = add_rows<float>(document, count, 2, 5126, [](std::size_t i, std::size_t k) {
    return (k == 0 ? double(i % side) : double(i / side)) / side + 1e-3;
  });
  attributes["TEXCOORD_1"] = add_rows<std::uint16_t>(
      document, count, 2, 5123, [&](std::size_t, std::size_t) { return random(); }, true);
  attributes["COLOR_0"] = add_rows<std::uint8_t>(
      document, count, 3, 5121, [&](std::size_t, std::size_t) { return random(); }, true);
  attributes["_ID"] = add_rows<float>(document, count, 1, 5126, [](std::size_t i, std::size_t) { return i; });
  const auto indices = [&](int first_row, int last_row, int type) {
    std::string bytes;
    std::size_t size = 0;
    for (int y = first_row; y < last_row; ++y)
      for (int x = 0; x + 1 < side; ++x)
        for (const int corner : {y * side + x, y * side + x + 1, (y + 1) * side + x, (y + 1) * side + x,
                                 y * side + x + 1, (y + 1) * side + x + 1}) {
          if (type == 5125)
            put(bytes, std::uint32_t(corner));
          else if (type == 5123)
            put(bytes, std::uint16_t(corner));
          else
            put(bytes, std::uint8_t(corner));
          ++size;
        }
    return add_accessor(document, bytes, size, type, "SCALAR");
  };
  // A target whose shape stands in sparse rows, as exporters do it.
  std::string rows, values;
  for (const int row : {3, 17, 40}) {
    put(rows, std::uint16_t(row));
    for (int k = 0; k < 3; ++k)
      put(values, 0.25f * float(row + k));
  }
  const std::size_t rows_view = add_view(document, rows), values_view = add_view(document, values);
  json["accessors"].push_back({{"componentType", 5126},
                               {"count", count},
                               {"type", "VEC3"},
                               {"name", "bulge"},
                               {"sparse",
                                {{"count", 3},
                                 {"indices", {{"bufferView", rows_view}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", values_view}}}}},
                               {"min", {0, 0, 0}},
                               {"max", {10, 10.25, 10.5}}});
  const Json targets = {{{"POSITION", json["accessors"].size() - 1}}};
  json["meshes"].push_back({{"name", "coat"}, {"weights", {0.5}}, {"extras", {{"targetNames", {"bulge"}}}}});
  json["meshes"][0]["primitives"] = {{{"attributes", attributes},
                                      {"indices", indices(0, side / 2, 5125)},
                                      {"material", 0},
                                      {"targets", targets},
                                      {"extras", {{"side", "front"}}}},
                                     {{"attributes", attributes},
                                      {"indices", indices(side / 2, side - 1, 5123)},
                                      {"material", 1},
                                      {"targets", targets}}};
  // Another mesh, with a skin.
  Json skinned;
  const auto high = [&](std::size_t i, std::size_t k) { return points[i][k] + (k == 2 ? 0.125f : 0.f); };
  skinned["POSITION"] = add_rows<float>(document, count, 3, 5126, high);
  set_bounds(document, skinned["POSITION"], count, high);
  skinned["_ID"] = attributes["_ID"];
  skinned["JOINTS_0"] = add_rows<std::uint8_t>(
      document, count, 4, 5121, [](std::size_t i, std::size_t k) { return k == 1 ? i % 2 : 0; });
  skinned["WEIGHTS_0"] = add_rows<std::uint8_t>(
      document, count, 4, 5121,
      [](std::size_t i, std::size_t k) {
        return k == 0 ? 255 - int(i % 2 * (i % 200)) : k == 1 ? int(i % 2 * (i % 200)) : 0;
      },
      true);
  json["meshes"].push_back(
      {{"name", "arm"},
       {"primitives", {{{"attributes", skinned}, {"indices", indices(0, side - 1, 5121)}}}}});
  json["meshes"].push_back(
      {{"name", "marks"},
       {"primitives", {{{"attributes", {{"POSITION", attributes["POSITION"]}}}, {"mode", 0}}}}});
  json["materials"] = {{{"name", "denim"},
                        {"pbrMetallicRoughness",
                         {{"baseColorFactor", {0.1, 0.2, 0.3, 1.0}}, {"baseColorTexture", {{"index", 0}}}}},
                        {"extras", {{"id", 7}}}},
                       {{"name", "silk"}, {"doubleSided", true}}};
  const unsigned char pixel[] = {
      0x89, 'P',  'N',  'G',  0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,    13,   'I',  'H',  'D',  'R', 0, 0,
      0,    1,    0,    0,    0,    1,    8,    6,    0,    0,    0,    0x1f, 0x15, 0xc4, 0x89, 0,   0, 0,
      13,   'I',  'D',  'A',  'T',  0x78, 0x9c, 0x63, 0x60, 0x60, 0x60, 0xf8, 0x0f, 0,    1,    4,   1, 0,
      0x5f, 0xe5, 0xc3, 0x4b, 0,    0,    0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
  const std::string png(pixel, pixel + sizeof pixel);
  json["images"] = {{{"bufferView", add_view(document, png)}, {"mimeType", "image/png"}, {"name", "weave"}},
                    {{"uri", "there%20is/none.png"}}};
  json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  std::string matrices, times, moves;
  for (int joint = 0; joint < 2; ++joint)
    for (int i = 0; i < 16; ++i)
      put(matrices, i % 5 == 0 ? 1.f : 0.f);
  for (int i = 0; i < 2; ++i) {
    put(times, float(i));
    for (int k = 0; k < 3; ++k)
      put(moves, float(i + k));
  }
  json["skins"] = {
      {{"inverseBindMatrices", add_accessor(document, matrices, 2, 5126, "MAT4")}, {"joints", {4, 5}}}};
  const std::size_t input = add_accessor(document, times, 2, 5126, "SCALAR");
  json["accessors"][input]["min"] = {0};
  json["accessors"][input]["max"] = {1};
  json["animations"] = {
      {{"samplers", {{{"input", input}, {"output", add_accessor(document, moves, 2, 5126, "VEC3")}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 4}, {"path", "translation"}}}}}}}};
  json["nodes"] = {
      {{"name", "root"},
       {"translation", {10.1, 20.2, 30.3}},
       {"children", {1, 2, 3, 4}},
       {"extras", {{"key", {true, nullptr}}}}},
      {{"name", "left"},
       {"mesh", 0},
       {"rotation", {0.0, 0.6, 0.0, 0.8}},
       {"scale", {1.5, 2.0, 0.7}},
       {"translation", {-3.3, 0.1, 0.2}}},
      {{"name", "right"},
       {"mesh", 0},
       {"matrix", {-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 5.5, 0.25, 0.125, 1.0}}},
      {{"name", "arm"}, {"mesh", 1}, {"skin", 0}, {"translation", {100.0, 0.0, 0.0}}},
      {{"name", "shoulder"}, {"children", {5}}},
      {{"name", "elbow"}},
      {{"name", "marks"}, {"mesh", 2}}};
  json["scenes"] = {{{"nodes", {0, 6}}, {"name", "fitting"}}};
  return document;
}

/// The rows of an accessor, read with other code than the library's.
std::vector<std::string> rows_of(const Document& document, std::size_t number)
{
  const Json& accessor = document.json["accessors"][number];
  const std::map<std::string, std::size_t> components = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const std::map<int, std::size_t> sizes = {{5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
  const std::size_t size = components.at(accessor["type"]) * sizes.at(accessor["componentType"]);
  std::vector<std::string> rows(accessor["count"].get<std::size_t>(), std::string(size, '\0'));
  if (accessor.contains("bufferView")) {
    const Json& view = document.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t stride = view.value("byteStride", size);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = document.bytes.substr(view["byteOffset"].get<std::size_t>() +
                                          accessor.value("byteOffset", std::size_t(0)) + i * stride,
                                      size);
  }
  if (accessor.contains("sparse")) {
    const Json& sparse = accessor["sparse"];
    const auto begin = [&](const char* part) {
      return document.json["bufferViews"][sparse[part]["bufferView"].get<std::size_t>()]["byteOffset"]
          .get<std::size_t>();
    };
    const bool are_bytes = sparse["indices"]["componentType"] == 5121;
    for (std::size_t i = 0; i < sparse["count"]; ++i)
      rows[are_bytes ? get<std::uint8_t>(document.bytes, begin("indices") + i)
                     : get<std::uint16_t>(document.bytes, begin("indices") + 2 * i)] =
          document.bytes.substr(begin("values") + i * size, size);
  }
  return rows;
}

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

void write_bytes(const std::filesystem::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

Simplified_soup reduce(const Triangle_soup& soup, double ratio, Placement placement = Placement::vertices,
                       Instances instances = Instances::apart)
{
  Simplify_options options;
  options.instances = instances;
  options.ratio = ratio;
  options.placement = placement;
  return simplify_soup(prepare(soup), options);
}

/// Waves of size 1 in a node that turns and stretches them, with values that are linear in x and y, the
/// weights of two joints among them. Every other vertex names its joints in the other order.
template <class Weight>
Document waves(int weight_type)
{
  constexpr int size = 24;
  constexpr std::size_t count = size * size;
  const auto x = [](std::size_t i) { return double(i % size) / (size - 1); };
  const auto y = [](std::size_t i) { return double(i / size) / (size - 1); };
  Document document;
  Json& json = document.json;
  const auto position = [&](std::size_t i, std::size_t k) {
    return float(k == 0 ? x(i) : k == 1 ? y(i) : 0.1 * std::sin(9 * x(i)) + 0.1 * std::cos(7 * y(i)));
  };
  Json attributes;
  attributes["POSITION"] = add_rows<float>(document, count, 3, 5126, position);
  set_bounds(document, attributes["POSITION"], count, position);
  attributes["NORMAL"] =
      add_rows<float>(document, count, 3, 5126, [](std::size_t, std::size_t k) { return k == 2; });
  attributes["TANGENT"] = add_rows<float>(document, count, 4, 5126, [&](std::size_t i, std::size_t k) {
    return k == 0 ? std::cos(x(i)) : k == 1 ? std::sin(x(i)) : k == 2 ? 0 : x(i) < 0.5 ? -1 : 1;
  });
  attributes["TEXCOORD_0"] = add_rows<std::uint16_t>(
      document, count, 2, 5123,
      [&](std::size_t i, std::size_t k) { return std::lround(65535 * (k == 0 ? x(i) : y(i))); }, true);
  attributes["JOINTS_0"] = add_rows<std::uint8_t>(
      document, count, 4, 5121, [](std::size_t i, std::size_t k) { return k < 2 ? 3 + (i + k) % 2 : 0; });
  const double whole = weight_type == 5126 ? 1 : double(std::numeric_limits<Weight>::max());
  attributes["WEIGHTS_0"] = add_rows<Weight>(
      document, count, 4, weight_type,
      [&](std::size_t i, std::size_t k) {
        const Weight of_third = Weight(whole * x(i)); // of joint 3
        return k > 1 ? Weight(0) : (i + k) % 2 == 0 ? of_third : Weight(whole - of_third);
      },
      weight_type != 5126);
  const Json targets = {
      {{"POSITION", add_rows<float>(document, count, 3, 5126, [&](std::size_t i, std::size_t k) {
          return k == 0 ? 0.5 * x(i) : k == 1 ? 0 : -0.25 * y(i);
        })}}};
  std::string corners;
  for (int row = 0; row + 1 < size; ++row)
    for (int i = row * size; i + 1 < (row + 1) * size; ++i)
      for (const int corner : {i, i + 1, i + size, i + size, i + 1, i + size + 1})
        put(corners, std::uint16_t(corner));
  const std::size_t indices = add_accessor(document, corners, corners.size() / 2, 5123, "SCALAR");
  json["asset"] = {{"version", "2.0"}};
  json["scene"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  json["nodes"] = {{{"mesh", 0},
                    {"rotation", {0.0, 0.6, 0.0, 0.8}},
                    {"scale", {1.5, 1.5, 1.5}},
                    {"translation", {-3.3, 0.1, 0.2}}}};
  json["meshes"] = {
      {{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"targets", targets}}}}}};
  return document;
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

Mesh_file read_glb(const Document& document)
{
  return read_mesh(to_glb(document), Mesh_format::glb, "test");
}

void expect_refused(const Document& document, const std::string& word)
{
  try {
    read_glb(document);
    FAIL() << "not refused: " << word;
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

/// One triangle at (0,0,0), (1,0,0), (0,1,0) in one node.
Document one_triangle()
{
  Document document;
  document.json = {
      {"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};
  const auto position = [](std::size_t i, std::size_t k) { return float(i == k + 1); };
  const std::size_t accessor = add_rows<float>(document, 3, 3, 5126, position);
  set_bounds(document, accessor, 3, position);
  document.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", accessor}}}}}}}};
  return document;
}

} // namespace

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

TEST(Gltf, BuffersInFilesOfTheirOwnAreRead)
{
  const Temporary_folder folder;
  Document document = everything();
  document.json["buffers"] = {{{"byteLength", document.bytes.size()}, {"uri", "the%20buffer.bin"}}};
  write_bytes(folder / "a.gltf", document.json.dump());
  write_bytes(folder / "the buffer.bin", document.bytes);
  EXPECT_EQ(read_mesh(folder / "a.gltf").soup.points, read_glb(everything()).soup.points);
  std::filesystem::remove(folder / "the buffer.bin");
  EXPECT_THROW(read_mesh(folder / "a.gltf"), Input_error);
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
    // A skinned mesh is where its vertices are, wherever its node is.
    EXPECT_EQ(file.soup.points[i + 2 * rows.size()],
              Point_3(px, py, double(float(get<float>(rows[i], 8) + 0.125f))));
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

/// The waves in three places: a node with two instances, and another node. Rotations are rounded to integers.
Document waves_in_places()
{
  Document document = waves<float>(5126);
  const auto translation = [](std::size_t i, std::size_t k) { return k == 0 ? 3.f * float(i) : 0.25f; };
  Json attributes;
  attributes["TRANSLATION"] = add_rows<float>(document, 2, 3, 5126, translation);
  attributes["ROTATION"] = add_rows<std::int16_t>(
      document, 2, 4, 5122,
      [](std::size_t i, std::size_t k) { return k == 2   ? 19660 * i
                                                : k == 3 ? 32767 - 6553 * i
                                                         : 0; }, true);
  attributes["SCALE"] = add_rows<float>(
      document, 2, 3, 5126, [](std::size_t i, std::size_t k) { return k == 2 && i == 1 ? 0.25 : 1; });
  attributes["_ID"] =
      add_rows<float>(document, 2, 1, 5126, [](std::size_t i, std::size_t) { return float(i); });
  Json& nodes = document.json["nodes"];
  nodes[0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
  nodes.push_back({{"mesh", 0}, {"translation", {0.0, 0.0, 7.0}}});
  document.json["scenes"][0]["nodes"].push_back(1);
  document.json["extensionsUsed"] = document.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return document;
}

TEST(Gltf, InstancesArePlacedLikeChildren)
{
  const Document instanced = waves_in_places();
  Document nodes = instanced;
  Json& list = nodes.json["nodes"];
  list[0].erase("extensions");
  list[0].erase("mesh");
  list[0]["children"] = {2, 3};
  for (const double i : {0., 1.})
    list.push_back({{"mesh", 0},
                    {"translation", {3 * i, 0.25, 0.25}},
                    {"rotation", {0., 0., 19660 * i / 32767, (32767 - 6553 * i) / 32767}},
                    {"scale", {1., 1., i == 0 ? 1. : 0.25}}});
  nodes.json.erase("extensionsRequired");
  const auto sorted = [](Triangle_soup soup) {
    std::sort(soup.points.begin(), soup.points.end());
    return soup.points;
  };
  const Triangle_soup soup = read_glb(instanced).soup;
  EXPECT_EQ(sorted(soup), sorted(read_glb(nodes).soup));
  EXPECT_EQ(soup.groups.names.size(), 3u);
}

TEST(Gltf, InstancesStayInstancesWhereTheyAreShared)
{
  const Temporary_folder folder;
  const Document before = waves_in_places();
  const Triangle_soup soup = read_glb(before).soup;
  for (const Instances instances : {Instances::shared, Instances::apart}) {
    const Simplified_soup reduced = reduce(soup, 0.2, Placement::vertices, instances);
    write_mesh(folder / "a.glb", reduced.soup);
    const Document after = from_glb(contents(folder / "a.glb"));
    const Triangle_soup again = read_mesh(folder / "a.glb").soup;
    EXPECT_EQ(again.triangles.size(), reduced.soup.triangles.size());
    EXPECT_EQ(again.groups.names.size(), 3u);
    if (instances == Instances::shared) {
      EXPECT_EQ(reduced.shared_places, 3u);
      EXPECT_EQ(after.json["nodes"], before.json["nodes"]);
      EXPECT_EQ(after.json["extensionsRequired"], before.json["extensionsRequired"]);
      EXPECT_EQ(after.json["meshes"].size(), 1u);
      for (const auto& [name, accessor] :
           before.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"].items())
        EXPECT_EQ(rows_of(after, accessor), rows_of(before, accessor)) << name;
      EXPECT_LT(4 * after.bytes.size(), before.bytes.size());
    } else { // nodes stand for the instances
      EXPECT_EQ(reduced.shared_places, 0u);
      EXPECT_EQ(after.json["nodes"].size(), before.json["nodes"].size() + 2);
      EXPECT_FALSE(after.json.contains("extensionsRequired"));
      EXPECT_EQ(after.json["meshes"].size(), 3u);
    }
  }
}

TEST(Gltf, InstancesThatDifferInOneTriangleAreTwoMeshes)
{
  const Temporary_folder folder;
  Triangle_soup soup = read_glb(waves_in_places()).soup;
  const Index in_each = Index(soup.triangles.size() / 3);
  std::vector<Index> kept;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (t != 0 && t != in_each + 1 && t != 2 * in_each) // as many are left in every place
      kept.push_back(t);
  keep_triangles(soup, kept);
  write_mesh(folder / "a.glb", soup);
  EXPECT_EQ(from_glb(contents(folder / "a.glb")).json["meshes"].size(), 2u);
  const Triangle_soup again = read_mesh(folder / "a.glb").soup;
  const auto points_of = [](const Triangle_soup& of) {
    std::multiset<std::array<Point_3, 3>> points;
    for (const Index_triple& t : of.triangles)
      points.insert({of.points[t[0]], of.points[t[1]], of.points[t[2]]});
    return points;
  };
  EXPECT_TRUE(points_of(again) == points_of(soup));
}

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
              2u);
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

TEST(Gltf, PrimitivesThatAreGoneLeaveAValidFile)
{
  const Temporary_folder folder;
  const Mesh_file file = read_glb(everything());
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

TEST(Gltf, NewFileFromAnotherFormat)
{
  const Temporary_folder folder;
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nvt 0 0\nvt 1 0\nvt 0.25 1\nvt 0.5 0.75\nvn 0 0 1\n"
      "g body\nusemtl denim\nf 1/1/1 2/2/1 3/3/1\nusemtl silk\nf 3/4/1 2/2/1 4/1/1\n"
      "g sleeve\nf 1 4 2\n";
  const Mesh_file file = read_mesh(obj, Mesh_format::obj, "test");
  EXPECT_TRUE(needs_float32(file.soup, Mesh_format::glb));
  write_mesh(folder / "a.glb", file.soup);
  const Mesh_file again = read_mesh(folder / "a.glb");
  ASSERT_EQ(again.soup.triangles.size(), 3u);
  EXPECT_EQ(again.soup.groups.names, (std::vector<std::string>{"body/0", "body/1", "sleeve"}));
  EXPECT_EQ(again.soup.materials.names, (std::vector<std::string>{"denim", "silk"}));
  for (std::size_t t = 0; t < 3; ++t) {
    EXPECT_EQ(again.soup.materials.names[again.soup.materials.of_triangle[t]],
              file.soup.materials.names[file.soup.materials.of_triangle[t]]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(again.soup.points[again.soup.triangles[t][k]], file.soup.points[file.soup.triangles[t][k]]);
      if (t < 2) {
        EXPECT_EQ(again.soup.uvs.values[again.soup.uvs.of_triangle[t][k]],
                  file.soup.uvs.values[file.soup.uvs.of_triangle[t][k]]);
        EXPECT_EQ(again.soup.normals.values[again.soup.normals.of_triangle[t][k]],
                  (std::array<double, 3>{0, 0, 1}));
      } else {
        EXPECT_EQ(again.soup.uvs.of_triangle[t][k], again.soup.uvs.missing);
      }
    }
  }
  Triangle_soup fine = file.soup;
  fine.points[0] = Point_3(0.1, 0, 0);
  EXPECT_THROW(write_mesh(folder / "b.glb", fine), Argument_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.glb"));
}

TEST(Gltf, AMeshWithoutTrianglesIsRefused)
{
  const Temporary_folder folder;
  EXPECT_THROW(write_mesh(folder / "a.glb", Triangle_soup()), Argument_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
}

TEST(Gltf, NewFileSplitsVerticesOnlyWhereCornersDiffer)
{
  // Some exporters write texture coordinates for every corner, the same ones again and again.
  const Temporary_folder folder;
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nvt 0 0\nvt 1 0\nvt 0 1\nvt 0 1\nvt 1 0\nvt 1 1\nvt 0.5 0.5\n";
  write_mesh(folder / "a.glb",
             read_mesh(obj + "f 1/1 2/2 3/3\nf 3/4 2/5 4/6\n", Mesh_format::obj, "test").soup);
  EXPECT_EQ(read_mesh(folder / "a.glb").soup.points.size(), 4u);
  write_mesh(folder / "a.glb",
             read_mesh(obj + "f 1/1 2/2 3/3\nf 3/7 2/5 4/6\n", Mesh_format::obj, "test").soup);
  EXPECT_EQ(read_mesh(folder / "a.glb").soup.points.size(), 5u);
}

TEST(Gltf, OtherFormatsHoldWorldPositions)
{
  const Temporary_folder folder;
  const Mesh_file file = read_glb(everything());
  for (const char* name : {"a.obj", "a.ply"}) {
    write_mesh(folder / name, file.soup);
    const Mesh_file again = read_mesh(folder / name);
    EXPECT_EQ(again.soup.points, file.soup.points) << name;
    EXPECT_EQ(again.soup.triangles, file.soup.triangles) << name;
    EXPECT_FALSE(again.soup.uvs.empty()) << name;
    const std::vector<std::string> lost = not_carried(file.soup, mesh_format(name));
    for (const char* what : {"skins", "morph targets", "animations", "images", "nodes and their transforms"})
      EXPECT_EQ(std::count(lost.begin(), lost.end(), what), 1) << what;
  }
}

TEST(Gltf, RefusesWhatItCannotRead)
{
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    Document document = one_triangle();
    document.json[list] = {"KHR_meshopt_compression"};
    expect_refused(document, "KHR_meshopt_compression");
  }
  Document unknown = one_triangle();
  unknown.json["extensionsUsed"] = {"ACME_unknown"};
  EXPECT_NO_THROW(read_glb(unknown));
  unknown.json["extensionsRequired"] = {"KHR_texture_transform"};
  EXPECT_NO_THROW(read_glb(unknown));
  unknown.json["extensionsRequired"] = {"ACME_unknown"};
  expect_refused(unknown, "ACME_unknown");
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
