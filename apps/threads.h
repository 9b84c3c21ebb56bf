// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_THREADS_H
#define SELVEDGE_APPS_THREADS_H

#include "subcommands.h"

#include <oneapi/tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace selvedge::app {

/// How many threads may work, the main one included: as many as `--threads` says while this lives, all cores
/// without.
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
    return command.add_option("--threads", count, "Threads to use; the result does not depend on them")
        ->check(CLI::Range(std::size_t(1), std::size_t(1024)).description(""))
        ->default_str("all cores")
        ->type_name("N");
  }

private:
  std::optional<tbb::global_control> m_limit;
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_THREADS_H
