// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "clearance.h"

#include "soup/Disjoint_sets.h"
#include "verify/triangle_distance.h"

#include <algorithm>
#include <optional>

namespace selvedge::reference {

std::vector<Index> pieces_of(const Complex& complex)
{
  Index size = 0;
  for (Index f = 0; f < complex.size(); ++f)
    for (const Index position : complex.face(f).positions)
      size = std::max(size, position + 1);
  internal::Disjoint_sets connected(size);
  for (Index f = 0; f < complex.size(); ++f)
    for (const Index position : complex.face(f).positions)
      connected.unite(complex.face(f).positions[0], position);
  std::vector<Index> pieces;
  for (Index position = 0; position < size; ++position)
    pieces.push_back(Index(connected.find(position)));
  return pieces;
}

bool is_clearance_kept(const Clearance_question& question, const Corners& standing)
{
  const Bounds limit = internal::square_bounds(question.distance);
  std::optional<Bounds> least; // of the limit and the squared distances of the star
  std::vector<Bounds> of_star;
  std::optional<internal::Exact_square> exact_least;
  for (const Corners& facet : question.facets) {
    const Bounds squared = internal::squared_distance_bounds(facet, standing);
    if (squared.lower >= limit.upper)
      continue;
    if (!least) {
      least = limit;
      for (const Corners& face : question.star) {
        of_star.push_back(internal::squared_distance_bounds(face, standing));
        least->lower = std::min(least->lower, of_star.back().lower);
        least->upper = std::min(least->upper, of_star.back().upper);
      }
    }
    if (squared.lower >= least->upper)
      continue;
    if (squared.upper < least->lower)
      return false;
    if (!exact_least) {
      exact_least = internal::exact_square(question.distance);
      for (std::size_t i = 0; i < of_star.size(); ++i)
        if (of_star[i].lower <= least->upper)
          exact_least = std::min(*exact_least, internal::exact_squared_distance(question.star[i], standing));
    }
    if (internal::exact_squared_distance(facet, standing) < *exact_least)
      return false;
  }
  return true;
}

} // namespace selvedge::reference
