// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_MATRIX_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_MATRIX_H

#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/internal/saturated_float.h>

#include <array>

namespace selvedge {
namespace internal {

/// A symmetric matrix of three rows, in double precision.
struct Symmetric_matrix
{
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// Adds weight × v vᵀ.
  void add_square(const Vector_of_doubles& v, double weight)
  {
    const double x = weight * v[0], y = weight * v[1], z = weight * v[2];
    xx += x * v[0];
    xy += x * v[1];
    xz += x * v[2];
    yy += y * v[1];
    yz += y * v[2];
    zz += z * v[2];
  }

  /// Adds weight × the identity.
  void add_identity(double weight)
  {
    xx += weight;
    yy += weight;
    zz += weight;
  }

  Symmetric_matrix& operator+=(const Symmetric_matrix& other)
  {
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    return *this;
  }

  Symmetric_matrix& operator*=(double factor)
  {
    for (double* const number : {&xx, &xy, &xz, &yy, &yz, &zz})
      *number *= factor;
    return *this;
  }

  Vector_of_doubles operator*(const Vector_of_doubles& v) const
  {
    return {xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2],
            xz * v[0] + yz * v[1] + zz * v[2]};
  }

  /// Returns vᵀ M v.
  double square(const Vector_of_doubles& v) const
  {
    return v[0] * (xx * v[0] + 2 * (xy * v[1] + xz * v[2])) + v[1] * (yy * v[1] + 2 * yz * v[2]) +
           v[2] * zz * v[2];
  }

  double trace() const { return xx + yy + zz; }
};

/// A symmetric matrix that is kept in single precision, for what there is one of for each vertex. Numbers too
/// large for that are the largest ones.
class Float_symmetric_matrix
{
public:
  Float_symmetric_matrix() = default;
  explicit Float_symmetric_matrix(const Symmetric_matrix& m)
      : m_numbers{saturated_float(m.xx), saturated_float(m.xy), saturated_float(m.xz),
                  saturated_float(m.yy), saturated_float(m.yz), saturated_float(m.zz)}
  {
  }

  operator Symmetric_matrix() const
  {
    return {m_numbers[0], m_numbers[1], m_numbers[2], m_numbers[3], m_numbers[4], m_numbers[5]};
  }

private:
  std::array<float, 6> m_numbers{};
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_SYMMETRIC_MATRIX_H
