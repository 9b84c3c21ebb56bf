// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_ROUNDING_H
#define SELVEDGE_MESH_ROUNDING_H

#include <selvedge/mesh/Triangle_soup.h>

#include <cstddef>

namespace selvedge {

/// What rounding changed.
struct Rounding_notes
{
  std::size_t coordinates =
      0; ///< Coordinates that were no 32-bit float, each moved by at most half a unit in the last place.
  std::size_t vertices = 0; ///< Vertices that have such a coordinate.
};

/// Whether `value` is the value of a 32-bit float.
bool is_float32(double value);

/// Rounds every coordinate to the nearest 32-bit float, ties to even, so that writing the soup to a format
/// that stores those (`stores_float32`) changes nothing any more.
///
/// **Guarantees**
/// 1. Afterwards `is_float32` holds for every coordinate; one for which it held before is unchanged.
/// 2. A coordinate that would overflow to infinity is refused with `Input_error`, which names its vertex
/// (counted from
///    0); the soup is then unchanged.
///
/// Distinct positions may become equal, triangles degenerate, and new intersections appear: judge after
/// rounding. Complexity: linear.
Rounding_notes round_to_float32(Triangle_soup& soup);

} // namespace selvedge

#endif // SELVEDGE_MESH_ROUNDING_H
