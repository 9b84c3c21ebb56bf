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

} // namespace selvedge

#endif // SELVEDGE_SOUP_NUMBER_POSITIONS_H
