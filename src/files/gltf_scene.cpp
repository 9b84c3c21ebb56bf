// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gltf_scene.h"

#include "files/Binary_reader.h"
#include "files/formats.h"
#include "files/transforms_of_vertices.h"

#include <map>

// What the reader and the writer of glTF share: the numbers in columns, and positions in world space.

namespace selvedge::files {

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

double component(const Gltf_scene::Column& column, std::size_t row, std::size_t place)
{
  const std::size_t size = component_size(column.component_type);
  Binary_reader bytes(std::string_view(column.rows).substr(row * column.row_size + place * size, size),
                      false);
  switch (column.component_type) {
  case type_int8:
    return bytes.take<std::int8_t>();
  case type_uint8:
    return bytes.take<std::uint8_t>();
  case type_int16:
    return bytes.take<std::int16_t>();
  case type_uint16:
    return bytes.take<std::uint16_t>();
  case type_uint32:
    return bytes.take<std::uint32_t>();
  default:
    return bytes.take<float>();
  }
}

const std::vector<std::string>& only_in_gltf(const Gltf_scene& scene)
{
  return scene.only_in_gltf;
}

Point_3 world_position(const Gltf_scene::Matrix& to_world, const Gltf_scene::Column& positions,
                       std::size_t row)
{
  const double x = component(positions, row, 0), y = component(positions, row, 1),
               z = component(positions, row, 2);
  const auto coordinate = [&](const std::array<double, 4>& m) {
    return m[0] * x + m[1] * y + m[2] * z + m[3];
  };
  return {coordinate(to_world[0]), coordinate(to_world[1]), coordinate(to_world[2])};
}

} // namespace selvedge::files

namespace selvedge {

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

} // namespace selvedge
