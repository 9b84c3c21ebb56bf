// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/replay.h>

#include <sstream>
#include <string>
#include <vector>

// Lists what a verdict of `replay` does not cover, so that reports can state it.

namespace selvedge {
namespace {

std::string text_of(double number)
{
  std::ostringstream text;
  text << number;
  return text.str();
}

} // namespace

std::vector<Not_judged> not_judged(const Replay_verdict& verdict)
{
  const Reduction_limits& limits = verdict.limits;
  std::vector<Not_judged> result;
  // Without a weld distance nothing snaps, without a height no corner is low, and pieces need a distance only
  // where somebody asks for one.
  const auto is_expected = [&](const Limit_description& limit) {
    return limit.value == &Reduction_limits::clearance ? verdict.header.limits.clearance.has_value()
                                                       : limit.value != &Reduction_limits::weld_distance &&
                                                             limit.value != &Reduction_limits::corner_height;
  };
  for (const Limit_description& limit : limit_descriptions)
    if (is_expected(limit) && !(limits.*limit.value))
      result.push_back({limit.key, std::string(limit.bounds) + ": there is no limit"});
  if (!limits.border_turn && !limits.seam_turn && !limits.border_drift)
    result.push_back(
        {"lines", "whether borders and seams move only along themselves: there is no limit on them"});
  if (verdict.snaps > 0)
    result.push_back({"limits_of_snaps", "what snaps do to angles and shapes of triangles, and to borders: "
                                         "the weld distance is their only limit"});
  if (const Logged_normals normals = verdict.header.normals; normals == Logged_normals::ignored ||
                                                             normals == Logged_normals::dropped ||
                                                             normals == Logged_normals::loose_shared)
    result.push_back(
        {"normals", std::string("whether edges across which normals differ move only along themselves: the "
                                "log says that normals are ") +
                        (normals == Logged_normals::dropped ? "dropped" : "ignored")});
  else if (normals == Logged_normals::soft || normals == Logged_normals::soft_shared)
    result.push_back({"normals", "whether soft edges, across which normals differ and which nobody sees as "
                                 "edges, move only along themselves"});
  else if (normals == Logged_normals::hard)
    result.push_back({"normals", "whether edges across which normals differ by at most 1° move only along "
                                 "themselves: new normals take the place of these"});
  for (const std::string& name : verdict.header.dropped_parts.names)
    result.push_back({"drop_part", "the part '" + name + "': the log says that it is left out"});
  if (const double size = verdict.header.dropped_parts.smaller_than; size > 0)
    result.push_back({"drop_smaller", "parts that are smaller than " + text_of(size) +
                                          ": the log says that they are left out"});
  for (const std::string& name : verdict.header.dropped)
    result.push_back(
        {"dropped", "whether edges across which the attribute '" + name +
                        "' differs move only along themselves: the log says that it is left out"});
  for (const auto& [a, b] : verdict.header.may_intersect)
    result.push_back({"may_intersect", "whether the parts '" + a + "' and '" + b +
                                           "' keep clear of each other: the log says that they may "
                                           "intersect"});
  if (verdict.is_in_first_pose && !verdict.header.poses.empty())
    result.push_back({"poses", "the further poses that the log names (" +
                                   std::to_string(verdict.header.poses.size()) +
                                   "): each has a verdict of its own"});
  const bool is_obstacle_missing = verdict.header.obstacle && !verdict.is_obstacle_judged;
  if (is_obstacle_missing)
    result.push_back(
        {"obstacle", "whether the steps keep clear of the obstacle that the log names: it was not given"});
  if (is_obstacle_missing && verdict.header.may_pairs_descend)
    result.push_back({"pairs",
                      "whether there are ever more offending pairs than before a step: those with the "
                      "obstacle are not known"});
  if (!verdict.is_input_stated)
    result.push_back(
        {"input", verdict.header.sha256.empty()
                      ? "whether the log was made from this file: it names no SHA-256 of its input"
                      : "whether the log was made from this file: its SHA-256 is not known"});
  if (!verdict.is_result_stated && !verdict.is_result_another)
    result.push_back({"result",
                      "whether the triangles left are the writer's result: no digest of the log was "
                      "found to match them"});
  if (verdict.places > 0)
    result.push_back({"places", "whether the new places of vertices that the log names are the writer's: the "
                                "digest of its result stands for numbers of vertices alone"});
  result.push_back({"attributes", "values attached to vertices and triangles, such as texture coordinates"});
  return result;
}

} // namespace selvedge
