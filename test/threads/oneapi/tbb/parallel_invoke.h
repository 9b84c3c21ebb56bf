// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_PARALLEL_INVOKE_H
#define SELVEDGE_TEST_THREADS_PARALLEL_INVOKE_H

#include "../../run_in_threads.h"

#include <array>
#include <functional>

namespace tbb {

template <class... Functions>
void parallel_invoke(const Functions&... functions)
{
  const std::array<std::function<void()>, sizeof...(functions)> tasks{std::cref(functions)...};
  selvedge_test::run_in_threads(tasks.size(), [&](std::size_t i) { tasks[i](); });
}

} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_PARALLEL_INVOKE_H
