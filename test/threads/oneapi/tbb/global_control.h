// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_GLOBAL_CONTROL_H
#define SELVEDGE_TEST_THREADS_GLOBAL_CONTROL_H

#include "../../run_in_threads.h"

namespace tbb {

class global_control
{
public:
  enum parameter { max_allowed_parallelism };

  global_control(parameter, std::size_t threads) : m_before(selvedge_test::s_most_threads.exchange(threads))
  {
  }
  ~global_control() { selvedge_test::s_most_threads = m_before; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;

private:
  std::size_t m_before;
};

} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_GLOBAL_CONTROL_H
