// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_MATERIAL_TEXTURES_H
#define SELVEDGE_SOUP_MATERIAL_TEXTURES_H

#include "Gltf_scene.h"

#include <functional>
#include <string>
#include <vector>

namespace selvedge {

/// Removes the references of materials to textures whose coordinates are left out, as `is_dropped` says of
/// the name of a set (`TEXCOORD_0`). Textures to which only these referred go from the document, and so do
/// images and samplers of these textures alone; others get new numbers. They all stay in a document with an
/// extension that is not known to leave textures to the materials, because it may refer to them by number.
void drop_textures(Gltf_scene& scene, const std::function<bool(const std::string& set)>& is_dropped);

/// Returns the numbers of the materials that no primitive has but those that are dropped, nor a variant of
/// another one, nor a material as its coarser level; ascending. It returns none where the document has an
/// extension as above. `is_dropped` says by part of the scene which are dropped.
std::vector<Index> materials_of(const Gltf_scene& scene, const std::vector<char>& is_dropped);

/// Removes the references of these materials to textures, and the textures, as above.
void drop_textures_of(Gltf_scene& scene, const std::vector<Index>& materials);

} // namespace selvedge

#endif // SELVEDGE_SOUP_MATERIAL_TEXTURES_H
