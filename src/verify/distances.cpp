// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Covering.h"
#include "Surface_tree.h"
#include "for_each_chunk.h"
#include "sides.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/compare.h>
#include <selvedge/verify.h>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

// Measures distances between two surfaces: at vertices, for `verify`, and anywhere with two bounds, for
// `compare`.

namespace selvedge {

using namespace internal;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls `function(i, vertex, nearest)` concurrently for each of some vertices, with the point of `to` that
/// is nearest to it; i is its place in an order in which neighbours follow each other, so that the last
/// answer is a good guess at the next. The answers depend on nothing but the arguments.
template <class Function>
void for_each_nearest(const std::vector<Index>& vertices, const Surface& from, const Surface_tree& to,
                      const Function& function)
{
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
  for_each_chunk(queries.size(), 1024, [&](std::size_t, std::size_t first, std::size_t beyond) {
    Index guess = 0;
    for (std::size_t i = first; i < beyond; ++i) {
      const Index vertex = queries[i].number;
      const Surface_tree::Nearest nearest = to.nearest(from.points[vertex], guess);
      function(i, vertex, nearest);
      guess = nearest.triangle;
    }
  });
}

/// The vertices of one mesh, in an order in which neighbours follow each other, and their squared distances
/// from the surface of another. These are in units of 2^(2 × exponent).
struct Squared_distances
{
  std::vector<Index> vertices;
  std::vector<double> values;
  int exponent;
};

Squared_distances squared_distances_of_vertices(const Triangle_soup& from, const Triangle_soup& to)
{
  const int exponent = common_exponent(from, to);
  const Point_3 origin = to.points[to.triangles[0][0]];
  const Surface source(from, exponent, origin), surface(to, exponent, origin);
  const std::vector<Index> vertices = used_vertices(from);
  Squared_distances result{std::vector<Index>(vertices.size()), std::vector<double>(vertices.size()),
                           exponent};
  for_each_nearest(vertices, source, Surface_tree(surface),
                   [&](std::size_t i, Index vertex, const Surface_tree::Nearest& nearest) {
                     result.vertices[i] = vertex;
                     result.values[i] = CGAL::squared_distance(source.points[vertex], nearest.point);
                   });
  return result;
}

/// A part of a triangle: its corners, and for each the nearest triangle of the other mesh.
struct Part
{
  std::array<Point_3, 3> corners;
  Index_triple nearest;
  double upper = infinity; // bound of the squared distance from any point of the part
  int cuts = 0;
  std::optional<Point_3> farthest = {}; // a point that may be as far as `upper` says, until it is asked for

  bool operator<(const Part& other) const { return upper < other.upper; }
};

/// Returns an upper bound of the squared distance from any point of a part to `to`. The distance to one
/// triangle is convex, so it is largest at a corner.
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

/// Returns a point of a segment that is equally far from two triangles, or none.
std::optional<Point_3> equally_far(const Point_3& from, const Point_3& to, const Triangle_3& of_from,
                                   const Triangle_3& of_to)
{
  const auto excess = [&](double position) {
    const Point_3 point = from + position * (to - from);
    return CGAL::squared_distance(point, nearest_on_triangle(point, of_from)) -
           CGAL::squared_distance(point, nearest_on_triangle(point, of_to));
  };
  // A cut nearer to an end would leave a part almost as large as the whole.
  double low = 1 / 16.0, high = 15 / 16.0;
  if (excess(low) > 0 || excess(high) <= 0)
    return std::nullopt;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (excess(middle) <= 0 ? low : high) = middle;
  }
  return from + low * (to - from);
}

/// Returns the side of a part to cut, by its first corner, and the point of the cut: where the nearest
/// triangle changes, so that each half comes to lie over one triangle; else, and in every second cut, the
/// middle of the longest side.
std::pair<int, Point_3> cut_of(const Part& part, const Surface& to)
{
  std::array<int, 3> sides = {0, 1, 2};
  const auto length = [&](int side) {
    return CGAL::squared_distance(part.corners[side], part.corners[(side + 1) % 3]);
  };
  std::sort(sides.begin(), sides.end(), [&](int a, int b) { return length(a) > length(b); });
  for (const int side : sides) {
    if (part.cuts % 2 == 1)
      break;
    const int end = (side + 1) % 3;
    if (part.nearest[side] != part.nearest[end] && part.corners[side] != part.corners[end])
      if (const auto point = equally_far(part.corners[side], part.corners[end],
                                         to.triangle(part.nearest[side]), to.triangle(part.nearest[end])))
        return {side, *point};
  }
  const int end = (sides[0] + 1) % 3;
  return {sides[0], CGAL::midpoint(part.corners[sides[0]], part.corners[end])};
}

} // namespace

std::vector<double> vertex_distances(const Triangle_soup& from, const Triangle_soup& to)
{
  std::vector<double> distances(from.points.size(), 0);
  if (from.triangles.empty())
    return distances;
  if (to.triangles.empty()) {
    for (const Index vertex : used_vertices(from))
      distances[vertex] = infinity;
    return distances;
  }
  const auto [order, squared, exponent] = squared_distances_of_vertices(from, to);
  for (std::size_t i = 0; i < order.size(); ++i)
    distances[order[i]] = std::ldexp(std::sqrt(squared[i]), exponent);
  return distances;
}

Distance distance(const Triangle_soup& from, const Triangle_soup& to)
{
  if (from.triangles.empty())
    return {0, 0};
  if (to.triangles.empty())
    return {infinity, infinity};

  const auto [vertices, squared_distances, exponent] = squared_distances_of_vertices(from, to);
  // Summed in a fixed order, whatever the threads do.
  const double sum = std::accumulate(squared_distances.begin(), squared_distances.end(), 0.0);
  const auto maximum = std::max_element(squared_distances.begin(), squared_distances.end());
  const double mean = sum / static_cast<double>(vertices.size());
  return {std::ldexp(std::sqrt(mean), exponent), std::ldexp(std::sqrt(*maximum), exponent),
          vertices[std::size_t(maximum - squared_distances.begin())]};
}

Bounds maximum_distance(const Triangle_soup& from, const Triangle_soup& to)
{
  if (from.triangles.empty())
    return {0, 0};
  if (to.triangles.empty())
    return {infinity, infinity};

  const int exponent = common_exponent(from, to);
  const Point_3 origin = to.points[to.triangles[0][0]];
  const Surface source(from, exponent, origin), surface(to, exponent, origin);
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

  CGAL::Bbox_3 box;
  for (const Index vertex : vertices)
    box += source.points[vertex].bbox();
  const double negligible = 1e-6 * std::max({box.x_span(), box.y_span(), box.z_span()});
  const auto good_enough = [&] {
    const double length = std::sqrt(lower);
    const double enough = length + std::max(0.01 * length, negligible);
    return enough * enough;
  };
  // A segment, as of borders and seams, is not covered.
  std::optional<Neighbours> neighbours;
  if (std::any_of(source.triangles.begin(), source.triangles.end(), is_face))
    neighbours.emplace(surface);
  // Where coverings fail, as on a surface in shreds, they could be tried for hours.
  const auto bound = [&](Part& part, std::optional<Covering_search>& search, std::size_t& looks_left) {
    part.upper = upper_bound(part, surface);
    part.farthest.reset();
    if (!neighbours || looks_left == 0 || !(part.upper > good_enough()))
      return;
    if (!search)
      search.emplace(*neighbours);
    const std::size_t looks_before = search->looks();
    if (const auto farthest = search->farthest(part.corners, part.nearest, part.upper)) {
      part.upper = farthest->squared_distance;
      part.farthest = farthest->point;
    }
    looks_left -= std::min(looks_left, search->looks() - looks_before);
  };

  tbb::enumerable_thread_specific<std::optional<Covering_search>> searches;
  constexpr std::size_t chunk = 4096;
  const std::size_t count = source.triangles.size();
  const std::size_t looks = 10'000'000 + 32 * (count + surface.triangles.size());
  std::vector<std::vector<Part>> parts_of_chunks(chunk_count(count, chunk));
  std::vector<double> upper_of_chunks(parts_of_chunks.size(), lower); // of what is good enough
  for_each_chunk(count, chunk, [&](std::size_t number, std::size_t first, std::size_t beyond) {
    auto& search = searches.local();
    std::size_t looks_left = looks / parts_of_chunks.size();
    for (std::size_t i = first; i < beyond; ++i) {
      const auto& [a, b, c] = source.triangles[i];
      Part part{{source.points[a], source.points[b], source.points[c]}, {nearest[a], nearest[b], nearest[c]}};
      bound(part, search, looks_left);
      if (part.upper > good_enough())
        parts_of_chunks[number].push_back(part);
      else
        upper_of_chunks[number] = std::max(upper_of_chunks[number], part.upper);
    }
  });
  double upper = *std::max_element(upper_of_chunks.begin(), upper_of_chunks.end());
  std::priority_queue<Part> parts;
  for (std::vector<Part>& of_chunk : parts_of_chunks)
    for (const Part& part : std::exchange(of_chunk, {}))
      parts.push(part);

  Cancellation_poll poll;
  auto& search = searches.local();
  std::size_t budget = count + 500'000, looks_left = looks;
  for (; !parts.empty() && parts.top().upper > good_enough() && budget > 0; --budget) {
    poll();
    Part part = parts.top();
    parts.pop();
    if (const auto farthest = std::exchange(part.farthest, {})) {
      const Point_3 nearest_to_it = tree.nearest(*farthest, part.nearest[0]).point;
      lower = std::max(lower, CGAL::squared_distance(*farthest, nearest_to_it));
      parts.push(part);
      continue;
    }
    const auto [place, point] = cut_of(part, surface);
    const Surface_tree::Nearest to_point = tree.nearest(point, part.nearest[place]);
    lower = std::max(lower, CGAL::squared_distance(point, to_point.point));
    for (const int replaced : {place, (place + 1) % 3}) {
      Part half = part;
      ++half.cuts;
      for (int k = 0; k < 3; ++k) // a triangle (a, b, b), which is a segment, has two corners at one end
        if (part.corners[k] == part.corners[replaced]) {
          half.corners[k] = point;
          half.nearest[k] = to_point.triangle;
        }
      bound(half, search, looks_left);
      if (half.upper > good_enough())
        parts.push(half);
      else
        upper = std::max(upper, half.upper);
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
    return Distance{d.root_mean_square / unit, d.maximum / unit, d.farthest};
  };
  return {relative(distance(original, result)), relative(distance(result, original)), diagonal};
}

} // namespace selvedge
