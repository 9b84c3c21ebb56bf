// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRIANGLE_GRID_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRIANGLE_GRID_H

#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace selvedge {
namespace internal {

/// The points that divide each side of a triangle into equal parts, and those between them on lines parallel
/// to the sides, without the corners. Points can be removed.
///
/// It exists to show that all of its points are near a surface with few questions: a point of the surface
/// removes all points of the grid that are near it.
///
/// **Exactness** Floating point. **Complexity** O(1), as there are at most `s_most_parts` parts.
class Triangle_grid
{
  using Kernel = CGAL::Simple_cartesian<double>;

public:
  using Point = Kernel::Point_3;
  using Triangle = std::array<Point, 3>;

  static constexpr int s_most_parts = 8;

  /// Returns into how many parts the sides are divided if no part is to be longer than `longest`, but into no
  /// more than `most`.
  static int parts_of(const Triangle& corners, double longest, int most = s_most_parts)
  {
    double side = 0;
    for (std::size_t i = 0; i < 3; ++i)
      side = (std::max)(side, CGAL::squared_distance(corners[i], corners[(i + 1) % 3]));
    side = std::sqrt(side);
    int parts = 1;
    while (parts < most && side > parts * longest)
      ++parts;
    return parts;
  }

  /// Returns the number of points of a grid with all sides.
  static int size_of(int parts) { return (parts + 1) * (parts + 2) / 2 - 3; }

  /// Makes a grid without points.
  Triangle_grid() = default;

  /// Side i, from corner i to the next one, is left out unless `sides[i]`.
  Triangle_grid(const Triangle& corners, int parts, const std::array<bool, 3>& sides)
      : m_origin(corners[0]), m_along{(corners[1] - corners[0]) / parts, (corners[2] - corners[0]) / parts},
        m_parts(parts)
  {
    for (int i = 0; i <= parts; ++i) {
      const int last = parts - i;
      unsigned row = (2u << last) - 1;
      if (!sides[0] || i == 0)
        row &= ~1u;
      if (!sides[1] || i == 0)
        row &= ~(1u << last);
      if (i == parts || (i == 0 && !sides[2]))
        row = 0;
      m_rows[std::size_t(i)] = Row(row);
    }
    const int of_side = (std::max)(parts - 1, 0), sides_left_out = !sides[0] + !sides[1] + !sides[2];
    m_size = size_of(parts) - of_side * sides_left_out;
    const double bb = m_along[0] * m_along[0], bc = m_along[0] * m_along[1], cc = m_along[1] * m_along[1];
    const double inverse_area = 1 / (bb * cc - bc * bc);
    m_inverse[0] = inverse_area * (cc * m_along[0] - bc * m_along[1]);
    m_inverse[1] = inverse_area * (bb * m_along[1] - bc * m_along[0]);
  }

  /// Calls `function(point)` for the points until it returns false, and returns whether it never did. It may
  /// remove points on the way.
  template <class Function>
  bool all_of(const Function& function) const
  {
    for (int i = 0; i <= m_parts && m_size > 0; ++i)
      for (int k = 0; k <= m_parts - i && m_rows[std::size_t(i)] != 0; ++k) {
        const int j = i % 2 == 0 ? k : m_parts - i - k; // there and back: each point is beside the last one
        if (has(i, j) && !function(at(i, j)))
          return false;
      }
    return true;
  }

  /// Removes points whose squared distance from `p` is at most `squared`: of these, the ones whose place in
  /// the grid is nearest to that of `p`, and those around them.
  void remove_near(const Point& p, double squared)
  {
    if (m_size == 0)
      return;
    const auto off = p - m_origin;
    const int i = place(off * m_inverse[0]), j = place(off * m_inverse[1]);
    const Row around = Row((7u << j) >> 1);
    for (int k = (std::max)(i - 1, 0); k <= (std::min)(i + 1, m_parts); ++k) {
      Row& row = m_rows[std::size_t(k)];
      for (int l = (std::max)(j - 1, 0); ((row & around) >> l) != 0; ++l)
        if (has(k, l) && CGAL::squared_distance(p, at(k, l)) <= squared) {
          row &= Row(~(1u << l));
          --m_size;
        }
    }
  }

private:
  using Row = std::uint16_t;

  bool has(int i, int j) const { return (m_rows[std::size_t(i)] >> j & 1) != 0; }
  Point at(int i, int j) const { return m_origin + (double(i) * m_along[0] + double(j) * m_along[1]); }

  // The nearest place in a row, or any where the triangle has no area.
  int place(double x) const { return x > 0 ? x < m_parts ? int(x + 0.5) : m_parts : 0; }

  Point m_origin;
  std::array<Kernel::Vector_3, 2> m_along, m_inverse; // the product of one of each is 1 or 0
  int m_parts = 0;
  int m_size = 0;
  std::array<Row, s_most_parts + 1> m_rows{};
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRIANGLE_GRID_H
