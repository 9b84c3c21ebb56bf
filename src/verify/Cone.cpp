// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "verify/Cone.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace selvedge {

// A difference of coordinates is wrong by at most 2⁻⁵² of itself in any rounding mode, and has the right
// sign. So a quotient of two is wrong by less than 2⁻⁵⁰ of itself, or by less than the least normal number
// where it is below it. The margin is larger than both, and than the rounding of the bounds.
Cone::Cone(const Vector& apex, const Vector& point)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Vector direction = internal::difference(point, apex);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = std::fabs(direction[axis]);
    for (std::size_t other = 0; other < 3; ++other) {
      const double quotient = direction[other] / size;
      const bool is_bounded = std::isfinite(size) && std::isfinite(quotient);
      const double margin = 0x1p-48 * std::fabs(quotient) + (std::numeric_limits<double>::min)();
      m_low[axis][other] = is_bounded ? quotient - margin : -infinity;
      m_high[axis][other] = is_bounded ? quotient + margin : infinity;
    }
    if (std::isfinite(size))
      m_low[axis][axis] = m_high[axis][axis] = double(direction[axis] > 0) - double(direction[axis] < 0);
  }
}

Cone::Cone(const Vector& apex, const Vector& a, const Vector& b) : Cone(apex, a)
{
  add(Cone(apex, b));
}

void Cone::add(const Cone& other)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 3; ++i) {
      m_low[axis][i] = (std::min)(m_low[axis][i], other.m_low[axis][i]);
      m_high[axis][i] = (std::max)(m_high[axis][i], other.m_high[axis][i]);
    }
    if (m_low[axis][axis] < m_high[axis][axis])
      for (std::size_t i = 0; i < 3; ++i)
        if (i != axis) {
          m_low[axis][i] = -infinity;
          m_high[axis][i] = infinity;
        }
  }
}

// Every point of a triangle, less the apex, is a sum of the two directions in which its other corners lie,
// with factors of at least 0. Where one of two cones has a coordinate of 1 and the other none above 0, or one
// at least 0 and the other −1, points of both have none in common but the apex; likewise the other way round.
// Where both have 1, or both −1, the points divided by the size of this coordinate lie within the bounds.
bool are_apart(const Cone& a, const Cone& b)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < 3; ++i)
      if (a.m_high[axis][i] < b.m_low[axis][i] || b.m_high[axis][i] < a.m_low[axis][i])
        return true;
  return false;
}

} // namespace selvedge
