// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_TRIANGLE_NORMALS_H
#define SELVEDGE_SRC_SOUP_TRIANGLE_NORMALS_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// Normals of triangles and of their corners, for what mends and fits normals, in floating point.

namespace selvedge::shading {

using Vector = internal::Vector_of_doubles;

/// Of 60°: normals that are farther from that of their triangle shade it like another.
constexpr double s_cosine_of_shading = 0.5;

/// Of 1°: normals that differ by more belong to two sides of a hard edge.
constexpr double s_cosine_smooth = 0.9998476952;

inline Vector difference(const Point_3& a, const Point_3& b)
{
  return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
}

/// Has the length 1, or 0 where the vector has no direction. A vector and its double have the same bits.
inline Vector unit(Vector a)
{
  const double largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  if (!(largest > 0 && std::isfinite(largest)))
    return {};
  // Within these bounds, squares neither overflow nor lose digits that count: scaling would not change a bit.
  constexpr double small = 0x1p-200, large = 0x1p+200;
  if (!(largest > small && largest < large))
    for (double& x : a)
      x = std::scalbn(x, -std::ilogb(largest));
  const double norm = std::sqrt(internal::dot(a, a));
  for (double& x : a)
    x /= norm;
  return a;
}

inline bool is_within(const Vector& a, const Vector& b, double cosine)
{
  return internal::dot(unit(a), unit(b)) >= cosine;
}

inline Vector unit_normal(const Triangle_soup& soup, Index triangle)
{
  const auto& [p, q, r] = soup.triangles[triangle];
  const Vector u = unit(difference(soup.points[q], soup.points[p]));
  const Vector v = unit(difference(soup.points[r], soup.points[p]));
  return unit(internal::cross(u, v));
}

/// Returns the directions of the two edges of a triangle at a corner. Corners have the numbers 3 × triangle +
/// place.
inline std::array<Vector, 2> directions_at(const Triangle_soup& soup, Index corner)
{
  const Index_triple& v = soup.triangles[corner / 3];
  const auto direction = [&](Index turn) {
    return unit(difference(soup.points[v[(corner + turn) % 3]], soup.points[v[corner % 3]]));
  };
  return {direction(1), direction(2)};
}

/// Returns the angle of a triangle at a corner, in radians.
inline double angle_at(const Triangle_soup& soup, Index corner)
{
  const auto [u, v] = directions_at(soup, corner);
  return std::acos(std::clamp(internal::dot(u, v), -1.0, 1.0));
}

inline void add(Vector& sum, const Vector& normal, double weight)
{
  for (std::size_t i = 0; i < 3; ++i)
    sum[i] += weight * normal[i];
}

/// Rounds to what the formats that store floats hold, so that all formats show the same.
inline Vector stored(const Vector& normal)
{
  if (normal == Vector{})
    return {0, 0, 1};
  return {nearest_float32(normal[0]), nearest_float32(normal[1]), nearest_float32(normal[2])};
}

inline Vector normal_at(const Corner_values<3>& normals, Index triangle, std::size_t place)
{
  return normals.values[normals.of_triangle[triangle][place]];
}

/// Returns the cosines of the angles between a normal vector of a triangle and the normals at its corners.
inline std::array<double, 3> cosines(const Vector& front, const Corner_values<3>& normals, Index triangle)
{
  const auto cosine = [&](std::size_t place) {
    return internal::dot(front, unit(normal_at(normals, triangle, place)));
  };
  return {cosine(0), cosine(1), cosine(2)};
}

/// Returns 1 where these are the cosines of normals that point to the front on average, -1 where they point
/// to the back, and 0 where neither is so, as for a triangle without a direction.
inline int side_of(const std::array<double, 3>& cosines)
{
  const double sum = cosines[0] + cosines[1] + cosines[2];
  return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}

} // namespace selvedge::shading

#endif // SELVEDGE_SRC_SOUP_TRIANGLE_NORMALS_H
