// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_FIT_ATTRIBUTES_H
#define SELVEDGE_SRC_SOUP_FIT_ATTRIBUTES_H

#include "Fitted_surface.h"
#include "Vertex_values.h"

#include <selvedge/Triangle_soup.h>

#include <vector>

namespace selvedge {

/// Finds, for vertices of a result, the colours and other numbers (`Vertex_values::fitted_components`) with
/// which its surface looks most like that of the original: those that, interpolated over each triangle, are
/// nearest to those of the original there, in the sense of least squares. Vertices that are not `free` keep
/// theirs. `values` are of the original.
///
/// The original is sampled as for its texture (fit_texture.h). Charts end at edges at whose ends vertices on
/// the two sides have different numbers. No number leaves the range of what it was and those that the
/// original has around the vertex, so that none goes beyond a jump.
///
/// Returns, for each component, what each vertex then stores; NaN where that stays as it is.
///
/// **Complexity** O(n log n) as a rule for n triangles of the original. Computed in double.
std::vector<std::vector<double>> fitted_attributes(const Fitted_surface& surface, const Vertex_values& values,
                                                   const std::vector<char>& is_free);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_FIT_ATTRIBUTES_H
