// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_GLTF_DOCUMENT_H
#define SELVEDGE_TEST_SUPPORT_GLTF_DOCUMENT_H

// glTF documents in the making, and what tests ask of those that were written.

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace selvedge::test {

using Json = nlohmann::ordered_json;

inline constexpr unsigned seed = 20261121;
inline constexpr int side = 14; // vertices along a sheet

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

inline std::string to_glb(Document document)
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

inline Document from_glb(const std::string& glb)
{
  const std::size_t size = get<std::uint32_t>(glb, 12);
  return {Json::parse(glb.substr(20, size)), glb.substr(28 + size, get<std::uint32_t>(glb, 20 + size))};
}

inline std::string contents(const std::filesystem::path& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline std::size_t add_view(Document& document, const std::string& bytes, std::size_t stride = 0)
{
  document.bytes.resize((document.bytes.size() + 3) / 4 * 4, '\xee');
  Json view = {{"buffer", 0}, {"byteOffset", document.bytes.size()}, {"byteLength", bytes.size()}};
  if (stride != 0)
    view["byteStride"] = stride;
  document.bytes += bytes;
  document.json["bufferViews"].push_back(view);
  return document.json["bufferViews"].size() - 1;
}

inline std::size_t add_accessor(Document& document, const std::string& bytes, std::size_t count,
                                int component_type, const char* type, bool is_normalized = false,
                                std::size_t stride = 0)
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

inline void set_bounds(Document& document, std::size_t accessor, std::size_t count,
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
inline Document everything()
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
inline std::vector<std::string> rows_of(const Document& document, std::size_t number)
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

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

inline Simplified_soup reduce(const Triangle_soup& soup, double ratio,
                              Placement placement = Placement::vertices,
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

inline Mesh_file read_glb(const Document& document)
{
  return read_mesh(to_glb(document), Mesh_format::glb, "test");
}

inline void expect_refused(const Document& document, const std::string& word)
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
inline Document one_triangle()
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

/// The waves in three places: a node with two instances, and another node. Rotations are rounded to integers.
inline Document waves_in_places()
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

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_GLTF_DOCUMENT_H
