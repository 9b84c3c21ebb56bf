// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_AUTOMATIC_CELLS_H
#define SELVEDGE_AUTOMATIC_CELLS_H

/// \file
/// Decides whether a mesh is reduced in cells where the user has not said it.

#include <selvedge/Simplify_options.h>
#include <selvedge/prepare.h>
#include <selvedge/simplify.h>

#include <cstddef>
#include <optional>

namespace selvedge {

/// Returns the `Simplify_options::faces_per_cell` with which the program and the bindings call
/// `simplify_soup`: 50,000 for a reduction in cells, or 0.
///
/// `is_in_cells` is what the user asks for. Without it, soups of at least 500,000 triangles are reduced in
/// cells, unless `options`, `intent` or `prepared` have what cells exclude, or a progression is recorded,
/// whose levels are to be those of a reduction to their number of faces. Smaller soups are done soon, and
/// cells would only take a little of the order of their collapses.
inline std::size_t faces_per_cell_for(const Prepared_soup& prepared, const Simplify_options& options,
                                      const Simplify_intent& intent, std::optional<bool> is_in_cells)
{
  // Large enough that few vertices lie on cell walls, small enough that a cell stays in a processor's cache.
  constexpr std::size_t faces_per_cell = 50'000;
  constexpr std::size_t faces_for_cells = 500'000;
  const bool are_cells_excluded = options.clearance || options.is_progression_recorded ||
                                  !intent.ratios.empty() || !prepared.may_intersect.empty() ||
                                  !prepared.soup.poses.empty();
  const bool is_default = prepared.soup.triangles.size() >= faces_for_cells && !are_cells_excluded;
  return is_in_cells.value_or(is_default) ? faces_per_cell : 0;
}

} // namespace selvedge

#endif // SELVEDGE_AUTOMATIC_CELLS_H
