// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_BLOCKED_RANGE_H
#define SELVEDGE_TEST_THREADS_BLOCKED_RANGE_H

#include <cstddef>

namespace tbb {

template <class Value>
class blocked_range
{
public:
  blocked_range(Value begin, Value end, std::size_t grain_size = 1)
      : m_begin(begin), m_end(end), m_grain_size(grain_size)
  {
  }

  Value begin() const { return m_begin; }
  Value end() const { return m_end; }
  std::size_t grainsize() const { return m_grain_size; }

private:
  Value m_begin, m_end;
  std::size_t m_grain_size;
};

} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_BLOCKED_RANGE_H
