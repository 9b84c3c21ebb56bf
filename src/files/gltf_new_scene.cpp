// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/columns.h"
#include "files/formats.h"
#include "soup/Gltf_scene.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>

// Makes a glTF document for a soup that was not read from one, which `write_gltf` then writes.

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;

Gltf_scene::Column column(const std::string& name, int component_type, std::size_t components,
                          bool is_normalized = false)
{
  Gltf_scene::Column result;
  result.name = name;
  result.component_type = component_type;
  result.components = components;
  result.row_size = components * component_size(component_type);
  result.accessor = {{"componentType", component_type}};
  if (is_normalized)
    result.accessor["normalized"] = true;
  result.accessor["type"] = "VEC" + std::to_string(components);
  return result;
}

/// Values as they will be written, and for each the number of the first equal one: some files repeat a value
/// at every corner that has it.
template <std::size_t dimension>
struct Rows
{
  using Row = std::array<float, dimension>;

  template <class Round>
  Rows(const Corner_values<dimension>& values, const Round& round)
  {
    std::map<Row, Index> first;
    Cancellation_poll poll;
    for (const auto& value : values.values) {
      poll();
      rows.push_back(round(value));
      numbers.push_back(first.emplace(rows.back(), Index(numbers.size())).first->second);
    }
  }

  std::vector<Row> rows;
  std::vector<Index> numbers;
};

class New_scene
{
public:
  explicit New_scene(const Triangle_soup& soup)
      : m_soup(soup), m_scene(std::make_shared<Gltf_scene>()),
        m_colours(find_colours(soup.vertex_attributes)),
        // The second texture coordinate points down in glTF, up in other formats.
        m_uvs(soup.uvs,
              [](const auto& uv) {
                return std::array<float, 2>{float(uv[0]), float(1 - uv[1])};
              }),
        m_normals(soup.normals, [](const auto& n) {
          return std::array<float, 3>{float(n[0]), float(n[1]), float(n[2])};
        })
  {
  }

  Triangle_soup make()
  {
    number_vertices();
    make_document();
    m_result.scene = m_scene;
    return std::move(m_result);
  }

private:
  // Triangles of one kind share vertices: those of a group whose corners have the same kinds of values.
  struct Kind
  {
    Index group;
    bool has_uvs;
    bool has_normals;

    std::tuple<Index, bool, bool> key() const { return {group, has_uvs, has_normals}; }
    bool operator<(const Kind& other) const { return key() < other.key(); }
    bool operator==(const Kind& other) const { return key() == other.key(); }
  };

  struct Vertex
  {
    Kind kind;
    Index vertex, uv, normal;

    auto key() const { return std::make_tuple(kind.key(), vertex, uv, normal); }
    bool operator<(const Vertex& other) const { return key() < other.key(); }
    bool operator==(const Vertex& other) const { return key() == other.key(); }
  };

  template <std::size_t dimension>
  static bool has_value(const Corner_values<dimension>& values, std::size_t triangle)
  {
    return !values.empty() && values.of_triangle[triangle][0] != values.missing;
  }

  Vertex vertex(std::size_t t, std::size_t corner) const
  {
    const Kind kind = {m_soup.groups.empty() ? 0 : m_soup.groups.of_triangle[t], has_value(m_soup.uvs, t),
                       has_value(m_soup.normals, t)};
    return {kind, m_soup.triangles[t][corner],
            kind.has_uvs ? m_uvs.numbers[m_soup.uvs.of_triangle[t][corner]] : 0,
            kind.has_normals ? m_normals.numbers[m_soup.normals.of_triangle[t][corner]] : 0};
  }

  void number_vertices()
  {
    std::vector<Vertex> vertices;
    vertices.reserve(3 * m_soup.triangles.size());
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t)
      for (std::size_t corner = 0; corner < 3; ++corner)
        vertices.push_back(vertex(t, corner));
    Cancellation_scope::check();
    std::sort(vertices.begin(), vertices.end());
    Cancellation_scope::check();
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Cancellation_poll poll;
    for (const Vertex& v : vertices) {
      poll();
      if (m_kinds.empty() || !(m_kinds.back() == v.kind))
        begin_block(v.kind);
      add(v);
    }
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t) {
      poll();
      Index_triple& triangle = m_result.triangles.emplace_back();
      for (std::size_t corner = 0; corner < 3; ++corner)
        triangle[corner] =
            Index(std::lower_bound(vertices.begin(), vertices.end(), vertex(t, corner)) - vertices.begin());
    }
    m_result.scene_vertices.resize(vertices.size());
    std::iota(m_result.scene_vertices.begin(), m_result.scene_vertices.end(), Index(0));
  }

  void begin_block(const Kind& kind)
  {
    m_kinds.push_back(kind);
    m_scene->instances.push_back(
        {Index(m_scene->blocks.size()), Index(m_result.points.size()), identity_matrix, false});
    std::vector<Gltf_scene::Column>& columns = m_scene->blocks.emplace_back().attributes;
    columns.push_back(column("POSITION", type_float32, 3));
    if (kind.has_normals)
      columns.push_back(column("NORMAL", type_float32, 3));
    if (kind.has_uvs)
      columns.push_back(column("TEXCOORD_0", type_float32, 2));
    if (!m_colours.empty())
      columns.push_back(column("COLOR_0", colour_type(), m_colours.size(), colour_type() != type_float32));
  }

  // Normalised integers keep their type where glTF has it for colours; all others become floats.
  int colour_type() const
  {
    const auto are_all = [this](Attribute::Type type) {
      return std::all_of(m_colours.begin(), m_colours.end(), [type](const Column& colour) {
        return colour.attribute->type == type && colour.attribute->is_normalized;
      });
    };
    return are_all(Attribute::Type::uint8)    ? int(type_uint8)
           : are_all(Attribute::Type::uint16) ? int(type_uint16)
                                              : int(type_float32);
  }

  void add(const Vertex& v)
  {
    const Point_3& point = m_soup.points[v.vertex];
    m_result.points.push_back(point);
    Gltf_scene::Block& block = m_scene->blocks.back();
    ++block.size;
    auto next = block.attributes.begin();
    const auto put = [&](auto... values) {
      (append_little_endian(next->rows, static_cast<float>(values)), ...);
      ++next;
    };
    put(point.x(), point.y(), point.z());
    if (v.kind.has_normals)
      std::apply(put, m_normals.rows[v.normal]);
    if (v.kind.has_uvs)
      std::apply(put, m_uvs.rows[v.uv]);
    for (const Column& colour : m_colours)
      if (next->component_type == type_float32)
        // Vertices without a colour are white, like a mesh without colours.
        append_little_endian(
            next->rows, static_cast<float>(std::isfinite(colour.real(v.vertex)) ? colour.real(v.vertex) : 1));
      else
        colour.with(v.vertex, [&](auto number) {
          if constexpr (sizeof number <= 2)
            append_little_endian(next->rows, number);
        });
  }

  void make_document()
  {
    Json& document = m_scene->document;
    document = {{"asset", {{"version", "2.0"}, {"generator", "Selvedge"}}},
                {"scene", 0},
                {"scenes", {{{"nodes", Json::array()}}}}};
    document["nodes"] = document["meshes"] = Json::array();
    // Materials are numbered as in the soup, without the one that stands for none.
    std::vector<int> materials;
    for (const std::string& name :
         m_soup.materials.empty() ? std::vector<std::string>() : m_soup.materials.names) {
      materials.push_back(name.empty() ? -1 : int(document["materials"].size()));
      if (!name.empty())
        document["materials"].push_back({{"name", name}});
    }
    std::map<std::pair<Kind, int>, Index> parts;
    const auto part_of = [&](std::size_t t) {
      return std::make_pair(vertex(t, 0).kind,
                            m_soup.materials.empty() ? -1 : materials[m_soup.materials.of_triangle[t]]);
    };
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t)
      parts.emplace(part_of(t), 0);
    Index group = 0;
    for (auto& [part, number] : parts) {
      const auto& [kind, material] = part;
      Json& meshes = document["meshes"];
      if (meshes.empty() || kind.group != group) {
        const std::string name = m_soup.groups.empty() ? "" : m_soup.groups.names[kind.group];
        const Json named = name.empty() ? Json::object() : Json{{"name", name}};
        document["scenes"][0]["nodes"].push_back(meshes.size());
        document["nodes"].push_back(named);
        document["nodes"].back()["mesh"] = meshes.size();
        meshes.push_back(named);
      }
      group = kind.group;
      Json& primitives = meshes.back()["primitives"];
      number = Index(m_scene->parts.size());
      const Index instance = Index(std::lower_bound(m_kinds.begin(), m_kinds.end(), kind) - m_kinds.begin());
      m_scene->parts.push_back({Index(meshes.size() - 1), Index(meshes.size() - 1), Index(primitives.size()),
                                instance, 0, Json::object()});
      m_result.groups.names.push_back(std::to_string(number));
      primitives.push_back({{"attributes", Json::object()}});
      if (material >= 0)
        primitives.back()["material"] = material;
    }
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t)
      m_result.groups.of_triangle.push_back(parts.at(part_of(t)));
  }

  const Triangle_soup& m_soup;
  std::shared_ptr<Gltf_scene> m_scene;
  Triangle_soup m_result;
  std::vector<Kind> m_kinds; // of instances, in order
  std::vector<Column> m_colours;
  Rows<2> m_uvs;
  Rows<3> m_normals;
};

} // namespace

const std::vector<std::string>& only_in_gltf(const Gltf_scene& scene)
{
  return scene.only_in_gltf;
}

Triangle_soup with_gltf_scene(const Triangle_soup& soup)
{
  return New_scene(soup).make();
}

} // namespace selvedge::files
