// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/columns.h"
#include "files/formats.h"
#include "soup/Gltf_scene.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>

// Makes a glTF document for a soup that was not read from one, which `write_gltf` then writes.

namespace selvedge::files {
namespace {

using Json = Gltf_scene::Json;

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

  Triangle_soup make(bool has_poses)
  {
    if (has_poses)
      find_displacements();
    number_vertices();
    make_document();
    if (has_poses)
      make_animation();
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

  // Each makes a node: groups, or objects where there are none.
  const Triangle_labels& parts() const { return m_soup.groups.empty() ? m_soup.objects : m_soup.groups; }

  Vertex vertex(std::size_t t, std::size_t corner) const
  {
    const Kind kind = {parts().empty() ? 0 : parts().of_triangle[t], m_soup.uvs.has(t),
                       m_soup.normals.has(t)};
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
    columns.push_back(empty_column("POSITION", type_float32, 3));
    if (kind.has_normals)
      columns.push_back(empty_column("NORMAL", type_float32, 3));
    if (kind.has_uvs)
      columns.push_back(empty_column("TEXCOORD_0", type_float32, 2));
    if (!m_colours.empty())
      columns.push_back(
          empty_column("COLOR_0", colour_type(), m_colours.size(), colour_type() != type_float32));
    for (std::size_t target = 0; target < m_displacements.size(); ++target) {
      Gltf_scene::Column displacements = empty_column("POSITION", type_float32, 3);
      displacements.is_sparse = true;
      m_scene->blocks.back().targets.push_back({std::move(displacements)});
    }
  }

  // Normalised integers keep their type where glTF has it for colours; all others become floats.
  int colour_type() const
  {
    const auto are_all = [this](Attribute::Type type) {
      return std::all_of(m_colours.begin(), m_colours.end(), [type](const Attribute_component& colour) {
        return colour.attribute->type == type && colour.attribute->is_normalized;
      });
    };
    return are_all(Attribute::Type::uint8)    ? int(type_uint8)
           : are_all(Attribute::Type::uint16) ? int(type_uint16)
                                              : int(type_float32);
  }

  // Returns the number that stands for 1 in the components of colours from `first` up to `end`: 255 where
  // they are from 0 to 255, and some well beyond 1.
  double one_of_colours(std::size_t first, std::size_t end) const
  {
    double least = 0, largest = 0;
    for (std::size_t k = first; k < (std::min)(end, m_colours.size()); ++k)
      for (std::size_t i = 0; i < m_soup.points.size(); ++i)
        if (const double number = m_colours[k].real(i); std::isfinite(number)) {
          least = std::min(least, number);
          largest = std::max(largest, number);
        }
    return least >= 0 && largest > 2 && largest <= 255 ? 255 : 1;
  }

  // Colours in glTF are from 0 to 1. Vertices without a colour are white, like a mesh without colours.
  float fraction_of_colour(std::size_t component, std::size_t vertex) const
  {
    const double number = m_colours[component].real(vertex),
                 one = component < 3 ? m_one_of_rgb : m_one_of_alpha;
    return std::isfinite(number) ? float(std::clamp(number / one, 0., 1.)) : 1;
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
    for (std::size_t target = 0; target < m_displacements.size(); ++target)
      for (const float displacement : m_displacements[target][v.vertex])
        append_little_endian(block.targets[target].front().rows, displacement);
    if (v.kind.has_normals)
      std::apply(put, m_normals.rows[v.normal]);
    if (v.kind.has_uvs)
      std::apply(put, m_uvs.rows[v.uv]);
    for (std::size_t k = 0; k < m_colours.size(); ++k)
      if (next->component_type == type_float32)
        append_little_endian(next->rows, fraction_of_colour(k, v.vertex));
      else
        m_colours[k].with(v.vertex, [&](auto number) {
          if constexpr (sizeof number <= 2)
            append_little_endian(next->rows, number);
        });
  }

  // Finds two displacements for each pose that bring every vertex there; the second is left out where it is
  // zero everywhere.
  void find_displacements()
  {
    using Displacement = std::array<float, 3>;
    for (const Pose& pose : m_soup.poses) {
      std::vector<Displacement> first, rest;
      Cancellation_poll poll;
      for (std::size_t v = 0; v < m_soup.points.size(); ++v) {
        poll();
        first.emplace_back();
        rest.emplace_back();
        for (int axis = 0; axis < 3; ++axis) {
          const double from = m_soup.points[v][axis], to = pose.points[v][axis];
          first.back()[std::size_t(axis)] = float(to - from);
          const double near = from + double(first.back()[std::size_t(axis)]);
          rest.back()[std::size_t(axis)] = float(to - near);
          if (near + double(rest.back()[std::size_t(axis)]) != to)
            throw Argument_error(
                "vertex " + std::to_string(v) + " (counted from 0) lies in pose '" + pose.name +
                "' where no two 32-bit displacements bring it; write each pose to a file of its "
                "own");
        }
      }
      m_keys.push_back({m_displacements.size()});
      m_target_names.push_back(pose.name);
      m_displacements.push_back(std::move(first));
      if (std::all_of(rest.begin(), rest.end(), [](const Displacement& d) { return d == Displacement{}; }))
        continue;
      m_keys.back().push_back(m_displacements.size());
      m_target_names.push_back(pose.name + " (rest)");
      m_displacements.push_back(std::move(rest));
    }
  }

  // Returns the number of an accessor of numbers that are no part of a mesh.
  std::size_t add_accessor(const std::vector<float>& numbers)
  {
    std::string bytes;
    for (const float number : numbers)
      append_little_endian(bytes, number);
    Json& document = m_scene->document;
    document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
    const auto [least, largest] = std::minmax_element(numbers.begin(), numbers.end());
    document["accessors"].push_back({{"bufferView", m_scene->views.size()},
                                     {"componentType", int(type_float32)},
                                     {"count", numbers.size()},
                                     {"type", "SCALAR"},
                                     {"min", {*least}},
                                     {"max", {*largest}}});
    m_scene->views.push_back(std::move(bytes));
    return document["accessors"].size() - 1;
  }

  // Shows one pose after another.
  void make_animation()
  {
    constexpr float per_second = 24;
    std::vector<float> times, weights;
    for (const Pose& pose : m_soup.poses)
      times.push_back(pose.time);
    const bool do_rise =
        times.front() >= 0 && std::adjacent_find(times.begin(), times.end(),
                                                 [](float a, float b) { return !(a < b); }) == times.end();
    for (std::size_t key = 0; key < m_keys.size(); ++key) {
      if (!do_rise)
        times[key] = float(key) / per_second;
      std::vector<float> at_key(m_displacements.size(), 0.f);
      for (const std::size_t target : m_keys[key])
        at_key[target] = 1;
      weights.insert(weights.end(), at_key.begin(), at_key.end());
    }
    Json& document = m_scene->document;
    Json animation = {{"name", "poses"}, {"channels", Json::array()}};
    animation["samplers"] = {
        {{"input", add_accessor(times)}, {"interpolation", "STEP"}, {"output", add_accessor(weights)}}};
    for (std::size_t node = 0; node < document["nodes"].size(); ++node) // each has a mesh of its own
      animation["channels"].push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
    for (Json& mesh : document["meshes"])
      mesh["extras"]["targetNames"] = m_target_names;
    document["animations"] = Json::array({std::move(animation)});
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
    std::map<std::pair<Kind, int>, Index> primitives_of;
    const auto part_of = [&](std::size_t t) {
      return std::make_pair(vertex(t, 0).kind,
                            m_soup.materials.empty() ? -1 : materials[m_soup.materials.of_triangle[t]]);
    };
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t)
      primitives_of.emplace(part_of(t), 0);
    Index group = 0;
    for (auto& [part, number] : primitives_of) {
      const auto& [kind, material] = part;
      Json& meshes = document["meshes"];
      if (meshes.empty() || kind.group != group) {
        const std::string name = parts().empty() ? "" : parts().names[kind.group];
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
      const Index mesh = Index(meshes.size() - 1);
      m_scene->parts.push_back({mesh, mesh, mesh, Index(primitives.size()), instance, 0, Json::object()});
      m_result.groups.names.push_back(std::to_string(number));
      primitives.push_back({{"attributes", Json::object()}});
      if (material >= 0)
        primitives.back()["material"] = material;
    }
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t)
      m_result.groups.of_triangle.push_back(primitives_of.at(part_of(t)));
  }

  const Triangle_soup& m_soup;
  std::shared_ptr<Gltf_scene> m_scene;
  Triangle_soup m_result;
  std::vector<Kind> m_kinds; // of instances, in order
  std::vector<Attribute_component> m_colours;
  // Some programs count colours from 0 to 255, and alpha from 0 to 1.
  double m_one_of_rgb = one_of_colours(0, 3), m_one_of_alpha = one_of_colours(3, 4);
  std::vector<std::vector<std::array<float, 3>>> m_displacements; // of vertices, by target
  std::vector<std::string> m_target_names;
  std::vector<std::vector<std::size_t>> m_keys; // targets of each pose
  Rows<2> m_uvs;
  Rows<3> m_normals;
};

} // namespace

const std::vector<std::string>& only_in_gltf(const Gltf_scene& scene)
{
  return scene.only_in_gltf;
}

Triangle_soup with_gltf_scene(const Triangle_soup& soup, bool has_poses)
{
  for (const auto& uv : soup.uvs.values)
    for (const double coordinate : uv)
      if (!(std::abs(coordinate) <= double(std::numeric_limits<float>::max())))
        throw Argument_error("texture coordinate " + std::to_string(&uv - soup.uvs.values.data()) +
                             " (counted from 0) is beyond the range of 32-bit floats, which glTF holds");
  return New_scene(soup).make(has_poses);
}

} // namespace selvedge::files
