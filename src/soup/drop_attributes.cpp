// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/attributes.h>

#include "Gltf_scene.h"
#include "flat_shading.h"
#include "material_textures.h"
#include "near_normals.h"
#include "poles.h"
#include "selection.h"
#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/normals.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <unordered_map>
#include <utility>

namespace selvedge {
namespace {

using Json = Gltf_scene::Json;

constexpr Index s_none = std::numeric_limits<Index>::max();
constexpr Index s_several = s_none - 1;

// Whether a name asks for an attribute. In a scene, only sets of texture coordinates have tangents.
bool means(const std::string& name, const std::string& attribute)
{
  if (name == "texture")
    return begins_with(attribute, "TEXCOORD_") || attribute == "TANGENT";
  if (name == "colors")
    return begins_with(attribute, "COLOR_") || attribute == "red" || attribute == "green" ||
           attribute == "blue" || attribute == "alpha";
  return name == attribute;
}

// Whether an attribute cannot be left out alone.
bool is_needed(const std::string& attribute)
{
  return attribute == "POSITION" || attribute == "NORMAL" || begins_with(attribute, "JOINTS_") ||
         begins_with(attribute, "WEIGHTS_");
}

class Attribute_dropper
{
public:
  Attribute_dropper(Triangle_soup& soup, const std::vector<std::string>& names)
      : m_soup(soup), m_names(names), m_are_uvs_dropped(is_dropped("TEXCOORD_0"))
  {
    for (const std::string& name : names)
      require(name);
  }

  std::size_t drop()
  {
    const std::vector<Index_triple> before = m_soup.triangles;
    separate_poles(m_soup);
    share_vertices();
    for (auto* attributes : {&m_soup.vertex_attributes, &m_soup.triangle_attributes})
      attributes->erase(
          std::remove_if(attributes->begin(), attributes->end(),
                         [&](const Attribute& attribute) { return is_dropped(attribute.name); }),
          attributes->end());
    if (m_are_uvs_dropped)
      m_soup.uvs = {};
    if (m_soup.scene) {
      drop_in_scene();
      share_split_vertices(m_soup); // those whose normals differ in the last digits alone
      share_poles(m_soup);
    }
    return corners_changed(before, m_soup.triangles);
  }

private:
  bool is_dropped(const std::string& attribute) const
  {
    return std::any_of(m_names.begin(), m_names.end(),
                       [&](const std::string& name) { return means(name, attribute); });
  }

  std::set<std::string> attributes() const
  {
    std::set<std::string> result;
    for (const auto* attributes : {&m_soup.vertex_attributes, &m_soup.triangle_attributes})
      for (const Attribute& attribute : *attributes)
        result.insert(attribute.name);
    if (m_soup.scene)
      for (const Gltf_scene::Block& block : m_soup.scene->blocks)
        for (const Gltf_scene::Column& column : block.attributes)
          result.insert(column.name);
    return result;
  }

  void require(const std::string& name) const
  {
    if (is_needed(name))
      throw Argument_error(
          "attribute '" + name + "' cannot be left out alone: " +
          (name == "NORMAL" ? "normals are dropped by --normals drop" : "positions and skins need it"));
    const std::set<std::string> all = attributes();
    const bool is_here =
        std::any_of(all.begin(), all.end(), [&](const std::string& one) { return means(name, one); }) ||
        (name == "texture" && !m_soup.uvs.empty());
    if (is_here) {
      if (m_soup.scene)
        require_sets_without_gap(name, all);
      return;
    }
    std::string here = m_soup.uvs.empty() ? "" : "texture";
    for (const std::string& one : all)
      if (!is_needed(one))
        here += (here.empty() ? "" : ", ") + one;
    throw Input_error("the mesh has no attribute '" + name + "' to leave out; " +
                      (here.empty() ? "it has none" : "it has " + here));
  }

  // glTF numbers sets of texture coordinates, and of colours, from 0 without a gap.
  void require_sets_without_gap(const std::string& name, const std::set<std::string>& all) const
  {
    for (const char* kind : {"TEXCOORD_", "COLOR_"})
      for (const std::string& one : all)
        if (begins_with(name, kind) && begins_with(one, kind) && !is_dropped(one) &&
            std::make_pair(one.size(), one) > std::make_pair(name.size(), name))
          throw Argument_error("attribute '" + name + "' cannot be left out without '" + one +
                               "': glTF numbers sets without a gap; leave out both");
  }

  // Returns the number of the value that all corners of a vertex have, or the first of values that are all
  // alike; or `s_several`.
  template <std::size_t dimension, class Are_alike>
  std::vector<Index> values_of_vertices(const Corner_values<dimension>& values,
                                        const Are_alike& are_alike) const
  {
    std::vector<Index> result(values.empty() ? 0 : m_soup.points.size(), s_none);
    for (std::size_t t = 0; t < values.of_triangle.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        Index& of_vertex = result[m_soup.triangles[t][k]];
        const Index value = values.of_triangle[t][k];
        if (of_vertex == s_none)
          of_vertex = value;
        else if (of_vertex != s_several && of_vertex != value && !are_alike(of_vertex, value))
          of_vertex = s_several;
      }
    return result;
  }

  void share_vertices()
  {
    const auto are_never = [](Index, Index) { return false; };
    // Several that are nearly alike are left at vertices that `share_split_vertices` has joined. Of vertices
    // that it has joined because they shade flat, those with one normal are such as have level faces alone.
    std::vector<Index> normals;
    if (!has_flat_normals(m_soup))
      normals = values_of_vertices(m_soup.normals, [this](Index a, Index b) {
        return m_soup.scene && are_near_normals(m_soup.normals.values[a], m_soup.normals.values[b]);
      });
    // Where corners have numbers of their own, as in OBJ, several vertices at one place mean something.
    std::vector<Index> uvs;
    if (m_soup.scene || are_numbered_like_vertices(m_soup.uvs, m_soup))
      uvs = values_of_vertices(m_soup.uvs, are_never);
    struct Shared_vertex
    {
      Index first;
      std::string dropped;
    };
    std::unordered_map<std::string, Shared_vertex> vertices; // by the bytes that stay
    const std::vector<char> is_used = are_used(m_soup);
    const bool have_faces_own =
        have_faces_own_vertices(m_soup.triangles.size(), count_of_used_vertices(m_soup));
    std::vector<Index> first(m_soup.points.size(), s_none);
    std::vector<char> is_shared(m_soup.points.size(), have_faces_own); // by first vertex
    Cancellation_poll poll;
    for (Index v = 0; v < m_soup.points.size(); ++v) {
      poll();
      if (!is_used[v])
        continue;
      std::string kept, dropped;
      append_vertex(v, uvs, normals, kept, dropped);
      const Shared_vertex& found = vertices.emplace(std::move(kept), Shared_vertex{v, dropped}).first->second;
      first[v] = found.first;
      is_shared[first[v]] |= found.dropped != dropped;
    }
    for (std::size_t t = 0; t < m_soup.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        Index& v = m_soup.triangles[t][k];
        if (first[v] == v || !is_shared[first[v]])
          continue;
        v = first[v];
        if (!uvs.empty() && uvs[v] != s_several)
          m_soup.uvs.of_triangle[t][k] = uvs[v];
        if (normals.empty() || normals[v] == s_several)
          continue;
        Index& normal = m_soup.normals.of_triangle[t][k];
        if (have_same_bits(m_soup.normals.values[normal], m_soup.normals.values[normals[v]]))
          normal = normals[v];
      }
  }

  void append_vertex(Index v, const std::vector<Index>& uvs, const std::vector<Index>& normals,
                     std::string& kept, std::string& dropped) const
  {
    const auto append = [](std::string& to, const auto& value) {
      to.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    const auto append_point = [&](const Point_3& point) {
      for (int i = 0; i < 3; ++i)
        append(kept, point[i] == 0 ? 0.0 : point[i]);
    };
    append_point(m_soup.points[v]);
    for (const Pose& pose : m_soup.poses)
      append_point(pose.points[v]);
    if (!normals.empty() && normals[v] != s_several)
      append(kept, m_soup.normals.values[normals[v]]);
    if (!uvs.empty() && uvs[v] != s_several)
      append(m_are_uvs_dropped ? dropped : kept, m_soup.uvs.values[uvs[v]]);
    if (!m_soup.scene) {
      for (const Attribute& attribute : m_soup.vertex_attributes) {
        const std::size_t size = row_size(attribute);
        (is_dropped(attribute.name) ? dropped : kept)
            .append(reinterpret_cast<const char*>(attribute.rows.data()) + v * size, size);
      }
      return;
    }
    const std::size_t number = m_soup.scene->instance_of(m_soup.scene_vertices[v]);
    append(kept, number);
    const Gltf_scene::Instance& instance = m_soup.scene->instances[number];
    const Gltf_scene::Block& block = m_soup.scene->blocks[instance.block];
    const std::size_t row = m_soup.scene_vertices[v] - instance.first;
    for (const Gltf_scene::Column& column : block.attributes)
      if (column.name != "POSITION" && column.name != "NORMAL") // which are above
        (is_dropped(column.name) ? dropped : kept) += column.row(row);
    for (const std::vector<Gltf_scene::Column>& target : block.targets)
      for (const Gltf_scene::Column& column : target)
        (is_dropped(column.name) ? dropped : kept) += column.row(row);
  }

  void drop_in_scene()
  {
    auto scene = std::make_shared<Gltf_scene>(*m_soup.scene);
    const auto drop_columns = [&](std::vector<Gltf_scene::Column>& columns) {
      columns.erase(std::remove_if(columns.begin(), columns.end(),
                                   [&](const Gltf_scene::Column& column) { return is_dropped(column.name); }),
                    columns.end());
    };
    for (Gltf_scene::Block& block : scene->blocks) {
      drop_columns(block.attributes);
      for (std::vector<Gltf_scene::Column>& target : block.targets)
        drop_columns(target);
    }
    const auto drop_members = [&](Json& attributes) {
      for (auto member = attributes.begin(); member != attributes.end();)
        member = is_dropped(member.key()) ? attributes.erase(member) : std::next(member);
    };
    for (const Gltf_scene::Part& part : scene->parts) {
      Json& primitive = scene->document["meshes"][part.mesh]["primitives"][part.primitive];
      drop_members(primitive["attributes"]);
      if (primitive.contains("targets"))
        for (Json& target : primitive["targets"])
          drop_members(target);
    }
    auto& names = scene->only_in_gltf; // such as "COLOR_1, which not every vertex has"
    names.erase(
        std::remove_if(names.begin(), names.end(),
                       [&](const std::string& name) { return is_dropped(name.substr(0, name.find(','))); }),
        names.end());
    drop_textures(*scene, [&](const std::string& set) { return is_dropped(set); });
    m_soup.scene = std::move(scene);
  }

  Triangle_soup& m_soup;
  const std::vector<std::string>& m_names;
  bool m_are_uvs_dropped;
};

} // namespace

std::string name_to_drop(const std::string& attribute)
{
  const bool is_of_targets = attribute.find(" of morph targets") != std::string::npos;
  return is_needed(attribute) || is_of_targets      ? ""
         : means("colors", attribute)               ? "colors"
         : attribute == further_texture_coordinates ? "texture"
                                                    : attribute;
}

std::size_t drop_attributes(Triangle_soup& soup, const std::vector<std::string>& names)
{
  return names.empty() ? 0 : Attribute_dropper(soup, names).drop();
}

} // namespace selvedge
