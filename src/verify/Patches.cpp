// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Patches.h"

#include "pieces.h"
#include "soup/Disjoint_sets.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

// Finds patches of one name and tells which are alike, for `match_pieces`.

namespace selvedge::internal {
namespace {

// Of some triangles, with points divided by 2^exponent.
CGAL::Bbox_3 box_of_triangles(const Triangle_soup& soup, const std::vector<Index>& triangles, int exponent)
{
  CGAL::Bbox_3 box;
  for (const Index t : triangles)
    for (const Index vertex : soup.triangles[t])
      box += scaled(soup.points[vertex], -exponent).bbox();
  return box;
}

double distance_between(const CGAL::Bbox_3& a, const CGAL::Bbox_3& b)
{
  double gaps[3];
  for (int axis = 0; axis < 3; ++axis)
    gaps[axis] = std::max({a.min(axis) - b.max(axis), b.min(axis) - a.max(axis), 0.0});
  return std::hypot(gaps[0], gaps[1], gaps[2]);
}

} // namespace

std::vector<Patch> patches(const Triangle_soup& soup, const std::vector<Index>& triangles,
                           const std::vector<Index>& names)
{
  std::vector<std::tuple<Index, Index, Index>> corners; // vertex, name, place in `triangles`
  for (Index i = 0; i < triangles.size(); ++i)
    for (const Index vertex : soup.triangles[triangles[i]])
      corners.emplace_back(vertex, names[i], i);
  Cancellation_scope::check();
  std::sort(corners.begin(), corners.end());
  Disjoint_sets connected(triangles.size());
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (std::get<0>(corners[i]) == std::get<0>(corners[i - 1]) &&
        std::get<1>(corners[i]) == std::get<1>(corners[i - 1]))
      connected.unite(std::get<2>(corners[i]), std::get<2>(corners[i - 1]));
  std::vector<Patch> result;
  std::vector<Index> patch_of_set(triangles.size(), no_piece);
  for (Index i = 0; i < triangles.size(); ++i) {
    Index& patch = patch_of_set[connected.find(i)];
    if (patch == no_piece) {
      patch = Index(result.size());
      result.push_back({names[i], {}});
    }
    result[patch].triangles.push_back(triangles[i]);
  }
  return result;
}

Patch_shapes::Patch_shapes(const Triangle_soup& soup, std::vector<Patch> patches, int exponent)
    : m_soup(soup), m_patches(std::move(patches)), m_exponent(exponent), m_shapes(m_patches.size())
{
  for (const Patch& patch : m_patches)
    m_boxes.push_back(box_of_triangles(m_soup, patch.triangles, m_exponent));
}

bool Patch_shapes::is_likest_of_its_name(const Triangle_soup& result, const Patch& patch)
{
  const Shape shape(result, patch.triangles, m_exponent);
  const CGAL::Bbox_3 box = box_of_triangles(result, patch.triangles, m_exponent);
  std::vector<std::pair<double, std::size_t>> of_name, others; // with the distance of the boxes, a bound
  for (std::size_t i = 0; i < m_patches.size(); ++i)
    (m_patches[i].name == patch.name ? of_name : others).emplace_back(distance_between(box, m_boxes[i]), i);
  std::sort(of_name.begin(), of_name.end());
  std::sort(others.begin(), others.end());
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [bound, i] : of_name) {
    if (bound >= least)
      break;
    least = std::min(least, distance(shape, i));
  }
  for (const auto& [bound, i] : others) {
    if (bound >= least)
      break;
    if (distance(shape, i) < least)
      return false;
  }
  return !of_name.empty();
}

double Patch_shapes::distance(const Shape& to, std::size_t patch)
{
  std::unique_ptr<Shape>& shape = m_shapes[patch];
  if (!shape)
    shape = std::make_unique<Shape>(m_soup, m_patches[patch].triangles, m_exponent);
  return std::max(shape->root_mean_square_distance(to), to.root_mean_square_distance(*shape));
}

} // namespace selvedge::internal
