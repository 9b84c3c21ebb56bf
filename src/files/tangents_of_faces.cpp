// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/tangents_of_faces.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <unordered_map>
#include <vector>

namespace selvedge::files {
namespace {

using Direction = std::array<double, 3>;

constexpr double s_least_cosine = 0.1736; // of 80°

Direction direction(const Gltf_scene::Column& tangents, Index row)
{
  std::array<float, 3> numbers;
  std::memcpy(numbers.data(), tangents.rows.data() + row * tangents.row_size, sizeof numbers);
  const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
  return {numbers[0] / length, numbers[1] / length, numbers[2] / length};
}

} // namespace

std::size_t join_tangents_of_faces(Gltf_scene::Block& block)
{
  Gltf_scene::Column* const tangents = block.tangents();
  if (!tangents || tangents->component_type != type_float32)
    return 0;
  std::unordered_map<std::string, std::vector<Index>> rows_alike; // by all other bytes
  Cancellation_poll poll;
  for (Index row = 0; row < block.size; ++row) {
    poll();
    const Row_bytes bytes = bytes_of_row(block, row);
    std::string key = bytes.others + bytes.side + bytes.targets;
    if (const Gltf_scene::Column* const normals = block.normals())
      key += normals->row(row);
    rows_alike[std::move(key)].push_back(row);
  }
  std::size_t changed = 0;
  for (const auto& alike : rows_alike) {
    poll();
    const std::vector<Index>& rows = alike.second;
    const auto is_as_first = [&](Index row) { return tangents->row(row) == tangents->row(rows.front()); };
    if (std::all_of(rows.begin(), rows.end(), is_as_first))
      continue;
    Direction sum{};
    for (const Index row : rows)
      for (std::size_t k = 0; k < 3; ++k)
        sum[k] += direction(*tangents, row)[k];
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    const auto is_near_mean = [&](Index row) { // false where there is no direction
      const Direction d = direction(*tangents, row);
      return d[0] * sum[0] + d[1] * sum[1] + d[2] * sum[2] > s_least_cosine * length;
    };
    if (!std::all_of(rows.begin(), rows.end(), is_near_mean))
      continue;
    std::array<float, 3> mean;
    for (std::size_t k = 0; k < 3; ++k)
      mean[k] = float(sum[k] / length);
    for (const Index row : rows)
      std::memcpy(tangents->rows.data() + row * tangents->row_size, mean.data(), sizeof mean);
    changed += rows.size();
  }
  return changed;
}

} // namespace selvedge::files
