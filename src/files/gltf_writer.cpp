// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Gltf_output.h"
#include "files/Local_normals.h"
#include "files/formats.h"
#include "files/gltf_decoding.h"
#include "files/gltf_encoding.h"
#include "files/gltf_nodes.h"
#include "files/gltf_quantization.h"
#include "files/united_levels.h"
#include "soup/Gltf_scene.h"
#include "soup/flat_shading.h"
#include "soup/gltf_transforms.h"
#include "soup/poles.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Column = Gltf_scene::Column;

/// Puts the meshes of a reduced soup into the glTF document of its scene: over those of the file or, of a
/// further level of detail, behind all that are there.
class Gltf_writer
{
public:
  /// The scene may hold normals though the soup has none, if it was made for this soup. `may_reorder` says
  /// whether vertices go into the order in which triangles come to them, and `coarsest`, for every vertex of
  /// the scene, what the last level is that has it.
  Gltf_writer(const Triangle_soup& soup, bool is_scene_made, bool is_further_level, bool may_reorder,
              const std::vector<Index>& coarsest, Gltf_output& output, Write_notes& notes)
      : m_is_scene_made(is_scene_made), m_may_reorder(may_reorder), m_soup(soup), m_scene(*soup.scene),
        m_normals(soup.normals), m_coarsest(coarsest), m_output(output), m_notes(notes),
        m_local_normals(*soup.scene)
  {
    quantise_new_normals();
    m_split = vertices_by_normal(soup, m_normals);
    if (!is_further_level)
      return;
    m_first_mesh = Index(meshes().size());
    for (const Json& mesh : m_scene.document["meshes"])
      meshes().push_back(mesh);
  }

  Gltf_level put()
  {
    find_copies_alike();
    put_vertices();
    put_triangles();
    Gltf_level level = {m_soup.triangles.size(), {}};
    for (const std::optional<Index>& mesh : meshes_left())
      level.meshes.push_back(mesh ? std::optional<Index>(m_first_mesh + *mesh) : std::nullopt);
    return level;
  }

private:
  Json& meshes() { return m_output.document["meshes"]; }

  const Gltf_scene::Block& block(const Gltf_scene::Instance& instance) const
  {
    return m_scene.blocks[instance.block];
  }

  // Whether a vertex does not lie where the file has it.
  bool has_moved(Index vertex) const
  {
    const Index scene_vertex = m_soup.scene_vertices[vertex];
    const Gltf_scene::Instance& own = m_scene.instances[m_scene.instance_of(scene_vertex)];
    return world_position(own.to_world, block(own).attributes.front(), scene_vertex - own.first) !=
           m_soup.points[vertex];
  }

  // Returns the bytes of a vertex's position in its node: those that the file has for it or, when it has
  // moved, those of another vertex under the same transform that lies where this one lies now, or else
  // others that stand for just this point.
  std::string local_position_of(Index vertex)
  {
    const Index scene_vertex = m_soup.scene_vertices[vertex];
    const Gltf_scene::Instance& own = m_scene.instances[m_scene.instance_of(scene_vertex)];
    const Point_3& point = m_soup.points[vertex];
    const auto position = [&](const Gltf_scene::Instance& instance, Index row) {
      return std::string_view(block(instance).attributes.front().rows).substr(std::size_t(row) * 12, 12);
    };
    if (!has_moved(vertex))
      return std::string(position(own, scene_vertex - own.first));
    if (!m_positions) {
      m_positions.emplace();
      for (const Gltf_scene::Instance& instance : m_scene.instances)
        for (Index i = 0; i < block(instance).size; ++i) {
          const Point_3 p = world_position(instance.to_world, block(instance).attributes.front(), i);
          m_positions->emplace(std::make_tuple(instance.to_world, p.x(), p.y(), p.z()),
                               position(instance, i));
        }
    }
    const auto found = m_positions->find({own.to_world, point.x(), point.y(), point.z()});
    if (found != m_positions->end())
      return std::string(found->second);
    const auto local = local_position(own.to_world, point);
    if (!local)
      throw Argument_error("vertex " + std::to_string(vertex) +
                           " (counted from 0) lies where no 32-bit coordinates under the transform of its "
                           "glTF node are known to bring it");
    std::string bytes;
    for (const double coordinate : *local)
      append_little_endian(bytes, static_cast<float>(coordinate));
    return bytes;
  }

  static bool is_quantised_direction(const Column& column, Index row)
  {
    const std::array<double, 3> direction = {component(column, row, 0), component(column, row, 1),
                                             component(column, row, 2)};
    return quantised_direction(column, direction) == direction;
  }

  // Gives normals that are new to a mesh the precision of those that it has in the file, before vertices are
  // split by their normals: so that none are split that have the same normal in the file.
  void quantise_new_normals()
  {
    std::vector<const Column*> columns; // by instance: of normals that are quantised
    std::vector<std::unordered_set<std::string>> known;
    for (const Gltf_scene::Instance& instance : m_scene.instances) {
      const Column* const normals = block(instance).normals();
      const bool are_quantised = normals && quantised_direction(*normals, {0, 0, 1});
      columns.push_back(are_quantised && !m_normals.empty() ? normals : nullptr);
      known.emplace_back();
      for (Index row = 0; row < block(instance).size && columns.back(); ++row)
        if (is_quantised_direction(*columns.back(), row)) // not those of vertices at new places
          known.back().insert(bits_of(world_normal(instance, *columns.back(), row)));
    }
    std::map<std::pair<Index, Index>, Index> numbers; // by instance and number of the normal
    Cancellation_poll poll;
    for (std::size_t t = 0; t < m_normals.of_triangle.size(); ++t)
      for (Index& corner : m_normals.of_triangle[t]) {
        poll();
        const Index i = m_scene.parts[m_soup.groups.of_triangle[t]].instance;
        if (!columns[i] || corner == m_normals.missing)
          continue;
        const auto [number, is_new] = numbers.try_emplace({i, corner}, corner);
        const std::array<double, 3> normal = m_normals.values[corner];
        if (is_new && known[i].count(bits_of(normal)) == 0) {
          const Gltf_scene::Instance& own = m_scene.instances[i];
          number->second = Index(m_normals.values.size());
          const std::array<double, 3> local = local_normal(own, normal);
          m_normals.values.push_back(
              world_normal(own, quantised_direction(*columns[i], local).value_or(local)));
        }
        corner = number->second;
      }
  }

  // Whether a column of normals, or one that means nothing without them, is left out: the soup has none.
  bool is_dropped(const Column& column) const
  {
    return m_soup.normals.empty() && !m_is_scene_made &&
           (column.name == "NORMAL" || column.name == "TANGENT");
  }

  // Copies of a mesh that have the same triangles of the same vertices are alike.
  void find_copies_alike()
  {
    m_same_as.resize(m_scene.document["meshes"].size());
    std::iota(m_same_as.begin(), m_same_as.end(), Index(0));
    std::vector<std::string> contents(m_scene.parts.size());
    std::map<Index, std::set<Index>> copies;
    for (const Gltf_scene::Part& part : m_scene.parts)
      copies[part.first_alike].insert(part.mesh);
    const auto is_shared = [&](const Gltf_scene::Part& part) { return copies[part.first_alike].size() > 1; };
    Cancellation_poll poll;
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t) {
      poll();
      const Index group = m_soup.groups.of_triangle[t];
      const Gltf_scene::Part& part = m_scene.parts[group];
      if (!is_shared(part))
        continue;
      for (const Index v : in_node(m_soup.triangles[t], part)) {
        append_little_endian(contents[group],
                             m_soup.scene_vertices[v] - m_scene.instances[part.instance].first);
        if (has_moved(v))
          contents[group] += local_position_of(v);
      }
    }
    std::map<std::pair<Index, std::string>, Index> first;
    std::map<Index, std::set<std::string>> different; // by first mesh alike
    for (std::size_t i = 0; i < m_scene.parts.size();) {
      const Gltf_scene::Part& part = m_scene.parts[i];
      std::string all, of_any_block;
      for (; i < m_scene.parts.size() && m_scene.parts[i].mesh == part.mesh; ++i) {
        append_little_endian(all, m_scene.instances[m_scene.parts[i].instance].block);
        for (std::string* const bytes : {&all, &of_any_block}) {
          append_little_endian(*bytes, std::uint32_t(contents[i].size()));
          *bytes += contents[i];
        }
      }
      if (!is_shared(part))
        continue;
      if (part.mesh == part.mesh_of_file &&
          different[part.first_alike].insert(std::move(of_any_block)).second &&
          different[part.first_alike].size() > 1)
        note("meshes with data apart, in common with others in the input");
      const auto [same, is_new] = first.emplace(std::make_pair(part.mesh_of_file, std::move(all)), part.mesh);
      m_same_as[part.mesh] = same->second;
      if (is_new && part.mesh != part.mesh_of_file)
        note("meshes more than in the input, because some are not the same in all places");
    }
  }

  void note(const char* what, std::size_t count = 1) { m_notes[what] += count; }

  bool is_put(const Gltf_scene::Part& part) const { return m_same_as[part.mesh] == part.mesh; }

  // Returns a triangle with its corners in the order that they have in the node.
  Index_triple in_node(Index_triple triangle, const Gltf_scene::Part& part) const
  {
    if (m_scene.instances[part.instance].is_mirrored)
      std::swap(triangle[1], triangle[2]);
    return triangle;
  }

  // Returns the last level that has a vertex of `m_split`.
  Index coarsest(Index vertex) const
  {
    return m_coarsest[m_soup.scene_vertices[m_split.vertices[vertex].vertex]];
  }

  // Returns the vertices of `m_split`: as they were, or as triangles come to them, which meshopt compresses
  // best.
  std::vector<Index> vertices_in_order() const
  {
    std::vector<Index> result(m_split.vertices.size());
    std::iota(result.begin(), result.end(), Index(0));
    if (!m_may_reorder)
      return result;
    std::vector<std::size_t> first_use(result.size(), 0);
    std::size_t corner = 0;
    for (const Index_triple& triangle : m_split.triangles)
      for (const Index v : triangle)
        if (++corner; first_use[v] == 0)
          first_use[v] = corner;
    std::sort(result.begin(), result.end(), [&](Index a, Index b) { return first_use[a] < first_use[b]; });
    return result;
  }

  using Vertices = std::vector<Vertices_by_normal::Vertex>;

  // Numbers the vertices in each instance, and returns those of each that is written.
  std::vector<Vertices> vertices_of_instances()
  {
    std::vector<char> is_instance_put(m_scene.instances.size(), false);
    for (const Gltf_scene::Part& part : m_scene.parts)
      is_instance_put[part.instance] |= is_put(part);
    std::vector<Vertices> vertices(m_scene.instances.size());
    std::vector<Index> order = vertices_in_order();
    std::stable_sort(order.begin(), order.end(),
                     [this](Index a, Index b) { return coarsest(a) > coarsest(b); });
    m_numbers.resize(order.size());
    for (const Index number : order) {
      const Vertices_by_normal::Vertex& v = m_split.vertices[number];
      const std::size_t instance = m_scene.instance_of(m_soup.scene_vertices[v.vertex]);
      m_numbers[number] = Index(vertices[instance].size());
      if (is_instance_put[instance])
        vertices[instance].push_back(v);
    }
    return vertices;
  }

  void put_vertices()
  {
    const std::vector<Vertices> vertices = vertices_of_instances();
    m_attributes.resize(vertices.size());
    m_targets.resize(vertices.size());
    m_sizes.resize(vertices.size());
    m_compressible.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      m_sizes[i] = vertices[i].size();
      if (!vertices[i].empty())
        put_vertices(i, vertices[i]);
    }
  }

  // Puts the vertices of an instance.
  void put_vertices(std::size_t i, const Vertices& vertices)
  {
    const Gltf_scene::Instance& instance = m_scene.instances[i];
    if (m_sizes[i] > block(instance).size)
      note("vertices beyond those of the input, because new normals differ on faces that had one in common",
           m_sizes[i] - block(instance).size);
    const auto put = [&](const Column& column, const auto& bytes_of) {
      Column left = column.without_rows();
      left.rows.reserve(vertices.size() * column.row_size);
      Cancellation_poll poll;
      for (const Vertices_by_normal::Vertex& v : vertices) {
        poll();
        left.rows += bytes_of(v);
      }
      if (std::optional<Column> quantised = quantised_again(left))
        left = std::move(*quantised);
      else if (left.quantised_accessor)
        note("attributes held as floats, because a new value is none of the whole numbers of the input");
      if (left.compression) { // is put with the triangles
        m_compressible[i].push_back(std::move(left));
        return std::size_t(0);
      }
      return m_output.put_accessor(left, vertices.size(), Gltf_output::Target::vertices, i);
    };
    const auto row_of = [&](const Column& column, const Vertices_by_normal::Vertex& v) {
      return column.row(m_soup.scene_vertices[v.vertex] - instance.first);
    };
    const bool has_normals = !m_soup.normals.empty() && block(instance).normals();
    const auto put_rows = [&](const Column& column, bool is_of_target) {
      const bool is_of_normals = has_normals && (column.name == "NORMAL" || column.name == "TANGENT");
      return put(column, [&](const Vertices_by_normal::Vertex& v) {
        return !is_of_normals || v.normal == m_normals.missing
                   ? std::string(row_of(column, v))
                   : m_local_normals.bytes_of(column, is_of_target, m_soup.scene_vertices[v.vertex],
                                              m_normals.values[v.normal]);
      });
    };
    for (const Column& column : block(instance).attributes)
      if (&column == &block(instance).attributes.front())
        m_attributes[i][column.name] =
            put(column, [&](const Vertices_by_normal::Vertex& v) { return local_position_of(v.vertex); });
      else if (is_dropped(column))
        m_attributes[i][column.name] = nullptr;
      else
        m_attributes[i][column.name] = put_rows(column, false);
    for (const std::vector<Column>& target : block(instance).targets) {
      Json& accessors = m_targets[i].emplace_back(Json::object());
      for (const Column& column : target)
        accessors[column.name] = is_dropped(column) ? Json() : Json(put_rows(column, true));
    }
  }

  void put_triangles()
  {
    std::vector<std::vector<Index>> corners(m_scene.parts.size());
    Cancellation_poll poll;
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t) {
      poll();
      const Index group = m_soup.groups.of_triangle[t];
      if (is_put(m_scene.parts[group]))
        for (const Index v : in_node(m_split.triangles[t], m_scene.parts[group]))
          corners[group].push_back(m_numbers[v]);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Gltf_scene::Part& part = m_scene.parts[i];
      if (!is_put(part))
        continue;
      if (corners[i].empty()) {
        m_empty.push_back(&part);
        continue;
      }
      Json& primitive = meshes()[m_first_mesh + part.mesh]["primitives"][part.primitive];
      primitive.erase("mode");
      if (!put_compressible(part, corners[i], primitive)) {
        Column column = indices_of(part, m_sizes[part.instance]);
        column.rows.reserve(corners[i].size() * column.row_size);
        for (const Index corner : corners[i])
          append_index(column, corner);
        primitive["indices"] = m_output.put_accessor(column, corners[i].size(), Gltf_output::Target::indices);
      }
      put_accessors(m_attributes[part.instance], primitive["attributes"]);
      for (std::size_t k = 0; k < m_targets[part.instance].size(); ++k)
        put_accessors(m_targets[part.instance][k], primitive["targets"][k]);
    }
  }

  // Returns a column for the indices of so many vertices, without rows: of the type that the file has for
  // them, where that is large enough.
  static Column indices_of(const Gltf_scene::Part& part, std::size_t vertices)
  {
    const auto holds_all = [&](int type) {
      // glTF does not allow the largest value of a type as an index.
      return type != 0 && vertices < std::uint64_t(1) << 8 * component_size(type);
    };
    const int type = holds_all(part.index_type) ? part.index_type
                     : holds_all(type_uint16)   ? int(type_uint16)
                                                : int(type_uint32);
    Column result = {"indices", part.index_json, type, 1, component_size(type), {}};
    result.accessor["type"] = "SCALAR";
    result.accessor["componentType"] = type;
    result.place = part.index_place;
    return result;
  }

  // Puts the columns that were compressed in the file: compressed again, with the corners, if no other
  // primitive has them, and plain otherwise. Returns whether they are compressed.
  bool put_compressible(const Gltf_scene::Part& part, const std::vector<Index>& corners, Json& primitive)
  {
    const std::vector<Column> columns = std::exchange(m_compressible[part.instance], {});
    if (columns.empty())
      return false;
    const bool is_alone = std::count_if(m_scene.parts.begin(), m_scene.parts.end(), [&](const auto& other) {
                            return other.instance == part.instance;
                          }) == 1;
    // Poses in other files, and accessors that stay plain, are in the order of the vertices.
    const Gltf_scene::Block& of_part = block(m_scene.instances[part.instance]);
    const bool may_reorder = m_soup.poses.empty() && of_part.targets.empty() &&
                             columns.size() == m_attributes[part.instance].size();
    const std::optional<Draco_primitive> encoded =
        is_alone ? encoded_by_draco(columns, corners, may_reorder) : std::nullopt;
    if (!encoded)
      note("primitives without Draco, because of shared vertices or no gain");
    else if (encoded->unquantised > 0)
      note("attributes that Draco holds as floats, because a new value is none of its whole numbers",
           encoded->unquantised);
    if (encoded && !may_reorder)
      note("primitives whose vertices Draco holds in order, because poses or morph targets have it");
    const std::size_t size = m_sizes[part.instance];
    if (!encoded) {
      for (const Column& column : columns)
        m_attributes[part.instance][column.name] =
            m_output.put_accessor(column, size, Gltf_output::Target::vertices, part.instance);
      return false;
    }
    Json& put = m_output.compressed_primitive(encoded->bytes);
    if (put.is_null()) { // otherwise another level of detail has the same
      put["indices"] = m_output.put_decoded_accessor(indices_of(part, encoded->vertices), corners.size());
      for (const Column& column : columns)
        put["attributes"][column.name] = m_output.put_decoded_accessor(column, encoded->vertices);
      put["extension"] = {{"bufferView", m_output.put_bytes(encoded->bytes)},
                          {"attributes", encoded->attributes}};
    }
    m_attributes[part.instance].update(put["attributes"]);
    primitive["indices"] = put["indices"];
    primitive["extensions"][draco_extension] = put["extension"];
    return true;
  }

  // Sets the numbers of accessors by name; null stands for one that goes.
  static void put_accessors(const Json& from, Json& to)
  {
    for (const auto& [name, accessor] : from.items())
      if (accessor.is_null())
        to.erase(name);
      else
        to[name] = accessor;
  }

  // Removes primitives without triangles. Returns for each mesh of the scene which one stands for it, the
  // first of those that are alike; none where no primitive is left.
  std::vector<std::optional<Index>> meshes_left()
  {
    std::vector<char> is_gone(m_same_as.size(), false);
    // From the back, so that the numbers of those still to be removed stay.
    std::sort(m_empty.begin(), m_empty.end(), [](const Gltf_scene::Part* a, const Gltf_scene::Part* b) {
      return std::make_pair(a->mesh, a->primitive) > std::make_pair(b->mesh, b->primitive);
    });
    for (const Gltf_scene::Part* part : m_empty) {
      Json& primitives = meshes()[m_first_mesh + part->mesh]["primitives"];
      primitives.erase(part->primitive);
      is_gone[part->mesh] = primitives.empty();
    }
    std::vector<std::optional<Index>> result;
    for (const Index mesh : m_same_as)
      result.push_back(is_gone[mesh] ? std::nullopt : std::optional<Index>(mesh));
    return result;
  }

  bool m_is_scene_made, m_may_reorder;
  const Triangle_soup& m_soup;
  const Gltf_scene& m_scene;
  Corner_values<3> m_normals; // of the soup, as precise as the file can have them
  Vertices_by_normal m_split; // by these
  const std::vector<Index>& m_coarsest;
  Gltf_output& m_output;
  Write_notes& m_notes;
  Index m_first_mesh = 0;         // in the document, of those of this soup
  std::vector<Index> m_same_as;   // by mesh: the first copy that is alike, or the mesh itself
  std::vector<Index> m_numbers;   // by vertex of `m_split`, in its instance
  std::vector<Json> m_attributes; // by instance
  std::vector<std::vector<Json>> m_targets;
  std::vector<std::vector<Column>> m_compressible; // likewise
  std::vector<std::size_t> m_sizes;
  std::vector<const Gltf_scene::Part*> m_empty;
  std::optional<std::map<std::tuple<Gltf_scene::Matrix, double, double, double>, std::string_view>>
      m_positions;
  Local_normals m_local_normals;
};

// Throws `Argument_error` unless a soup fits its scene.
void require_fitting(const Triangle_soup& soup)
{
  const Gltf_scene& scene = *soup.scene;
  const auto refuse = [](const std::string& what) {
    throw Argument_error("the soup does not fit the glTF file that it was read from: " + what +
                         "; empty its member scene to write a new one");
  };
  const Gltf_scene::Instance& last = scene.instances.back();
  if (soup.scene_vertices.size() != soup.points.size())
    refuse("it does not say for every vertex which of the file it is");
  for (const Index v : soup.scene_vertices)
    if (v >= last.first + scene.blocks[last.block].size)
      refuse("it names vertex " + std::to_string(v) + ", which is not there");
  if (soup.groups.of_triangle.size() != soup.triangles.size() ||
      soup.groups.names.size() != scene.parts.size())
    refuse("its groups are not the primitives of the file");
  Cancellation_poll poll;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    poll();
    for (const Index v : soup.triangles[t])
      if (scene.instance_of(soup.scene_vertices[v]) != scene.parts[soup.groups.of_triangle[t]].instance)
        refuse("triangle " + std::to_string(t) + " has a vertex of another primitive");
  }
}

/// Levels of detail, and the glTF scene that they all belong to.
struct Levels_of_scene
{
  std::vector<const Triangle_soup*> levels;
  bool is_scene_made = false;
  std::vector<Triangle_soup> made; // where there was no scene, or a vertex has several rows of it
};

// Makes a scene for levels that have none.
Levels_of_scene with_scene(const std::vector<const Triangle_soup*>& levels, bool has_poses)
{
  for (const Triangle_soup* const soup : levels) {
    if (soup->triangles.empty())
      throw Argument_error("a glTF file cannot hold a mesh without triangles; write OBJ, OFF or PLY");
    if (soup->scene != levels.front()->scene)
      throw Argument_error("the levels of detail are not of one mesh; write each to a file of its own");
  }
  Levels_of_scene result;
  result.made.reserve(levels.size());
  if (levels.front()->scene) {
    for (const Triangle_soup* const soup : levels) {
      require_fitting(*soup);
      std::optional<Triangle_soup> split = with_split_poles(*soup);
      result.levels.push_back(split ? &result.made.emplace_back(std::move(*split)) : soup);
    }
    return result;
  }
  result.is_scene_made = true;
  Triangle_soup all = with_gltf_scene(levels.size() == 1 ? *levels.front() : united(levels), has_poses);
  if (levels.size() == 1) {
    result.made.push_back(std::move(all));
  } else {
    const auto part = [](const auto& rows, std::size_t first, std::size_t size) {
      const auto begin = rows.begin() + std::ptrdiff_t(first);
      return std::vector(begin, begin + std::ptrdiff_t(size));
    };
    std::size_t first = 0;
    for (const Triangle_soup* const level : levels) {
      Triangle_soup& soup = result.made.emplace_back();
      soup.points = all.points;
      soup.triangles = part(all.triangles, first, level->triangles.size());
      soup.groups = {part(all.groups.of_triangle, first, level->triangles.size()), all.groups.names};
      soup.poses = level->poses;
      soup.scene = all.scene;
      soup.scene_vertices = all.scene_vertices;
      first += level->triangles.size();
    }
  }
  for (const Triangle_soup& soup : result.made)
    result.levels.push_back(&soup);
  return result;
}

} // namespace

Write_notes write_gltf(Byte_writer& out, const std::vector<const Triangle_soup*>& levels, Mesh_format format,
                       bool has_poses)
{
  const Levels_of_scene all = with_scene(levels, has_poses);
  const Gltf_scene& scene = *all.levels.front()->scene;
  const bool may_reorder = levels.front()->poses.empty();
  // Vertices of coarser levels come first, so that these levels have the first rows of the finer ones.
  std::vector<Index> coarsest(scene.instances.back().first + scene.blocks[scene.instances.back().block].size,
                              0);
  for (std::size_t level = 1; level < levels.size() && may_reorder; ++level) {
    const Triangle_soup& soup = *all.levels[level];
    for (const Index_triple& triangle : soup.triangles)
      for (const Index v : triangle)
        if (v < soup.scene_vertices.size() && soup.scene_vertices[v] < coarsest.size())
          coarsest[soup.scene_vertices[v]] = Index(level); // others are refused
  }
  // Levels have rows in common, in one order.
  const bool is_any_order_right = may_reorder && levels.size() == 1 && !scene.meshopt_views.empty();
  Gltf_output output(scene, may_reorder, levels.size() > 1);
  std::vector<Gltf_level> put;
  Write_notes notes;
  for (const Triangle_soup* const soup : all.levels)
    put.push_back(
        Gltf_writer(*soup, all.is_scene_made, !put.empty(), is_any_order_right, coarsest, output, notes)
            .put());
  put_meshes_in_nodes(output.document, scene, std::move(put));
  output.write(out, format);
  return notes.empty() ? scene.compact : notes;
}

} // namespace selvedge::files

namespace selvedge {

void write_gltf_poses(const std::filesystem::path& path, const Triangle_soup& mesh)
{
  const Mesh_format format = mesh_format(path);
  if (format != Mesh_format::glb && format != Mesh_format::gltf)
    throw Argument_error("only glTF files show a mesh in several poses");
  require_avatar(path, {}); // what is written is a new document
  if (mesh.poses.empty())
    throw Argument_error("there is no pose to write");
  if (!has_float32_points(mesh.points))
    throw Argument_error("a coordinate is no 32-bit float; call round_to_float32 first");
  Triangle_soup soup = mesh;
  soup.scene = nullptr;
  soup.scene_vertices.clear();
  files::Byte_writer out(path);
  files::write_gltf(out, {&soup}, format, true);
}

} // namespace selvedge
