// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_JUDGE_WORLD_H
#define SELVEDGE_TEST_WORLDS_JUDGE_WORLD_H

#include "Broken_promise.h"
#include "World_run.h"

#include <cstddef>
#include <optional>

namespace selvedge::test {

struct Judgement_counts
{
  std::size_t worlds = 0; ///< accepted by `prepare`
  std::size_t refused_worlds = 0;
  std::size_t collapses = 0; ///< judged by brute force
  std::size_t snaps = 0;
  std::size_t twins = 0;

  Judgement_counts& operator+=(const Judgement_counts& other);
};

/// The first promise that a run breaks: every motion by brute force, the end, the log by the replay, the
/// file.
std::optional<Broken_promise> judge(const World& world, const World_run& run, Judgement_counts& counts);

/// The first promise that a twin of a run breaks. One with another index, in other threads, with zeros of the
/// other sign, or in units 2^k times as large does the same; one with vertices and triangles in another order
/// keeps what this one keeps; a level of detail is what a run to it alone gives.
std::optional<Broken_promise> judge_twins(const World& world, const World_run& run, Judgement_counts& counts);

/// Runs a world and judges all of that. An exception is a promise broken.
std::optional<Broken_promise> judge(const World& world, Judgement_counts& counts);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_JUDGE_WORLD_H
