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
#include <selvedge/internal/Stopwatch.h>
#include <selvedge/key_poses.h>
#include <selvedge/merge.h>
#include <selvedge/suited_normals.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::bindings {

using app::Json;

Reduction::Reduction(Triangle_soup input, const Reduction_request& request, bool has_normals_of_vertices)
    : m_options(request.json()), m_is_sewn(request.is_sewn),
      m_is_error_given(request.is_error_given && request.options.max_error), m_threads(request.threads)
{
  request.check();
  if (request.is_sewn && !input.poses.empty())
    throw Argument_error(
        "sewn: vertices that meet in one pose may be apart in others; leave out one of the two");
  if (request.are_key_poses_chosen && input.poses.empty())
    throw Argument_error("key_poses: there are no further poses; give poses, or leave it out");
  const app::Thread_limit limit(request.threads);
  Log_header header;
  const Log_numbering numbering(input, false);
  header.vertices = input.points.size();
  header.triangles = input.triangles.size();
  header.dropped_parts = request.dropped_parts;
  m_numbers = drop_parts(input, request.dropped_parts).triangles;
  const Suited_normals normals = suit_normals(input, request.prepare.normals, has_normals_of_vertices);
  if (normals.joined_corners > 0)
    header.normals = shared_normals(normals.choice);
  m_input_triangles = input.triangles;
  header.is_rounded_to_float32 = request.prepare.round_to_float32;
  if (!request.obstacle.triangles.empty())
    header.obstacle = {request.obstacle.points.size(), request.obstacle.triangles.size(), {}};
  Prepare_options prepare_options = request.complete_prepare_options();
  prepare_options.normals = normals.choice;
  prepare_options.may_intersect = parts_in_pairs(input, request.may_intersect, "may_intersect");
  keep_from_snapping(prepare_options, request.intent);
  m_prepared = prepare(std::move(input), prepare_options, request.obstacle);

  const std::size_t poses = m_prepared.soup.poses.size();
  m_guarded_poses =
      key_poses(m_prepared.soup, request.are_key_poses_chosen ? number_of_key_poses(poses) : poses);
  std::optional<Missed_target> missed_target;
  if (request.is_error_everywhere)
    m_error_search.emplace(*request.options.max_error);
  else
    missed_target.emplace(request.complete_options(), request.is_border_turn_given);
  do {
    Simplify_options options = missed_target ? missed_target->options() : request.complete_options();
    if (m_error_search)
      options.max_error = m_error_search->max_error();
    if (m_guarded_poses.size() < poses)
      options.guarded_poses = m_guarded_poses;
    options.are_values_fitted = false; // until a result is kept
    std::vector<Soup_collapse> collapses;
    if (request.is_log_wanted)
      options.on_collapse = [&](const Soup_collapse& collapse) { collapses.push_back(collapse); };
    std::vector<Simplified_soup> results;
    if (request.lods.empty())
      results.push_back(simplify_soup(m_prepared, options, request.intent));
    else
      results = simplify_lods(m_prepared, options, request.lods, request.intent);
    if (missed_target)
      missed_target->complete(results);
    take(std::move(results));
    if (request.is_log_wanted) {
      std::vector<const Simplified_soup*> all;
      for (const Level& level : m_levels)
        all.push_back(&level.result);
      const std::vector<Collapses_of_level> shares = collapses_of_levels(all, options, request.intent);
      for (std::size_t i = 0; i < m_levels.size(); ++i) {
        Level& level = m_levels[i];
        const auto first = collapses.begin() + std::ptrdiff_t(shares[i].first);
        level.collapses.assign(first, first + std::ptrdiff_t(shares[i].count));
        std::ostringstream stream;
        Reduction_log log(stream, header, numbering, m_prepared, options);
        for (const Soup_collapse& collapse : level.collapses)
          log.add_collapse(collapse);
        log.finish(level.result);
        level.log = stream.str();
      }
    }
  } while (is_to_be_repeated(request, missed_target));
  const internal::Stopwatch stopwatch;
  for (Level& level : m_levels)
    fit_values(level.result, m_prepared, request.intent);
  m_seconds["fit"] += stopwatch.seconds();
  if (m_is_sewn)
    for (Level& level : m_levels)
      level.merged = merged_at_positions(level.result.soup);
}

// Judges results, which become the levels.
void Reduction::take(std::vector<Simplified_soup> results)
{
  m_levels.clear();
  std::vector<const Simplified_soup*> all;
  for (const Simplified_soup& result : results)
    all.push_back(&result);
  m_seconds.add(m_prepared, all);
  const internal::Stopwatch stopwatch;
  for (Simplified_soup& result : results) {
    Level& level = m_levels.emplace_back();
    level.result = std::move(result);
    level.verification = verify(level.result, m_prepared);
    if (m_error_search)
      level.distances = distances_anywhere(level.result.soup, m_prepared.soup);
  }
  m_seconds["verify"] += stopwatch.seconds();
}

// As in the program: guards the poses in which a result is refused or too far off, or chooses another error.
// Where a target was missed, asks for faces that keep the shape.
bool Reduction::is_to_be_repeated(const Reduction_request& request,
                                  std::optional<Missed_target>& missed_target)
{
  const auto is_stopped = [](const Level& level) { return level.result.report.is_stopped; };
  if (std::any_of(m_levels.begin(), m_levels.end(), is_stopped))
    return false;
  bool are_poses_added = false, are_all_accepted = true;
  for (const Level& level : m_levels) {
    are_poses_added |=
        request.options.check_intersections && add_refused_poses(m_guarded_poses, level.verification);
    are_all_accepted &= level.is_accepted();
  }
  if (are_poses_added || !are_all_accepted)
    return are_poses_added;
  if (missed_target) {
    std::vector<Missed_target::Judged> judged;
    for (const Level& level : m_levels)
      judged.push_back({level.result, level.verification.distances->original_to_result, m_prepared});
    return missed_target->advance(judged);
  }
  std::vector<Bounds_over_poses> largest;
  for (const Level& level : m_levels)
    largest.push_back(level.distances->larger());
  return m_error_search->advance(largest, m_guarded_poses);
}

std::vector<Index> Reduction::vertices(std::size_t level) const
{
  const Triangle_soup& of_level = soup(level);
  std::vector<Index> vertices(of_level.points.size());
  for (std::size_t t = 0; t < of_level.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corner = m_levels[level].result.corners[t][k];
      vertices[of_level.triangles[t][k]] = m_prepared.soup.triangles[corner / 3][corner % 3];
    }
  return vertices;
}

std::vector<Index> Reduction::triangles(std::size_t level) const
{
  // What was prepared are these triangles in their order, but for those that were left out.
  std::vector<Index> numbers;
  numbers.reserve(m_prepared.soup.triangles.size());
  for (Index t = 0; numbers.size() < m_prepared.soup.triangles.size(); ++t)
    if (m_input_triangles[t] == m_prepared.soup.triangles[numbers.size()])
      numbers.push_back(m_numbers[t]);
  std::vector<Index> result;
  result.reserve(m_levels[level].result.triangles.size());
  for (const Index t : m_levels[level].result.triangles)
    result.push_back(numbers[t]);
  return result;
}

std::string Reduction::report(std::size_t level) const
{
  const Level& of_level = m_levels[level];
  Json report = app::new_report("simplify");
  report["options"] = Json::parse(m_options);
  app::add_reduction(report, m_prepared, of_level.result);
  app::add_verification(report, of_level.verification, true);
  app::add_guarded_poses(report, m_guarded_poses, of_level.result);
  std::optional<Distances_anywhere> distances = of_level.distances;
  if (m_is_error_given && !distances) {
    const app::Thread_limit limit(m_threads);
    distances = distances_anywhere(of_level.result.soup, m_prepared.soup);
  }
  app::add_distances(report, of_level.verification, distances);
  app::add_error_search(report, m_error_search);
  app::add_parts(report, m_prepared, of_level.result);
  report["seconds"] = m_seconds.json({"weld", "check", "snap", "index", "cells", "reduce", "verify", "fit"});
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
