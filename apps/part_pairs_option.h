// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_PART_PAIRS_OPTION_H
#define SELVEDGE_APPS_PART_PAIRS_OPTION_H

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace selvedge::app {

/// Declares the option --may-intersect, which sets `texts`.
inline CLI::Option* add_part_pairs_option(CLI::App& command, std::vector<std::string>& texts,
                                          const char* description)
{
  return command.add_option("--may-intersect", texts, description)
      ->type_name("PART:PART")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_PART_PAIRS_OPTION_H
