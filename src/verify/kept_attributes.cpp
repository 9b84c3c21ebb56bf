// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "kept_attributes.h"

#include "positions.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <utility>

// Counts, for `compare`, how many vertices and attribute values of a result its original has too.

namespace selvedge::internal {
namespace {

/// The values that one attribute has at the corners of triangles, as bytes that can be compared.
struct Column
{
  std::string name;
  bool is_by_position;
  std::function<std::string(Index triangle, int place)> value;
};

template <std::size_t dimension>
void add_column(std::vector<Column>& columns, const char* name, const Corner_values<dimension>& values)
{
  if (values.empty())
    return;
  columns.push_back({name, true, [&values](Index triangle, int place) {
                       const Index number = values.of_triangle[triangle][place];
                       if (number == values.missing)
                         return std::string();
                       std::string bytes(sizeof(double) * dimension, '\0');
                       for (std::size_t i = 0; i < dimension; ++i) {
                         const double coordinate = values.values[number][i] + 0.0; // no −0
                         std::memcpy(bytes.data() + sizeof(double) * i, &coordinate, sizeof coordinate);
                       }
                       return bytes;
                     }});
}

void add_column(std::vector<Column>& columns, const char* name, const Triangle_labels& labels,
                bool is_by_position)
{
  if (!labels.empty())
    columns.push_back({name, is_by_position, [&labels](Index triangle, int) {
                         return labels.names[labels.of_triangle[triangle]];
                       }});
}

std::string row(const Attribute& attribute, Index number, std::size_t rows)
{
  const std::size_t size = attribute.rows.size() / rows;
  // Equal numbers of different types count as different values.
  std::string bytes = std::to_string(static_cast<int>(attribute.type)) + ' ';
  return bytes.append(reinterpret_cast<const char*>(attribute.rows.data()) + size * number, size);
}

std::vector<Column> columns_of(const Triangle_soup& soup, const Corner_values<2>& uvs)
{
  std::vector<Column> columns;
  add_column(columns, "uv", uvs);
  add_column(columns, "normal", soup.normals);
  add_column(columns, "group", soup.groups, true);
  add_column(columns, "object", soup.objects, true);
  add_column(columns, "material", soup.materials, true);
  add_column(columns, "smoothing group", soup.smoothing_groups, false);
  for (const Attribute& attribute : soup.vertex_attributes)
    columns.push_back({attribute.name, true, [&soup, &attribute](Index triangle, int place) {
                         return row(attribute, soup.triangles[triangle][place], soup.points.size());
                       }});
  for (const Attribute& attribute : soup.triangle_attributes)
    columns.push_back({attribute.name, false, [&soup, &attribute](Index triangle, int) {
                         return row(attribute, triangle, soup.triangles.size());
                       }});
  return columns;
}

// Returns texture coordinates as glTF files store them: 32-bit floats, of which v runs the other way.
Corner_values<2> stored_in_gltf(Corner_values<2> uvs)
{
  for (auto& [u, v] : uvs.values) {
    u = nearest_float32(u);
    v = nearest_float32(1 - v);
  }
  return uvs;
}

/// Pairs of a position and a value, both as numbers, sorted and without duplicates.
using Combinations = std::vector<std::pair<Index, Index>>;
using Value_numbers = std::unordered_map<std::string, Index>;

Combinations combinations(const Triangle_soup& soup, const Index* positions, const Column& column,
                          Value_numbers& numbers)
{
  Combinations result;
  Cancellation_poll poll;
  for (Index triangle = 0; triangle < soup.triangles.size(); ++triangle)
    for (int place = 0; place < 3; ++place) {
      poll();
      const auto value = numbers.emplace(column.value(triangle, place), static_cast<Index>(numbers.size()));
      const Index position = column.is_by_position ? positions[soup.triangles[triangle][place]] : 0;
      result.emplace_back(position, value.first->second);
    }
  std::sort(result.begin(), result.end(), [&](const auto& a, const auto& b) {
    poll();
    return a < b;
  });
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::size_t common(const Combinations& a, const Combinations& b)
{
  std::size_t count = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    count += *i == *j;
    const bool is_behind = *j < *i;
    i += !is_behind;
    j += is_behind;
  }
  return count;
}

std::size_t at_new_places(const Combinations& after, const Combinations& before)
{
  std::size_t count = 0;
  auto j = before.begin();
  for (const auto& [position, value] : after) {
    while (j != before.end() && j->first < position)
      ++j;
    count += j == before.end() || j->first != position;
  }
  return count;
}

} // namespace

void compare_values(Comparison& comparison, const Triangle_soup& result, const Triangle_soup& original)
{
  const std::vector<Index> positions = position_numbers(result, original);
  const Index* const of_result = positions.data();
  const Index* const of_original = positions.data() + result.points.size();
  Value_numbers nothing;
  const Column no_value = {"", true, [](Index, int) { return std::string(); }};
  const Combinations before = combinations(original, of_original, no_value, nothing);
  const Combinations after = combinations(result, of_result, no_value, nothing);
  comparison.vertices = after.size();
  comparison.original_vertices = common(after, before);

  // What a glTF file could not but round is no change.
  const bool is_only_result_gltf = result.scene && !original.scene;
  const auto uvs_of = [&](const Triangle_soup& soup) {
    return is_only_result_gltf ? stored_in_gltf(soup.uvs) : Corner_values<2>();
  };
  const Corner_values<2> stored = uvs_of(result), stored_of_original = uvs_of(original);
  const std::vector<Column> columns = columns_of(result, is_only_result_gltf ? stored : result.uvs);
  for (const Column& column : columns_of(original, is_only_result_gltf ? stored_of_original : original.uvs)) {
    const auto same = std::find_if(columns.begin(), columns.end(), [&](const Column& other) {
      return other.name == column.name && other.is_by_position == column.is_by_position;
    });
    if (same == columns.end()) {
      comparison.lost_attributes.push_back(column.name);
      continue;
    }
    Value_numbers numbers;
    const Combinations old = combinations(original, of_original, column, numbers);
    const Combinations kept = combinations(result, of_result, *same, numbers);
    comparison.attributes.push_back({column.name, kept.size(), common(kept, old), at_new_places(kept, old)});
  }
}

} // namespace selvedge::internal
