// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_DISJOINT_SETS_H
#define SELVEDGE_SRC_SOUP_DISJOINT_SETS_H

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <vector>

namespace selvedge::internal {

/// A partition of the numbers below `size` into sets that can be united (union-find). A set is named by its
/// smallest number.
class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t size) : m_parent(size)
  {
    std::iota(m_parent.begin(), m_parent.end(), std::size_t(0));
  }

  std::size_t find(std::size_t element)
  {
    while (m_parent[element] != element)
      element = m_parent[element] = m_parent[m_parent[element]];
    return element;
  }

  void unite(std::size_t a, std::size_t b)
  {
    std::tie(a, b) = std::minmax({find(a), find(b)});
    m_parent[b] = a;
  }

private:
  std::vector<std::size_t> m_parent;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_SOUP_DISJOINT_SETS_H
