// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "kept_attributes.h"

#include "part_names.h"
#include "positions.h"
#include "soup/Gltf_scene.h"
#include "soup/with_number.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
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
                bool is_by_position, bool is_numbered = false)
{
  if (labels.empty())
    return;
  std::vector<std::string> names = labels.names;
  if (is_numbered)
    std::transform(names.begin(), names.end(), names.begin(), without_numbers);
  columns.push_back({name, is_by_position, [&labels, names = std::move(names)](Index triangle, int) {
                       return names[labels.of_triangle[triangle]];
                     }});
}

std::string row(const Attribute& attribute, Index number, std::size_t rows)
{
  const std::size_t size = attribute.rows.size() / rows;
  // Equal numbers of different types count as different values.
  std::string bytes = std::to_string(static_cast<int>(attribute.type)) + ' ';
  return bytes.append(reinterpret_cast<const char*>(attribute.rows.data()) + size * number, size);
}

/// Colours of two meshes, of which one may have numbers up to 255 or 65535, as integers or floats, and the
/// other fractions. Where they differ in that, those of both are taken in the coarser of the two scales.
class Colours_in_one_scale
{
public:
  Colours_in_one_scale(const Triangle_soup& a, const Triangle_soup& b)
  {
    add(a.vertex_attributes, b.vertex_attributes);
    add(a.triangle_attributes, b.triangle_attributes);
  }

  /// Returns an attribute of one of the meshes as it is to be compared.
  const Attribute& operator()(const Attribute& attribute) const
  {
    const auto found = m_scaled.find(&attribute);
    return found == m_scaled.end() ? attribute : found->second;
  }

private:
  static bool is_colour(const Attribute& attribute)
  {
    constexpr std::array<std::string_view, 4> names{"red", "green", "blue", "alpha"};
    return attribute.components == 1 && std::find(names.begin(), names.end(), attribute.name) != names.end();
  }

  void add(const std::vector<Attribute>& of_a, const std::vector<Attribute>& of_b)
  {
    for (const Attribute& a : of_a)
      for (const Attribute& b : of_b)
        if (a.name == b.name && is_colour(a) && is_colour(b)) {
          const double one_of_a = one_of(a, of_a), one_of_b = one_of(b, of_b);
          if (a.type == b.type && one_of_a == one_of_b)
            continue;
          const Attribute::Type coarser = std::min(type_of(a), type_of(b)); // they are listed by size
          m_scaled.emplace(&a, scaled(a, one_of_a, coarser));
          m_scaled.emplace(&b, scaled(b, one_of_b, coarser));
        }
  }

  // Other integers than those that stand for fractions become fractions in 32-bit floats in glTF.
  static Attribute::Type type_of(const Attribute& colour)
  {
    return colour.is_normalized ? colour.type : std::max(colour.type, Attribute::Type::float32);
  }

  // Calls `function(i, number)` for each number of a column.
  template <class Function>
  static void for_each_number(const Attribute& attribute, const Function& function)
  {
    with_number(attribute.type, [&](auto number) {
      for (std::size_t i = 0; i < attribute.rows.size() / sizeof number; ++i) {
        std::memcpy(&number, attribute.rows.data() + i * sizeof number, sizeof number);
        function(i, double(number));
      }
    });
  }

  // Returns the number that stands for 1 in a colour: for integers of fractions the largest, and for others
  // 255 where those of all colours but alpha, or of alpha, are from 0 to 255, and some well beyond 1, as some
  // programs write them; glTF gets fractions of these.
  static double one_of(const Attribute& colour, const std::vector<Attribute>& attributes)
  {
    double least = 0, largest = 0;
    for (const Attribute& other : attributes)
      if (is_colour(other) && (other.name == "alpha") == (colour.name == "alpha"))
        for_each_number(other, [&](std::size_t, double number) {
          least = std::min(least, number);
          largest = std::max(largest, number);
        });
    return with_number(colour.type, [&](auto number) {
      using Number = decltype(number);
      return colour.is_normalized                          ? double(std::numeric_limits<Number>::max())
             : least >= 0 && largest > 2 && largest <= 255 ? 255.
                                                           : 1.;
    });
  }

  // The numbers that a column of another type would have for the same colours.
  static Attribute scaled(const Attribute& attribute, double one, Attribute::Type type)
  {
    Attribute result{attribute.name, Attribute::Type::float64, 1, false, {}};
    for_each_number(attribute, [&](std::size_t i, double number) {
      const double value = in_scale_of(type, number / one) + 0.0; // no −0
      result.rows.resize((i + 1) * sizeof value);
      std::memcpy(result.rows.data() + i * sizeof value, &value, sizeof value);
    });
    return result;
  }

  static double in_scale_of(Attribute::Type type, double fraction)
  {
    return with_number(type, [&](auto number) {
      using Number = decltype(number);
      if constexpr (std::is_integral_v<Number>)
        return std::nearbyint(fraction * double(std::numeric_limits<Number>::max()));
      else
        return double(Number(fraction));
    });
  }

  std::map<const Attribute*, Attribute> m_scaled;
};

std::vector<Column> columns_of(const Triangle_soup& soup, const Corner_values<2>& uvs,
                               const Colours_in_one_scale& in_scale, bool is_gltf)
{
  std::vector<Column> columns;
  add_column(columns, "uv", uvs);
  add_column(columns, "normal", soup.normals);
  add_column(columns, "group", soup.groups, true, is_gltf);
  add_column(columns, "object", soup.objects, true);
  add_column(columns, "material", soup.materials, true);
  add_column(columns, "smoothing group", soup.smoothing_groups, false);
  for (const Attribute& stored : soup.vertex_attributes) {
    const Attribute& attribute = in_scale(stored);
    columns.push_back({attribute.name, true, [&soup, &attribute](Index triangle, int place) {
                         return row(attribute, soup.triangles[triangle][place], soup.points.size());
                       }});
  }
  for (const Attribute& stored : soup.triangle_attributes) {
    const Attribute& attribute = in_scale(stored);
    columns.push_back({attribute.name, false, [&soup, &attribute](Index triangle, int) {
                         return row(attribute, triangle, soup.triangles.size());
                       }});
  }
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

/// Whether a mesh that names no such attribute has it in its scene alone, as tangents are where vertices of
/// different tangents have become one.
bool is_left_to_scene(const Triangle_soup& soup, const std::string& name)
{
  if (!soup.scene)
    return false;
  const std::vector<Gltf_scene::Block>& blocks = soup.scene->blocks;
  return std::any_of(blocks.begin(), blocks.end(), [&](const Gltf_scene::Block& block) {
    return std::any_of(block.attributes.begin(), block.attributes.end(),
                       [&](const Gltf_scene::Column& column) { return column.name == name; });
  });
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
  const Colours_in_one_scale in_scale(result, original);
  const bool is_gltf = result.scene || original.scene;
  const std::vector<Column> columns =
      columns_of(result, is_only_result_gltf ? stored : result.uvs, in_scale, is_gltf);
  for (const Column& column :
       columns_of(original, is_only_result_gltf ? stored_of_original : original.uvs, in_scale, is_gltf)) {
    const auto same = std::find_if(columns.begin(), columns.end(), [&](const Column& other) {
      return other.name == column.name && other.is_by_position == column.is_by_position;
    });
    if (same == columns.end()) {
      if (!is_left_to_scene(result, column.name))
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
