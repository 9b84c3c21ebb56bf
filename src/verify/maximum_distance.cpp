// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Covering.h"
#include "Surface_tree.h"
#include "for_each_chunk.h"
#include "for_each_nearest.h"
#include "sides.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/compare.h>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

// Bounds the largest distance from any point of one mesh to another, for `compare`.

namespace selvedge {

using namespace internal;

namespace {

/// A part of a triangle: its corners, and for each the nearest triangle of the other mesh.
struct Part
{
  std::array<Point_3, 3> corners;
  Index_triple nearest;
  double upper =
      std::numeric_limits<double>::infinity(); // bound of the squared distance from any point of the part
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

/// Returns a point of a segment that is equally far from two triangles, or none. It is no nearer to either
/// end than a share of the way.
std::optional<Point_3> equally_far(const Point_3& from, const Point_3& to, const Triangle_3& of_from,
                                   const Triangle_3& of_to, double least_share)
{
  const auto excess = [&](double position) {
    const Point_3 point = from + position * (to - from);
    return CGAL::squared_distance(point, nearest_on_triangle(point, of_from)) -
           CGAL::squared_distance(point, nearest_on_triangle(point, of_to));
  };
  double low = least_share, high = 1 - least_share;
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
/// middle of the longest side. A cut near an end leaves a part almost as large as the whole, so that others
/// are preferred; but along a strip that is far narrower than the part, there is no other.
std::pair<int, Point_3> cut_of(const Part& part, const Surface& to)
{
  std::array<int, 3> sides = {0, 1, 2};
  const auto length = [&](int side) {
    return CGAL::squared_distance(part.corners[side], part.corners[(side + 1) % 3]);
  };
  std::sort(sides.begin(), sides.end(), [&](int a, int b) { return length(a) > length(b); });
  if (part.cuts % 2 == 0)
    for (const double least_share : {0x1p-4, 0x1p-20})
      for (const int side : sides) {
        const int end = (side + 1) % 3;
        if (part.nearest[side] != part.nearest[end] && part.corners[side] != part.corners[end])
          if (const auto point =
                  equally_far(part.corners[side], part.corners[end], to.triangle(part.nearest[side]),
                              to.triangle(part.nearest[end]), least_share))
            return {side, *point};
      }
  const int end = (sides[0] + 1) % 3;
  return {sides[0], CGAL::midpoint(part.corners[sides[0]], part.corners[end])};
}

/// Looks for the point of one surface that is farthest from another. All distances are squared.
class Farthest_point_search
{
public:
  /// Begins with the vertices, which are listed. No point is looked for that is nearer than `known`. Both
  /// surfaces outlive the search.
  Farthest_point_search(const Surface& from, const Surface& to, const std::vector<Index>& vertices,
                        double known)
      : m_from(from), m_to(to), m_tree(to), m_nearest(from.points.size()),
        m_points_left(from.triangles.size() + 500'000),
        m_looks(10'000'000 + 32 * (from.triangles.size() + to.triangles.size()))
  {
    std::vector<double> distances(vertices.size());
    for_each_nearest(vertices, from, m_tree,
                     [&](std::size_t i, Index vertex, const Surface_tree::Nearest& found) {
                       m_nearest[vertex] = found.triangle;
                       distances[i] = CGAL::squared_distance(from.points[vertex], found.point);
                     });
    m_lower = m_upper = std::max(known, *std::max_element(distances.begin(), distances.end()));
    CGAL::Bbox_3 box;
    for (const Index vertex : vertices)
      box += from.points[vertex].bbox();
    m_negligible = 1e-6 * std::max({box.x_span(), box.y_span(), box.z_span()});
    // A segment, as of borders and seams, is not covered.
    if (std::any_of(from.triangles.begin(), from.triangles.end(), is_face))
      m_neighbours.emplace(to);
  }

  void run()
  {
    bound_triangles();
    Cancellation_poll poll;
    Search& search = m_searches.local();
    std::size_t looks_left = m_looks;
    while (m_points_left > 0 && is_promising()) {
      poll();
      Part part = m_parts.top();
      m_parts.pop();
      if (const auto farthest = std::exchange(part.farthest, {})) {
        see(*farthest, part.nearest[0]);
        m_parts.push(part);
      } else {
        divide(part, search, looks_left);
      }
    }
    if (!m_parts.empty())
      m_upper = std::max(m_upper, m_parts.top().upper);
  }

  /// The distance of the farthest point that was looked at, or the one known.
  double lower() const { return m_lower; }
  /// A bound of the distance of any point.
  double upper() const { return std::max(m_lower, m_upper); }

private:
  using Search = std::optional<Covering_search>; // of a thread, made when it is first needed

  // The bound with which a part need not be examined.
  double good_enough() const
  {
    const double length = std::sqrt(m_lower), enough = length + std::max(0.01 * length, m_negligible);
    return enough * enough;
  }
  bool is_promising() const { return !m_parts.empty() && m_parts.top().upper > good_enough(); }

  // Looks at a point. Returns the triangle nearest to it. Where triangles crowd in each other's boxes, one
  // may cost as much as many.
  Index see(const Point_3& point, Index guess)
  {
    constexpr std::size_t usual_looks = 1000;
    const Surface_tree::Nearest nearest = m_tree.nearest(point, guess);
    m_points_left -= std::min(m_points_left, 1 + nearest.looks / usual_looks);
    m_lower = std::max(m_lower, CGAL::squared_distance(point, nearest.point));
    return nearest.triangle;
  }

  // Bounds the distance of a part. Where coverings fail, as on a surface in shreds, they could be tried for
  // hours; so there are only so many looks at triangles.
  void bound(Part& part, Search& search, std::size_t& looks_left) const
  {
    part.upper = upper_bound(part, m_to);
    part.farthest.reset();
    if (!m_neighbours || looks_left == 0 || !(part.upper > good_enough()))
      return;
    if (!search)
      search.emplace(*m_neighbours);
    const std::size_t looks_before = search->looks();
    if (const auto farthest = search->farthest(part.corners, part.nearest, part.upper)) {
      part.upper = farthest->squared_distance;
      part.farthest = farthest->point;
    }
    looks_left -= std::min(looks_left, search->looks() - looks_before);
  }

  void bound_triangles()
  {
    constexpr std::size_t chunk = 4096;
    const std::size_t count = m_from.triangles.size();
    std::vector<std::vector<Part>> parts(chunk_count(count, chunk));
    std::vector<double> upper(parts.size(), m_upper); // of what is good enough
    for_each_chunk(count, chunk, [&](std::size_t number, std::size_t first, std::size_t beyond) {
      Search& search = m_searches.local();
      std::size_t looks_left = m_looks / parts.size();
      for (std::size_t i = first; i < beyond; ++i) {
        const auto& [a, b, c] = m_from.triangles[i];
        Part part{{m_from.points[a], m_from.points[b], m_from.points[c]},
                  {m_nearest[a], m_nearest[b], m_nearest[c]}};
        bound(part, search, looks_left);
        if (part.upper > good_enough())
          parts[number].push_back(part);
        else
          upper[number] = std::max(upper[number], part.upper);
      }
    });
    m_upper = *std::max_element(upper.begin(), upper.end());
    for (std::vector<Part>& of_chunk : parts)
      for (const Part& part : std::exchange(of_chunk, {}))
        m_parts.push(part);
  }

  void divide(const Part& part, Search& search, std::size_t& looks_left)
  {
    const auto [place, point] = cut_of(part, m_to);
    const Index nearest = see(point, part.nearest[place]);
    for (const int replaced : {place, (place + 1) % 3}) {
      Part half = part;
      ++half.cuts;
      for (int k = 0; k < 3; ++k) // a triangle (a, b, b), which is a segment, has two corners at one end
        if (part.corners[k] == part.corners[replaced]) {
          half.corners[k] = point;
          half.nearest[k] = nearest;
        }
      bound(half, search, looks_left);
      if (half.upper > good_enough())
        m_parts.push(half);
      else
        m_upper = std::max(m_upper, half.upper);
    }
  }

  const Surface &m_from, &m_to;
  Surface_tree m_tree;
  std::vector<Index> m_nearest; // by vertex: the triangle nearest to it
  double m_negligible;          // a length
  double m_lower, m_upper;      // the latter of the parts that are no longer examined
  std::optional<Neighbours> m_neighbours;
  std::size_t m_points_left;
  std::size_t m_looks;
  tbb::enumerable_thread_specific<Search> m_searches;
  std::priority_queue<Part> m_parts;
};

} // namespace

Bounds maximum_distance(const Triangle_soup& from, const Triangle_soup& to, const Bounds& of_others)
{
  if (from.triangles.empty())
    return of_others;
  if (to.triangles.empty())
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const int exponent = common_exponent(from, to);
  const double known = std::ldexp(of_others.lower, -exponent);
  if (known > 4) // no two points are farther apart than 2 √3
    return of_others;
  const Point_3 origin = to.points[to.triangles[0][0]];
  const Surface source(from, exponent, origin), surface(to, exponent, origin);
  Farthest_point_search search(source, surface, used_vertices(from), known * known);
  search.run();
  const auto length = [&](double squared) { return std::ldexp(std::sqrt(squared), exponent); };
  return {search.lower() > known * known ? length(search.lower()) : of_others.lower,
          std::max(length(search.upper()), of_others.upper)};
}

} // namespace selvedge
