// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "poses_option.h"

#include <selvedge/poses.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace selvedge::app {

CLI::Option* add_poses_option(CLI::App& command, const std::string& option, std::vector<std::string>& names,
                              const std::string& description)
{
  return command.add_option(option, names, description)
      ->type_name("FILE|PATTERN")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void read_poses(const std::vector<std::string>& names, const std::string& mesh_file, Triangle_soup& mesh)
{
  for (const std::string& name : names)
    for (const std::filesystem::path& file : files_named(name, mesh_file)) {
      std::vector<Pose> poses =
          is_point_cache(file) ? read_point_cache(file, mesh) : std::vector<Pose>{read_pose(file, mesh)};
      std::move(poses.begin(), poses.end(), std::back_inserter(mesh.poses));
    }
}

} // namespace selvedge::app
