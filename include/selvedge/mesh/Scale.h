// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_SCALE_H
#define SELVEDGE_MESH_SCALE_H

#include <selvedge/mesh/Triangle_soup.h>

namespace selvedge {

/// The power of two by which all coordinates are divided while a mesh is reduced, so that everything about
/// quality is computed at one size: squares of areas neither overflow nor vanish.
///
/// **Guarantees**
/// 1. *Same steps*: two meshes of which one is the other multiplied by a power of two, obstacle and all, have
///    the same points after division, bit for bit.
/// 2. *Exact*: dividing the points that triangles of either soup use loses no digit, and gives finite
///    numbers. So every exact predicate has the same answer before and after: each is made of comparisons of
///    coordinates and of signs of polynomials all of whose terms have one degree d, and division by 2^k
///    divides such a polynomial by 2^(kd), which is positive, and keeps every comparison.
/// 3. *Size*: the largest coordinate of the mesh's own triangles comes as near to a number from 1/2 to 1 as 2
///    allows. Nothing but an obstacle, or coordinates of the mesh 300 orders of magnitude apart, hinders it.
class Scale
{
public:
  /// 1.
  Scale() = default;

  /// For a mesh and an obstacle beside it, which may be larger or smaller.
  ///
  /// Throws `Input_error` when the largest coordinate of the mesh would stay out of the range from 2^-140 to
  /// 2^140; the message says what is too far apart.
  ///
  /// **Complexity** Linear.
  explicit Scale(const Triangle_soup& soup, const Triangle_soup& obstacle = {});

  /// Divides.
  Point_3 operator()(const Point_3& point) const;
  double operator()(double length) const;

  /// Multiplies what was divided.
  double undone(double length) const;

private:
  int m_exponent = 0;
};

} // namespace selvedge

#endif // SELVEDGE_MESH_SCALE_H
