// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_SNAP_H
#define SELVEDGE_SRC_REPLAY_SNAP_H

#include "Complex.h"

#include <selvedge/replay.h>

#include <optional>
#include <string>

namespace selvedge::reference {

/// What is wrong with a snap, apart from what its faces run into.
struct Snap_objection
{
  Violation_kind kind;
  std::string message;
};

/// Returns the first reason why what is at `moved` may not snap to `kept`, where no edge joins the two: there
/// is no weld distance or they lie further apart, they are no partners, or an edge would not be one of two
/// faces that run along it in opposite ways. Distances are compared in floating point, with the tolerance of
/// the limits.
std::optional<Snap_objection> judge_snap(const Complex& complex, Index moved, Index kept,
                                         const std::optional<double>& weld_distance);

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_SNAP_H
