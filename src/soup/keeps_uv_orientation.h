// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_KEEPS_UV_ORIENTATION_H
#define SELVEDGE_SOUP_KEEPS_UV_ORIENTATION_H

#include "Corner_mesh.h"
#include "Placed_vertices.h"

#include <selvedge/Surface_mesh_simplification/Border_rule.h>

namespace selvedge {

/// Returns whether every triangle of the texture keeps its orientation when a vertex moves onto another.
bool keeps_uv_orientation(const Corner_mesh& corners, const Placed_vertices& placed,
                          Corner_mesh::Halfedge moving, const Border_rule<Corner_mesh::Mesh>& rule);

/// Returns the same for two vertices that move to a place.
bool keeps_uv_orientation_at(const Corner_mesh& corners, const Placed_vertices& placed,
                             Corner_mesh::Halfedge moving, const Point_3& place);

} // namespace selvedge

#endif // SELVEDGE_SOUP_KEEPS_UV_ORIENTATION_H
