// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Local_normals.h"

#include "Byte_writer.h"
#include "gltf_encoding.h"
#include "soup/flat_shading.h"

namespace selvedge::files {

std::string bits_of(const std::array<double, 3>& normal)
{
  return std::string(reinterpret_cast<const char*>(normal.data()), sizeof normal);
}

bool Local_normals::is_of_row(const Gltf_scene::Column& column, Index scene_vertex,
                              const std::array<double, 3>& normal) const
{
  const Gltf_scene::Instance& own = m_scene.instances[m_scene.instance_of(scene_vertex)];
  return column.component_type != type_float32 ||
         have_same_bits(world_normal(own, column, scene_vertex - own.first), normal);
}

const Local_normals::Rows& Local_normals::rows_of(const Gltf_scene::Column& column, std::size_t number)
{
  const auto [rows, is_new] = m_rows.try_emplace(number);
  const Gltf_scene::Instance& instance = m_scene.instances[number];
  const Gltf_scene::Block& block = m_scene.blocks[instance.block];
  for (Index row = 0; is_new && row < block.size; ++row)
    rows->second.emplace(
        bits_of(world_normal(instance, column, row)).append(block.attributes.front().row(row)), row);
  return rows->second;
}

std::string Local_normals::key(Index scene_vertex, const std::array<double, 3>& normal) const
{
  const Gltf_scene::Instance& own = m_scene.instances[m_scene.instance_of(scene_vertex)];
  const Gltf_scene::Column& positions = m_scene.blocks[own.block].attributes.front();
  return bits_of(normal).append(positions.row(scene_vertex - own.first));
}

std::string Local_normals::bytes_of(const Gltf_scene::Column& column, Index scene_vertex,
                                    const std::array<double, 3>& normal)
{
  const std::size_t number = m_scene.instance_of(scene_vertex);
  const Gltf_scene::Instance& own = m_scene.instances[number];
  if (is_of_row(column, scene_vertex, normal))
    return std::string(column.row(scene_vertex - own.first));
  const Rows& rows = rows_of(column, number);
  auto row = rows.find(key(scene_vertex, normal));
  if (row == rows.end())
    row = rows.lower_bound(bits_of(normal));
  if (row != rows.end() && row->first.compare(0, sizeof normal, bits_of(normal)) == 0)
    return std::string(column.row(row->second));
  const std::array<double, 3> local = local_normal(own, normal);
  std::string result;
  for (const double coordinate : quantised_normal(column, local).value_or(local))
    append_little_endian(result, static_cast<float>(coordinate));
  return result;
}

Index Local_normals::row_at(const Gltf_scene::Column& column, Index scene_vertex,
                            const std::array<double, 3>& normal)
{
  const std::size_t number = m_scene.instance_of(scene_vertex);
  const Index own = scene_vertex - m_scene.instances[number].first;
  if (is_of_row(column, scene_vertex, normal))
    return own;
  const Rows& rows = rows_of(column, number);
  const auto row = rows.find(key(scene_vertex, normal));
  return row == rows.end() ? own : row->second;
}

} // namespace selvedge::files
