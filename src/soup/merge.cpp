// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/merge.h>

#include "first_alike.h"
#include "number_positions.h"
#include "selection.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace selvedge {

std::vector<Index> first_alike(const Triangle_soup& soup)
{
  const std::vector<Index> positions = number_positions(soup.points);
  const auto have_same_attributes = [&](Index v, Index w) {
    const bool is_together = std::all_of(soup.poses.begin(), soup.poses.end(),
                                         [&](const Pose& pose) { return pose.points[v] == pose.points[w]; });
    return is_together &&
           std::all_of(soup.vertex_attributes.begin(), soup.vertex_attributes.end(),
                       [&](const Attribute& attribute) {
                         const std::size_t size = row_size(attribute);
                         return std::memcmp(&attribute.rows[v * size], &attribute.rows[w * size], size) == 0;
                       });
  };
  // For each position, the first vertex with each set of attributes. There are few.
  std::vector<std::vector<Index>> firsts(soup.points.size());
  std::vector<Index> joined(soup.points.size());
  Cancellation_poll poll;
  for (Index v = 0; v < joined.size(); ++v) {
    poll();
    std::vector<Index>& known = firsts[positions[v]];
    const auto it =
        std::find_if(known.begin(), known.end(), [&](Index w) { return have_same_attributes(v, w); });
    joined[v] = it == known.end() ? known.emplace_back(v) : *it;
  }
  return joined;
}

Triangle_soup merged_at_positions(const Triangle_soup& soup)
{
  if (soup.scene)
    return soup; // its vertices are rows of accessors, which hold more than can be compared here
  const std::vector<Index> joined = first_alike(soup);
  Triangle_soup renumbered = soup;
  std::vector<Index> triangles(soup.triangles.size());
  std::vector<Index_triple> corners(soup.triangles.size());
  for (Index t = 0; t < triangles.size(); ++t) {
    for (Index& v : renumbered.triangles[t])
      v = joined[v];
    triangles[t] = t;
    corners[t] = {3 * t, 3 * t + 1, 3 * t + 2};
  }
  return selected(renumbered, triangles, corners);
}

} // namespace selvedge
