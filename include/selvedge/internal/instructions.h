// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_INSTRUCTIONS_H
#define SELVEDGE_INTERNAL_INSTRUCTIONS_H

#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace selvedge {
namespace internal {

// What processors do in one instruction and C++17 has no words for; elsewhere the same in several.

/// Tells that what lies there will be read soon.
inline void prefetch([[maybe_unused]] const void* address)
{
#ifdef __GNUC__
  __builtin_prefetch(address);
#endif
}

/// Which of the first `count` numbers, 64 at most, are less than 0: bit i is number i.
inline std::uint64_t negative(const double* numbers, std::size_t count)
{
  std::uint64_t result = 0;
  std::size_t i = 0;
#ifdef __SSE2__
  for (; i + 2 <= count; i += 2)
    result |= std::uint64_t(_mm_movemask_pd(_mm_cmplt_pd(_mm_loadu_pd(numbers + i), _mm_setzero_pd()))) << i;
#endif
  for (; i < count; ++i)
    result |= std::uint64_t(numbers[i] < 0) << i;
  return result;
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_INSTRUCTIONS_H
