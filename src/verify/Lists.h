// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_LISTS_H
#define SELVEDGE_SRC_VERIFY_LISTS_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge::internal {

using Pair = std::pair<Index, Index>;

/// Holds a list of numbers for each key, sorted and without duplicates, in two flat arrays. The judge keeps
/// in it, for example, the triangles of each piece.
class Lists
{
public:
  class Range
  {
  public:
    Range(const Index* first, const Index* beyond) : m_first(first), m_beyond(beyond) {}
    const Index* begin() const { return m_first; }
    const Index* end() const { return m_beyond; }
    std::size_t size() const { return std::size_t(m_beyond - m_first); }

  private:
    const Index *m_first, *m_beyond;
  };

  Lists() = default;

  /// Takes pairs of a key, which is below `keys`, and a number, in any order and with repetitions.
  Lists(std::size_t keys, std::vector<Pair> pairs) : m_first(keys + 1)
  {
    Cancellation_scope::check();
    std::sort(pairs.begin(), pairs.end());
    Cancellation_scope::check();
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    m_numbers.reserve(pairs.size());
    for (const auto& [key, number] : pairs) {
      ++m_first[key + 1];
      m_numbers.push_back(number);
    }
    for (std::size_t key = 0; key < keys; ++key)
      m_first[key + 1] += m_first[key];
  }

  Range operator[](std::size_t key) const
  {
    return {m_numbers.data() + m_first[key], m_numbers.data() + m_first[key + 1]};
  }

private:
  std::vector<std::size_t> m_first;
  std::vector<Index> m_numbers;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_LISTS_H
