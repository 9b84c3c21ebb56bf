// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_BIND_POSES_H
#define SELVEDGE_SRC_FILES_GLTF_BIND_POSES_H

#include "files/gltf_document.h"

#include <map>

namespace selvedge::files {

/// Returns the transforms that take skinned meshes to the world in their bind pose, by the numbers of the
/// skins that nodes of the scene with a mesh have. mesh_files.h says what they are.
///
/// Where a document does not say it in the way of the format, a transform is the identity. Throws
/// `Input_error` when matrices are not in the file.
///
/// **Complexity** O(n log n) for n joints of all skins together.
std::map<int, Gltf_scene::Matrix> bind_poses(const Gltf_document& document);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_BIND_POSES_H
