// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Local_normals.h"

#include "gltf_encoding.h"
#include "soup/flat_shading.h"
#include "soup/gltf_transforms.h"

#include <selvedge/internal/Vector_of_doubles.h>

#include <cstring>
#include <limits>

namespace selvedge::files {

std::string bits_of(const std::array<double, 3>& normal)
{
  return std::string(reinterpret_cast<const char*>(normal.data()), sizeof normal);
}

namespace {

/// Returns the first three of the floats in a row.
std::array<double, 3> direction(std::string_view row)
{
  std::array<float, 3> result;
  std::memcpy(result.data(), row.data(), sizeof result);
  return {result[0], result[1], result[2]};
}

} // namespace

bool Local_normals::has_normal(const Gltf_scene::Column& column, std::size_t instance, Index row,
                               const std::array<double, 3>& normal) const
{
  return column.component_type != type_float32 ||
         have_same_bits(world_normal(m_scene.instances[instance], column, row), normal);
}

const Local_normals::Rows& Local_normals::rows_of(const Gltf_scene::Column& column, std::size_t instance)
{
  const auto [rows, is_new] = m_rows.try_emplace(instance);
  const Gltf_scene::Block& block = m_scene.blocks[m_scene.instances[instance].block];
  for (Index row = 0; is_new && row < block.size; ++row) {
    rows->second.by_position[block.attributes.front().row(row)].push_back(row);
    rows->second.by_normal.emplace(bits_of(world_normal(m_scene.instances[instance], column, row)), row);
  }
  return rows->second;
}

std::string Local_normals::bytes_of(const Gltf_scene::Column& column, bool is_of_target, Index scene_vertex,
                                    const std::array<double, 3>& normal)
{
  const Gltf_scene::Block& block = m_scene.blocks[m_scene.instances[m_scene.instance_of(scene_vertex)].block];
  return is_of_target               ? displacement_of(column, block, scene_vertex, normal)
         : column.name == "TANGENT" ? tangent_of(column, *block.normals(), scene_vertex, normal)
                                    : normal_of(column, scene_vertex, normal);
}

std::string Local_normals::normal_of(const Gltf_scene::Column& column, Index scene_vertex,
                                     const std::array<double, 3>& normal)
{
  const std::size_t instance = m_scene.instance_of(scene_vertex);
  const Index row = row_at(column, scene_vertex, normal);
  if (has_normal(column, instance, row, normal))
    return std::string(column.row(row));
  const Rows& rows = rows_of(column, instance);
  if (const auto other = rows.by_normal.find(bits_of(normal)); other != rows.by_normal.end())
    return std::string(column.row(other->second));
  const std::array<double, 3> local = local_normal(m_scene.instances[instance], normal);
  std::string result;
  for (const double coordinate : quantised_direction(column, local).value_or(local))
    append_little_endian(result, static_cast<float>(coordinate));
  return result;
}

Index Local_normals::row_at(const Gltf_scene::Column& column, Index scene_vertex,
                            const std::array<double, 3>& normal)
{
  const std::size_t number = m_scene.instance_of(scene_vertex);
  const Gltf_scene::Instance& instance = m_scene.instances[number];
  const Gltf_scene::Block& block = m_scene.blocks[instance.block];
  const Index own = scene_vertex - instance.first;
  if (has_normal(column, number, own, normal))
    return own;
  const Row_bytes bytes = bytes_of_row(block, own);
  Index best = own;
  double highest = -std::numeric_limits<double>::infinity();
  for (const Index row : rows_of(column, number).by_position.at(block.attributes.front().row(own))) {
    const Row_bytes other = bytes_of_row(block, row);
    if (other.others != bytes.others || other.side != bytes.side)
      continue;
    if (has_normal(column, number, row, normal))
      return row;
    const double cosine = internal::dot(world_normal(instance, column, row), normal);
    if (cosine > highest) {
      highest = cosine;
      best = row;
    }
  }
  return best;
}

std::string Local_normals::tangent_of(const Gltf_scene::Column& tangents, const Gltf_scene::Column& normals,
                                      Index scene_vertex, const std::array<double, 3>& normal)
{
  const std::size_t instance = m_scene.instance_of(scene_vertex);
  const Index row = row_at(normals, scene_vertex, normal);
  std::string result(tangents.row(row));
  if (has_normal(normals, instance, row, normal) || tangents.component_type != type_float32 ||
      tangents.components != 4)
    return result;
  const std::array<double, 3> direction =
      perpendicular({component(tangents, row, 0), component(tangents, row, 1), component(tangents, row, 2)},
                    local_normal(m_scene.instances[instance], normal));
  std::string turned;
  for (const double coordinate : quantised_direction(tangents, direction).value_or(direction))
    append_little_endian(turned, static_cast<float>(coordinate));
  return result.replace(0, turned.size(), turned);
}

std::string Local_normals::displacement_of(const Gltf_scene::Column& column, const Gltf_scene::Block& block,
                                           Index scene_vertex, const std::array<double, 3>& normal)
{
  const Gltf_scene::Column& normals = *block.normals();
  const std::size_t instance = m_scene.instance_of(scene_vertex);
  const Index row = row_at(normals, scene_vertex, normal);
  std::string bytes(column.row(row));
  if (has_normal(normals, instance, row, normal) || column.component_type != type_float32 ||
      column.components != 3)
    return bytes;
  const std::array<double, 3> added = direction(bytes);
  if (added == std::array<double, 3>{})
    return bytes;
  const std::array<double, 3> before = direction(normals.row(row)),
                              after = direction(normal_of(normals, scene_vertex, normal));
  std::array<double, 3> result = turned(added, before, after);
  const Gltf_scene::Column* const tangents = block.tangents();
  if (column.name == "TANGENT" && tangents && tangents->component_type == type_float32)
    result = turned(result, turned(direction(tangents->row(row)), before, after),
                    direction(tangent_of(*tangents, normals, scene_vertex, normal)));
  bytes.clear();
  for (const double coordinate : quantised_direction(column, result).value_or(result))
    append_little_endian(bytes, static_cast<float>(coordinate));
  return bytes;
}

} // namespace selvedge::files
