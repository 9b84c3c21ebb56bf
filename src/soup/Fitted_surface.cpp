// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Fitted_surface.h"

#include "triangle_normals.h"

#include <cmath>

namespace selvedge {

Fitted_surface::Fitted_surface(const Triangle_soup& result, const std::vector<Index>& triangles,
                               const std::vector<Index_triple>& corners, const Triangle_soup& original,
                               const std::vector<Index>& positions)
    : m_result(result), m_triangles(triangles), m_corners(corners), m_original(original),
      m_positions(positions)
{
  double largest = 0;
  for (const Point_3& point : original.points)
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(point[axis]));
  m_exponent = largest > 0 ? -std::ilogb(largest) : 0;
  m_normals.reserve(size());
  for (Index i = 0; i < size(); ++i)
    m_normals.push_back(shading::unit_normal(result, i));
}

Fitted_surface::Corners Fitted_surface::corners(const Triangle_soup& soup, Index triangle) const
{
  Corners result;
  for (std::size_t k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis)
      result[k][axis] = std::scalbn(soup.points[soup.triangles[triangle][k]][axis], m_exponent);
  return result;
}

bool Fitted_surface::is_changed(Index i) const
{
  const Index t = m_triangles[i];
  if (m_corners[i] != Index_triple{3 * t, 3 * t + 1, 3 * t + 2})
    return true;
  for (std::size_t k = 0; k < 3; ++k)
    if (m_result.points[m_result.triangles[i][k]] != m_original.points[m_original.triangles[t][k]])
      return true;
  return false;
}

} // namespace selvedge
