// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "inputs.h"

#include "soup/obstacle.h"

#include <selvedge/Error.h>

#include <cstddef>
#include <string>

namespace selvedge::reference {

namespace {

// Returns what the log says of the pose of a number.
const Log_header::Posed& stated_pose(const Triangle_soup& original, const Log_header& header,
                                     std::size_t pose)
{
  if (pose >= original.poses.size())
    throw Argument_error("there is no pose " + std::to_string(pose) + "; the mesh has " +
                         std::to_string(original.poses.size()) + " further poses");
  const std::string& name = original.poses[pose].name;
  // Without some of the mesh's poses, the log has the others by their names.
  std::size_t place = pose;
  if (header.poses.size() < original.poses.size())
    for (place = 0; place < header.poses.size() && header.poses[place].name != name;)
      ++place;
  if (place >= header.poses.size())
    throw Input_error("the log says nothing of the pose '" + name + "': it has " +
                      std::to_string(header.poses.size()) + " further poses; leave out the others");
  const Log_header::Posed& stated = header.poses[place];
  if (!stated.sha256.empty() && stated.sha256 != digest_of(original.poses[pose].points))
    throw Input_error("the pose '" + name + "' is not the pose '" + stated.name +
                      "' that the log has in its place; give the same poses in the same order");
  return stated;
}

// Returns whether the log names the digests of the obstacle. `posed` is what it says of the pose in question.
// Throws when the obstacle is another.
bool is_obstacle_stated(const Replay_options& options, const Log_header& header,
                        const Log_header::Posed* posed)
{
  const Triangle_soup& obstacle = *options.obstacle;
  if (!header.obstacle)
    return false;
  const Log_header::Obstacle& stated = *header.obstacle;
  if (!stated.sha256.empty() && !options.sha256_of_obstacle.empty() &&
      stated.sha256 != options.sha256_of_obstacle)
    throw Input_error("this is not the obstacle that the log names, which has another SHA-256; give the one "
                      "that the log was made with");
  if (stated.vertices != obstacle.points.size() || stated.triangles != obstacle.triangles.size())
    throw Input_error("the log names an obstacle of " + std::to_string(stated.vertices) + " vertices and " +
                      std::to_string(stated.triangles) + " triangles; this one has " +
                      std::to_string(obstacle.points.size()) + " and " +
                      std::to_string(obstacle.triangles.size()) +
                      "; give the one that the log was made with");
  const bool is_stated = !stated.sha256.empty() && !options.sha256_of_obstacle.empty();
  if (!posed)
    return is_stated;
  if (!posed->sha256_of_obstacle.empty() &&
      posed->sha256_of_obstacle != digest_of(points_in_pose(obstacle, *options.pose)))
    throw Input_error("in the pose '" + posed->name +
                      "', the obstacle is not where the log has it; give the "
                      "poses of the obstacle that the log was made with, in the same order");
  return is_stated && !posed->sha256_of_obstacle.empty();
}

} // namespace

bool check_inputs(const Triangle_soup& original, bool is_stl, const Log_header& header,
                  const Replay_options& options)
{
  const std::size_t vertices = is_stl ? 3 * original.triangles.size() : original.points.size();
  if (!header.sha256.empty() && !options.sha256_of_original.empty() &&
      header.sha256 != options.sha256_of_original)
    throw Input_error("this is not the file that the log was made from, which has another SHA-256; give the "
                      "original that the log was made from");
  if (header.vertices != vertices || header.triangles != original.triangles.size())
    throw Input_error("the log is of a mesh of " + std::to_string(header.vertices) + " vertices and " +
                      std::to_string(header.triangles) + " triangles; this one has " +
                      std::to_string(vertices) + " and " + std::to_string(original.triangles.size()) +
                      "; give the original that the log was made from");
  if (options.obstacle && !options.obstacle->poses.empty() &&
      options.obstacle->poses.size() != original.poses.size())
    throw Argument_error("the obstacle has " + std::to_string(options.obstacle->poses.size()) +
                         " further poses and the mesh " + std::to_string(original.poses.size()) +
                         "; give as many, or none for an obstacle that stands still");
  const Log_header::Posed* const posed =
      options.pose ? &stated_pose(original, header, *options.pose) : nullptr;
  return options.obstacle && is_obstacle_stated(options, header, posed);
}

} // namespace selvedge::reference
