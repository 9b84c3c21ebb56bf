// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Surface_tree.h"

#include <selvedge/compare.h>
#include <selvedge/verify.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

namespace selvedge {

using namespace internal;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls `function(i, vertex, nearest)` for the i-th of some vertices, with what is nearest to it: in an
/// order in which neighbours follow each other, so that the last answer is a good guess at the next, and
/// concurrently. The answers depend on nothing but the arguments.
template <class Function>
void for_each_nearest(const std::vector<Index>& vertices, const Surface& from, const Surface_tree& to,
                      const Function& function)
{
  constexpr std::size_t chunk = 1024;
  std::vector<Numbered_point> queries;
  queries.reserve(vertices.size());
  for (const Index vertex : vertices) {
    const Point_3& point = from.points[vertex];
    queries.push_back({{point.x(), point.y(), point.z()}, vertex});
  }
  std::size_t parts = 1;
  while (4 * parts < queries.size())
    parts *= 2;
  sort_by_halves(queries, parts);
  tbb::parallel_for(std::size_t(0), (queries.size() + chunk - 1) / chunk, [&](std::size_t number) {
    Index guess = 0;
    for (std::size_t i = chunk * number; i < (std::min)(chunk * (number + 1), queries.size()); ++i) {
      const Index vertex = queries[i].number;
      const Surface_tree::Nearest nearest = to.nearest(from.points[vertex], guess);
      function(i, vertex, nearest);
      guess = nearest.triangle;
    }
  });
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
  const Surface source(from, exponent), surface(to, exponent);
  const std::vector<Index> vertices = used_vertices(from);
  std::vector<double> squared_distances(vertices.size());
  for_each_nearest(vertices, source, Surface_tree(surface),
                   [&](std::size_t i, Index vertex, const Surface_tree::Nearest& nearest) {
                     squared_distances[i] = CGAL::squared_distance(source.points[vertex], nearest.point);
                   });
  // In one order, whichever came first.
  const double sum = std::accumulate(squared_distances.begin(), squared_distances.end(), 0.0);
  const double maximum = *std::max_element(squared_distances.begin(), squared_distances.end());
  const double mean = sum / static_cast<double>(vertices.size());
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
  const Surface_tree tree(surface);
  const std::vector<Index> vertices = used_vertices(from);
  std::vector<Index> nearest(source.points.size());
  std::vector<double> squared_distances(vertices.size());
  for_each_nearest(vertices, source, tree,
                   [&](std::size_t i, Index vertex, const Surface_tree::Nearest& found) {
                     nearest[vertex] = found.triangle;
                     squared_distances[i] = CGAL::squared_distance(source.points[vertex], found.point);
                   });
  double lower = *std::max_element(squared_distances.begin(), squared_distances.end());

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
    const Surface_tree::Nearest to_middle = tree.nearest(middle, part.nearest[longest]);
    lower = std::max(lower, CGAL::squared_distance(middle, to_middle.point));
    for (const int replaced : {longest, end}) {
      Part half = part;
      for (int place = 0; place < 3; ++place) // a segment has two corners at one end
        if (part.corners[place] == part.corners[replaced]) {
          half.corners[place] = middle;
          half.nearest[place] = to_middle.triangle;
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
