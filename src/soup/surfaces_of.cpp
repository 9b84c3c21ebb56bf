// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surfaces_of.h"

#include "Disjoint_sets.h"
#include "number_positions.h"

namespace selvedge {

std::vector<std::size_t> surfaces_of(const Triangle_soup& soup)
{
  return surfaces_of(soup.triangles, number_positions(soup.points));
}

std::vector<std::size_t> surfaces_of(const std::vector<Index_triple>& triangles,
                                     const std::vector<Index>& positions)
{
  internal::Disjoint_sets sets(positions.size());
  for (const auto& [a, b, c] : triangles) {
    sets.unite(positions[a], positions[b]);
    sets.unite(positions[b], positions[c]);
  }
  std::vector<std::size_t> result;
  result.reserve(triangles.size());
  for (const Index_triple& triangle : triangles)
    result.push_back(sets.find(positions[triangle[0]]));
  return result;
}

} // namespace selvedge
