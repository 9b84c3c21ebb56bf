// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Gltf_scene.h"

#include "transforms_of_vertices.h"
#include "with_number.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>

// What all who handle vertices of a glTF scene share: the numbers in columns.

namespace selvedge {

std::size_t Gltf_scene::instance_of(Index scene_vertex) const
{
  const auto beyond =
      std::upper_bound(instances.begin(), instances.end(), scene_vertex,
                       [](Index v, const Gltf_scene::Instance& instance) { return v < instance.first; });
  return std::size_t(beyond - instances.begin()) - 1;
}

double Gltf_scene::Column::nearest_quantised(double number, std::size_t component) const
{
  if (quantised_accessor) {
    const bool is_fraction = quantised_accessor->value("normalized", false);
    return with_number(attribute_type((*quantised_accessor)["componentType"]), [&](auto zero) {
      using Limits = std::numeric_limits<decltype(zero)>;
      const double most = double(Limits::max()), unit = is_fraction ? most : 1,
                   least = std::max(double(Limits::lowest()), is_fraction ? -most : double(Limits::lowest()));
      return double(float(std::clamp(std::round(number * unit), least, most) / unit + 0.)); // not -0
    });
  }
  if (!compression || !compression->quantisation || compression->quantisation->origin.empty())
    return number;
  const Compression::Quantisation& quantisation = *compression->quantisation;
  if (!(quantisation.range > 0))
    return quantisation.origin[component];
  const double step = quantisation.step_at(number, component);
  return quantisation.number_at(std::clamp(step, 0., double(quantisation.steps())), component);
}

std::size_t component_size(int component_type)
{
  switch (component_type) {
  case type_int8:
  case type_uint8:
    return 1;
  case type_int16:
  case type_uint16:
    return 2;
  case type_uint32:
  case type_float32:
    return 4;
  default:
    return 0;
  }
}

Gltf_scene::Column empty_column(const std::string& name, int component_type, std::size_t components,
                                bool is_normalized)
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

Attribute::Type attribute_type(int component_type)
{
  switch (component_type) {
  case type_int8:
    return Attribute::Type::int8;
  case type_uint8:
    return Attribute::Type::uint8;
  case type_int16:
    return Attribute::Type::int16;
  case type_uint16:
    return Attribute::Type::uint16;
  case type_uint32:
    return Attribute::Type::uint32;
  default:
    return Attribute::Type::float32;
  }
}

Row_bytes bytes_of_row(const Gltf_scene::Block& block, std::size_t row)
{
  Row_bytes result;
  for (const Gltf_scene::Column& column : block.attributes) {
    const std::string_view bytes = column.row(row);
    if (column.name == "TANGENT" && column.components == 4) {
      const std::size_t direction = bytes.size() / 4 * 3;
      result.tangent += bytes.substr(0, direction);
      result.side += bytes.substr(direction);
    } else if (column.name != "NORMAL") {
      result.others += bytes;
    }
  }
  for (const std::vector<Gltf_scene::Column>& target : block.targets)
    for (const Gltf_scene::Column& column : target)
      (column.name == "NORMAL" || column.name == "TANGENT" ? result.targets : result.others) +=
          column.row(row);
  return result;
}

double component(const Gltf_scene::Column& column, std::size_t row, std::size_t place)
{
  return with_number(attribute_type(column.component_type), [&](auto number) {
    std::memcpy(&number, column.rows.data() + row * column.row_size + place * sizeof number, sizeof number);
    return double(number);
  });
}

double normalised(const Gltf_scene::Column& column, std::size_t row, std::size_t place)
{
  const double number = component(column, row, place);
  if (!column.is_normalized() || column.component_type == type_float32)
    return number;
  return with_number(attribute_type(column.component_type), [&](auto zero) {
    return std::max(number / double(std::numeric_limits<decltype(zero)>::max()), -1.0);
  });
}

double fraction(Attribute::Type type, double number)
{
  switch (type) {
  case Attribute::Type::uint8:
    return number / 255;
  case Attribute::Type::uint16:
    return number / 65535;
  default:
    return number;
  }
}

std::array<double, 2> texture_coordinates(const Gltf_scene::Column& column, std::size_t row)
{
  const auto at = [&](std::size_t place) {
    return fraction(attribute_type(column.component_type), component(column, row, place));
  };
  return {at(0), 1 - at(1)};
}

std::vector<Index> transforms_of_vertices(const Triangle_soup& soup)
{
  if (!soup.scene)
    return {};
  const Gltf_scene& scene = *soup.scene;
  std::map<Gltf_scene::Matrix, Index> numbers;
  std::vector<Index> of_scene_vertex;
  for (const Gltf_scene::Instance& instance : scene.instances)
    of_scene_vertex.resize(of_scene_vertex.size() + scene.blocks[instance.block].size,
                           numbers.emplace(instance.to_world, Index(numbers.size())).first->second);
  std::vector<Index> result;
  result.reserve(soup.points.size());
  for (const Index v : soup.scene_vertices)
    result.push_back(of_scene_vertex[v]);
  return result;
}

bool may_part(const Triangle_soup& soup, Index a, Index b)
{
  if (!soup.scene || a == b)
    return false;
  const Gltf_scene& scene = *soup.scene;
  const std::size_t number = scene.instance_of(soup.scene_vertices[a]);
  if (scene.instance_of(soup.scene_vertices[b]) != number)
    return true; // their nodes may move
  const Gltf_scene::Instance& instance = scene.instances[number];
  const Gltf_scene::Block& block = scene.blocks[instance.block];
  const auto differ = [&](const Gltf_scene::Column& column) {
    return column.row(soup.scene_vertices[a] - instance.first) !=
           column.row(soup.scene_vertices[b] - instance.first);
  };
  const auto is_of_skin = [](const Gltf_scene::Column& column) {
    return begins_with(column.name, "JOINTS_") || begins_with(column.name, "WEIGHTS_");
  };
  for (const Gltf_scene::Column& column : block.attributes)
    if (is_of_skin(column) && differ(column))
      return true;
  for (const std::vector<Gltf_scene::Column>& target : block.targets)
    for (const Gltf_scene::Column& column : target)
      if (column.name == "POSITION" && differ(column))
        return true;
  return false;
}

} // namespace selvedge
