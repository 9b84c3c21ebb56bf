// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_TASK_ARENA_H
#define SELVEDGE_TEST_THREADS_TASK_ARENA_H

namespace tbb {

/// As many threads as there are may work in it.
class task_arena
{
public:
  explicit task_arena(int /*threads*/) {}

  template <class Function>
  auto execute(const Function& function)
  {
    return function();
  }
};

} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_TASK_ARENA_H
