// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Diagonal.h"
#include "for_each_nearest.h"

#include <selvedge/verify.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

// Measures distances between two surfaces at vertices, for `verify`.

namespace selvedge {

using namespace internal;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

Distances distances(const Triangle_soup& result, const Triangle_soup& original)
{
  const Diagonal diagonal(original);
  const auto relative = [&](const Distance& d) {
    return Distance{diagonal.share(d.root_mean_square), diagonal.share(d.maximum), d.farthest};
  };
  return {relative(distance(original, result)), relative(distance(result, original)), diagonal.length()};
}

} // namespace selvedge
