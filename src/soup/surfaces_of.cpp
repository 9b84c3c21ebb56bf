// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surfaces_of.h"

#include "Disjoint_sets.h"
#include "number_positions.h"

namespace selvedge {

std::vector<std::size_t> surfaces_of(const Triangle_soup& soup)
{
  const std::vector<Index> positions = number_positions(soup.points);
  internal::Disjoint_sets sets(soup.points.size());
  for (const auto& [a, b, c] : soup.triangles) {
    sets.unite(positions[a], positions[b]);
    sets.unite(positions[b], positions[c]);
  }
  std::vector<std::size_t> result;
  result.reserve(soup.triangles.size());
  for (const Index_triple& triangle : soup.triangles)
    result.push_back(sets.find(positions[triangle[0]]));
  return result;
}

} // namespace selvedge
