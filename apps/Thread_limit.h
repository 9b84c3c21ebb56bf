// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_THREAD_LIMIT_H
#define SELVEDGE_APPS_THREAD_LIMIT_H

#include <oneapi/tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace selvedge::app {

/// Limits the number of threads, the main one included, as long as it lives. Without a number all cores are
/// used.
class Thread_limit
{
public:
  explicit Thread_limit(std::optional<std::size_t> count)
  {
    if (count)
      m_limit.emplace(tbb::global_control::max_allowed_parallelism, *count);
  }

private:
  std::optional<tbb::global_control> m_limit;
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_THREAD_LIMIT_H
