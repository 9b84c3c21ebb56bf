// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/formats.h"
#include "files/gltf_decoding.h"
#include "files/gltf_encoding.h"
#include "soup/Gltf_scene.h"
#include "soup/flat_shading.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/internal/base64.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Column = Gltf_scene::Column;

constexpr int s_vertices = 34962, s_indices = 34963, s_any = 0; // targets of buffer views; 0 stands for none

/// Writes a reduced soup back into the glTF document of its scene.
class Gltf_writer
{
public:
  /// The scene may hold normals though the soup has none, if it was made for this soup.
  Gltf_writer(const Triangle_soup& soup, const Gltf_scene& scene, bool is_scene_made)
      : m_is_scene_made(is_scene_made), m_soup(soup), m_scene(scene), m_split(vertices_by_normal(soup)),
        m_document(scene.document), m_instanced_nodes(scene.instanced_nodes), m_views(scene.views),
        m_free_accessors(scene.free_accessors.rbegin(), scene.free_accessors.rend()),
        m_free_views(scene.free_views.rbegin(), scene.free_views.rend())
  {
    check();
    for (const auto& [view, row_size] : scene.meshopt_views)
      if (row_size > 0)
        m_row_sizes[view] = {row_size, false};
  }

  void write(Byte_writer& out, Mesh_format format)
  {
    find_copies_alike();
    put_vertices();
    put_triangles();
    if (m_has_draco)
      require(draco_extension);
    fill_free();
    renumber_meshes();
    put_instances();
    std::string bytes = put_buffer();
    if (format == Mesh_format::gltf) {
      m_document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + internal::base64(bytes);
      out << m_document.dump(1, '\t') << '\n';
    } else {
      std::string json = m_document.dump();
      json.resize((json.size() + 3) / 4 * 4, ' ');
      bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
      const std::size_t size = 12 + 8 + json.size() + 8 + bytes.size();
      if (size > std::numeric_limits<std::uint32_t>::max())
        throw Output_error("a GLB file holds no more than 4 GiB; write .gltf instead");
      out << "glTF";
      out.binary(std::uint32_t(2));
      out.binary(std::uint32_t(size));
      out.binary(std::uint32_t(json.size()));
      out << "JSON" << json;
      out.binary(std::uint32_t(bytes.size()));
      out << std::string_view("BIN\0", 4) << bytes;
    }
    out.commit();
  }

private:
  const Gltf_scene::Block& block(const Gltf_scene::Instance& instance) const
  {
    return m_scene.blocks[instance.block];
  }

  void check() const
  {
    const auto refuse = [](const std::string& what) {
      throw Argument_error("the soup does not fit the glTF file that it was read from: " + what +
                           "; empty its member scene to write a new one");
    };
    const Gltf_scene::Instance& last = m_scene.instances.back();
    if (m_soup.scene_vertices.size() != m_soup.points.size())
      refuse("it does not say for every vertex which of the file it is");
    for (const Index v : m_soup.scene_vertices)
      if (v >= last.first + block(last).size)
        refuse("it names vertex " + std::to_string(v) + ", which is not there");
    if (m_soup.groups.of_triangle.size() != m_soup.triangles.size() ||
        m_soup.groups.names.size() != m_scene.parts.size())
      refuse("its groups are not the primitives of the file");
    Cancellation_poll poll;
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t) {
      poll();
      for (const Index v : m_soup.triangles[t])
        if (m_scene.instance_of(m_soup.scene_vertices[v]) !=
            m_scene.parts[m_soup.groups.of_triangle[t]].instance)
          refuse("triangle " + std::to_string(t) + " has a vertex of another primitive");
    }
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

  // Returns the bytes of the normal that a vertex has in its node: those of its row where that is its normal,
  // else those of another row of the instance with this normal, at this position if there is one, or else new
  // ones.
  std::string local_normal_of(const Vertices_by_normal::Vertex& v, const Column& column)
  {
    const Index scene_vertex = m_soup.scene_vertices[v.vertex];
    const std::size_t number = m_scene.instance_of(scene_vertex);
    const Gltf_scene::Instance& own = m_scene.instances[number];
    const std::array<double, 3>& normal = m_soup.normals.values[v.normal];
    const auto row_of = [](const Column& of, std::size_t row) {
      return std::string_view(of.rows).substr(row * of.row_size, of.row_size);
    };
    const auto bits_of = [](const std::array<double, 3>& numbers) {
      return std::string(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    };
    const auto normal_of = [&](std::size_t row) {
      return world_normal(own,
                          {component(column, row, 0), component(column, row, 1), component(column, row, 2)});
    };
    if (v.normal == m_soup.normals.missing || column.component_type != type_float32 ||
        have_same_bits(normal_of(scene_vertex - own.first), normal))
      return std::string(row_of(column, scene_vertex - own.first));
    const Column& positions = block(own).attributes.front();
    const auto [rows, is_new] = m_rows_of_normals.try_emplace(number);
    if (is_new)
      for (Index row = 0; row < block(own).size; ++row)
        rows->second.emplace(bits_of(normal_of(row)).append(row_of(positions, row)), row);
    auto row = rows->second.find(bits_of(normal).append(row_of(positions, scene_vertex - own.first)));
    if (row == rows->second.end())
      row = rows->second.lower_bound(bits_of(normal));
    if (row != rows->second.end() && row->first.compare(0, sizeof normal, bits_of(normal)) == 0)
      return std::string(row_of(column, row->second));
    std::string result;
    for (const double coordinate : local_normal(own, normal))
      append_little_endian(result, static_cast<float>(coordinate));
    return result;
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
    m_same_as.resize(m_document["meshes"].size());
    std::iota(m_same_as.begin(), m_same_as.end(), Index(0));
    std::vector<std::string> contents(m_scene.parts.size());
    std::map<Index, std::set<Index>> copies;
    for (const Gltf_scene::Part& part : m_scene.parts)
      copies[part.mesh_of_file].insert(part.mesh);
    const auto is_shared = [&](const Gltf_scene::Part& part) { return copies[part.mesh_of_file].size() > 1; };
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
    for (std::size_t i = 0; i < m_scene.parts.size();) {
      const Gltf_scene::Part& part = m_scene.parts[i];
      std::string all;
      for (; i < m_scene.parts.size() && m_scene.parts[i].mesh == part.mesh; ++i) {
        append_little_endian(all, m_scene.instances[m_scene.parts[i].instance].block);
        append_little_endian(all, std::uint32_t(contents[i].size()));
        all += contents[i];
      }
      if (is_shared(part))
        m_same_as[part.mesh] =
            first.emplace(std::make_pair(part.mesh_of_file, std::move(all)), part.mesh).first->second;
    }
  }

  bool is_put(const Gltf_scene::Part& part) const { return m_same_as[part.mesh] == part.mesh; }

  // Returns a triangle with its corners in the order that they have in the node.
  Index_triple in_node(Index_triple triangle, const Gltf_scene::Part& part) const
  {
    if (m_scene.instances[part.instance].is_mirrored)
      std::swap(triangle[1], triangle[2]);
    return triangle;
  }

  void put_vertices()
  {
    std::vector<char> is_instance_put(m_scene.instances.size(), false);
    for (const Gltf_scene::Part& part : m_scene.parts)
      is_instance_put[part.instance] |= is_put(part);
    std::vector<std::vector<Vertices_by_normal::Vertex>> vertices(m_scene.instances.size());
    for (const Vertices_by_normal::Vertex& v : m_split.vertices) {
      const std::size_t instance = m_scene.instance_of(m_soup.scene_vertices[v.vertex]);
      auto& of_instance = vertices[instance];
      m_numbers.push_back(Index(of_instance.size()));
      if (!is_instance_put[instance])
        continue;
      of_instance.push_back(v);
    }
    m_attributes.resize(m_scene.instances.size());
    m_targets.resize(m_scene.instances.size());
    m_sizes.resize(m_scene.instances.size());
    m_compressible.resize(m_scene.instances.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      m_sizes[i] = vertices[i].size();
      if (vertices[i].empty())
        continue;
      const Gltf_scene::Instance& instance = m_scene.instances[i];
      const auto put = [&](const Column& column, const auto& bytes_of) {
        Column left = {column.name,       column.accessor,   column.component_type,
                       column.components, column.row_size,   {},
                       column.is_sparse,  column.compression};
        left.rows.reserve(vertices[i].size() * column.row_size);
        Cancellation_poll poll;
        for (const Vertices_by_normal::Vertex& v : vertices[i]) {
          poll();
          left.rows += bytes_of(v);
        }
        if (left.compression) { // is put with the triangles
          m_compressible[i].push_back(std::move(left));
          return std::size_t(0);
        }
        return put_accessor(left, vertices[i].size(), s_vertices);
      };
      const auto put_rows = [&](const Column& column) {
        return put(column, [&](const Vertices_by_normal::Vertex& v) {
          return std::string_view(column.rows)
              .substr((m_soup.scene_vertices[v.vertex] - instance.first) * column.row_size, column.row_size);
        });
      };
      for (const Column& column : block(instance).attributes)
        if (&column == &block(instance).attributes.front())
          m_attributes[i][column.name] =
              put(column, [&](const Vertices_by_normal::Vertex& v) { return local_position_of(v.vertex); });
        else if (is_dropped(column))
          m_attributes[i][column.name] = nullptr;
        else if (column.name == "NORMAL" && column.components == 3 && !m_soup.normals.empty())
          m_attributes[i][column.name] =
              put(column, [&](const Vertices_by_normal::Vertex& v) { return local_normal_of(v, column); });
        else
          m_attributes[i][column.name] = put_rows(column);
      for (const std::vector<Column>& target : block(instance).targets) {
        Json& accessors = m_targets[i].emplace_back(Json::object());
        for (const Column& column : target)
          accessors[column.name] = is_dropped(column) ? Json() : Json(put_rows(column));
      }
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
      Json& primitive = m_document["meshes"][part.mesh]["primitives"][part.primitive];
      const bool is_compressed = put_compressible(part, corners[i], primitive);
      put_accessors(m_attributes[part.instance], primitive["attributes"]);
      for (std::size_t k = 0; k < m_targets[part.instance].size(); ++k)
        put_accessors(m_targets[part.instance][k], primitive["targets"][k]);
      // glTF does not allow the largest value of a type as an index.
      const std::size_t size = m_sizes[part.instance];
      const int type = part.index_type != 0 ? part.index_type
                       : size < 0xffff      ? int(type_uint16)
                                            : int(type_uint32);
      Column column = {"indices", part.index_json, type, 1, component_size(type), {}};
      column.accessor["type"] = "SCALAR";
      column.accessor["componentType"] = type;
      primitive.erase("mode");
      if (is_compressed) {
        primitive["indices"] = put_decoded_accessor(column, corners[i].size());
        continue;
      }
      column.rows.reserve(corners[i].size() * column.row_size);
      for (const Index corner : corners[i])
        append_index(column, corner);
      primitive["indices"] = put_accessor(column, corners[i].size(), s_indices);
    }
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
    const std::size_t size = m_sizes[part.instance];
    for (const Column& column : columns)
      m_attributes[part.instance][column.name] =
          encoded ? put_decoded_accessor(column, size) : put_accessor(column, size, s_vertices);
    if (!encoded)
      return false;
    primitive["extensions"][draco_extension] = {{"bufferView", put_view({}, encoded->bytes, s_any)},
                                                {"attributes", encoded->attributes}};
    m_has_draco = true;
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

  // Returns a number for a new element. Free numbers are used first, so that all others stay.
  static std::size_t next(std::vector<Index>& free, std::size_t size)
  {
    if (free.empty())
      return size;
    const Index number = free.back();
    free.pop_back();
    return number;
  }

  // Returns what the document says about an accessor, apart from where its bytes are.
  static Json description(const Column& column, std::size_t count)
  {
    Json result = column.accessor;
    result["count"] = count;
    if (!column.rows.empty() &&
        (column.name == "POSITION" || result.contains("min") || result.contains("max")))
      put_bounds(result, column, count);
    return result;
  }

  // Puts an accessor whose bytes are compressed.
  std::size_t put_decoded_accessor(const Column& column, std::size_t count)
  {
    return put_accessor(description(column, count));
  }

  std::size_t put_accessor(Json accessor)
  {
    Json& accessors = m_document["accessors"];
    const std::size_t number = next(m_free_accessors, accessors.size());
    accessors[number] = std::move(accessor);
    return number;
  }

  // Accessors that say the same of the same bytes become one, as in files that share them.
  std::size_t put_accessor(const Column& column, std::size_t count, int target)
  {
    const Json rest = description(column, count);
    std::string bytes = column.is_sparse ? column.rows : bytes_of_view(column, count, target);
    const std::size_t hash = std::hash<std::string>()(bytes);
    for (auto range = m_written.equal_range(hash); range.first != range.second; ++range.first) {
      const Written& known = range.first->second;
      if (known.target == target && known.is_sparse == column.is_sparse && known.rest == rest &&
          (known.is_sparse ? known.sparse_rows : m_views[known.view]) == bytes)
        return known.accessor;
    }
    Written& written = m_written.emplace(hash, Written{rest, target, column.is_sparse, {}, 0, 0})->second;
    Json accessor = Json::object();
    if (column.is_sparse)
      written.sparse_rows = std::exchange(bytes, bytes_of_view(column, count, target));
    if (!column.is_sparse || !put_sparse(accessor, column, count))
      accessor["bufferView"] = written.view = put_view(column, std::move(bytes), target);
    accessor.update(rest);
    return written.accessor = put_accessor(std::move(accessor));
  }

  // Puts only the rows that are not zero, where that takes less space. Returns whether it does.
  bool put_sparse(Json& accessor, const Column& column, std::size_t count)
  {
    const int type = count <= 0x100     ? int(type_uint8)
                     : count <= 0x10000 ? int(type_uint16)
                                        : int(type_uint32);
    Column indices = {"indices", {}, type, 1, component_size(type), {}};
    Column values = {"values", {}, column.component_type, column.components, column.row_size, {}};
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view row = std::string_view(column.rows).substr(i * column.row_size, column.row_size);
      if (row.find_first_not_of('\0') == row.npos)
        continue;
      ++size;
      append_index(indices, Index(i));
      values.rows += row;
    }
    if (indices.rows.size() + values.rows.size() >= column.rows.size())
      return false;
    if (size > 0)
      accessor["sparse"] = {
          {"count", size},
          {"indices", {{"bufferView", put_view(indices, indices.rows, s_any)}, {"componentType", type}}},
          {"values", {{"bufferView", put_view(values, values.rows, s_any)}}}};
    return true;
  }

  static void append_index(Column& column, Index index)
  {
    for (std::size_t k = 0; k < column.row_size; ++k)
      column.rows += static_cast<char>(index >> (8 * k) & 0xff);
  }

  static void put_bounds(Json& accessor, const Column& column, std::size_t count)
  {
    Json least = Json::array(), largest = Json::array();
    for (std::size_t k = 0; k < column.components; ++k) {
      double low = component(column, 0, k), high = low;
      for (std::size_t i = 1; i < count; ++i) {
        low = std::min(low, component(column, i, k));
        high = std::max(high, component(column, i, k));
      }
      if (column.component_type == type_float32) {
        least.push_back(low);
        largest.push_back(high);
      } else {
        least.push_back(std::int64_t(low));
        largest.push_back(std::int64_t(high));
      }
    }
    accessor["min"] = std::move(least);
    accessor["max"] = std::move(largest);
  }

  // Rows of vertices begin at multiples of four bytes.
  static std::size_t stride_of(const Column& column, int target)
  {
    return target == s_vertices ? (column.row_size + 3) / 4 * 4 : column.row_size;
  }

  static std::string bytes_of_view(const Column& column, std::size_t count, int target)
  {
    const std::size_t stride = stride_of(column, target);
    if (stride == column.row_size)
      return column.rows;
    std::string bytes;
    bytes.reserve(count * stride);
    for (std::size_t i = 0; i < count; ++i) {
      bytes.append(column.rows, i * column.row_size, column.row_size);
      bytes.append(stride - column.row_size, '\0');
    }
    return bytes;
  }

  std::size_t put_view(const Column& column, std::string bytes, int target)
  {
    Json view = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}};
    if (const std::size_t stride = stride_of(column, target); stride != column.row_size)
      view["byteStride"] = stride;
    if (target != s_any)
      view["target"] = target;
    Json& views = m_document["bufferViews"];
    const std::size_t number = next(m_free_views, views.size());
    views[number] = std::move(view);
    m_views.resize(views.size());
    m_views[number] = std::move(bytes);
    m_row_sizes.erase(Index(number));
    if (target != s_any)
      m_row_sizes[Index(number)] = {target == s_indices ? column.row_size : stride_of(column, target),
                                    target == s_indices};
    return number;
  }

  // Puts the smallest valid accessor or buffer view where a removed primitive has left a number.
  void fill_free()
  {
    for (const Index number : m_free_accessors)
      m_document["accessors"][number] = {
          {"componentType", int(type_uint8)}, {"count", 1}, {"type", "SCALAR"}};
    for (const Index number : m_free_views) {
      m_document["bufferViews"][number] = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 1}};
      m_views[number].assign(1, '\0');
    }
  }

  // Removes primitives without triangles, the meshes that they leave empty, and copies that are alike.
  void renumber_meshes()
  {
    Json& meshes = m_document["meshes"];
    std::vector<char> is_gone(meshes.size(), false);
    // From the back, so that the numbers of those still to be removed stay.
    std::sort(m_empty.begin(), m_empty.end(), [](const Gltf_scene::Part* a, const Gltf_scene::Part* b) {
      return std::make_pair(a->mesh, a->primitive) > std::make_pair(b->mesh, b->primitive);
    });
    for (const Gltf_scene::Part* part : m_empty) {
      Json& primitives = meshes[part->mesh]["primitives"];
      primitives.erase(part->primitive);
      is_gone[part->mesh] = primitives.empty();
    }
    std::vector<std::size_t> numbers;
    Json kept = Json::array();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      numbers.push_back(kept.size());
      if (!is_gone[m] && m_same_as[m] == m)
        kept.push_back(std::move(meshes[m]));
    }
    meshes = std::move(kept);
    const auto renumber = [&](Json& node) {
      const auto mesh = node.find("mesh");
      if (mesh == node.end())
        return;
      const Index same = m_same_as[mesh->get<std::size_t>()];
      if (!is_gone[same])
        *mesh = numbers[same];
      else
        for (const char* key : {"mesh", "skin", "weights"})
          node.erase(key);
    };
    for (Json& node : m_document["nodes"])
      renumber(node);
    for (Gltf_scene::Instanced_node& node : m_instanced_nodes)
      for (Json& instance : node.instances)
        renumber(instance);
  }

  // Instances that do not share one mesh any more become nodes.
  void put_instances()
  {
    Json& nodes = m_document["nodes"];
    for (const auto& [number, instances] : m_instanced_nodes) {
      const auto is_like_first = [&first = instances.front()](const Json& instance) {
        return instance.value("mesh", -1) == first.value("mesh", -1);
      };
      if (nodes[number].contains("mesh") && std::all_of(instances.begin(), instances.end(), is_like_first))
        continue;
      for (const char* key : {"mesh", "weights"})
        nodes[number].erase(key);
      remove_extension_of(nodes[number], instancing_extension);
      for (const Json& instance : instances)
        if (instance.contains("mesh")) {
          nodes[number]["children"].push_back(nodes.size());
          nodes.push_back(instance);
        }
    }
    if (!m_instanced_nodes.empty() && std::all_of(nodes.begin(), nodes.end(), [](const Json& node) {
          return instance_attributes(node).empty();
        }))
      remove_extension(m_document, instancing_extension);
  }

  // Puts all buffer views into one buffer, each at a multiple of four bytes.
  std::string put_buffer()
  {
    std::string bytes;
    std::size_t decoded = 0; // bytes of views that are compressed
    const auto begin_view = [](std::size_t& size) { size = (size + 3) / 4 * 4; };
    for (std::size_t i = 0; i < m_views.size(); ++i) {
      std::size_t begin = bytes.size();
      begin_view(begin);
      bytes.resize(begin, '\0');
      Json& view = m_document["bufferViews"][i];
      const std::optional<std::string> encoded = compressed_view(i);
      if (encoded) {
        const auto& [row_size, are_triangles] = m_row_sizes.at(Index(i));
        begin_view(decoded);
        view["buffer"] = 1;
        view["byteOffset"] = decoded;
        view["extensions"][meshopt_extension] = {{"buffer", 0},
                                                 {"byteOffset", begin},
                                                 {"byteLength", encoded->size()},
                                                 {"byteStride", row_size},
                                                 {"count", m_views[i].size() / row_size},
                                                 {"mode", !are_triangles         ? "ATTRIBUTES"
                                                          : m_soup.poses.empty() ? "TRIANGLES"
                                                                                 : "INDICES"}};
        decoded += m_views[i].size();
      } else {
        view["buffer"] = 0;
        view["byteOffset"] = begin;
      }
      bytes += encoded ? *encoded : m_views[i];
    }
    Json buffer = m_document.contains("buffers") ? m_document["buffers"][0] : Json::object();
    buffer.erase("uri");
    buffer["byteLength"] = bytes.size();
    m_document["buffers"] = Json::array({std::move(buffer)});
    if (decoded > 0) {
      m_document["buffers"].push_back(
          {{"byteLength", decoded}, {"extensions", {{meshopt_extension, {{"fallback", true}}}}}});
      require(meshopt_extension);
    }
    return bytes;
  }

  // Returns a view compressed as others of the file were, unless it was plain there.
  std::optional<std::string> compressed_view(std::size_t view) const
  {
    const auto found = m_row_sizes.find(Index(view));
    return m_scene.meshopt_views.empty() || found == m_row_sizes.end()
               ? std::nullopt
               : encoded_by_meshopt(m_views[view], found->second.first, found->second.second,
                                    m_soup.poses.empty());
  }

  void require(const char* extension)
  {
    for (const char* key : {"extensionsUsed", "extensionsRequired"})
      m_document[key].push_back(extension);
  }

  bool m_is_scene_made;
  const Triangle_soup& m_soup;
  const Gltf_scene& m_scene;
  Vertices_by_normal m_split;
  Json m_document;
  std::vector<Gltf_scene::Instanced_node> m_instanced_nodes;
  std::vector<Index> m_same_as; // by mesh: the first copy that is alike, or the mesh itself
  std::vector<std::string> m_views;
  std::vector<Index> m_free_accessors, m_free_views; // the first at the back
  std::vector<Index> m_numbers;                      // by vertex of `m_split`, in its instance
  std::vector<Json> m_attributes;                    // by instance
  std::vector<std::vector<Json>> m_targets;
  std::vector<std::vector<Column>> m_compressible; // likewise
  bool m_has_draco = false;
  std::map<Index, std::pair<std::size_t, bool>> m_row_sizes; // of views of attributes and of triangles
  std::vector<std::size_t> m_sizes;
  std::vector<const Gltf_scene::Part*> m_empty;
  struct Written
  {
    Json rest; // of an accessor
    int target;
    bool is_sparse;
    std::string sparse_rows; // in full
    std::size_t view, accessor;
  };
  std::unordered_multimap<std::size_t, Written> m_written; // by the hash of the bytes
  std::optional<std::map<std::tuple<Gltf_scene::Matrix, double, double, double>, std::string_view>>
      m_positions;
  // By instance: rows by the bits of their normals and positions.
  std::map<std::size_t, std::map<std::string, Index>> m_rows_of_normals;
};

} // namespace

void write_gltf(Byte_writer& out, const Triangle_soup& soup, Mesh_format format)
{
  if (soup.triangles.empty())
    throw Argument_error("a glTF file cannot hold a mesh without triangles; write OBJ, OFF or PLY");
  if (soup.scene)
    return Gltf_writer(soup, *soup.scene, false).write(out, format);
  const Triangle_soup of_scene = with_gltf_scene(soup);
  Gltf_writer(of_scene, *of_scene.scene, true).write(out, format);
}

} // namespace selvedge::files
