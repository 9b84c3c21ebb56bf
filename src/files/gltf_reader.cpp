// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/columns.h"
#include "files/formats.h"
#include "files/gltf_bind_poses.h"
#include "files/gltf_column_reader.h"
#include "files/gltf_decoding.h"
#include "files/gltf_levels.h"
#include "files/gltf_quantization.h"
#include "files/row_unlike.h"
#include "files/tangents_of_faces.h"

#include "soup/flat_shading.h"
#include "soup/gltf_transforms.h"
#include "soup/selection.h"
#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

// Reads glTF and GLB: all triangles of the scene become one soup in world space. The rest of the document is
// kept in a `Gltf_scene`, so that the reduced triangles can be written back into it.

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Matrix = Gltf_scene::Matrix;
using Column = Gltf_scene::Column;

bool is_mirroring(const Matrix& m)
{
  const auto column = [&](std::size_t i) { return Point_3(m[0][i], m[1][i], m[2][i]); };
  return CGAL::orientation(Point_3(0, 0, 0), column(0), column(1), column(2)) == CGAL::NEGATIVE;
}

class Gltf_reader
{
public:
  Gltf_reader(Gltf_document document, Mesh_format format) : m_document(std::move(document))
  {
    m_file.format = format;
    m_file.notes.remarks = m_document.remarks;
    const Json& extensions = member(json(), "extensionsUsed");
    m_may_be_quantised =
        std::find(extensions.begin(), extensions.end(), quantization_extension) != extensions.end();
  }

  Mesh_file read()
  {
    find_parts();
    fill_soup();
    set_free();
    forget_progression();
    if (soup().triangles.empty())
      fail(what_there_is() + "; export the mesh as triangles");
    m_scene->document = std::move(json());
    m_scene->compact = std::move(m_document.compact);
    m_scene->placed_nodes = std::move(m_document.placed_nodes);
    soup().scene = m_scene;
    return std::move(m_file);
  }

private:
  static constexpr Index s_none = std::numeric_limits<Index>::max();
  static constexpr const char* s_no_triangles =
      "primitives of points or lines, or without positions, kept as they are";

  // Says what a file without triangles in its scene has instead.
  std::string what_there_is()
  {
    if (model().meshes.empty())
      return member(json(), "animations").empty() ? "the file holds no mesh"
                                                  : "the file holds animations and no mesh";
    if (soup().points.empty() && m_file.notes.remarks.count(s_no_triangles) != 0)
      return "the file holds points or lines and no triangles";
    return "the file has no triangles in its scene";
  }

  Triangle_soup& soup() { return m_file.soup; }
  Json& json() { return m_document.json; }
  const tinygltf::Model& model() const { return m_document.model; }
  void remark(const std::string& what, std::size_t count = 1) { m_file.notes.remarks[what] += count; }
  void remark_compact(const std::string& what)
  {
    remark(what);
    ++m_document.compact[what];
  }
  [[noreturn]] void fail(const std::string& message) const { m_document.fail(message); }

  bool is_reducible(const tinygltf::Primitive& primitive) const
  {
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN &&
           primitive.attributes.count("POSITION") != 0;
  }

  using Attribute_accessors = std::map<std::string, int>; // by the name of the attribute

  /// Where a mesh stands in the scene: a node, or an instance of one.
  struct Place
  {
    std::size_t node;
    Matrix in_node, to_world;
    Json* json; // says which mesh it is
  };

  // Whether a transform brings all to one point, as that of a node does which an animation hides.
  static bool hides_all(const Matrix& to_world)
  {
    return std::all_of(to_world.begin(), to_world.end(),
                       [](const auto& row) { return row[0] == 0 && row[1] == 0 && row[2] == 0; });
  }

  // Returns the places of the scene where a mesh can be seen. Where it is hidden, it stays as it is, or
  // becomes what it becomes elsewhere.
  std::vector<Place> places()
  {
    const auto add_unless_hidden = [&](std::vector<Place>& list, Place place) {
      if (model().nodes[place.node].skin == -1 && hides_all(place.to_world))
        return remark("places where a mesh is scaled to nothing, neither reduced nor judged there");
      list.push_back(std::move(place));
    };
    std::vector<Place> result;
    m_scene->instanced_nodes.reserve(m_document.instances.size()); // places point into it
    double rows = 0, bytes = 0;
    for (const tinygltf::Buffer& buffer : model().buffers)
      bytes += double(buffer.data.size());
    for (std::size_t n = 0; n < model().nodes.size(); ++n) {
      if (!m_document.to_world[n] || model().nodes[n].mesh == -1)
        continue;
      Json& node = json()["nodes"][n];
      const auto found = m_document.instances.find(n);
      if (found == m_document.instances.end()) {
        add_unless_hidden(result, {n, identity_matrix, *m_document.to_world[n], &node});
        continue;
      }
      rows += double(found->second.size()) * rows_of(model().meshes[model().nodes[n].mesh]);
      constexpr double always = 1 << 20, most_times = 256;
      if (rows > always && rows > most_times * bytes)
        fail("its instances have more than " + std::to_string(int(most_times)) +
             " times as many vertices and corners as the file has bytes; split it");
      std::vector<Json>& instances = m_scene->instanced_nodes.emplace_back().instances;
      m_scene->instanced_nodes.back().node = Index(n);
      for (const Gltf_document::Instance& instance : found->second) {
        instances.push_back(instance.node);
        instances.back()["mesh"] = node["mesh"];
      }
      for (std::size_t i = 0; i < instances.size(); ++i)
        add_unless_hidden(result, {n, found->second[i].in_node, found->second[i].to_world, &instances[i]});
      remark("instances of EXT_mesh_gpu_instancing", instances.size());
    }
    return result;
  }

  // Returns how many vertices and corners a mesh has.
  double rows_of(const tinygltf::Mesh& mesh) const
  {
    double result = 0;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      for (const int accessor :
           {primitive.indices, position == primitive.attributes.end() ? -1 : position->second})
        if (accessor >= 0 && std::size_t(accessor) < model().accessors.size())
          result += double(model().accessors[accessor].count);
    }
    return result;
  }

  // Gives every node of the scene a mesh of its own, and lists its primitives.
  void find_parts()
  {
    m_is_free_accessor.assign(model().accessors.size(), false);
    std::vector<std::size_t> in_scene(model().meshes.size(), 0);
    std::vector<char> is_taken(model().meshes.size(), false); // nodes outside the scene keep their meshes
    for (std::size_t n = 0; n < model().nodes.size(); ++n) {
      const int mesh = model().nodes[n].mesh;
      if (mesh == -1)
        continue;
      if (mesh < 0 || std::size_t(mesh) >= model().meshes.size())
        fail("node " + std::to_string(n) + " names mesh " + std::to_string(mesh) +
             ", which is not there; correct it");
      is_taken[mesh] |= !m_document.to_world[n];
    }
    find_meshes_alike();
    m_bind_poses = bind_poses(m_document);
    const std::vector<Place> all = places();
    for (const Place& place : all)
      ++in_scene[model().nodes[place.node].mesh];
    for (std::size_t m = 0; m < in_scene.size(); ++m) {
      if (in_scene[m] > 1 || (in_scene[m] == 1 && is_taken[m]))
        remark("meshes that several nodes or instances share");
      if (in_scene[m] == 0) {
        remark("meshes that are not in the scene, kept as they are");
        keep_accessors(m, [](const tinygltf::Primitive&) { return true; });
      } else {
        keep_accessors(m, [this](const tinygltf::Primitive& primitive) { return !is_reducible(primitive); });
        if (is_taken[m])
          keep_accessors(m, [](const tinygltf::Primitive&) { return true; });
      }
    }
    for (const Place& place : all) {
      const Index mesh = Index(model().nodes[place.node].mesh);
      Index own = mesh;
      if (is_taken[mesh]) {
        own = Index(json()["meshes"].size());
        Json copy = json()["meshes"][mesh];
        json()["meshes"].push_back(std::move(copy));
        (*place.json)["mesh"] = own;
      }
      is_taken[mesh] = true;
      add_place(place, mesh, own);
      forget_numberings(mesh, own);
    }
    for (const char* const extension : s_numberings)
      if (!is_in_meshes(extension))
        remove_extension(json(), extension);
    for (const Gltf_scene::Instanced_node& node : m_scene->instanced_nodes)
      json()["nodes"][node.node]["mesh"] = node.instances.front()["mesh"];
  }

  /// Extensions that name the vertices or triangles of a mesh by numbers, or depend on their order.
  static constexpr std::array<const char*, 4> s_numberings = {"CESIUM_primitive_outline", "EXT_mesh_manifold",
                                                              "EXT_mesh_primitive_edge_visibility",
                                                              "FB_ngon_encoding"};

  // Whether a mesh, or a primitive of one, has an extension.
  bool is_in_meshes(const char* extension)
  {
    const auto has = [extension](const Json& part) { return find_extension(part, extension) != nullptr; };
    const Json& meshes = member(json(), "meshes");
    return std::any_of(meshes.begin(), meshes.end(), [&](const Json& mesh) {
      const Json& primitives = member(mesh, "primitives");
      return has(mesh) || std::any_of(primitives.begin(), primitives.end(), has);
    });
  }

  // Drops these extensions where they are of triangles to be reduced, whose vertices get other numbers.
  void forget_numberings(Index mesh, Index own)
  {
    const std::vector<tinygltf::Primitive>& primitives = model().meshes[mesh].primitives;
    bool is_any_reducible = false;
    const auto forget = [this](Json& part) {
      for (const char* const extension : s_numberings)
        if (find_extension(part, extension)) {
          remove_extension_of(part, extension);
          ++m_file.notes.ignored[std::string("numbers of vertices or triangles (") + extension + ")"];
        }
    };
    for (std::size_t p = 0; p < primitives.size(); ++p)
      if (is_reducible(primitives[p])) {
        is_any_reducible = true;
        forget(json()["meshes"][own]["primitives"][p]);
      }
    if (is_any_reducible)
      forget(json()["meshes"][own]);
  }

  // Finds meshes that have the same accessors, as those do that differ only in their materials. Primitives of
  // one material must be of one in both, because lines between materials hold a mesh.
  void find_meshes_alike()
  {
    using Primitive_key =
        std::tuple<int, int, Attribute_accessors, std::vector<Attribute_accessors>, std::size_t>;
    std::map<std::vector<Primitive_key>, Index> first;
    for (const tinygltf::Mesh& mesh : model().meshes) {
      std::map<int, std::size_t> first_of_material;
      std::vector<Primitive_key> key;
      for (const tinygltf::Primitive& primitive : mesh.primitives)
        key.emplace_back(primitive.mode, primitive.indices, primitive.attributes, primitive.targets,
                         first_of_material.emplace(primitive.material, key.size()).first->second);
      m_first_alike.push_back(first.emplace(std::move(key), Index(m_first_alike.size())).first->second);
    }
  }

  template <class Which>
  void keep_accessors(std::size_t mesh, const Which& which)
  {
    for (const tinygltf::Primitive& primitive : model().meshes[mesh].primitives)
      if (which(primitive)) {
        m_kept_accessors.insert(primitive.indices);
        for (const auto& [name, accessor] : primitive.attributes)
          m_kept_accessors.insert(accessor);
        for (const auto& target : primitive.targets)
          for (const auto& [name, accessor] : target)
            m_kept_accessors.insert(accessor);
      }
  }

  void add_place(const Place& place, Index mesh, Index own)
  {
    const tinygltf::Node& node = model().nodes[place.node];
    const std::vector<tinygltf::Primitive>& primitives = model().meshes[mesh].primitives;
    const bool is_skinned = node.skin != -1;
    if (is_skinned)
      remark("skinned meshes, read in their bind pose (their animations can be given as poses)");
    const std::size_t parts =
        std::count_if(primitives.begin(), primitives.end(), [&](const auto& p) { return is_reducible(p); });
    const Matrix& to_world = is_skinned ? m_bind_poses.at(node.skin) : place.to_world;
    std::map<Index, Index> instance_of_block;
    for (Index p = 0; p < primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = primitives[p];
      if (!is_reducible(primitive)) {
        remark(s_no_triangles);
        continue;
      }
      const Index block =
          block_of(mesh, primitive, "mesh " + std::to_string(mesh) + ", primitive " + std::to_string(p));
      const auto [it, is_new] = instance_of_block.emplace(block, Index(m_scene->instances.size()));
      if (is_new)
        m_scene->instances.push_back(
            {block, 0, to_world, is_mirroring(to_world), Index(place.node), place.in_node});
      m_scene->parts.push_back({own, mesh, m_first_alike[mesh], p, it->second, 0, Json::object()});
      m_sources.push_back(&primitive);
      if (!primitive.targets.empty())
        remark("primitives with morph targets, which are kept");
      soup().groups.names.push_back(group_name(place.node, mesh, p, parts));
    }
  }

  std::string group_name(std::size_t n, std::size_t mesh, std::size_t primitive, std::size_t parts)
  {
    std::string name = model().nodes[n].name.empty() ? model().meshes[mesh].name : model().nodes[n].name;
    name = name.empty() ? "node " + std::to_string(n) : name;
    if (parts > 1)
      name += "/" + std::to_string(primitive);
    return as_label(name, m_group_names);
  }

  /// The names that elements have got, and the largest number added to each, or 1.
  using Names = std::map<std::string, std::size_t>;

  // Returns a name that OBJ files can hold and that no other element has.
  static std::string as_label(std::string name, Names& taken)
  {
    for (char& c : name)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\')
        c = '_';
    name.erase(0, name.find_first_not_of(' '));
    name.erase(name.find_last_not_of(' ') + 1);
    if (name.empty())
      name = "_";
    std::size_t& number = taken[name];
    if (number++ == 0)
      return name;
    std::string unique = name + "#" + std::to_string(number);
    while (!taken.emplace(unique, 1).second)
      unique = name + "#" + std::to_string(++number);
    return unique;
  }

  Index block_of(Index mesh, const tinygltf::Primitive& primitive, const std::string& place)
  {
    const auto [it, is_new] = m_block_numbers.emplace(
        std::make_tuple(mesh, primitive.attributes, primitive.targets), Index(m_scene->blocks.size()));
    if (!is_new)
      return it->second;
    Gltf_scene::Block& block = m_scene->blocks.emplace_back();
    const int position = primitive.attributes.at("POSITION");
    if (position < 0 || std::size_t(position) >= model().accessors.size() ||
        model().accessors[position].bufferView < 0)
      fail(place + ": its positions are nowhere in the file; export it again");
    if (model().accessors[position].count >= std::numeric_limits<Index>::max())
      fail(place + ": it has more than 4294967294 vertices; split it");
    block.size = Index(model().accessors[position].count);
    const Column& positions =
        block.attributes.emplace_back(read_plain_column(position, "POSITION", block.size, place));
    if (positions.component_type != type_float32 || positions.components != 3 || positions.row_size != 12)
      fail(place + ": its positions are not three 32-bit floats each; export the file again");
    for (const auto& [name, accessor] : primitive.attributes)
      if (name != "POSITION")
        block.attributes.push_back(read_plain_column(accessor, name, block.size, place));
    for (const auto& target : primitive.targets) {
      block.targets.emplace_back();
      for (const auto& [name, accessor] : target)
        block.targets.back().push_back(read_plain_column(accessor, name, block.size, place));
    }
    return it->second;
  }

  Column read_column(int accessor, const std::string& name, std::size_t count, const std::string& place)
  {
    Column result = Gltf_column_reader(m_document, place).read(accessor, name, count);
    if (const auto found = m_document.compressions.find(accessor); found != m_document.compressions.end())
      result.compression = found->second;
    m_is_free_accessor[accessor] = true;
    if (model().accessors[accessor].sparse.isSparse && !result.is_sparse)
      remark_compact("sparse accessors, from now on written in full");
    return result;
  }

  // Reads a column. Floats take the place of quantised numbers.
  Column read_plain_column(int accessor, const std::string& name, std::size_t count, const std::string& place)
  {
    const Column column = read_column(accessor, name, count, place);
    if (!m_may_be_quantised || !is_quantised(name, column.accessor))
      return column;
    remark("attributes decoded from KHR_mesh_quantization; glTF output has it where it loses nothing");
    return dequantised(column);
  }

  // Whether all that may refer to accessors and buffer views is known here.
  bool is_all_known()
  {
    for (const Json& extension : member(json(), "extensionsUsed")) {
      const std::string name = extension.is_string() ? extension.get<std::string>() : "";
      // What is left of MSFT_lod is of materials.
      if (!is_apart_from_meshes(name) && name != quantization_extension && name != instancing_extension &&
          name != levels_extension)
        return false;
    }
    return true;
  }

  // Drops the lists of a progressive file, which say where the vertices of its own triangles go.
  void forget_progression()
  {
    const auto forget = [this](Json& element) {
      const auto extras = element.find("extras");
      if (extras == element.end() || !extras->is_object() || extras->erase(progressive_extras) == 0)
        return;
      if (extras->empty())
        element.erase("extras");
      m_file.notes.ignored["lists of collapses (selvedge level reads them)"] = 1;
    };
    forget(json());
    if (json().contains("meshes"))
      for (Json& mesh : json()["meshes"])
        for (Json& primitive : mesh["primitives"])
          forget(primitive);
  }

  // Finds the accessors and buffer views that only the triangles of the soup need, and keeps the bytes of all
  // other views.
  void set_free()
  {
    for (const Json& animation : member(json(), "animations"))
      for (const Json& sampler : member(animation, "samplers"))
        for (const char* key : {"input", "output"})
          m_kept_accessors.insert(sampler.value(key, -1));
    for (const Json& node : member(json(), "nodes"))
      for (const Json& accessor : instance_attributes(node))
        m_kept_accessors.insert(accessor.is_number_integer() ? accessor.get<int>() : -1);
    for (const Json& skin : member(json(), "skins"))
      m_kept_accessors.insert(skin.value("inverseBindMatrices", -1));
    const Gltf_column_reader columns(m_document, "the file");
    // What nothing refers to goes, where that is certain: buffers are often left behind, or compressed.
    const bool may_drop = is_all_known();
    std::set<int> freed, kept;
    for (std::size_t i = 0; i < model().accessors.size(); ++i) {
      const tinygltf::Accessor& accessor = model().accessors[i];
      const bool is_free = (m_is_free_accessor[i] || may_drop) && m_kept_accessors.count(int(i)) == 0;
      if (is_free)
        m_scene->free_accessors.push_back(Index(i));
      std::set<int>& views = is_free ? freed : kept;
      views.insert(accessor.bufferView);
      if (accessor.sparse.isSparse)
        views.insert({accessor.sparse.indices.bufferView, accessor.sparse.values.bufferView});
    }
    for (const Json& image : member(json(), "images")) {
      kept.insert(image.value("bufferView", -1));
      if (image.contains("uri") && image["uri"].is_string() &&
          image["uri"].get<std::string>().compare(0, 5, "data:") != 0)
        remark("images in files of their own, whose addresses are kept");
    }
    m_scene->views.resize(model().bufferViews.size());
    m_scene->meshopt_views = std::move(m_document.meshopt_views);
    for (int i = 0; i < int(model().bufferViews.size()); ++i)
      if ((freed.count(i) != 0 || may_drop) && kept.count(i) == 0)
        m_scene->free_views.push_back(Index(i));
      else
        m_scene->views[i] = columns.view(i);
  }

  void fill_soup()
  {
    for (Gltf_scene::Instance& instance : m_scene->instances) {
      const Gltf_scene::Block& block = m_scene->blocks[instance.block];
      if (block.size > std::numeric_limits<Index>::max() - soup().points.size())
        fail("the scene has more than 4294967295 vertices; split it");
      instance.first = Index(soup().points.size());
      for (Index i = 0; i < block.size; ++i) {
        m_poll();
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
    join_tangents();
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
      m_poll();
      if (instance.is_mirrored)
        std::swap(b, c);
      const Index_triple triangle = {instance.first + corners[a], instance.first + corners[b],
                                     instance.first + corners[c]};
      const bool is_repeated =
          triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
      if (is_repeated && primitive.mode != TINYGLTF_MODE_TRIANGLES)
        return; // such triangles only stitch a strip together
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
      remark_compact("strips and fans, from now on lists of triangles");
      for (std::size_t i = 0; i + 2 < size; ++i)
        add(i, i + 1 + i % 2, i + 2 - i % 2);
      break;
    default:
      remark_compact("strips and fans, from now on lists of triangles");
      for (std::size_t i = 0; i + 2 < size; ++i)
        add(i + 1, i + 2, 0);
    }
  }

  std::vector<Index> corners_of(const tinygltf::Primitive& primitive, Gltf_scene::Part& part)
  {
    const Gltf_scene::Block& block = m_scene->blocks[m_scene->instances[part.instance].block];
    std::vector<Index> result;
    if (primitive.indices >= 0) {
      const Column indices = read_column(primitive.indices, "indices",
                                         model().accessors[primitive.indices].count, "an index accessor");
      if (indices.components != 1 || indices.component_type == type_float32 ||
          indices.component_type == type_int8 || indices.component_type == type_int16)
        fail("accessor " + std::to_string(primitive.indices) +
             " does not hold indices; export the file again");
      part.index_type = indices.component_type;
      part.index_json = indices.accessor;
      part.index_place = indices.place;
      const std::size_t count = indices.rows.size() / indices.row_size;
      for (std::size_t i = 0; i < count; ++i) {
        m_poll();
        const double index = component(indices, i, 0);
        if (index >= block.size)
          fail("an index names vertex " + std::to_string(std::uint64_t(index)) + ", but there are only " +
               std::to_string(block.size) + " counted from 0; correct or remove the triangle");
        result.push_back(Index(index));
      }
      return result;
    }
    // Without indices no two triangles share a vertex; vertices that agree in everything are merged.
    remark("primitives without indices, whose vertices are one where they agree in everything");
    std::unordered_map<std::string, Index> first_of;
    for (Index i = 0; i < block.size; ++i) {
      m_poll();
      std::string row;
      const auto append = [&](const std::vector<Column>& columns) {
        for (const Column& column : columns)
          row += column.row(i);
      };
      append(block.attributes);
      for (const std::vector<Column>& target : block.targets)
        append(target);
      result.push_back(first_of.emplace(std::move(row), i).first->second);
    }
    return result;
  }

  // Joins the tangents of blocks in which every face has vertices of its own.
  void join_tangents()
  {
    std::vector<std::size_t> triangles(m_scene->blocks.size(), 0), vertices(m_scene->blocks.size(), 0);
    std::vector<char> is_counted(soup().points.size(), false);
    for (std::size_t t = 0; t < soup().triangles.size(); ++t) {
      m_poll();
      const Gltf_scene::Part& part = m_scene->parts[soup().groups.of_triangle[t]];
      const Index block = m_scene->instances[part.instance].block;
      ++triangles[block];
      for (const Index v : soup().triangles[t])
        vertices[block] += !std::exchange(is_counted[v], true);
    }
    for (std::size_t i = 0; i < m_scene->blocks.size(); ++i)
      if (have_faces_own_vertices(triangles[i], vertices[i]))
        if (const std::size_t joined = join_tangents_of_faces(m_scene->blocks[i]); joined > 0)
          remark("vertices that differ in nothing but their tangents, which get the mean of these", joined);
  }

  void add_materials()
  {
    const Json& materials = member(json(), "materials");
    const auto has_none = [](const tinygltf::Primitive* primitive) { return primitive->material < 0; };
    if (std::all_of(m_sources.begin(), m_sources.end(), has_none))
      return;
    Names taken;
    for (std::size_t i = 0; i < materials.size(); ++i) {
      const std::string name = materials[i].value("name", "");
      soup().materials.names.push_back(
          as_label(name.empty() ? "material " + std::to_string(i) : name, taken));
    }
    if (std::any_of(m_sources.begin(), m_sources.end(), has_none))
      soup().materials.names.emplace_back(); // stands for no material
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

  // Sets the values of one attribute at all corners. Triangles without it refer to a value that stands for
  // none.
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
      for (Index row = 0; row < block.size; ++row) {
        m_poll();
        result.values.push_back(value(instance, *column, row));
      }
    }
    if (result.values.empty())
      return;
    if (std::find(first.begin(), first.end(), s_none) != first.end()) {
      result.missing = Index(result.values.size());
      result.values.push_back(row_unlike(result.values));
    }
    for (std::size_t t = 0; t < soup().triangles.size(); ++t) {
      m_poll();
      const Index instance = m_scene->parts[soup().groups.of_triangle[t]].instance;
      Index_triple& corners = result.of_triangle.emplace_back(soup().triangles[t]);
      for (Index& corner : corners)
        corner = first[instance] == s_none ? *result.missing
                                           : corner - m_scene->instances[instance].first + first[instance];
    }
  }

  void add_uvs()
  {
    set_corner_values(soup().uvs, "TEXCOORD_0",
                      [](const Gltf_scene::Instance&, const Column& column, Index row) {
                        return texture_coordinates(column, row);
                      });
  }

  void add_normals()
  {
    set_corner_values(soup().normals, "NORMAL",
                      [](const Gltf_scene::Instance& instance, const Column& column, Index row) {
                        return world_normal(instance, column, row);
                      });
  }

  // Adds the further attributes that all vertices have in the same form, and colours in any.
  void add_attributes()
  {
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
        first = first ? first : column;
        is_common = column && column->component_type == first->component_type &&
                    column->components == first->components &&
                    column->is_normalized() == first->is_normalized() &&
                    column->row_size == column->components * component_size(column->component_type);
        if (!is_common)
          break;
        attribute.rows.insert(attribute.rows.end(), column->rows.begin(), column->rows.end());
        attribute.is_normalized = column->is_normalized();
      }
      if (!is_common && name == "COLOR_0" && add_colours_of_different_types())
        continue;
      if (!is_common) {
        const bool is_everywhere =
            std::all_of(m_scene->instances.begin(), m_scene->instances.end(),
                        [&](const auto& instance) { return find(m_scene->blocks[instance.block], name); });
        m_scene->only_in_gltf.push_back(name + (is_everywhere ? ", which primitives have in different types"
                                                              : ", which not every vertex has"));
        continue;
      }
      attribute.name = name;
      attribute.type = attribute_type(first->component_type);
      attribute.components = std::uint32_t(first->components);
      if (name == "COLOR_0")
        add_colours(attribute);
      else
        soup().vertex_attributes.push_back(std::move(attribute));
    }
  }

  // Adds colours that primitives have in different types as floats, opaque where they have no alpha. Returns
  // whether all vertices have some.
  bool add_colours_of_different_types()
  {
    const auto is_colour = [](const Column* column) {
      return column && (column->components == 3 || column->components == 4) &&
             (column->component_type == type_float32 || column->is_normalized());
    };
    std::vector<const Column*> columns; // by instance
    for (const Gltf_scene::Instance& instance : m_scene->instances)
      columns.push_back(find(m_scene->blocks[instance.block], "COLOR_0"));
    if (!std::all_of(columns.begin(), columns.end(), is_colour))
      return false;
    Attribute colours{"COLOR_0", Attribute::Type::float32, 3, false, {}};
    for (const Column* const column : columns)
      colours.components = std::max(colours.components, std::uint32_t(column->components));
    for (std::size_t i = 0; i < columns.size(); ++i)
      for (Index row = 0; row < m_scene->blocks[m_scene->instances[i].block].size; ++row) {
        m_poll();
        for (std::size_t k = 0; k < colours.components; ++k)
          append_number(colours.rows,
                        k < columns[i]->components ? float(normalised(*columns[i], row, k)) : 1.f);
      }
    add_colours(colours);
    return true;
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
      if (!member(json(), key).empty())
        names.push_back(key == std::string_view("materials") ? "properties of materials" : key);
  }

  Gltf_document m_document;
  Mesh_file m_file;
  std::shared_ptr<Gltf_scene> m_scene = std::make_shared<Gltf_scene>();
  std::vector<const tinygltf::Primitive*> m_sources; // the primitive of each part
  Cancellation_poll m_poll;
  Names m_group_names;
  std::vector<Index> m_first_alike;   // of each mesh of the file, as in `Gltf_scene::Part`
  std::map<int, Matrix> m_bind_poses; // by skin
  std::map<std::tuple<Index, Attribute_accessors, std::vector<Attribute_accessors>>, Index> m_block_numbers;
  std::vector<char> m_is_free_accessor;
  std::set<int> m_kept_accessors;
  bool m_may_be_quantised = false;
};

} // namespace

Mesh_file read_gltf(std::string_view contents, Mesh_format format, const std::string& name,
                    const std::filesystem::path* folder, std::size_t level)
{
  try {
    return Gltf_reader(read_gltf_document(contents, format, name, folder, level), format).read();
  } catch (const nlohmann::json::exception& error) {
    throw Input_error(name + ": not a valid glTF file (" + error.what() + "); export it again");
  }
}

} // namespace selvedge::files
