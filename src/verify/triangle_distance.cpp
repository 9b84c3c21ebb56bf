// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "triangle_distance.h"

#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

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
  Interval least(std::numeric_limits<double>::infinity());
  for (const Corner& p : corners) {
    const Interval at = Interval(sign) * (direction[0] * Interval(p[0]) + direction[1] * Interval(p[1]) +
                                          direction[2] * Interval(p[2]));
    least = Interval((std::min)(least.inf(), at.inf()), (std::min)(least.sup(), at.sup()));
  }
  return least;
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

CGAL::Exact_rational exact_squared_distance(const Corners& a, const Corners& b)
{
  using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const auto triangle = [](const Corners& corners) {
    const auto point = [](const Corner& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
    return Kernel::Triangle_3(point(corners[0]), point(corners[1]), point(corners[2]));
  };
  const Kernel::Triangle_3 of_a = triangle(a), of_b = triangle(b);
  CGAL::Exact_rational least = CGAL::squared_distance(of_a[0], of_b[0]);
  const auto take = [&](const CGAL::Exact_rational& squared) { least = (std::min)(least, squared); };
  const auto take_edges = [&](const Kernel::Point_3& p, const Kernel::Point_3& q, const Kernel::Point_3& r,
                              const Kernel::Point_3& s) {
    if (p == q && r == s)
      take(CGAL::squared_distance(p, r));
    else if (p == q || r == s)
      take(p == q ? CGAL::squared_distance(p, Kernel::Segment_3(r, s))
                  : CGAL::squared_distance(r, Kernel::Segment_3(p, q)));
    else
      take(CGAL::squared_distance(Kernel::Segment_3(p, q), Kernel::Segment_3(r, s)));
  };
  // Where two triangles meet, an edge of one meets the other.
  const auto meets_edge_of = [](const Kernel::Triangle_3& face, const Kernel::Triangle_3& other) {
    for (int i = 0; i < 3 && !face.is_degenerate(); ++i)
      if (other[i] != other[i + 1] && CGAL::do_intersect(face, Kernel::Segment_3(other[i], other[i + 1])))
        return true;
    return false;
  };
  if (meets_edge_of(of_a, of_b) || meets_edge_of(of_b, of_a))
    return 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      take_edges(of_a[i], of_a[i + 1], of_b[j], of_b[j + 1]);
    if (!of_b.is_degenerate())
      take(CGAL::squared_distance(of_a[i], of_b));
    if (!of_a.is_degenerate())
      take(CGAL::squared_distance(of_b[i], of_a));
  }
  return least;
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
