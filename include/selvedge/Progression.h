// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_PROGRESSION_H
#define SELVEDGE_PROGRESSION_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// A reduction as a sequence of steps that name only *wedges*: the corners at a vertex of the original
/// between two lines (seams, borders of groups, hard edges), which share a vertex number and all attributes.
///
/// A step moves every corner of one or more wedges to another wedge each, and a triangle is gone once two of
/// its corners are in one wedge. So the state after any step follows from the original and the steps alone:
/// no position and no attribute is computed.
///
/// **Guarantees**
/// 1. *Well-defined*: corners that are in one wedge stay together. A wedge moves once at most, to a wedge
///    that has not moved yet, and nothing comes to a wedge that has moved.
/// 2. *Exact*: after n steps, the triangles that are left and the position, texture coordinates, normal and
///    attributes at each corner are those that the reduction had then. (Of equal values under two numbers,
///    either may be named.)
/// 3. *Judged*: before a step was taken, the reduction decided exactly that nothing meets or passes through
///    anything while the vertices go in straight lines, in every pose that it guards.
struct Progression
{
  struct Move
  {
    Index from = 0, to = 0; ///< wedges
  };

  /// For every triangle of the original, the wedges of its three corners. Wedges are numbered from 0; the
  /// three differ.
  std::vector<Index_triple> wedges;

  /// The moves of all steps, in order.
  std::vector<Move> moves;

  /// For every step, how many of the moves belong to it and those before it. Vertices that move together, in
  /// several sheets or in several places of a shared mesh, do so in one step.
  std::vector<std::size_t> steps;

  bool empty() const { return wedges.empty(); }
};

/// What is left of a triangle after some steps.
struct Wedge_triangle
{
  Index triangle = 0;       ///< of the original
  Index_triple wedges = {}; ///< where its corners are, in the order that they have in the original
};

/// Returns the triangles that are left after some steps, in their order.
///
/// **Preconditions** There are as many steps. **Complexity** Linear.
std::vector<Wedge_triangle> triangles_after(const Progression& progression, std::size_t steps);

} // namespace selvedge

#endif // SELVEDGE_PROGRESSION_H
