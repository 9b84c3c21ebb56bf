// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_CONE_H
#define SELVEDGE_SRC_VERIFY_CONE_H

#include <selvedge/internal/Vector_of_doubles.h>

#include <array>

namespace selvedge {

/// Bounds of the directions in which triangles lie, seen from a corner that they share, the apex.
///
/// They are seen in the six sides of a cube around the apex, where the points of a triangle form a segment.
/// On each side that sees all of them, the bounds are a rectangle.
///
/// **Exactness** `are_apart` is one-sided: true is proved, false is undecided. It holds in every rounding
/// mode, and for coordinates of any size.
class Cone
{
public:
  using Vector = internal::Vector_of_doubles;

  /// Makes the bounds of a triangle with a corner `apex`. Other corners may be at the same position.
  Cone(const Vector& apex, const Vector& a, const Vector& b);

  /// Extends the bounds to those of another cone with the same apex.
  void add(const Cone& other);

  /// Returns whether no triangle of one cone surely meets one of the other beyond the apex of both.
  friend bool are_apart(const Cone& a, const Cone& b);

private:
  // Makes the bounds of one direction.
  Cone(const Vector& apex, const Vector& point);

  // By axis, of a direction divided by the size of its coordinate there, which leaves 1, 0 or −1 of this one.
  // Where that differs between directions or is 0, the others are unbounded.
  std::array<Vector, 3> m_low, m_high;
};

} // namespace selvedge

#endif // SELVEDGE_SRC_VERIFY_CONE_H
