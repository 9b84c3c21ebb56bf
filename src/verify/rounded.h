// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_ROUNDED_H
#define SELVEDGE_SRC_VERIFY_ROUNDED_H

#include "Surface_tree.h"

#include <selvedge/rounding.h>

#include <cmath>
#include <limits>

// Rounds an original to 32-bit floats when its result has been, so that the judge does not count rounding as
// a change.

namespace selvedge::internal {

/// Whether all coordinates that the triangles of a soup use are 32-bit floats.
inline bool has_float32_alone(const Triangle_soup& soup)
{
  for (const Index vertex : used_vertices(soup))
    for (int axis = 0; axis < 3; ++axis)
      if (!is_float32(soup.points[vertex][axis]))
        return false;
  return true;
}

/// Whether the first soup has 32-bit floats alone, and the second has not but could be rounded to them.
inline bool is_only_first_rounded(const Triangle_soup& first, const Triangle_soup& second)
{
  if (!has_float32_alone(first) || has_float32_alone(second))
    return false;
  for (const Index vertex : used_vertices(second))
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(second.points[vertex][axis]) > std::numeric_limits<float>::max())
        return false;
  return true;
}

/// Returns the triangles of a soup and their names, with all coordinates rounded to 32-bit floats.
inline Triangle_soup rounded(const Triangle_soup& soup)
{
  Triangle_soup result;
  result.points = soup.points;
  result.poses = soup.poses;
  result.triangles = soup.triangles;
  result.groups = soup.groups;
  result.objects = soup.objects;
  result.materials = soup.materials;
  result.scene = soup.scene;
  result.scene_vertices = soup.scene_vertices;
  // The coordinates of an unused vertex do not matter, but may be too large to be rounded.
  std::vector<bool> is_used(soup.points.size());
  for (const Index vertex : used_vertices(soup))
    is_used[vertex] = true;
  for (std::size_t vertex = 0; vertex < is_used.size(); ++vertex)
    if (!is_used[vertex]) {
      result.points[vertex] = Point_3(0, 0, 0);
      for (Pose& pose : result.poses)
        pose.points[vertex] = Point_3(0, 0, 0);
    }
  round_to_float32(result);
  return result;
}

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_ROUNDED_H
