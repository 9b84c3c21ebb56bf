// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Reduction.h"

#include "apps/Thread_limit.h"
#include "apps/report_json.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/Reduction_log.h>
#include <selvedge/collapse_log.h>
#include <selvedge/drop_parts.h>
#include <selvedge/key_poses.h>
#include <selvedge/merge.h>

#include <chrono>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::bindings {
namespace {

using app::Json;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

Reduction::Reduction(Triangle_soup input, const Reduction_request& request, bool has_normals_of_vertices)
    : m_options(request.json()), m_is_sewn(request.is_sewn)
{
  request.check();
  if (request.is_sewn && !input.poses.empty())
    throw Argument_error(
        "sewn: vertices that meet in one pose may be apart in others; leave out one of the two");
  if (request.are_key_poses_chosen && input.poses.empty())
    throw Argument_error("key_poses: there are no further poses; give poses, or leave it out");
  const app::Thread_limit limit(request.threads);
  Log_header header;
  if (has_normals_of_vertices && joins_vertices(request.prepare.normals) &&
      share_vertices_without_normals(input, request.prepare.normals) > 0)
    header.normals = Logged_normals::dropped;
  const Log_numbering numbering(input, false);
  header.vertices = input.points.size();
  header.triangles = input.triangles.size();
  header.dropped_parts = request.dropped_parts;
  m_numbers = drop_parts(input, request.dropped_parts).triangles;
  m_input_triangles = input.triangles;
  header.is_rounded_to_float32 = request.prepare.round_to_float32;
  if (!request.obstacle.triangles.empty())
    header.obstacle = {request.obstacle.points.size(), request.obstacle.triangles.size(), {}};
  Prepare_options prepare_options = request.complete_prepare_options();
  prepare_options.may_intersect = parts_in_pairs(input, request.may_intersect, "may_intersect");
  keep_from_snapping(prepare_options, request.intent);
  m_prepared = prepare(std::move(input), prepare_options, request.obstacle);

  const std::size_t poses = m_prepared.soup.poses.size();
  m_guarded_poses =
      key_poses(m_prepared.soup, request.are_key_poses_chosen ? number_of_key_poses(poses) : poses);
  if (request.is_error_everywhere)
    m_error_search.emplace(*request.options.max_error);
  Missed_target missed_target(request.complete_options());
  do {
    Simplify_options options = missed_target.options();
    if (m_error_search)
      options.max_error = m_error_search->max_error();
    if (m_guarded_poses.size() < poses)
      options.guarded_poses = m_guarded_poses;
    std::ostringstream stream;
    std::optional<Reduction_log> log;
    m_collapses.clear();
    if (request.is_log_wanted) {
      log.emplace(stream, header, numbering, m_prepared, options);
      options.on_collapse = [&](const Soup_collapse& collapse) {
        log->add_collapse(collapse);
        m_collapses.push_back(collapse);
      };
    }
    std::vector<Simplified_soup> results{simplify_soup(m_prepared, options, request.intent)};
    missed_target.complete(results);
    m_result = std::move(results.front());
    m_seconds.add(m_prepared, {&m_result});
    if (log) {
      log->finish(m_result);
      m_log = stream.str();
    }
    const Clock::time_point start = Clock::now();
    m_verification = verify(m_result, m_prepared);
    if (m_error_search)
      m_distances = distances_anywhere(m_result.soup, m_prepared.soup);
    m_seconds["verify"] += seconds_since(start);
  } while (is_to_be_repeated(request, missed_target));
  if (m_is_sewn)
    m_merged = merged_at_positions(m_result.soup);
}

// As in the program: guards the poses in which the result is refused or too far off, or chooses another
// error. Where a target was missed, asks for faces that keep the shape.
bool Reduction::is_to_be_repeated(const Reduction_request& request, Missed_target& missed_target)
{
  if (is_stopped())
    return false;
  if (request.options.check_intersections && add_refused_poses(m_guarded_poses, m_verification))
    return true;
  if (!is_accepted())
    return false;
  if (!m_error_search)
    return missed_target.advance({{m_result, m_verification.distances->original_to_result}});
  const Bounds_over_poses largest = m_distances->larger();
  if (largest.upper > *request.options.max_error && largest.pose && add_pose(m_guarded_poses, *largest.pose))
    return true;
  return m_error_search->advance(largest.upper);
}

std::vector<Index> Reduction::vertices() const
{
  std::vector<Index> vertices(soup().points.size());
  for (std::size_t t = 0; t < soup().triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corner = m_result.corners[t][k];
      vertices[soup().triangles[t][k]] = m_prepared.soup.triangles[corner / 3][corner % 3];
    }
  return vertices;
}

std::vector<Index> Reduction::triangles() const
{
  // What was prepared are these triangles in their order, but for those that were left out.
  std::vector<Index> numbers;
  numbers.reserve(m_prepared.soup.triangles.size());
  for (Index t = 0; numbers.size() < m_prepared.soup.triangles.size(); ++t)
    if (m_input_triangles[t] == m_prepared.soup.triangles[numbers.size()])
      numbers.push_back(m_numbers[t]);
  std::vector<Index> result;
  result.reserve(m_result.triangles.size());
  for (const Index t : m_result.triangles)
    result.push_back(numbers[t]);
  return result;
}

std::string Reduction::report() const
{
  Json report = app::new_report("simplify");
  report["options"] = Json::parse(m_options);
  app::add_reduction(report, m_prepared, m_result);
  app::add_verification(report, m_verification, true);
  app::add_guarded_poses(report, m_guarded_poses, m_result);
  app::add_distances(report, m_verification, m_distances);
  app::add_error_search(report, m_error_search);
  app::add_parts(report, m_prepared, m_result);
  report["seconds"] = m_seconds.json({"weld", "check", "snap", "index", "cells", "reduce", "verify"});
  return app::to_text(report);
}

Replay_verdict replay(const Triangle_soup& original, const std::string& log, Replay_options options)
{
  std::istringstream stream(log);
  Log_reader reader(stream, "the log");
  return selvedge::replay(original, false, reader, options);
}

std::string report_of(const Replay_verdict& verdict)
{
  Json report = app::new_report("replay");
  app::add_replay(report, verdict);
  return app::to_text(report);
}

} // namespace selvedge::bindings
