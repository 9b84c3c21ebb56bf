// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_REPLAY_INPUTS_H
#define SELVEDGE_SRC_REPLAY_INPUTS_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/collapse_log.h>
#include <selvedge/replay.h>

namespace selvedge::reference {

/// Refuses what does not belong to a log, with `Input_error`: another original, obstacle or pose than it
/// names. Throws `Argument_error` for a pose that is not there. Returns whether the obstacle is surely the
/// one of the log, by its digests.
bool check_inputs(const Triangle_soup& original, bool is_stl, const Log_header& header,
                  const Replay_options& options);

} // namespace selvedge::reference

#endif // SELVEDGE_SRC_REPLAY_INPUTS_H
