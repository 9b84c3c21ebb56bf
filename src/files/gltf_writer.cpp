// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/formats.h"
#include "soup/Gltf_scene.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;
using Column = Gltf_scene::Column;

constexpr int s_vertices = 34962, s_indices = 34963; // targets of buffer views

std::string base64(const std::string& bytes)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  Cancellation_poll poll;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    poll();
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      result += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return result;
}

/// Writes a reduced soup back into the glTF document of its scene.
class Gltf_writer
{
public:
  Gltf_writer(const Triangle_soup& soup, const Gltf_scene& scene)
      : m_soup(soup), m_scene(scene), m_document(scene.document), m_views(scene.views),
        m_free_accessors(scene.free_accessors.rbegin(), scene.free_accessors.rend()),
        m_free_views(scene.free_views.rbegin(), scene.free_views.rend())
  {
    check();
  }

  void write(Byte_writer& out, Mesh_format format)
  {
    put_vertices();
    put_triangles();
    fill_free();
    remove_empty();
    std::string bytes = put_buffer();
    if (format == Mesh_format::gltf) {
      m_document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes);
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
  static constexpr Index s_none = std::numeric_limits<Index>::max();

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
    if (world_position(own.to_world, block(own).attributes.front(), scene_vertex - own.first) == point)
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

  void put_vertices()
  {
    std::vector<std::vector<Index>> vertices(m_scene.instances.size());
    std::vector<char> is_used(m_soup.points.size(), false);
    for (const Index_triple& triangle : m_soup.triangles)
      for (const Index v : triangle)
        is_used[v] = true;
    m_numbers.assign(m_soup.points.size(), s_none);
    for (Index v = 0; v < m_soup.points.size(); ++v)
      if (is_used[v]) {
        std::vector<Index>& of_instance = vertices[m_scene.instance_of(m_soup.scene_vertices[v])];
        m_numbers[v] = Index(of_instance.size());
        of_instance.push_back(v);
      }
    m_attributes.resize(m_scene.instances.size());
    m_targets.resize(m_scene.instances.size());
    m_sizes.resize(m_scene.instances.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      m_sizes[i] = vertices[i].size();
      if (vertices[i].empty())
        continue;
      const Gltf_scene::Instance& instance = m_scene.instances[i];
      const auto put = [&](const Column& column, bool is_position) {
        Column left = {column.name,       column.accessor, column.component_type,
                       column.components, column.row_size, {}};
        left.rows.reserve(vertices[i].size() * column.row_size);
        Cancellation_poll poll;
        for (const Index v : vertices[i]) {
          poll();
          if (is_position)
            left.rows += local_position_of(v);
          else
            left.rows.append(column.rows, (m_soup.scene_vertices[v] - instance.first) * column.row_size,
                             column.row_size);
        }
        return put_accessor(left, vertices[i].size(), s_vertices);
      };
      for (const Column& column : block(instance).attributes)
        m_attributes[i][column.name] = put(column, &column == &block(instance).attributes.front());
      for (const std::vector<Column>& target : block(instance).targets) {
        Json& accessors = m_targets[i].emplace_back(Json::object());
        for (const Column& column : target)
          accessors[column.name] = put(column, false);
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
      auto [a, b, c] = m_soup.triangles[t];
      if (m_scene.instances[m_scene.parts[group].instance].is_mirrored)
        std::swap(b, c);
      for (const Index v : {a, b, c})
        corners[group].push_back(m_numbers[v]);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Gltf_scene::Part& part = m_scene.parts[i];
      if (corners[i].empty()) {
        m_empty.push_back(&part);
        continue;
      }
      Json& primitive = m_document["meshes"][part.mesh]["primitives"][part.primitive];
      for (const auto& [name, accessor] : m_attributes[part.instance].items())
        primitive["attributes"][name] = accessor;
      for (std::size_t k = 0; k < m_targets[part.instance].size(); ++k)
        for (const auto& [name, accessor] : m_targets[part.instance][k].items())
          primitive["targets"][k][name] = accessor;
      // glTF does not allow the largest value of a type as an index.
      const std::size_t size = m_sizes[part.instance];
      const int type = part.index_type != 0 ? part.index_type
                       : size < 0xffff      ? int(type_uint16)
                                            : int(type_uint32);
      Column column = {"indices", part.index_json, type, 1, component_size(type), {}};
      column.accessor["type"] = "SCALAR";
      column.accessor["componentType"] = type;
      column.rows.reserve(corners[i].size() * column.row_size);
      for (const Index corner : corners[i])
        for (std::size_t k = 0; k < column.row_size; ++k)
          column.rows += static_cast<char>(corner >> (8 * k) & 0xff);
      primitive["indices"] = put_accessor(column, corners[i].size(), s_indices);
      primitive.erase("mode");
    }
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

  std::size_t put_accessor(const Column& column, std::size_t count, int target)
  {
    Json accessor = {{"bufferView", put_view(column, count, target)}};
    accessor.update(column.accessor);
    accessor["count"] = count;
    if (column.name == "POSITION" || accessor.contains("min") || accessor.contains("max"))
      put_bounds(accessor, column, count);
    Json& accessors = m_document["accessors"];
    const std::size_t number = next(m_free_accessors, accessors.size());
    accessors[number] = std::move(accessor);
    return number;
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

  std::size_t put_view(const Column& column, std::size_t count, int target)
  {
    // Rows of vertices begin at multiples of four bytes.
    const std::size_t stride = target == s_vertices ? (column.row_size + 3) / 4 * 4 : column.row_size;
    std::string bytes;
    if (stride == column.row_size) {
      bytes = column.rows;
    } else {
      bytes.reserve(count * stride);
      for (std::size_t i = 0; i < count; ++i) {
        bytes.append(column.rows, i * column.row_size, column.row_size);
        bytes.append(stride - column.row_size, '\0');
      }
    }
    Json view = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}};
    if (stride != column.row_size)
      view["byteStride"] = stride;
    view["target"] = target;
    Json& views = m_document["bufferViews"];
    const std::size_t number = next(m_free_views, views.size());
    views[number] = std::move(view);
    m_views.resize(views.size());
    m_views[number] = std::move(bytes);
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

  void remove_empty()
  {
    Json& meshes = m_document["meshes"];
    // From the back, so that the numbers of those still to be removed stay.
    std::sort(m_empty.begin(), m_empty.end(), [](const Gltf_scene::Part* a, const Gltf_scene::Part* b) {
      return std::make_pair(a->mesh, a->primitive) > std::make_pair(b->mesh, b->primitive);
    });
    for (const Gltf_scene::Part* part : m_empty) {
      Json& primitives = meshes[part->mesh]["primitives"];
      primitives.erase(part->primitive);
      if (!primitives.empty())
        continue;
      meshes.erase(part->mesh);
      for (Json& node : m_document["nodes"]) {
        const auto mesh = node.find("mesh");
        if (mesh == node.end() || *mesh < part->mesh)
          continue;
        if (*mesh > part->mesh)
          *mesh = mesh->get<Index>() - 1;
        else
          for (const char* key : {"mesh", "skin", "weights"})
            node.erase(key);
      }
    }
  }

  // Puts all buffer views into one buffer, each at a multiple of four bytes.
  std::string put_buffer()
  {
    std::string bytes;
    for (std::size_t i = 0; i < m_views.size(); ++i) {
      bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
      Json& view = m_document["bufferViews"][i];
      view["buffer"] = 0;
      view["byteOffset"] = bytes.size();
      bytes += m_views[i];
    }
    Json buffer = m_document.contains("buffers") ? m_document["buffers"][0] : Json::object();
    buffer.erase("uri");
    buffer["byteLength"] = bytes.size();
    m_document["buffers"] = Json::array({std::move(buffer)});
    return bytes;
  }

  const Triangle_soup& m_soup;
  const Gltf_scene& m_scene;
  Json m_document;
  std::vector<std::string> m_views;
  std::vector<Index> m_free_accessors, m_free_views; // the first at the back
  std::vector<Index> m_numbers;                      // by vertex of the soup, in its instance
  std::vector<Json> m_attributes;                    // by instance
  std::vector<std::vector<Json>> m_targets;
  std::vector<std::size_t> m_sizes;
  std::vector<const Gltf_scene::Part*> m_empty;
  std::optional<std::map<std::tuple<Gltf_scene::Matrix, double, double, double>, std::string_view>>
      m_positions;
};

} // namespace

void write_gltf(Byte_writer& out, const Triangle_soup& soup, Mesh_format format)
{
  if (soup.triangles.empty())
    throw Argument_error("a glTF file cannot hold a mesh without triangles; write OBJ, OFF or PLY");
  if (soup.scene)
    return Gltf_writer(soup, *soup.scene).write(out, format);
  const Triangle_soup of_scene = with_gltf_scene(soup);
  Gltf_writer(of_scene, *of_scene.scene).write(out, format);
}

} // namespace selvedge::files
