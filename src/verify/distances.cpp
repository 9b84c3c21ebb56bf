// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Diagonal.h"
#include "for_each_chunk.h"
#include "for_each_nearest.h"

#include <selvedge/verify.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

// Measures distances between two surfaces at vertices, for `verify`.

namespace selvedge {

using namespace internal;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The places at which a mesh has vertices. The mesh outlives the object.
class Places
{
public:
  explicit Places(const Triangle_soup& soup) : m_points(soup.points)
  {
    const std::vector<Index> vertices = used_vertices(soup);
    std::size_t size = 2;
    while (size < 2 * vertices.size())
      size *= 2;
    m_table.assign(size, s_none);
    for (const Index vertex : vertices)
      m_table[slot(m_points[vertex])] = vertex;
  }

  bool contain(const Point_3& p) const { return m_table[slot(p)] != s_none; }

private:
  static constexpr Index s_none = std::numeric_limits<Index>::max();

  // Returns where a vertex at the place is in the table, or where it would be.
  std::size_t slot(const Point_3& p) const
  {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate = p[axis] + 0.0; // −0 is 0
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (m_table.size() - 1);
    while (m_table[slot] != s_none && m_points[m_table[slot]] != p)
      slot = (slot + 1) & (m_table.size() - 1);
    return slot;
  }

  const std::vector<Point_3>& m_points;
  std::vector<Index> m_table; // of vertices, one at each place; half of it or more is empty
};

/// The vertices of one mesh and their squared distances from the surface of another, in an order that depends
/// on nothing but the meshes. The distances are in units of 2^(2 × exponent).
struct Squared_distances
{
  std::vector<Index> vertices;
  std::vector<double> values;
  int exponent;
};

Squared_distances squared_distances_of_vertices(const Triangle_soup& from, const Triangle_soup& to)
{
  Squared_distances result{used_vertices(from), {}, 0};
  result.values.resize(result.vertices.size());
  // Where the other mesh has a vertex, too, no surface need be searched. After collapses to either end, that
  // is so at all vertices of the result.
  std::vector<char> is_there(from.points.size(), false);
  const Places places(to);
  for_each_chunk(result.vertices.size(), 4096, [&](std::size_t, std::size_t first, std::size_t beyond) {
    for (std::size_t i = first; i < beyond; ++i)
      is_there[result.vertices[i]] = places.contain(from.points[result.vertices[i]]);
  });
  const auto first_there = std::stable_partition(result.vertices.begin(), result.vertices.end(),
                                                 [&](Index vertex) { return is_there[vertex] == 0; });
  const std::vector<Index> elsewhere(result.vertices.begin(), first_there);
  if (elsewhere.empty())
    return result;
  result.exponent = common_exponent(from, to);
  const Point_3 origin = to.points[to.triangles[0][0]];
  const Surface source(from, result.exponent, origin), surface(to, result.exponent, origin);
  for_each_nearest(elsewhere, source, Surface_tree(surface),
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
