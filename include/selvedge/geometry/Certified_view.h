// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_CERTIFIED_VIEW_H
#define SELVEDGE_GEOMETRY_CERTIFIED_VIEW_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace selvedge {

/// A few points near each other, seen along a direction, in coordinates of their own and with a bound for the
/// error of these: a cheap way to prove that simplices of the points do not meet.
///
/// Coordinates u and v span the plane of projection, w is the height above it. The axes are any three
/// vectors: what is proved in their coordinates is true, since the map to them is linear.
///
/// Two simplices are *clear* of each other when they have in common exactly the simplex spanned by the points
/// that are in both, and this is not a triangle. A plane proves it that has one of them on one side, the
/// other on the other side, and on itself nothing but a face of one of them: what they have in common lies in
/// this face, and in the hull of those points of the other that lie in the plane. Such a plane is sought here
/// among those that stand on a line, and those of triangles.
///
/// **Guarantees** What `is_*` answers with yes is so. No means "not proved".
///
/// **Exactness** Coordinates are doubles. Signs count only beyond the error bounds, which hold for rounding
/// to nearest and points whose distances from the origin lie between 10⁻⁹⁰ and 10⁹⁰ or are zero.
///
/// **Complexity** Constant for a question; two products for the side of a line.
class Certified_view
{
public:
  using Index = std::uint32_t;
  using Vector = std::array<double, 3>;

  /// An empty view from the direction of `normal`, of any length, of points around `origin`. Not usable when
  /// there is no such direction.
  void begin(const Vector& origin, const Vector& normal)
  {
    m_points.clear();
    m_origin = origin;
    m_extent = 0;
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    const double inverse = 1 / length;
    m_is_usable = std::isfinite(length) && std::isfinite(inverse);
    if (!m_is_usable)
      return;
    const Vector n{normal[0] * inverse, normal[1] * inverse, normal[2] * inverse};
    // Right angles are good to have, and not needed.
    const std::size_t least = std::fabs(n[0]) <= std::fabs(n[1]) && std::fabs(n[0]) <= std::fabs(n[2])
                                  ? 0
                                  : (std::fabs(n[1]) <= std::fabs(n[2]) ? 1 : 2);
    Vector axis{0, 0, 0};
    axis[least] = 1;
    const Vector u = cross(axis, n), v = cross(n, u);
    // No component of an axis is larger than 1.
    m_axes = {u, v, n};
  }

  Index add(const Vector& point)
  {
    const Vector d{point[0] - m_origin[0], point[1] - m_origin[1], point[2] - m_origin[2]};
    m_extent = (std::max)(m_extent, std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]));
    Vector seen;
    for (std::size_t i = 0; i < 3; ++i)
      seen[i] = m_axes[i][0] * d[0] + m_axes[i][1] * d[1] + m_axes[i][2] * d[2];
    m_points.push_back(seen);
    return Index(m_points.size() - 1);
  }

  /// To be called when all points are in; whether anything can be proved at all.
  bool close()
  {
    // With r for the largest distance from the origin (in the 1-norm) and ε = 2⁻⁵³: a coordinate is at most r
    // (1 + 8 ε) and wrong by at most 8 ε r; a difference of two by 18 ε r. A side is a sum of two products of
    // differences, each at most 2 r: wrong by at most 2 · 2 · (2 r · 18 ε r) + 3 · 8 ε r² < 2⁸ ε r². A height
    // above a plane is a sum of three products of such sums, at most 8 r², and differences: wrong by at most
    // 3 · (2⁸ ε r² · 2 r + 8 r² · 18 ε r) + 5 · 48 ε r³ < 2¹² ε r³. Twice that is asked for.
    m_is_usable = m_is_usable && m_extent > 1e-90 && m_extent < 1e90;
    m_length_error = std::ldexp(m_extent, -48);
    m_area_error = std::ldexp(m_extent * m_extent, -44);
    m_volume_error = std::ldexp(m_extent * m_extent * m_extent, -40);
    return m_is_usable;
  }

  const Vector& operator[](Index i) const { return m_points[i]; }

  /// By how much coordinates of two points must differ to be in that order.
  double length_error() const { return m_length_error; }

  /// The side of the line from i to j on which k is seen: 1 left, −1 right, 0 not known.
  int side(Index i, Index j, Index k) const
  {
    const Vector &p = m_points[i], &q = m_points[j], &r = m_points[k];
    const double area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    return int(area > m_area_error) - int(area < -m_area_error);
  }

  /// Is the triangle clear of any simplex of `points` by a plane that stands on one of its edges?
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

  /// Is the triangle clear of any simplex of `points` by its own plane?
  template <class Points>
  bool is_clear_by_plane(const std::array<Index, 3>& triangle, const Points& points) const
  {
    const Vector& o = m_points[triangle[0]];
    const Vector normal = cross(difference(m_points[triangle[1]], o), difference(m_points[triangle[2]], o));
    int sign = 0;
    std::size_t shared = 0;
    for (const Index p : points) {
      if (p == triangle[0] || p == triangle[1] || p == triangle[2]) {
        ++shared;
        continue;
      }
      const Vector d = difference(m_points[p], o);
      const double volume = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
      const int height = int(volume > m_volume_error) - int(volume < -m_volume_error);
      if (height == 0 || height == -sign)
        return false;
      sign = height;
    }
    return sign != 0 && shared < 3;
  }

  /// Is the triangle clear of the tetrahedron by a plane that stands on one of the latter's edges?
  bool is_clear_by_edge_of(const std::array<Index, 4>& tetrahedron,
                           const std::array<Index, 3>& triangle) const
  {
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        const Index i = tetrahedron[a], j = tetrahedron[b];
        // The other two.
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
  static Vector difference(const Vector& a, const Vector& b)
  {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
  static Vector cross(const Vector& a, const Vector& b)
  {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  Vector m_origin{};
  std::array<Vector, 3> m_axes{};
  std::vector<Vector> m_points;
  double m_extent = 0;
  double m_length_error = 0, m_area_error = 0, m_volume_error = 0;
  bool m_is_usable = false;
};

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_CERTIFIED_VIEW_H
