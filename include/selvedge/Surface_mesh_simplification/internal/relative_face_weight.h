// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_RELATIVE_FACE_WEIGHT_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_RELATIVE_FACE_WEIGHT_H

#include <cmath>

namespace selvedge {
namespace internal {

/// Returns the weight that a face of some area has in a cost, relative to a face of area 1. `Quadric_cost`
/// says why it is not the area itself.
inline double relative_face_weight(double area)
{
  return std::sqrt(std::sqrt(area));
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_RELATIVE_FACE_WEIGHT_H
