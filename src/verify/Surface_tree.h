// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_SURFACE_TREE_H
#define SELVEDGE_VERIFY_SURFACE_TREE_H

#include <selvedge/mesh/Triangle_soup.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>

#include <boost/iterator/counting_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge::internal {

using Vector_3 = Kernel::Vector_3;
using Segment_3 = Kernel::Segment_3;
using Triangle_3 = Kernel::Triangle_3;

/// The vertices that triangles name, each once, in the order in which they are named first.
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

/// The exponent of the power of two by which two soups are brought to a size at which squares neither
/// overflow nor vanish, without the loss of a digit.
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

/// The triangles of a soup with their points divided by 2^exponent.
struct Surface
{
  Surface(const Triangle_soup& soup, int exponent) : triangles(soup.triangles)
  {
    points.reserve(soup.points.size());
    for (const Point_3& point : soup.points)
      points.push_back(scaled(point, -exponent));
  }

  const Point_3& corner(Index triangle, int place) const { return points[triangles[triangle][place]]; }
  Triangle_3 triangle(Index number) const
  {
    return Triangle_3(corner(number, 0), corner(number, 1), corner(number, 2));
  }
  /// Perpendicular to the triangle, twice as long as its area.
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

/// The nearest point of a triangle, degenerate ones included; whatever rounding does, it is one of the
/// triangle.
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

/// The triangles of a surface, degenerate ones included, in CGAL's AABB tree.
class Surface_tree
{
public:
  /// **Preconditions** The surface has a triangle, and outlives the tree.
  explicit Surface_tree(const Surface& surface) : m_shared{&surface, nullptr, {}}
  {
    using Counter = boost::counting_iterator<Index>;
    m_tree.insert(Counter(0), Counter(static_cast<Index>(surface.triangles.size())), &m_shared);
    m_tree.build();
    m_last = {surface.corner(0, 0), 0};
  }
  Surface_tree(const Surface_tree&) = delete;
  Surface_tree& operator=(const Surface_tree&) = delete;

  struct Nearest
  {
    Point_3 point;
    Index triangle;
  };

  /// The last answer is the first guess, so queries near each other should follow each other.
  Nearest nearest(const Point_3& query)
  {
    const auto [point, triangle] = m_tree.closest_point_and_primitive(query, {m_last.point, m_last.triangle});
    return m_last = {point, triangle};
  }

  /// The same, with a triangle for a first guess.
  Nearest nearest(const Point_3& query, Index guess)
  {
    m_last = {nearest_on_triangle(query, m_shared.surface->triangle(guess)), guess};
    return nearest(query);
  }

  /// The nearest, no farther than `limit`, among triangles whose entry in `directions` has a positive product
  /// with `direction`.
  std::optional<Nearest> nearest_facing(const Point_3& query, const std::vector<Vector_3>& directions,
                                        const Vector_3& direction, double limit)
  {
    constexpr Index none = -1;
    m_shared.directions = &directions;
    m_shared.direction = direction;
    const auto [point, triangle] =
        m_tree.closest_point_and_primitive(query, {query + Vector_3(limit, 0, 0), none});
    m_shared.directions = nullptr;
    return triangle == none ? std::nullopt : std::optional(Nearest{point, triangle});
  }

  /// All triangles that are not degenerate and meet a segment; decided exactly.
  template <class Output_iterator>
  void crossed(const Segment_3& segment, Output_iterator output) const
  {
    m_tree.all_intersected_primitives(segment, output);
  }

private:
  struct Shared
  {
    const Surface* surface;
    const std::vector<Vector_3>* directions;
    Vector_3 direction;

    bool is_wanted(Index triangle) const { return !directions || (*directions)[triangle] * direction > 0; }
  };

  /// A triangle by its number.
  class Primitive
  {
  public:
    using Point = Point_3;
    using Datum = Triangle_3;
    using Id = Index;
    using Shared_data = const Shared*;

    Primitive(boost::counting_iterator<Index> triangle, Shared_data) : m_triangle(*triangle) {}

    static Shared_data construct_shared_data(Shared_data shared) { return shared; }
    Id id() const { return m_triangle; }
    Point reference_point(Shared_data shared) const { return shared->surface->corner(m_triangle, 0); }
    Datum datum(Shared_data shared) const { return shared->surface->triangle(m_triangle); }

  private:
    Index m_triangle;
  };

  /// CGAL's traits, but what takes distances does so in plain doubles, and nothing minds a degenerate
  /// triangle.
  class Traits : public CGAL::AABB_traits<Kernel, Primitive>
  {
  public:
    struct Closest_point
    {
      const Traits& traits;

      Point_3 operator()(const Point_3& query, const Primitive& primitive, const Point_3& bound) const
      {
        if (!traits.shared_data()->is_wanted(primitive.id()))
          return bound;
        const Point_3 nearest = nearest_on_triangle(query, primitive.datum(traits.shared_data()));
        return CGAL::squared_distance(query, nearest) < CGAL::squared_distance(query, bound) ? nearest
                                                                                             : bound;
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

    struct Do_intersect
    {
      const Traits& traits;

      bool operator()(const Segment_3& query, const CGAL::Bbox_3& box) const
      {
        return CGAL::do_intersect(query, box);
      }
      bool operator()(const Segment_3& query, const Primitive& primitive) const
      {
        const Triangle_3 triangle = primitive.datum(traits.shared_data());
        return !triangle.is_degenerate() && CGAL::do_intersect(query, triangle);
      }
    };

    Closest_point closest_point_object() const { return {*this}; }
    Compare_distance compare_distance_object() const { return {}; }
    Do_intersect do_intersect_object() const { return {*this}; }
  };

  Shared m_shared;
  CGAL::AABB_tree<Traits> m_tree;
  Nearest m_last;
};

} // namespace selvedge::internal

#endif // SELVEDGE_VERIFY_SURFACE_TREE_H
