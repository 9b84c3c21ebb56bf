// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_SATURATED_FLOAT_H
#define SELVEDGE_INTERNAL_SATURATED_FLOAT_H

#include <algorithm>
#include <limits>

namespace selvedge {
namespace internal {

/// Returns the float that is nearest to a number: the largest one for a number beyond it, and not infinity.
inline float saturated_float(double number)
{
  constexpr double largest = (std::numeric_limits<float>::max)();
  return float((std::max)(-largest, (std::min)(largest, number)));
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_SATURATED_FLOAT_H
