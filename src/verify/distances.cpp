// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Surface_tree.h"

#include <selvedge/compare.h>
#include <selvedge/verify.h>

#include <CGAL/Hilbert_sort_median_3.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace selvedge {

using namespace internal;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Neighbours follow each other along a space-filling curve, so that the last answer of a tree is a good
/// guess at the next.
void sort_along_curve(std::vector<Index>& vertices, const std::vector<Point_3>& points)
{
  using Map = CGAL::Pointer_property_map<Point_3>::const_type;
  using Traits = CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>;
  const CGAL::Hilbert_sort_median_3<Traits, CGAL::Sequential_tag> sort(
      Traits(CGAL::make_property_map(points)));
  sort(vertices.begin(), vertices.end());
}

/// A part of a triangle: its corners, and for each the nearest triangle of the other mesh.
struct Part
{
  std::array<Point_3, 3> corners;
  Index_triple nearest;
  double upper; // of the squared distance

  bool operator<(const Part& other) const { return upper < other.upper; }
};

/// The distance to one convex set is convex, so it is largest at a corner.
double upper_bound(const Part& part, const Surface& to)
{
  double bound = part.upper;
  for (const Index triangle : part.nearest) {
    double largest = 0;
    for (const Point_3& corner : part.corners)
      largest = std::max(largest,
                         CGAL::squared_distance(corner, nearest_on_triangle(corner, to.triangle(triangle))));
    bound = std::min(bound, largest);
  }
  return bound;
}

} // namespace

Distance distance(const Triangle_soup& from, const Triangle_soup& to)
{
  if (from.triangles.empty())
    return {0, 0};
  if (to.triangles.empty())
    return {infinity, infinity};

  const int exponent = common_exponent(from, to);
  const Surface surface(to, exponent);
  Surface_tree tree(surface);
  std::vector<Point_3> queries;
  for (const Index vertex : used_vertices(from))
    queries.push_back(scaled(from.points[vertex], -exponent));
  CGAL::hilbert_sort(queries.begin(), queries.end());
  double sum = 0, maximum = 0;
  for (const Point_3& query : queries) {
    const double squared_distance = CGAL::squared_distance(query, tree.nearest(query).point);
    sum += squared_distance;
    maximum = std::max(maximum, squared_distance);
  }
  const double mean = sum / static_cast<double>(queries.size());
  return {std::ldexp(std::sqrt(mean), exponent), std::ldexp(std::sqrt(maximum), exponent)};
}

Bounds maximum_distance(const Triangle_soup& from, const Triangle_soup& to)
{
  if (from.triangles.empty())
    return {0, 0};
  if (to.triangles.empty())
    return {infinity, infinity};

  const int exponent = common_exponent(from, to);
  const Surface source(from, exponent), surface(to, exponent);
  Surface_tree tree(surface);
  double lower = 0;
  const auto look_at = [&](const Point_3& point, Index guess) {
    const Surface_tree::Nearest nearest = tree.nearest(point, guess);
    lower = std::max(lower, CGAL::squared_distance(point, nearest.point));
    return nearest.triangle;
  };
  std::vector<Index> nearest(source.points.size());
  std::vector<Index> vertices = used_vertices(from);
  sort_along_curve(vertices, source.points);
  Index guess = 0;
  for (const Index vertex : vertices)
    guess = nearest[vertex] = look_at(source.points[vertex], guess);

  // Bounds that differ by a hundredth are good enough, and so are those that differ by rounding.
  const auto good_enough = [&] {
    const double length = std::sqrt(lower);
    const double enough = length + std::max(0.01 * length, 1e-9);
    return enough * enough;
  };
  std::priority_queue<Part> parts;
  const auto keep = [&](Part part) {
    part.upper = upper_bound(part, surface);
    if (part.upper > good_enough())
      parts.push(part);
    else
      return part.upper;
    return 0.0;
  };
  double upper = lower; // of what is no longer looked at
  for (const Index_triple& triangle : source.triangles) {
    const auto& [a, b, c] = triangle;
    upper = std::max(upper, keep({{source.points[a], source.points[b], source.points[c]},
                                  {nearest[a], nearest[b], nearest[c]},
                                  infinity}));
  }
  std::size_t budget = from.triangles.size() + 1'000'000;
  for (; !parts.empty() && parts.top().upper > good_enough() && budget > 0; --budget) {
    const Part part = parts.top();
    parts.pop();
    const auto length = [&](int place) {
      return CGAL::squared_distance(part.corners[place], part.corners[(place + 1) % 3]);
    };
    const int longest =
        length(0) < length(1) ? (length(1) < length(2) ? 2 : 1) : (length(0) < length(2) ? 2 : 0);
    const int end = (longest + 1) % 3;
    const Point_3 middle = CGAL::midpoint(part.corners[longest], part.corners[end]);
    const Index nearest_to_middle = look_at(middle, part.nearest[longest]);
    for (const int replaced : {longest, end}) {
      Part half = part;
      for (int place = 0; place < 3; ++place) // a segment has two corners at one end
        if (part.corners[place] == part.corners[replaced]) {
          half.corners[place] = middle;
          half.nearest[place] = nearest_to_middle;
        }
      upper = std::max(upper, keep(half));
    }
  }
  if (!parts.empty())
    upper = std::max(upper, parts.top().upper);
  return {std::ldexp(std::sqrt(lower), exponent), std::ldexp(std::sqrt(std::max(lower, upper)), exponent)};
}

Distances distances(const Triangle_soup& result, const Triangle_soup& original)
{
  CGAL::Bbox_3 box;
  for (const Index vertex : used_vertices(original))
    box += original.points[vertex].bbox();
  const double diagonal =
      original.triangles.empty() ? 0 : std::hypot(box.x_span(), box.y_span(), box.z_span());
  const double unit = diagonal > 0 ? diagonal : 1;
  const auto relative = [&](const Distance& d) {
    return Distance{d.root_mean_square / unit, d.maximum / unit};
  };
  return {relative(distance(original, result)), relative(distance(result, original)), diagonal};
}

} // namespace selvedge
