// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_RUN_IN_THREADS_H
#define SELVEDGE_TEST_THREADS_RUN_IN_THREADS_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

/// \file
/// What the project uses of oneTBB, made of `std::thread`. The thread sanitizer does not see how the real one
/// hands work from thread to thread, since that is compiled without it, and takes every hand-over for a race.
/// These few headers come first in the preset `threads`; of all that runs at once there, it sees every access
/// and every lock.
///
/// No more is ordered than oneTBB orders: what one task did, another sees only when it was begun afterwards
/// by the one that waited for the first.
namespace tbb::selvedge_test {

/// How many threads may run; set by `global_control`.
inline std::atomic<std::size_t> s_most_threads = 4;

/// Those that run beside the first.
inline std::atomic<std::size_t> s_further_threads = 0;

/// Calls `function(i)` for all i < count, in several threads as long as there are any. The first exception
/// comes out when all that was begun has ended.
template <class Function>
void run_in_threads(std::size_t count, const Function& function)
{
  // Relaxed, so that taking numbers orders nothing.
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr first_error;
  const auto work = [&] {
    for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;)
      try {
        function(i);
      } catch (...) {
        next.store(count, std::memory_order_relaxed);
        const std::lock_guard lock(mutex);
        if (!first_error)
          first_error = std::current_exception();
      }
  };
  std::vector<std::thread> threads;
  while (threads.size() + 1 < count) {
    if (s_further_threads.fetch_add(1, std::memory_order_relaxed) + 1 >= s_most_threads.load()) {
      s_further_threads.fetch_sub(1, std::memory_order_relaxed);
      break;
    }
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads) {
    thread.join();
    s_further_threads.fetch_sub(1, std::memory_order_relaxed);
  }
  if (first_error)
    std::rethrow_exception(first_error);
}

} // namespace tbb::selvedge_test

#endif // SELVEDGE_TEST_THREADS_RUN_IN_THREADS_H
