// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_JUDGE_STOP_H
#define SELVEDGE_TEST_WORLDS_JUDGE_STOP_H

#include "Broken_promise.h"
#include "World_run.h"

#include <vector>

namespace selvedge::test {

/// Which triangles of a prepared soup must not change; those that are locked only if asked for.
std::vector<char> held(const World& world, const Triangle_soup& soup, bool with_locked);

/// Whether the report says what has happened, and the target is reached and not passed.
Verdict judge_stop(const World& world, const World_run& run);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_JUDGE_STOP_H
