// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_SORTED_BY_H
#define SELVEDGE_SRC_SOUP_SORTED_BY_H

#include <cstddef>
#include <numeric>
#include <vector>

namespace selvedge::internal {

/// Returns items in ascending order of `key_of(item)`, numbers below `keys`. Items with the same key keep
/// their order, so that one call by a second number and then one by a first sort by both.
///
/// **Complexity** Linear in the numbers of items and keys.
template <class Item, class Key_of>
std::vector<Item> sorted_by(const std::vector<Item>& items, std::size_t keys, const Key_of& key_of)
{
  std::vector<std::size_t> places(keys + 1, 0);
  for (const Item& item : items)
    ++places[std::size_t(key_of(item)) + 1];
  std::partial_sum(places.begin(), places.end(), places.begin());
  std::vector<Item> sorted(items.size());
  for (const Item& item : items)
    sorted[places[key_of(item)]++] = item;
  return sorted;
}

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_SOUP_SORTED_BY_H
