// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_POSES_OPTION_H
#define SELVEDGE_APPS_POSES_OPTION_H

#include <selvedge/Triangle_soup.h>

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace selvedge::app {

/// Declares an option that names further poses of a mesh, by files (meshes and point caches) and patterns of
/// such.
CLI::Option* add_poses_option(CLI::App& command, const std::string& option, std::vector<std::string>& names,
                              const std::string& description);

/// Reads the poses that the option names into a mesh that was read from a file.
void read_poses(const std::vector<std::string>& names, const std::string& mesh_file, Triangle_soup& mesh);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_POSES_OPTION_H
