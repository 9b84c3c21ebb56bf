// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_UV_QUADRIC_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_UV_QUADRIC_H

#include <selvedge/Surface_mesh_simplification/internal/Symmetric_quadric.h>
#include <selvedge/Surface_mesh_simplification/internal/relative_face_weight.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace selvedge {

/// Measures how far a texture is displaced, summed over triangles: for a point x with the texture coordinates
/// s, it is the sum of weight × |Gx + d − s|², where Gx + d are the texture coordinates that a triangle gives
/// to x in its plane.
///
/// It is zero for all x and s that continue the texture unchanged, as on flat cloth with its pattern as
/// texture.
///
/// **Exactness** Floating point.
///
/// **Reference** Hoppe: New quadric metric for simplifying meshes with appearance attributes, section 4.
class Uv_quadric
{
public:
  using Vector = internal::Vector_of_doubles;
  using Uv = std::array<double, 2>;

  /// Adds a triangle, with `weight` times the `relative_face_weight` of its area. A thin triangle counts
  /// less, since it says little about what lies beside it; a degenerate one adds nothing.
  void add_triangle(const std::array<Vector, 3>& x, const std::array<Uv, 3>& s, double weight)
  {
    const Vector e = internal::difference(x[1], x[0]), f = internal::difference(x[2], x[0]),
                 g = internal::difference(x[2], x[1]);
    const Vector normal = internal::cross(e, f);
    const double squared_area = 0.25 * internal::dot(normal, normal);
    if (!(squared_area > 0))
      return;
    const double squared_edges = internal::dot(e, e) + internal::dot(f, f) + internal::dot(g, g);
    const double squared_quality = 48 * squared_area / (squared_edges * squared_edges); // 1: equilateral
    weight *= internal::relative_face_weight(std::sqrt(squared_area)) * squared_quality;
    const Vector of_e = internal::cross(f, normal), of_f = internal::cross(normal, e);
    for (std::size_t k = 0; k < 2; ++k) {
      Vector gradient;
      for (std::size_t i = 0; i < 3; ++i)
        gradient[i] = ((s[1][k] - s[0][k]) * of_e[i] + (s[2][k] - s[0][k]) * of_f[i]) / (4 * squared_area);
      const double d = s[0][k] - internal::dot(gradient, x[0]);
      m_of_points.add_square(gradient, d, weight);
      for (std::size_t i = 0; i < 3; ++i)
        m_gradients[k][i] += weight * gradient[i];
      m_d[k] += weight * d;
    }
    m_weight += weight;
  }

  Uv_quadric& operator+=(const Uv_quadric& other)
  {
    m_of_points += other.m_of_points;
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t i = 0; i < 3; ++i)
        m_gradients[k][i] += other.m_gradients[k][i];
      m_d[k] += other.m_d[k];
    }
    m_weight += other.m_weight;
    return *this;
  }

  Uv_quadric& operator*=(double factor)
  {
    m_of_points *= factor;
    for (std::size_t k = 0; k < 2; ++k) {
      for (double& coordinate : m_gradients[k])
        coordinate *= factor;
      m_d[k] *= factor;
    }
    m_weight *= factor;
    return *this;
  }

  /// Returns the value at a point with the texture coordinates that make it least.
  double least(const Vector& x) const
  {
    double sum = m_of_points(x);
    for (std::size_t k = 0; k < 2 && m_weight > 0; ++k) {
      const double s = internal::dot(m_gradients[k], x) + m_d[k];
      sum -= s * s / m_weight;
    }
    return sum > 0 ? sum : 0;
  }

  double operator()(const Vector& x, const Uv& s) const
  {
    double sum = m_of_points(x);
    for (std::size_t k = 0; k < 2; ++k)
      sum += s[k] * (m_weight * s[k] - 2 * (internal::dot(m_gradients[k], x) + m_d[k]));
    return sum > 0 ? sum : 0; // rounding may leave a sum slightly below zero
  }

private:
  // The terms in x alone, in x and s, and in s alone.
  internal::Symmetric_quadric m_of_points;
  std::array<Vector, 2> m_gradients{};
  Uv m_d{0, 0};
  double m_weight = 0;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_UV_QUADRIC_H
