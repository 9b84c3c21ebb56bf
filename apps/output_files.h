// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_OUTPUT_FILES_H
#define SELVEDGE_APPS_OUTPUT_FILES_H

#include <selvedge/mesh/mesh_files.h>

#include <filesystem>

namespace selvedge::app {

/// The format that an output file's name stands for. Throws `Argument_error` when it stands for none.
Mesh_format output_format(const std::filesystem::path& path);

/// Throws `Output_error` when it is clear before any work that `path` cannot be written.
void require_writable(const std::filesystem::path& path);

/// Whether both name one file, existing or not.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// `write_mesh`, for which a mesh that the format cannot hold is an `Output_error`: nothing is wrong with the
/// command line.
void write_output(const std::filesystem::path& path, const Triangle_soup& soup, bool is_ascii);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_OUTPUT_FILES_H
