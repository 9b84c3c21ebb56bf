// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Reduction_log.h>

#include "guarded_poses.h"
#include "soup/obstacle.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Sha256.h>

#include <algorithm>
#include <map>
#include <utility>

namespace selvedge {
namespace {

/// Returns for every vertex the smallest number that the log has for a vertex with equal coordinates.
std::vector<Index> smallest_numbers(const std::vector<Point_3>& points, const Log_numbering& numbering)
{
  std::map<std::array<double, 3>, Index> smallest; // compares doubles, so that −0 is 0
  const auto place = [&](Index v) { return std::array{points[v].x(), points[v].y(), points[v].z()}; };
  Cancellation_poll poll;
  for (Index v = 0; v < points.size(); ++v) {
    poll();
    const auto [entry, is_new] = smallest.emplace(place(v), numbering.number(v));
    entry->second = std::min(entry->second, numbering.number(v));
  }
  std::vector<Index> result;
  result.reserve(points.size());
  for (Index v = 0; v < points.size(); ++v) {
    poll();
    result.push_back(smallest.at(place(v)));
  }
  return result;
}

Logged_normals logged(Normals_treatment treatment)
{
  switch (treatment) {
  case Normals_treatment::none:
  case Normals_treatment::kept:
    return Logged_normals::kept;
  case Normals_treatment::mended:
  case Normals_treatment::fitted:
    return Logged_normals::joined;
  case Normals_treatment::softened:
    return Logged_normals::soft;
  case Normals_treatment::smoothed:
    return Logged_normals::smooth;
  case Normals_treatment::smooth:
    return Logged_normals::hard;
  case Normals_treatment::picked:
  case Normals_treatment::flat:
  case Normals_treatment::dropped:
    break;
  }
  return Logged_normals::ignored;
}

Log_header completed(Log_header header, const Prepared_soup& prepared, const Simplify_options& options)
{
  header.limits = limits_of(options);
  if (header.normals == Logged_normals::kept)
    header.normals = logged(prepared.normals);
  header.may_pairs_descend = prepared.may_pairs_descend();
  header.may_intersect = prepared.may_intersect;
  if (prepared.snapping.distance > 0)
    header.limits.weld_distance = prepared.snapping.distance;
  const Triangle_soup& obstacle = prepared.obstacle;
  const std::vector<std::size_t> guarded = guarded_poses(prepared.soup, options);
  if (header.poses.empty())
    for (const std::size_t pose : guarded)
      header.poses.push_back({prepared.soup.poses[pose].name, {}, {}});
  if (!header.obstacle && !obstacle.triangles.empty())
    header.obstacle = {obstacle.points.size(), obstacle.triangles.size(), {}};
  if (header.obstacle && header.poses.size() == guarded.size())
    for (std::size_t i = 0; i < guarded.size(); ++i)
      header.poses[i].sha256_of_obstacle = digest_of(points_in_pose(obstacle, guarded[i]));
  return header;
}

} // namespace

Reduction_log::Reduction_log(std::ostream& stream, Log_header header, const Log_numbering& numbering,
                             const Prepared_soup& prepared, const Simplify_options& options)
    : m_writer(stream, completed(std::move(header), prepared, options)), m_numbering(numbering),
      m_prepared(prepared)
{
  for (const auto& [from, to] : prepared.snapping.snaps) {
    Log_step step;
    step.kind = Log_step::Kind::snap;
    step.removed = numbering.number(from);
    step.kept = numbering.number(to);
    m_writer.write(step);
  }
  // In several poses, other vertices are coincident in each.
  const std::vector<Index> smallest = smallest_numbers(prepared.soup.points, numbering);
  std::map<Index, std::vector<Index>> groups;
  for (Index v = 0; v < smallest.size() && prepared.soup.poses.empty(); ++v)
    if (smallest[v] != numbering.number(v))
      groups[smallest[v]].push_back(numbering.number(v));
  for (auto& [first, others] : groups) {
    Log_step step;
    step.kind = Log_step::Kind::weld;
    step.group = std::move(others);
    step.group.insert(step.group.begin(), first);
    m_writer.write(step);
  }
  Log_step turn;
  turn.kind = Log_step::Kind::turn;
  for (Index t = 0; t < prepared.is_turned.size(); ++t)
    if (prepared.is_turned[t])
      turn.group.push_back(t);
  if (!turn.group.empty())
    m_writer.write(turn);
}

void Reduction_log::add_collapse(const Soup_collapse& collapse)
{
  Log_step step;
  step.removed = m_numbering.number(Index(collapse.removed));
  step.kept = m_numbering.number(Index(collapse.kept));
  step.place = collapse.place;
  step.is_removed_first = collapse.is_removed_first;
  m_writer.write(step);
  ++m_collapses;
}

void Reduction_log::finish(const Simplified_soup& result)
{
  const std::vector<Index> smallest = smallest_numbers(m_prepared.soup.points, m_numbering);
  Sha256 sha256;
  for (const Index_triple& corners : result.corners) {
    const auto number = [&](Index corner) {
      return std::to_string(smallest[m_prepared.soup.triangles[corner / 3][corner % 3]]);
    };
    sha256.add(number(corners[0]) + ' ' + number(corners[1]) + ' ' + number(corners[2]) + '\n');
  }
  m_writer.write(Log_result{m_collapses, result.corners.size(), sha256.digest()});
}

} // namespace selvedge
