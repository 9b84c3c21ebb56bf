// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_KEEPS_SHADING_H
#define SELVEDGE_SOUP_KEEPS_SHADING_H

#include "Corner_mesh.h"
#include "Placed_vertices.h"

#include <selvedge/Surface_mesh_simplification/Border_rule.h>

namespace selvedge {

/// Returns whether every face whose three normals point to one side of it has them on that side still when a
/// vertex moves onto another.
///
/// It exists because a vertex keeps its normal when it comes to bound other faces: the outside of a hem whose
/// lower vertices were those of its inside would be dark. Computed in floating point.
///
/// **Preconditions** The soup has normals.
bool keeps_shading(const Corner_mesh& corners, const Placed_vertices& placed, Corner_mesh::Halfedge moving,
                   const Border_rule<Corner_mesh::Mesh>& rule);

/// Returns the same for two vertices that move to a place.
bool keeps_shading_at(const Corner_mesh& corners, const Placed_vertices& placed, Corner_mesh::Halfedge moving,
                      const Point_3& place);

} // namespace selvedge

#endif // SELVEDGE_SOUP_KEEPS_SHADING_H
