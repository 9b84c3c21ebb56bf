// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "judge_result.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

/// The borders of the input, and what has become of their vertices: those that have merged are one.
class Followed_borders
{
public:
  Followed_borders(const World_run& run, const std::vector<Point_3>& points) : m_one(points.size())
  {
    const Prepared_soup& prepared = run.prepared;
    for (const Point_3& point : points)
      m_before.push_back(prepared.scale(point));
    m_after = m_before;
    std::map<std::pair<Index, Index>, std::vector<std::pair<Index, Index>>> uses;
    for (const Index_triple& triangle : prepared.soup.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index from = prepared.positions[triangle[k]], to = prepared.positions[triangle[(k + 1) % 3]];
        uses[std::minmax(from, to)].emplace_back(from, to);
      }
    for (const auto& [ends, sides] : uses)
      if (sides.size() == 1) {
        m_next[sides[0].first].push_back(sides[0].second);
        m_previous[sides[0].second].push_back(sides[0].first);
      }
    std::iota(m_one.begin(), m_one.end(), Index(0));
    for (const Soup_collapse& collapse : run.collapses) {
      const Index kept = one(prepared.positions[collapse.kept]);
      m_one[one(prepared.positions[collapse.removed])] = kept;
      if (collapse.place)
        m_after[kept] =
            prepared.scale(Point_3((*collapse.place)[0], (*collapse.place)[1], (*collapse.place)[2]));
    }
  }

  /// Returns how far an original position on a border is from the two edges that its border now has at the
  /// vertex with which it has merged; none where borders branch on the way there.
  std::optional<double> drift(Index position) const
  {
    const auto behind = first_other(m_previous, position), ahead = first_other(m_next, position);
    if (!behind || !ahead)
      return std::nullopt;
    const Point_3 &p = m_before[position], &here = m_after[one(position)];
    return std::sqrt(std::min(CGAL::squared_distance(p, Kernel::Segment_3(m_after[*behind], here)),
                              CGAL::squared_distance(p, Kernel::Segment_3(here, m_after[*ahead]))));
  }

private:
  using Neighbours = std::map<Index, std::vector<Index>>;

  Index one(Index position) const
  {
    while (m_one[position] != position)
      position = m_one[position];
    return position;
  }

  // Follows a border from a position to the first that has not merged with it.
  std::optional<Index> first_other(const Neighbours& neighbours, Index position) const
  {
    for (Index at = position;;) {
      const auto found = neighbours.find(at);
      if (found == neighbours.end() || found->second.size() != 1)
        return std::nullopt;
      at = found->second[0];
      if (one(at) != one(position))
        return one(at);
      if (at == position)
        return std::nullopt;
    }
  }

  std::vector<Point_3> m_before, m_after; // by position; what has merged is at the place of the one
  Neighbours m_next, m_previous;
  std::vector<Index> m_one; // with which each position has merged, step by step
};

} // namespace

Verdict judge_drift(const World& world, const World_run& run)
{
  const Prepared_soup& prepared = run.prepared;
  if (world.options.loop != Collapse_loop::own)
    return std::nullopt;
  CGAL::Bbox_3 box;
  for (const Index_triple& triangle : prepared.soup.triangles)
    for (const Index v : triangle)
      box += prepared.scale(prepared.soup.points[v]).bbox();
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  const double most = (world.options.max_border_drift / 10 * (1 + 1e-9) + 1e-14) * diagonal;
  const auto judged = [&](const std::vector<Point_3>& points, const std::string& where) -> Verdict {
    const Followed_borders borders(run, points);
    for (const Index position : prepared.facing)
      if (const auto drift = borders.drift(position); drift && *drift > most)
        return Broken_promise{Promise::seams, "a border is " + std::to_string(*drift / diagonal) +
                                                  " of the diagonal from its vertex " +
                                                  std::to_string(position) + ", which faces another" + where};
    return std::nullopt;
  };
  if (prepared.facing.empty())
    return std::nullopt;
  if (auto broken = judged(prepared.soup.points, ""))
    return broken;
  for (std::size_t pose = 0; pose < prepared.soup.poses.size(); ++pose)
    if (world.is_guarded(pose))
      if (auto broken =
              judged(prepared.soup.poses[pose].points, " in the pose " + prepared.soup.poses[pose].name))
        return broken;
  return std::nullopt;
}

} // namespace selvedge::test
