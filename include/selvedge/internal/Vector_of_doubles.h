// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_VECTOR_OF_DOUBLES_H
#define SELVEDGE_INTERNAL_VECTOR_OF_DOUBLES_H

#include <array>

namespace selvedge {
namespace internal {

/// A point or direction in floating point, for kernels of any kind.
using Vector_of_doubles = std::array<double, 3>;

inline double dot(const Vector_of_doubles& a, const Vector_of_doubles& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double dot(const std::array<float, 3>& a, const Vector_of_doubles& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector_of_doubles difference(const Vector_of_doubles& a, const Vector_of_doubles& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector_of_doubles cross(const Vector_of_doubles& a, const Vector_of_doubles& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_VECTOR_OF_DOUBLES_H
