// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_ORDER_ALONG_CURVE_H
#define SELVEDGE_SPATIAL_INTERNAL_ORDER_ALONG_CURVE_H

#include <selvedge/spatial/internal/Hilbert_curve.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Returns the numbers 0 … size−1 in the order in which a Hilbert curve visits points: point i is
/// `point_at(i)`, three finite coordinates. Points that the curve does not tell apart keep their order.
///
/// Of things in this order, those that are near each other in space are mostly near each other in memory.
///
/// **Complexity** Linear in the number of points; `point_at` is called twice for each.
template <class Point_at>
std::vector<std::uint32_t> order_along_curve(std::size_t size, const Point_at& point_at)
{
  static constexpr Hilbert_curve curve;
  struct Place
  {
    std::uint64_t on_curve;
    std::uint32_t number;
  };
  std::vector<std::uint32_t> order;
  if (size == 0)
    return order;
  std::array<double, 3> lower, upper;
  for (std::size_t i = 0; i < size; ++i) {
    const auto point = point_at(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = i == 0 ? point[axis] : (std::min)(lower[axis], double(point[axis]));
      upper[axis] = i == 0 ? point[axis] : (std::max)(upper[axis], double(point[axis]));
    }
  }
  const double extent = (std::max)({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
  // All points are in one cell where their extent or its inverse is 0 or no number.
  const double per_unit = ((1 << Hilbert_curve::bits) - 1) / extent;
  const double cells = std::isfinite(per_unit) ? per_unit : 0;
  std::vector<Place> places;
  places.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto point = point_at(i);
    Hilbert_curve::Cell cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
      cell[axis] = cells > 0 ? std::uint32_t((point[axis] - lower[axis]) * cells) : 0;
    places.push_back({curve.place_of(cell), std::uint32_t(i)});
  }

  // Sorts digit by digit, from the last one, and keeps the order of equal places.
  constexpr int bits = 11;
  constexpr std::size_t digits = 1 << bits;
  std::vector<Place> sorted(size);
  for (int shift = 0; shift < 3 * Hilbert_curve::bits; shift += bits) {
    const auto digit = [shift](const Place& place) { return place.on_curve >> shift & (digits - 1); };
    std::array<std::size_t, digits> first{};
    for (const Place& place : places)
      ++first[digit(place)];
    std::size_t sum = 0;
    for (std::size_t& count : first)
      sum += std::exchange(count, sum);
    for (const Place& place : places)
      sorted[first[digit(place)]++] = place;
    places.swap(sorted);
  }
  order.reserve(size);
  for (const Place& place : places)
    order.push_back(place.number);
  return order;
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_ORDER_ALONG_CURVE_H
