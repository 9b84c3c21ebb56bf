// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Sewing.h"

#include "Disjoint_sets.h"

#include <selvedge/Cancellation_scope.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace selvedge {
namespace {

/// Finds the pairs of sides that make edges.
class Side_matching
{
public:
  Side_matching(const std::vector<Index_triple>& triangles, Index own_sides, Index position_count,
                Sewing_notes& notes)
      : m_triangles(triangles), m_own_sides(own_sides), m_mates(3 * triangles.size(), Sewing::none)
  {
    struct Side
    {
      Index high, side;
    };
    const auto ends = [this](Index side) {
      return std::minmax({position(side), position(Sewing::next(side))});
    };
    // Sides are sorted by their lower end in linear time, then the few that share it by their higher end.
    std::vector<Index> places(std::size_t(position_count) + 1, 0);
    for (Index side = 0; side < m_mates.size(); ++side)
      ++places[ends(side).first + 1];
    std::partial_sum(places.begin(), places.end(), places.begin());
    std::vector<Side> sides(m_mates.size());
    for (Index side = 0; side < m_mates.size(); ++side) {
      const auto [low, high] = ends(side);
      sides[places[low]++] = {high, side};
    }
    const auto for_each_run = [&](Index low, const auto& function) {
      const auto end = sides.begin() + places[low];
      for (auto it = sides.begin() + (low == 0 ? 0 : places[low - 1]), beyond = it; it != end; it = beyond) {
        beyond = std::find_if(it, end, [&](const Side& side) {
          return side.high != it->high || is_own(side.side) != is_own(it->side);
        });
        function(it, beyond);
      }
    };
    // Nearly all runs are edges or borders. What else there is comes in the order of its positions.
    std::vector<char> has_others(position_count, false);
    Cancellation_scope::check();
    tbb::parallel_for(Index(0), position_count, [&](Index low) {
      std::sort(
          sides.begin() + (low == 0 ? 0 : places[low - 1]), sides.begin() + places[low],
          [](const Side& a, const Side& b) { return std::tie(a.high, a.side) < std::tie(b.high, b.side); });
      for_each_run(low, [&](auto first, auto beyond) {
        has_others[low] |= beyond - first > 1 && !make_edge(first, beyond);
      });
    });
    Cancellation_poll poll;
    for (Index low = 0; low < position_count; ++low) {
      poll();
      if (has_others[low])
        for_each_run(low, [&](auto first, auto beyond) {
          if (beyond - first > 1 && !make_edge(first, beyond))
            leave_apart(first, beyond, notes);
        });
    }
  }

  std::vector<Index> take_mates() { return std::move(m_mates); }
  std::vector<Index> take_misoriented() { return std::move(m_misoriented); }

  /// The sides that make no edge though there are several between two positions, grouped by these positions.
  const std::vector<std::vector<Index>>& unsewn() const { return m_unsewn; }

private:
  Index position(Index corner) const { return m_triangles[corner / 3][corner % 3]; }
  bool is_own(Index side) const { return side < m_own_sides; }

  // Makes an edge of all sides between two positions, either those of the soup or those of the obstacle, of
  // which there are several. Returns false, and does nothing, where they are none.
  template <class Iterator>
  bool make_edge(Iterator first, Iterator beyond)
  {
    const Index a = first->side, b = first[1].side;
    if (beyond - first != 2 || position(a) == position(b) ||
        position(Sewing::previous(a)) == position(Sewing::previous(b)))
      return false;
    m_mates[a] = b;
    m_mates[b] = a;
    return true;
  }

  // Takes note of such sides that are no edge.
  template <class Iterator>
  void leave_apart(Iterator first, Iterator beyond, Sewing_notes& notes)
  {
    const Index a = first->side, b = first[1].side;
    const bool is_misoriented = beyond - first == 2 && position(a) == position(b);
    notes.non_manifold_edges += is_own(a) && beyond - first > 2;
    notes.misoriented_edges += is_own(a) && is_misoriented;
    if (is_misoriented)
      m_misoriented.insert(m_misoriented.end(), {a, b});
    m_unsewn.emplace_back();
    for (Iterator it = first; it != beyond; ++it)
      m_unsewn.back().push_back(it->side);
  }

  const std::vector<Index_triple>& m_triangles; // of positions
  Index m_own_sides;
  std::vector<Index> m_mates;
  std::vector<Index> m_misoriented;
  std::vector<std::vector<Index>> m_unsewn;
};

} // namespace

Sewing::Sewing(const std::vector<Index_triple>& triangles, Index own_sides, Index position_count,
               Sewing_notes& notes)
{
  Side_matching matching(triangles, own_sides, position_count, notes);
  m_mates = matching.take_mates();
  m_misoriented = matching.take_misoriented();
  number_vertices();
  if (tear_parallel_edges(matching.unsewn()))
    number_vertices();
}

Sewing::Sewing(std::vector<Index> mates) : m_mates(std::move(mates))
{
  number_vertices();
}

// Corners that follow each other around a position across sewn sides are one vertex. Every corner follows at
// most one corner and is followed by at most one, so a walk ends at a border or where it began.
void Sewing::number_vertices()
{
  m_vertices.assign(m_mates.size(), none);
  m_vertex_count = 0;
  Cancellation_poll poll;
  for (Index first = 0; first < m_vertices.size(); ++first) {
    poll();
    if (m_vertices[first] != none)
      continue;
    const Index vertex = m_vertex_count++;
    Index corner = first;
    do {
      m_vertices[corner] = vertex;
      const Index across = m_mates[corner];
      corner = across == none ? none : next(across);
    } while (corner != none && corner != first);
    for (Index across = m_mates[previous(first)]; corner == none && across != none;
         across = m_mates[previous(across)])
      m_vertices[across] = vertex;
  }
}

std::vector<char> turned_triangles(const std::vector<Index_triple>& triangles, Index own_sides,
                                   Index position_count)
{
  Sewing_notes notes;
  Side_matching matching(triangles, own_sides, position_count, notes);
  if (notes.misoriented_edges == 0)
    return {};
  std::vector<std::pair<Index, Index>> disagreeing;
  const std::vector<Index> sides = matching.take_misoriented();
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    const auto position = [&](Index corner) { return triangles[corner / 3][corner % 3]; };
    const Index a = sides[i], b = sides[i + 1];
    if (a < own_sides && position(Sewing::previous(a)) != position(Sewing::previous(b)))
      disagreeing.emplace_back(a, b);
  }
  std::sort(disagreeing.begin(), disagreeing.end());

  // Number `t` stands for triangle t as it runs, and `count + t` for it turned: each surface is two sets, one
  // the other turned, and its first triangle names the set in which it runs as it does.
  const Index count = own_sides / 3;
  internal::Disjoint_sets ways(2 * std::size_t(count));
  const auto first_of = [&](Index t) { return std::min(ways.find(t), ways.find(count + t)); };
  const auto unite = [&](Index a, Index b, bool do_disagree) {
    if (first_of(a) == first_of(b))
      return;
    ways.unite(a, do_disagree ? count + b : b);
    ways.unite(count + a, do_disagree ? b : count + b);
  };
  const std::vector<Index> mates = matching.take_mates();
  for (Index side = 0; side < own_sides; ++side)
    if (mates[side] != Sewing::none && side < mates[side])
      unite(side / 3, mates[side] / 3, false);
  for (const auto& [a, b] : disagreeing)
    unite(a / 3, b / 3, true);

  const auto is_against = [&](Index t) { return ways.find(t) != first_of(t); }; // the first triangle
  std::vector<Index> size(count, 0), against(count, 0);                         // by first triangle
  for (Index t = 0; t < count; ++t) {
    ++size[first_of(t)];
    against[first_of(t)] += is_against(t);
  }
  std::vector<char> is_turned(count);
  for (Index t = 0; t < count; ++t)
    is_turned[t] = is_against(t) != (2 * against[first_of(t)] > size[first_of(t)]);
  if (std::find(is_turned.begin(), is_turned.end(), char(true)) == is_turned.end())
    is_turned.clear();
  return is_turned;
}

// Undoes the sewing where unsewn sides would make two edges between the same two vertices. When all sides
// sewn at these vertices are torn apart, every corner there is a vertex of its own. Once is enough: all torn
// sides end at such corners, and no two of these are one vertex. Returns whether there were such edges.
bool Sewing::tear_parallel_edges(const std::vector<std::vector<Index>>& unsewn)
{
  std::unordered_set<Index> torn;
  for (const std::vector<Index>& sides : unsewn) {
    std::vector<std::pair<Index, Index>> ends;
    for (const Index side : sides)
      ends.push_back(std::minmax({m_vertices[side], m_vertices[next(side)]}));
    std::sort(ends.begin(), ends.end());
    for (auto it = std::adjacent_find(ends.begin(), ends.end()); it != ends.end();
         it = std::adjacent_find(it + 1, ends.end()))
      torn.insert({it->first, it->second});
  }
  for (Index side = 0; side < m_mates.size() && !torn.empty(); ++side) {
    if (m_mates[side] == none || !(torn.count(m_vertices[side]) || torn.count(m_vertices[next(side)])))
      continue;
    m_mates[m_mates[side]] = none;
    m_mates[side] = none;
  }
  return !torn.empty();
}

} // namespace selvedge
