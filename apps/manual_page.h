// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_MANUAL_PAGE_H
#define SELVEDGE_APPS_MANUAL_PAGE_H

#include <CLI/CLI.hpp>

#include <string>

namespace selvedge::app {

/// Returns the manual page of a program, in the man macros of troff: what `--help` says of it and of its
/// subcommands.
std::string manual_page(const CLI::App& program);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_MANUAL_PAGE_H
