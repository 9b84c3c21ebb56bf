// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_PART_PAIRS_H
#define SELVEDGE_APPS_PART_PAIRS_H

#include <selvedge/Triangle_soup.h>

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace selvedge::app {

/// Declares the option --may-intersect, which sets `texts`.
CLI::Option* add_part_pairs_option(CLI::App& command, std::vector<std::string>& texts,
                                   const char* description);

/// Returns the names of the two parts in each of some texts of the form A:B (`parts_in_pair`). Errors begin
/// with the name of the option.
std::vector<std::pair<std::string, std::string>> part_pairs(const std::vector<std::string>& texts,
                                                            const Triangle_soup& soup);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_PART_PAIRS_H
