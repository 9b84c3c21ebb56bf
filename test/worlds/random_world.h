// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_RANDOM_WORLD_H
#define SELVEDGE_TEST_WORLDS_RANDOM_WORLD_H

#include "World.h"

#include <cstdint>

namespace selvedge::test {

/// The world of a seed: a scene, spoiled or not, displaced, decorated, in a file of some format, beside an
/// obstacle or not, and every option of a reduction, most of them as they are by default. The same on every
/// machine.
World random_world(std::uint64_t seed);

/// The same input, files and preparation, with other limits, targets, means and parts. Those of a number are
/// always the same.
World with_other_options(const World& world, std::uint64_t number);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_RANDOM_WORLD_H
