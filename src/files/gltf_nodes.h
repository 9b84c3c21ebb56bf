// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_NODES_H
#define SELVEDGE_SRC_FILES_GLTF_NODES_H

#include "soup/Gltf_scene.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace selvedge::files {

/// A level of detail in a document that is being made.
struct Gltf_level
{
  std::size_t triangles = 0;

  /// For each mesh of the scene the one in the document that stands for it; none where nothing of it is left.
  std::vector<std::optional<Index>> meshes;
};

/// Puts the meshes of all levels, from fine to coarse, into the nodes of the document, which is that of the
/// scene with the meshes written, and removes those that no level has. Instances of EXT_mesh_gpu_instancing
/// become nodes where they do not share their mesh any more.
///
/// The first level goes into the nodes of the scene. A node in which further levels differ gets the extension
/// MSFT_lod, which names a new node outside the scene for each: a copy of the node with the mesh of the
/// level. A program that knows the extension puts these in place of the node, with all that is below it. So a
/// node that does more than show its mesh (it has children, a camera or an extension, is a joint, or is
/// moved) gets a child that shows the mesh and has the levels. An animation of the weights of morph targets
/// moves all levels.
void put_meshes_in_nodes(Gltf_scene::Json& document, const Gltf_scene& scene, std::vector<Gltf_level> levels);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_NODES_H
