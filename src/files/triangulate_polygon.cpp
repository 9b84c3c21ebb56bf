// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/triangulate_polygon.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <cmath>

// Cuts the polygons of a file into triangles when it is read; all signs are exact.

namespace selvedge::files {
namespace {

using Point_2 = Kernel::Point_2;

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
  std::vector<Index> obstacles;
  for (Index i = 0; i < size; ++i)
    if (turn_at(i) != inside)
      obstacles.push_back(i);
  const auto is_ear = [&](Index i) {
    if (turn_at(i) != inside)
      return false;
    const Point_2 &a = points[previous[i]], &b = points[i], &c = points[next[i]];
    return std::none_of(obstacles.begin(), obstacles.end(), [&](Index obstacle) {
      const Point_2& p = points[obstacle];
      return p != a && p != b && p != c && CGAL::orientation(a, b, p) != -inside &&
             CGAL::orientation(b, c, p) != -inside && CGAL::orientation(c, a, p) != -inside;
    });
  };

  // A corner that is no ear stays so until one of its neighbours is cut off.
  std::vector<char> is_refused(size, false);
  Index corner = 1, refused = 0;
  for (Index left = size; left > 3;) {
    if (size > 1000) // each look at a corner may take this many steps
      Cancellation_scope::check();
    const Index following = next[corner];
    if (!is_refused[corner] && is_ear(corner)) {
      triangles.push_back({previous[corner], corner, following});
      next[previous[corner]] = following;
      previous[following] = previous[corner];
      is_refused[following] = is_refused[previous[corner]] = false;
      --left;
      refused = 0;
    } else {
      is_refused[corner] = true;
      if (++refused == left)
        return false;
    }
    corner = following;
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
