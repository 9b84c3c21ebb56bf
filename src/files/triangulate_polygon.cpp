// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/triangulate_polygon.h"

#include <selvedge/Cancellation_scope.h>

#include <CGAL/Bbox_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

// Cuts the polygons of a file into triangles when it is read; all signs are exact.

namespace selvedge::files {
namespace {

using Point_2 = Kernel::Point_2;
using Triangle = std::array<Point_2, 3>;

/// Returns the coordinate axis along which the polygon looks largest. Rounding may select another one of
/// nearly the same size; any axis is good along which ears can be cut.
int widest_view(const std::vector<Point_3>& points, const std::vector<Index>& corners)
{
  // Coordinates are brought to one size, at which areas neither overflow nor vanish.
  double largest = 0;
  for (const Index corner : corners)
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(points[corner][axis]));
  int exponent = 0;
  std::frexp(largest, &exponent);
  const auto from_first = [&, &first = points[corners[0]]](Index corner) {
    const auto side = [&](int axis) {
      return std::ldexp(points[corner][axis], -exponent) - std::ldexp(first[axis], -exponent);
    };
    return Kernel::Vector_3(side(0), side(1), side(2));
  };
  std::array<double, 3> area = {0, 0, 0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Kernel::Vector_3 normal = CGAL::cross_product(from_first(corners[i]), from_first(corners[i + 1]));
    for (int axis = 0; axis < 3; ++axis)
      area[axis] += normal[axis];
  }
  int widest = 2;
  for (const int axis : {0, 1})
    if (std::abs(area[axis]) > std::abs(area[widest]))
      widest = axis;
  return widest;
}

/// Tells whether some points of the plane lie in a triangle, by a tree of boxes.
class Points_in_plane
{
public:
  explicit Points_in_plane(std::vector<Point_2> points)
      : m_points(std::move(points)), m_boxes(m_points.size())
  {
    halve(0, m_points.size(), 0);
  }

  /// Returns whether a point lies in a triangle or on its sides, but not at a corner. The corners turn left.
  bool is_any_in(const Triangle& triangle) const { return is_any_in(triangle, 0, m_points.size()); }

private:
  static constexpr std::size_t s_few = 8;

  // Puts the point in the middle of a range between two halves, along the two axes in turn.
  void halve(std::size_t first, std::size_t beyond, int axis)
  {
    if (beyond - first <= s_few)
      return;
    const std::size_t middle = (first + beyond) / 2;
    const auto at = [&](std::size_t place) { return m_points.begin() + std::ptrdiff_t(place); };
    m_boxes[middle] = CGAL::bbox_2(at(first), at(beyond));
    std::nth_element(at(first), at(middle), at(beyond),
                     [axis](const Point_2& p, const Point_2& q) { return p[axis] < q[axis]; });
    halve(first, middle, 1 - axis);
    halve(middle + 1, beyond, 1 - axis);
  }

  bool is_any_in(const Triangle& triangle, std::size_t first, std::size_t beyond) const
  {
    const auto& [a, b, c] = triangle;
    const auto is_in = [&, &a = a, &b = b, &c = c](const Point_2& p) {
      return p != a && p != b && p != c && !CGAL::right_turn(a, b, p) && !CGAL::right_turn(b, c, p) &&
             !CGAL::right_turn(c, a, p);
    };
    if (beyond - first <= s_few)
      return std::any_of(m_points.data() + first, m_points.data() + beyond, is_in);
    const std::size_t middle = (first + beyond) / 2;
    const CGAL::Bbox_2& box = m_boxes[middle];
    return CGAL::do_overlap(box, CGAL::bbox_2(triangle.begin(), triangle.end())) && !is_beyond(a, b, box) &&
           !is_beyond(b, c, box) && !is_beyond(c, a, box) &&
           (is_in(m_points[middle]) || is_any_in(triangle, first, middle) ||
            is_any_in(triangle, middle + 1, beyond));
  }

  // Returns whether a box lies to the right of the way from a to b.
  static bool is_beyond(const Point_2& a, const Point_2& b, const CGAL::Bbox_2& box)
  {
    const Point_2 leftmost(b.y() > a.y() ? box.xmin() : box.xmax(), b.x() > a.x() ? box.ymax() : box.ymin());
    return CGAL::right_turn(a, b, leftmost);
  }

  std::vector<Point_2> m_points;
  std::vector<CGAL::Bbox_2> m_boxes; // of ranges of more than a few points, by the place of their middle
};

/// Cuts ears off a polygon of the plane until a triangle remains; false when that fails. It never fails for a
/// simple polygon, because any triangulation of one has two ears, and cutting one leaves a simple polygon.
bool cut_ears(const std::vector<Point_2>& points, std::vector<Index_triple>& triangles)
{
  const Index size = static_cast<Index>(points.size());
  std::vector<Index> previous(size), next(size);
  for (Index i = 0; i < size; ++i) {
    next[i] = (i + 1) % size;
    previous[next[i]] = i;
  }
  const auto turn_at = [&](Index i) {
    return CGAL::orientation(points[previous[i]], points[i], points[next[i]]);
  };
  const auto lowest = std::min_element(points.begin(), points.end());
  const CGAL::Orientation inside = turn_at(static_cast<Index>(lowest - points.begin()));
  if (inside == CGAL::COLLINEAR)
    return false;

  // Only reflex and straight corners can obstruct an ear, and cutting ears makes no new ones.
  std::vector<Point_2> obstacles;
  for (Index i = 0; i < size; ++i)
    if (turn_at(i) != inside)
      obstacles.push_back(points[i]);
  const Points_in_plane in_the_way(std::move(obstacles));
  const auto is_ear = [&](Index i) {
    if (turn_at(i) != inside)
      return false;
    const bool is_left = inside == CGAL::LEFT_TURN;
    return !in_the_way.is_any_in(
        {points[is_left ? previous[i] : next[i]], points[i], points[is_left ? next[i] : previous[i]]});
  };

  // Walks around and around. A corner that is no ear stays so until one of its neighbours is cut off: `turn`
  // is when the walk comes to one that may be an ear, in steps from corner 0.
  std::vector<std::size_t> steps(size);
  std::iota(steps.begin(), steps.end(), std::size_t(1));
  std::priority_queue turns(std::greater<>(), std::move(steps));
  std::vector<char> has_turn(size, true);
  Index corner = 1;
  for (Index left = size; left > 3;) {
    if (size > 1000) // each look at a corner may take this many steps
      Cancellation_scope::check();
    if (turns.empty())
      return false;
    const std::size_t turn = turns.top();
    turns.pop();
    corner = Index(turn % size);
    has_turn[corner] = false;
    if (!is_ear(corner))
      continue;
    const Index following = next[corner], preceding = previous[corner];
    triangles.push_back({preceding, corner, following});
    next[preceding] = following;
    previous[following] = preceding;
    for (const Index neighbour : {preceding, following})
      if (!std::exchange(has_turn[neighbour], true))
        turns.push(turn - corner + neighbour + (neighbour < corner ? size : 0));
    corner = following;
    --left;
  }
  triangles.push_back({previous[corner], corner, next[corner]});
  return turn_at(corner) == inside;
}

} // namespace

std::vector<Index_triple> triangulate_polygon(const std::vector<Point_3>& points,
                                              const std::vector<Index>& corners)
{
  const int widest = widest_view(points, corners);
  std::vector<Index_triple> triangles;
  std::vector<Point_2> projected(corners.size());
  for (int view = 0; view < 3; ++view) {
    const int axis = (widest + view) % 3;
    std::transform(corners.begin(), corners.end(), projected.begin(),
                   [&](Index i) { return Point_2(points[i][(axis + 1) % 3], points[i][(axis + 2) % 3]); });
    triangles.clear();
    if (cut_ears(projected, triangles))
      return triangles;
  }
  triangles.clear();
  for (Index i = 1; i + 1 < corners.size(); ++i)
    triangles.push_back({0, i, i + 1});
  return triangles;
}

} // namespace selvedge::files
