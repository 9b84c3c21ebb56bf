// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_EXIT_CODES_H
#define SELVEDGE_APPS_EXIT_CODES_H

#include <array>

namespace selvedge::app {

/// Says how the app ended, for scripts: a part of its interface.
enum Exit_code {
  exit_done = 0,
  exit_not_verified = 1,
  exit_usage = 2,
  exit_bad_input = 3,
  exit_not_written = 4,
  exit_interrupted = 5
};

struct Exit_code_description
{
  Exit_code code;
  const char* meaning;
};

/// Says what each exit code means. `selvedge --help` prints this table; a test compares the README with it.
inline constexpr std::array<Exit_code_description, 6> exit_code_descriptions{{
    {exit_done, "done; the judge accepts the result"},
    {exit_not_verified,
     "the judge does not accept the result, or it misses the target and --require-target is given"},
    {exit_usage, "the command line is wrong, or names an output file of an unknown kind"},
    {exit_bad_input, "the input cannot be read, is not acceptable, or is too large for the memory"},
    {exit_not_written, "an output file cannot be written; an older file of that name is still there"},
    {exit_interrupted, "interrupted; a reduction that had begun is judged and written as far as it got"},
}};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_EXIT_CODES_H
