// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_SURFACES_OF_H
#define SELVEDGE_SRC_SOUP_SURFACES_OF_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// Returns, for each triangle, the number of its surface: triangles connected by positions, which files part
/// into pieces at seams. It is the number of a vertex, and smaller for a surface that has an earlier one.
///
/// **Complexity** O(n log n).
std::vector<std::size_t> surfaces_of(const Triangle_soup& soup);

/// Likewise, where the positions of the vertices (`number_positions`) are known.
std::vector<std::size_t> surfaces_of(const std::vector<Index_triple>& triangles,
                                     const std::vector<Index>& positions);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_SURFACES_OF_H
