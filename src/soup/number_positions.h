// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_NUMBER_POSITIONS_H
#define SELVEDGE_SOUP_NUMBER_POSITIONS_H

#include <selvedge/Triangle_soup.h>

#include <vector>

namespace selvedge {

/// Returns for every vertex the number of the first vertex with equal coordinates (−0 is 0), as the number of
/// its position.
std::vector<Index> number_positions(const std::vector<Point_3>& points);

/// Returns triangles with the position of each corner in place of its vertex.
std::vector<Index_triple> in_positions(std::vector<Index_triple> triangles,
                                       const std::vector<Index>& positions);

/// The triangles of a soup that are no doubles: their numbers, and the positions of their corners.
struct Fronts
{
  std::vector<Index> numbers;
  std::vector<Index_triple> triangles;
};

/// Returns the triangles that are no doubles. `fronts` is that of `Prepared_soup`, empty when none is one.
Fronts fronts_in_positions(const std::vector<Index_triple>& triangles, const std::vector<Index>& positions,
                           const std::vector<Index>& fronts);

} // namespace selvedge

#endif // SELVEDGE_SOUP_NUMBER_POSITIONS_H
