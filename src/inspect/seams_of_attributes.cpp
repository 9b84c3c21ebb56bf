// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/inspect.h>

#include "soup/Gltf_scene.h"
#include "soup/inner_edges.h"
#include "soup/selection.h"

#include <cstring>
#include <initializer_list>
#include <set>
#include <utility>

namespace selvedge {
namespace {

template <class Values>
bool is_seam_of(const Values& values, Index a, Index b)
{
  return !values.empty() &&
         values.values[values.of_triangle[a / 3][a % 3]] != values.values[values.of_triangle[b / 3][b % 3]];
}

bool is_seam_of(const Triangle_labels& labels, Index a, Index b)
{
  return !labels.empty() && labels.of_triangle[a / 3] != labels.of_triangle[b / 3];
}

// Adds the names of the attributes that differ between two vertices, apart from those that corners have.
void add_differences(const Triangle_soup& soup, Index a, Index b, std::set<std::string>& names)
{
  if (!soup.scene) {
    for (const Attribute& attribute : soup.vertex_attributes) {
      const std::size_t size = row_size(attribute);
      if (std::memcmp(attribute.rows.data() + a * size, attribute.rows.data() + b * size, size) != 0)
        names.insert(attribute.name);
    }
    return;
  }
  const Gltf_scene& scene = *soup.scene;
  const std::size_t number = scene.instance_of(soup.scene_vertices[a]);
  if (scene.instance_of(soup.scene_vertices[b]) != number)
    return;
  const Gltf_scene::Instance& instance = scene.instances[number];
  const Gltf_scene::Block& block = scene.blocks[instance.block];
  const auto is_different = [&](const Gltf_scene::Column& column) {
    return column.row(soup.scene_vertices[a] - instance.first) !=
           column.row(soup.scene_vertices[b] - instance.first);
  };
  for (const Gltf_scene::Column& column : block.attributes)
    if (column.name != "POSITION" && column.name != "NORMAL" && column.name != "TEXCOORD_0" &&
        is_different(column))
      names.insert(column.name);
  for (const std::vector<Gltf_scene::Column>& target : block.targets)
    for (const Gltf_scene::Column& column : target)
      if (is_different(column))
        names.insert(column.name + " of morph targets");
}

} // namespace

std::map<std::string, std::size_t> seams_of_attributes(const Triangle_soup& soup,
                                                       const std::vector<Index>& positions)
{
  if (!soup.scene && soup.vertex_attributes.empty() && soup.uvs.empty())
    return {};
  std::vector<Index_triple> triangles = soup.triangles; // of positions
  for (Index_triple& triangle : triangles)
    for (Index& v : triangle)
      v = positions[v];
  std::map<std::string, std::size_t> result;
  internal::for_each_inner_edge(triangles, [&](const internal::Edge_side& a, const internal::Edge_side& b) {
    std::set<std::string> names;
    for (const auto& [c, d] : {std::pair(a.at_low, b.at_low), std::pair(a.at_high, b.at_high)}) {
      if (is_seam_of(soup.normals, c, d) || is_seam_of(soup.groups, c, d) || is_seam_of(soup.objects, c, d) ||
          is_seam_of(soup.materials, c, d))
        return;
      if (is_seam_of(soup.uvs, c, d))
        names.insert("texture");
      add_differences(soup, soup.triangles[c / 3][c % 3], soup.triangles[d / 3][d % 3], names);
    }
    for (const std::string& name : names)
      ++result[name];
  });
  return result;
}

} // namespace selvedge
