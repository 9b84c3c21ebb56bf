// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_THREADS_H
#define SELVEDGE_APPS_THREADS_H

#include "subcommands.h"

#include <oneapi/tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace selvedge::app {

/// Limits the number of threads, the main one included, to that of `--threads` as long as it lives. Without
/// the option all cores are used.
class Thread_limit
{
public:
  explicit Thread_limit(std::optional<std::size_t> count)
  {
    if (count)
      m_limit.emplace(tbb::global_control::max_allowed_parallelism, *count);
  }

  static CLI::Option* add_option(CLI::App& command, std::optional<std::size_t>& count)
  {
    return command.add_option("--threads", count, "Number of threads. The result does not depend on it.")
        ->check(CLI::Range(std::size_t(1), std::size_t(1024)).description(""))
        ->default_str("all cores")
        ->type_name("N");
  }

private:
  std::optional<tbb::global_control> m_limit;
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_THREADS_H
