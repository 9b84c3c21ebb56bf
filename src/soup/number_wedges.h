// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_NUMBER_WEDGES_H
#define SELVEDGE_SOUP_NUMBER_WEDGES_H

#include "Corner_mesh.h"

#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>

#include <vector>

namespace selvedge {

/// The wedges of a mesh: the corners at a vertex between two lines, which share their attributes.
struct Wedge_numbers
{
  std::vector<Index_triple> of_face;                     ///< by face, for each of its corners
  std::vector<Corner_mesh::Mesh::Vertex_index> vertices; ///< by wedge
};

/// Numbers the wedges in the order of their first halfedges. The constraints say which edges are lines and
/// spokes.
///
/// **Preconditions** Nothing has been collapsed.
///
/// **Complexity** Linear.
Wedge_numbers number_wedges(const Corner_mesh& corners,
                            const Simplify_constraints<Corner_mesh::Mesh>& constraints);

} // namespace selvedge

#endif // SELVEDGE_SOUP_NUMBER_WEDGES_H
