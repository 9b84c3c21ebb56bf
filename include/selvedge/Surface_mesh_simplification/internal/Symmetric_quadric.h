// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_QUADRIC_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_QUADRIC_H

#include <selvedge/internal/Vector_of_doubles.h>

#include <cstddef>

namespace selvedge {
namespace internal {

/// A quadratic function of a point, x ↦ xᵀAx + 2bᵀx + c, in double precision.
class Symmetric_quadric
{
public:
  /// Adds weight × (gradient · x + d)².
  void add_square(const Vector_of_doubles& gradient, double d, double weight)
  {
    m_xx += weight * gradient[0] * gradient[0];
    m_xy += weight * gradient[0] * gradient[1];
    m_xz += weight * gradient[0] * gradient[2];
    m_yy += weight * gradient[1] * gradient[1];
    m_yz += weight * gradient[1] * gradient[2];
    m_zz += weight * gradient[2] * gradient[2];
    for (std::size_t i = 0; i < 3; ++i)
      m_b[i] += weight * d * gradient[i];
    m_c += weight * d * d;
  }

  /// Adds weight × squared distance to `point`.
  void add_point(const Vector_of_doubles& point, double weight)
  {
    m_xx += weight;
    m_yy += weight;
    m_zz += weight;
    for (std::size_t i = 0; i < 3; ++i)
      m_b[i] -= weight * point[i];
    m_c += weight * dot(point, point);
  }

  Symmetric_quadric& operator+=(const Symmetric_quadric& other)
  {
    m_xx += other.m_xx;
    m_xy += other.m_xy;
    m_xz += other.m_xz;
    m_yy += other.m_yy;
    m_yz += other.m_yz;
    m_zz += other.m_zz;
    for (std::size_t i = 0; i < 3; ++i)
      m_b[i] += other.m_b[i];
    m_c += other.m_c;
    return *this;
  }

  Symmetric_quadric& operator*=(double factor)
  {
    for (double* const number : {&m_xx, &m_xy, &m_xz, &m_yy, &m_yz, &m_zz, &m_b[0], &m_b[1], &m_b[2], &m_c})
      *number *= factor;
    return *this;
  }

  double operator()(const Vector_of_doubles& x) const
  {
    return x[0] * (m_xx * x[0] + 2 * (m_xy * x[1] + m_xz * x[2] + m_b[0])) +
           x[1] * (m_yy * x[1] + 2 * (m_yz * x[2] + m_b[1])) + x[2] * (m_zz * x[2] + 2 * m_b[2]) + m_c;
  }

  /// Returns the sum of the weights, if all terms are squared distances; those of points count three times.
  double trace() const { return m_xx + m_yy + m_zz; }

private:
  double m_xx = 0, m_xy = 0, m_xz = 0, m_yy = 0, m_yz = 0, m_zz = 0;
  Vector_of_doubles m_b{0, 0, 0};
  double m_c = 0;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_QUADRIC_H
