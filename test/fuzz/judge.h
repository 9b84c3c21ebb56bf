// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_FUZZ_JUDGE_H
#define SELVEDGE_TEST_FUZZ_JUDGE_H

#include <string_view>

namespace selvedge::test {

/// Reads `contents` as a file of a kind ("obj", "off", "ply", "stl", "glb", "gltf", "log", "progressive"),
/// and aborts with a line on stderr when a promise is broken: those of `judge_mesh`, `judge_log` and
/// `judge_progressive`, and that no more memory is taken at a time than `contents` can account for.
void judge(std::string_view kind, std::string_view contents);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_FUZZ_JUDGE_H
