// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_SHRUNK_WORLD_H
#define SELVEDGE_TEST_WORLDS_SHRUNK_WORLD_H

#include "World.h"

#include <functional>

namespace selvedge::test {

/// A smaller world that still fails: options as they are by default, fewer triangles, nothing that hangs on
/// them, smaller and rounder coordinates; whatever can be had step by step. `fails` is asked of worlds that
/// have at least one triangle.
World shrunk(World world, const std::function<bool(const World&)>& fails);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_SHRUNK_WORLD_H
