// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_COMPLETION_H
#define SELVEDGE_APPS_COMPLETION_H

#include <CLI/CLI.hpp>

#include <string>

namespace selvedge::app {

/// Returns a script by which a shell completes the subcommands of a program, their options, and the words
/// that an option takes. Everything else is completed as the name of a file.
///
/// @param shell  bash, zsh or fish
///
/// @throws Argument_error  it is another shell
std::string completion(const CLI::App& program, const std::string& shell);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_COMPLETION_H
