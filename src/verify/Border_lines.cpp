// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Border_lines.h"

#include "sides.h"

#include <algorithm>
#include <set>
#include <utility>

// Follows the border of a piece, for the judge to tell whether the piece is turned inside out.

namespace selvedge::internal {
namespace {

/// Returns the edges of one triangle as the triangles run.
std::vector<std::pair<Point_3, Point_3>> border_edges(const Surface& surface)
{
  std::vector<std::pair<Point_3, Point_3>> edges;
  const std::vector<Side> sides = sides_between_positions(surface.points, surface.triangles);
  for (auto first = sides.begin(), beyond = first; first != sides.end(); first = beyond) {
    beyond = std::find_if(first, sides.end(), [&](const Side& side) {
      return side.low != first->low || side.high != first->high;
    });
    if (beyond - first > 1)
      continue;
    const auto triangle = Index(first->corner_at_low / 3);
    const int low = int(first->corner_at_low % 3), high = int(first->corner_at_high % 3);
    edges.emplace_back(surface.corner(triangle, low), surface.corner(triangle, high));
    if (high != (low + 1) % 3)
      std::swap(edges.back().first, edges.back().second);
  }
  return edges;
}

} // namespace

Border_lines::Border_lines(const Surface& surface)
{
  std::map<Point_3, Point_3> next;
  std::set<Point_3> branching, targets;
  for (const auto& [from, to] : border_edges(surface))
    if (!next.emplace(from, to).second)
      branching.insert(from);
  for (const Point_3& point : branching)
    next.erase(point);
  for (const auto& edge : next)
    targets.insert(edge.second);

  const auto follow = [&](const Point_3& start) {
    Line line{0, false};
    auto edge = next.find(start);
    while (edge != next.end() && m_places.emplace(edge->first, Place{m_lines.size(), line.size}).second) {
      ++line.size;
      line.is_closed = edge->second == start;
      edge = next.find(edge->second);
    }
    m_lines.push_back(line);
  };
  for (const auto& edge : next)
    if (targets.count(edge.first) == 0)
      follow(edge.first);
  for (const auto& edge : next) // the others are closed
    if (m_places.count(edge.first) == 0)
      follow(edge.first);
}

int Border_lines::direction(const Place& from, const Place& to) const
{
  if (from.line != to.line)
    return 0;
  const auto [size, is_closed] = m_lines[from.line];
  if (!is_closed)
    return from.number < to.number ? 1 : -1;
  const std::size_t forwards = (to.number + size - from.number) % size, backwards = size - forwards;
  return int(forwards < backwards) - int(backwards < forwards);
}

bool Border_lines::are_followed_by(const Surface& other) const
{
  int sum = 0;
  for (const auto& edge : border_edges(other)) {
    const auto from = m_places.find(edge.first), to = m_places.find(edge.second);
    if (from != m_places.end() && to != m_places.end())
      sum += direction(from->second, to->second);
  }
  return sum > 0;
}

} // namespace selvedge::internal
