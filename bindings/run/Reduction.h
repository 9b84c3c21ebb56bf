// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BINDINGS_RUN_REDUCTION_H
#define SELVEDGE_BINDINGS_RUN_REDUCTION_H

#include "Reduction_request.h"
#include "apps/report_json.h"

#include <selvedge/Error_search.h>
#include <selvedge/Missed_target.h>
#include <selvedge/compare.h>
#include <selvedge/replay.h>
#include <selvedge/verify.h>

#include <optional>
#include <string>
#include <vector>

namespace selvedge::bindings {

/// A reduction from a mesh in memory to judged meshes in memory, as `selvedge simplify` makes it from file to
/// files: one for each level of detail, or one where the request has no `lods`. Levels have the order of the
/// request, and are numbered from 0.
class Reduction
{
public:
  /// Reduces and judges. Throws what `prepare` and `simplify_soup` throw, and `Argument_error` when
  /// `request.check()` does. `has_normals_of_vertices` says that the input is from a file with one normal for
  /// each vertex: vertices that differ in their normals alone then become one where these are made anew.
  Reduction(Triangle_soup input, const Reduction_request& request, bool has_normals_of_vertices = false);

  std::size_t level_count() const { return m_levels.size(); }

  const Triangle_soup& soup(std::size_t level) const
  {
    return m_is_sewn ? m_levels[level].merged : m_levels[level].result.soup;
  }

  /// For every vertex of the result, the vertex of the input that it is or, at a new place
  /// (`Placement::optimal`), the one of whose attributes most were taken. For every triangle of the result,
  /// the triangle of the input that it was.
  std::vector<Index> vertices(std::size_t level) const;
  std::vector<Index> triangles(std::size_t level) const;

  bool is_accepted(std::size_t level) const { return m_levels[level].is_accepted(); }
  bool is_reached(std::size_t level) const { return m_levels[level].result.report.is_reached(); }
  bool is_stopped(std::size_t level) const { return m_levels[level].result.report.is_stopped; }

  /// Every collapse that led to the level, in the format of collapse_log.h; empty unless the request asks for
  /// it.
  const std::string& log(std::size_t level) const { return m_levels[level].log; }

  /// These collapses as pairs (removed, kept) of vertices of the input; empty unless a log was asked for.
  const std::vector<Soup_collapse>& collapses(std::size_t level) const { return m_levels[level].collapses; }

  /// Returns a report in JSON: what the program's reports say of a level, apart from files (docs/report.md).
  std::string report(std::size_t level) const;

private:
  struct Level
  {
    bool is_accepted() const { return verification.accepted() && verification.same_topology(); }

    Simplified_soup result;
    Triangle_soup merged; // if it is sewn
    Verification verification;
    std::optional<Distances_anywhere> distances; // where the error is to be kept everywhere
    std::string log;
    std::vector<Soup_collapse> collapses;
  };

  void take(std::vector<Simplified_soup> results);
  bool is_to_be_repeated(const Reduction_request& request, std::optional<Missed_target>& missed_target);

  std::vector<Index> m_numbers;                // in the input, of the triangles that are not dropped
  std::vector<Index_triple> m_input_triangles; // these
  std::string m_options;
  bool m_is_sewn;
  bool m_is_error_given; // a number, of which the report tells how well it was kept
  std::optional<std::size_t> m_threads;
  Prepared_soup m_prepared;
  std::vector<std::size_t> m_guarded_poses;
  std::vector<Level> m_levels;
  std::optional<Error_search> m_error_search; // where the error is to be kept everywhere
  app::Phase_seconds m_seconds;
};

/// Replays a log on the mesh that it was made of.
Replay_verdict replay(const Triangle_soup& original, const std::string& log, Replay_options options);

/// Returns what the program's reports say of a verdict, in JSON.
std::string report_of(const Replay_verdict& verdict);

} // namespace selvedge::bindings

#endif // SELVEDGE_BINDINGS_RUN_REDUCTION_H
