// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_DIAGONAL_H
#define SELVEDGE_SRC_VERIFY_DIAGONAL_H

#include "Surface_tree.h"

#include <cmath>

namespace selvedge::internal {

/// Returns the diagonal of the bounding box of points; 0 when there are none.
inline double diagonal(const std::vector<Point_3>& points)
{
  CGAL::Bbox_3 box;
  for (const Point_3& point : points)
    box += point.bbox();
  return points.empty() ? 0 : std::hypot(box.x_span(), box.y_span(), box.z_span());
}

/// The diagonal of the bounding box of a soup's triangles, in which the judge measures lengths; the unit of
/// the coordinates when it is zero. It serves even where its own length is too large for a double.
class Diagonal
{
public:
  explicit Diagonal(const Triangle_soup& soup) : m_exponent(common_exponent(soup, {}))
  {
    std::vector<Point_3> points;
    for (const Index vertex : used_vertices(soup))
      points.push_back(scaled(soup.points[vertex], -m_exponent));
    m_scaled = diagonal(points);
  }

  /// Returns its own length, divided by 2^exponent.
  double length(int exponent = 0) const { return std::ldexp(m_scaled, m_exponent - exponent); }

  /// Returns a length as a share of the diagonal.
  double share(double length) const
  {
    return m_scaled > 0 ? std::ldexp(length, -m_exponent) / m_scaled : length;
  }

  /// Returns the length of which this is the share.
  double length_of(double share) const
  {
    return m_scaled > 0 ? std::ldexp(share * m_scaled, m_exponent) : share;
  }

private:
  int m_exponent;
  double m_scaled;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_DIAGONAL_H
