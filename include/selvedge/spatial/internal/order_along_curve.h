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
/// **Complexity** Linear in the number n of points where few of them lie in one cell of a grid of 1024³ cells
/// around all, as those of a surface do; O(n log n) otherwise. `point_at` is called two or three times for
/// each.
template <class Point_at>
std::vector<std::uint32_t> order_along_curve(std::size_t size, const Point_at& point_at)
{
  static constexpr Hilbert_curve curve;
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
  // All points are in one cell where their extent or its inverse is no number.
  const double per_unit = ((1 << Hilbert_curve::bits) - 1) / extent;
  const double cells = std::isfinite(extent) && std::isfinite(per_unit) ? per_unit : 0;
  const auto cell_of = [&](std::size_t i) {
    const auto point = point_at(i);
    Hilbert_curve::Cell cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
      cell[axis] = std::uint32_t((point[axis] - lower[axis]) * cells);
    return cell;
  };

  // Sorts by the leading bits, digit by digit from the last one, which keeps the order of equal numbers.
  struct Place
  {
    std::uint32_t leading;
    std::uint32_t number;
  };
  constexpr int levels = 10, digit_bits = levels;
  constexpr std::uint32_t digits = 1 << digit_bits;
  std::vector<Place> places, sorted(size);
  places.reserve(size);
  for (std::size_t i = 0; i < size; ++i)
    places.push_back({std::uint32_t(curve.place_of<levels>(cell_of(i))), std::uint32_t(i)});
  for (int shift = 0; shift < 3 * levels; shift += digit_bits) {
    const auto digit = [shift](const Place& place) { return place.leading >> shift & (digits - 1); };
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

  // Sorts those that have the same leading bits by all bits.
  order.reserve(size);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> run;
  for (auto place = places.begin(); place != places.end();) {
    const std::uint32_t leading = place->leading;
    run.clear();
    for (; place != places.end() && place->leading == leading; ++place)
      run.emplace_back(0, place->number);
    if (run.size() > 1) {
      for (auto& [on_curve, number] : run)
        on_curve = curve.place_of(cell_of(number));
      std::sort(run.begin(), run.end());
    }
    for (const auto& [on_curve, number] : run)
      order.push_back(number);
  }
  return order;
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_ORDER_ALONG_CURVE_H
