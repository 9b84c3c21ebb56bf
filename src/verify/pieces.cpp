// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/verify.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace selvedge {
namespace {

class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t size) : m_parent(size)
  {
    std::iota(m_parent.begin(), m_parent.end(), std::size_t(0));
  }

  std::size_t find(std::size_t element)
  {
    while (m_parent[element] != element)
      element = m_parent[element] = m_parent[m_parent[element]];
    return element;
  }

  void unite(std::size_t a, std::size_t b)
  {
    std::tie(a, b) = std::minmax({find(a), find(b)});
    m_parent[b] = a;
  }

private:
  std::vector<std::size_t> m_parent;
};

/// The side of a triangle, from the end with the lower vertex number to the other. A corner is 3 · triangle +
/// 0, 1 or 2.
struct Side
{
  Index low, high;
  std::size_t corner_at_low, corner_at_high;
};

bool is_face(const Index_triple& corners)
{
  return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

/// By their lower ends in linear time, and the few of one lower end by the other, then by the corner.
std::vector<Side> sorted_sides(const Triangle_soup& soup)
{
  const std::vector<Index_triple>& triangles = soup.triangles;
  const auto for_each_side = [&](const auto& function) {
    for (std::size_t triangle = 0; triangle < triangles.size(); ++triangle)
      for (int i = 0; is_face(triangles[triangle]) && i < 3; ++i) {
        const int j = (i + 1) % 3;
        const Index from = triangles[triangle][i], to = triangles[triangle][j];
        const std::size_t corner_from = 3 * triangle + i, corner_to = 3 * triangle + j;
        function(from < to ? Side{from, to, corner_from, corner_to} : Side{to, from, corner_to, corner_from});
      }
  };
  std::vector<std::size_t> places(soup.points.size() + 1, 0);
  for_each_side([&](const Side& side) { ++places[side.low + 1]; });
  std::partial_sum(places.begin(), places.end(), places.begin());
  std::vector<Side> sides(places.back());
  for_each_side([&](const Side& side) { sides[places[side.low]++] = side; });
  auto first = sides.begin();
  for (std::size_t low = 0; low < soup.points.size(); ++low) {
    const auto beyond = sides.begin() + std::ptrdiff_t(places[low]);
    std::sort(first, beyond, [](const Side& a, const Side& b) {
      return std::tie(a.high, a.corner_at_low) < std::tie(b.high, b.corner_at_low);
    });
    first = beyond;
  }
  return sides;
}

} // namespace

std::vector<Piece> pieces(const Triangle_soup& soup)
{
  Disjoint_sets connected(soup.points.size());
  for (const Index_triple& triangle : soup.triangles)
    if (is_face(triangle)) {
      connected.unite(triangle[0], triangle[1]);
      connected.unite(triangle[0], triangle[2]);
    }

  std::vector<Piece> result;
  constexpr Index none = -1;
  std::vector<Index> piece_of_set(soup.points.size(), none);
  const auto piece_of = [&](Index vertex) -> Piece& { return result[piece_of_set[connected.find(vertex)]]; };
  std::vector<bool> used(soup.points.size());
  for (Index i = 0; i < soup.triangles.size(); ++i)
    if (is_face(soup.triangles[i])) {
      Index& number = piece_of_set[connected.find(soup.triangles[i][0])];
      if (number == none) {
        number = static_cast<Index>(result.size());
        result.push_back(Piece{i, 0, 0, 0, 0, 0, 0});
      }
      Piece& piece = result[number];
      ++piece.faces;
      ++piece.euler_characteristic;
      for (const Index vertex : soup.triangles[i])
        if (!used[vertex]) {
          used[vertex] = true;
          ++piece.vertices;
          ++piece.euler_characteristic;
        }
    }

  // The fans of faces around the vertices, as sets of corners.
  Disjoint_sets fans(3 * soup.triangles.size());
  std::vector<Side> borders;
  const std::vector<Side> sides = sorted_sides(soup);
  for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
    for (; last != sides.end() && last->low == first->low && last->high == first->high; ++last) {
      fans.unite(first->corner_at_low, last->corner_at_low);
      fans.unite(first->corner_at_high, last->corner_at_high);
    }
    Piece& piece = piece_of(first->low);
    --piece.euler_characteristic;
    if (last - first == 1) {
      ++piece.border_edges;
      borders.push_back(*first);
    } else if (last - first > 2)
      ++piece.non_manifold_edges;
  }

  // A border edge leads from one fan to another; a loop is what hangs together that way.
  for (const Side& border : borders)
    fans.unite(border.corner_at_low, border.corner_at_high);
  std::vector<bool> counted(3 * soup.triangles.size());
  for (const Side& border : borders) {
    const std::size_t loop = fans.find(border.corner_at_low);
    if (!counted[loop])
      ++piece_of(border.low).boundary_loops;
    counted[loop] = true;
  }
  return result;
}

std::vector<Topology_difference> topology_differences(const std::vector<Piece>& result,
                                                      const std::vector<Piece>& original)
{
  struct Counts
  {
    std::size_t original = 0, result = 0;
  };
  std::map<std::pair<std::size_t, long>, Counts> kinds;
  for (const Piece& piece : original)
    ++kinds[{piece.boundary_loops, piece.euler_characteristic}].original;
  for (const Piece& piece : result)
    ++kinds[{piece.boundary_loops, piece.euler_characteristic}].result;

  std::vector<Topology_difference> differences;
  for (const auto& [kind, counts] : kinds)
    if (counts.original != counts.result)
      differences.push_back({kind.first, kind.second, counts.original, counts.result});
  return differences;
}

} // namespace selvedge
