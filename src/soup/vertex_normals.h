// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_VERTEX_NORMALS_H
#define SELVEDGE_SOUP_VERTEX_NORMALS_H

#include <selvedge/Triangle_soup.h>

#include <array>
#include <vector>

namespace selvedge {

/// Normals by vertex of a soup, of length 1, or 0 where there is none.
using Vertex_normals = std::vector<std::array<double, 3>>;

/// Returns the normals with which viewers shade a mesh that has none: for each vertex the mean of those of
/// the triangles at its position, weighted by the chords of the angles there (by the angles: Thürmer and
/// Wüthrich 1998), without hard edges. `positions`, `is_turned` and `fronts` are those of `Prepared_soup`:
/// turned triangles count as they were turned, and doubles do not count.
///
/// **Complexity** Linear. Computed in double; no decision about intersections depends on it.
Vertex_normals vertex_normals(const Triangle_soup& soup, const std::vector<Index>& positions,
                              const std::vector<char>& is_turned, const std::vector<Index>& fronts);

} // namespace selvedge

#endif // SELVEDGE_SOUP_VERTEX_NORMALS_H
