// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_SLOW_JUDGE_H
#define SELVEDGE_TEST_SUPPORT_SLOW_JUDGE_H

#include "support/Exact_oracle.h"
#include "support/Exact_unit.h"

#include <selvedge/Triangle_soup.h>
#include <selvedge/replay.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {

using Number = CGAL::Gmpz;
using Exact_point = oracle::Point<Number>;
using Exact_triangle = std::array<Exact_point, 3>;
using Verdict = std::pair<std::size_t, Violation_kind>; // which step, from 1; 0 and `result` for the end

/// A collapse or a snap: what is at the position of `first` goes to that of `second`.
struct Step
{
  Index first, second;
  bool is_snap;

  Step(Index moved, Index kept, bool is_a_snap = false) : first(moved), second(kept), is_snap(is_a_snap) {}
};

/// A mesh as a plain list of triangles over positions, which knows nothing but how to look through it. Its
/// coordinates are integers: all are multiplied by one power of two.
class Slow_judge
{
public:
  explicit Slow_judge(const Triangle_soup& soup, double weld_distance = 0)
      : m_points(soup.points), m_weld_distance(weld_distance)
  {
    find_unit();
    std::map<std::array<double, 3>, Index> first;
    for (Index v = 0; v < m_points.size(); ++v)
      m_position.push_back(
          first.emplace(std::array{m_points[v].x(), m_points[v].y(), m_points[v].z()}, v).first->second);
    for (const Index_triple& t : soup.triangles)
      m_triangles.push_back({m_position[t[0]], m_position[t[1]], m_position[t[2]]});
    m_start = m_triangles;
  }

  /// The first violation of a log whose honest end is that of `honest`.
  Verdict judge(const std::vector<Step>& steps, const std::vector<Step>& honest)
  {
    const auto count = [](const std::vector<Step>& list) {
      return std::count_if(list.begin(), list.end(), [](const Step& step) { return !step.is_snap; });
    };
    begin();
    for (const Step& step : honest)
      take(step);
    const std::vector<Index_triple> honest_end = end();
    begin();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (const std::optional<Violation_kind> kind = remembered(steps[i]))
        return {i + 1, *kind};
      take(steps[i]);
    }
    const bool is_same = end() == honest_end && count(steps) == count(honest);
    return {0, is_same ? Violation_kind::no_edge : Violation_kind::result};
  }

  /// Every bad step of a log, as `Replay_options::is_all_wanted` has it: a bad step is taken where it can be,
  /// and later two faces that meet before a step do not count against it.
  std::vector<Verdict> judge_all(const std::vector<Step>& steps)
  {
    std::vector<Verdict> verdicts;
    begin();
    m_is_old_forgiven = true;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::optional<Violation_kind> kind = violation(steps[i]);
      if (kind)
        verdicts.emplace_back(i + 1, *kind);
      if (kind != Violation_kind::no_edge)
        take(steps[i]);
    }
    m_is_old_forgiven = false;
    return verdicts;
  }

private:
  static bool has(const Index_triple& triangle, Index v)
  {
    return triangle[0] == v || triangle[1] == v || triangle[2] == v;
  }

  void begin()
  {
    m_triangles = m_start;
    m_now = m_position;
  }

  void take(const Step& step)
  {
    const Index m = m_now[step.first], t = m_now[step.second];
    m_triangles.erase(std::remove_if(m_triangles.begin(), m_triangles.end(),
                                     [&](const Index_triple& f) { return has(f, m) && has(f, t); }),
                      m_triangles.end());
    for (Index_triple& triangle : m_triangles)
      std::replace(triangle.begin(), triangle.end(), m, t);
    if (step.is_snap)
      std::replace(m_now.begin(), m_now.end(), m, t);
  }

  // The triangles by the smallest vertices at their positions, as a log's digest has them.
  std::vector<Index_triple> end() const
  {
    std::vector<Index_triple> triangles = m_triangles;
    for (Index_triple& triangle : triangles)
      for (Index& v : triangle)
        v = Index(std::find(m_now.begin(), m_now.end(), v) - m_now.begin());
    return triangles;
  }

  /// The same question about the same triangles has the same answer.
  std::optional<Violation_kind> remembered(const Step& step)
  {
    if (const std::optional<Violation_kind> kind = broken_rule(step))
      return kind;
    const Index m = m_now[step.first], t = m_now[step.second];
    const CGAL::Bbox_3 box = box_of_star(m, t);
    std::vector<Index> question{m, t};
    for (const Index_triple& f : m_triangles)
      if (has(f, t) || CGAL::do_overlap(box, box_of(f)))
        question.insert(question.end(), f.begin(), f.end());
    const auto [entry, is_new] = m_answers.emplace(question, std::nullopt);
    if (is_new)
      entry->second = contact(m, t);
    return entry->second;
  }

  std::optional<Violation_kind> violation(const Step& step) const
  {
    const std::optional<Violation_kind> kind = broken_rule(step);
    return kind ? kind : contact(m_now[step.first], m_now[step.second]);
  }

  /// What is wrong apart from what meets what.
  std::optional<Violation_kind> broken_rule(const Step& step) const
  {
    const Index m = m_now[step.first], t = m_now[step.second];
    std::vector<Index_triple> star, contracted;
    bool is_kept_there = false;
    for (const Index_triple& f : m_triangles) {
      is_kept_there = is_kept_there || has(f, t);
      if (has(f, m))
        star.push_back(f);
      if (has(f, m) && has(f, t))
        contracted.push_back(f);
    }
    if (m == t || star.empty() || !is_kept_there || contracted.empty() != step.is_snap)
      return Violation_kind::no_edge;
    if (step.is_snap) {
      if (is_beyond_weld_distance(m, t))
        return Violation_kind::weld_distance;
      if (!are_partners(m, t))
        return Violation_kind::partner;
      if (!is_sewing_manifold(m, t))
        return Violation_kind::link;
    } else {
      if (fans(m, star) != 1)
        return Violation_kind::locked;
      if (!is_link_condition_met(m, t, contracted))
        return Violation_kind::link;
    }
    return std::nullopt;
  }

  std::optional<Violation_kind> contact(Index m, Index t) const
  {
    std::vector<Index_triple> contracted, moving, others;
    for (const Index_triple& f : m_triangles)
      (!has(f, m) ? others : has(f, t) ? contracted : moving).push_back(f);

    std::vector<Exact_triangle> before, after; // m first
    for (const Index_triple& f : moving) {
      const std::size_t k = std::size_t(std::find(f.begin(), f.end(), m) - f.begin());
      const Exact_point a = exact(f[(k + 1) % 3]), b = exact(f[(k + 2) % 3]);
      before.push_back({exact(m), a, b});
      after.push_back({exact(t), a, b});
    }
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto normal = [](const Exact_triangle& f) {
        return oracle::cross(oracle::difference(f[1], f[0]), oracle::difference(f[2], f[0]));
      };
      const Exact_point u = normal(before[i]), v = normal(after[i]), zero{Number(0), Number(0), Number(0)};
      if (u == zero || v == zero || (oracle::cross(u, v) == zero && oracle::dot(u, v) < Number(0)))
        return Violation_kind::degenerate;
    }
    for (std::size_t i = 0; i < after.size(); ++i) {
      for (const Index_triple& f : others)
        if (CGAL::do_overlap(
                box_of({t, moving[i][0] == m ? t : moving[i][0], moving[i][1] == m ? t : moving[i][1]}) +
                    box_of(moving[i]),
                box_of(f)) &&
            do_meet(after[i], exact(f)) && !is_forgiven(before[i], exact(f)))
          return Violation_kind::intersection;
      for (std::size_t j = 0; j < i; ++j)
        if (do_meet(after[i], after[j]) && !is_forgiven(before[i], before[j]))
          return Violation_kind::intersection;
    }
    for (std::size_t i = 0; i < after.size(); ++i)
      for (const Index_triple& f : others)
        if (CGAL::do_overlap(box_of(moving[i]) + m_points[t].bbox(), box_of(f)) &&
            !oracle::is_sweep_clear<Number>(exact(m), exact(t), after[i][1], after[i][2], exact(f)) &&
            !is_forgiven(before[i], exact(f)))
          return Violation_kind::tunnelling;
    for (const Index_triple& f : contracted) {
      const std::size_t k = std::size_t(std::find(f.begin(), f.end(), m) - f.begin());
      before.push_back({exact(m), exact(f[(k + 1) % 3]), exact(f[(k + 2) % 3])});
    }
    for (std::size_t i = 0; i < before.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        oracle::Star<Number> motion{exact(m), exact(t), {}, {}};
        for (const std::size_t k : i == j ? std::vector{i} : std::vector{i, j})
          (k < moving.size() ? motion.moving : motion.contracted).push_back({before[k][1], before[k][2]});
        if (!oracle::is_star_motion_clear(motion) && (i == j || !is_forgiven(before[i], before[j])))
          return Violation_kind::tunnelling;
      }
    return std::nullopt;
  }

  bool is_forgiven(const Exact_triangle& a, const Exact_triangle& b) const
  {
    return m_is_old_forgiven && do_meet(a, b);
  }

  static bool do_meet(const Exact_triangle& a, const Exact_triangle& b)
  {
    std::vector<bool> shared;
    for (const Exact_point& p : b)
      shared.push_back(std::find(a.begin(), a.end(), p) != a.end());
    return (shared[0] && shared[1] && shared[2]) ||
           oracle::meets_beyond<Number>({a[0], a[1], a[2]}, {b[0], b[1], b[2]}, shared);
  }

  // How many of `faces` have the edge, and whether two of them run along it in opposite ways.
  bool is_border(Index v, Index w) const
  {
    int forward = 0, backward = 0;
    for (const Index_triple& f : m_triangles)
      for (int k = 0; k < 3; ++k) {
        forward += f[k] == v && f[(k + 1) % 3] == w;
        backward += f[k] == w && f[(k + 1) % 3] == v;
      }
    return forward != 1 || backward != 1;
  }

  // Partners, word for word as snapping.h has it; asked of every edge of the mesh.
  bool are_partners(Index m, Index t) const
  {
    const std::vector<Step> sides = border_sides();
    const auto is_sewable = [&](Index a, Index b) {
      for (const Step& from_a : sides)
        for (const Step& to_b : sides)
          if (from_a.first == a && to_b.second == b && !is_beyond_weld_distance(from_a.second, to_b.first))
            return true;
      return false;
    };
    return (is_sewable(m, t) || is_sewable(t, m)) && !is_shortly_followed(sides, m, t) &&
           !is_shortly_followed(sides, t, m);
  }

  // Lengths are sums of roots: in doubles, which the scenes do not come near to.
  bool is_shortly_followed(const std::vector<Step>& sides, Index a, Index b) const
  {
    double length = 0;
    for (Index at = a; length <= 2 * m_weld_distance;) {
      if (at == b)
        return true;
      std::vector<Index> next;
      std::size_t arriving = 0;
      for (const Step& side : sides) {
        arriving += side.second == at;
        if (side.first == at)
          next.push_back(side.second);
      }
      if (next.size() != 1 || (at != a && arriving != 1) || next.front() == a)
        return false;
      length += std::sqrt(CGAL::squared_distance(m_points[at], m_points[next.front()]));
      at = next.front();
    }
    return false;
  }

  // Sides of triangles that are alone in their place, as their triangles run.
  std::vector<Step> border_sides() const
  {
    std::map<std::pair<Index, Index>, int> uses;
    for (const Index_triple& f : m_triangles)
      for (int k = 0; k < 3; ++k)
        ++uses[std::minmax(f[k], f[(k + 1) % 3])];
    std::vector<Step> sides;
    for (const Index_triple& f : m_triangles)
      for (int k = 0; k < 3; ++k)
        if (uses[std::minmax(f[k], f[(k + 1) % 3])] == 1)
          sides.emplace_back(f[k], f[(k + 1) % 3]);
    return sides;
  }

  // Whether edges that become one were borders, and are of two triangles that run opposite ways afterwards.
  bool is_sewing_manifold(Index m, Index t) const
  {
    const std::set<Index> at_m = neighbours(m), at_t = neighbours(t);
    return std::all_of(at_m.begin(), at_m.end(), [&](Index v) {
      if (at_t.count(v) == 0)
        return true;
      int from = 0, to = 0;
      for (const Index w : {m, t}) {
        int of_one = 0;
        for (const Index_triple& f : m_triangles)
          for (int k = 0; k < 3; ++k) {
            const bool is_from = f[k] == v && f[(k + 1) % 3] == w, is_to = f[k] == w && f[(k + 1) % 3] == v;
            from += is_from;
            to += is_to;
            of_one += is_from || is_to;
          }
        if (of_one != 1)
          return false;
      }
      return from == 1 && to == 1;
    });
  }

  bool is_beyond_weld_distance(Index v, Index w) const
  {
    const Exact_point u = oracle::difference(exact(v), exact(w));
    return oracle::dot(u, u) > m_unit(m_weld_distance) * m_unit(m_weld_distance);
  }

  std::set<Index> neighbours(Index v) const
  {
    std::set<Index> result;
    for (const Index_triple& f : m_triangles)
      if (has(f, v))
        result.insert(f.begin(), f.end());
    result.erase(v);
    return result;
  }

  int fans(Index m, std::vector<Index_triple> star) const
  {
    int count = 0;
    while (!star.empty()) {
      ++count;
      std::vector<Index_triple> fan{star.back()};
      star.pop_back();
      for (std::size_t i = 0; i < fan.size(); ++i)
        for (std::size_t j = star.size(); j-- > 0;)
          if (std::any_of(fan[i].begin(), fan[i].end(),
                          [&](Index v) { return v != m && has(star[j], v) && !is_border(m, v); })) {
            fan.push_back(star[j]);
            star.erase(star.begin() + std::ptrdiff_t(j));
          }
    }
    return count;
  }

  bool is_link_condition_met(Index m, Index t, const std::vector<Index_triple>& contracted) const
  {
    const std::set<Index> at_m = neighbours(m), at_t = neighbours(t);
    for (const Index v : at_m) {
      const bool is_apex = std::any_of(contracted.begin(), contracted.end(),
                                       [&](const Index_triple& f) { return has(f, v) && v != t; });
      if (at_t.count(v) > 0 && !is_apex)
        return false;
      if (is_apex && is_border(m, v) && is_border(t, v))
        return false;
    }
    const auto is_on_border = [&](Index v, const std::set<Index>& around) {
      return std::any_of(around.begin(), around.end(), [&](Index w) { return is_border(v, w); });
    };
    return !is_on_border(m, at_m) || !is_on_border(t, at_t) || is_border(m, t);
  }

  CGAL::Bbox_3 box_of(const Index_triple& f) const
  {
    return m_points[f[0]].bbox() + m_points[f[1]].bbox() + m_points[f[2]].bbox();
  }
  CGAL::Bbox_3 box_of_star(Index m, Index t) const
  {
    CGAL::Bbox_3 box = m_points[m].bbox() + m_points[t].bbox();
    for (const Index_triple& f : m_triangles)
      if (has(f, m))
        box += box_of(f);
    return box;
  }

  void find_unit()
  {
    m_unit.consider(m_weld_distance);
    for (const Point_3& point : m_points)
      for (int axis = 0; axis < 3; ++axis)
        m_unit.consider(point[axis]);
  }

  Exact_point exact(Index v) const
  {
    return {m_unit(m_points[v].x()), m_unit(m_points[v].y()), m_unit(m_points[v].z())};
  }
  Exact_triangle exact(const Index_triple& f) const { return {exact(f[0]), exact(f[1]), exact(f[2])}; }

  std::vector<Point_3> m_points;
  const double m_weld_distance;
  Exact_unit m_unit;             // of all coordinates
  std::vector<Index> m_position; // by vertex, at the start
  std::vector<Index> m_now;      // and after the snaps so far
  std::vector<Index_triple> m_start, m_triangles;
  std::map<std::vector<Index>, std::optional<Violation_kind>> m_answers;
  bool m_is_old_forgiven = false;
};

/// A log, taken apart; what it says of vertices at one position is left out.
struct Log_parts
{
  std::string head, result;
  std::vector<Step> steps;

  explicit Log_parts(const std::string& log)
  {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      if (line[0] == 'c' || line.rfind("s ", 0) == 0) {
        std::istringstream words(line.substr(2));
        Index moved, kept;
        words >> moved >> kept;
        steps.emplace_back(moved, kept, line[0] == 's');
      } else if (line[0] != 'w') {
        (line.rfind("result", 0) == 0 ? result : head) += line + '\n';
      }
    }
  }

  std::string with(const std::vector<Step>& changed) const
  {
    std::string text = head;
    for (const Step& step : changed)
      text += (step.is_snap ? "s " : "c ") + std::to_string(step.first) + ' ' + std::to_string(step.second) +
              '\n';
    return text + result;
  }
};

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_SLOW_JUDGE_H
