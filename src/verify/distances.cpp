// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/verify.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <boost/iterator/counting_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace selvedge {
namespace {

using Vector_3 = Kernel::Vector_3;
using Triangle_3 = Kernel::Triangle_3;

std::vector<Index> used_vertices(const Triangle_soup& soup)
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

double largest_coordinate(const Triangle_soup& soup)
{
  double largest = 0;
  for (const Index vertex : used_vertices(soup))
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(soup.points[vertex][axis]));
  return largest;
}

Point_3 scaled(const Point_3& p, int exponent)
{
  return Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
}

struct Surface
{
  const std::vector<Index_triple>& triangles;
  std::vector<Point_3> points;
};

/// A triangle by its number, for `CGAL::AABB_tree`.
class Primitive
{
public:
  using Point = Point_3;
  using Datum = Triangle_3;
  using Id = Index;
  using Shared_data = const Surface*;

  Primitive(boost::counting_iterator<Index> triangle, Shared_data) : m_triangle(*triangle) {}

  static Shared_data construct_shared_data(Shared_data surface) { return surface; }
  Id id() const { return m_triangle; }
  Point reference_point(Shared_data surface) const
  {
    return surface->points[surface->triangles[m_triangle][0]];
  }
  Datum datum(Shared_data surface) const
  {
    const auto& [a, b, c] = surface->triangles[m_triangle];
    return Datum(surface->points[a], surface->points[b], surface->points[c]);
  }

private:
  Index m_triangle;
};

Point_3 nearest_on_segment(const Point_3& query, const Point_3& from, const Point_3& to)
{
  const Vector_3 direction = to - from;
  const double length = direction.squared_length();
  const double position = length > 0 ? direction * (query - from) / length : 0;
  return from + std::clamp(position, 0.0, 1.0) * direction;
}

/// CGAL's traits, but what takes distances does so in plain doubles, and minds no degenerate triangle:
/// whatever rounding does, the point found is one of the triangle.
class Traits : public CGAL::AABB_traits<Kernel, Primitive>
{
public:
  struct Closest_point
  {
    const Traits& traits;

    Point_3 operator()(const Point_3& query, const Primitive& primitive, const Point_3& bound) const
    {
      const Triangle_3 triangle = primitive.datum(traits.shared_data());
      Point_3 nearest = bound;
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
  };

  struct Compare_distance
  {
    CGAL::Comparison_result operator()(const Point_3& query, const CGAL::Bbox_3& box,
                                       const Point_3& bound) const
    {
      double distance = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double gap = std::max({box.min(axis) - query[axis], 0.0, query[axis] - box.max(axis)});
        distance += gap * gap;
      }
      return CGAL::compare(distance, CGAL::squared_distance(query, bound));
    }
  };

  Closest_point closest_point_object() const { return {*this}; }
  Compare_distance compare_distance_object() const { return {}; }
};

} // namespace

Distance distance(const Triangle_soup& from, const Triangle_soup& to)
{
  if (from.triangles.empty())
    return {0, 0};
  if (to.triangles.empty())
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

  // Brought to a size at which squares neither overflow nor vanish: by a power of two, so that no digit is
  // lost.
  int exponent = 0;
  std::frexp(std::max(largest_coordinate(from), largest_coordinate(to)), &exponent);
  Surface surface = {to.triangles, to.points};
  for (Point_3& point : surface.points)
    point = scaled(point, -exponent);
  std::vector<Point_3> queries;
  for (const Index vertex : used_vertices(from))
    queries.push_back(scaled(from.points[vertex], -exponent));

  using Counter = boost::counting_iterator<Index>;
  CGAL::AABB_tree<Traits> tree;
  tree.insert(Counter(0), Counter(static_cast<Index>(to.triangles.size())), &surface);
  tree.build();

  // Neighbours follow each other along a space-filling curve, so the last answer is a good guess at the next.
  CGAL::hilbert_sort(queries.begin(), queries.end());
  double sum = 0, maximum = 0;
  Point_3 nearest = surface.points[to.triangles[0][0]];
  for (const Point_3& query : queries) {
    nearest = tree.closest_point(query, nearest);
    const double squared_distance = CGAL::squared_distance(query, nearest);
    sum += squared_distance;
    maximum = std::max(maximum, squared_distance);
  }
  const double mean = sum / static_cast<double>(queries.size());
  return {std::ldexp(std::sqrt(mean), exponent), std::ldexp(std::sqrt(maximum), exponent)};
}

Distances distances(const Triangle_soup& result, const Triangle_soup& original)
{
  CGAL::Bbox_3 box;
  for (const Index vertex : used_vertices(original))
    box += original.points[vertex].bbox();
  const double diagonal =
      original.triangles.empty() ? 0 : std::hypot(box.x_span(), box.y_span(), box.z_span());
  const double unit = diagonal > 0 ? diagonal : 1;
  const auto relative = [&](const Distance& d) {
    return Distance{d.root_mean_square / unit, d.maximum / unit};
  };
  return {relative(distance(original, result)), relative(distance(result, original)), diagonal};
}

} // namespace selvedge
