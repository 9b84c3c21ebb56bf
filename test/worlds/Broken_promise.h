// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_BROKEN_PROMISE_H
#define SELVEDGE_TEST_WORLDS_BROKEN_PROMISE_H

#include <cstddef>
#include <optional>
#include <string>

namespace selvedge::test {

/// What every run of every world must keep.
enum class Promise {
  preparation, ///< rounding, the offending pairs, and what is frozen for them, are as brute force finds them
  embedded,    ///< after every motion, faces that changed are proper and meet others only in what they share
  motion,      ///< so they do at every time on the way
  topology,    ///< every collapse meets the link condition; every piece keeps its boundary loops and Euler
               ///< number
  seams, ///< what is on a border or seam moves along it alone; a snap goes to a partner within the distance
  clearance,   ///< pieces come no nearer to each other than the distance asked for, or than they were
  attributes,  ///< every corner has what a corner of the input has there, on the same side
  frozen,      ///< nothing locked, kept or frozen moves
  stop,        ///< the target is reached and not passed, or the report says that it was not
  verdict,     ///< the library's judge finds nothing wrong with the result
  log_replay,  ///< the log is accepted, limits of quality included, and leads to the result
  progression, ///< every step leads to the state that the reduction had, also from a file
  written,     ///< the file reads back as the result
  determinism, ///< twins that must be the same are the same
  refusal      ///< what is refused is what should be, by an error of the right kind
};

const char* name(Promise promise);

struct Broken_promise
{
  Promise promise;
  std::string message;
};

/// None when all promises are kept.
using Verdict = std::optional<Broken_promise>;

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_BROKEN_PROMISE_H
