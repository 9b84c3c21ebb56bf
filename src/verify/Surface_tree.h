// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_SURFACE_TREE_H
#define SELVEDGE_VERIFY_SURFACE_TREE_H

#include "Triangle_tree.h"

#include <selvedge/Triangle_soup.h>

#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

// The surface of a soup in a tree of boxes. `verify` and `compare` ask it for nearest points, and `compare`
// for the triangles that a line crosses.

namespace selvedge::internal {

using Vector_3 = Kernel::Vector_3;
using Segment_3 = Kernel::Segment_3;
using Triangle_3 = Kernel::Triangle_3;

/// Returns the vertices that triangles use, each once, in the order of their first use.
inline std::vector<Index> used_vertices(const Triangle_soup& soup)
{
  std::vector<bool> used(soup.points.size());
  std::vector<Index> vertices;
  for (const Index_triple& triangle : soup.triangles)
    for (const Index vertex : triangle)
      if (!used[vertex]) {
        used[vertex] = true;
        vertices.push_back(vertex);
      }
  return vertices;
}

/// Returns the exponent of a power of two. Divided by it, the largest coordinate of both soups lies between
/// 1/2 and 1, so that squares of lengths neither overflow nor vanish. The division rounds nothing unless a
/// coordinate becomes subnormal.
inline int common_exponent(const Triangle_soup& first, const Triangle_soup& second)
{
  double largest = 0;
  for (const Triangle_soup* soup : {&first, &second})
    for (const Index vertex : used_vertices(*soup))
      for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(soup->points[vertex][axis]));
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent;
}

inline Point_3 scaled(const Point_3& p, int exponent)
{
  return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
}

/// The triangles of a soup, which must outlive this, with all points divided by 2^exponent. With an origin,
/// coordinates are differences from its, rounded: near the origin, what is computed from them is then as
/// accurate as the surface is small, however far away it lies from zero.
struct Surface
{
  Surface(const Triangle_soup& soup, int exponent, const Point_3& origin = Point_3(0, 0, 0))
      : triangles(soup.triangles)
  {
    const Vector_3 shift = scaled(origin, -exponent) - Point_3(0, 0, 0);
    points.reserve(soup.points.size());
    for (const Point_3& point : soup.points)
      points.push_back(scaled(point, -exponent) - shift);
  }

  const Point_3& corner(Index triangle, int place) const { return points[triangles[triangle][place]]; }
  Triangle_3 triangle(Index number) const
  {
    return Triangle_3(corner(number, 0), corner(number, 1), corner(number, 2));
  }
  /// Returns a normal whose length is twice the area of the triangle.
  Vector_3 normal(Index triangle) const
  {
    return CGAL::cross_product(corner(triangle, 1) - corner(triangle, 0),
                               corner(triangle, 2) - corner(triangle, 0));
  }
  bool is_degenerate(Index triangle) const
  {
    return CGAL::collinear(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
  }

  const std::vector<Index_triple>& triangles;
  std::vector<Point_3> points;
};

inline Point_3 nearest_on_segment(const Point_3& query, const Point_3& from, const Point_3& to)
{
  const Vector_3 direction = to - from;
  const double length = direction.squared_length();
  const double position = length > 0 ? direction * (query - from) / length : 0;
  return position <= 0 ? from : position >= 1 ? to : from + position * direction;
}

/// Returns the point of a triangle, which may be degenerate, that is nearest to `query`. Rounding may choose
/// another point of the triangle, so a distance may come out too large, but not too small.
inline Point_3 nearest_on_triangle(const Point_3& query, const Triangle_3& triangle)
{
  Point_3 nearest = triangle[0];
  const auto consider = [&](const Point_3& point) {
    if (CGAL::squared_distance(query, point) < CGAL::squared_distance(query, nearest))
      nearest = point;
  };
  for (int i = 0; i < 3; ++i)
    consider(nearest_on_segment(query, triangle[i], triangle[i + 1]));

  const Vector_3 b = triangle[1] - triangle[0], c = triangle[2] - triangle[0], q = query - triangle[0];
  const Vector_3 normal = CGAL::cross_product(b, c);
  const double area = normal.squared_length();
  const double along_b = normal * CGAL::cross_product(q, c) / area;
  const double along_c = normal * CGAL::cross_product(b, q) / area;
  if (area > 0 && along_b >= 0 && along_c >= 0 && along_b + along_c <= 1)
    consider(triangle[0] + along_b * b + along_c * c);
  return nearest;
}

/// Returns whether the plane of a triangle, and so the triangle, is surely farther from `query` than the root
/// of `squared_bound`. False says nothing: it is for triangles that are much farther away than their boxes.
inline bool is_plane_beyond(const Point_3& query, const Triangle_3& triangle, double squared_bound)
{
  const Vector_3 b = triangle[1] - triangle[0], c = triangle[2] - triangle[0], q = query - triangle[0];
  const Vector_3 normal = CGAL::cross_product(b, c);
  const double height = normal * q, largest_normal = b.squared_length() * c.squared_length();
  // Rounding changes the normal by less than 2e-15 |b| |c|, and the height by less than that times |q|. As
  // (x + y)² <= 2 x² + 2 y², the squares need no roots.
  constexpr double rounding = 1e-28;
  return height * height > 2.1 * (squared_bound * (normal.squared_length() + rounding * largest_normal) +
                                  rounding * largest_normal * q.squared_length());
}

/// Finds nearest points on a surface, and the triangles that meet a segment, in a tree of boxes. The surface
/// may have degenerate triangles.
class Surface_tree
{
public:
  /// **Preconditions** The surface has a triangle, and outlives the tree.
  explicit Surface_tree(const Surface& surface)
      : m_surface(surface), m_tree(surface.points, surface.triangles)
  {
  }

  struct Nearest
  {
    Point_3 point;
    Index triangle;
    std::size_t looks = 0; ///< how many triangles were looked at for it
  };

  /// Returns the nearest point. The search starts from the last answer, so it is fast when successive queries
  /// are near each other.
  Nearest nearest(const Point_3& query)
  {
    const Nearest nearest = this->nearest(query, m_last);
    m_last = nearest.triangle;
    return nearest;
  }

  /// Returns the nearest point. The search starts from the triangle `guess`.
  Nearest nearest(const Point_3& query, Index guess) const
  {
    Nearest nearest{nearest_on_triangle(query, m_surface.triangle(guess)), guess};
    approach(query, CGAL::squared_distance(query, nearest.point), nearest, [](Index) { return true; });
    return nearest;
  }

  /// Returns the nearest point that is nearer than `limit`, among the triangles whose entry in `directions`
  /// has a scalar product above `least_product` with `direction`; none if there is none.
  std::optional<Nearest> nearest_facing(const Point_3& query, const std::vector<Vector_3>& directions,
                                        const Vector_3& direction, double limit,
                                        double least_product = 0) const
  {
    constexpr Index none = -1;
    Nearest nearest{query, none};
    approach(query, limit * limit, nearest,
             [&](Index triangle) { return directions[triangle] * direction > least_product; });
    return nearest.triangle == none ? std::nullopt : std::optional(nearest);
  }

  /// Outputs all triangles that are not degenerate and meet a segment; decided exactly.
  template <class Output_iterator>
  void crossed(const Segment_3& segment, Output_iterator output) const
  {
    m_tree.visit([&](const CGAL::Bbox_3& box) { return CGAL::do_intersect(segment, box); },
                 [&](Index number) {
                   if (!m_surface.is_degenerate(number) &&
                       CGAL::do_intersect(segment, m_surface.triangle(number)))
                     *output++ = number;
                 });
  }

private:
  template <class Is_wanted>
  void approach(const Point_3& query, double squared_bound, Nearest& nearest,
                const Is_wanted& is_wanted) const
  {
    m_tree.approach(query, squared_bound, [&](Index triangle) {
      ++nearest.looks;
      if (!is_wanted(triangle) || is_plane_beyond(query, m_surface.triangle(triangle), squared_bound))
        return;
      const Point_3 point = nearest_on_triangle(query, m_surface.triangle(triangle));
      const double squared_distance = CGAL::squared_distance(query, point);
      if (squared_distance < squared_bound) {
        squared_bound = squared_distance;
        nearest.point = point;
        nearest.triangle = triangle;
      }
    });
  }

  const Surface& m_surface;
  Triangle_tree m_tree;
  Index m_last = 0;
};

} // namespace selvedge::internal

#endif // SELVEDGE_VERIFY_SURFACE_TREE_H
