// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_PACKED_NUMBERS_H
#define SELVEDGE_INTERNAL_PACKED_NUMBERS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace selvedge {
namespace internal {

/// An array of numbers below a bound, each of which takes as many bits as the bound asks for. It is for what
/// is large and seldom read.
class Packed_numbers
{
public:
  using Number = std::uint32_t;

  /// Makes an empty array for numbers less than `beyond`.
  explicit Packed_numbers(std::uint64_t beyond = s_most)
  {
    while (std::uint64_t(1) << m_bits < (std::min)(beyond, s_most))
      ++m_bits;
  }

  /// Makes an array of these numbers.
  explicit Packed_numbers(const std::vector<Number>& numbers)
      : Packed_numbers(numbers.empty() ? 0
                                       : 1 + std::uint64_t(*std::max_element(numbers.begin(), numbers.end())))
  {
    reserve(numbers.size());
    for (const Number number : numbers)
      push_back(number);
  }

  std::size_t size() const { return m_size; }
  void reserve(std::size_t size) { m_words.reserve(size * m_bits / 64 + 1); }

  void push_back(Number number)
  {
    const std::size_t shift = m_size * m_bits % 64;
    if (shift == 0)
      m_words.push_back(0);
    m_words.back() |= std::uint64_t(number) << shift;
    if (shift + m_bits > 64)
      m_words.push_back(std::uint64_t(number) >> (64 - shift));
    ++m_size;
  }

  Number operator[](std::size_t i) const
  {
    const std::size_t word = i * m_bits / 64, shift = i * m_bits % 64;
    std::uint64_t bits = m_words[word] >> shift;
    if (shift + m_bits > 64)
      bits |= m_words[word + 1] << (64 - shift);
    return Number(bits & ((std::uint64_t(1) << m_bits) - 1));
  }

private:
  static constexpr std::uint64_t s_most = std::uint64_t(1) << 32;

  std::vector<std::uint64_t> m_words;
  std::size_t m_size = 0;
  std::size_t m_bits = 1;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_PACKED_NUMBERS_H
