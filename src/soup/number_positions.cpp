// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "number_positions.h"

#include <selvedge/Cancellation_scope.h>

#include <oneapi/tbb/parallel_sort.h>

#include <numeric>
#include <tuple>
#include <utility>

namespace selvedge {

std::vector<Index> number_positions(const std::vector<Point_3>& points)
{
  std::vector<Index> sorted(points.size());
  std::iota(sorted.begin(), sorted.end(), Index(0));
  const auto coordinates = [&](Index v) {
    return std::make_tuple(points[v].x(), points[v].y(), points[v].z());
  };
  Cancellation_scope::check();
  tbb::parallel_sort(sorted.begin(), sorted.end(), [&](Index a, Index b) {
    return std::make_pair(coordinates(a), a) < std::make_pair(coordinates(b), b);
  });
  Cancellation_scope::check();
  std::vector<Index> numbers(points.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    numbers[sorted[i]] =
        i > 0 && coordinates(sorted[i]) == coordinates(sorted[i - 1]) ? numbers[sorted[i - 1]] : sorted[i];
  return numbers;
}

std::vector<Index_triple> in_positions(std::vector<Index_triple> triangles,
                                       const std::vector<Index>& positions)
{
  for (Index_triple& triangle : triangles)
    for (Index& v : triangle)
      v = positions[v];
  return triangles;
}

Fronts fronts_in_positions(const std::vector<Index_triple>& triangles, const std::vector<Index>& positions,
                           const std::vector<Index>& fronts)
{
  Fronts result;
  for (Index t = 0; t < triangles.size(); ++t)
    if (fronts.empty() || fronts[t] == t) {
      result.numbers.push_back(t);
      result.triangles.push_back(triangles[t]);
    }
  result.triangles = in_positions(std::move(result.triangles), positions);
  return result;
}

} // namespace selvedge
