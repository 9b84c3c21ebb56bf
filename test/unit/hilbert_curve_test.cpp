// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/spatial/internal/Hilbert_curve.h>
#include <selvedge/spatial/internal/order_along_curve.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
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

using Place_in_space = std::array<double, 3>;

TEST(OrderAlongCurve, HasEveryNumberOnceAndGoesFromNeighbourToNeighbour)
{
  constexpr int size = 16;
  std::vector<Place_in_space> points;
  for (int i = 0; i < size * size * size; ++i)
    points.push_back({100. + i % size, 10. + i / size % size, -3. - i / size / size});
  std::shuffle(points.begin(), points.end(), std::mt19937(1));
  const std::vector<std::uint32_t> order =
      selvedge::internal::order_along_curve(points.size(), [&](std::size_t i) { return points[i]; });
  std::vector<std::uint32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted.size(), points.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i)
    ASSERT_EQ(sorted[i], i);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Place_in_space &a = points[order[i - 1]], &b = points[order[i]];
    ASSERT_EQ(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]), 1) << i;
  }
}

TEST(OrderAlongCurve, GoesFromNeighbourToNeighbourInACornerOfAllSpace)
{
  constexpr int size = 16;
  std::vector<Place_in_space> points;
  for (int i = 0; i < size * size * size; ++i)
    points.push_back({1. * (i % size), 1. * (i / size % size), 1. * (i / size / size)});
  std::shuffle(points.begin(), points.end(), std::mt19937(2));
  // So far away that cells are of size 1.
  points.push_back({(1 << selvedge::internal::Hilbert_curve::bits) - 1., 0, 0});
  const std::vector<std::uint32_t> order =
      selvedge::internal::order_along_curve(points.size(), [&](std::size_t i) { return points[i]; });
  ASSERT_EQ(order.size(), points.size());
  ASSERT_EQ(order.back(), points.size() - 1);
  for (std::size_t i = 1; i + 1 < order.size(); ++i) {
    const Place_in_space &a = points[order[i - 1]], &b = points[order[i]];
    ASSERT_EQ(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]), 1) << i;
  }
}

TEST(OrderAlongCurve, TellsPointsApartOfWhichTheLastIsTheLowest)
{
  const std::vector<Place_in_space> points = {{7, 0, 0}, {8, 8, 8}, {0, 0, 0}};
  const auto order =
      selvedge::internal::order_along_curve(points.size(), [&](std::size_t i) { return points[i]; });
  EXPECT_EQ(order.front(), 2u);
}

TEST(OrderAlongCurve, KeepsTheOrderOfPointsWhoseExtentIsNoNumber)
{
  for (const double far : {1.7e308, 4e-323}) {
    const std::vector<Place_in_space> points = {{far, 0, 0}, {-far, 0, 0}, {0, far, 0}};
    const auto order =
        selvedge::internal::order_along_curve(points.size(), [&](std::size_t i) { return points[i]; });
    EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 2})) << far;
  }
}

TEST(OrderAlongCurve, KeepsTheOrderOfPointsThatAreOne)
{
  const std::vector<Place_in_space> points = {{1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}};
  const auto order = [&](std::size_t size) {
    return selvedge::internal::order_along_curve(size, [&](std::size_t i) { return points[i]; });
  };
  EXPECT_EQ(order(5), (std::vector<std::uint32_t>{1, 3, 0, 2, 4}));
  EXPECT_EQ(order(1), std::vector<std::uint32_t>{0});
  EXPECT_TRUE(order(0).empty());
}

} // namespace
