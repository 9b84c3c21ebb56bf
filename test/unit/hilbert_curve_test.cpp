// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/spatial/internal/Hilbert_curve.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace {

using selvedge::internal::Hilbert_curve;

TEST(HilbertCurve, ComesToEveryCellOnceAndAlwaysFromANeighbour)
{
  constexpr std::uint32_t size = 16;
  constexpr Hilbert_curve curve;
  std::vector<Hilbert_curve::Cell> cells(size * size * size, {size, size, size});
  for (std::uint32_t x = 0; x < size; ++x)
    for (std::uint32_t y = 0; y < size; ++y)
      for (std::uint32_t z = 0; z < size; ++z) {
        const std::uint64_t place = curve.place_of({x, y, z});
        ASSERT_LT(place, cells.size());
        ASSERT_EQ(cells[place][0], size) << "another cell is there";
        cells[place] = {x, y, z};
      }
  for (std::size_t i = 1; i < cells.size(); ++i) {
    int steps = 0;
    for (int axis = 0; axis < 3; ++axis)
      steps += std::abs(int(cells[i][axis]) - int(cells[i - 1][axis]));
    ASSERT_EQ(steps, 1) << "from " << i - 1 << " to " << i;
  }
}

TEST(HilbertCurve, TellsTheLastCellsApart)
{
  constexpr std::uint32_t last = (1u << Hilbert_curve::bits) - 1;
  constexpr Hilbert_curve curve;
  const std::uint64_t a = curve.place_of({last, last, last}), b = curve.place_of({last, last, last - 1});
  EXPECT_NE(a, b);
  EXPECT_LT(std::max(a, b), std::uint64_t(1) << 3 * Hilbert_curve::bits);
}

} // namespace
