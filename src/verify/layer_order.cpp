// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "layer_order.h"

#include "Surface_tree.h"
#include "face_samples.h"
#include "for_each_chunk.h"
#include "positions.h"
#include "soup/Disjoint_sets.h"
#include "soup/surfaces_of.h"


#include <CGAL/Exact_rational.h>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

// Draws lines through the layers of an original and its result, and finds layers that have changed places,
// for `compare`. `Layer_order` in compare.h states the rule.

namespace selvedge::internal {
namespace {

constexpr Index none = -1;

/// The edges of the original as a graph of positions.
class Position_graph
{
public:
  /// `positions` are those of the vertices of the triangles; all are below `size`.
  Position_graph(const std::vector<Index_triple>& triangles, std::vector<Index> positions, Index size)
      : m_positions(std::move(positions)), m_first(size + 1)
  {
    const auto for_each_side = [&](auto function) {
      for (const Index_triple& triangle : triangles)
        for (int i = 0; i < 3; ++i)
          for (const int j : {(i + 1) % 3, (i + 2) % 3})
            function(m_positions[triangle[i]], m_positions[triangle[j]]);
    };
    for_each_side([&](Index from, Index) { ++m_first[from + 1]; });
    std::partial_sum(m_first.begin(), m_first.end(), m_first.begin());
    m_neighbours.resize(m_first[size]);
    std::vector<std::size_t> next(m_first.begin(), m_first.end() - 1);
    for_each_side([&](Index from, Index to) { m_neighbours[next[from]++] = to; });
    remove_repetitions();
    find_components(triangles);
  }

  /// Returns a number below `size` that two positions share when one is reached from the other.
  Index component(Index position) const { return m_components[position]; }

  Index size() const { return Index(m_first.size() - 1); }
  Index position(Index vertex) const { return m_positions[vertex]; }

  template <class Function>
  void for_each_neighbour(Index position, const Function& function) const
  {
    for (std::size_t k = m_first[position]; k < m_first[position + 1]; ++k)
      function(m_neighbours[k]);
  }

private:
  void remove_repetitions()
  {
    auto beyond = m_neighbours.begin();
    std::size_t first = 0;
    for (std::size_t position = 0; position + 1 < m_first.size(); ++position) {
      const auto begin = m_neighbours.begin() + std::ptrdiff_t(first),
                 end = m_neighbours.begin() + std::ptrdiff_t(m_first[position + 1]);
      first = m_first[position + 1];
      std::sort(begin, end);
      beyond = std::copy(begin, std::unique(begin, end), beyond);
      m_first[position + 1] = std::size_t(beyond - m_neighbours.begin());
    }
    m_neighbours.erase(beyond, m_neighbours.end());
  }

  void find_components(const std::vector<Index_triple>& triangles)
  {
    Disjoint_sets components(size());
    for (const auto& [a, b, c] : triangles) {
      components.unite(m_positions[a], m_positions[b]);
      components.unite(m_positions[a], m_positions[c]);
    }
    for (Index position = 0; position < size(); ++position)
      m_components.push_back(Index(components.find(position)));
  }

  std::vector<Index> m_positions;   // of the vertices of the triangles
  std::vector<std::size_t> m_first; // of each position, and one more
  std::vector<Index> m_neighbours;
  std::vector<Index> m_components; // by position
};

/// A search in the graph that starts at several triangles, one per layer, and tells from which of them a
/// position is reached first.
class Flood
{
public:
  explicit Flood(const Position_graph& graph)
      : m_graph(graph), m_marks(graph.size()), m_starts(graph.size(), 0)
  {
  }

  /// Finds, for every wanted position, from which of some triangles it is reached over the fewest edges.
  /// Returns how many positions it has reached.
  std::size_t run(const std::vector<Index_triple>& triangles, const std::vector<Index>& wanted)
  {
    ++m_time;
    m_queue.clear();
    std::size_t missing = 0;
    for (const Index_triple& triangle : triangles)
      m_starts[m_graph.component(m_graph.position(triangle[0]))] = m_time;
    for (const Index position : wanted)
      if (m_starts[m_graph.component(position)] == m_time)
        missing += std::exchange(m_marks[position].wanted, m_time) != m_time;
    const auto reach = [&](Index position, Index layer, Index ring) {
      Mark& mark = m_marks[position];
      if (mark.reached != m_time) {
        missing -= mark.wanted == m_time;
        mark = {m_time, mark.wanted, ring, layer};
        m_queue.push_back(position);
      } else if (mark.ring == ring && mark.layer != layer) {
        mark.layer = none;
      }
    };
    for (Index layer = 0; layer < triangles.size(); ++layer)
      for (const Index vertex : triangles[layer])
        reach(m_graph.position(vertex), layer, 0);
    constexpr std::size_t enough = 20'000;
    Index last_ring = none;
    for (std::size_t i = 0; i < m_queue.size() && m_queue.size() < enough; ++i) {
      const Mark from = m_marks[m_queue[i]];
      // The last ring is completed, since another layer may reach the same positions.
      if (missing == 0 && last_ring == none)
        last_ring = m_marks[m_queue.back()].ring;
      if (from.ring == last_ring)
        break;
      m_graph.for_each_neighbour(m_queue[i],
                                 [&](Index position) { reach(position, from.layer, from.ring + 1); });
    }
    return m_queue.size();
  }

  /// Returns the layer of a position after a search; none where several layers reach it first, or no layer.
  Index layer(Index position) const
  {
    return m_marks[position].reached == m_time ? m_marks[position].layer : none;
  }

private:
  struct Mark
  {
    Index reached = 0, wanted = 0; // number of the last search that did
    Index ring = 0, layer = 0;
  };

  const Position_graph& m_graph;
  std::vector<Mark> m_marks;   // by position
  std::vector<Index> m_starts; // of components: number of the last search that began in one
  std::vector<Index> m_queue;
  Index m_time = 0;
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
std::vector<Index> positions_in_original(const Surface& result, const Surface& original,
                                         const Surface_tree& tree, const std::vector<Index>& positions,
                                         Index size, const std::vector<Index>& vertices)
{
  const auto of_original = positions.begin() + result.points.size();
  std::vector<char> is_original(size);
  for (const Index_triple& triangle : original.triangles)
    for (const Index vertex : triangle)
      is_original[of_original[vertex]] = true;
  std::vector<Index> found(positions.begin(), of_original);
  for_each_chunk(vertices.size(), 1024, [&](std::size_t, std::size_t first, std::size_t beyond) {
    Index guess = 0;
    for (std::size_t i = first; i < beyond; ++i) {
      const Index vertex = vertices[i];
      if (is_original[found[vertex]])
        continue;
      const Point_3& point = result.points[vertex];
      guess = tree.nearest(point, guess).triangle;
      const Index_triple& corners = original.triangles[guess];
      found[vertex] = of_original[*std::min_element(corners.begin(), corners.end(), [&](Index v, Index w) {
        return CGAL::has_smaller_distance_to_point(point, original.points[v], original.points[w]);
      })];
    }
  });
  return found;
}

/// A line on which the order of layers is compared: through a point of a face of the original, at right
/// angles to it.
struct Line
{
  Index face;
  Point_3 point;
  Segment_3 segment;
};

/// Compares the order of layers along lines.
class Comparison_along_lines
{
public:
  /// The positions of the vertices of the result that `graph` knows are `stand_ins`. Everything outlives
  /// this.
  Comparison_along_lines(const Surface& before, const Surface& after, const Surface_tree& tree_before,
                         const Surface_tree& tree_after, const Position_graph& graph,
                         const std::vector<Index>& stand_ins)
      : m_before(before), m_after(after), m_tree_before(tree_before), m_tree_after(tree_after),
        m_stand_ins(stand_ins), m_flood(graph)
  {
  }

  /// Adds to `order` what is found along a line. Returns how many positions the search has reached. Swaps
  /// lie at points of the surface, not of the soup.
  std::size_t compare(const Line& line, Layer_order& order)
  {
    ++order.lines;
    const std::vector<Crossing> old = crossings(m_tree_before, m_before, line.segment);
    if (old.size() < 2)
      return 0;
    ++order.crossing;
    order.pairs += old.size() - 1;

    const std::vector<Crossing> now = crossings(m_tree_after, m_after, line.segment);
    m_layers.clear();
    m_wanted.clear();
    for (const Crossing& crossing : old)
      m_layers.push_back(m_before.triangles[crossing.triangle]);
    for (const Crossing& crossing : now)
      for (const Index vertex : m_after.triangles[crossing.triangle])
        m_wanted.push_back(m_stand_ins[vertex]);
    const std::size_t work = m_flood.run(m_layers, m_wanted);

    const std::vector<std::size_t> places = places_of_layers(old, now);
    const std::size_t compared_before = order.compared;
    std::size_t last = s_nowhere; // the last layer that is crossed once
    for (std::size_t layer = 0; layer < old.size(); ++layer) {
      if (places[layer] >= now.size())
        continue;
      if (last != s_nowhere) {
        ++order.compared;
        const Index lower = now[places[last]].triangle, upper = now[places[layer]].triangle;
        if (places[last] > places[layer] &&
            is_before(m_before, old[last].triangle, old[layer].triangle, line.segment) &&
            is_before(m_after, upper, lower, line.segment))
          order.swaps.push_back({line.point, {old[last].triangle, old[layer].triangle}, {lower, upper}});
      }
      last = layer;
    }
    order.lines_compared += order.compared > compared_before;
    return work;
  }

private:
  static constexpr std::size_t s_nowhere = -1, s_several = -2;

  // Returns where each layer is crossed in the result: nowhere, at one place, or at several.
  std::vector<std::size_t> places_of_layers(const std::vector<Crossing>& old,
                                            const std::vector<Crossing>& now) const
  {
    std::vector<std::size_t> places(old.size(), s_nowhere);
    for (std::size_t place = 0; place < now.size(); ++place) {
      const Index_triple& corners = m_after.triangles[now[place].triangle];
      const Index layer = m_flood.layer(m_stand_ins[corners[0]]);
      if (layer != none && layer == m_flood.layer(m_stand_ins[corners[1]]) &&
          layer == m_flood.layer(m_stand_ins[corners[2]]))
        places[layer] = places[layer] == s_nowhere && is_alike(now[place], old[layer]) ? place : s_several;
    }
    return places;
  }

  const Surface &m_before, &m_after;
  const Surface_tree &m_tree_before, &m_tree_after;
  const std::vector<Index>& m_stand_ins; // by vertex of the result
  Flood m_flood;
  std::vector<Index_triple> m_layers;
  std::vector<Index> m_wanted;
};

void add(Layer_order& sum, const Layer_order& part)
{
  sum.lines += part.lines;
  sum.crossing += part.crossing;
  sum.pairs += part.pairs;
  sum.compared += part.compared;
  sum.lines_compared += part.lines_compared;
  sum.swaps.insert(sum.swaps.end(), part.swaps.begin(), part.swaps.end());
}

/// Returns lines through faces of the original, spread over all faces, as far as `reach` to either side.
std::vector<Line> lines_through(const Surface& original, double reach)
{
  constexpr std::size_t most = 200'000, least = 20'000;
  const std::size_t faces = original.triangles.size();
  const std::size_t count = faces > most ? most : faces * (1 + least / faces);
  const Stride faces_in_turn(faces);
  Face_samples samples(original);
  std::vector<Line> lines;
  for (std::size_t i = 0; i < count; ++i) {
    const Index face = faces_in_turn(i);
    const Vector_3 normal = original.normal(face);
    const double length = std::sqrt(normal.squared_length());
    if (!(length > 0))
      continue;
    const Point_3 point = samples.next(face);
    const Vector_3 half = (reach / length) * normal;
    const Segment_3 segment(point - half, point + half);
    if (!segment.is_degenerate()) // not too short for the coordinates
      lines.push_back({face, point, segment});
  }
  return lines;
}

} // namespace

Layer_order layer_order(const Triangle_soup& result, const Triangle_soup& original, double reach)
{
  Layer_order order;
  if (result.triangles.empty() || original.triangles.empty())
    return order;
  const int exponent = common_exponent(result, original);
  const Surface before(original, exponent), after(result, exponent);
  const Surface_tree tree_before(before), tree_after(after);
  const std::vector<Index> positions = position_numbers(result, original);
  const Index size = 1 + *std::max_element(positions.begin(), positions.end());
  const std::vector<Index> stand_ins =
      positions_in_original(after, before, tree_before, positions, size, used_vertices(result));
  const Position_graph graph(
      before.triangles, {positions.begin() + std::ptrdiff_t(result.points.size()), positions.end()}, size);

  std::vector<Line> lines = lines_through(before, std::ldexp(reach, -exponent));
  tbb::enumerable_thread_specific<std::optional<Comparison_along_lines>> comparisons;
  // Lines are compared in batches as large as the work allows, to judge by that of earlier ones. In a batch
  // they are in the order of faces, so that what one line has read is at hand for the next.
  constexpr std::size_t least_batch = 8192, chunk = 64, most_work = 100'000'000;
  std::size_t work = 0, count = 0;
  for (std::size_t first = 0; first < lines.size() && work < most_work; first += count) {
    const double affordable = double(most_work - work) / double(work + 1) * double(first);
    count = std::min(lines.size() - first, std::max(least_batch, std::size_t(std::min(affordable, 1e9))));
    std::stable_sort(lines.begin() + std::ptrdiff_t(first), lines.begin() + std::ptrdiff_t(first + count),
                     [](const Line& a, const Line& b) { return a.face < b.face; });
    std::vector<Layer_order> orders(chunk_count(count, chunk));
    std::vector<std::size_t> works(orders.size(), 0);
    for_each_chunk(count, chunk, [&](std::size_t number, std::size_t from, std::size_t beyond) {
      auto& comparison = comparisons.local();
      if (!comparison)
        comparison.emplace(before, after, tree_before, tree_after, graph, stand_ins);
      for (std::size_t i = from; i < beyond; ++i)
        works[number] += comparison->compare(lines[first + i], orders[number]);
    });
    work = std::accumulate(works.begin(), works.end(), work);
    for (const Layer_order& of_chunk : orders)
      add(order, of_chunk);
  }
  for (Layer_swap& swap : order.swaps)
    swap.point = scaled(swap.point, exponent);
  order.reach = reach;
  return order;
}

} // namespace selvedge::internal

namespace selvedge {

void leave_out_without_order(Layer_order& layers, const Triangle_soup& result, const Triangle_soup& original,
                             const std::vector<Offending_pair>& pairs_of_original)
{
  const auto box_of = [](const Triangle_soup& soup, Index triangle) {
    CGAL::Bbox_3 box;
    for (const Index v : soup.triangles[triangle])
      box += soup.points[v].bbox();
    return box;
  };
  const std::vector<std::size_t> surfaces = surfaces_of(original);
  const auto surfaces_of_both = [&](const std::array<Index, 2>& triangles) {
    const auto [least, most] = std::minmax(surfaces[triangles[0]], surfaces[triangles[1]]);
    return std::pair<std::size_t, std::size_t>(least, most);
  };
  std::map<std::pair<std::size_t, std::size_t>, std::vector<CGAL::Bbox_3>> places; // by the two surfaces
  for (const Offending_pair& pair : pairs_of_original) {
    const CGAL::Bbox_3 a = box_of(original, pair.first), b = box_of(original, pair.second);
    std::array<double, 3> least{}, most{};
    for (int axis = 0; axis < 3; ++axis) {
      least[std::size_t(axis)] = std::max(a.min(axis), b.min(axis)) - layers.reach;
      most[std::size_t(axis)] = std::min(a.max(axis), b.max(axis)) + layers.reach;
    }
    places[surfaces_of_both({pair.first, pair.second})].emplace_back(least[0], least[1], least[2], most[0],
                                                                     most[1], most[2]);
  }
  // A triangle of the result may come from farther away than it reaches.
  const auto around = [&](Index triangle) {
    const CGAL::Bbox_3 box = box_of(result, triangle);
    const double side = std::max({box.x_span(), box.y_span(), box.z_span()});
    return CGAL::Bbox_3(box.xmin() - side, box.ymin() - side, box.zmin() - side, box.xmax() + side,
                        box.ymax() + side, box.zmax() + side);
  };
  const auto is_without_order = [&](const Layer_swap& swap) {
    const auto found = places.find(surfaces_of_both(swap.of_original));
    if (found == places.end())
      return false;
    const CGAL::Bbox_3 a = around(swap.of_result[0]), b = around(swap.of_result[1]);
    return std::any_of(found->second.begin(), found->second.end(), [&](const CGAL::Bbox_3& box) {
      return CGAL::do_overlap(box, a) && CGAL::do_overlap(box, b);
    });
  };
  const auto left = std::remove_if(layers.swaps.begin(), layers.swaps.end(), is_without_order);
  layers.without_order += std::size_t(layers.swaps.end() - left);
  layers.swaps.erase(left, layers.swaps.end());
}

} // namespace selvedge
