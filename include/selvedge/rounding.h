// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_ROUNDING_H
#define SELVEDGE_ROUNDING_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// What `round_to_float32` changed.
struct Rounding_notes
{
  /// Coordinates that were no 32-bit float. Each moved by at most half a unit in the last place.
  std::size_t coordinates = 0;
  std::size_t vertices = 0; ///< vertices that have such a coordinate
};

/// Returns whether `value` is the value of a 32-bit float.
bool is_float32(double value);

/// Returns the 32-bit float nearest to `value`, ties to even; infinite where it is too large for one.
double nearest_float32(double value);

/// Returns whether every coordinate of a soup, in all poses, is the value of a 32-bit float.
bool has_float32_points(const Triangle_soup& soup);

/// Returns whether every coordinate of some points is the value of a 32-bit float.
bool has_float32_points(const std::vector<Point_3>& points);

/// Returns whether every coordinate of a soup in its first pose has no more binary digits than a 32-bit float
/// has, at whatever exponent. It holds for a soup exactly when it does for its multiple by a power of two.
bool has_float32_digits(const Triangle_soup& soup);

/// Rounds every coordinate, in all poses, to the nearest 32-bit float, ties to even, so that no coordinate
/// changes when the soup is written to a format that stores 32-bit floats (`stores_float32`).
///
/// **Guarantees**
/// 1. Afterwards `is_float32` holds for every coordinate. A coordinate for which it held before is unchanged.
/// 2. A coordinate that would overflow to infinity is refused with `Input_error`, which names its vertex
///    (counted from 0). The soup is then unchanged.
///
/// **Not promised** Distinct positions may become equal, triangles may degenerate, and new intersections may
/// appear: judge after rounding.
///
/// **Complexity** Linear.
Rounding_notes round_to_float32(Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_ROUNDING_H
