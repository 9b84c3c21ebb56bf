// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/internal/Packed_numbers.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace selvedge::test {
namespace {

using internal::Packed_numbers;

TEST(Packed_numbers, AreThoseThatWereAdded)
{
  std::mt19937_64 random(3);
  for (int bits = 0; bits <= 32; ++bits) {
    SCOPED_TRACE(bits);
    const std::uint64_t largest = (std::uint64_t(1) << bits) - 1;
    std::vector<std::uint32_t> numbers;
    for (int i = 0; i < 200; ++i)
      numbers.push_back(std::uint32_t(i % 9 == 0 ? largest : random() & largest));
    Packed_numbers bounded(largest + 1), unbounded;
    for (const std::uint32_t number : numbers) {
      bounded.push_back(number);
      unbounded.push_back(number);
    }
    Packed_numbers copied(numbers);
    for (Packed_numbers* packed : {&bounded, &unbounded, &copied}) {
      ASSERT_EQ(packed->size(), numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i)
        ASSERT_EQ((*packed)[i], numbers[i]) << i;
    }
  }
  EXPECT_EQ(Packed_numbers(std::vector<std::uint32_t>()).size(), 0u);
}

} // namespace
} // namespace selvedge::test
