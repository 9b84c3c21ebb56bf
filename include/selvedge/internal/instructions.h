// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_INSTRUCTIONS_H
#define SELVEDGE_INTERNAL_INSTRUCTIONS_H

#include <array>
#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace selvedge {
namespace internal {

// Operations that processors do in one instruction but C++17 cannot express. Where the compiler or processor
// does not offer them, plain code does the same.

/// Asks the processor to load an object that will be read soon.
template <class T>
void prefetch([[maybe_unused]] const T& object)
{
#ifdef __GNUC__
  constexpr std::size_t line = 64;
  for (std::size_t offset = 0; offset < sizeof(T); offset += line)
    __builtin_prefetch(reinterpret_cast<const char*>(&object) + offset);
#endif
}

/// Returns the number of the lowest bit that is set. **Precondition** `mask` is not 0.
inline std::size_t lowest_bit(std::uint32_t mask)
{
#ifdef __GNUC__
  return std::size_t(__builtin_ctz(mask));
#else
  std::size_t i = 0;
  while ((mask >> i & 1) == 0)
    ++i;
  return i;
#endif
}

/// Returns a mask whose bit i says whether number i is negative. `count` is a multiple of four, at most 32.
template <std::size_t count>
std::uint32_t negative(const std::array<std::int32_t, count>& numbers)
{
  static_assert(count % 4 == 0 && count <= 32, "");
  std::uint32_t result = 0;
#ifdef __SSE2__ // compilers do not always make this of a plain loop
  for (std::size_t i = 0; i < count; i += 4) {
    const __m128i four = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&numbers[i]));
    result |= std::uint32_t(_mm_movemask_ps(_mm_castsi128_ps(four))) << i;
  }
#else
  for (std::size_t i = 0; i < count; ++i)
    result |= std::uint32_t(numbers[i] < 0) << i;
#endif
  return result;
}

/// The same for numbers of 16 bits, of which there are a multiple of 16.
template <std::size_t count>
std::uint32_t negative(const std::array<std::int16_t, count>& numbers)
{
  static_assert(count % 16 == 0 && count <= 32, "");
  std::uint32_t result = 0;
#ifdef __SSE2__
  for (std::size_t i = 0; i < count; i += 16) {
    const auto eight_from = [&](std::size_t first) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(&numbers[first]));
    };
    result |= std::uint32_t(_mm_movemask_epi8(_mm_packs_epi16(eight_from(i), eight_from(i + 8)))) << i;
  }
#else
  for (std::size_t i = 0; i < count; ++i)
    result |= std::uint32_t(numbers[i] < 0) << i;
#endif
  return result;
}

/// Masks whose bits i say whether number i is surely negative, or surely positive.
struct Signs
{
  std::uint64_t negative = 0, positive = 0;
};

/// Returns the signs of a[i] x + b[i] y + c[i] for i < `count`, which is even and at most 64. Sums within
/// `error` of 0 are neither negative nor positive.
inline Signs signs_of_sums(const double* a, const double* b, const double* c, std::size_t count, double x,
                           double y, double error)
{
  Signs signs;
#ifdef __SSE2__
  const __m128d xx = _mm_set1_pd(x), yy = _mm_set1_pd(y), most = _mm_set1_pd(error),
                least = _mm_set1_pd(-error);
  for (std::size_t i = 0; i < count; i += 2) {
    const __m128d sum =
        _mm_add_pd(_mm_add_pd(_mm_mul_pd(_mm_loadu_pd(a + i), xx), _mm_mul_pd(_mm_loadu_pd(b + i), yy)),
                   _mm_loadu_pd(c + i));
    signs.negative |= std::uint64_t(_mm_movemask_pd(_mm_cmplt_pd(sum, least))) << i;
    signs.positive |= std::uint64_t(_mm_movemask_pd(_mm_cmpgt_pd(sum, most))) << i;
  }
#else
  for (std::size_t i = 0; i < count; ++i) {
    const double sum = a[i] * x + b[i] * y + c[i];
    signs.negative |= std::uint64_t(sum < -error) << i;
    signs.positive |= std::uint64_t(sum > error) << i;
  }
#endif
  return signs;
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_INSTRUCTIONS_H
