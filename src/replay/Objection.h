// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REPLAY_OBJECTION_H
#define SELVEDGE_REPLAY_OBJECTION_H

#include <selvedge/replay.h>

#include <string>
#include <vector>

namespace selvedge::reference {

/// Why `replay` rejects a step.
struct Objection
{
  Violation_kind kind;
  std::string message;
  std::vector<Index> faces = {}; ///< of the complex
  std::string point = {};        ///< as in `Violation`, like the next
  std::string scene = {};
};

} // namespace selvedge::reference

#endif // SELVEDGE_REPLAY_OBJECTION_H
