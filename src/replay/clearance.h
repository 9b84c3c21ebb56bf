// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_CLEARANCE_H
#define SELVEDGE_SRC_REPLAY_CLEARANCE_H

#include "Complex.h"

#include <array>
#include <vector>

namespace selvedge::reference {

using Corners = std::array<Coordinates, 3>; // of a triangle

/// Returns a number for every position, which all positions have in common whose faces are connected.
std::vector<Index> pieces_of(const Complex& complex);

/// What a motion does to the distance between its star and a triangle that stands still.
struct Clearance_question
{
  double distance;           ///< that is to be kept
  std::vector<Corners> star; ///< the faces at the vertex before it moves
  std::vector<Corners>
      facets; ///< of the tetrahedra that the moving faces pass over, those that are not of the star
};

/// Decides, for `replay`, whether all facets are as far from a triangle as the distance or, if that is less,
/// as the star is. Intervals decide it, and rational numbers where they do not.
bool is_clearance_kept(const Clearance_question& question, const Corners& standing);

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_CLEARANCE_H
