// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Diagonal.h"
#include "match_steps.h"

#include <selvedge/Cancellation_scope.h>

#include <cmath>

// Finds the positions of an original that vertices of its result are next to, for `match_pieces`.

namespace selvedge::internal {
namespace {

// As a share of the diagonal. Written with six digits, a garment's heights above 1 m are off by up to 5e-6 m,
// and it has a diagonal of 1.7 m or more. A motion that changes a shape is longer.
constexpr double most_distance_of_near = 3e-6;

// How many times as far any other position must be.
constexpr double least_excess_of_others = 10;

CGAL::Bbox_3 box_around(const Point_3& p, double radius)
{
  return CGAL::Bbox_3(p.x() - radius, p.y() - radius, p.z() - radius, p.x() + radius, p.y() + radius,
                      p.z() + radius);
}

} // namespace

std::vector<Index> near_positions(const Matching& matching)
{
  const Triangle_soup &result = matching.result.soup, &original = matching.original.soup;
  std::vector<Index> positions(matching.positions.begin(),
                               matching.positions.begin() + std::ptrdiff_t(result.points.size()));
  std::vector<Index> moved; // vertices of the result whose positions the original does not have
  for (const Index vertex : used_vertices(result))
    if (matching.original_at[positions[vertex]].size() == 0)
      moved.push_back(vertex);
  if (moved.empty())
    return positions;

  // One vertex of the original at each position that has a piece.
  std::vector<Point_3> points;
  std::vector<Index_triple> corners; // each point as a triangle (i, i, i)
  std::vector<Index> numbers;
  std::vector<bool> is_done(matching.position_count);
  for (const Index vertex : used_vertices(original)) {
    const Index position = matching.original.positions[vertex];
    if (is_done[position] || matching.original_at[position].size() == 0)
      continue;
    is_done[position] = true;
    const Index i = Index(points.size());
    points.push_back(scaled(original.points[vertex], -matching.exponent));
    corners.push_back({i, i, i});
    numbers.push_back(position);
  }
  const Triangle_tree tree(points, corners);
  const double most = most_distance_of_near * Diagonal(original).length(matching.exponent);
  Cancellation_poll poll;
  for (const Index vertex : moved) {
    const Point_3 p = scaled(result.points[vertex], -matching.exponent);
    const auto visit_within = [&](double radius, const auto& visit) {
      const CGAL::Bbox_3 box = box_around(p, radius);
      tree.visit([&](const CGAL::Bbox_3& other) { return CGAL::do_overlap(box, other); },
                 [&](Index i) {
                   poll();
                   visit(i, std::sqrt(CGAL::squared_distance(p, points[i])));
                 });
    };
    double least = most;
    Index nearest = no_piece;
    visit_within(most, [&](Index i, double distance) {
      if (distance <= least) {
        least = distance;
        nearest = i;
      }
    });
    if (nearest == no_piece)
      continue;
    bool is_clear = true;
    visit_within(least_excess_of_others * least, [&](Index i, double distance) {
      is_clear = is_clear && (i == nearest || distance >= least_excess_of_others * least);
    });
    if (is_clear)
      positions[vertex] = numbers[nearest];
  }
  return positions;
}

} // namespace selvedge::internal
