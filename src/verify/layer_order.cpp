// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "layer_order.h"

#include "Surface_tree.h"
#include "face_samples.h"
#include "positions.h"

#include <selvedge/Cancellation_scope.h>

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

// Draws lines through the layers of an original and its result, and finds layers that have changed places,
// for `compare`. `Layer_order` in compare.h states the rule.

namespace selvedge::internal {
namespace {

constexpr Index none = -1;

/// The edges of the original as a graph of positions. A search that starts at several triangles, one per
/// layer, tells from which of them a position is reached first.
class Position_graph
{
public:
  Position_graph(const std::vector<Index_triple>& triangles, std::vector<Index> positions, Index size)
      : m_positions(std::move(positions)), m_first(size + 1), m_reached(size), m_wanted(size), m_ring(size),
        m_layer(size)
  {
    const auto for_each_side = [&](auto function) {
      for (const Index_triple& triangle : triangles)
        for (int i = 0; i < 3; ++i)
          for (const int j : {(i + 1) % 3, (i + 2) % 3})
            function(m_positions[triangle[i]], m_positions[triangle[j]]);
    };
    for_each_side([&](Index from, Index) { ++m_first[from + 1]; });
    for (Index position = 0; position < size; ++position)
      m_first[position + 1] += m_first[position];
    m_neighbours.resize(m_first[size]);
    std::vector<std::size_t> next(m_first.begin(), m_first.end() - 1);
    for_each_side([&](Index from, Index to) { m_neighbours[next[from]++] = to; });
  }

  /// Finds, for every wanted position, from which of some triangles it is reached over the fewest edges.
  void flood(const std::vector<Index_triple>& triangles, const std::vector<Index>& wanted)
  {
    ++m_time;
    m_queue.clear();
    std::size_t missing = 0;
    for (const Index position : wanted)
      if (m_wanted[position] != m_time) {
        m_wanted[position] = m_time;
        ++missing;
      }
    const auto reach = [&](Index position, Index layer, Index ring) {
      if (m_reached[position] != m_time) {
        m_reached[position] = m_time;
        m_ring[position] = ring;
        m_layer[position] = layer;
        m_queue.push_back(position);
        ++m_work;
        missing -= m_wanted[position] == m_time;
      } else if (m_ring[position] == ring && m_layer[position] != layer) {
        m_layer[position] = none;
      }
    };
    for (Index layer = 0; layer < triangles.size(); ++layer)
      for (const Index vertex : triangles[layer])
        reach(m_positions[vertex], layer, 0);
    constexpr std::size_t enough = 20'000;
    Index last_ring = none;
    for (std::size_t i = 0; i < m_queue.size() && m_queue.size() < enough; ++i) {
      const Index position = m_queue[i];
      // The last ring is completed, since another layer may reach the same positions.
      if (missing == 0 && last_ring == none)
        last_ring = m_ring[m_queue.back()];
      if (m_ring[position] == last_ring)
        break;
      for (std::size_t k = m_first[position]; k < m_first[position + 1]; ++k)
        reach(m_neighbours[k], m_layer[position], m_ring[position] + 1);
    }
  }

  /// Returns the layer of a position after a flood; none where several layers reach it first, or no layer.
  Index layer(Index position) const { return m_reached[position] == m_time ? m_layer[position] : none; }

  /// Returns how many positions all floods have reached so far.
  std::size_t work() const { return m_work; }

private:
  std::vector<Index> m_positions; // of the vertices of the triangles
  std::vector<std::size_t> m_first;
  std::vector<Index> m_neighbours;
  std::vector<Index> m_reached, m_wanted; // number of the last flood that did
  std::vector<Index> m_ring, m_layer;
  std::vector<Index> m_queue;
  Index m_time = 0;
  std::size_t m_work = 0;
};

/// Enumerates the numbers below `size`, each once, so that the first few of them are spread over all.
class Stride
{
public:
  explicit Stride(std::size_t size) : m_size(size), m_step(static_cast<std::size_t>(0.618033988749895 * size))
  {
    while (std::gcd(m_step, m_size) != 1)
      ++m_step;
  }
  Index operator()(std::size_t i) const { return static_cast<Index>(i % m_size * m_step % m_size); }

private:
  std::size_t m_size, m_step;
};

/// Returns where a segment crosses the plane of a triangle: 0 at its source, 1 at its target.
template <class Number>
Number crossing(const Surface& surface, Index triangle, const Segment_3& segment)
{
  using Numbers = std::array<Number, 3>;
  const auto difference = [](const Point_3& p, const Point_3& q) {
    return Numbers{Number(p.x()) - Number(q.x()), Number(p.y()) - Number(q.y()),
                   Number(p.z()) - Number(q.z())};
  };
  const Point_3& corner = surface.corner(triangle, 0);
  const Numbers b = difference(surface.corner(triangle, 1), corner);
  const Numbers c = difference(surface.corner(triangle, 2), corner);
  const Numbers normal = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
  const auto height = [&](const Point_3& p) {
    const Numbers d = difference(p, corner);
    return Number(normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]);
  };
  const Number source = height(segment.source()), target = height(segment.target());
  return source == target ? Number(0) : Number(source / (source - target));
}

struct Crossing
{
  double place; // along the segment
  Index triangle;
  double cosine; // between the segment and the triangle's normal

  bool operator<(const Crossing& other) const { return place < other.place; }
};

/// Whether a crossing in the result and one in the original may be of the same layer: both are at most 60°
/// from the normal, from the same side, and not farther apart than two fifths of the line. Unless `compare`
/// has limited its length, that is twice the largest distance of either mesh from the other.
bool is_alike(const Crossing& now, const Crossing& old)
{
  return std::min(std::abs(now.cosine), std::abs(old.cosine)) >= 0.5 && now.cosine * old.cosine > 0 &&
         std::abs(now.place - old.place) <= 0.4;
}

std::vector<Crossing> crossings(const Surface_tree& tree, const Surface& surface, const Segment_3& segment)
{
  std::vector<Index> triangles;
  tree.crossed(segment, std::back_inserter(triangles));
  std::sort(triangles.begin(), triangles.end());
  std::vector<Crossing> result;
  const Vector_3 along = segment.to_vector();
  for (const Index triangle : triangles) {
    const Vector_3 normal = surface.normal(triangle);
    result.push_back({crossing<double>(surface, triangle, segment), triangle,
                      normal * along / std::sqrt(normal.squared_length() * along.squared_length())});
  }
  std::stable_sort(result.begin(), result.end());
  return result;
}

/// Whether a segment crosses one triangle before another; decided exactly.
bool is_before(const Surface& surface, Index first, Index second, const Segment_3& segment)
{
  using Exact = CGAL::Exact_rational;
  return crossing<Exact>(surface, first, segment) < crossing<Exact>(surface, second, segment);
}

/// Returns, for every vertex of the result, its position in the original, or that of the nearest vertex
/// there.
std::vector<Index> positions_in_original(const Surface& result, const Surface& original, Surface_tree& tree,
                                         const std::vector<Index>& positions, Index size,
                                         const std::vector<Index>& vertices)
{
  const auto of_original = positions.begin() + result.points.size();
  std::vector<bool> is_original(size);
  for (const Index_triple& triangle : original.triangles)
    for (const Index vertex : triangle)
      is_original[of_original[vertex]] = true;
  std::vector<Index> found(positions.begin(), of_original);
  Cancellation_poll poll;
  for (const Index vertex : vertices) {
    poll();
    if (!is_original[found[vertex]]) {
      const Point_3& point = result.points[vertex];
      const Index_triple& corners = original.triangles[tree.nearest(point).triangle];
      found[vertex] = of_original[*std::min_element(corners.begin(), corners.end(), [&](Index v, Index w) {
        return CGAL::has_smaller_distance_to_point(point, original.points[v], original.points[w]);
      })];
    }
  }
  return found;
}

} // namespace

Layer_order layer_order(const Triangle_soup& result, const Triangle_soup& original, double reach)
{
  Layer_order order;
  if (result.triangles.empty() || original.triangles.empty())
    return order;
  const int exponent = common_exponent(result, original);
  const Surface before(original, exponent), after(result, exponent);
  Surface_tree tree_before(before);
  const Surface_tree tree_after(after);
  const std::vector<Index> positions = position_numbers(result, original);
  const Index size = 1 + *std::max_element(positions.begin(), positions.end());
  const std::vector<Index> stand_ins =
      positions_in_original(after, before, tree_before, positions, size, used_vertices(result));
  Position_graph graph(before.triangles, {positions.begin() + result.points.size(), positions.end()}, size);

  constexpr std::size_t most = 200'000, least = 20'000, most_work = 50'000'000;
  const std::size_t faces = original.triangles.size();
  const std::size_t lines = faces > most ? most : faces * (1 + least / faces);
  const Stride faces_in_turn(faces);
  Face_samples samples(before);
  std::vector<Index_triple> layers;
  std::vector<Index> wanted;
  for (std::size_t line = 0; line < lines && graph.work() < most_work; ++line) {
    Cancellation_scope::check();
    const Index face = faces_in_turn(line);
    const Vector_3 normal = before.normal(face);
    const double length = std::sqrt(normal.squared_length());
    if (!(length > 0))
      continue;
    const Point_3 point = samples.next(face);
    const Vector_3 half = (std::ldexp(reach, -exponent) / length) * normal;
    const Segment_3 segment(point - half, point + half);
    if (segment.is_degenerate()) // too short for the coordinates
      continue;
    ++order.lines;
    const std::vector<Crossing> old = crossings(tree_before, before, segment);
    if (old.size() < 2)
      continue;
    ++order.crossing;
    order.pairs += old.size() - 1;

    const std::vector<Crossing> now = crossings(tree_after, after, segment);
    layers.clear();
    wanted.clear();
    for (const Crossing& crossing : old)
      layers.push_back(before.triangles[crossing.triangle]);
    for (const Crossing& crossing : now)
      for (const Index vertex : after.triangles[crossing.triangle])
        wanted.push_back(stand_ins[vertex]);
    graph.flood(layers, wanted);

    // Where each layer is crossed in the result: nowhere, at one place, or at several.
    constexpr std::size_t nowhere = -1, several = -2;
    std::vector<std::size_t> places(old.size(), nowhere);
    for (std::size_t place = 0; place < now.size(); ++place) {
      const Index_triple& corners = after.triangles[now[place].triangle];
      const Index layer = graph.layer(stand_ins[corners[0]]);
      if (layer != none && layer == graph.layer(stand_ins[corners[1]]) &&
          layer == graph.layer(stand_ins[corners[2]]))
        places[layer] = places[layer] == nowhere && is_alike(now[place], old[layer]) ? place : several;
    }
    const std::size_t compared_before = order.compared;
    std::size_t last = nowhere; // the last layer that is crossed once
    for (std::size_t layer = 0; layer < old.size(); ++layer) {
      if (places[layer] >= now.size())
        continue;
      if (last != nowhere) {
        ++order.compared;
        const Index lower = now[places[last]].triangle, upper = now[places[layer]].triangle;
        if (places[last] > places[layer] &&
            is_before(before, old[last].triangle, old[layer].triangle, segment) &&
            is_before(after, upper, lower, segment))
          order.swaps.push_back(
              {scaled(point, exponent), {old[last].triangle, old[layer].triangle}, {lower, upper}});
      }
      last = layer;
    }
    order.lines_compared += order.compared > compared_before;
  }
  return order;
}

} // namespace selvedge::internal
