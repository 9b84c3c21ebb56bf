// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_MONOTONE_BOX_H
#define SELVEDGE_SPATIAL_INTERNAL_MONOTONE_BOX_H

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace selvedge {
namespace internal {

/// An axis-aligned box of floats, half the size of a `CGAL::Bbox_3`.
///
/// Boxes of doubles become boxes of floats through one map x ↦ float(x − origin) per axis. This can add
/// overlaps, but never lose one: every step of the map is monotone, whatever the rounding mode; overlap is a
/// conjunction of ≤ between bounds; and a monotone map keeps every ≤.
struct Monotone_box
{
  std::array<float, 3> lower;
  std::array<float, 3> upper;

  static Monotone_box empty()
  {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  }

  Monotone_box& operator+=(const Monotone_box& other)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = (std::min)(lower[axis], other.lower[axis]);
      upper[axis] = (std::max)(upper[axis], other.upper[axis]);
    }
    return *this;
  }

  bool overlaps(const Monotone_box& other) const
  {
    // Always all six comparisons: there is no branch to mispredict.
    const auto is_met = [&](std::size_t axis) {
      return int(lower[axis] <= other.upper[axis]) & int(other.lower[axis] <= upper[axis]);
    };
    return (is_met(0) & is_met(1) & is_met(2)) != 0;
  }

  bool is_empty() const { return lower[0] > upper[0]; }

  bool contains(const Monotone_box& other) const
  {
    return lower[0] <= other.lower[0] && lower[1] <= other.lower[1] && lower[2] <= other.lower[2] &&
           upper[0] >= other.upper[0] && upper[1] >= other.upper[1] && upper[2] >= other.upper[2];
  }

  /// Returns twice the centre along one axis, which is enough for comparisons.
  float centre(std::size_t axis) const { return lower[axis] + upper[axis]; }

  std::size_t longest_axis() const
  {
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (upper[axis] - lower[axis] > upper[longest] - lower[longest])
        longest = axis;
    return longest;
  }
};

/// Maps boxes of doubles to boxes of floats. Its origin lies in the middle of the mesh, because floats are
/// densest around 0.
class Monotone_box_map
{
public:
  Monotone_box_map() = default;
  explicit Monotone_box_map(const CGAL::Bbox_3& domain)
  {
    for (int axis = 0; axis < 3; ++axis)
      if ((domain.min)(axis) <= (domain.max)(axis)) // false for the box of nothing
        m_origin[std::size_t(axis)] = 0.5 * (domain.min)(axis) + 0.5 * (domain.max)(axis);
  }

  Monotone_box operator()(const CGAL::Bbox_3& box) const
  {
    Monotone_box result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.lower[axis] = to_float((box.min)(int(axis)) - m_origin[axis]);
      result.upper[axis] = to_float((box.max)(int(axis)) - m_origin[axis]);
    }
    return result;
  }

  const std::array<double, 3>& origin() const { return m_origin; }

private:
  // The conversion of a double beyond the range of float is not defined. Clamping to that range is monotone.
  static float to_float(double x)
  {
    constexpr double largest = (std::numeric_limits<float>::max)();
    return static_cast<float>((std::min)((std::max)(x, -largest), largest));
  }

  std::array<double, 3> m_origin{0, 0, 0};
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_MONOTONE_BOX_H
