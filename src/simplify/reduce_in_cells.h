// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SIMPLIFY_REDUCE_IN_CELLS_H
#define SELVEDGE_SIMPLIFY_REDUCE_IN_CELLS_H

#include "soup/Working_mesh.h"
#include <selvedge/Simplify_options.h>
#include <selvedge/simplify.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// What cells must know of the whole mesh.
struct Cell_context
{
  const Prepared_soup& prepared;
  const Working_mesh& working; ///< the mesh of `prepared`, in which nothing has been collapsed
  const Border_rule<Working_mesh::Mesh>& rule;
  const Simplify_options& options;
  double diagonal;
  Simplify_progress progress;

  /// The share of the movable vertices that is to be collapsed; above 1 where the target cannot be reached.
  double share;
};

struct Cell_collapse
{
  Working_mesh::Collapse collapse;
  double cost;
};

struct Cell_collapses
{
  std::size_t cells = 0;
  std::vector<std::vector<Cell_collapse>> collapses; ///< of each cell, in their order
  bool is_stopped = false;                           ///< `should_stop` of the options has returned true
};

/// Finds collapses that can be done to the whole mesh: those of one cell in their order, and those of
/// different cells in any order, or at once.
///
/// Cells are disjoint open boxes. A vertex may move in a cell only if it and all its neighbours are strictly
/// inside, and only to places strictly inside. So every star and every sweep is strictly inside a convex set,
/// which no star and no sweep of another cell meets. Everything else that a cell sees stands still in all
/// cells. No cell decides what is one edge, what is one vertex, what is a line or what is locked: all of this
/// is taken from the whole. docs/guarantees.md proves that this is enough.
///
/// **Guarantees** Unless stopped, the result depends on the input alone, not on the number of threads or
/// their timing. `should_stop` of the options is asked before every division of a box, before every cell, and
/// within each cell as in any reduction.
///
/// **Complexity** O(n log n) for n faces in all, in parallel.
Cell_collapses reduce_in_cells(const Cell_context& whole);

} // namespace selvedge

#endif // SELVEDGE_SIMPLIFY_REDUCE_IN_CELLS_H
