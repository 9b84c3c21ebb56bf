// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_FACE_SAMPLES_H
#define SELVEDGE_VERIFY_FACE_SAMPLES_H

#include "Surface_tree.h"

#include <cmath>

namespace selvedge::internal {

/// Yields the points of triangles at which `compare` looks at normals and layers. The points of one triangle
/// cover it evenly, however many it gets.
///
/// **Reference** Roberts, *The unreasonable effectiveness of quasirandom sequences*, 2018.
class Face_samples
{
public:
  explicit Face_samples(const Surface& surface) : m_surface(surface) {}

  Point_3 next(Index triangle)
  {
    m_u = std::fmod(m_u + 0.7548776662466927, 1);
    m_v = std::fmod(m_v + 0.5698402909980532, 1);
    const bool is_beyond = m_u + m_v > 1;
    const double u = is_beyond ? 1 - m_u : m_u, v = is_beyond ? 1 - m_v : m_v;
    const Point_3& corner = m_surface.corner(triangle, 0);
    return corner + u * (m_surface.corner(triangle, 1) - corner) +
           v * (m_surface.corner(triangle, 2) - corner);
  }

private:
  const Surface& m_surface;
  double m_u = 0.5, m_v = 0.5;
};

} // namespace selvedge::internal

#endif // SELVEDGE_VERIFY_FACE_SAMPLES_H
