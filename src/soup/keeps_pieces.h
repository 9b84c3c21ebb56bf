// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_KEEPS_PIECES_H
#define SELVEDGE_SOUP_KEEPS_PIECES_H

#include "Corner_mesh.h"

#include <selvedge/Surface_mesh_simplification/Border_rule.h>

#include <vector>

namespace selvedge {

/// Returns whether a motion, which the rule allows, keeps the topology of every piece of the soup: of what is
/// connected by common vertex numbers, doubles included.
bool keeps_pieces(const Corner_mesh& corners, Corner_mesh::Halfedge moving,
                  const Border_rule<Corner_mesh::Mesh>& rule);

/// Returns whether pieces are joined after vertices have moved together as they were before, see
/// `No_observer::keeps_joints`.
bool keeps_joints(const Corner_mesh& corners, Corner_mesh::Halfedge moving,
                  const std::vector<Corner_mesh::Halfedge>& others);

} // namespace selvedge

#endif // SELVEDGE_SOUP_KEEPS_PIECES_H
