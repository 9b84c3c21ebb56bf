// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_FIT_TEXTURE_H
#define SELVEDGE_SRC_SOUP_FIT_TEXTURE_H

#include "Fitted_surface.h"

#include <selvedge/Triangle_soup.h>

#include <array>
#include <functional>
#include <vector>

namespace selvedge {

/// Finds, for vertices of a result, the texture coordinates with which its texture lies most like that of the
/// original: those that, interpolated over each triangle, are nearest to those of the original there, in the
/// sense of least squares. What a vertex has from the surface at its own place is right there alone; on large
/// triangles, the texture between vertices is displaced. Vertices that are `free` have one texture coordinate
/// each, all others keep theirs. `stored(v, uv)` returns what becomes of the coordinates of vertex v when
/// they are stored.
///
/// The original is sampled in the middle of every triangle. A sample counts for the triangle of the result
/// that is nearest, of those of the same chart (what is connected by edges at which the texture goes on) that
/// face the same side, unless it is off there by more than that triangle is large in the texture, as beyond a
/// cut. No triangle of the texture turns over or loses its area, decided exactly, and no coordinate leaves
/// the range of those of the original: a vertex goes a part of the way then, or stays.
///
/// Returns the coordinates by vertex; those of a vertex that is not free are not set.
///
/// **Complexity** O(n log n) as a rule for n triangles of the original. Computed in double.
std::vector<std::array<double, 2>>
fitted_texture(const Fitted_surface& surface, const std::vector<char>& is_free,
               const std::function<std::array<double, 2>(Index, const std::array<double, 2>&)>& stored);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_FIT_TEXTURE_H
