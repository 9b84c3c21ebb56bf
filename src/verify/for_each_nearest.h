// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_FOR_EACH_NEAREST_H
#define SELVEDGE_SRC_VERIFY_FOR_EACH_NEAREST_H

#include "Surface_tree.h"
#include "for_each_chunk.h"

#include <cstddef>
#include <vector>

namespace selvedge::internal {

/// Calls `function(i, vertex, nearest)` concurrently for each of some vertices, with the point of `to` that
/// is nearest to it; i is its place in an order in which neighbours follow each other, so that the last
/// answer is a good guess at the next. The answers depend on nothing but the arguments.
template <class Function>
void for_each_nearest(const std::vector<Index>& vertices, const Surface& from, const Surface_tree& to,
                      const Function& function)
{
  std::vector<Numbered_point> queries;
  queries.reserve(vertices.size());
  for (const Index vertex : vertices) {
    const Point_3& point = from.points[vertex];
    queries.push_back({{float(point.x()), float(point.y()), float(point.z())}, vertex});
  }
  std::size_t parts = 1;
  while (4 * parts < queries.size())
    parts *= 2;
  sort_by_halves(queries, parts);
  for_each_chunk(queries.size(), 1024, [&](std::size_t, std::size_t first, std::size_t beyond) {
    Index guess = 0;
    for (std::size_t i = first; i < beyond; ++i) {
      const Index vertex = queries[i].number;
      const Surface_tree::Nearest nearest = to.nearest(from.points[vertex], guess);
      function(i, vertex, nearest);
      guess = nearest.triangle;
    }
  });
}

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_FOR_EACH_NEAREST_H
