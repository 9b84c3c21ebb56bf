// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "verify/positions.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>

// Finds the offending pairs of a result that descend from no pair of its original, from the list of collapses
// alone.

namespace selvedge {
namespace {

using Ancestors = std::vector<Index>; // triangles of the original, in ascending order

/// Repeats collapses on the positions of an original, to know from which of its offending triangles each
/// triangle descends, and where its corners come to be.
class Descent_of_triangles
{
public:
  Descent_of_triangles(const Triangle_soup& original, const std::vector<Offending_pair>& pairs)
      : m_position_of_vertex(internal::position_numbers(original.points)), m_points(original.points.size()),
        m_triangles_at(original.points.size()), m_fronts(original.triangles.size()),
        m_ancestors(original.triangles.size()), m_partners(original.triangles.size())
  {
    std::map<Index_triple, Index> first_with; // corners, in ascending order
    for (Index v = 0; v < original.points.size(); ++v)
      m_points[m_position_of_vertex[v]] = original.points[v];
    for (Index t = 0; t < original.triangles.size(); ++t) {
      const auto& [a, b, c] = original.triangles[t];
      m_corners.push_back({m_position_of_vertex[a], m_position_of_vertex[b], m_position_of_vertex[c]});
      for (const Index position : m_corners[t])
        m_triangles_at[position].push_back(t);
      Index_triple corners = m_corners[t];
      std::sort(corners.begin(), corners.end());
      m_fronts[t] = first_with.emplace(corners, t).first->second;
    }
    for (const Offending_pair& pair : pairs) {
      if (pair.offence == Offence::degenerate) {
        m_degenerate.insert(pair.first);
        continue;
      }
      const Index first = m_fronts[pair.first], second = m_fronts[pair.second];
      if (first == second)
        continue; // they exempt nothing but each other
      for (const auto& [f, g] : {std::pair(first, second), std::pair(second, first)}) {
        if (!m_ancestors[f])
          m_ancestors[f] = std::make_shared<Ancestors>(1, f);
        m_partners[f].push_back(g);
      }
    }
  }

  void collapse(const Soup_collapse& collapse)
  {
    const Index removed = m_position_of_vertex[collapse.removed], kept = m_position_of_vertex[collapse.kept];
    const Point_3 end = collapse.place
                            ? Point_3((*collapse.place)[0], (*collapse.place)[1], (*collapse.place)[2])
                            : m_points[kept];
    std::vector<Index> changed;
    for (const Index position : {removed, kept})
      if (m_points[position] != end)
        changed.insert(changed.end(), m_triangles_at[position].begin(), m_triangles_at[position].end());
    share_ancestors(changed);
    for (const Index t : changed)
      m_degenerate.erase(t); // no face without an area descends from it
    m_points[kept] = end;

    for (const Index t : std::exchange(m_triangles_at[removed], {})) {
      Index_triple& corners = m_corners[t];
      if (std::find(corners.begin(), corners.end(), kept) == corners.end()) {
        std::replace(corners.begin(), corners.end(), removed, kept);
        m_triangles_at[kept].push_back(t);
        continue;
      }
      for (const Index position : corners)
        if (position != removed) {
          std::vector<Index>& there = m_triangles_at[position];
          there.erase(std::find(there.begin(), there.end(), t));
        }
      m_ancestors[t].reset();
    }
  }

  /// Whether the triangle had no area in the original, and has not changed.
  bool is_degenerate(Index triangle) const { return m_degenerate.count(triangle) > 0; }

  const Point_3& corner(Index triangle, std::size_t k) const { return m_points[m_corners[triangle][k]]; }

  /// Whether two triangles had the same corners in the original. They still have.
  bool are_doubles(Index first, Index second) const { return m_fronts[first] == m_fronts[second]; }

  /// Whether ancestors of the two triangles offended together in the original.
  bool are_partners(Index first, Index second) const
  {
    const Ancestors *const of_first = ancestors(first), *const of_second = ancestors(second);
    return of_first && of_second && std::any_of(of_first->begin(), of_first->end(), [&](Index f) {
             return std::any_of(m_partners[f].begin(), m_partners[f].end(), [&](Index g) {
               return std::binary_search(of_second->begin(), of_second->end(), g);
             });
           });
  }

private:
  const Ancestors* ancestors(Index triangle) const { return m_ancestors[m_fronts[triangle]].get(); }

  void share_ancestors(const std::vector<Index>& triangles)
  {
    std::set<std::shared_ptr<const Ancestors>> sets; // mostly one, of which all have a share already
    for (const Index t : triangles)
      if (const auto& some = m_ancestors[m_fronts[t]])
        sets.insert(some);
    if (sets.empty())
      return;
    std::shared_ptr<const Ancestors> shared = *sets.begin();
    if (sets.size() > 1) {
      Ancestors all;
      for (const auto& some : sets)
        all.insert(all.end(), some->begin(), some->end());
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      shared = std::make_shared<Ancestors>(std::move(all));
    }
    for (const Index t : triangles)
      m_ancestors[t] = shared;
  }

  std::vector<Index> m_position_of_vertex;        // at the start
  std::vector<Point_3> m_points;                  // by position, now
  std::vector<std::vector<Index>> m_triangles_at; // by position
  std::vector<Index_triple> m_corners;            // positions, by triangle
  std::vector<Index> m_fronts;                    // by triangle, the first with its corners in the original
  std::vector<std::shared_ptr<const Ancestors>> m_ancestors; // by front
  std::vector<std::vector<Index>> m_partners;                // by triangle of the original
  std::set<Index> m_degenerate;
};

bool is_of_two(const Offending_pair& pair)
{
  return pair.offence != Offence::degenerate;
}

} // namespace

std::vector<Offending_pair> pairs_without_descent(const Triangle_soup& result,
                                                  const std::vector<Offending_pair>& pairs_of_result,
                                                  const Triangle_soup& original,
                                                  const std::vector<Offending_pair>& pairs_of_original,
                                                  const std::vector<Soup_collapse>& collapses,
                                                  const std::vector<Index>& triangles_of_original)
{
  if (pairs_of_result.empty())
    return {};
  Descent_of_triangles descent(original, pairs_of_original);
  Cancellation_poll poll;
  for (const Soup_collapse& collapse : collapses) {
    poll();
    descent.collapse(collapse);
  }
  // A triangle that is not where the collapses lead descends from nothing.
  const auto is_led_to = [&](Index i) {
    for (std::size_t k = 0; k < 3; ++k)
      if (result.points[result.triangles[i][k]] != descent.corner(triangles_of_original[i], k))
        return false;
    return true;
  };
  std::size_t left = std::count_if(pairs_of_original.begin(), pairs_of_original.end(), is_of_two);
  std::vector<Offending_pair> pairs;
  for (const Offending_pair& pair : pairs_of_result) {
    poll();
    const Index first = triangles_of_original[pair.first], second = triangles_of_original[pair.second];
    bool is_old = is_led_to(pair.first) && is_led_to(pair.second);
    if (is_of_two(pair)) {
      is_old = is_old && left > 0 &&
               (descent.are_doubles(first, second) ? pair.offence == Offence::duplicate
                                                   : descent.are_partners(first, second));
      left -= left > 0;
    } else {
      is_old = is_old && descent.is_degenerate(first);
    }
    if (!is_old)
      pairs.push_back(pair);
  }
  return pairs;
}

} // namespace selvedge
