// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/united_levels.h"

#include "soup/selection.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <unordered_map>
#include <utility>

namespace selvedge::files {
namespace {

// Appends triples of numbers, each larger by so much.
void append(std::vector<Index_triple>& to, const std::vector<Index_triple>& from, Index offset)
{
  for (const auto& [a, b, c] : from)
    to.push_back({a + offset, b + offset, c + offset});
}

template <std::size_t dimension>
void append(Corner_values<dimension>& to, const Corner_values<dimension>& from)
{
  const std::size_t first = to.of_triangle.size();
  const Index offset = Index(to.values.size());
  to.values.insert(to.values.end(), from.values.begin(), from.values.end());
  append(to.of_triangle, from.of_triangle, offset);
  if (!from.missing)
    return;
  if (!to.missing)
    to.missing = *from.missing + offset;
  for (std::size_t t = first; t < to.of_triangle.size(); ++t)
    for (Index& value : to.of_triangle[t])
      if (value == *from.missing + offset)
        value = *to.missing;
}

/// Puts levels together.
class Union_of_levels
{
public:
  void add(const Triangle_soup& level)
  {
    if (m_result.triangles.empty()) {
      m_result.vertex_attributes = level.vertex_attributes;
      for (Attribute& attribute : m_result.vertex_attributes)
        attribute.rows.clear();
      for (const auto labels : {&Triangle_soup::groups, &Triangle_soup::materials})
        (m_result.*labels).names = (level.*labels).names;
    }
    require_alike(level);
    const std::vector<Index> numbers = vertices_of(level);
    Cancellation_poll poll;
    for (const auto& [a, b, c] : level.triangles) {
      poll();
      m_result.triangles.push_back({numbers[a], numbers[b], numbers[c]});
    }
    append(m_result.uvs, level.uvs);
    append(m_result.normals, level.normals);
    for (const auto labels : {&Triangle_soup::groups, &Triangle_soup::materials}) {
      std::vector<Index>& to = (m_result.*labels).of_triangle;
      const std::vector<Index>& from = (level.*labels).of_triangle;
      to.insert(to.end(), from.begin(), from.end());
    }
  }

  Triangle_soup take() { return std::move(m_result); }

private:
  void require_alike(const Triangle_soup& level) const
  {
    const auto has_as_well = [&](const auto& here, const auto& there) {
      return m_result.triangles.empty() || here.empty() == there.empty();
    };
    bool are_alike =
        level.groups.names == m_result.groups.names && level.materials.names == m_result.materials.names &&
        has_as_well(m_result.groups, level.groups) && has_as_well(m_result.materials, level.materials) &&
        has_as_well(m_result.uvs, level.uvs) && has_as_well(m_result.normals, level.normals) &&
        level.vertex_attributes.size() == m_result.vertex_attributes.size();
    for (std::size_t i = 0; are_alike && i < level.vertex_attributes.size(); ++i) {
      const Attribute &a = level.vertex_attributes[i], &b = m_result.vertex_attributes[i];
      are_alike = a.name == b.name && a.type == b.type && a.components == b.components &&
                  a.is_normalized == b.is_normalized;
    }
    if (!are_alike)
      throw Argument_error("the levels of detail are not of one mesh; write each to a file of its own");
  }

  // Returns the number of each vertex of a level among all.
  std::vector<Index> vertices_of(const Triangle_soup& level)
  {
    std::vector<Index> result;
    std::unordered_map<std::string, std::size_t> count;
    Cancellation_poll poll;
    for (std::size_t v = 0; v < level.points.size(); ++v) {
      poll();
      std::string key;
      for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = level.points[v][axis];
        key.append(reinterpret_cast<const char*>(&coordinate), sizeof coordinate);
      }
      for (const Attribute& attribute : level.vertex_attributes) {
        const std::size_t size = row_size(attribute);
        key.append(reinterpret_cast<const char*>(attribute.rows.data()) + v * size, size);
      }
      const std::size_t number = count[key]++;
      std::vector<Index>& alike = m_alike[std::move(key)];
      if (number == alike.size()) {
        alike.push_back(Index(m_result.points.size()));
        m_result.points.push_back(level.points[v]);
        for (std::size_t i = 0; i < level.vertex_attributes.size(); ++i)
          append_row(m_result.vertex_attributes[i].rows, level.vertex_attributes[i], Index(v));
      }
      result.push_back(alike[number]);
    }
    return result;
  }

  Triangle_soup m_result;
  std::unordered_map<std::string, std::vector<Index>> m_alike; // by their bits
};

} // namespace

Triangle_soup united(const std::vector<const Triangle_soup*>& levels)
{
  Union_of_levels all;
  for (const Triangle_soup* level : levels)
    all.add(*level);
  return all.take();
}

} // namespace selvedge::files
