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

std::string Local_normals::bytes_of(const Gltf_scene::Column& column, Index scene_vertex,
                                    const std::array<double, 3>& normal)
{
  const std::size_t number = m_scene.instance_of(scene_vertex);
  const Gltf_scene::Instance& own = m_scene.instances[number];
  const auto normal_of = [&](std::size_t row) { return world_normal(own, column, row); };
  if (column.component_type != type_float32 || have_same_bits(normal_of(scene_vertex - own.first), normal))
    return std::string(column.row(scene_vertex - own.first));
  const Gltf_scene::Block& block = m_scene.blocks[own.block];
  const Gltf_scene::Column& positions = block.attributes.front();
  const auto [rows, is_new] = m_rows.try_emplace(number);
  if (is_new)
    for (Index row = 0; row < block.size; ++row)
      rows->second.emplace(bits_of(normal_of(row)).append(positions.row(row)), row);
  auto row = rows->second.find(bits_of(normal).append(positions.row(scene_vertex - own.first)));
  if (row == rows->second.end())
    row = rows->second.lower_bound(bits_of(normal));
  if (row != rows->second.end() && row->first.compare(0, sizeof normal, bits_of(normal)) == 0)
    return std::string(column.row(row->second));
  const std::array<double, 3> local = local_normal(own, normal);
  std::string result;
  for (const double coordinate : quantised_normal(column, local).value_or(local))
    append_little_endian(result, static_cast<float>(coordinate));
  return result;
}

} // namespace selvedge::files
