// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_INTERNAL_PIERCING_DEPTH_H
#define SELVEDGE_GEOMETRY_INTERNAL_PIERCING_DEPTH_H

#include <selvedge/internal/Vector_of_doubles.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace selvedge {
namespace internal {

/// Returns how deep two triangles pierce each other: the length of a short translation that parts them, along
/// the normal of one or across an edge of each. It is 0 where a triangle is degenerate.
///
/// **Exactness** Floating point, for limits of quality. The cross product of two edges that are parallel to
/// 0.001 is left out, so that no direction is an accident of rounding.
template <class Point>
double piercing_depth(const std::array<Point, 3>& f, const std::array<Point, 3>& g)
{
  using Vector = Vector_of_doubles;
  const std::array<const std::array<Point, 3>*, 2> triangles{&f, &g};
  std::array<std::array<Vector, 3>, 2> corners, sides;
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        corners[t][i][std::size_t(k)] = CGAL::to_double((*triangles[t])[i][k]) - CGAL::to_double(f[0][k]);
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      sides[t][i] = difference(corners[t][(i + 1) % 3], corners[t][i]);

  double depth = std::numeric_limits<double>::infinity();
  const auto measure_along = [&](const Vector& direction, double least_length) {
    const double length = std::sqrt(dot(direction, direction));
    if (!(length > least_length))
      return;
    std::array<std::array<double, 2>, 2> ranges;
    for (std::size_t t = 0; t < 2; ++t) {
      const auto [least, most] = std::minmax(
          {dot(direction, corners[t][0]), dot(direction, corners[t][1]), dot(direction, corners[t][2])});
      ranges[t] = {least, most};
    }
    const double overlap = std::min(ranges[0][1] - ranges[1][0], ranges[1][1] - ranges[0][0]) / length;
    depth = std::min(depth, std::max(overlap, 0.0));
  };
  for (std::size_t t = 0; t < 2; ++t) {
    const Vector normal = cross(sides[t][0], sides[t][1]);
    if (!(dot(normal, normal) > 0))
      return 0;
    measure_along(normal, 0);
  }
  for (const Vector& a : sides[0])
    for (const Vector& b : sides[1])
      measure_along(cross(a, b), 1e-3 * std::sqrt(dot(a, a) * dot(b, b)));
  return depth;
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_INTERNAL_PIERCING_DEPTH_H
