// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_FLOAT_SLAB_H
#define SELVEDGE_SPATIAL_INTERNAL_FLOAT_SLAB_H

#include <selvedge/spatial/Slab_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace selvedge {
namespace internal {

/// A slab in the coordinates of a `Monotone_box_map`, so much wider that a box of floats for which
/// `normal` · x, in floats, is above `upper` or below `lower` throughout, stands for a box outside the slab.
///
/// Let o be the origin of the map, y = x − o, d the origin of the slab − o; let the normal n be scaled so
/// that its largest component is 1, N be the sum of its components' magnitudes, and R the largest magnitude
/// among d and all coordinates of boxes. Then |n · y| ≤ N R. The errors, in units of 2⁻²⁴ N R and whatever
/// the rounding mode, are at most: 2 for the coordinates of boxes as floats, 2 for n as floats, 2 for the
/// products, 4 for the two sums, and 4 for a bound, of magnitude at most 2 N R, as a float. That makes 14;
/// what is of second order, or rounded as double, is less than 1, and what is lost to underflow less than the
/// least normal float. The slab is made wider by 16 and that.
struct Float_slab
{
  std::array<float, 3> normal;
  std::array<std::size_t, 3>
      low_bounds; ///< which bound makes `normal` · x least: 0 … 2 a lower, 3 … 5 an upper
  float lower;
  float upper;

  /// None where there is no slab, or where numbers are too large for what is said above. `magnitude` is at
  /// least that of every coordinate of a box.
  static std::optional<Float_slab> make(const Slab_box& slab, const std::array<double, 3>& map_origin,
                                        float magnitude)
  {
    const auto [x, y, z] = slab.normal;
    const double longest = (std::max)({std::abs(x), std::abs(y), std::abs(z)});
    constexpr double largest = (std::numeric_limits<float>::max)() / 16;
    double sum = 0, offset = 0, reach = magnitude;
    Float_slab result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double component = slab.normal[axis] / longest;
      const double distance = slab.origin[axis] - map_origin[axis];
      sum += std::abs(component);
      offset += component * distance;
      reach = (std::max)(reach, std::abs(distance));
      result.normal[axis] = float(component);
      result.low_bounds[axis] = component < 0 ? 3 + axis : axis;
    }
    if (!(reach <= largest && sum <= 3))
      return std::nullopt;
    const double scale = sum * reach;
    const double slack = std::ldexp(scale, -20) + (std::numeric_limits<float>::min)();
    // What is not a number stays so, and keeps everything.
    const auto bound = [&](double at) {
      return (std::max)((std::min)(at / longest + offset, 2 * scale), -2 * scale);
    };
    result.lower = float(bound(slab.lower) - slack);
    result.upper = float(bound(slab.upper) + slack);
    return result;
  }
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_FLOAT_SLAB_H
