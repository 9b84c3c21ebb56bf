// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_POSITIONS_H
#define SELVEDGE_VERIFY_POSITIONS_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>

#include <oneapi/tbb/parallel_sort.h>

#include <numeric>
#include <vector>

namespace selvedge::internal {

/// Numbers positions, by which the judge compares meshes: returns a number for every point, which all points
/// of the same coordinates share; −0 is 0. Numbers begin at 0.
inline std::vector<Index> position_numbers(const std::vector<Point_3>& points)
{
  std::vector<Index> order(points.size()), numbers(points.size());
  std::iota(order.begin(), order.end(), Index(0));
  Cancellation_scope::check();
  tbb::parallel_sort(order.begin(), order.end(), [&](Index v, Index w) {
    return CGAL::lexicographically_xyz_smaller(points[v], points[w]);
  });
  Cancellation_scope::check();
  Index number = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && points[order[i]] != points[order[i - 1]])
      ++number;
    numbers[order[i]] = number;
  }
  return numbers;
}

/// Numbers the positions of two soups in common: the points of the second follow those of the first.
inline std::vector<Index> position_numbers(const Triangle_soup& first, const Triangle_soup& second)
{
  std::vector<Point_3> points = first.points;
  points.insert(points.end(), second.points.begin(), second.points.end());
  return position_numbers(points);
}

} // namespace selvedge::internal

#endif // SELVEDGE_VERIFY_POSITIONS_H
