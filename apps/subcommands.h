// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_SUBCOMMANDS_H
#define SELVEDGE_APPS_SUBCOMMANDS_H

#include "exit_codes.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <limits>

namespace selvedge::app {

/// What a subcommand does once its options are read.
using Action = std::function<Exit_code()>;

/// Each declares the options of its subcommand and returns what carries it out.
Action add_simplify(CLI::App& command);
Action add_verify(CLI::App& command);
Action add_replay(CLI::App& command);
Action add_generate(CLI::App& command);

/// Accepts a number in [least, most]; unlike CLI::Range no NaN.
inline CLI::Validator in_range(double least, double most = std::numeric_limits<double>::infinity())
{
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most)
          return {};
        const std::string range =
            most == std::numeric_limits<double>::infinity()
                ? "at least " + CLI::detail::to_string(least)
                : "from " + CLI::detail::to_string(least) + " to " + CLI::detail::to_string(most);
        return "'" + text + "' is not a number " + range;
      },
      "");
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_SUBCOMMANDS_H
