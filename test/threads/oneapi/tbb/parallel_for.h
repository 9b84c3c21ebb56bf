// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_PARALLEL_FOR_H
#define SELVEDGE_TEST_THREADS_PARALLEL_FOR_H

#include "blocked_range.h"
#include "partitioner.h"

#include "../../run_in_threads.h"

namespace tbb {

template <class Index, class Function>
void parallel_for(Index first, Index beyond, const Function& function, simple_partitioner = {})
{
  selvedge_test::run_in_threads(beyond > first ? std::size_t(beyond - first) : 0,
                                [&](std::size_t i) { function(Index(first + Index(i))); });
}

template <class Value, class Function>
void parallel_for(const blocked_range<Value>& range, const Function& function)
{
  const std::size_t size = range.end() - range.begin(), grain = range.grainsize();
  selvedge_test::run_in_threads((size + grain - 1) / grain, [&](std::size_t i) {
    function(blocked_range<Value>(range.begin() + i * grain,
                                  range.begin() + (std::min)(size, (i + 1) * grain), grain));
  });
}

} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_PARALLEL_FOR_H
