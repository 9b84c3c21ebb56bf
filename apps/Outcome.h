// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_OUTCOME_H
#define SELVEDGE_APPS_OUTCOME_H

#include "exit_codes.h"

namespace selvedge::app {

/// Says how a reduction ended, and decides what follows from it.
struct Outcome
{
  bool is_guarded = true;  ///< the intersection filter was on
  bool is_accepted = true; ///< the judge found nothing that was not there before
  bool is_interrupted = false;
  bool is_reached = true;
  bool is_target_required = false;

  /// A guarded result that the judge refuses is a bug of ours, and must not replace a good file. An unguarded
  /// one is written, because the user asked for it.
  bool is_written() const { return is_accepted || !is_guarded; }

  /// An unguarded result is never called verified, because the judge sees the result and not the way there.
  Exit_code exit_code() const
  {
    if (!is_accepted || !is_guarded)
      return exit_not_verified;
    if (is_interrupted)
      return exit_interrupted;
    return is_reached || !is_target_required ? exit_done : exit_not_verified;
  }
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_OUTCOME_H
