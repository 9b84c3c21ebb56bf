// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_JUDGE_FILES_H
#define SELVEDGE_TEST_WORLDS_JUDGE_FILES_H

#include "Broken_promise.h"
#include "World_run.h"

#include <vector>

namespace selvedge::test {

/// Whether the log is accepted, in every pose that is guarded, and leads to the result.
Verdict judge_replay(const World& world, const World_run& run);

/// Whether the file reads back as the result.
Verdict judge_file(const World& world, const World_run& run);

/// Whether the last level in the progressive file is the result in a file of the same format.
Verdict judge_progressive_file(const World_run& run);

/// Whether levels that one file holds are read as they were judged.
Verdict judge_file_of_levels(const World& world, const std::vector<Simplified_soup>& levels);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_JUDGE_FILES_H
