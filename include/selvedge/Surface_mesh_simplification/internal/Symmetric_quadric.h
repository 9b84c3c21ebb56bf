// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_QUADRIC_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_QUADRIC_H

#include <selvedge/Surface_mesh_simplification/internal/Symmetric_matrix.h>
#include <selvedge/internal/Vector_of_doubles.h>

#include <cmath>
#include <cstddef>
#include <optional>

namespace selvedge {
namespace internal {

/// A quadratic function of a point, x ↦ xᵀAx + 2bᵀx + c, in double precision.
class Symmetric_quadric
{
public:
  Symmetric_quadric() = default;
  Symmetric_quadric(const Symmetric_matrix& matrix, const Vector_of_doubles& b, double c)
      : m_b(b), m_c(c), m_matrix(matrix)
  {
  }

  /// Returns the function whose value at x is that of this one at x − `point`.
  Symmetric_quadric moved_by(const Vector_of_doubles& point) const
  {
    Symmetric_quadric moved = *this;
    const Vector_of_doubles product = m_matrix * point;
    for (std::size_t i = 0; i < 3; ++i)
      moved.m_b[i] -= product[i];
    moved.m_c += dot(product, point) - 2 * dot(m_b, point);
    return moved;
  }

  Symmetric_quadric& operator+=(const Symmetric_quadric& other)
  {
    m_matrix += other.m_matrix;
    for (std::size_t i = 0; i < 3; ++i)
      m_b[i] += other.m_b[i];
    m_c += other.m_c;
    return *this;
  }

  Symmetric_quadric& operator*=(double factor)
  {
    m_matrix *= factor;
    for (double& number : m_b)
      number *= factor;
    m_c *= factor;
    return *this;
  }

  double operator()(const Vector_of_doubles& x) const { return m_matrix.square(x) + 2 * dot(m_b, x) + m_c; }

  const Symmetric_matrix& matrix() const { return m_matrix; }
  const Vector_of_doubles& b() const { return m_b; }
  double c() const { return m_c; }

  /// Returns half of the gradient at a point.
  Vector_of_doubles half_gradient(const Vector_of_doubles& x) const
  {
    Vector_of_doubles result = m_matrix * x;
    for (std::size_t i = 0; i < 3; ++i)
      result[i] += m_b[i];
    return result;
  }

  /// Returns where the function is least, or none when its matrix is singular to working precision.
  std::optional<Vector_of_doubles> least_point() const
  {
    const auto& [xx, xy, xz, yy_, yz_, zz_] = m_matrix;
    // Decomposes the matrix into LDLᵀ. Without pivots: it is positive semidefinite.
    const double least = s_least_pivot * trace();
    if (!(xx > least))
      return std::nullopt;
    const double yx = xy / xx, zx = xz / xx;
    const double yy = yy_ - yx * xy, yz = yz_ - yx * xz;
    if (!(yy > least))
      return std::nullopt;
    const double zy = yz / yy, zz = zz_ - zx * xz - zy * yz;
    if (!(zz > least))
      return std::nullopt;
    const double u = -m_b[0], v = -m_b[1] - yx * u, w = -m_b[2] - zx * u - zy * v;
    Vector_of_doubles x;
    x[2] = w / zz;
    x[1] = v / yy - zy * x[2];
    x[0] = u / xx - yx * x[1] - zx * x[2];
    return x;
  }

  /// Returns where the function is least among the points x with normal · x = product, or none when that is
  /// not one point to working precision. `near` is a point that may be far from the plane.
  std::optional<Vector_of_doubles> least_point_on_plane(const Vector_of_doubles& normal, double product,
                                                        const Vector_of_doubles& near) const
  {
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0))
      return std::nullopt;
    // Two unit vectors in the plane; the first is at a right angle to the axis that is nearest to the plane.
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::fabs(normal[i]) < std::fabs(normal[axis]))
        axis = i;
    Vector_of_doubles of_axis{0, 0, 0};
    of_axis[axis] = 1;
    Vector_of_doubles u = cross(normal, of_axis);
    const double length_of_u = std::sqrt(dot(u, u));
    for (double& coordinate : u)
      coordinate /= length_of_u;
    Vector_of_doubles v = cross(normal, u);
    for (double& coordinate : v)
      coordinate /= length;
    const double off = (product - dot(normal, near)) / (length * length);
    Vector_of_doubles x = near;
    for (std::size_t i = 0; i < 3; ++i)
      x[i] += off * normal[i];

    const Vector_of_doubles times_u = m_matrix * u, times_v = m_matrix * v;
    const Vector_of_doubles gradient = half_gradient(x);
    const double uu = dot(u, times_u), uv = dot(u, times_v), vv = dot(v, times_v);
    const double determinant = uu * vv - uv * uv, trace = uu + vv;
    if (!(determinant > s_least_pivot * trace * trace))
      return std::nullopt;
    const double at_u = dot(u, gradient), at_v = dot(v, gradient);
    const double along_u = (uv * at_v - vv * at_u) / determinant,
                 along_v = (uv * at_u - uu * at_v) / determinant;
    for (std::size_t i = 0; i < 3; ++i)
      x[i] += along_u * u[i] + along_v * v[i];
    return x;
  }

  /// Returns for which λ the function is least at point + λ · direction, or none where it is constant or
  /// linear along that line.
  std::optional<double> least_along(const Vector_of_doubles& point, const Vector_of_doubles& direction) const
  {
    const Vector_of_doubles product = m_matrix * direction;
    const double curvature = dot(direction, product);
    if (!(curvature > 0))
      return std::nullopt;
    return -(dot(point, product) + dot(m_b, direction)) / curvature;
  }

  /// Returns the sum of the weights, if all terms are squared distances; those of points count three times.
  double trace() const { return m_matrix.trace(); }

private:
  static constexpr double s_least_pivot = 1e-13; // relative to the trace

  Vector_of_doubles m_b{0, 0, 0};
  double m_c = 0;
  Symmetric_matrix m_matrix;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_QUADRIC_H
