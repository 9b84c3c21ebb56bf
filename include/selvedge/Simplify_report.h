// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_REPORT_H
#define SELVEDGE_SIMPLIFY_REPORT_H

#include <selvedge/Surface_mesh_simplification/Intersection_statistics.h>
#include <selvedge/Surface_mesh_simplification/Refusals.h>
#include <selvedge/spatial/Index_statistics.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace selvedge {

/// What a reduction of a mesh did.
struct Simplify_report
{
  std::size_t faces_input = 0;
  std::size_t faces_target = 0;
  std::size_t faces_output = 0;
  std::size_t faces_to_go = 0; ///< by which shares exceed their targets at the end
  std::size_t collapses = 0;
  std::size_t passes = 0;  ///< of CGAL's loop: another begins while refused edges have become possible
  bool is_stopped = false; ///< by `Simplify_options::should_stop`
  Refusals refused; ///< with `Simplify_options::faces_per_cell`: after the cells, as the next two
  Intersection_statistics intersections;
  Index_statistics index;
  std::size_t cells = 0;
  std::size_t collapses_in_cells = 0; ///< of `collapses`
  double seconds_cells = 0;           ///< of `seconds_reduce`: until all cells were done and joined
  double seconds_index = 0;           ///< for building the index
  double seconds_reduce = 0;          ///< in all, the index included

  /// What was refused in the last pass alone, when everything still possible was tried once more.
  Refusals refused_in_last_pass;

  bool is_reached() const { return faces_to_go == 0; }

  /// "reached", "stopped", or the rule that refused most in the last pass.
  std::string outcome() const
  {
    if (is_reached())
      return "reached";
    if (is_stopped)
      return "stopped";
    const auto rules = Refusals::rules();
    const auto most = std::max_element(rules.begin(), rules.end(), [&](const auto& a, const auto& b) {
      return refused_in_last_pass.*a.count < refused_in_last_pass.*b.count;
    });
    return refused_in_last_pass.*most->count > 0 ? most->key : "topology";
  }
};

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_REPORT_H
