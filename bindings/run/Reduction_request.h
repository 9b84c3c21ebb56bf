// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BINDINGS_RUN_REDUCTION_REQUEST_H
#define SELVEDGE_BINDINGS_RUN_REDUCTION_REQUEST_H

#include <selvedge/drop_parts.h>
#include <selvedge/simplify.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::bindings {

/// What a caller in another language asks of a reduction. Its options have the names that they have in the
/// reports of the program (docs/report.md), and the values that the program takes, as text.
struct Reduction_request
{
  Reduction_request();

  /// Sets one option. Throws `Argument_error` when there is no such option, with a message that names the
  /// nearest, and when the value is not one that it takes.
  ///
  /// One more option is "log": whether a log is wanted. The parts of `lock`, `keep` and `drop_part` and the
  /// ratios of `part_ratios` ("PART=R") and `lods` ("R,R") are added to those set before.
  void set(const std::string& name, const std::string& value);

  /// Refuses what does not fit together. Throws `Argument_error`.
  void check() const;

  /// Returns whether nothing says how far to reduce the whole mesh.
  bool is_without_target() const
  {
    return !options.ratio && !options.faces && !is_error_given && lods.empty();
  }

  /// Returns the options for a reduction. Where only parts have ratios, all else has the ratio 1.
  Simplify_options complete_options() const;

  /// Returns the options for preparing the mesh. Unless the caller says what becomes of open seams, CGAL's
  /// loop does not hold them, which it cannot.
  Prepare_options complete_prepare_options() const;

  /// Returns all options with their values, as a JSON object like `options` in the program's reports.
  std::string json() const;

  Simplify_options options;
  Simplify_intent intent;
  Prepare_options prepare;
  std::vector<double> lods; ///< ratios of levels of detail, in the order of the results
  Triangle_soup obstacle;
  std::vector<std::string> may_intersect; ///< "PART:PART", with names of parts of the mesh
  Parts_to_drop dropped_parts;
  bool is_sewn = false;
  bool is_log_wanted = false;
  bool is_error_given = false; ///< whether `options.max_error` is what the caller said, and no default
  bool is_error_everywhere = false;
  bool is_weld_given = false;
  bool is_border_turn_given = false;
  bool are_key_poses_chosen = false; ///< whether collapses are judged in some of the further poses at first
  std::optional<std::size_t> threads;
};

/// Returns the names of all options, in the order of the program's reports.
std::vector<std::string> option_names();

/// Returns that of `names` which is most like `name`: the one with the fewest letters to change.
std::string nearest(const std::string& name, const std::vector<std::string>& names);

} // namespace selvedge::bindings

#endif // SELVEDGE_BINDINGS_RUN_REDUCTION_REQUEST_H
