// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "sides.h"

#include "positions.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <numeric>
#include <tuple>

std::vector<selvedge::internal::Side>
selvedge::internal::sorted_sides(const std::vector<Index_triple>& triangles, std::size_t vertices)
{
  const auto for_each_side = [&](const auto& function) {
    for (std::size_t triangle = 0; triangle < triangles.size(); ++triangle)
      for (int i = 0; is_face(triangles[triangle]) && i < 3; ++i) {
        const int j = (i + 1) % 3;
        const Index from = triangles[triangle][i], to = triangles[triangle][j];
        const std::size_t corner_from = 3 * triangle + i, corner_to = 3 * triangle + j;
        function(from < to ? Side{from, to, corner_from, corner_to} : Side{to, from, corner_to, corner_from});
      }
  };
  std::vector<std::size_t> places(vertices + 1, 0);
  for_each_side([&](const Side& side) { ++places[side.low + 1]; });
  std::partial_sum(places.begin(), places.end(), places.begin());
  std::vector<Side> sides(places.back());
  for_each_side([&](const Side& side) { sides[places[side.low]++] = side; });
  auto first = sides.begin();
  Cancellation_poll poll;
  for (std::size_t low = 0; low < vertices; ++low) {
    poll();
    const auto beyond = sides.begin() + std::ptrdiff_t(places[low]);
    std::sort(first, beyond, [](const Side& a, const Side& b) {
      return std::tie(a.high, a.corner_at_low) < std::tie(b.high, b.corner_at_low);
    });
    first = beyond;
  }
  return sides;
}

std::vector<selvedge::internal::Side>
selvedge::internal::sides_between_positions(const std::vector<Point_3>& points,
                                            std::vector<Index_triple> triangles)
{
  const std::vector<Index> positions = position_numbers(points);
  for (Index_triple& triangle : triangles)
    for (Index& corner : triangle)
      corner = positions[corner];
  return sorted_sides(triangles, points.size());
}
