// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_PROGRESSION_RECORDER_H
#define SELVEDGE_SOUP_PROGRESSION_RECORDER_H

#include "Corner_mesh.h"

#include <selvedge/Progression.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>

namespace selvedge {

/// Records the steps of a reduction in a progression.
///
/// **Preconditions** No vertex goes to a new place. The mesh and the progression outlive the recorder.
class Progression_recorder
{
public:
  /// Makes `progression` hold the wedges of the soup, and no steps.
  ///
  /// **Preconditions** Nothing has been collapsed.
  Progression_recorder(const Corner_mesh& corners, const Simplify_constraints<Corner_mesh::Mesh>& constraints,
                       Progression& progression);

  /// Records the moves of the wedges at the source of `moving`, before it is done.
  void record_moves(Corner_mesh::Halfedge moving);

  /// Makes one step of all moves since the last one.
  void end_step() { m_progression.steps.push_back(m_progression.moves.size()); }

private:
  const Corner_mesh& m_corners;
  Progression& m_progression;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_PROGRESSION_RECORDER_H
