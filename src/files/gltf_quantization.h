// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_QUANTIZATION_H
#define SELVEDGE_SRC_FILES_GLTF_QUANTIZATION_H

#include "soup/Gltf_scene.h"

#include <optional>
#include <string>

namespace selvedge::files {

// KHR_mesh_quantization allows attributes to be whole numbers where glTF itself asks for floats. A scene has
// them as floats. They are written as they were in the file where these floats stand for such numbers still.

inline constexpr const char* quantization_extension = "KHR_mesh_quantization";

/// Returns whether only KHR_mesh_quantization allows an attribute of this name such an accessor.
bool is_quantised(const std::string& name, const Gltf_scene::Json& accessor);

/// Returns a column of 32-bit floats, each the nearest to what a quantised number stands for.
Gltf_scene::Column dequantised(const Gltf_scene::Column& column);

/// Returns a column whose `dequantised` is this one, bit for bit, in the type that it has in the file;
/// nothing when it was not quantised there, or when some of its floats come from no such number.
std::optional<Gltf_scene::Column> quantised_again(const Gltf_scene::Column& column);

/// Removes the name of the extension from a document in which no attribute or morph target needs it.
void remove_needless_quantization(Gltf_scene::Json& document);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_QUANTIZATION_H
