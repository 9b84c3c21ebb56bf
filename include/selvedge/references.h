// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REFERENCES_H
#define SELVEDGE_REFERENCES_H

#include <selvedge/mesh_files.h>

#include <filesystem>
#include <string>
#include <vector>

namespace selvedge {

/// Rewrites the names of other files to which a mesh refers, so that a file of a format in another folder
/// refers to the same files: material libraries for OBJ, images for GLB and glTF. `from` is the folder of the
/// file that was read, `to` that of the file that will be written. Returns the names as they are now; none
/// when both folders are one, or the mesh refers to no other file.
///
/// Absolute names and addresses with a scheme stay. A `mtllib` statement is one name when there is a file of
/// that name or the name has no blank, and several names otherwise. Folders may be reached through symbolic
/// links. Buffers of glTF files need no rewriting, because they are written into the new file.
std::vector<std::string> relocate_references(Triangle_soup& soup, Mesh_format format,
                                             const std::filesystem::path& from,
                                             const std::filesystem::path& to);

} // namespace selvedge

#endif // SELVEDGE_REFERENCES_H
