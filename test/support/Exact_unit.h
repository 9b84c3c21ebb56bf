// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_EXACT_UNIT_H
#define SELVEDGE_TEST_SUPPORT_EXACT_UNIT_H

#include "support/Exact_oracle.h"

#include <CGAL/Gmpz.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace selvedge::test {

/// A power of two of which all lengths considered are multiples. It makes integers of them, with which the
/// oracle computes several times as fast as with rationals.
class Exact_unit
{
public:
  void consider(double length)
  {
    int exponent = 0;
    double rest = std::frexp(length, &exponent);
    for (; rest != 0; rest -= std::trunc(rest)) {
      rest = std::ldexp(rest, 1);
      --exponent;
    }
    if (length != 0)
      m_exponent = std::min(m_exponent, exponent);
  }

  /// Returns a length that was considered as a multiple of the unit. No length may be 2^1024 times as long.
  CGAL::Gmpz operator()(double length) const
  {
    return CGAL::Gmpz(length == 0 ? 0. : std::ldexp(length, -m_exponent));
  }

private:
  int m_exponent = std::numeric_limits<int>::max();
};

/// Makes integers of the coordinates of points, on each axis with a unit of its own: this changes no answer
/// of the oracle.
class Exact_axes
{
public:
  template <class Point>
  void consider(const Point& p)
  {
    for (int axis = 0; axis < 3; ++axis)
      m_units[axis].consider(p[axis]);
  }

  /// Returns a point that was considered.
  template <class Point>
  oracle::Point<CGAL::Gmpz> operator()(const Point& p) const
  {
    return {m_units[0](p[0]), m_units[1](p[1]), m_units[2](p[2])};
  }

private:
  std::array<Exact_unit, 3> m_units;
};

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_EXACT_UNIT_H
