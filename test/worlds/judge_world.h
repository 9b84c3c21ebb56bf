// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_JUDGE_WORLD_H
#define SELVEDGE_TEST_WORLDS_JUDGE_WORLD_H

#include "Broken_promise.h"
#include "World_run.h"

#include <cstddef>
#include <map>
#include <string>

namespace selvedge::test {

struct Judgement_counts
{
  std::size_t worlds = 0; ///< accepted by `prepare`
  std::size_t refused_worlds = 0;
  std::size_t collapses = 0; ///< judged by brute force
  std::size_t placed = 0;    ///< how many of them go to new places
  std::size_t snaps = 0;
  std::size_t turned = 0; ///< faces that were turned
  std::size_t twins = 0;
  std::size_t option_sets = 0;                ///< beyond the first of each world
  std::map<std::string, std::size_t> options; ///< how many reductions had it

  Judgement_counts& operator+=(const Judgement_counts& other);
};

/// How much is judged.
struct Judgement_extent
{
  bool is_replay_asked = true; ///< about the log, which costs as much as all other questions
  std::size_t option_sets = 0; ///< so many reductions more from one preparation, `with_other_options`
};

/// The first promise that a run breaks: every motion by brute force, the end, the log by the replay, the
/// file; then every motion and the end of reductions with other options.
Verdict judge(const World& world, const World_run& run, Judgement_counts& counts,
              const Judgement_extent& extent = {});

/// The first promise that a twin of a run breaks. One with another index, in other threads, with zeros of the
/// other sign, or in units 2^k times as large does the same; one with vertices and triangles in another order
/// keeps what this one keeps, and so does a second reduction after a missed target; a level of detail is what
/// a run to it alone gives.
Verdict judge_twins(const World& world, const World_run& run, Judgement_counts& counts,
                    const Judgement_extent& extent = {});

/// Runs a world and judges all of that. An exception is a promise broken.
Verdict judge(const World& world, Judgement_counts& counts, const Judgement_extent& extent = {});

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_JUDGE_WORLD_H
