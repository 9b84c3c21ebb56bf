// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "selection.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace selvedge {
namespace {

// Renumbers the items to which triangles refer, such that only used ones remain, in their order. Returns the
// old numbers of those that remain.
std::vector<Index> keep_used(std::vector<Index_triple>& triangles, std::size_t size)
{
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> numbers(size, none), kept;
  for (const Index_triple& triangle : triangles)
    for (const Index i : triangle)
      numbers[i] = 0;
  for (Index i = 0; i < size; ++i)
    if (numbers[i] != none) {
      numbers[i] = Index(kept.size());
      kept.push_back(i);
    }
  for (Index_triple& triangle : triangles)
    for (Index& i : triangle)
      i = numbers[i];
  return kept;
}

template <class T>
std::vector<T> rows(const std::vector<T>& from, const std::vector<Index>& kept)
{
  std::vector<T> result;
  result.reserve(kept.size());
  for (const Index i : kept)
    result.push_back(from[i]);
  return result;
}

std::vector<Attribute> rows(const std::vector<Attribute>& from, const std::vector<Index>& kept)
{
  std::vector<Attribute> result;
  for (const Attribute& attribute : from) {
    Attribute& column = result.emplace_back(
        Attribute{attribute.name, attribute.type, attribute.components, attribute.is_normalized, {}});
    column.rows.reserve(kept.size() * row_size(attribute));
    for (const Index i : kept)
      append_row(column.rows, attribute, i);
  }
  return result;
}

std::vector<Index_triple> at_corners(const std::vector<Index_triple>& from,
                                     const std::vector<Index_triple>& corners)
{
  std::vector<Index_triple> result;
  result.reserve(corners.size());
  for (const auto& [a, b, c] : corners)
    result.push_back({from[a / 3][a % 3], from[b / 3][b % 3], from[c / 3][c % 3]});
  return result;
}

template <std::size_t dimension>
Corner_values<dimension> selected(const Corner_values<dimension>& from,
                                  const std::vector<Index_triple>& corners)
{
  return from.empty() ? Corner_values<dimension>()
                      : with_used(from.values, at_corners(from.of_triangle, corners), from.missing);
}

Triangle_labels selected(const Triangle_labels& from, const std::vector<Index>& triangles)
{
  Triangle_labels result;
  if (!from.empty())
    result = {rows(from.of_triangle, triangles), from.names};
  return result;
}

// Returns the polygons of which all triangles are there, one after another, and `is_as_it_was(i)` is true for
// each of their places i.
template <class Function>
std::vector<Cut_polygon> polygons_left(const std::vector<Cut_polygon>& from,
                                       const std::vector<Index>& triangles, const Function& is_as_it_was)
{
  std::vector<Cut_polygon> result;
  for (std::size_t i = 0; i < triangles.size() && !from.empty(); ++i) {
    const auto polygon =
        std::lower_bound(from.begin(), from.end(), triangles[i],
                         [](const Cut_polygon& p, Index triangle) { return p.first_triangle < triangle; });
    if (polygon == from.end() || polygon->first_triangle != triangles[i])
      continue;
    const std::size_t size = polygon->corners - std::size_t(2);
    std::size_t left = 0;
    while (left < size && i + left < triangles.size() && triangles[i + left] == triangles[i] + left &&
           is_as_it_was(i + left))
      ++left;
    if (left == size)
      result.push_back({Index(i), polygon->corners, polygon->start});
  }
  return result;
}

} // namespace

template <std::size_t dimension>
Corner_values<dimension> with_used(const std::vector<std::array<double, dimension>>& values,
                                   std::vector<Index_triple> of_triangle, std::optional<Index> missing)
{
  Corner_values<dimension> result;
  const std::vector<Index> kept = keep_used(of_triangle, values.size());
  result.of_triangle = std::move(of_triangle);
  result.values = rows(values, kept);
  if (missing) {
    const auto found = std::lower_bound(kept.begin(), kept.end(), *missing);
    if (found != kept.end() && *found == *missing)
      result.missing = Index(found - kept.begin());
  }
  return result;
}

template Corner_values<2> with_used(const std::vector<std::array<double, 2>>&, std::vector<Index_triple>,
                                    std::optional<Index>);
template Corner_values<3> with_used(const std::vector<std::array<double, 3>>&, std::vector<Index_triple>,
                                    std::optional<Index>);

std::size_t row_size(const Attribute& attribute)
{
  switch (attribute.type) {
  case Attribute::Type::int8:
  case Attribute::Type::uint8:
    return attribute.components;
  case Attribute::Type::int16:
  case Attribute::Type::uint16:
    return 2 * std::size_t(attribute.components);
  case Attribute::Type::float64:
    return 8 * std::size_t(attribute.components);
  default:
    return 4 * std::size_t(attribute.components);
  }
}

std::string_view row_of(const Attribute& attribute, Index row)
{
  const std::size_t size = row_size(attribute);
  return {reinterpret_cast<const char*>(attribute.rows.data()) + row * size, size};
}

void append_row(std::vector<unsigned char>& rows, const Attribute& from, Index row)
{
  const std::size_t size = row_size(from);
  rows.insert(rows.end(), from.rows.begin() + row * size, from.rows.begin() + (row + 1) * size);
}

void keep_triangles(Triangle_soup& soup, const std::vector<Index>& triangles)
{
  const auto keep = [&](auto& of_triangle) {
    if (!of_triangle.empty())
      of_triangle = rows(of_triangle, triangles);
  };
  soup.polygons = polygons_left(soup.polygons, triangles, [](std::size_t) { return true; });
  soup.triangles = rows(soup.triangles, triangles);
  keep(soup.uvs.of_triangle);
  keep(soup.normals.of_triangle);
  keep(soup.groups.of_triangle);
  keep(soup.objects.of_triangle);
  keep(soup.materials.of_triangle);
  keep(soup.smoothing_groups.of_triangle);
  soup.triangle_attributes = rows(soup.triangle_attributes, triangles);
}

std::vector<char> are_used(const Triangle_soup& soup)
{
  std::vector<char> result(soup.points.size(), false);
  for (const Index_triple& triangle : soup.triangles)
    for (const Index v : triangle)
      result[v] = true;
  return result;
}

std::size_t count_of_used_vertices(const Triangle_soup& soup)
{
  const std::vector<char> used = are_used(soup);
  return std::size_t(std::count(used.begin(), used.end(), char(true)));
}

void forget_moved_polygons(Triangle_soup& soup, const std::vector<Point_3>& points_before)
{
  const auto has_moved = [&](const Cut_polygon& polygon) {
    const auto first = soup.triangles.begin() + polygon.first_triangle;
    return std::any_of(first, first + (polygon.corners - 2), [&](const Index_triple& triangle) {
      return std::any_of(triangle.begin(), triangle.end(),
                         [&](Index v) { return soup.points[v] != points_before[v]; });
    });
  };
  soup.polygons.erase(std::remove_if(soup.polygons.begin(), soup.polygons.end(), has_moved),
                      soup.polygons.end());
}

Triangle_soup selected(const Triangle_soup& soup, const std::vector<Index>& triangles,
                       const std::vector<Index_triple>& corners)
{
  Triangle_soup result;
  result.triangles = at_corners(soup.triangles, corners);
  const std::vector<Index> vertices = keep_used(result.triangles, soup.points.size());
  result.points = rows(soup.points, vertices);
  for (const Pose& pose : soup.poses)
    result.poses.push_back({pose.name, rows(pose.points, vertices), pose.time});
  result.vertex_attributes = rows(soup.vertex_attributes, vertices);
  result.triangle_attributes = rows(soup.triangle_attributes, triangles);
  result.uvs = selected(soup.uvs, corners);
  result.normals = selected(soup.normals, corners);
  result.groups = selected(soup.groups, triangles);
  result.objects = selected(soup.objects, triangles);
  result.materials = selected(soup.materials, triangles);
  result.smoothing_groups = selected(soup.smoothing_groups, triangles);
  result.polygons = polygons_left(soup.polygons, triangles, [&](std::size_t i) {
    const Index first = 3 * triangles[i];
    return corners[i] == Index_triple{first, first + 1, first + 2};
  });
  result.material_libraries = soup.material_libraries;
  result.header_comments = soup.header_comments;
  result.scene = soup.scene;
  if (soup.scene)
    result.scene_vertices = rows(soup.scene_vertices, vertices);
  return result;
}

} // namespace selvedge
