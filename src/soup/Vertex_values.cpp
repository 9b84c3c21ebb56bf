// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Vertex_values.h"

#include "selection.h"
#include "with_number.h"
#include <selvedge/rounding.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <type_traits>

// Mixes the attributes of vertices, for reductions that put vertices to new places.

namespace selvedge {
namespace {

bool is_mixed(const Attribute& attribute)
{
  const bool is_float =
      attribute.type == Attribute::Type::float32 || attribute.type == Attribute::Type::float64;
  return (is_float || attribute.is_normalized) && attribute.name.compare(0, 8, "WEIGHTS_") != 0;
}

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
    using Limits = std::numeric_limits<Number>;
    return Number(std::clamp(std::nearbyint(value), double(Limits::min()), double(Limits::max())));
  } else {
    return Number(value);
  }
}

} // namespace

Vertex_values::Vertex_values(const Triangle_soup& soup)
    : m_soup(soup), m_are_uvs_float32(are_float32(soup.uvs.values)),
      m_are_normals_float32(are_float32(soup.normals.values))
{
  m_first_of_normal = soup.uvs.empty() ? 0 : 2;
  m_size = m_first_of_normal + (soup.normals.empty() ? 0 : 3);
  for (std::size_t i = 0; i < soup.vertex_attributes.size(); ++i)
    if (is_mixed(soup.vertex_attributes[i])) {
      m_columns.push_back({i, m_size});
      m_size += soup.vertex_attributes[i].components;
    }
}

void Vertex_values::add(Index corner, double weight, std::vector<double>& sum) const
{
  const auto add_value = [&](const auto& values, std::size_t first) {
    if (values.empty())
      return;
    const auto& value = values.values[values.of_triangle[corner / 3][corner % 3]];
    for (std::size_t i = 0; i < value.size(); ++i)
      sum[first + i] += weight * value[i];
  };
  add_value(m_soup.uvs, 0);
  add_value(m_soup.normals, m_first_of_normal);
  const std::size_t row = m_soup.triangles[corner / 3][corner % 3];
  for (const Column& column : m_columns) {
    const Attribute& attribute = m_soup.vertex_attributes[column.attribute];
    with_number(attribute.type, [&](auto number) {
      const unsigned char* bytes = attribute.rows.data() + row * row_size(attribute);
      for (std::size_t i = 0; i < attribute.components; ++i, bytes += sizeof number) {
        std::memcpy(&number, bytes, sizeof number);
        sum[column.first + i] += weight * double(number);
      }
    });
  }
}

void Vertex_values::finish(std::vector<double>& sum, const std::vector<double>& nearest) const
{
  if (!m_soup.normals.empty()) {
    double* const normal = sum.data() + m_first_of_normal;
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (std::size_t i = 0; i < 3; ++i)
      normal[i] /= length;
  }
  const auto round = [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i)
      sum[i] = nearest_float32(sum[i]);
  };
  if (!m_soup.uvs.empty() && m_are_uvs_float32)
    round(0, 2);
  if (!m_soup.normals.empty() && m_are_normals_float32)
    round(m_first_of_normal, 3);
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (!std::isfinite(sum[i]))
      sum[i] = nearest[i];
}

// Overwrites values that belong to one vertex alone, so that files with one value for each vertex stay such
// files, and adds new values where vertices share one.
template <std::size_t dimension>
void Vertex_values::put(const Of_vertices& of_vertex, std::size_t first, const Triangle_soup& result,
                        Corner_values<dimension>& values)
{
  if (values.empty())
    return;
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> owner(values.values.size(), none), added(of_vertex.size(), none);
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
      Index& number = values.of_triangle[t][k];
      if (!of_vertex[vertex] || number == values.missing)
        continue;
      if (is_shared[number] && added[vertex] == none) {
        added[vertex] = Index(values.values.size());
        values.values.emplace_back();
        is_shared.push_back(false);
      }
      if (is_shared[number])
        number = added[vertex];
      std::copy_n(of_vertex[vertex]->begin() + std::ptrdiff_t(first), dimension,
                  values.values[number].begin());
    }
}

void Vertex_values::put(const Of_vertices& of_vertex, Triangle_soup& result) const
{
  const std::size_t values_before = result.uvs.values.size() + result.normals.values.size();
  put(of_vertex, 0, result, result.uvs);
  put(of_vertex, m_first_of_normal, result, result.normals);
  for (const Column& column : m_columns) {
    Attribute& attribute = result.vertex_attributes[column.attribute];
    with_number(attribute.type, [&](auto number) {
      for (std::size_t v = 0; v < of_vertex.size(); ++v) {
        if (!of_vertex[v])
          continue;
        unsigned char* bytes = attribute.rows.data() + v * row_size(attribute);
        for (std::size_t i = 0; i < attribute.components; ++i, bytes += sizeof number) {
          number = nearest_number<decltype(number)>((*of_vertex[v])[column.first + i]);
          std::memcpy(bytes, &number, sizeof number);
        }
      }
    });
  }
  if (result.uvs.values.size() + result.normals.values.size() == values_before)
    return;
  std::vector<Index> triangles(result.triangles.size());
  std::iota(triangles.begin(), triangles.end(), Index(0));
  std::vector<Index_triple> corners;
  for (const Index t : triangles)
    corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  result = selected(result, triangles, corners); // drops the values that nobody shares any more
}

} // namespace selvedge
