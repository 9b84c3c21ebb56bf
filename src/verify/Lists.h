// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_LISTS_H
#define SELVEDGE_SRC_VERIFY_LISTS_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Triangle_soup.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
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

  /// Takes pairs of a key, which is below `keys`, and a number, in any order and with repetitions. Linear in
  /// time where the numbers of each key come in ascending order.
  Lists(std::size_t keys, const std::vector<Pair>& pairs) : m_first(keys + 1), m_numbers(pairs.size())
  {
    Cancellation_scope::check();
    for (const auto& [key, number] : pairs)
      ++m_first[key + 1];
    std::partial_sum(m_first.begin(), m_first.end(), m_first.begin());
    std::vector<std::size_t> places = m_first;
    for (const auto& [key, number] : pairs)
      m_numbers[places[key]++] = number;
    Cancellation_scope::check();
    auto kept = m_numbers.begin();
    for (std::size_t key = 0; key < keys; ++key) {
      const auto first = m_numbers.begin() + std::ptrdiff_t(m_first[key]),
                 beyond = m_numbers.begin() + std::ptrdiff_t(places[key]);
      if (!std::is_sorted(first, beyond))
        std::sort(first, beyond);
      const auto first_kept = kept;
      for (auto number = first; number != beyond; ++number)
        if (kept == first_kept || kept[-1] != *number)
          *kept++ = *number;
      m_first[key] = std::size_t(first_kept - m_numbers.begin());
    }
    m_numbers.erase(kept, m_numbers.end());
    m_first[keys] = m_numbers.size();
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
