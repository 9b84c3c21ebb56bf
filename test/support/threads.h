// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_THREADS_H
#define SELVEDGE_TEST_SUPPORT_THREADS_H

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

namespace selvedge::test {

/// What `function` returns where oneTBB grants it so many threads, whatever the machine has.
template <class Function>
auto with_threads(std::size_t count, const Function& function)
{
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
  return tbb::task_arena(static_cast<int>(count)).execute(function);
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_THREADS_H
