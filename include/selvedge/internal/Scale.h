// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_SCALE_H
#define SELVEDGE_INTERNAL_SCALE_H

#include <selvedge/Triangle_soup.h>

#include <array>

namespace selvedge {

/// The power of two by which all coordinates are divided while a mesh is reduced. It brings every mesh to one
/// size, so that quality is computed without overflow or underflow, even of squares of areas.
///
/// **Guarantees**
/// 1. *Same steps*: when one mesh is another multiplied by a power of two, together with its obstacle and
///    without losing a digit, both have the same points after division, bit for bit.
/// 2. *Exact*: dividing the points that triangles of mesh and obstacle use loses no digit, and gives finite
///    numbers. So every exact predicate has the same answer before and after: it consists of comparisons of
///    coordinates and of signs of polynomials all of whose terms have one degree d. Division by 2^k keeps
///    every comparison, and divides such a polynomial by 2^(kd), which is positive.
/// 3. *Size*: the largest coordinate of the mesh's own triangles, in all poses, comes as near to the range from 1/2 to 1 as
///    guarantee 2 allows. Only an obstacle, or coordinates of the mesh that are 300 orders of magnitude
///    apart, can keep it outside.
class Scale
{
public:
  /// Divides by 1.
  Scale() = default;

  /// Chooses the power for a mesh and an obstacle beside it, which may be larger or smaller.
  ///
  /// Throws `Input_error` when the largest coordinate of the mesh would stay outside the range from 2^-140 to
  /// 2^140. The message says which coordinates are too far apart.
  ///
  /// **Complexity** Linear.
  explicit Scale(const Triangle_soup& soup, const Triangle_soup& obstacle = {});

  /// Returns a point or a length divided by the power.
  Point_3 operator()(const Point_3& point) const;
  double operator()(double length) const;

  /// Returns a divided point or length multiplied by the power again.
  Point_3 undone(const Point_3& point) const;
  double undone(double length) const;

private:
  // The power, as two factors, and its inverse: one factor alone could be too large for a number.
  std::array<double, 2> m_power{1, 1}, m_inverse{1, 1};
};

} // namespace selvedge

#endif // SELVEDGE_INTERNAL_SCALE_H
