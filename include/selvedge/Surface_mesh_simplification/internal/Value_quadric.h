// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_VALUE_QUADRIC_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_VALUE_QUADRIC_H

#include <selvedge/Surface_mesh_simplification/internal/Symmetric_matrix.h>
#include <selvedge/Surface_mesh_simplification/internal/relative_face_weight.h>
#include <selvedge/internal/saturated_float.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace selvedge {

/// Measures how much farther values on the surface, such as a texture or normals, are displaced when a vertex
/// moves. The displacement is a sum over triangles: for a point x with the value s, it is the sum of weight ×
/// |Gx + d − s|², where Gx + d is the value that a triangle gives to x in its plane.
///
/// It says how much larger this sum is, after a motion of the point and of its value, than it is for an
/// origin of both. The displacement does not grow with motions that continue the values unchanged, as on flat
/// cloth with its pattern as texture.
///
/// **Exactness** Floating point. It is kept in single precision, since it takes much memory, which a loop
/// would wait for; numbers too large for that are the largest ones.
///
/// **Reference** Hoppe: New quadric metric for simplifying meshes with appearance attributes, section 4.
template <std::size_t dimension>
class Value_quadric
{
public:
  using Vector = internal::Vector_of_doubles;
  using Value = std::array<double, dimension>;

  Value_quadric() = default;

  /// Makes that of a triangle, with `weight` times the `relative_face_weight` of its area. Its origin is any
  /// corner. A thin triangle counts less, since it says little about what lies beside it; a degenerate one
  /// does not count.
  Value_quadric(const std::array<Vector, 3>& x, const std::array<Value, 3>& s, double weight)
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
    internal::Symmetric_matrix matrix;
    for (std::size_t k = 0; k < dimension; ++k) {
      Vector gradient;
      for (std::size_t i = 0; i < 3; ++i)
        gradient[i] = ((s[1][k] - s[0][k]) * of_e[i] + (s[2][k] - s[0][k]) * of_f[i]) / (4 * squared_area);
      matrix.add_square(gradient, weight);
      for (std::size_t i = 0; i < 3; ++i)
        m_numbers[s_gradients + 3 * k + i] = internal::saturated_float(weight * gradient[i]);
    }
    const std::array<double, 6> numbers{matrix.xx, matrix.xy, matrix.xz, matrix.yy, matrix.yz, matrix.zz};
    std::transform(numbers.begin(), numbers.end(), m_numbers.begin(), internal::saturated_float);
    m_numbers[s_weight] = internal::saturated_float(weight);
  }

  /// Adds one with the same origin.
  Value_quadric& operator+=(const Value_quadric& other)
  {
    constexpr float largest = (std::numeric_limits<float>::max)();
    for (std::size_t i = 0; i < m_numbers.size(); ++i)
      m_numbers[i] = (std::max)(-largest, (std::min)(largest, m_numbers[i] + other.m_numbers[i]));
    return *this;
  }

  /// Returns how much the displacement grows with a motion of the point and of its value.
  double operator()(const Vector& motion, const Value& value_motion) const
  {
    double sum = growth_with_value_fixed(motion);
    for (std::size_t k = 0; k < dimension; ++k)
      sum += value_motion[k] * (weight() * value_motion[k] - 2 * displacement(k, motion));
    return sum;
  }

  /// Returns the same with the motion of the value for which it is least.
  double least(const Vector& motion) const
  {
    double sum = growth_with_value_fixed(motion);
    for (std::size_t k = 0; k < dimension && weight() > 0; ++k)
      sum -= displacement(k, motion) * displacement(k, motion) / weight();
    return sum;
  }

  /// Returns the motion of the value alone for which the displacement is least.
  Value best_value_motion() const
  {
    Value motion{};
    for (std::size_t k = 0; k < dimension && weight() > 0; ++k)
      motion[k] = m_numbers[s_displacements + k] / weight();
    return motion;
  }

  /// Returns the function whose origin is that of this one after a motion.
  Value_quadric moved_by(const Vector& motion, const Value& value_motion) const
  {
    Value_quadric moved = *this;
    const Vector product = matrix() * motion;
    for (std::size_t i = 0; i < 3; ++i) {
      double linear = m_numbers[s_linear + i] + product[i];
      for (std::size_t k = 0; k < dimension; ++k)
        linear -= value_motion[k] * m_numbers[s_gradients + 3 * k + i];
      moved.m_numbers[s_linear + i] = internal::saturated_float(linear);
    }
    for (std::size_t k = 0; k < dimension; ++k)
      moved.m_numbers[s_displacements + k] =
          internal::saturated_float(displacement(k, motion) - weight() * value_motion[k]);
    return moved;
  }

private:
  // Where its parts begin: the terms in the motion alone, in both motions, and in that of the value alone.
  static constexpr std::size_t s_linear = 6, s_gradients = s_linear + 3,
                               s_displacements = s_gradients + 3 * dimension,
                               s_weight = s_displacements + dimension;

  internal::Symmetric_matrix matrix() const
  {
    return {m_numbers[0], m_numbers[1], m_numbers[2], m_numbers[3], m_numbers[4], m_numbers[5]};
  }
  double weight() const { return m_numbers[s_weight]; }

  double growth_with_value_fixed(const Vector& motion) const
  {
    return matrix().square(motion) + 2 * product(s_linear, motion);
  }

  // The sum of the displacements in one number, each with its weight.
  double displacement(std::size_t k, const Vector& motion) const
  {
    return product(s_gradients + 3 * k, motion) + m_numbers[s_displacements + k];
  }

  // The scalar product of the three numbers from `first` on with a vector.
  double product(std::size_t first, const Vector& v) const
  {
    return m_numbers[first] * v[0] + m_numbers[first + 1] * v[1] + m_numbers[first + 2] * v[2];
  }

  // In one array, since the compiler then adds several at once.
  std::array<float, s_weight + 1> m_numbers{};
};

using Uv_quadric = Value_quadric<2>;

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_VALUE_QUADRIC_H
