// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Binary_reader.h"
#include "files/formats.h"
#include "files/gltf_scene.h"

#include <selvedge/Error.h>
#include <selvedge/mesh/selection.h>

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <unordered_map>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Matrix = Gltf_scene::Matrix;
using Column = Gltf_scene::Column;

constexpr Index s_none = std::numeric_limits<Index>::max();
constexpr const char* s_embedded_buffer = "glb-buffer";

/// What tinygltf may open: the chunk of a GLB, and files beside the document.
struct Buffer_sources
{
  std::string_view embedded;
  const std::filesystem::path* folder; // none when the document is not a file
};

bool buffer_exists(const std::string& name, void* user)
{
  const Buffer_sources& sources = *static_cast<const Buffer_sources*>(user);
  std::error_code error;
  return name == s_embedded_buffer ||
         (sources.folder && std::filesystem::is_regular_file(*sources.folder / name, error));
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

/// A copy without what tinygltf would only have to get wrong.
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

const Json& member(const Json& object, const char* name)
{
  static const Json none = Json::array();
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

/// Its rotation is not normalised; that keeps every entry one formula of the numbers in the file.
Matrix local_matrix(const tinygltf::Node& node)
{
  Matrix result = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  if (!node.matrix.empty()) {
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        result[row][column] = node.matrix[4 * column + row];
    return result;
  }
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

/// See mesh_files.h for the formula.
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

constexpr Matrix s_identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

bool is_mirroring(const Matrix& m)
{
  const auto column = [&](std::size_t i) { return Point_3(m[0][i], m[1][i], m[2][i]); };
  return CGAL::orientation(Point_3(0, 0, 0), column(0), column(1), column(2)) == CGAL::NEGATIVE;
}

/// The normal's direction, by the matrix of cofactors; as it is where that is the identity.
std::array<double, 3> world_normal(const Matrix& m, bool is_mirrored, const std::array<double, 3>& n)
{
  Matrix linear = m;
  for (auto& row : linear)
    row[3] = 0;
  if (linear == s_identity)
    return n;
  std::array<double, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = m[(i + 1) % 3], &b = m[(i + 2) % 3];
    result[i] = (a[1] * b[2] - a[2] * b[1]) * n[0] + (a[2] * b[0] - a[0] * b[2]) * n[1] +
                (a[0] * b[1] - a[1] * b[0]) * n[2];
  }
  const double length = std::sqrt(result[0] * result[0] + result[1] * result[1] + result[2] * result[2]);
  for (double& coordinate : result)
    coordinate = length > 0 ? coordinate / (is_mirrored ? -length : length) : 0;
  return result;
}

class Gltf_reader
{
public:
  Gltf_reader(std::string_view contents, Mesh_format format, const std::string& name,
              const std::filesystem::path* folder)
      : m_contents(contents), m_name(name), m_folder(folder)
  {
    m_file.format = format;
  }

  Mesh_file read()
  {
    split();
    parse();
    refuse_extensions();
    load();
    place_nodes();
    find_parts();
    fill_soup();
    set_free();
    if (soup().triangles.empty())
      fail("the file has no triangles in its scene; export the mesh as triangles");
    soup().scene = m_scene;
    return std::move(m_file);
  }

private:
  Triangle_soup& soup() { return m_file.soup; }
  Json& document() { return m_scene->document; }
  void remark(const std::string& what, std::size_t count = 1) { m_file.notes.remarks[what] += count; }
  [[noreturn]] void fail(const std::string& message) const { throw Input_error(m_name + ": " + message); }

  void split()
  {
    m_json = m_contents;
    if (m_file.format == Mesh_format::gltf)
      return;
    Binary_reader bytes(m_contents, false);
    if (bytes.remaining() < 20 || m_contents.substr(0, 4) != "glTF")
      fail("this is no GLB file: it does not begin with glTF; export it again");
    bytes.skip(4);
    if (bytes.take<std::uint32_t>() != 2)
      fail("this GLB file is not of version 2; export it as glTF 2.0");
    const std::size_t length = bytes.take<std::uint32_t>();
    if (length > m_contents.size())
      fail("the file ends before its last byte; copy or export it again");
    const auto chunk = [&](std::size_t& at, std::uint32_t kind) {
      if (length - at < 8)
        return std::string_view();
      Binary_reader head(m_contents.substr(at, 8), false);
      const std::size_t size = head.take<std::uint32_t>();
      if (size > length - at - 8)
        fail("a chunk of the file is longer than the file; export it again");
      const bool is_wanted = head.take<std::uint32_t>() == kind;
      const std::string_view body = m_contents.substr(at + 8, size);
      at += 8 + size;
      return is_wanted ? body : std::string_view();
    };
    std::size_t at = 12;
    if (length < at)
      fail("the file says that it is shorter than its head; export it again");
    m_json = chunk(at, 0x4E4F534A);
    m_embedded = chunk(at, 0x004E4942);
  }

  void parse()
  {
    // Further down, functions call themselves once per level.
    const auto limit_depth = [this](int depth, Json::parse_event_t, const Json&) {
      if (depth > 100)
        fail("its JSON is nested more than 100 levels deep; simplify it");
      return true;
    };
    m_scene = std::make_shared<Gltf_scene>();
    document() = Json::parse(m_json, limit_depth);
    if (!document().is_object())
      fail("its JSON is not an object; export the file again");
    const Json& asset = member(document(), "asset");
    if (!asset.is_object() || !asset.value("version", Json()).is_string() ||
        asset["version"].get<std::string>().substr(0, 2) != "2.")
      fail("this is not glTF of version 2; export it as glTF 2.0");
  }

  void refuse_extensions()
  {
    const std::map<std::string, std::string> refused = {
        {"KHR_draco_mesh_compression",
         "its meshes are compressed with KHR_draco_mesh_compression; export it without compression"},
        {"EXT_meshopt_compression",
         "its buffers are compressed with EXT_meshopt_compression; export it without compression"},
        {"KHR_meshopt_compression",
         "its buffers are compressed with KHR_meshopt_compression; export it without compression"},
        {"KHR_mesh_quantization",
         "its vertices are quantised with KHR_mesh_quantization; export it without quantisation"},
        {"EXT_mesh_gpu_instancing",
         "it places meshes with EXT_mesh_gpu_instancing; export it with one node for each"}};
    for (const char* list : {"extensionsRequired", "extensionsUsed"})
      for (const Json& extension : member(document(), list)) {
        if (!extension.is_string())
          fail(std::string(list) + " holds something that is no name; export the file again");
        const std::string name = extension;
        if (const auto found = refused.find(name); found != refused.end())
          fail(found->second);
        const auto begins_with = [&](std::string_view prefix) {
          return name.compare(0, prefix.size(), prefix) == 0;
        };
        if (list == std::string_view("extensionsRequired") && !begins_with("KHR_materials_") &&
            !begins_with("KHR_texture_") && !begins_with("EXT_texture_") && !begins_with("MSFT_texture_") &&
            !begins_with("KHR_lights_") && !begins_with("KHR_xmp"))
          fail("it requires the extension " + name + ", which is not known here; export it without");
      }
  }

  void load()
  {
    Json reduced;
    for (const char* name :
         {"asset", "buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes", "scene"})
      if (document().contains(name))
        reduced[name] = without_extensions(document()[name]);
    Buffer_sources sources{m_embedded, m_folder};
    if (const Json& buffers = member(reduced, "buffers");
        m_file.format == Mesh_format::glb && buffers.is_array() && !buffers.empty() &&
        buffers[0].is_object() && !buffers[0].contains("uri")) {
      reduced["buffers"][0]["uri"] = s_embedded_buffer;
      // The chunk may be longer, by its padding.
      sources.embedded = m_embedded.substr(0, buffers[0].value("byteLength", std::size_t(0)));
    }
    const std::string text = reduced.dump();
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({buffer_exists, [](const std::string& name, void*) { return name; }, read_buffer,
                           tinygltf::WriteWholeFile, &sources});
    std::string error, warning;
    const bool is_loaded =
        loader.LoadASCIIFromString(&m_model, &error, &warning, text.data(), unsigned(text.size()), "");
    if (!is_loaded || !error.empty()) {
      std::replace(error.begin(), error.end(), '\n', ' ');
      error.erase(error.find_last_not_of(" .") + 1);
      fail("not a valid glTF file (" + error + "); export it again");
    }
    check_lists();
  }

  // What tinygltf lets pass: lists out of step with the document, and transforms that are none.
  void check_lists()
  {
    const auto is_whole = [](const Json& list, std::size_t size) {
      return list.is_array() && list.size() == size;
    };
    bool is_in_step = true;
    is_in_step &= is_whole(member(document(), "meshes"), m_model.meshes.size());
    is_in_step &= is_whole(member(document(), "nodes"), m_model.nodes.size());
    is_in_step &= is_whole(member(document(), "accessors"), m_model.accessors.size());
    is_in_step &= is_whole(member(document(), "bufferViews"), m_model.bufferViews.size());
    for (std::size_t m = 0; m < m_model.meshes.size() && is_in_step; ++m) {
      const Json& primitives = member(document()["meshes"][m], "primitives");
      is_in_step &= is_whole(primitives, m_model.meshes[m].primitives.size());
      for (std::size_t p = 0; p < m_model.meshes[m].primitives.size() && is_in_step; ++p)
        is_in_step &= primitives[p].is_object() && is_whole(member(primitives[p], "targets"),
                                                            m_model.meshes[m].primitives[p].targets.size());
    }
    if (!is_in_step)
      fail("not a valid glTF file (a list holds something that does not belong there); export it again");
    for (std::size_t n = 0; n < m_model.nodes.size(); ++n) {
      const tinygltf::Node& node = m_model.nodes[n];
      const Json& json = document()["nodes"][n];
      const auto has_size = [&](const char* name, const std::vector<double>& values, std::size_t size) {
        return json.contains(name) &&
               (!node.matrix.empty() && &values != &node.matrix ? false : values.size() != size);
      };
      if (has_size("matrix", node.matrix, 16) || has_size("translation", node.translation, 3) ||
          has_size("rotation", node.rotation, 4) || has_size("scale", node.scale, 3))
        fail("node " + std::to_string(n) + " has a transform of the wrong length; correct it");
      if (!node.matrix.empty() &&
          (node.matrix[3] != 0 || node.matrix[7] != 0 || node.matrix[11] != 0 || node.matrix[15] != 1))
        fail("node " + std::to_string(n) +
             " has a matrix whose last row is not 0 0 0 1; apply the transform to the mesh");
    }
  }

  // Global transforms of the nodes of the scene, which must be a forest.
  void place_nodes()
  {
    const std::size_t size = m_model.nodes.size();
    m_is_in_scene.assign(size, false);
    m_to_world.assign(size, s_identity);
    std::vector<int> stack;
    if (m_model.scenes.empty()) {
      std::vector<char> is_child(size, false);
      for (const tinygltf::Node& node : m_model.nodes)
        for (const int child : node.children)
          if (child >= 0 && std::size_t(child) < size)
            is_child[child] = true;
      for (std::size_t n = 0; n < size; ++n)
        if (!is_child[n])
          stack.push_back(int(n));
    } else {
      const std::size_t scene = m_model.defaultScene < 0 ? 0 : std::size_t(m_model.defaultScene);
      if (scene >= m_model.scenes.size())
        fail("its scene is number " + std::to_string(scene) + ", but there are only " +
             std::to_string(m_model.scenes.size()) + "; correct it");
      stack = m_model.scenes[scene].nodes;
    }
    const auto enter = [&](int n, const Matrix& parent) {
      if (n < 0 || std::size_t(n) >= size)
        fail("its scene names node " + std::to_string(n) + ", which is not there; correct it");
      if (m_is_in_scene[n])
        fail("node " + std::to_string(n) + " stands in the scene twice; give each node one parent");
      m_is_in_scene[n] = true;
      m_to_world[n] = product(parent, local_matrix(m_model.nodes[n]));
    };
    for (const int root : stack)
      enter(root, s_identity);
    while (!stack.empty()) {
      const int n = stack.back();
      stack.pop_back();
      for (const int child : m_model.nodes[n].children) {
        enter(child, m_to_world[n]);
        stack.push_back(child);
      }
    }
  }

  bool is_reducible(const tinygltf::Primitive& primitive) const
  {
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN &&
           primitive.attributes.count("POSITION") != 0;
  }

  // Gives every node of the scene a mesh of its own, and lists its primitives.
  void find_parts()
  {
    m_is_free_accessor.assign(m_model.accessors.size(), false);
    std::vector<std::size_t> in_scene(m_model.meshes.size(), 0);
    std::vector<char> is_taken(m_model.meshes.size(), false); // nodes outside the scene keep their meshes
    for (std::size_t n = 0; n < m_model.nodes.size(); ++n) {
      const int mesh = m_model.nodes[n].mesh;
      if (mesh == -1)
        continue;
      if (mesh < 0 || std::size_t(mesh) >= m_model.meshes.size())
        fail("node " + std::to_string(n) + " names mesh " + std::to_string(mesh) +
             ", which is not there; correct it");
      if (m_is_in_scene[n])
        ++in_scene[mesh];
      else
        is_taken[mesh] = true;
    }
    for (std::size_t m = 0; m < in_scene.size(); ++m) {
      if (in_scene[m] > 1 || (in_scene[m] == 1 && is_taken[m]))
        remark("meshes that several nodes share, from now on each with its own");
      if (in_scene[m] == 0) {
        remark("meshes that are not in the scene, kept as they are");
        keep_accessors(m, [](const tinygltf::Primitive&) { return true; });
      } else {
        keep_accessors(m, [this](const tinygltf::Primitive& primitive) { return !is_reducible(primitive); });
        if (is_taken[m])
          keep_accessors(m, [](const tinygltf::Primitive&) { return true; });
      }
    }
    for (std::size_t n = 0; n < m_model.nodes.size(); ++n)
      if (m_is_in_scene[n] && m_model.nodes[n].mesh != -1) {
        const Index mesh = Index(m_model.nodes[n].mesh);
        Index own = mesh;
        if (is_taken[mesh]) {
          own = Index(document()["meshes"].size());
          Json copy = document()["meshes"][mesh];
          document()["meshes"].push_back(std::move(copy));
          document()["nodes"][n]["mesh"] = own;
        }
        is_taken[mesh] = true;
        add_node(n, mesh, own);
      }
  }

  template <class Which>
  void keep_accessors(std::size_t mesh, const Which& which)
  {
    for (const tinygltf::Primitive& primitive : m_model.meshes[mesh].primitives)
      if (which(primitive)) {
        m_kept_accessors.insert(primitive.indices);
        for (const auto& [name, accessor] : primitive.attributes)
          m_kept_accessors.insert(accessor);
        for (const auto& target : primitive.targets)
          for (const auto& [name, accessor] : target)
            m_kept_accessors.insert(accessor);
      }
  }

  void add_node(std::size_t n, Index mesh, Index own)
  {
    const tinygltf::Node& node = m_model.nodes[n];
    const std::vector<tinygltf::Primitive>& primitives = m_model.meshes[mesh].primitives;
    const bool is_skinned = node.skin != -1;
    if (is_skinned)
      remark("skinned meshes, taken in their bind pose");
    const std::size_t parts =
        std::count_if(primitives.begin(), primitives.end(), [&](const auto& p) { return is_reducible(p); });
    const Matrix& to_world = is_skinned ? s_identity : m_to_world[n];
    std::map<Index, Index> instance_of_block;
    for (Index p = 0; p < primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = primitives[p];
      if (!is_reducible(primitive)) {
        remark("primitives of points or lines, or without positions, kept as they are");
        continue;
      }
      m_place = "mesh " + std::to_string(mesh) + ", primitive " + std::to_string(p);
      const Index block = block_of(mesh, primitive);
      const auto [it, is_new] = instance_of_block.emplace(block, Index(m_scene->instances.size()));
      if (is_new)
        m_scene->instances.push_back({block, 0, to_world, is_mirroring(to_world)});
      m_scene->parts.push_back({own, p, it->second, 0, Json::object()});
      m_sources.push_back(&primitive);
      if (!primitive.targets.empty())
        remark("primitives with morph targets, whose shapes are carried and not guarded");
      soup().groups.names.push_back(group_name(n, mesh, p, parts));
    }
  }

  std::string group_name(std::size_t n, std::size_t mesh, std::size_t primitive, std::size_t parts)
  {
    std::string name = m_model.nodes[n].name.empty() ? m_model.meshes[mesh].name : m_model.nodes[n].name;
    name = name.empty() ? "node " + std::to_string(n) : name;
    if (parts > 1)
      name += "/" + std::to_string(primitive);
    return as_label(name, m_group_names);
  }

  // A name that OBJ files can hold, and that no other has.
  static std::string as_label(std::string name, std::set<std::string>& taken)
  {
    for (char& c : name)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\')
        c = '_';
    name.erase(0, name.find_first_not_of(' '));
    name.erase(name.find_last_not_of(' ') + 1);
    if (name.empty())
      name = "_";
    std::string unique = name;
    for (std::size_t i = 2; !taken.insert(unique).second; ++i)
      unique = name + "#" + std::to_string(i);
    return unique;
  }

  Index block_of(Index mesh, const tinygltf::Primitive& primitive)
  {
    const auto [it, is_new] = m_block_numbers.emplace(
        std::make_tuple(mesh, primitive.attributes, primitive.targets), Index(m_scene->blocks.size()));
    if (!is_new)
      return it->second;
    Gltf_scene::Block& block = m_scene->blocks.emplace_back();
    const int position = primitive.attributes.at("POSITION");
    if (position < 0 || std::size_t(position) >= m_model.accessors.size() ||
        m_model.accessors[position].bufferView < 0)
      fail(m_place + ": its positions are nowhere in the file; export it again");
    if (m_model.accessors[position].count >= std::numeric_limits<Index>::max())
      fail(m_place + ": it has more than 4294967294 vertices; split it");
    block.size = Index(m_model.accessors[position].count);
    block.attributes.push_back(read_column(position, "POSITION", block.size));
    check_position(block.attributes.front());
    for (const auto& [name, accessor] : primitive.attributes)
      if (name != "POSITION")
        block.attributes.push_back(read_column(accessor, name, block.size));
    for (const auto& target : primitive.targets) {
      block.targets.emplace_back();
      for (const auto& [name, accessor] : target)
        block.targets.back().push_back(read_column(accessor, name, block.size));
    }
    return it->second;
  }

  void check_position(const Column& column)
  {
    if (column.component_type != type_float32 || column.components != 3 || column.row_size != 12)
      fail(m_place + ": its positions are not three 32-bit floats each; export it without quantisation");
  }

  std::string_view view(int number)
  {
    if (number < 0 || std::size_t(number) >= m_model.bufferViews.size())
      fail(m_place + ": buffer view " + std::to_string(number) + " is not there; export the file again");
    const tinygltf::BufferView& range = m_model.bufferViews[number];
    if (range.buffer < 0 || std::size_t(range.buffer) >= m_model.buffers.size())
      fail("buffer view " + std::to_string(number) +
           " names a buffer that is not there; export the file again");
    const std::vector<unsigned char>& bytes = m_model.buffers[range.buffer].data;
    if (range.byteOffset > bytes.size() || range.byteLength > bytes.size() - range.byteOffset)
      fail("buffer view " + std::to_string(number) + " ends beyond its buffer; export the file again");
    return {reinterpret_cast<const char*>(bytes.data()) + range.byteOffset, range.byteLength};
  }

  // The rows in a buffer view, one after the other.
  std::string rows(int number, std::size_t offset, std::size_t row_size, std::size_t count,
                   bool may_have_gaps = false)
  {
    const std::string_view bytes = view(number);
    const std::size_t gap = may_have_gaps ? m_model.bufferViews[number].byteStride : 0,
                      stride = gap == 0 ? row_size : gap;
    // No product overflows: the count is at most that of bytes.
    if (count == 0 || count > bytes.size() || offset > bytes.size() || row_size > bytes.size() - offset ||
        (count - 1) * stride > bytes.size() - offset - row_size)
      fail(m_place + ": an accessor has no rows or reaches beyond buffer view " + std::to_string(number) +
           "; export the file again");
    std::string result;
    result.reserve(count * row_size);
    for (std::size_t i = 0; i < count; ++i)
      result.append(bytes, offset + i * stride, row_size);
    return result;
  }

  Column read_column(int number, const std::string& name, std::size_t count)
  {
    if (number < 0 || std::size_t(number) >= m_model.accessors.size())
      fail(m_place + ": " + name + " names accessor " + std::to_string(number) +
           ", which is not there; export the file again");
    const tinygltf::Accessor& accessor = m_model.accessors[number];
    if (accessor.count != count)
      fail(m_place + ": " + name + " has " + std::to_string(accessor.count) + " rows for " +
           std::to_string(count) + " vertices; export the file again");
    Column column;
    column.name = name;
    column.component_type = accessor.componentType;
    const std::size_t size = component_size(accessor.componentType);
    if (size == 0)
      fail(m_place + ": " + name + " is of a type that glTF does not know; export the file again");
    // Columns of matrices begin at multiples of four bytes.
    const auto matrix = [&](std::size_t order) { return order * ((order * size + 3) / 4 * 4); };
    switch (accessor.type) {
    case TINYGLTF_TYPE_MAT2:
      column.components = 4, column.row_size = matrix(2);
      break;
    case TINYGLTF_TYPE_MAT3:
      column.components = 9, column.row_size = matrix(3);
      break;
    case TINYGLTF_TYPE_MAT4:
      column.components = 16, column.row_size = matrix(4);
      break;
    default:
      column.components = accessor.type == TINYGLTF_TYPE_SCALAR ? 1 : std::size_t(accessor.type);
      column.row_size = column.components * size;
    }
    column.accessor = document()["accessors"][number];
    for (const char* key : {"bufferView", "byteOffset", "sparse", "count"})
      column.accessor.erase(key);
    m_is_free_accessor[number] = true;
    if (accessor.bufferView >= 0)
      column.rows = rows(accessor.bufferView, accessor.byteOffset, column.row_size, count, true);
    else
      column.rows.assign(count * column.row_size, '\0');
    if (accessor.sparse.isSparse)
      put_sparse_values(accessor, column, count);
    if (column.component_type == type_float32)
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < column.components; ++k)
          if (!std::isfinite(component(column, i, k)))
            fail(m_place + ": " + name + " of vertex " + std::to_string(i) +
                 " is not finite; remove or repair it");
    return column;
  }

  void put_sparse_values(const tinygltf::Accessor& accessor, Column& column, std::size_t count)
  {
    remark("sparse accessors, from now on written in full");
    const auto& sparse = accessor.sparse;
    Column indices;
    indices.component_type = sparse.indices.componentType;
    indices.row_size = component_size(indices.component_type);
    if (sparse.count < 1 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
        (indices.component_type != type_uint8 && indices.component_type != type_uint16 &&
         indices.component_type != type_uint32))
      fail(m_place + ": the sparse part of " + column.name + " is not valid; export the file again");
    indices.rows = rows(sparse.indices.bufferView, sparse.indices.byteOffset, indices.row_size, sparse.count);
    const std::string values =
        rows(sparse.values.bufferView, sparse.values.byteOffset, column.row_size, sparse.count);
    for (std::size_t i = 0; i < std::size_t(sparse.count); ++i) {
      const double row = component(indices, i, 0);
      if (row >= double(count))
        fail(m_place + ": the sparse part of " + column.name +
             " names a vertex that is not there; export the file again");
      column.rows.replace(std::size_t(row) * column.row_size, column.row_size, values, i * column.row_size,
                          column.row_size);
    }
  }

  // The numbers of accessors and buffer views that only the triangles of the soup need, and the bytes of all
  // others.
  void set_free()
  {
    for (const Json& animation : member(document(), "animations"))
      for (const Json& sampler : member(animation, "samplers"))
        for (const char* key : {"input", "output"})
          m_kept_accessors.insert(sampler.value(key, -1));
    for (const Json& skin : member(document(), "skins"))
      m_kept_accessors.insert(skin.value("inverseBindMatrices", -1));
    m_place = "the file";
    std::set<int> freed, kept;
    for (std::size_t i = 0; i < m_model.accessors.size(); ++i) {
      const tinygltf::Accessor& accessor = m_model.accessors[i];
      const bool is_free = m_is_free_accessor[i] && m_kept_accessors.count(int(i)) == 0;
      if (is_free)
        m_scene->free_accessors.push_back(Index(i));
      std::set<int>& views = is_free ? freed : kept;
      views.insert(accessor.bufferView);
      if (accessor.sparse.isSparse)
        views.insert({accessor.sparse.indices.bufferView, accessor.sparse.values.bufferView});
    }
    for (const Json& image : member(document(), "images")) {
      kept.insert(image.value("bufferView", -1));
      if (image.contains("uri") && image["uri"].is_string() &&
          image["uri"].get<std::string>().compare(0, 5, "data:") != 0)
        remark("images in files of their own, whose addresses are kept");
    }
    m_scene->views.resize(m_model.bufferViews.size());
    for (int i = 0; i < int(m_model.bufferViews.size()); ++i)
      if (freed.count(i) != 0 && kept.count(i) == 0)
        m_scene->free_views.push_back(Index(i));
      else
        m_scene->views[i] = view(i);
  }

  void fill_soup()
  {
    for (Gltf_scene::Instance& instance : m_scene->instances) {
      const Gltf_scene::Block& block = m_scene->blocks[instance.block];
      if (block.size > std::numeric_limits<Index>::max() - soup().points.size())
        fail("the scene has more than 4294967295 vertices; split it");
      instance.first = Index(soup().points.size());
      for (Index i = 0; i < block.size; ++i) {
        const Point_3 point = world_position(instance.to_world, block.attributes.front(), i);
        if (!std::isfinite(point.x()) || !std::isfinite(point.y()) || !std::isfinite(point.z()))
          fail("a vertex has no finite position in the scene; correct the transforms of its node");
        soup().points.push_back(point);
      }
    }
    soup().scene_vertices.resize(soup().points.size());
    std::iota(soup().scene_vertices.begin(), soup().scene_vertices.end(), Index(0));
    for (std::size_t i = 0; i < m_scene->parts.size(); ++i)
      add_triangles(i);
    add_materials();
    add_uvs();
    add_normals();
    add_attributes();
    name_what_only_gltf_holds();
  }

  void add_triangles(std::size_t number)
  {
    Gltf_scene::Part& part = m_scene->parts[number];
    const Gltf_scene::Instance& instance = m_scene->instances[part.instance];
    const tinygltf::Primitive& primitive = *m_sources[number];
    const std::vector<Index> corners = corners_of(primitive, part);
    const std::size_t size = corners.size();
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (instance.is_mirrored)
        std::swap(b, c);
      const Index_triple triangle = {instance.first + corners[a], instance.first + corners[b],
                                     instance.first + corners[c]};
      const bool is_repeated =
          triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
      if (is_repeated && primitive.mode != TINYGLTF_MODE_TRIANGLES)
        return; // they stitch a strip together
      m_file.notes.repeated_corner += is_repeated;
      soup().triangles.push_back(triangle);
      soup().groups.of_triangle.push_back(Index(number));
    };
    switch (primitive.mode) {
    case TINYGLTF_MODE_TRIANGLES:
      if (size % 3 != 0)
        fail("a primitive's corners are not a multiple of three (" + std::to_string(size) +
             "); export the file again");
      for (std::size_t i = 0; i + 2 < size; i += 3)
        add(i, i + 1, i + 2);
      break;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
      remark("strips and fans, from now on lists of triangles");
      for (std::size_t i = 0; i + 2 < size; ++i)
        add(i, i + 1 + i % 2, i + 2 - i % 2);
      break;
    default:
      remark("strips and fans, from now on lists of triangles");
      for (std::size_t i = 0; i + 2 < size; ++i)
        add(i + 1, i + 2, 0);
    }
  }

  std::vector<Index> corners_of(const tinygltf::Primitive& primitive, Gltf_scene::Part& part)
  {
    const Gltf_scene::Block& block = m_scene->blocks[m_scene->instances[part.instance].block];
    std::vector<Index> result;
    if (primitive.indices >= 0) {
      m_place = "an index accessor";
      const Column indices =
          read_column(primitive.indices, "indices", m_model.accessors[primitive.indices].count);
      if (indices.components != 1 || indices.component_type == type_float32 ||
          indices.component_type == type_int8 || indices.component_type == type_int16)
        fail("accessor " + std::to_string(primitive.indices) +
             " does not hold indices; export the file again");
      part.index_type = indices.component_type;
      part.index_json = indices.accessor;
      const std::size_t count = indices.rows.size() / indices.row_size;
      for (std::size_t i = 0; i < count; ++i) {
        const double index = component(indices, i, 0);
        if (index >= block.size)
          fail("an index names vertex " + std::to_string(std::uint64_t(index)) + ", but there are only " +
               std::to_string(block.size) + " counted from 0; correct or remove the triangle");
        result.push_back(Index(index));
      }
      return result;
    }
    // Without indices no two triangles share a vertex; those that agree in everything are one.
    remark("primitives without indices, whose vertices are one where they agree in everything");
    std::unordered_map<std::string, Index> first_of;
    for (Index i = 0; i < block.size; ++i) {
      std::string row;
      const auto append = [&](const std::vector<Column>& columns) {
        for (const Column& column : columns)
          row.append(column.rows, i * column.row_size, column.row_size);
      };
      append(block.attributes);
      for (const std::vector<Column>& target : block.targets)
        append(target);
      result.push_back(first_of.emplace(std::move(row), i).first->second);
    }
    return result;
  }

  void add_materials()
  {
    const Json& materials = member(document(), "materials");
    const auto has_none = [](const tinygltf::Primitive* primitive) { return primitive->material < 0; };
    if (std::all_of(m_sources.begin(), m_sources.end(), has_none))
      return;
    std::set<std::string> taken;
    for (std::size_t i = 0; i < materials.size(); ++i) {
      const std::string name = materials[i].value("name", "");
      soup().materials.names.push_back(
          as_label(name.empty() ? "material " + std::to_string(i) : name, taken));
    }
    if (std::any_of(m_sources.begin(), m_sources.end(), has_none))
      soup().materials.names.emplace_back(); // the name of none
    for (const Index group : soup().groups.of_triangle) {
      const int material = m_sources[group]->material;
      if (material >= int(materials.size()))
        fail("a primitive names material " + std::to_string(material) + ", which is not there; correct it");
      soup().materials.of_triangle.push_back(material < 0 ? Index(materials.size()) : Index(material));
    }
  }

  static const Column* find(const Gltf_scene::Block& block, const std::string& name)
  {
    for (const Column& column : block.attributes)
      if (column.name == name)
        return &column;
    return nullptr;
  }

  static double fraction(const Column& column, std::size_t row, std::size_t place)
  {
    const double value = component(column, row, place);
    switch (column.component_type) {
    case type_uint8:
      return value / 255;
    case type_uint16:
      return value / 65535;
    default:
      return value;
    }
  }

  // Of the vertices that have them; triangles without refer to a value that stands for none.
  template <std::size_t dimension, class Value>
  void set_corner_values(Corner_values<dimension>& result, const std::string& name, const Value& value)
  {
    std::vector<Index> first(m_scene->instances.size(), s_none);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const Gltf_scene::Instance& instance = m_scene->instances[i];
      const Gltf_scene::Block& block = m_scene->blocks[instance.block];
      const Column* const column = find(block, name);
      if (!column || column->components != dimension)
        continue;
      first[i] = Index(result.values.size());
      for (Index row = 0; row < block.size; ++row)
        result.values.push_back(value(instance, *column, row));
    }
    if (result.values.empty())
      return;
    if (std::find(first.begin(), first.end(), s_none) != first.end()) {
      std::array<double, dimension> none = {};
      while (std::find(result.values.begin(), result.values.end(), none) != result.values.end())
        --none[0];
      result.missing = Index(result.values.size());
      result.values.push_back(none);
    }
    for (std::size_t t = 0; t < soup().triangles.size(); ++t) {
      const Index instance = m_scene->parts[soup().groups.of_triangle[t]].instance;
      Index_triple& corners = result.of_triangle.emplace_back(soup().triangles[t]);
      for (Index& corner : corners)
        corner = first[instance] == s_none ? *result.missing
                                           : corner - m_scene->instances[instance].first + first[instance];
    }
  }

  void add_uvs()
  {
    // Elsewhere the second coordinate points up, here it points down.
    set_corner_values(soup().uvs, "TEXCOORD_0",
                      [](const Gltf_scene::Instance&, const Column& column, Index row) {
                        return std::array<double, 2>{fraction(column, row, 0), 1 - fraction(column, row, 1)};
                      });
  }

  void add_normals()
  {
    set_corner_values(soup().normals, "NORMAL",
                      [](const Gltf_scene::Instance& instance, const Column& column, Index row) {
                        return world_normal(instance.to_world, instance.is_mirrored,
                                            {component(column, row, 0), component(column, row, 1),
                                             component(column, row, 2)});
                      });
  }

  // Further attributes that all vertices have, in the same form.
  void add_attributes()
  {
    const std::map<int, Attribute::Type> types = {
        {type_int8, Attribute::Type::int8},     {type_uint8, Attribute::Type::uint8},
        {type_int16, Attribute::Type::int16},   {type_uint16, Attribute::Type::uint16},
        {type_uint32, Attribute::Type::uint32}, {type_float32, Attribute::Type::float32}};
    std::set<std::string> names;
    for (const Gltf_scene::Block& block : m_scene->blocks)
      for (const Column& column : block.attributes)
        if (column.name != "POSITION" && column.name != "NORMAL" && column.name != "TEXCOORD_0")
          names.insert(column.name);
    for (const std::string& name : names) {
      Attribute attribute;
      const Column* first = nullptr;
      bool is_common = true;
      for (const Gltf_scene::Instance& instance : m_scene->instances) {
        const Column* const column = find(m_scene->blocks[instance.block], name);
        const auto is_normalized = [](const Column& c) { return c.accessor.value("normalized", false); };
        first = first ? first : column;
        is_common = column && column->component_type == first->component_type &&
                    column->components == first->components &&
                    is_normalized(*column) == is_normalized(*first) &&
                    column->row_size == column->components * component_size(column->component_type);
        if (!is_common)
          break;
        attribute.rows.insert(attribute.rows.end(), column->rows.begin(), column->rows.end());
        attribute.is_normalized = is_normalized(*column);
      }
      if (!is_common) {
        m_scene->only_in_gltf.push_back(name + ", which not every vertex has");
        continue;
      }
      attribute.name = name;
      attribute.type = types.at(first->component_type);
      attribute.components = std::uint32_t(first->components);
      if (name == "COLOR_0")
        add_colours(attribute);
      else
        soup().vertex_attributes.push_back(std::move(attribute));
    }
  }

  void add_colours(const Attribute& colours)
  {
    const std::size_t row = row_size(colours), size = row / colours.components;
    const std::array<const char*, 4> names = {"red", "green", "blue", "alpha"};
    for (std::size_t k = 0; k < std::min<std::size_t>(4, colours.components); ++k) {
      Attribute colour = {names[k], colours.type, 1, colours.is_normalized, {}};
      for (std::size_t at = k * size; at < colours.rows.size(); at += row)
        colour.rows.insert(colour.rows.end(), colours.rows.begin() + at, colours.rows.begin() + at + size);
      soup().vertex_attributes.push_back(std::move(colour));
    }
  }

  void name_what_only_gltf_holds()
  {
    std::vector<std::string>& names = m_scene->only_in_gltf;
    names.push_back("nodes and their transforms");
    if (std::any_of(m_scene->blocks.begin(), m_scene->blocks.end(),
                    [](const auto& block) { return !block.targets.empty(); }))
      names.push_back("morph targets");
    for (const char* key :
         {"materials", "textures", "images", "skins", "animations", "cameras", "extensions"})
      if (!member(document(), key).empty())
        names.push_back(key == std::string_view("materials") ? "properties of materials" : key);
  }

  std::string_view m_contents, m_json, m_embedded;
  const std::string& m_name;
  const std::filesystem::path* m_folder;
  Mesh_file m_file;
  std::shared_ptr<Gltf_scene> m_scene;
  tinygltf::Model m_model;
  std::vector<char> m_is_in_scene; // by node
  std::vector<Matrix> m_to_world;
  std::vector<const tinygltf::Primitive*> m_sources; // of parts
  std::set<std::string> m_group_names;
  std::map<std::tuple<Index, std::map<std::string, int>, std::vector<std::map<std::string, int>>>, Index>
      m_block_numbers;
  std::vector<char> m_is_free_accessor;
  std::set<int> m_kept_accessors;
  std::string m_place; // for messages
};

} // namespace

Mesh_file read_gltf(std::string_view contents, Mesh_format format, const std::string& name,
                    const std::filesystem::path* folder)
{
  try {
    return Gltf_reader(contents, format, name, folder).read();
  } catch (const nlohmann::json::exception& error) {
    throw Input_error(name + ": not a valid glTF file (" + error.what() + "); export it again");
  }
}

} // namespace selvedge::files
