// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_UV_QUADRIC_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_UV_QUADRIC_H

#include <array>
#include <cmath>
#include <cstddef>

namespace selvedge {

/// How far a texture is displaced, summed over triangles: for a point x with the texture coordinates s, the
/// sum of weight × |Gx + d − s|², where Gx + d are the texture coordinates that a triangle gives to x in its
/// plane.
///
/// Zero for any x and s that continue the texture as it is, so on flat cloth with its pattern as texture.
///
/// **Exactness** Floating point.
///
/// **Reference** Hoppe: New quadric metric for simplifying meshes with appearance attributes, section 4.
class Uv_quadric
{
public:
  using Vector = std::array<double, 3>;
  using Uv = std::array<double, 2>;

  /// Adds a triangle, weighted by its area times `weight`; less where it is thin, for then it says little
  /// about what lies beside it. A degenerate one adds nothing.
  void add_triangle(const std::array<Vector, 3>& x, const std::array<Uv, 3>& s, double weight)
  {
    const Vector e = difference(x[1], x[0]), f = difference(x[2], x[0]), g = difference(x[2], x[1]);
    const Vector normal = cross(e, f);
    const double squared_area = 0.25 * dot(normal, normal);
    if (!(squared_area > 0))
      return;
    const double squared_edges = dot(e, e) + dot(f, f) + dot(g, g);
    const double squared_quality = 48 * squared_area / (squared_edges * squared_edges); // 1: equilateral
    weight *= std::sqrt(squared_area) * squared_quality;
    const Vector of_e = cross(f, normal), of_f = cross(normal, e);
    for (std::size_t k = 0; k < 2; ++k) {
      Vector gradient;
      for (std::size_t i = 0; i < 3; ++i)
        gradient[i] = ((s[1][k] - s[0][k]) * of_e[i] + (s[2][k] - s[0][k]) * of_f[i]) / (4 * squared_area);
      const double d = s[0][k] - dot(gradient, x[0]);
      m_xx += weight * gradient[0] * gradient[0];
      m_xy += weight * gradient[0] * gradient[1];
      m_xz += weight * gradient[0] * gradient[2];
      m_yy += weight * gradient[1] * gradient[1];
      m_yz += weight * gradient[1] * gradient[2];
      m_zz += weight * gradient[2] * gradient[2];
      for (std::size_t i = 0; i < 3; ++i) {
        m_b[i] += weight * d * gradient[i];
        m_gradients[k][i] += weight * gradient[i];
      }
      m_c += weight * d * d;
      m_d[k] += weight * d;
    }
    m_weight += weight;
  }

  Uv_quadric& operator+=(const Uv_quadric& other)
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
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t i = 0; i < 3; ++i)
        m_gradients[k][i] += other.m_gradients[k][i];
      m_d[k] += other.m_d[k];
    }
    m_weight += other.m_weight;
    return *this;
  }

  double operator()(const Vector& x, const Uv& s) const
  {
    double sum = x[0] * (m_xx * x[0] + 2 * (m_xy * x[1] + m_xz * x[2] + m_b[0])) +
                 x[1] * (m_yy * x[1] + 2 * (m_yz * x[2] + m_b[1])) + x[2] * (m_zz * x[2] + 2 * m_b[2]) + m_c;
    for (std::size_t k = 0; k < 2; ++k)
      sum += s[k] * (m_weight * s[k] - 2 * (dot(m_gradients[k], x) + m_d[k]));
    return sum > 0 ? sum : 0; // cancellation may leave a little less than nothing
  }

private:
  static double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector difference(const Vector& a, const Vector& b)
  {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
  static Vector cross(const Vector& a, const Vector& b)
  {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  // Of x alone, of x and s, and of s alone.
  double m_xx = 0, m_xy = 0, m_xz = 0, m_yy = 0, m_yz = 0, m_zz = 0;
  Vector m_b{0, 0, 0};
  double m_c = 0;
  std::array<Vector, 2> m_gradients{};
  Uv m_d{0, 0};
  double m_weight = 0;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_UV_QUADRIC_H
