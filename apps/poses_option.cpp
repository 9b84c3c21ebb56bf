// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "poses_option.h"

#include "subcommands.h"

#include <selvedge/Error.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/poses.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string>
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

void add_pose_options(CLI::App& command, Pose_sources& sources, const std::string& mesh,
                      const std::string& description, const std::string& group)
{
  add_poses_option(command, "--pose", sources.files, description)->group(group);
  command
      .add_flag("--morphs", sources.are_morphs,
                "Each morph target of " + mesh +
                    " (glTF), at weight 1 on all meshes that have it, is a further pose.")
      ->group(group);
  command
      .add_option("--animation", sources.animation,
                  "The keyframes of this animation of " + mesh +
                      " (glTF), or of all of them, are further poses: skins, morph targets and moving "
                      "nodes are evaluated in double precision.")
      ->type_name("NAME|all")
      ->group(group);
  command
      .add_option(
          "--every", sources.every,
          "Of the keyframes of --animation, and of the frames of each point cache, take the first and "
          "each N-th after it.")
      ->type_name("N")
      ->check(in_range(1))
      ->capture_default_str()
      ->group(group);
  command
      .add_flag("--humanoid-poses", sources.are_of_humanoid,
                "Poses that clothes meet, made of the skeleton of a human figure in " + mesh +
                    " (glTF, VRM), are further poses: arms down, elbows bent, arms forward, arms up, a step, "
                    "sitting, bowing.")
      ->group(group);
  command
      .add_option("--without-pose", sources.left_out,
                  "Leaves out one of these poses, such as a morph target in which a face has no area, by the "
                  "name that summary and report give it. May be given several times.")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(group);
}

void add_obstacle_pose_options(CLI::App& command, Pose_sources& sources, const std::string& mesh,
                               const std::string& group)
{
  add_poses_option(command, "--obstacle-pose", sources.files,
                   "Poses of the obstacle, as many as of " + mesh +
                       " and in the same order. Without them it stands still.")
      ->group(group);
  command
      .add_option(
          "--obstacle-animation", sources.animation,
          "The keyframes of this animation of the obstacle (glTF), or of all of them, are poses of the "
          "obstacle, one in so many as --every says.")
      ->type_name("NAME|all")
      ->group(group);
  command
      .add_flag(
          "--obstacle-humanoid-poses", sources.are_of_humanoid,
          "The poses of --humanoid-poses, made of the skeleton of the obstacle, are poses of the obstacle.")
      ->group(group);
}

void check_obstacle_poses(const Pose_sources& of_obstacle, const std::string& obstacle,
                          const Pose_sources& of_mesh)
{
  if (of_obstacle.empty())
    return;
  const std::string option = !of_obstacle.files.empty()       ? "--obstacle-pose"
                             : !of_obstacle.animation.empty() ? "--obstacle-animation"
                                                              : "--obstacle-humanoid-poses";
  if (of_mesh.empty())
    throw Argument_error(option + ": the mesh has no further poses; give them by " + options_of_poses);
  if (obstacle.empty())
    throw Argument_error(option + ": there is no obstacle; give --obstacle FILE");
}

void append_pose_files(std::vector<Named_file>& files, const std::string& option,
                       const std::vector<std::string>& names, const std::string& mesh_file)
{
  for (const std::string& name : names)
    for (const std::filesystem::path& file : files_named(name, mesh_file))
      files.push_back({option, file});
}

namespace {

// Gives poses of one name the names of the cache or folder that they come from, and else numbers.
void give_names_of_their_own(std::vector<Pose>& poses, const std::vector<std::string>& origins)
{
  std::map<std::string, std::size_t> times;
  for (const Pose& pose : poses)
    ++times[pose.name];
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (times[poses[i].name] > 1 && !origins[i].empty())
      poses[i].name = origins[i] + '_' + poses[i].name;
  std::set<std::string> taken;
  for (Pose& pose : poses) {
    const std::string name = pose.name;
    for (std::size_t number = 2; !taken.insert(pose.name).second; ++number)
      pose.name = name + '_' + std::to_string(number);
  }
}

// Returns the first pose of a cache and each n-th after it.
std::vector<Pose> every(std::vector<Pose> poses, std::size_t n)
{
  std::vector<Pose> result;
  for (std::size_t i = 0; i < poses.size(); i += n)
    result.push_back(std::move(poses[i]));
  return result;
}

} // namespace

bool has_frames(const Pose_sources& sources, const std::string& mesh_file)
{
  std::vector<Named_file> files;
  append_pose_files(files, "", sources.files, mesh_file);
  return !sources.animation.empty() || std::any_of(files.begin(), files.end(), [](const Named_file& file) {
    return is_point_cache(file.path);
  });
}

void read_poses(const Pose_sources& sources, const std::string& mesh_file, Triangle_soup& mesh)
{
  if (sources.every > 1 && !has_frames(sources, mesh_file))
    throw Argument_error("--every: there are no frames to choose from; give --animation or a point cache");
  std::vector<std::string> origins; // of poses
  const auto append = [&](std::vector<Pose> poses, const std::string& origin = {}) {
    origins.insert(origins.end(), poses.size(), origin);
    std::move(poses.begin(), poses.end(), std::back_inserter(mesh.poses));
  };
  for (const std::string& name : sources.files)
    for (const std::filesystem::path& file : files_named(name, mesh_file))
      if (is_point_cache(file))
        append(every(read_point_cache(file, mesh), sources.every), file.stem().string());
      else
        append({read_pose(file, mesh)}, std::filesystem::absolute(file).parent_path().filename().string());
  if (sources.are_morphs)
    append(morph_poses(mesh, mesh_file));
  if (!sources.animation.empty())
    append(animation_poses(mesh, sources.animation, sources.every, mesh_file));
  if (sources.are_of_humanoid)
    append(humanoid_poses(mesh, mesh_file));
  give_names_of_their_own(mesh.poses, origins);
  for (const std::string& name : sources.left_out) {
    const auto found = std::find_if(mesh.poses.begin(), mesh.poses.end(),
                                    [&](const Pose& pose) { return pose.name == name; });
    if (found == mesh.poses.end()) {
      std::string names;
      for (const Pose& pose : mesh.poses)
        names += (names.empty() ? "'" : ", '") + pose.name + "'";
      throw Input_error(mesh_file + ": has no further pose '" + name + "' to leave out; there " +
                        (names.empty() ? "is none" : "are " + names));
    }
    mesh.poses.erase(found);
  }
}

void read_obstacle_poses(const Pose_sources& of_obstacle, const std::string& obstacle_file,
                         const Pose_sources& of_mesh, Triangle_soup& obstacle)
{
  Pose_sources sources = of_obstacle;
  sources.every = has_frames(of_obstacle, obstacle_file) ? of_mesh.every : 1;
  read_poses(sources, obstacle_file, obstacle);
  const auto is_left_out = [&](const Pose& pose) {
    return std::find(of_mesh.left_out.begin(), of_mesh.left_out.end(), pose.name) != of_mesh.left_out.end();
  };
  obstacle.poses.erase(std::remove_if(obstacle.poses.begin(), obstacle.poses.end(), is_left_out),
                       obstacle.poses.end());
}

} // namespace selvedge::app
