// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_REGIONS_H
#define SELVEDGE_SOUP_REGIONS_H

#include <selvedge/Triangle_soup.h>

#include <vector>

namespace selvedge {

/// Returns the attributes of triangles that tell *regions* apart, such as the number of a material or a
/// painted colour: they differ across some edges, and across at most one in sixteen. Triangles with the same
/// three positions are one face here, and edges count at which exactly two faces meet. `positions` has a
/// number for every vertex of the soup. A program that simplifies in several poses, or replays that, takes
/// the positions of the first pose.
///
/// **Complexity** O(n log n) for n triangles.
std::vector<const Attribute*> attributes_of_regions(const Triangle_soup& soup,
                                                    const std::vector<Index>& positions);

} // namespace selvedge

#endif // SELVEDGE_SOUP_REGIONS_H
