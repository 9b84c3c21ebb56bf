// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_WELD_OPEN_SEAMS_H
#define SELVEDGE_WELD_OPEN_SEAMS_H

#include "Border_sites.h"
#include <selvedge/Border_gaps.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Scale.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge {

/// What is left open within a distance: partners that are each the nearest of the other, frozen or not
/// (`Prepared_soup::tied`), and the positions in no such pair that are within the distance of an edge of
/// another border at which the surface continues (`Prepared_soup::facing`). Nothing counts between two pieces
/// that both have no position inside.
struct Gaps_left
{
  std::vector<std::pair<Index, Index>> tied;
  std::vector<Index> facing;
};

/// The gaps between borders, and what is open within the clear length, if there is one.
struct Open_borders
{
  Border_gaps gaps;
  Gaps_left left;
};

/// Finds, for every vertex on a border, the least distance within which it has a partner, as `snap_borders`
/// defines partners, as far as that is at most the median length of border edges; which length is clear; and
/// what is open within it, if `is_left_listed`. Nothing is moved. (A vertex may cease to have a partner
/// within larger distances, because then a short stretch of border joins the two.) Vertices under different
/// transforms are no partners. Frozen ones may be.
///
/// **Preconditions** and other parameters as for `snap_borders`. **Exactness** Distances are rounded to
/// double. **Complexity** O(n log n) for n triangles, and as many steps as there are pairs of border vertices
/// within twice the lengths found.
Open_borders find_open_seams(const Triangle_soup& soup, const std::vector<Index>& positions,
                             const std::vector<Index>& transforms = {}, std::size_t obstacle_triangles = 0,
                             const Scale& scale = Scale(), bool is_left_listed = true);

/// Returns what is open within the distance of partners.
Gaps_left gaps_left(internal::Border_sites borders);

} // namespace selvedge

#endif // SELVEDGE_WELD_OPEN_SEAMS_H
