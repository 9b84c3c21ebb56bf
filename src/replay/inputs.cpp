// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "inputs.h"

#include "soup/obstacle.h"

#include <selvedge/Error.h>

#include <cstddef>
#include <optional>
#include <string>

namespace selvedge {

std::optional<std::size_t> stated_pose(const Log_header& header, const Triangle_soup& original,
                                       std::size_t pose, const Triangle_soup* obstacle)
{
  if (pose >= original.poses.size())
    throw Argument_error("there is no pose " + std::to_string(pose) + "; the mesh has " +
                         std::to_string(original.poses.size()) + " further poses");
  const std::string digest = digest_of(original.poses[pose].points),
                    of_obstacle = obstacle ? digest_of(points_in_pose(*obstacle, pose)) : "";
  std::optional<std::size_t> best;
  int rank_of_best = 0;
  for (std::size_t place = 0; place < header.poses.size(); ++place) {
    const Log_header::Posed& stated = header.poses[place];
    const bool has_digest = stated.sha256 == digest, has_name = stated.name == original.poses[pose].name;
    // A log of some of the mesh's poses has them at other places.
    const bool has_place = place == pose && header.poses.size() >= original.poses.size();
    if (!has_digest && !(stated.sha256.empty() && (has_name || has_place)))
      continue;
    const int rank = 8 * has_digest + 4 * (obstacle && stated.sha256_of_obstacle == of_obstacle) +
                     2 * has_name + has_place;
    if (!best || rank > rank_of_best) {
      best = place;
      rank_of_best = rank;
    }
  }
  return best;
}

} // namespace selvedge

namespace selvedge::reference {

namespace {

// Returns what the log says of the pose that is judged.
const Log_header::Posed& posed(const Triangle_soup& original, const Log_header& header,
                               const Replay_options& options)
{
  const auto place =
      stated_pose(header, original, *options.pose, options.obstacle ? &*options.obstacle : nullptr);
  if (!place)
    throw Input_error("the log says nothing of the pose '" + original.poses[*options.pose].name +
                      "': it names " + std::to_string(header.poses.size()) +
                      " further poses, and none has these places; give the poses that the log was made with");
  return header.poses[*place];
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
  const Log_header::Posed* const stated = options.pose ? &posed(original, header, options) : nullptr;
  return options.obstacle && is_obstacle_stated(options, header, stated);
}

} // namespace selvedge::reference
