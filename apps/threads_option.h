// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_THREADS_OPTION_H
#define SELVEDGE_APPS_THREADS_OPTION_H

#include <CLI/CLI.hpp>

#include <cstddef>
#include <optional>

namespace selvedge::app {

/// Declares the option --threads, which sets `count`, for a `Thread_limit`.
inline CLI::Option* add_threads_option(CLI::App& command, std::optional<std::size_t>& count)
{
  return command.add_option("--threads", count, "Number of threads. The result does not depend on it.")
      ->check(CLI::Range(std::size_t(1), std::size_t(1024)).description(""))
      ->default_str("all cores")
      ->type_name("N");
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_THREADS_OPTION_H
