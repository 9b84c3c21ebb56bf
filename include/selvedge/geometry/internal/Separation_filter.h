// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_INTERNAL_SEPARATION_FILTER_H
#define SELVEDGE_GEOMETRY_INTERNAL_SEPARATION_FILTER_H

#include <selvedge/internal/Vector_of_doubles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace selvedge {

/// Proves cheaply, in floating point, that simplices of a few points near each other do not meet.
///
/// The points are seen along a direction: the *view*. It has coordinates of its own, with a bound for their
/// error. Coordinates u and v span the plane of projection, and w is the height above it. The axes may be any
/// three vectors: what is proved in their coordinates is true, since the map to them is linear.
///
/// Two simplices are *clear* of each other when they have in common exactly the simplex spanned by the points
/// that are in both, and this is not a triangle. A plane proves it when one simplex lies on one side of it,
/// the other lies on the other side, and the plane itself contains nothing of them but a face of one. Why:
/// what the two have in common lies in this face, and in the hull of those points of the other simplex that
/// lie in the plane; they are corners of the face. The planes that are tried are those that the view shows as
/// the line of an edge, those of triangles, those parallel to them, and those of a box around some points.
///
/// **Guarantees** `is_clear…` is one-sided: true is proved, false is undecided.
///
/// **Exactness** Coordinates are doubles. Signs count only beyond the error bounds. These hold for rounding
/// to nearest when the largest distance of a point from the origin lies between 10⁻⁹⁰ and 10⁹⁰, which
/// `is_usable` checks.
///
/// **Complexity** Constant for a question; two products for the side of a line.
class Separation_filter
{
public:
  using Index = std::uint32_t;
  using Vector = internal::Vector_of_doubles;

  /// Starts an empty view, from the direction of `normal`, of points around `origin`. The normal may have any
  /// length from 10⁻¹⁵⁰ to 10¹⁵⁰; otherwise the view is not usable.
  void begin(const Vector& origin, const Vector& normal)
  {
    m_points.clear();
    m_origin = origin;
    m_lower.fill(-std::numeric_limits<double>::infinity());
    m_upper.fill(std::numeric_limits<double>::infinity());
    bound_errors(0);
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    m_is_directed = length > s_least_normal && length < 1 / s_least_normal;
    if (!m_is_directed)
      return;
    const double inverse = 1 / length;
    const Vector n{normal[0] * inverse, normal[1] * inverse, normal[2] * inverse};
    // The axes are perpendicular to each other up to rounding, which no proof needs.
    const std::size_t least = std::fabs(n[0]) <= std::fabs(n[1]) && std::fabs(n[0]) <= std::fabs(n[2])
                                  ? 0
                                  : (std::fabs(n[1]) <= std::fabs(n[2]) ? 1 : 2);
    Vector axis{0, 0, 0};
    axis[least] = 1;
    const Vector u = internal::cross(axis, n), v = internal::cross(n, u);
    // No component of an axis is larger than 1.
    m_axes = {u, v, n};
  }

  Index add(const Vector& point)
  {
    const Vector d = internal::difference(point, m_origin);
    const double distance = std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]);
    if (!(distance <= m_extent))
      bound_errors(distance);
    Seen_point seen;
    seen.outside = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = m_axes[i][0] * d[0] + m_axes[i][1] * d[1] + m_axes[i][2] * d[2];
      seen.position[i] = x;
      seen.outside |= unsigned(x < m_lower[i] - m_length_error) << 2 * i;
      seen.outside |= unsigned(x > m_upper[i] + m_length_error) << (2 * i + 1);
    }
    m_points.push_back(seen);
    return Index(m_points.size() - 1);
  }

  /// Puts a box around the points added so far, for `is_clear_of_box` of points that are added later.
  void enclose()
  {
    m_lower.fill(std::numeric_limits<double>::infinity());
    m_upper.fill(-std::numeric_limits<double>::infinity());
    for (const Seen_point& point : m_points)
      for (std::size_t i = 0; i < 3; ++i) {
        m_lower[i] = (std::min)(m_lower[i], point.position[i]);
        m_upper[i] = (std::max)(m_upper[i], point.position[i]);
      }
  }

  /// Whether a plane of the box proves the triangle clear of all enclosed points.
  bool is_clear_of_box(const std::array<Index, 3>& triangle) const
  {
    return (m_points[triangle[0]].outside & m_points[triangle[1]].outside & m_points[triangle[2]].outside) !=
           0;
  }

  /// Whether anything can be proved about the points added so far. More points may be added afterwards.
  bool is_usable() const { return m_is_directed && m_extent > s_least && m_extent < s_largest; }

  const Vector& operator[](Index i) const { return m_points[i].position; }

  /// The axes of the view, perpendicular to each other up to rounding and not longer than 1.
  const Vector& axis(std::size_t i) const { return m_axes[i]; }

  /// The largest distance of a point from the origin, as the sum of its coordinates' sizes.
  double extent() const { return m_extent; }

  /// How much twice the area of a triangle in the view must differ from 0 for its sign to be known.
  double area_error() const { return m_area_error; }

  /// Returns the side of the line from i to j on which k is seen: 1 left, −1 right, 0 not known.
  int side(Index i, Index j, Index k) const
  {
    const Vector &p = (*this)[i], &q = (*this)[j], &r = (*this)[k];
    const double area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    return int(area > m_area_error) - int(area < -m_area_error);
  }

  /// Whether a plane that the view shows as the line of one of the triangle's edges proves the triangle clear
  /// of every simplex of `points`.
  template <class Points>
  bool is_clear_by_edge(const std::array<Index, 3>& triangle, const Points& points) const
  {
    for (std::size_t e = 0; e < 3; ++e) {
      const Index i = triangle[e], j = triangle[(e + 1) % 3];
      const int far = -side(i, j, triangle[(e + 2) % 3]);
      if (far != 0 && std::all_of(points.begin(), points.end(),
                                  [&](Index p) { return p == i || p == j || side(i, j, p) == far; }))
        return true;
    }
    return false;
  }

  /// A set of points among the first `s_max_masked`, one bit for each.
  using Mask = std::uint64_t;
  static constexpr std::size_t s_max_masked = 64;

  /// Returns the mask of some points; 0, about which nothing can be proved, when one of them has no bit.
  template <class Points>
  static Mask mask(const Points& points)
  {
    Mask result = 0;
    for (const Index p : points) {
      if (p >= s_max_masked)
        return 0;
      result |= Mask(1) << p;
    }
    return result;
  }

  /// The points that are known to lie above and below the plane of a triangle. Its corners count as both.
  struct Heights
  {
    Mask above = 0, below = 0;
    Mask corners = 0; ///< all bits when a corner has no bit

    /// Whether the plane of the triangle proves it clear of every simplex of these points.
    bool is_clear(Mask points) const
    {
      return points != 0 && ((above & points) == points || (below & points) == points) &&
             (corners & ~points) != 0;
    }
  };

  /// Returns on which side of the triangle's plane the first `count` points lie.
  Heights heights(const std::array<Index, 3>& triangle, std::size_t count) const
  {
    const Vector normal = this->normal(triangle);
    const double level = internal::dot(normal, (*this)[triangle[0]]);
    Heights result;
    for (Index p = 0; p < (std::min)(count, s_max_masked); ++p) {
      const double height = internal::dot(normal, (*this)[p]) - level;
      result.above |= Mask(height > m_volume_error) << p;
      result.below |= Mask(height < -m_volume_error) << p;
    }
    for (const Index corner : triangle)
      result.corners |= corner < s_max_masked ? Mask(1) << corner : 0;
    result.above |= result.corners;
    result.below |= result.corners;
    if ((std::max)({triangle[0], triangle[1], triangle[2]}) >= s_max_masked)
      result.corners = ~Mask(0);
    return result;
  }

  /// The normal of a triangle, and the heights along it between which the triangle and one more point lie.
  struct Slab
  {
    Vector normal;
    double lower, upper;
  };
  Slab slab(const std::array<Index, 3>& triangle, Index point) const
  {
    Slab result;
    result.normal = normal(triangle);
    result.lower = result.upper = internal::dot(result.normal, (*this)[point]);
    for (const Index corner : triangle) {
      const double height = internal::dot(result.normal, (*this)[corner]);
      result.lower = (std::min)(result.lower, height);
      result.upper = (std::max)(result.upper, height);
    }
    return result;
  }

  /// Whether a plane parallel to the slab proves the triangle clear of everything in the slab.
  bool is_clear_of_slab(const std::array<Index, 3>& triangle, const Slab& slab) const
  {
    const double a = internal::dot(slab.normal, (*this)[triangle[0]]),
                 b = internal::dot(slab.normal, (*this)[triangle[1]]),
                 c = internal::dot(slab.normal, (*this)[triangle[2]]);
    return (a > slab.upper + m_volume_error && b > slab.upper + m_volume_error &&
            c > slab.upper + m_volume_error) ||
           (a < slab.lower - m_volume_error && b < slab.lower - m_volume_error &&
            c < slab.lower - m_volume_error);
  }

  /// Whether a plane that the view shows as the line of one of the tetrahedron's edges proves the triangle
  /// clear of the tetrahedron.
  bool is_clear_by_edge_of(const std::array<Index, 4>& tetrahedron,
                           const std::array<Index, 3>& triangle) const
  {
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        const Index i = tetrahedron[a], j = tetrahedron[b];
        // The other two corners.
        const std::size_t c = a != 0 ? 0 : (b != 1 ? 1 : 2), d = 6 - a - b - c;
        const int near = side(i, j, tetrahedron[c]);
        if (near != 0 && near == side(i, j, tetrahedron[d]) &&
            std::all_of(triangle.begin(), triangle.end(),
                        [&](Index p) { return p == i || p == j || side(i, j, p) == -near; }))
          return true;
      }
    return false;
  }

private:
  struct alignas(32) Seen_point
  {
    Vector position;
    unsigned outside; ///< two bits for each coordinate: surely below the box, surely above it
  };

  static constexpr double s_least = 1e-90, s_largest = 1e90;
  static constexpr double s_least_normal = 1e-150; // the squares of shorter normals are less exact

  // Let r be the largest distance from the origin (in the 1-norm), and ε = 2⁻⁵³.
  // - A coordinate is at most r (1 + 8 ε), and wrong by at most 8 ε r.
  // - A difference of two coordinates is wrong by at most 18 ε r.
  // - A side is a sum of two products of differences, each at most 2 r. It is wrong by at most
  //   2 · 2 · (2 r · 18 ε r) + 3 · 8 ε r² < 2⁸ ε r².
  // - So is ax + by + c, where a and b are differences, x and y are coordinates, and c = −(ax₀ + by₀). It is
  //   wrong by at most 4 · (r · 18 ε r + 2 r · 8 ε r) + 3 · 8 ε r².
  // - A normal has three components, each computed like a side, and each at most 8 r².
  // - So a height above a plane, the difference of two products with the normal, is wrong by at most
  //   3 · 2⁸ ε r² · 2 r for the normal, 2 · 3 · 8 r² · 8 ε r for the coordinates, and 200 ε r³ for rounding:
  //   together less than 2¹² ε r³.
  //
  // The bounds below are twice these. They hold as well where the compiler contracts a product and a sum into
  // one operation (-ffp-contract=fast): that rounds once where two roundings are counted here.
  void bound_errors(double extent)
  {
    m_extent = extent;
    // Where products may overflow, nothing can be proved.
    const double r = extent < s_largest ? extent : std::numeric_limits<double>::infinity();
    m_length_error = 0x1p-48 * r;
    m_area_error = 0x1p-44 * r * r;
    m_volume_error = 0x1p-40 * r * r * r;
  }

  Vector normal(const std::array<Index, 3>& triangle) const
  {
    const Vector& o = (*this)[triangle[0]];
    return internal::cross(internal::difference((*this)[triangle[1]], o),
                           internal::difference((*this)[triangle[2]], o));
  }

  Vector m_origin{};
  std::array<Vector, 3> m_axes{};
  std::vector<Seen_point> m_points;
  Vector m_lower{}, m_upper{}; // of the enclosed points
  double m_extent = 0;
  double m_length_error = 0, m_area_error = 0, m_volume_error = 0;
  bool m_is_directed = false;
};

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_INTERNAL_SEPARATION_FILTER_H
