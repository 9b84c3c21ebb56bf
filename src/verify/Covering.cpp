// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Covering.h"

#include "sides.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace selvedge::internal {
namespace {

/// Returns the number of a side, as `Neighbours` numbers them.
Index side_number(const Side& side)
{
  const std::size_t low = side.corner_at_low, high = side.corner_at_high;
  return Index(high % 3 == (low + 1) % 3 ? low : high);
}

template <class Predicate>
bool is_all(const std::array<int, 3>& signs, const Predicate& predicate)
{
  return std::all_of(signs.begin(), signs.end(), predicate);
}

/// Returns on which side of the line from `from` to `to` a point lies. It asks for the ends of the line,
/// where meshes often meet, before the predicate, which would compute with numbers of any length for them.
int side_of_line(const Kernel::Point_2& from, const Kernel::Point_2& to, const Kernel::Point_2& point)
{
  return point == from || point == to ? 0 : int(CGAL::orientation(from, to, point));
}

constexpr auto is_outside_or_on = [](int sign) { return sign <= 0; };
constexpr auto is_inside_or_on = [](int sign) { return sign >= 0; };

} // namespace

Neighbours::Neighbours(const Surface& surface) : m_surface(surface), m_next(3 * surface.triangles.size())
{
  std::iota(m_next.begin(), m_next.end(), Index(0));
  const std::vector<Side> sides = sides_between_positions(surface.points, surface.triangles);
  for (auto first = sides.begin(), side = first; side != sides.end(); ++side) {
    const auto next = side + 1;
    const bool is_last = next == sides.end() || next->low != side->low || next->high != side->high;
    m_next[side_number(*side)] = side_number(is_last ? *first : *next);
    if (is_last)
      first = next;
  }
}

Covering_search::Covering_search(const Neighbours& neighbours)
    : m_neighbours(neighbours), m_visited(neighbours.surface().triangles.size(), 0)
{
}

auto Covering_search::farthest(const std::array<Point_3, 3>& corners, const Index_triple& near, double limit)
    -> std::optional<Farthest>
{
  const std::size_t most = m_looks + 16'000;
  if (!set_plane(corners))
    return std::nullopt;
  const std::optional<Index> first = overlapping(near);
  if (!first)
    return std::nullopt;
  forget_visits();
  visit(*first);
  m_queue.assign(1, *first);
  Farthest result{corners[0], 0};
  for (std::size_t i = 0; i < m_queue.size(); ++i) {
    const Projection projection = projected(m_queue[i]);
    for (int side = 0; side < 3; ++side)
      if (crosses(projection, side)) {
        const std::optional<Index> beyond = neighbour_beyond(projection, side);
        if (!beyond || m_looks >= most)
          return std::nullopt;
        if (visit(*beyond))
          m_queue.push_back(*beyond);
      }
    find_farther(projection, result);
    if (result.squared_distance >= limit)
      return std::nullopt;
  }
  return result;
}

// Makes the plane of a triangle the one onto which triangles are projected, unless it has none.
bool Covering_search::set_plane(const std::array<Point_3, 3>& corners)
{
  m_origin = corners[0];
  const Vector_3 along = corners[1] - corners[0],
                 normal = CGAL::cross_product(along, corners[2] - corners[0]);
  const double length = std::sqrt(along.squared_length()), area = std::sqrt(normal.squared_length());
  if (!(length > 0 && area > 0))
    return false;
  m_x = along / length;
  m_y = CGAL::cross_product(normal / area, m_x);
  for (std::size_t i = 0; i < 3; ++i)
    m_corners[i] = projected(corners[i]);
  return CGAL::orientation(m_corners[0], m_corners[1], m_corners[2]) == CGAL::POSITIVE;
}

Kernel::Point_2 Covering_search::projected(const Point_3& point) const
{
  const Vector_3 from_origin = point - m_origin;
  return {from_origin * m_x, from_origin * m_y};
}

auto Covering_search::projected(Index triangle) -> Projection
{
  ++m_looks;
  const Surface& surface = m_neighbours.surface();
  Projection result;
  result.triangle = triangle;
  auto& own = result.corners;
  for (int j = 0; j < 3; ++j)
    own[j] = projected(surface.corner(triangle, j));
  result.turn = CGAL::orientation(own[0], own[1], own[2]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      result.at_given[i][j] = side_of_line(m_corners[i], m_corners[(i + 1) % 3], own[j]);
      result.at_this[i][j] = result.turn * side_of_line(own[i], own[(i + 1) % 3], m_corners[j]);
    }
  return result;
}

// Whether the interiors of the two triangles have a point in common: no line of either has the other one on
// its outer side.
bool Covering_search::overlaps(const Projection& projection)
{
  for (const auto* lines : {&projection.at_given, &projection.at_this})
    for (const auto& at_line : *lines)
      if (is_all(at_line, is_outside_or_on))
        return false;
  return true;
}

// Whether a side meets the interior of the given triangle: neither its line, nor one of the other's,
// separates them.
bool Covering_search::crosses(const Projection& projection, int side)
{
  const auto& at_line = projection.at_this[side];
  if (is_all(at_line, is_inside_or_on) || is_all(at_line, is_outside_or_on))
    return false;
  return std::none_of(projection.at_given.begin(), projection.at_given.end(), [side](const auto& corners) {
    return corners[side] <= 0 && corners[(side + 1) % 3] <= 0;
  });
}

// Returns a neighbour that lies on the other side of a side.
std::optional<Index> Covering_search::neighbour_beyond(const Projection& projection, int side)
{
  const Index own = 3 * projection.triangle + Index(side);
  for (Index other = m_neighbours.next_at_edge(own); other != own; other = m_neighbours.next_at_edge(other)) {
    ++m_looks;
    const Point_2 opposite = projected(m_neighbours.surface().corner(other / 3, (other % 3 + 2) % 3));
    const int turn =
        CGAL::orientation(projection.corners[side], projection.corners[(side + 1) % 3], opposite);
    if (turn * projection.turn < 0)
      return other / 3;
  }
  return std::nullopt;
}

// Returns a triangle whose projection overlaps the given one, out of the neighbourhood of some triangles.
std::optional<Index> Covering_search::overlapping(const Index_triple& near)
{
  constexpr std::size_t most = 32;
  forget_visits();
  m_queue.clear();
  for (const Index triangle : near)
    if (visit(triangle))
      m_queue.push_back(triangle);
  for (std::size_t i = 0; i < m_queue.size(); ++i) {
    const Index triangle = m_queue[i];
    if (overlaps(projected(triangle)))
      return triangle;
    for (Index side = 3 * triangle; side < 3 * triangle + 3; ++side)
      for (Index other = m_neighbours.next_at_edge(side); other != side;
           other = m_neighbours.next_at_edge(other)) {
        if (m_queue.size() == most)
          break;
        if (visit(other / 3))
          m_queue.push_back(other / 3);
      }
  }
  return std::nullopt;
}

// Cuts the given triangle to what lies below a triangle of the surface, and looks at the corners of that.
void Covering_search::find_farther(const Projection& projection, Farthest& farthest) const
{
  // A cut gives a convex polygon one more corner; rounding may make it one that is not convex, and twice as
  // many.
  std::array<Point_2, 3 * 2 * 2 * 2> polygon{m_corners[0], m_corners[1], m_corners[2]}, cut;
  std::size_t size = 3;
  for (int i = 0; i < 3; ++i) {
    const Point_2 &from = projection.corners[i], &to = projection.corners[(i + 1) % 3];
    const Kernel::Vector_2 along = to - from;
    // It is too large by more than its rounding, so that nothing is cut away that may be below the triangle:
    // cuts at any angle to a needle, which may be narrower than rounding, would otherwise leave nothing of
    // it.
    const auto inwards = [&](const Point_2& point) {
      const Kernel::Vector_2 offset = point - from;
      const double first = along.x() * offset.y(), second = along.y() * offset.x();
      return projection.turn * (first - second) + 1e-15 * (std::abs(first) + std::abs(second));
    };
    std::size_t count = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const Point_2 &corner = polygon[k], &next = polygon[(k + 1) % size];
      const double here = inwards(corner), there = inwards(next);
      if (here >= 0)
        cut[count++] = corner;
      if ((here > 0 && there < 0) || (here < 0 && there > 0))
        cut[count++] = corner + here / (here - there) * (next - corner);
    }
    polygon = cut;
    size = count;
  }
  const Triangle_3 above = m_neighbours.surface().triangle(projection.triangle);
  for (std::size_t k = 0; k < size; ++k) {
    const Point_3 point = m_origin + polygon[k].x() * m_x + polygon[k].y() * m_y;
    const double squared = CGAL::squared_distance(point, nearest_on_triangle(point, above));
    if (squared > farthest.squared_distance)
      farthest = {point, squared};
  }
}

bool Covering_search::visit(Index triangle)
{
  return std::exchange(m_visited[triangle], m_time) != m_time;
}

} // namespace selvedge::internal
