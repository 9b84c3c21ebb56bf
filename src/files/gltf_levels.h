// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_LEVELS_H
#define SELVEDGE_SRC_FILES_GLTF_LEVELS_H

#include "files/gltf_document.h"

#include <cstddef>

namespace selvedge::files {

inline constexpr const char* levels_extension = "MSFT_lod";

/// Makes the document one of a single level of detail, 0 being the finest. The node of a coarser level takes
/// the place of the node that names it, but for the name; a node with fewer levels takes its coarsest. The
/// nodes of all other levels become empty, or go where they are the last of the document; what refers to them
/// goes, and so do meshes that only they name. Levels of materials stay.
///
/// Is to be called before the document is loaded. Throws `Input_error` when a node names another one that is
/// not there, or no node has this level.
void choose_level(Gltf_document& document, std::size_t level);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_LEVELS_H
