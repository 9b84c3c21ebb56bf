// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_DECODING_H
#define SELVEDGE_SRC_FILES_GLTF_DECODING_H

#include "files/gltf_document.h"

#include <string>

namespace selvedge::files {

// The extensions by which a glTF file keeps its meshes small. What they say is decoded after tinygltf has
// read the document; then the document is a plain one, in which nothing names them any more.

inline constexpr const char* draco_extension = "KHR_draco_mesh_compression";
inline constexpr const char* meshopt_extension = "EXT_meshopt_compression";

/// Returns the library without which a file that names this extension cannot be read; empty when there is no
/// such extension or the library is there.
std::string missing_decoder(const std::string& extension);

/// Changes a copy of the document, without extensions, such that tinygltf can read it: buffers that hold
/// nothing until they are decoded become one byte, and accessors of compressed primitives refer to some view.
void prepare_for_decoding(const Gltf_scene::Json& document, Gltf_scene::Json& reduced);

/// Decodes the buffer views of EXT_meshopt_compression, and lists them in `Gltf_document::meshopt_views`.
///
/// Throws `Input_error` when they cannot be decoded, or when their contents are more than 64 KiB and more
/// than 256 times as large as they are.
void decode_views(Gltf_document& document);

/// Decodes the primitives of KHR_draco_mesh_compression: their accessors get buffer views of their own, and
/// `Gltf_document::compressions` says how they were quantised.
///
/// Throws `Input_error` when they cannot be decoded, do not fit their accessors, or when these hold more than
/// 64 KiB and more than 1024 times as much as what is decoded.
void decode_primitives(Gltf_document& document);

/// Returns what an extension says of a node, a primitive or the like; null when it is not there.
const Gltf_scene::Json* find_extension(const Gltf_scene::Json& part, const char* name);

/// Removes an extension of this name from a node, a primitive or the like, if it has one.
void remove_extension_of(Gltf_scene::Json& part, const char* name);

/// Adds a name to the list of extensions that the document uses and, where it is so, to that of those that it
/// requires, unless it is there.
void add_extension(Gltf_scene::Json& document, const std::string& name, bool is_required);

/// Removes a name from the lists of extensions that the document uses and requires.
void remove_extension(Gltf_scene::Json& document, const std::string& name);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_DECODING_H
