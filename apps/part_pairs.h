// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_PART_PAIRS_H
#define SELVEDGE_APPS_PART_PAIRS_H

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace selvedge::app {

/// Declares the option --may-intersect, which sets `texts`.
CLI::Option* add_part_pairs_option(CLI::App& command, std::vector<std::string>& texts,
                                   const char* description);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_PART_PAIRS_H
