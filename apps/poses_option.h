// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_POSES_OPTION_H
#define SELVEDGE_APPS_POSES_OPTION_H

#include "output_files.h"

#include <selvedge/Triangle_soup.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace selvedge::app {

/// Where the further poses of a mesh come from. They are taken in the order of the members.
struct Pose_sources
{
  std::vector<std::string> files;    ///< meshes and point caches, and patterns of such
  bool are_morphs = false;           ///< whether each morph target of the glTF file is one
  std::string animation;             ///< name of an animation of the glTF file, or "all"
  std::size_t every = 1;             ///< one in so many keyframes of it, and frames of each cache
  bool are_of_humanoid = false;      ///< whether those that its skeleton can take are some
  std::vector<std::string> left_out; ///< names of poses that do not count

  bool empty() const { return files.empty() && !are_morphs && animation.empty() && !are_of_humanoid; }
};

/// The options that name further poses, for messages.
inline constexpr const char* options_of_poses = "--pose, --morphs, --animation or --humanoid-poses";

/// Declares an option that names further poses of a mesh by files.
CLI::Option* add_poses_option(CLI::App& command, const std::string& option, std::vector<std::string>& names,
                              const std::string& description);

/// Declares --pose, with this description, and --morphs, --animation, --every, --humanoid-poses and
/// --without-pose, in a group of the help. `mesh` says in the help which file they are of.
void add_pose_options(CLI::App& command, Pose_sources& sources, const std::string& mesh,
                      const std::string& description, const std::string& group);

/// Declares --obstacle-pose, --obstacle-animation and --obstacle-humanoid-poses, in a group of the help.
/// `mesh` says in the help of which file the others are.
void add_obstacle_pose_options(CLI::App& command, Pose_sources& sources, const std::string& mesh,
                               const std::string& group);

/// Refuses poses of an obstacle where there is no obstacle, or where the mesh has none.
void check_obstacle_poses(const Pose_sources& of_obstacle, const std::string& obstacle,
                          const Pose_sources& of_mesh);

/// Appends the files that an option such as --pose names for a mesh, patterns resolved. Throws `Input_error`
/// where a pattern fits none.
void append_pose_files(std::vector<Named_file>& files, const std::string& option,
                       const std::vector<std::string>& names, const std::string& mesh_file);

/// Returns whether some of the poses are frames, of which --every chooses: of an animation or a point cache.
bool has_frames(const Pose_sources& sources, const std::string& mesh_file);

/// Reads the further poses of a mesh that was read from a file. Poses of one name get the name of their
/// cache or folder before it, and else a number after it. Throws `Input_error` when one that is to be left
/// out is none of them, and `Argument_error` when there are no frames of which --every could choose.
void read_poses(const Pose_sources& sources, const std::string& mesh_file, Triangle_soup& mesh);

/// Reads the poses of an obstacle: one in so many frames as of the mesh, and none of a name that is left
/// out there.
void read_obstacle_poses(const Pose_sources& of_obstacle, const std::string& obstacle_file,
                         const Pose_sources& of_mesh, Triangle_soup& obstacle);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_POSES_OPTION_H
