// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_MESH_FILES_H
#define SELVEDGE_MESH_MESH_FILES_H

#include <selvedge/mesh/Triangle_soup.h>

#include <filesystem>

namespace selvedge {

enum class Mesh_format { obj, off, ply, stl };

/// The format that a path's extension names (`.obj`, `.off`, `.ply`, `.stl`, in any case).
/// Throws `Input_error` when it names none of them.
Mesh_format mesh_format(const std::filesystem::path& path);

} // namespace selvedge

#endif // SELVEDGE_MESH_MESH_FILES_H
