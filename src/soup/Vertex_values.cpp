// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Vertex_values.h"

#include "Gltf_scene.h"
#include "gltf_transforms.h"
#include "poles.h"
#include "selection.h"
#include "with_number.h"
#include <selvedge/rounding.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <type_traits>

// Mixes the attributes of vertices, for reductions that put vertices to new places.

namespace selvedge {
namespace {

constexpr std::array<const char*, 4> s_colours = {"red", "green", "blue", "alpha"};

template <class Values>
bool are_float32(const Values& values)
{
  return std::all_of(values.begin(), values.end(), [](const auto& value) {
    return std::all_of(value.begin(), value.end(), [](double number) { return is_float32(number); });
  });
}

template <class Number>
Number nearest_number(double value)
{
  if constexpr (std::is_integral_v<Number>) {
    using Range = std::numeric_limits<Number>;
    return Number(std::clamp(std::nearbyint(value), double(Range::min()), double(Range::max())));
  } else {
    return Number(value);
  }
}

// A weighted mean of numbers. Rounding does not take it out of their range, so that it is their number where
// they are all the same.
class Weighted_mean
{
public:
  void add(double weight, double number)
  {
    m_sum += weight * number;
    m_low = std::min(m_low, number);
    m_high = std::max(m_high, number);
  }
  double value() const { return std::max(std::min(m_sum, m_high), m_low); } // NaN where the sum is

private:
  double m_sum = 0, m_low = std::numeric_limits<double>::infinity(), m_high = -m_low;
};

} // namespace

Vertex_values::Vertex_values(const Triangle_soup& soup)
    : m_soup(soup), m_are_uvs_float32(are_float32(soup.uvs.values)),
      m_are_normals_float32(are_float32(soup.normals.values))
{
  m_first_of_normal = soup.uvs.empty() ? 0 : 2;
  std::vector<Column> columns;
  for (std::size_t i = 0; i < soup.vertex_attributes.size(); ++i) {
    const Attribute& attribute = soup.vertex_attributes[i];
    columns.push_back({attribute.name, attribute.type, attribute.components, attribute.is_normalized,
                       attribute.rows.data(), row_size(attribute), i});
  }
  m_own = table(m_first_of_normal + (soup.normals.empty() ? 0 : 3), columns);
  if (!soup.scene)
    return;
  m_of_corners = scene_vertices_of_corners(soup);
  for (const Gltf_scene::Block& block : soup.scene->blocks) {
    columns.clear();
    const auto add = [&](const Gltf_scene::Column& column, std::size_t place, std::size_t target) {
      columns.push_back({column.name, attribute_type(column.component_type), column.components,
                         column.is_normalized(), reinterpret_cast<const unsigned char*>(column.rows.data()),
                         column.row_size, place, target});
      if (!begins_with(column.name, "WEIGHTS_")) // whose sum is 1
        columns.back().quantised = &column;
    };
    for (std::size_t i = 1; i < block.attributes.size(); ++i) // after the position
      add(block.attributes[i], i, s_none);
    for (std::size_t t = 0; t < block.targets.size(); ++t)
      for (std::size_t i = 0; i < block.targets[t].size(); ++i)
        add(block.targets[t][i], i, t);
    m_of_blocks.push_back(table(m_own.size, columns));
  }
}

const Vertex_values::Column* Vertex_values::Table::find(const char* name, std::size_t components) const
{
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) {
    return column.target == s_none && column.name == name && column.components == components;
  });
  return found == columns.end() ? nullptr : &*found;
}

bool Vertex_values::is_mixed(const Column& column)
{
  if (begins_with(column.name, "JOINTS_") || begins_with(column.name, "WEIGHTS_"))
    return false;
  // Numbers of EXT_mesh_features, or of its predecessors, stand for nothing between them, floats or not.
  if (begins_with(column.name, "_FEATURE_ID_") || column.name == "_BATCHID")
    return false;
  const bool is_float = column.type == Attribute::Type::float32 || column.type == Attribute::Type::float64;
  return is_float || column.is_normalized || begins_with(column.name, "TEXCOORD_") || column.target != s_none;
}

Vertex_values::Table Vertex_values::table(std::size_t first, const std::vector<Column>& columns)
{
  Table result;
  result.size = first;
  const auto add = [&](const Column& column) -> const Column& {
    Column& added = result.columns.emplace_back(column);
    added.first = result.size;
    result.size += column.components;
    return added;
  };
  // Rows of matrices may have gaps; they are not mixed.
  const auto has_gaps = [](const Column& column) {
    return with_number(column.type, [&](auto number) { return column.components * sizeof number; }) !=
           column.row_size;
  };
  for (const Column& column : columns)
    if (is_mixed(column) && !has_gaps(column))
      add(column);
  for (const Column& weights : columns) {
    const bool is_float = weights.type == Attribute::Type::float32;
    if (!begins_with(weights.name, "WEIGHTS_") || !(is_float || weights.is_normalized) || has_gaps(weights) ||
        (!result.influences.empty() && result.influences.front().weights.type != weights.type))
      continue;
    for (const Column& joints : columns)
      if (joints.name == "JOINTS_" + weights.name.substr(8) && joints.components == weights.components &&
          !has_gaps(joints)) {
        result.influences.push_back({add(weights), joints});
        break;
      }
  }
  return result;
}

Vertex_values::Row Vertex_values::scene_row(Index corner) const
{
  const auto at_pole = m_of_corners.find(corner);
  const Index scene_vertex =
      at_pole == m_of_corners.end() ? m_soup.scene_vertices[vertex_of(corner)] : at_pole->second;
  const Gltf_scene::Instance& instance = m_soup.scene->instances[m_soup.scene->instance_of(scene_vertex)];
  return {&m_of_blocks[instance.block], scene_vertex - instance.first};
}

double Vertex_values::number(const Column& column, const void* row, std::size_t component)
{
  return with_number(column.type, [&](auto number) {
    std::memcpy(&number, static_cast<const char*>(row) + component * sizeof number, sizeof number);
    return double(number);
  });
}

// Returns what a number becomes when it is stored.
double Vertex_values::stored(const Column& column, double number, std::size_t component)
{
  if (column.quantised)
    number = column.quantised->nearest_quantised(number, component);
  if (column.type == Attribute::Type::float32)
    return nearest_float32(number);
  return with_number(column.type, [&](auto zero) { return double(nearest_number<decltype(zero)>(number)); });
}

void Vertex_values::write(const Column& column, std::size_t component, double number, void* row)
{
  with_number(column.type, [&](auto zero) {
    const auto bytes = static_cast<decltype(zero)>(stored(column, number, component));
    std::memcpy(static_cast<unsigned char*>(row) + component * sizeof bytes, &bytes, sizeof bytes);
  });
}

void Vertex_values::write(const Column& column, const double* numbers, void* row)
{
  for (std::size_t i = 0; i < column.components; ++i)
    write(column, i, numbers[i], row);
}

// Colours of the soup are those of the first set in its scene, one column for each component.
std::vector<Vertex_values::Component> Vertex_values::fitted_components() const
{
  using Name = std::pair<std::string, std::size_t>;
  const auto is_fitted = [](const Column& column) {
    return column.target == s_none && column.name != "NORMAL" && column.name != "TANGENT" &&
           !begins_with(column.name, "TEXCOORD_") && !begins_with(column.name, "WEIGHTS_");
  };
  std::map<Name, Component> found;
  for (std::size_t block = 0; block < m_of_blocks.size(); ++block)
    for (const Column& column : m_of_blocks[block].columns)
      for (std::size_t i = 0; i < column.components && is_fitted(column); ++i) {
        Component& component = found[{column.name, i}];
        component.in_scene = i;
        component.of_blocks.resize(m_of_blocks.size(), nullptr);
        component.of_blocks[block] = &column;
      }
  for (const Column& column : m_own.columns)
    for (std::size_t i = 0; i < column.components && is_fitted(column); ++i) {
      Name name(column.name, i);
      if (m_soup.scene && column.components == 1)
        for (std::size_t k = 0; k < s_colours.size(); ++k)
          if (column.name == s_colours[k])
            name = {"COLOR_0", k};
      Component& component = found[name];
      component.in_own = i;
      component.own = &column;
    }
  std::vector<Component> result;
  for (auto& [name, component] : found)
    result.push_back(std::move(component));
  return result;
}

Vertex_values::Place Vertex_values::place(const Component& component, const Triangle_soup& soup,
                                          Index vertex) const
{
  if (component.of_blocks.empty())
    return {component.own, component.in_own, vertex, nullptr};
  const std::size_t number = soup.scene->instance_of(soup.scene_vertices[vertex]);
  const Gltf_scene::Instance& instance = soup.scene->instances[number];
  return {component.of_blocks[m_soup.scene->instances[number].block], component.in_scene,
          soup.scene_vertices[vertex] - instance.first, &instance};
}

double Vertex_values::unit(const Column& column)
{
  return with_number(column.type, [&](auto number) {
    using Number = decltype(number);
    return std::is_integral_v<Number> && column.is_normalized ? double(std::numeric_limits<Number>::max())
                                                              : 1;
  });
}

double Vertex_values::value(const Component& component, const Triangle_soup& soup, Index vertex) const
{
  const auto [column, i, row, instance] = place(component, soup, vertex);
  if (!column)
    return std::numeric_limits<double>::quiet_NaN();
  const void* const rows =
      instance ? static_cast<const void*>(
                     soup.scene->blocks[instance->block].attributes[column->place].rows.data())
               : soup.vertex_attributes[column->place].rows.data();
  return number(*column, static_cast<const char*>(rows) + row * column->row_size, i) / unit(*column);
}

double Vertex_values::stored_value(const Component& component, const Triangle_soup& soup, Index vertex,
                                   double value) const
{
  const Place at = place(component, soup, vertex);
  return stored(*at.column, value * unit(*at.column), at.component) / unit(*at.column);
}

Vertex_values::Numbers Vertex_values::numbers_of(const Share& share) const
{
  if (share.numbers)
    return *share.numbers;
  Numbers result;
  const auto append = [&](const auto& values) {
    if (values.empty())
      return;
    const auto& value = values.values[values.of_triangle[share.corner / 3][share.corner % 3]];
    result.insert(result.end(), value.begin(), value.end());
  };
  append(m_soup.uvs);
  append(m_soup.normals);
  const auto append_columns = [&](const Row& row) {
    for (const Column& column : row.table->columns)
      for (std::size_t i = 0; i < column.components; ++i)
        result.push_back(number(column, row.number, i));
  };
  append_columns(own_row(vertex_of(share.corner)));
  if (m_soup.scene)
    append_columns(scene_row(share.corner));
  return result;
}

const Vertex_values::Column* Vertex_values::texture_column(Index corner) const
{
  return m_soup.scene ? scene_row(corner).table->find("TEXCOORD_0", 2) : nullptr;
}

// Returns the texture coordinate that a reader makes of a number in an accessor.
double Vertex_values::coordinate(const Column& column, double number, std::size_t component)
{
  const double result = fraction(column.type, number);
  return component == 0 ? result : 1 - result;
}

std::array<double, 2> Vertex_values::mixed_uv(const Shares& shares, const Share& own) const
{
  const Column* const column = texture_column(own.corner);
  std::array<double, 2> result{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto at = [&](const Share& share) {
      if (share.numbers)
        return (*share.numbers)[(column ? column->first : 0) + i];
      if (column)
        return number(*column, scene_row(share.corner).number, i);
      return m_soup.uvs.values[m_soup.uvs.of_triangle[share.corner / 3][share.corner % 3]][i];
    };
    Weighted_mean mean;
    for (const Share& share : shares)
      if (share.weight != 0)
        mean.add(share.weight, at(share));
    result[i] = mean.value();
    if (column) {
      result[i] = coordinate(*column, stored(*column, std::isfinite(result[i]) ? result[i] : at(own), i), i);
    } else {
      if (m_are_uvs_float32)
        result[i] = nearest_float32(result[i]);
      if (!std::isfinite(result[i]))
        result[i] = at(own);
    }
  }
  return result;
}

Vertex_values::Stored_uv Vertex_values::stored_uv(Index corner, const std::array<double, 2>& uv) const
{
  const Column* const column = texture_column(corner);
  Stored_uv result{};
  for (std::size_t i = 0; i < 2; ++i) {
    if (column) {
      const double one = fraction(column->type, 1); // divided by the largest integer, or by 1
      result.in_scene[i] = stored(*column, (i == 0 ? uv[0] : 1 - uv[1]) / one, i);
      result.uv[i] = coordinate(*column, result.in_scene[i], i);
    } else {
      result.uv[i] = m_are_uvs_float32 ? nearest_float32(uv[i]) : uv[i];
    }
  }
  return result;
}

Vertex_values::Numbers Vertex_values::mixed(const Shares& shares, const Share& own) const
{
  const Numbers numbers_of_own = numbers_of(own);
  std::vector<Weighted_mean> means(numbers_of_own.size());
  for (const Share& share : shares) {
    if (share.weight == 0)
      continue;
    const Numbers numbers = numbers_of(share);
    for (std::size_t i = 0; i < means.size(); ++i)
      means[i].add(share.weight, numbers[i]);
  }
  Numbers result;
  for (const Weighted_mean& mean : means)
    result.push_back(mean.value());
  if (!m_soup.normals.empty()) {
    double* const normal = result.data() + m_first_of_normal;
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      normal[i] /= length;
      if (m_are_normals_float32)
        normal[i] = nearest_float32(normal[i]);
    }
  }
  mix_influences([this](const Share& share) { return own_row(vertex_of(share.corner)); }, shares, own,
                 result);
  if (m_soup.scene)
    complete_scene(shares, own, numbers_of_own, result);
  for (std::size_t i = 0; i < result.size(); ++i)
    if (!std::isfinite(result[i]))
      result[i] = numbers_of_own[i];
  if (!m_soup.uvs.empty()) {
    const std::array<double, 2> uv = mixed_uv(shares, own);
    std::copy(uv.begin(), uv.end(), result.begin());
  }
  if (m_soup.scene && !m_soup.normals.empty())
    if (const Column* const column = scene_row(own.corner).table->find("NORMAL", 3)) {
      // What the accessor will hold, as its reader turns it into world space.
      std::array<double, 3> normal;
      for (std::size_t i = 0; i < 3; ++i)
        normal[i] = stored(*column, result[column->first + i], i);
      const Index vertex = m_soup.scene_vertices[vertex_of(own.corner)];
      normal = world_normal(m_soup.scene->instances[m_soup.scene->instance_of(vertex)], normal);
      std::copy(normal.begin(), normal.end(), result.begin() + std::ptrdiff_t(m_first_of_normal));
    }
  return result;
}

// Mixes the weights of joints in the scene, and completes its normals and tangents and what morph targets add
// to them.
void Vertex_values::complete_scene(const Shares& shares, const Share& own, const Numbers& numbers_of_own,
                                   Numbers& numbers) const
{
  const auto row_of = [this](const Share& share) { return scene_row(share.corner); };
  mix_influences(row_of, shares, own, numbers);
  const Table& table = *row_of(own).table;
  const Column* const normal = table.find("NORMAL", 3);
  const Column* const tangent = table.find("TANGENT", 4);
  const auto direction = [&](const Column& column) {
    const double* const first = numbers.data() + column.first;
    return std::array<double, 3>{first[0], first[1], first[2]};
  };
  const auto set = [&](const Column& column, const std::array<double, 3>& xyz) {
    std::copy(xyz.begin(), xyz.end(), numbers.begin() + std::ptrdiff_t(column.first));
  };
  // Gives a direction the length 1. What morph targets add to it is turned and scaled with it.
  const auto finish = [&](const Column& column, const std::array<double, 3>& before) {
    normalize(column, numbers_of_own, numbers);
    for (const Column& added : table.columns)
      if (added.target != s_none && added.name == column.name && added.components == 3)
        set(added, turned(direction(added), before, direction(column)));
  };
  if (normal)
    finish(*normal, direction(*normal));
  if (tangent) {
    const std::array<double, 3> before = direction(*tangent);
    if (normal)
      set(*tangent, perpendicular(before, direction(*normal)));
    finish(*tangent, before);
  }
}

// Gives a direction the length 1, or that of which its integers are fractions. The sign at the end of a
// tangent is not mixed.
void Vertex_values::normalize(const Column& column, const Numbers& own, Numbers& numbers)
{
  double* const direction = numbers.data() + column.first;
  const double unit = with_number(column.type, [](auto number) {
    using Number = decltype(number);
    return std::is_integral_v<Number> ? double(std::numeric_limits<Number>::max()) : 1;
  });
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  for (std::size_t i = 0; i < 3; ++i)
    direction[i] *= unit / length;
  if (column.components == 4)
    direction[3] = own[column.first + 3];
}

// The joints are those of `own`. Each gets the weights that the mixed vertices give to it, and all are scaled
// to the sum 1, exactly so where they are integers.
template <class Row_of>
void Vertex_values::mix_influences(const Row_of& row_of, const Shares& shares, const Share& own,
                                   Numbers& numbers)
{
  const Row own_row = row_of(own);
  const std::vector<Influences>& influences = own_row.table->influences;
  if (influences.empty())
    return;
  const auto weight_of = [&](const Share& share, const Row& row, const Column& weights, std::size_t i) {
    return share.numbers ? (*share.numbers)[weights.first + i] : number(weights, row.number, i);
  };
  const auto given = [&](const Share& share, double joint) {
    const Row row = row_of(share);
    double sum = 0;
    for (const auto& [weights, joints] : influences)
      for (std::size_t i = 0; i < weights.components; ++i)
        if (number(joints, row.number, i) == joint)
          sum += weight_of(share, row, weights, i);
    return sum;
  };
  std::vector<double*> mixed; // those of different joints
  std::vector<double> known;  // these joints
  double sum = 0;
  for (const auto& [weights, joints] : influences)
    for (std::size_t i = 0; i < weights.components; ++i) {
      const double joint = number(joints, own_row.number, i);
      double& weight = numbers[weights.first + i];
      weight = 0;
      if (weight_of(own, own_row, weights, i) == 0 ||
          std::find(known.begin(), known.end(), joint) != known.end())
        continue;
      known.push_back(joint);
      mixed.push_back(&weight);
      for (const Share& share : shares)
        if (share.weight != 0)
          weight += share.weight * given(share, joint);
      sum += weight;
    }
  if (!(sum > 0 && std::isfinite(sum))) {
    for (const auto& [weights, joints] : influences)
      for (std::size_t i = 0; i < weights.components; ++i)
        numbers[weights.first + i] = weight_of(own, own_row, weights, i);
    return;
  }
  with_number(influences.front().weights.type, [&](auto zero) {
    using Number = decltype(zero);
    if constexpr (std::is_integral_v<Number>) {
      double left = double(std::numeric_limits<Number>::max());
      const double factor = left / sum;
      for (double* const weight : mixed)
        left -= * weight = std::nearbyint(*weight * factor);
      **std::max_element(mixed.begin(), mixed.end(),
                         [](const double* a, const double* b) { return *a < *b; }) += left;
    } else {
      for (double* const weight : mixed)
        *weight /= sum;
    }
  });
}

// Sets joints that have no weight to 0, as glTF asks.
void Vertex_values::clear_joints_without_weight(const Gltf_scene::Column& weights, Gltf_scene::Column& joints,
                                                std::size_t row)
{
  const std::size_t size = component_size(joints.component_type);
  for (std::size_t i = 0; i < joints.components; ++i)
    if (component(weights, row, i) == 0)
      joints.rows.replace(row * joints.row_size + i * size, size, size, '\0');
}

// Overwrites the rows of these vertices in a copy of the scene. A block that several nodes show becomes one
// of each node first.
void Vertex_values::put_in_scene(const Of_vertices& of_vertex, Triangle_soup& result) const
{
  const auto scene = std::make_shared<Gltf_scene>(*result.scene);
  std::vector<std::size_t> users(scene->blocks.size(), 0);
  for (const Gltf_scene::Instance& instance : scene->instances)
    ++users[instance.block];
  for (std::size_t v = 0; v < of_vertex.size(); ++v) {
    if (!of_vertex[v])
      continue;
    const std::size_t number = scene->instance_of(result.scene_vertices[v]);
    Gltf_scene::Instance& instance = scene->instances[number];
    if (users[instance.block] > 1) {
      --users[instance.block];
      Gltf_scene::Block own = scene->blocks[instance.block];
      instance.block = Index(scene->blocks.size());
      scene->blocks.push_back(std::move(own));
      users.push_back(1);
    }
    Gltf_scene::Block& block = scene->blocks[instance.block];
    const std::size_t row = result.scene_vertices[v] - instance.first;
    if (const auto local = local_position(instance.to_world, result.points[v])) {
      Gltf_scene::Column& positions = block.attributes.front();
      std::string bytes;
      for (const double coordinate : *local)
        append_little_endian(bytes, static_cast<float>(coordinate));
      positions.rows.replace(row * positions.row_size, positions.row_size, bytes);
    }
    const Table& table = m_of_blocks[m_soup.scene->instances[number].block];
    for (const Column& column : table.columns) {
      Gltf_scene::Column& written = column.target == s_none ? block.attributes[column.place]
                                                            : block.targets[column.target][column.place];
      write(column, of_vertex[v]->data() + column.first, written.rows.data() + row * written.row_size);
    }
    for (const auto& [weights, joints] : table.influences)
      clear_joints_without_weight(block.attributes[weights.place], block.attributes[joints.place], row);
  }
  result.scene = scene;
}

// Overwrites values that belong to one vertex alone, so that files with one value for each vertex stay such
// files, and adds new values where vertices share one.
template <std::size_t dimension, class Numbers_of>
void Vertex_values::put(const Numbers_of& numbers_of, const Triangle_soup& result,
                        Corner_values<dimension>& values)
{
  if (values.empty())
    return;
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> owner(values.values.size(), none), added(result.points.size(), none);
  std::vector<char> is_shared(values.values.size(), false);
  for (std::size_t t = 0; t < result.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index vertex = result.triangles[t][k], number = values.of_triangle[t][k];
      is_shared[number] |= owner[number] != none && owner[number] != vertex;
      owner[number] = vertex;
    }
  for (std::size_t t = 0; t < result.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index vertex = result.triangles[t][k];
      const double* const numbers = numbers_of(vertex);
      Index& number = values.of_triangle[t][k];
      if (!numbers || number == values.missing)
        continue;
      if (is_shared[number] && added[vertex] == none) {
        added[vertex] = Index(values.values.size());
        values.values.emplace_back();
        is_shared.push_back(false);
      }
      if (is_shared[number])
        number = added[vertex];
      std::copy_n(numbers, dimension, values.values[number].begin());
    }
}

void Vertex_values::put(const Of_vertices& of_vertex, Triangle_soup& result) const
{
  const std::size_t values_before = result.uvs.values.size() + result.normals.values.size();
  const auto from = [&](std::size_t first) {
    return [&of_vertex, first](Index v) { return of_vertex[v] ? of_vertex[v]->data() + first : nullptr; };
  };
  put(from(0), result, result.uvs);
  put(from(m_first_of_normal), result, result.normals);
  for (const Column& column : m_own.columns)
    for (std::size_t v = 0; v < of_vertex.size(); ++v)
      if (of_vertex[v])
        write(column, of_vertex[v]->data() + column.first,
              result.vertex_attributes[column.place].rows.data() + v * column.row_size);
  if (m_soup.scene)
    put_in_scene(of_vertex, result);
  if (result.uvs.values.size() + result.normals.values.size() == values_before)
    return;
  std::vector<Index> triangles(result.triangles.size());
  std::iota(triangles.begin(), triangles.end(), Index(0));
  std::vector<Index_triple> corners;
  for (const Index t : triangles)
    corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  result = selected(result, triangles, corners); // drops the values that nobody shares any more
}

void Vertex_values::put(const Fitted& fitted, Triangle_soup& result) const
{
  const auto& uvs = fitted.uvs;
  if (!uvs.empty())
    put([&](Index v) { return uvs[v] ? uvs[v]->uv.data() : nullptr; }, result, result.uvs);
  const auto scene = m_soup.scene ? std::make_shared<Gltf_scene>(*result.scene) : nullptr;
  const auto row_in_scene = [&](const Column& column, const Gltf_scene::Instance& instance, std::size_t row) {
    return scene->blocks[instance.block].attributes[column.place].rows.data() + row * column.row_size;
  };
  const auto row_of_soup = [&](const Column& column, std::size_t row) {
    return result.vertex_attributes[column.place].rows.data() + row * column.row_size;
  };
  for (std::size_t v = 0; v < uvs.size() && scene; ++v) {
    if (!uvs[v])
      continue;
    const std::size_t number = scene->instance_of(result.scene_vertices[v]);
    const Gltf_scene::Instance& instance = scene->instances[number];
    const Table& table = m_of_blocks[m_soup.scene->instances[number].block];
    if (const Column* const column = table.find("TEXCOORD_0", 2))
      write(*column, uvs[v]->in_scene.data(),
            row_in_scene(*column, instance, result.scene_vertices[v] - instance.first));
  }
  const std::vector<Component> components = fitted_components();
  for (std::size_t c = 0; c < fitted.values.size(); ++c)
    for (std::size_t v = 0; v < fitted.values[c].size(); ++v) {
      const double value = fitted.values[c][v];
      if (std::isnan(value))
        continue;
      const auto [column, i, row, instance] = place(components[c], result, Index(v));
      if (instance)
        write(*column, i, value * unit(*column), row_in_scene(*column, *instance, row));
      if (const Column* const own = components[c].own)
        write(*own, components[c].in_own, value * unit(*own), row_of_soup(*own, v));
    }
  if (scene)
    result.scene = scene;
}

} // namespace selvedge
