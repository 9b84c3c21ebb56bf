// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/inspect.h>

#include <selvedge/attributes.h>

#include "soup/Gltf_scene.h"
#include "soup/inner_edges.h"
#include "soup/number_positions.h"
#include "soup/regions.h"
#include "soup/selection.h"

#include <algorithm>
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

bool differ(const Attribute& attribute, Index a, Index b)
{
  return row_of(attribute, a) != row_of(attribute, b);
}

// Adds the names of the attributes that differ between two vertices, apart from those that corners have.
void add_differences(const Triangle_soup& soup, Index a, Index b, std::set<std::string>& names)
{
  if (!soup.scene) {
    for (const Attribute& attribute : soup.vertex_attributes)
      if (differ(attribute, a, b))
        names.insert(attribute.name);
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

// Of the attributes that differ across an edge, returns those that can be left out such that none differs any
// more: one alone, or several that go together.
std::set<std::string> sole_causes(const std::set<std::string>& names)
{
  const auto are_all = [&](const auto& property) {
    return std::all_of(names.begin(), names.end(), property);
  };
  if (names.size() < 2 || are_all([](const std::string& name) { return name_to_drop(name) == "colors"; }))
    return names;
  const bool are_of_texture = are_all([](const std::string& name) {
    return name == "texture" || name == "TANGENT" || name.rfind("TEXCOORD_", 0) == 0;
  });
  if (!are_of_texture)
    return {};
  return {names.count("texture") > 0 ? "texture" : further_texture_coordinates};
}

} // namespace

std::map<std::string, std::size_t> seams_of_attributes(const Prepared_soup& prepared)
{
  const Triangle_soup& soup = prepared.soup;
  if (!soup.scene && soup.vertex_attributes.empty() && soup.triangle_attributes.empty() && soup.uvs.empty())
    return {};
  // With doubles, no edge would be one of two triangles.
  const Fronts without_doubles = fronts_in_positions(soup.triangles, prepared.positions, prepared.fronts);
  const std::vector<Index>& fronts = without_doubles.numbers;
  const std::vector<Index_triple>& triangles = without_doubles.triangles;
  std::vector<const Attribute*> of_regions;
  if (!soup.triangle_attributes.empty())
    of_regions = attributes_of_regions(soup, number_positions(soup.points));
  const auto corner = [&](Index c) { return 3 * fronts[c / 3] + c % 3; };
  std::map<std::string, std::size_t> result;
  internal::for_each_inner_edge(triangles, [&](const internal::Edge_side& a, const internal::Edge_side& b) {
    std::set<std::string> names;
    for (const Attribute* const attribute : of_regions)
      if (differ(*attribute, fronts[a.at_low / 3], fronts[b.at_low / 3]))
        names.insert(attribute->name);
    for (const auto& [c, d] :
         {std::pair(corner(a.at_low), corner(b.at_low)), std::pair(corner(a.at_high), corner(b.at_high))}) {
      if (is_seam_of(soup.normals, c, d) || is_seam_of(soup.groups, c, d) || is_seam_of(soup.objects, c, d) ||
          is_seam_of(soup.materials, c, d))
        return;
      if (is_seam_of(soup.uvs, c, d))
        names.insert("texture");
      add_differences(soup, soup.triangles[c / 3][c % 3], soup.triangles[d / 3][d % 3], names);
    }
    for (const std::string& name : sole_causes(names))
      ++result[name];
  });
  return result;
}

} // namespace selvedge
