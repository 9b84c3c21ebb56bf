// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_LINK_H
#define SELVEDGE_SRC_REPLAY_LINK_H

#include "Complex.h"

namespace selvedge::reference {

/// Returns why `replay` rejects a collapse by the link condition, or null: the two positions have a
/// neighbour in common without a triangle of the three, or borders would meet.
const char* link_objection(const Complex& complex, Index removed, Index kept);

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_LINK_H
