// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_INNER_EDGES_H
#define SELVEDGE_SRC_SOUP_INNER_EDGES_H

#include "sorted_by.h"

#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge::internal {

/// A side of a triangle. Corners have the numbers 3 × triangle + place.
struct Edge_side
{
  Index low, high;       ///< the vertices of the edge
  Index at_low, at_high; ///< the corners there
};

/// Visits every edge of two triangles, by the two sides there, in linear time.
template <class Function>
void for_each_inner_edge(const std::vector<Index_triple>& triangles, const Function& function)
{
  Index beyond = 0; // the numbers of all vertices
  std::vector<Edge_side> sides;
  sides.reserve(3 * triangles.size());
  for (Index t = 0; t < triangles.size(); ++t)
    for (Index k = 0; k < 3; ++k) {
      const Index l = (k + 1) % 3;
      const Index a = triangles[t][k], b = triangles[t][l];
      beyond = std::max({beyond, a + 1, b + 1});
      sides.push_back(a < b ? Edge_side{a, b, 3 * t + k, 3 * t + l} : Edge_side{b, a, 3 * t + l, 3 * t + k});
    }
  const auto edge = [](const Edge_side& side) { return std::make_pair(side.low, side.high); };
  sides = sorted_by(sides, beyond, [](const Edge_side& side) { return side.high; });
  sides = sorted_by(sides, beyond, [](const Edge_side& side) { return side.low; });
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && edge(sides[end]) == edge(sides[i]))
      ++end;
    if (end - i == 2)
      function(sides[i], sides[i + 1]);
    i = end;
  }
}

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_SOUP_INNER_EDGES_H
