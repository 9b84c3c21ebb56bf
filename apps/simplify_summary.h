// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_SIMPLIFY_SUMMARY_H
#define SELVEDGE_APPS_SIMPLIFY_SUMMARY_H

#include "Outcome.h"
#include "Simplify_request.h"

#include <selvedge/Error_search.h>
#include <selvedge/compare.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>
#include <selvedge/verify.h>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::app {

/// One level of detail: its result, its output file, and the verdict of the judge.
struct Level
{
  std::string output;
  Simplified_soup result;
  Verification verification;
  std::optional<Distances_anywhere> distances_anywhere; ///< where the user has set a limit
  std::vector<std::size_t> guarded_poses; ///< numbers of the further poses in which collapses were judged

  /// Faces of more than three corners, in the input and in the file.
  struct Polygons
  {
    std::size_t input = 0, output = 0;
  } polygons;

  std::size_t number = 0; ///< among the levels in the file, from 1; 0 where it is alone there

  std::optional<Error_search> error_search; ///< where the limit is to be kept everywhere
  Write_notes notes;                        ///< on the file, where it is alone there
  std::uintmax_t bytes_more = 0;            ///< than the input has, where this is of the same format
  double seconds = 0;                       ///< of its reductions, also of those that this one replaces
};

/// Says in a sentence that the file is larger than the input, and why; empty where it is not.
std::string enlargement(const Simplify_request& request, const Level& level);

/// Returns the name of the file, and which of its levels this is where it holds several.
std::string name_of(const Level& level);

/// Prints to `stream` what was read and prepared. `diagonal` is that of the bounding box; `notes` are those
/// of the report about the file; `dropped` is what the output's format cannot hold; `references` are the
/// names of other files that have been changed.
void print_input(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                 double diagonal, const Json& notes, const std::vector<std::string>& dropped,
                 const std::vector<std::string>& references);

/// Prints to `stream` what the reduction and the judge say of a level. Where it has the mesh of the one
/// `before`, if there is one, all has been said.
void print_summary(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                   const Level& level, const Outcome& outcome, const Level* before = nullptr);

/// Returns what the user must be told of a level on the error stream; empty when all went well.
std::string complaint(const Simplify_request& request, const Level& level, const Outcome& outcome);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_SIMPLIFY_SUMMARY_H
