// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_JUDGE_START_H
#define SELVEDGE_TEST_WORLDS_JUDGE_START_H

#include "Broken_promise.h"
#include "Judged_complex.h"
#include "World_run.h"

#include <cstddef>
#include <string>
#include <vector>

namespace selvedge::test {

/// What `prepare` should come to, found by looking at everything.
struct Expected_start
{
  explicit Expected_start(const World& world);

  Triangle_soup soup, obstacle; ///< points and triangles alone
  std::vector<char> is_merged;  ///< by own vertex: rounding has brought others of other positions to it
  std::vector<char> part_of;    ///< by own triangle
};

/// A world as it is in one of its poses.
World in_pose(const World& world, std::size_t pose);

/// Whether a world was rightly refused.
Verdict judge_refusal(const World& world, const std::string& message);

/// Whether what is prepared is what was expected. Exempts and freezes in the complex what it should.
Verdict judge_preparation(const World& world, const World_run& run, const Expected_start& expected,
                          Judged_complex& complex);

/// Whether every snap is allowed; the complex does them, and `count` becomes larger by their number.
Verdict judge_snaps(const World& world, const World_run& run, Judged_complex& complex, std::size_t& count);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_JUDGE_START_H
