// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_ROUNDED_H
#define SELVEDGE_SRC_VERIFY_ROUNDED_H

#include "Surface_tree.h"

#include <selvedge/mesh/rounding.h>

#include <limits>

namespace selvedge::internal {

/// Whether all coordinates that the triangles of one soup use are 32-bit floats, and not all of another,
/// which could be rounded to such.
inline bool is_only_first_rounded(const Triangle_soup& first, const Triangle_soup& second)
{
  const auto are_all = [](const Triangle_soup& soup, const auto& holds) {
    for (const Index vertex : used_vertices(soup))
      for (int axis = 0; axis < 3; ++axis)
        if (!holds(soup.points[vertex][axis]))
          return false;
    return true;
  };
  const auto is_in_range = [](double value) { return std::abs(value) <= std::numeric_limits<float>::max(); };
  return are_all(first, is_float32) && !are_all(second, is_float32) && are_all(second, is_in_range);
}

/// The triangles of a soup and their names, rounded to 32-bit floats.
inline Triangle_soup rounded(const Triangle_soup& soup)
{
  Triangle_soup result;
  result.points = soup.points;
  result.triangles = soup.triangles;
  result.groups = soup.groups;
  result.objects = soup.objects;
  result.materials = soup.materials;
  result.scene = soup.scene;
  // No number of an unused vertex matters, but it may be too large.
  std::vector<bool> is_used(soup.points.size());
  for (const Index vertex : used_vertices(soup))
    is_used[vertex] = true;
  for (std::size_t vertex = 0; vertex < is_used.size(); ++vertex)
    if (!is_used[vertex])
      result.points[vertex] = Point_3(0, 0, 0);
  round_to_float32(result);
  return result;
}

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_ROUNDED_H
