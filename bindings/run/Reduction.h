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

/// A reduction from a mesh in memory to a judged mesh in memory, as `selvedge simplify` makes it from file to
/// file.
class Reduction
{
public:
  /// Reduces and judges. Throws what `prepare` and `simplify_soup` throw, and `Argument_error` when
  /// `request.check()` does. `has_normals_of_vertices` says that the input is from a file with one normal for
  /// each vertex: vertices that differ in their normals alone then become one where these are made anew.
  Reduction(Triangle_soup input, const Reduction_request& request, bool has_normals_of_vertices = false);

  const Triangle_soup& soup() const { return m_is_sewn ? m_merged : m_result.soup; }

  /// For every vertex of the result, the vertex of the input that it is or, at a new place
  /// (`Placement::optimal`), the one of whose attributes most were taken. For every triangle of the result,
  /// the triangle of the input that it was.
  std::vector<Index> vertices() const;
  std::vector<Index> triangles() const;

  const Verification& verification() const { return m_verification; }
  bool is_accepted() const { return m_verification.accepted() && m_verification.same_topology(); }
  bool is_reached() const { return m_result.report.is_reached(); }
  bool is_stopped() const { return m_result.report.is_stopped; }

  /// Every collapse, in the format of collapse_log.h; empty unless the request asks for it.
  const std::string& log() const { return m_log; }

  /// The collapses as pairs (removed, kept) of vertices of the input; empty unless a log was asked for.
  const std::vector<Soup_collapse>& collapses() const { return m_collapses; }

  /// Returns a report in JSON: what the program's reports say of a reduction, apart from files
  /// (docs/report.md).
  std::string report() const;

private:
  bool is_to_be_repeated(const Reduction_request& request, Missed_target& missed_target);

  std::vector<Index> m_numbers;                // in the input, of the triangles that are not dropped
  std::vector<Index_triple> m_input_triangles; // these
  std::string m_options;
  bool m_is_sewn;
  Prepared_soup m_prepared;
  std::vector<std::size_t> m_guarded_poses;
  Simplified_soup m_result;
  Triangle_soup m_merged; // if it is sewn
  Verification m_verification;
  std::optional<Distances_anywhere> m_distances; // these two where the error is to be kept everywhere
  std::optional<Error_search> m_error_search;
  std::string m_log;
  std::vector<Soup_collapse> m_collapses;
  app::Phase_seconds m_seconds;
};

/// Replays a log on the mesh that it was made of.
Replay_verdict replay(const Triangle_soup& original, const std::string& log, Replay_options options);

/// Returns what the program's reports say of a verdict, in JSON.
std::string report_of(const Replay_verdict& verdict);

} // namespace selvedge::bindings

#endif // SELVEDGE_BINDINGS_RUN_REDUCTION_H
