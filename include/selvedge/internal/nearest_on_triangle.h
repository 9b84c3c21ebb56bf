// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_NEAREST_ON_TRIANGLE_H
#define SELVEDGE_INTERNAL_NEAREST_ON_TRIANGLE_H

#include <selvedge/internal/Vector_of_doubles.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace selvedge {
namespace internal {

/// A point of a triangle, and how far it is from another point.
struct Nearest_on_triangle
{
  std::array<double, 3> weights = {}; ///< of the corners
  Vector_of_doubles point;
  double squared_distance = 0;
};

inline Nearest_on_triangle weighted(const std::array<Vector_of_doubles, 3>& corners,
                                    const std::array<double, 3>& weights, const Vector_of_doubles& p)
{
  Nearest_on_triangle result{weights, {}, 0};
  for (std::size_t i = 0; i < 3; ++i)
    result.point[i] = weights[0] * corners[0][i] + weights[1] * corners[1][i] + weights[2] * corners[2][i];
  const Vector_of_doubles off = difference(p, result.point);
  result.squared_distance = dot(off, off);
  return result;
}

/// Returns the weights of the nearest point of the sides, which may have no length.
inline std::array<double, 3> weights_on_sides(const std::array<Vector_of_doubles, 3>& corners,
                                              const Vector_of_doubles& p)
{
  std::array<double, 3> best{1, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Vector_of_doubles along = difference(corners[j], corners[i]);
    const double length = dot(along, along);
    const double share = length > 0 ? dot(along, difference(p, corners[i])) / length : 0;
    std::array<double, 3> weights{};
    weights[j] = (std::min)((std::max)(share, 0.), 1.);
    weights[i] = 1 - weights[j];
    if (weighted(corners, weights, p).squared_distance < weighted(corners, best, p).squared_distance)
      best = weights;
  }
  return best;
}

/// Returns the point of a triangle, which may be degenerate, that is nearest to `p`.
///
/// Of a needle, whose double area is less than a 10,000th of the square of a side, it is the nearest point of
/// the sides: rounding could move the nearest of all along the needle.
///
/// **Exactness** Floating point, in the order of the corners given. The distance is that of the point
/// returned.
///
/// **Reference** Ericson: Real-Time Collision Detection, section 5.1.5.
inline Nearest_on_triangle nearest_on_triangle(const std::array<Vector_of_doubles, 3>& corners,
                                               const Vector_of_doubles& p)
{
  const auto& [a, b, c] = corners;
  const Vector_of_doubles ab = difference(b, a), ac = difference(c, a), ap = difference(p, a);
  const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  // The products of both sides with the ways from a, b and c to p.
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = d1 - bb, d4 = d2 - bc, d5 = d1 - bc, d6 = d2 - cc;
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  const double sum = of_a + of_b + of_c; // the square of the double area
  const double longest = (std::max)(bb, cc);
  std::array<double, 3> weights;
  if (!(sum > 1e-8 * longest * longest))
    weights = weights_on_sides(corners, p);
  else if (d1 <= 0 && d2 <= 0)
    weights = {1, 0, 0};
  else if (d3 >= 0 && d4 <= d3)
    weights = {0, 1, 0};
  else if (d6 >= 0 && d5 <= d6)
    weights = {0, 0, 1};
  else if (of_c <= 0 && d1 >= 0 && d3 <= 0)
    weights = {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  else if (of_b <= 0 && d2 >= 0 && d6 <= 0)
    weights = {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  else if (of_a <= 0 && d4 >= d3 && d5 >= d6)
    weights = {0, 1 - (d4 - d3) / (d4 - d3 + d5 - d6), (d4 - d3) / (d4 - d3 + d5 - d6)};
  else
    weights = {1 - of_b / sum - of_c / sum, of_b / sum, of_c / sum};
  return weighted(corners, weights, p);
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_NEAREST_ON_TRIANGLE_H
