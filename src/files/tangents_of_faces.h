// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_TANGENTS_OF_FACES_H
#define SELVEDGE_SRC_FILES_TANGENTS_OF_FACES_H

#include "soup/Gltf_scene.h"

#include <cstddef>

namespace selvedge::files {

/// Gives the vertices of a block that differ in nothing but the direction of their tangents the mean of
/// these, as precise as the file has them, and returns how many have a new one. Some programs compute
/// tangents face by face; MikkTSpace, which glTF names, gives such vertices one. They keep theirs where one
/// of them is farther than 80° from the mean, or has no direction, and so do all if tangents are no floats.
///
/// **Complexity** O(n) expected for n vertices.
std::size_t join_tangents_of_faces(Gltf_scene::Block& block);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_TANGENTS_OF_FACES_H
