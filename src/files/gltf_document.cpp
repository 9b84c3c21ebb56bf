// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_document.h"

#include "files/Binary_reader.h"
#include "files/gltf_column_reader.h"
#include "files/gltf_decoding.h"
#include "files/gltf_levels.h"
#include "files/gltf_quantization.h"

#include <selvedge/Error.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

// Reads glTF and GLB up to the transforms of the nodes, and refuses documents that are not valid or not
// supported.

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Matrix = Gltf_scene::Matrix;

constexpr const char* s_embedded_buffer = "glb-buffer";

// The successor of EXT_meshopt_compression; what it packs is encoded in other ways, too.
constexpr const char* s_next_meshopt_extension = "KHR_meshopt_compression";

/// The parts that a file consists of.
struct Chunks
{
  std::string_view json;
  std::optional<std::string_view> embedded; // of a GLB
};

Chunks split(std::string_view contents, const Gltf_document& document)
{
  Binary_reader bytes(contents, false);
  if (bytes.remaining() < 20 || contents.substr(0, 4) != "glTF")
    document.fail("this is no GLB file: it does not begin with glTF; export it again");
  bytes.skip(4);
  if (bytes.take<std::uint32_t>() != 2)
    document.fail("this GLB file is not of version 2; export it as glTF 2.0");
  const std::size_t length = bytes.take<std::uint32_t>();
  if (length > contents.size())
    document.fail("the file ends before its last byte; copy or export it again");
  const auto chunk = [&](std::size_t& at, std::uint32_t kind) {
    if (length - at < 8)
      return std::string_view();
    Binary_reader head(contents.substr(at, 8), false);
    const std::size_t size = head.take<std::uint32_t>();
    if (size > length - at - 8)
      document.fail("a chunk of the file is longer than the file; export it again");
    const bool is_wanted = head.take<std::uint32_t>() == kind;
    const std::string_view body = contents.substr(at + 8, size);
    at += 8 + size;
    return is_wanted ? body : std::string_view();
  };
  std::size_t at = 12;
  if (length < at)
    document.fail("the file says that it is shorter than its head; export it again");
  const std::string_view json = chunk(at, 0x4E4F534A);
  return {json, chunk(at, 0x004E4942)};
}

void parse(std::string_view json, Gltf_document& document)
{
  // Functions that visit the JSON call themselves once per level, so the depth is limited.
  const auto limit_depth = [&document](int depth, Json::parse_event_t, const Json&) {
    if (depth > 100)
      document.fail("its JSON is nested more than 100 levels deep; simplify it");
    return true;
  };
  document.json = Json::parse(json, limit_depth);
  if (!document.json.is_object())
    document.fail("its JSON is not an object; export the file again");
  const Json& asset = member(document.json, "asset");
  if (!asset.is_object() || !asset.value("version", Json()).is_string() ||
      asset["version"].get<std::string>().substr(0, 2) != "2.")
    document.fail("this is not glTF of version 2; export it as glTF 2.0");
}

bool is_understood(const std::string& extension)
{
  return extension == "EXT_meshopt_compression" || extension == "KHR_draco_mesh_compression" ||
         extension == quantization_extension || extension == instancing_extension ||
         extension == levels_extension;
}

void refuse_extensions(const Gltf_document& document)
{
  for (const char* list : {"extensionsRequired", "extensionsUsed"})
    for (const Json& extension : member(document.json, list)) {
      if (!extension.is_string())
        document.fail(std::string(list) + " holds something that is no name; export the file again");
      const std::string name = extension;
      if (const std::string library = missing_decoder(name); !library.empty())
        document.fail("it is compressed with " + name + ", and this program was built without " + library +
                      ", which decodes that; export it without compression");
      if (list == std::string_view("extensionsRequired") && !is_understood(name) &&
          !is_apart_from_meshes(name))
        document.fail("it requires the extension " + name + ", which is not known here; export it without");
    }
}

/// Removes KHR_meshopt_compression where the file has the same data uncompressed, too, and refuses it
/// elsewhere.
void take_uncompressed_views(Gltf_document& document, bool has_embedded_buffer)
{
  Json& json = document.json;
  std::size_t views = 0;
  bool is_all_there = true;
  for (const char* list : {"bufferViews", "buffers"}) {
    if (!member(json, list).is_array() || member(json, list).empty())
      continue;
    Json& parts = json[list];
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool is_named = find_extension(parts[i], s_next_meshopt_extension) != nullptr;
      const bool is_view = list == std::string_view("bufferViews");
      views += is_named && is_view;
      is_all_there &=
          is_view || (i == 0 && has_embedded_buffer) || (parts[i].is_object() && parts[i].contains("uri"));
      remove_extension_of(parts[i], s_next_meshopt_extension);
    }
  }
  const Json& required = member(json, "extensionsRequired");
  if (std::find(required.begin(), required.end(), s_next_meshopt_extension) != required.end() ||
      (views > 0 && !is_all_there))
    document.fail("its buffers are compressed with KHR_meshopt_compression; export it without compression");
  if (views > 0)
    document.remarks["buffer views read from uncompressed data beside KHR_meshopt_compression, which glTF "
                     "output does not have"] += views;
  remove_extension(json, s_next_meshopt_extension);
}

/// What tinygltf may open: the chunk of a GLB, and files beside the document.
struct Buffer_sources
{
  std::string_view embedded;
  const std::filesystem::path* folder; // null when the document is not a file
  std::string missing;                 // the first file that is not there
};

bool buffer_exists(const std::string& name, void* user)
{
  Buffer_sources& sources = *static_cast<Buffer_sources*>(user);
  std::error_code error;
  const bool exists = name == s_embedded_buffer ||
                      (sources.folder && std::filesystem::is_regular_file(*sources.folder / name, error));
  if (!exists && sources.missing.empty())
    sources.missing = name;
  return exists;
}

bool read_buffer(std::vector<unsigned char>* bytes, std::string* message, const std::string& name, void* user)
{
  const Buffer_sources& sources = *static_cast<const Buffer_sources*>(user);
  if (name == s_embedded_buffer) {
    bytes->assign(sources.embedded.begin(), sources.embedded.end());
    return true;
  }
  std::ifstream stream(*sources.folder / name, std::ios::binary);
  bytes->assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  if (stream.bad() || bytes->empty())
    *message = "it is empty or cannot be read";
  return message->empty();
}

/// Returns a copy without extras and extensions, which tinygltf could only get wrong.
Json without_extensions(const Json& value)
{
  if (!value.is_structured())
    return value;
  Json result = value.is_array() ? Json::array() : Json::object();
  for (auto it = value.begin(); it != value.end(); ++it)
    if (value.is_array())
      result.push_back(without_extensions(*it));
    else if (it.key() != "extras" && it.key() != "extensions")
      result[it.key()] = without_extensions(*it);
  return result;
}

void load(const std::optional<std::string_view>& embedded, const std::filesystem::path* folder,
          Gltf_document& document)
{
  Json reduced;
  for (const char* name :
       {"asset", "buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes", "scene"})
    if (document.json.contains(name))
      reduced[name] = without_extensions(document.json[name]);
  prepare_for_decoding(document.json, reduced);
  Buffer_sources sources{embedded.value_or(""), folder, {}};
  const Json& buffers = member(reduced, "buffers");
  if (embedded && buffers.is_array() && !buffers.empty() && buffers[0].is_object() &&
      !buffers[0].contains("uri")) {
    reduced["buffers"][0]["uri"] = s_embedded_buffer;
    // The chunk may be longer, by its padding.
    sources.embedded = embedded->substr(0, buffers[0].value("byteLength", std::size_t(0)));
  }
  const std::string text = reduced.dump();
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({buffer_exists, [](const std::string& name, void*) { return name; }, read_buffer,
                         tinygltf::WriteWholeFile, &sources});
  std::string error, warning;
  const bool is_loaded =
      loader.LoadASCIIFromString(&document.model, &error, &warning, text.data(), unsigned(text.size()), "");
  if (!is_loaded || !error.empty()) {
    if (!sources.missing.empty())
      document.fail("the file with its numbers, " + sources.missing +
                    ", is not beside it; put it there, or export the mesh as GLB, which is one file");
    std::replace(error.begin(), error.end(), '\n', ' ');
    error.erase(error.find_last_not_of(" .") + 1);
    document.fail("not a valid glTF file (" + error + "); export it again");
  }
}

/// Refuses what tinygltf lets pass: lists that do not correspond to those of the document, and invalid
/// transforms.
void check_lists(const Gltf_document& document)
{
  const tinygltf::Model& model = document.model;
  const auto is_whole = [](const Json& list, std::size_t size) {
    return list.is_array() && list.size() == size;
  };
  bool is_in_step = true;
  is_in_step &= is_whole(member(document.json, "meshes"), model.meshes.size());
  is_in_step &= is_whole(member(document.json, "nodes"), model.nodes.size());
  is_in_step &= is_whole(member(document.json, "accessors"), model.accessors.size());
  is_in_step &= is_whole(member(document.json, "bufferViews"), model.bufferViews.size());
  for (std::size_t m = 0; m < model.meshes.size() && is_in_step; ++m) {
    const Json& primitives = member(document.json["meshes"][m], "primitives");
    is_in_step &= is_whole(primitives, model.meshes[m].primitives.size());
    for (std::size_t p = 0; p < model.meshes[m].primitives.size() && is_in_step; ++p)
      is_in_step &= primitives[p].is_object() &&
                    is_whole(member(primitives[p], "targets"), model.meshes[m].primitives[p].targets.size());
  }
  if (!is_in_step)
    document.fail(
        "not a valid glTF file (a list holds something that does not belong there); export it again");
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Node& node = model.nodes[n];
    const Json& json = document.json["nodes"][n];
    const auto has_wrong_size = [&](const char* name, const std::vector<double>& values, std::size_t size) {
      return json.contains(name) &&
             (!node.matrix.empty() && &values != &node.matrix ? false : values.size() != size);
    };
    if (has_wrong_size("matrix", node.matrix, 16) || has_wrong_size("translation", node.translation, 3) ||
        has_wrong_size("rotation", node.rotation, 4) || has_wrong_size("scale", node.scale, 3))
      document.fail("node " + std::to_string(n) + " has a transform of the wrong length; correct it");
    if (!node.matrix.empty() &&
        (node.matrix[3] != 0 || node.matrix[7] != 0 || node.matrix[11] != 0 || node.matrix[15] != 1))
      document.fail("node " + std::to_string(n) +
                    " has a matrix whose last row is not 0 0 0 1; apply the transform to the mesh");
  }
}

/// Computes the global transforms of the nodes of the scene, which must be a forest.
void place_nodes(Gltf_document& document)
{
  const tinygltf::Model& model = document.model;
  const std::size_t size = model.nodes.size();
  document.to_world.resize(size);
  std::vector<int> stack;
  if (model.scenes.empty()) {
    std::vector<char> is_child(size, false);
    for (const tinygltf::Node& node : model.nodes)
      for (const int child : node.children)
        if (child >= 0 && std::size_t(child) < size)
          is_child[child] = true;
    for (std::size_t n = 0; n < size; ++n)
      if (!is_child[n])
        stack.push_back(int(n));
  } else {
    const std::size_t scene = model.defaultScene < 0 ? 0 : std::size_t(model.defaultScene);
    if (scene >= model.scenes.size())
      document.fail("its scene is number " + std::to_string(scene) + ", but there are only " +
                    std::to_string(model.scenes.size()) + "; correct it");
    stack = model.scenes[scene].nodes;
  }
  const auto enter = [&](int n, std::optional<Index> parent) {
    if (n < 0 || std::size_t(n) >= size)
      document.fail("its scene names node " + std::to_string(n) + ", which is not there; correct it");
    if (document.to_world[n])
      document.fail("node " + std::to_string(n) + " stands in the scene twice; give each node one parent");
    document.to_world[n] =
        product(parent ? *document.to_world[*parent] : identity_matrix, local_matrix(model.nodes[n]));
    document.placed_nodes.push_back({Index(n), parent});
  };
  for (const int root : stack)
    enter(root, std::nullopt);
  while (!stack.empty()) {
    const int n = stack.back();
    stack.pop_back();
    for (const int child : model.nodes[n].children) {
      enter(child, Index(n));
      stack.push_back(child);
    }
  }
}

/// Returns the nodes that stand for the instances of a node.
std::vector<Json> instances_of(const Gltf_document& document, std::size_t n)
{
  const std::string place = "the instances of node " + std::to_string(n);
  const tinygltf::Model& model = document.model;
  const Gltf_column_reader reader(document, place);
  std::vector<Json> result;
  std::size_t count = 0;
  for (const auto& [key, number] : instance_attributes(document.json["nodes"][n]).items()) {
    const int accessor = number.is_number_integer() ? number.get<int>() : -1;
    const bool is_there = accessor >= 0 && std::size_t(accessor) < model.accessors.size();
    // The rows of an accessor without a buffer view take no space in the file.
    if (!is_there || model.accessors[accessor].bufferView < 0)
      document.fail(place +
                    " name an accessor that is not there or has no buffer view; export the file again");
    count = count == 0 ? model.accessors[accessor].count : count;
    const Gltf_scene::Column column = reader.read(accessor, key, count);
    const bool is_rotation = key == "ROTATION";
    if (!is_rotation && key != "TRANSLATION" && key != "SCALE")
      continue;
    if (column.components != (is_rotation ? 4 : 3) ||
        (column.component_type != type_float32 && !(is_rotation && column.is_normalized())))
      document.fail(place + " have a " + key +
                    " of another type than the extension allows; export the file again");
    std::string member = key;
    std::transform(member.begin(), member.end(), member.begin(), [](char c) { return char(c - 'A' + 'a'); });
    result.resize(count, Json::object());
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < column.components; ++k)
        result[i][member].push_back(normalised(column, i, k));
  }
  if (count == 0)
    document.fail(place + " have no transforms; export the file again");
  result.resize(count, Json::object());
  return result;
}

/// Reads EXT_mesh_gpu_instancing.
void place_instances(Gltf_document& document)
{
  const tinygltf::Model& model = document.model;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    if (!document.to_world[n] || model.nodes[n].mesh == -1 ||
        instance_attributes(document.json["nodes"][n]).empty())
      continue;
    if (model.nodes[n].skin != -1)
      document.fail("node " + std::to_string(n) + " has a skin and instances; export it with one of the two");
    for (Json& json : instances_of(document, n)) {
      tinygltf::Node node;
      node.translation = json.value("translation", std::vector<double>());
      node.rotation = json.value("rotation", std::vector<double>());
      node.scale = json.value("scale", std::vector<double>());
      if (const Json& weights = member(document.json["nodes"][n], "weights"); !weights.empty())
        json["weights"] = weights;
      const Matrix in_node = local_matrix(node);
      document.instances[n].push_back({std::move(json), in_node, product(*document.to_world[n], in_node)});
    }
  }
}

} // namespace

Matrix local_matrix(const tinygltf::Node& node)
{
  if (!node.matrix.empty())
    return matrix_of([&](std::size_t i) { return node.matrix[i]; });
  Matrix result = identity_matrix;
  if (!node.rotation.empty()) {
    const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    result = {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
               {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
               {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0}}};
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3 && !node.scale.empty(); ++column)
      result[row][column] *= node.scale[column];
    if (!node.translation.empty())
      result[row][3] = node.translation[row];
  }
  return result;
}

Matrix product(const Matrix& a, const Matrix& b)
{
  Matrix result;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      result[row][column] = a[row][0] * b[0][column] + a[row][1] * b[1][column] + a[row][2] * b[2][column];
      if (column == 3)
        result[row][column] += a[row][3];
    }
  return result;
}

const Json& instance_attributes(const Json& node)
{
  static const Json none = Json::object();
  const Json* found = &node;
  for (const char* const name : {"extensions", instancing_extension, "attributes"}) {
    if (!found->is_object() || !found->contains(name))
      return none;
    found = &(*found)[name];
  }
  return found->is_object() ? *found : none;
}

bool is_apart_from_meshes(const std::string& extension)
{
  constexpr std::array<std::string_view, 6> prefixes{"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                     "MSFT_texture_",  "KHR_lights_",  "KHR_xmp"};
  return std::any_of(prefixes.begin(), prefixes.end(), [&](std::string_view prefix) {
    return extension.compare(0, prefix.size(), prefix) == 0;
  });
}

void Gltf_document::fail(const std::string& message) const
{
  throw Input_error(name + ": " + message);
}

Gltf_document read_gltf_document(std::string_view contents, Mesh_format format, const std::string& name,
                                 const std::filesystem::path* folder, std::size_t level)
{
  Gltf_document document;
  document.name = name;
  const Chunks chunks = format == Mesh_format::glb ? split(contents, document) : Chunks{contents, {}};
  parse(chunks.json, document);
  take_uncompressed_views(document, chunks.embedded.has_value());
  refuse_extensions(document);
  choose_level(document, level);
  load(chunks.embedded, folder, document);
  check_lists(document);
  decode_views(document);
  decode_primitives(document);
  place_nodes(document);
  place_instances(document);
  return document;
}

const Gltf_scene::Json& member(const Gltf_scene::Json& object, const char* name)
{
  static const Json none = Json::array();
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

void drop_channels(Json& document, const std::function<bool(const Json& channel)>& is_dropped)
{
  const Json& animations = member(document, "animations");
  if (!animations.is_array() || animations.empty())
    return;
  Json kept = Json::array();
  for (Json animation : animations) {
    Json channels = Json::array();
    const Json& all = animation.is_object() ? member(animation, "channels") : animation;
    for (const Json& channel : all)
      if (!is_dropped(channel))
        channels.push_back(channel);
    if (channels.size() == all.size()) {
      kept.push_back(std::move(animation));
    } else if (!channels.empty()) {
      animation["channels"] = std::move(channels);
      kept.push_back(std::move(animation));
    }
  }
  if (kept.empty())
    document.erase("animations");
  else
    document["animations"] = std::move(kept);
}

} // namespace selvedge::files
