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

namespace this_task_arena {

/// A thread that waits here takes up no other work in any case.
template <class Function>
auto isolate(const Function& function)
{
  return function();
}

} // namespace this_task_arena
} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_TASK_ARENA_H
