// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_REPORT_OUTPUT_H
#define SELVEDGE_APPS_REPORT_OUTPUT_H

#include "report_json.h"
#include "standard_streams.h"
#include "subcommands.h"

#include <selvedge/mesh_files.h>

#include <iostream>

// The report of a subcommand that judges or describes: in a file beside the text, or in place of the text.

namespace selvedge::app {

/// Adds `--report` and `--json`, of which one alone may be given. A request has the members `report`, a file
/// name or empty, and `is_json`.
template <class Request>
void add_report_options(CLI::App& command, Request& request)
{
  CLI::Option* const report =
      command.add_option("--report", request.report, "Write a JSON report, and print the text all the same.")
          ->type_name("FILE");
  command.add_flag("--json", request.is_json, "Print the JSON report instead of the text.")->excludes(report);
}

/// Prints the report, or calls `print_text` to print the text; then writes the file that is asked for.
template <class Request, class Print_text>
void put_report(const Request& request, const Json& report, const Print_text& print_text)
{
  if (request.is_json) {
    std::cout << to_text(report) << std::flush;
  } else {
    const Text_to_standard_error elsewhere(is_standard_output(request.report));
    print_text();
  }
  if (!request.report.empty())
    write_file(output_path(request.report), to_text(report));
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_REPORT_OUTPUT_H
