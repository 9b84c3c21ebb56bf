// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_RANDOM_H
#define SELVEDGE_TEST_WORLDS_RANDOM_H

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

namespace selvedge::test {

/// Numbers that are the same with every standard library.
class Random
{
public:
  explicit Random(std::uint64_t seed) : m_engine(seed) {}

  std::uint64_t number() { return m_engine(); }

  /// From 0 to count − 1.
  std::size_t below(std::size_t count) { return std::size_t(m_engine() % count); }

  /// Both included.
  int between(int low, int high) { return low + int(below(std::size_t(high - low + 1))); }

  bool one_in(std::size_t count) { return below(count) == 0; }

  /// From 0 to 1, the latter excluded.
  double share() { return double(m_engine() >> 11) * 0x1p-53; }

  template <class Value>
  Value one_of(std::initializer_list<Value> values)
  {
    return values.begin()[below(values.size())];
  }

  template <class Value>
  const Value& one_of(const std::vector<Value>& values)
  {
    return values[below(values.size())];
  }

private:
  std::mt19937_64 m_engine;
};

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_RANDOM_H
