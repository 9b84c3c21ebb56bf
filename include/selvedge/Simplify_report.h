// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_REPORT_H
#define SELVEDGE_SIMPLIFY_REPORT_H

#include <selvedge/Surface_mesh_simplification/Hindrances.h>
#include <selvedge/Surface_mesh_simplification/Intersection_statistics.h>
#include <selvedge/Surface_mesh_simplification/Refusals.h>
#include <selvedge/spatial/Index_statistics.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace selvedge {

/// What a reduction did, in counts and seconds.
struct Simplify_report
{
  std::size_t faces_input = 0;
  std::size_t faces_fixed = 0; ///< of `faces_input`, those that cannot change: all their corners are locked
  std::size_t faces_target = 0;
  std::size_t faces_output = 0;
  std::size_t faces_to_go = 0; ///< faces above the target at the end, summed over all parts with a target

  /// The faces of a part with a target, or of what is in no such part.
  struct Share
  {
    std::size_t input = 0, fixed = 0; ///< as `faces_input` and `faces_fixed`
    std::size_t target = 0, output = 0;
    std::size_t within_reach = 0; ///< as `faces_within_reach`, of this share

    std::size_t excess() const { return output - std::min(output, target); }
  };
  std::vector<Share> shares; ///< first what is in no such part; the counts above are their sums

  /// Where a caller reduced to more faces than is possible, to keep shape (`Missed_target`): the fewest that
  /// are possible, for which `hindrances` are. Otherwise 0.
  std::size_t faces_within_reach = 0;

  /// Where the caller also eased the turn of borders (`Missed_target`): the limit to which it reduced, in
  /// degrees.
  std::optional<double> eased_border_turn;

  std::size_t collapses = 0;
  std::size_t placed = 0;     ///< how many of `collapses` put the merged vertex to a new place
  std::size_t left_alone = 0; ///< vertices whose partners have gone without them; see `Prepared_soup::tied`
  std::size_t refused_elsewhere = 0; ///< motions that only another place of their shared mesh did not allow
  std::size_t passes = 0;            ///< of the loop: another begins while more collapses may be possible
  bool is_stopped = false;           ///< by `Simplify_options::should_stop`

  /// With `Simplify_options::faces_per_cell`, these three are of the reduction after the cells.
  Refusals refused;
  Intersection_statistics intersections;
  Index_statistics index;
  /// For each further pose: collapses that the exact test refused there, after all poses asked before it
  /// had allowed them. They are among `refused.intersection`.
  std::vector<std::size_t> refused_in_poses;

  std::size_t cells = 0;
  std::size_t collapses_in_cells = 0; ///< how many of `collapses` were found in cells
  double seconds_cells = 0;           ///< part of `seconds_reduce`, until all cells were done and joined
  double seconds_index = 0;           ///< part of `seconds_reduce`, for building the index
  double seconds_reduce = 0;          ///< in all

  /// What holds back the edges that are left. Counted only when the reduction ended by itself short of the
  /// target; otherwise all counts are 0.
  Hindrances hindrances;

  bool is_reached() const { return faces_to_go == 0; }

  /// Returns "reached", "stopped", or the rule that holds back most of the edges left: its key in `Refusals`,
  /// or "topology", also when no edge is left that could go.
  std::string outcome() const
  {
    if (is_reached())
      return "reached";
    if (is_stopped)
      return "stopped";
    std::map<std::string, std::size_t> edges;
    std::string most = "topology";
    for (const Hindrances::Description& description : Hindrances::descriptions())
      edges[description.rule] += hindrances[description.reason];
    for (const auto& [rule, count] : edges)
      if (count > edges[most])
        most = rule;
    return most;
  }
};

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_REPORT_H
