// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_THREADS_ENUMERABLE_THREAD_SPECIFIC_H
#define SELVEDGE_TEST_THREADS_ENUMERABLE_THREAD_SPECIFIC_H

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>

namespace tbb {

template <class Value>
class enumerable_thread_specific
{
  using Values = std::map<std::size_t, Value>;

public:
  class iterator
  {
  public:
    explicit iterator(typename Values::iterator at) : m_at(at) {}
    Value& operator*() const { return m_at->second; }
    iterator& operator++()
    {
      ++m_at;
      return *this;
    }
    bool operator!=(const iterator& other) const { return m_at != other.m_at; }

  private:
    typename Values::iterator m_at;
  };

  Value& local()
  {
    // Not its id, which another may have when it is gone.
    static std::atomic<std::size_t> s_threads = 0;
    static thread_local const std::size_t number = s_threads.fetch_add(1, std::memory_order_relaxed);
    const std::lock_guard lock(m_mutex);
    return m_values[number];
  }
  iterator begin() { return iterator(m_values.begin()); }
  iterator end() { return iterator(m_values.end()); }

private:
  std::mutex m_mutex;
  Values m_values;
};

} // namespace tbb

#endif // SELVEDGE_TEST_THREADS_ENUMERABLE_THREAD_SPECIFIC_H
