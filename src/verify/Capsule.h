// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_CAPSULE_H
#define SELVEDGE_SRC_VERIFY_CAPSULE_H

#include <selvedge/internal/Vector_of_doubles.h>

#include <array>

namespace selvedge {

/// The points within a radius of a segment. It encloses long thin things in any direction far more tightly
/// than a box with sides along the axes.
///
/// **Exactness** `are_apart` is one-sided: true is proved, false is undecided. The proof holds for capsules
/// that were all made with one `margin`, as `margin_for` returns it, whatever points they enclose. One of two
/// may have a smaller margin, for the coordinates of what it encloses, when the other's is for all.
class Capsule
{
public:
  using Vector = internal::Vector_of_doubles;

  /// Returns the margin by which capsules must exceed what they enclose, so that rounding cannot matter, when
  /// no coordinate is larger than `largest`; 0 when rounding is not bounded, because products of coordinates
  /// may overflow or vanish. Then no capsule may be made.
  static double margin_for(double largest);

  Capsule() = default;

  /// Makes a capsule around a box.
  Capsule(const Vector& low, const Vector& high, double margin);

  /// Makes a capsule around a triangle, whose axis is the longest edge.
  Capsule(const Vector& a, const Vector& b, const Vector& c, double margin);

  /// Makes a capsule around two others.
  Capsule(const Capsule& a, const Capsule& b, double margin);

  /// Returns whether the capsule is so long and thin that it may be worth asking.
  bool is_slender() const;

  /// Returns whether two capsules surely have no point in common.
  friend bool are_apart(const Capsule& a, const Capsule& b);

private:
  std::array<Vector, 2> m_ends{};
  double m_radius = 0;
};

} // namespace selvedge

#endif // SELVEDGE_SRC_VERIFY_CAPSULE_H
