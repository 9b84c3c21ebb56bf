// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_OUTPUT_FILES_H
#define SELVEDGE_APPS_OUTPUT_FILES_H

#include <selvedge/mesh_files.h>

#include <filesystem>

namespace selvedge::app {

/// Returns the format that the name of an output file stands for. Throws `Argument_error` when it stands for
/// none.
Mesh_format output_format(const std::filesystem::path& path);

/// Throws `Output_error` when `path` cannot be written, as far as that is clear before any work is done.
void require_writable(const std::filesystem::path& path);

/// Returns whether both paths name one file, which need not exist.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Writes a mesh as `write_mesh` does, but throws `Output_error` when the format cannot hold it: the command
/// line is not at fault then.
void write_output(const std::filesystem::path& path, const Triangle_soup& soup, bool is_ascii);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_OUTPUT_FILES_H
