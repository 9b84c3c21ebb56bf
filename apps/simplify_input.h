// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_SIMPLIFY_INPUT_H
#define SELVEDGE_APPS_SIMPLIFY_INPUT_H

#include "Progress_bar.h"
#include "Simplify_request.h"
#include "report_json.h"

#include <selvedge/collapse_log.h>
#include <selvedge/simplify.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::app {

/// What `selvedge simplify` reduces: its input, without what is left out, prepared.
struct Simplify_input
{
  Prepared_soup prepared;
  Json report;                            ///< what the report says of the file
  std::vector<std::string> references;    ///< to other files, as they are named from the output's folder
  std::size_t polygons = 0;               ///< faces of more than three corners that may be written
  double seconds = 0;                     ///< that reading the mesh took
  std::optional<Log_numbering> numbering; ///< used only when a log is written, as is the next
  Log_header log_header;
};

/// Reads and prepares the input of a request, with its poses and its obstacle, and refuses outputs that do
/// not fit it. Says on the error stream what in it is doubtful.
///
/// @throws Argument_error  options or outputs do not fit the input
/// @throws Input_error     the input cannot be read, or not be reduced
Simplify_input read_input(const Simplify_request& request, Progress_bar& bar);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_SIMPLIFY_INPUT_H
