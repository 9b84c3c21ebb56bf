// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "triangle_distance.h"

#include <CGAL/Interval_nt.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <limits>

namespace selvedge::internal {
namespace {

using Interval = CGAL::Interval_nt_advanced;

double dot_product(const Corner& a, const Corner& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Corner minus(const Corner& a, const Corner& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Corner cross_product_of(const Corner& a, const Corner& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The point o + s (x − o) + t (y − o) of a triangle: s, t ≥ 0 and s + t ≤ 1.
struct Foot
{
  const Corner *o, *x, *y;
  double s = 0, t = 0;

  Corner rounded() const
  {
    const Corner u = minus(*x, *o), v = minus(*y, *o);
    return {(*o)[0] + s * u[0] + t * v[0], (*o)[1] + s * u[1] + t * v[1], (*o)[2] + s * u[2] + t * v[2]};
  }
  Interval enclosed(int axis) const
  {
    const Interval from((*o)[axis]);
    return from + Interval(s) * (Interval((*x)[axis]) - from) + Interval(t) * (Interval((*y)[axis]) - from);
  }
};

/// The nearest points of two triangles that were found so far, in floating point.
struct Feet
{
  Foot of_a, of_b;
  double squared = std::numeric_limits<double>::infinity();

  void consider(const Foot& a, const Foot& b)
  {
    const Corner way = minus(b.rounded(), a.rounded());
    if (const double length = dot_product(way, way); length < squared) {
      of_a = a;
      of_b = b;
      squared = length;
    }
  }
};

double share(double numerator, double denominator)
{
  return denominator > 0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0;
}

// The nearest points of two edges (Ericson, Real-Time Collision Detection, 5.1.9).
void consider_edges(const Corner& a0, const Corner& a1, const Corner& b0, const Corner& b1, Feet& feet)
{
  const Corner u = minus(a1, a0), v = minus(b1, b0), w = minus(a0, b0);
  const double uu = dot_product(u, u), vv = dot_product(v, v), uv = dot_product(u, v), uw = dot_product(u, w),
               vw = dot_product(v, w);
  double s = share(uv * vw - uw * vv, uu * vv - uv * uv);
  const double t = share(uv * s + vw, vv);
  s = share(uv * t - uw, uu);
  feet.consider({&a0, &a1, &a1, s}, {&b0, &b1, &b1, t});
}

// Where the foot of a corner in the plane of a triangle lies inside; where it does not, an edge is nearer.
template <class Consider>
void consider_corner(const Corner& p, const Corners& b, const Consider& consider)
{
  const Corner u = minus(b[1], b[0]), v = minus(b[2], b[0]), w = minus(p, b[0]), n = cross_product_of(u, v);
  const double area = dot_product(n, n);
  const double s = dot_product(n, cross_product_of(w, v)) / area,
               t = dot_product(n, cross_product_of(u, w)) / area;
  constexpr double inside = 1 - 0x1p-50; // so that s + t ≤ 1 is true of the numbers themselves
  if (area > 0 && s >= 0 && t >= 0 && s + t <= inside)
    consider(Foot{&p, &p, &p}, Foot{&b[0], &b[1], &b[2], s, t});
}

Interval least_along(const std::array<Interval, 3>& direction, const Corners& corners, int sign)
{
  const auto height = [&](const Corner& p) {
    return Interval(sign) *
           (direction[0] * Interval(p[0]) + direction[1] * Interval(p[1]) + direction[2] * Interval(p[2]));
  };
  Interval least = height(corners[0]);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Interval at = height(corners[i]);
    least = Interval((std::min)(least.inf(), at.inf()), (std::min)(least.sup(), at.sup()));
  }
  return least;
}

struct Exact_vector
{
  Exact_number x, y, z;

  Exact_vector operator-(const Exact_vector& other) const { return {x - other.x, y - other.y, z - other.z}; }
  Exact_number dot(const Exact_vector& other) const { return x * other.x + y * other.y + z * other.z; }
  Exact_number square() const { return dot(*this); }
  Exact_vector cross(const Exact_vector& other) const
  {
    return {y * other.z - z * other.y, z * other.x - x * other.z, x * other.y - y * other.x};
  }
};

Exact_vector exact_vector(const Corner& p)
{
  return {Exact_number(p[0]), Exact_number(p[1]), Exact_number(p[2])};
}

// Whether an edge of one of two triangles meets the inside of the other, as it does where they meet other
// than edge to edge.
bool do_triangles_meet(const Corners& a, const Corners& b)
{
  const auto point = [](const Corner& p) { return Point_3(p[0], p[1], p[2]); };
  const auto meets_edge_of = [&](const Corners& face, const Corners& other) {
    const Kernel::Triangle_3 triangle(point(face[0]), point(face[1]), point(face[2]));
    for (std::size_t i = 0; i < 3 && !triangle.is_degenerate(); ++i)
      if (const Kernel::Segment_3 edge(point(other[i]), point(other[(i + 1) % 3]));
          !edge.is_degenerate() && CGAL::do_intersect(triangle, edge))
        return true;
    return false;
  };
  return meets_edge_of(a, b) || meets_edge_of(b, a);
}

} // namespace

Bounds squared_distance_bounds(const Corners& a, const Corners& b)
{
  Feet feet;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      consider_edges(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], feet);
    consider_corner(a[i], b, [&](const Foot& corner, const Foot& foot) { feet.consider(corner, foot); });
    consider_corner(b[i], a, [&](const Foot& corner, const Foot& foot) { feet.consider(foot, corner); });
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!(feet.squared < infinity))
    return {0, infinity};
  const CGAL::Protect_FPU_rounding<true> upward;
  std::array<Interval, 3> way, direction;
  const Corner from = feet.of_a.rounded(), to = feet.of_b.rounded();
  for (int axis = 0; axis < 3; ++axis) {
    way[axis] = feet.of_b.enclosed(axis) - feet.of_a.enclosed(axis);
    direction[axis] = Interval(to[axis] - from[axis]); // any direction will do
  }
  const auto squared_length = [](const std::array<Interval, 3>& v) {
    return CGAL::square(v[0]) + CGAL::square(v[1]) + CGAL::square(v[2]);
  };
  const Interval gap = least_along(direction, b, 1) + least_along(direction, a, -1);
  const Interval length = squared_length(direction);
  const double lower = gap.inf() > 0 && length.inf() > 0 ? (CGAL::square(gap) / length).inf() : 0;
  return {(std::max)(lower, 0.0), squared_length(way).sup()};
}

Exact_square exact_squared_distance(const Corners& a, const Corners& b)
{
  if (do_triangles_meet(a, b))
    return 0;
  const std::array<Exact_vector, 3> of_a{exact_vector(a[0]), exact_vector(a[1]), exact_vector(a[2])},
      of_b{exact_vector(b[0]), exact_vector(b[1]), exact_vector(b[2])};
  Exact_square least = (of_b[0] - of_a[0]).square();
  const auto take = [&](const Exact_number& numerator, const Exact_number& denominator) {
    least = (std::min)(least, Exact_square(numerator, denominator));
  };
  const auto is_share = [](const Exact_number& numerator, const Exact_number& denominator) {
    return numerator >= 0 && numerator <= denominator;
  };
  // The foot of a corner on an edge, and in the plane of a triangle.
  const auto take_corner = [&](const Exact_vector& p, const std::array<Exact_vector, 3>& of) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Exact_vector edge = of[(j + 1) % 3] - of[j], way = p - of[j];
      take(way.square(), 1);
      if (const Exact_number length = edge.square(); length > 0 && is_share(edge.dot(way), length))
        take(edge.cross(way).square(), length);
    }
    const Exact_vector u = of[1] - of[0], v = of[2] - of[0], way = p - of[0], normal = u.cross(v);
    const Exact_number area = normal.square(), s = way.cross(v).dot(normal), t = u.cross(way).dot(normal);
    if (area > 0 && s >= 0 && t >= 0 && s + t <= area) {
      const Exact_number height = way.dot(normal);
      take(height * height, area);
    }
  };
  for (std::size_t i = 0; i < 3; ++i) {
    take_corner(of_a[i], of_b);
    take_corner(of_b[i], of_a);
    for (std::size_t j = 0; j < 3; ++j) {
      const Exact_vector u = of_a[(i + 1) % 3] - of_a[i], v = of_b[(j + 1) % 3] - of_b[j],
                         way = of_b[j] - of_a[i], normal = u.cross(v);
      const Exact_number area = normal.square();
      if (area > 0 && is_share(way.cross(v).dot(normal), area) && is_share(way.cross(u).dot(normal), area)) {
        const Exact_number height = way.dot(normal);
        take(height * height, area);
      }
    }
  }
  return least;
}

Exact_square exact_square(double number)
{
  return Exact_number(number) * Exact_number(number);
}

Bounds square_bounds(double number)
{
  const CGAL::Protect_FPU_rounding<true> upward;
  const Interval square = CGAL::square(Interval(number));
  return {square.inf(), square.sup()};
}

Bounds root_bounds(const Bounds& square)
{
  const CGAL::Protect_FPU_rounding<true> upward;
  const Interval root = CGAL::sqrt(Interval(square.lower, square.upper));
  return {(std::max)(root.inf(), 0.0), root.sup()};
}

} // namespace selvedge::internal
