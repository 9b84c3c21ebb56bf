// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_SNAP_H
#define SELVEDGE_SRC_REPLAY_SNAP_H

#include "Complex.h"
#include "Objection.h"

#include <optional>

namespace selvedge::reference {

/// Returns the first reason why the vertices at `moved` may not snap to `kept`, to which no edge leads: there
/// is no weld distance; they lie farther apart; they are no partners; or an edge would get other faces than
/// two that run along it in opposite directions. Distances are compared in floating point, with the tolerance
/// of the limits.
std::optional<Objection> judge_snap(const Complex& complex, Index moved, Index kept,
                                    const std::optional<double>& weld_distance);

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_SNAP_H
