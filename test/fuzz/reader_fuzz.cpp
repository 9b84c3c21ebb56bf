// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What libFuzzer calls with every file that it makes up. What a program of its own reads is said by
// SELVEDGE_FUZZED.

#include "fuzz/judge.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
  selvedge::test::judge(SELVEDGE_FUZZED, {reinterpret_cast<const char*>(data), size});
  return 0;
}
