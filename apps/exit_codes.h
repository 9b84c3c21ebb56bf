// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_EXIT_CODES_H
#define SELVEDGE_APPS_EXIT_CODES_H

namespace selvedge::app {

/// How the app ends, for scripts; part of its interface.
enum Exit_code {
  exit_done = 0,         ///< done and verified: no offending pair that was not in the input, same topology
  exit_not_verified = 1, ///< the judge objects, or the target was missed and `--require-target` given
  exit_usage = 2,        ///< the command line asks for something that does not exist or makes no sense
  exit_bad_input = 3,    ///< the input cannot be read, is unacceptable, or too large for the memory
  exit_not_written = 4,  ///< the output or the report could not be written
  exit_interrupted =
      5 ///< stopped by a signal; what a reduction has reached is verified and written, else nothing
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_EXIT_CODES_H
