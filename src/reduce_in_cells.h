// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REDUCE_IN_CELLS_H
#define SELVEDGE_REDUCE_IN_CELLS_H

#include <selvedge/Simplify_options.h>
#include <selvedge/mesh/Working_mesh.h>
#include <selvedge/simplify_soup.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// What cells must know of the whole that they are cells of.
struct Whole
{
  const Prepared_soup& prepared;
  const Working_mesh& working; ///< the mesh of `prepared`, in which nothing has been collapsed
  const Border_rule<Working_mesh::Mesh>& rule;
  const Simplify_options& options;
  double diagonal;
  Simplify_progress progress;

  /// Of all vertices that may move, the share that has to go.
  double share;
};

struct Cell_collapses
{
  std::size_t cells = 0;
  std::vector<Working_mesh::Side> collapses; ///< those of a cell in their order, cell by cell
  bool is_stopped = false;                   ///< somebody wished it
};

/// Collapses that can be done to the whole, cell by cell, or those of different cells in any order or at
/// once.
///
/// Cells are disjoint open boxes. In a cell moves what is strictly inside, and has neighbours that are; so
/// every star and every sweep is strictly inside a convex set, which no star and no sweep of another cell
/// meets. Whatever else is in sight stands still in all cells. What is one edge, one vertex, a line or locked
/// is taken from the whole, and decided by no cell. See docs/guarantees.md.
///
/// **Guarantees** The result is a function of the input, not of threads and their luck, unless stopped.
/// `should_stop` of the options is asked before every division of a box and every cell, and by each of these
/// as in any reduction.
///
/// **Complexity** O(n log n) for n faces in all, in parallel but for the division into cells.
Cell_collapses reduce_in_cells(const Whole& whole);

} // namespace selvedge

#endif // SELVEDGE_REDUCE_IN_CELLS_H
