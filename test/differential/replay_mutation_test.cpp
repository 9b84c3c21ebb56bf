// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Logs with one thing changed, judged by the replay and by a slow oracle that asks linear programs over
// rationals about every pair: the same step is refused for the same reason, or only the result is another.

#include "support/Exact_oracle.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <CGAL/Gmpq.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <random>
#include <set>

namespace selvedge::test {
namespace {

using Number = CGAL::Gmpq;
using Exact_point = oracle::Point<Number>;
using Exact_triangle = std::array<Exact_point, 3>;
using Step = std::pair<Index, Index>;
using Verdict = std::pair<std::size_t, Violation_kind>; // which step, from 1; 0 and `result` for the end

/// A mesh as a plain list of triangles over positions, which knows nothing but how to look through it.
class Slow_judge
{
public:
  explicit Slow_judge(const Triangle_soup& soup) : m_points(soup.points)
  {
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
    m_triangles = m_start;
    for (const auto& [m, t] : honest)
      take(m_position[m], m_position[t]);
    const std::vector<Index_triple> honest_end = m_triangles;
    m_triangles = m_start;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Index m = m_position[steps[i].first], t = m_position[steps[i].second];
      if (const std::optional<Violation_kind> kind = remembered(m, t))
        return {i + 1, *kind};
      take(m, t);
    }
    const bool is_same = m_triangles == honest_end && steps.size() == honest.size();
    return {0, is_same ? Violation_kind::no_edge : Violation_kind::result};
  }

private:
  static bool has(const Index_triple& triangle, Index v)
  {
    return triangle[0] == v || triangle[1] == v || triangle[2] == v;
  }

  void take(Index m, Index t)
  {
    m_triangles.erase(std::remove_if(m_triangles.begin(), m_triangles.end(),
                                     [&](const Index_triple& f) { return has(f, m) && has(f, t); }),
                      m_triangles.end());
    for (Index_triple& triangle : m_triangles)
      std::replace(triangle.begin(), triangle.end(), m, t);
  }

  /// The same question about the same triangles has the same answer.
  std::optional<Violation_kind> remembered(Index m, Index t)
  {
    const CGAL::Bbox_3 box = box_of_star(m, t);
    std::vector<Index> question{m, t};
    for (const Index_triple& f : m_triangles)
      if (has(f, t) || CGAL::do_overlap(box, box_of(f)))
        question.insert(question.end(), f.begin(), f.end());
    const auto [entry, is_new] = m_answers.emplace(question, std::nullopt);
    if (is_new)
      entry->second = violation(m, t);
    return entry->second;
  }

  std::optional<Violation_kind> violation(Index m, Index t) const
  {
    std::vector<Index_triple> star, contracted, moving, others;
    bool is_kept_there = false;
    for (const Index_triple& f : m_triangles) {
      is_kept_there = is_kept_there || has(f, t);
      (has(f, m) ? star : others).push_back(f);
    }
    for (const Index_triple& f : star)
      (has(f, t) ? contracted : moving).push_back(f);
    if (m == t || !is_kept_there || contracted.empty())
      return Violation_kind::no_edge;
    if (fans(m, star) != 1)
      return Violation_kind::locked;
    if (!is_link_condition_met(m, t, contracted))
      return Violation_kind::link;

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
            do_meet(after[i], exact(f)))
          return Violation_kind::intersection;
      for (std::size_t j = 0; j < i; ++j)
        if (do_meet(after[i], after[j]))
          return Violation_kind::intersection;
    }
    for (std::size_t i = 0; i < after.size(); ++i)
      for (const Index_triple& f : others)
        if (CGAL::do_overlap(box_of(moving[i]) + m_points[t].bbox(), box_of(f)) &&
            !oracle::is_sweep_clear<Number>(exact(m), exact(t), after[i][1], after[i][2], exact(f)))
          return Violation_kind::tunnelling;
    oracle::Star<Number> motion{exact(m), exact(t), {}, {}};
    for (const Exact_triangle& f : before)
      motion.moving.push_back({f[1], f[2]});
    for (const Index_triple& f : contracted) {
      const std::size_t k = std::size_t(std::find(f.begin(), f.end(), m) - f.begin());
      motion.contracted.push_back({exact(f[(k + 1) % 3]), exact(f[(k + 2) % 3])});
    }
    if (!oracle::is_star_motion_clear(motion))
      return Violation_kind::tunnelling;
    return std::nullopt;
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

  Exact_point exact(Index v) const
  {
    return {Number(m_points[v].x()), Number(m_points[v].y()), Number(m_points[v].z())};
  }
  Exact_triangle exact(const Index_triple& f) const { return {exact(f[0]), exact(f[1]), exact(f[2])}; }

  std::vector<Point_3> m_points;
  std::vector<Index> m_position;
  std::vector<Index_triple> m_start, m_triangles;
  std::map<std::vector<Index>, std::optional<Violation_kind>> m_answers;
};

/// A log, taken apart.
struct Parts
{
  std::string head, result;
  std::vector<Step> steps;

  explicit Parts(const std::string& log)
  {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      if (line[0] == 'c') {
        std::istringstream words(line.substr(2));
        steps.emplace_back();
        words >> steps.back().first >> steps.back().second;
      } else {
        (steps.empty() ? head : result) += line + '\n';
      }
    }
  }

  std::string with(const std::vector<Step>& changed) const
  {
    std::string text = head;
    for (const auto& [m, t] : changed)
      text += "c " + std::to_string(m) + ' ' + std::to_string(t) + '\n';
    return text + result;
  }
};

class Mutations
{
public:
  Mutations(const Triangle_soup& soup, const std::string& log) : m_soup(soup), m_parts(log), m_judge(soup) {}

  void compare(const std::vector<Step>& steps)
  {
    Replay_options options;
    options.are_limits_judged = false;
    const Replay_verdict verdict = replay_text(m_soup, m_parts.with(steps), options);
    Verdict found{0, Violation_kind::no_edge}; // stands for none
    if (!verdict.violations.empty())
      found = {verdict.violations.front().step, verdict.violations.front().kind};
    const Verdict expected = m_judge.judge(steps, m_parts.steps);
    EXPECT_EQ(found.first, expected.first);
    EXPECT_STREQ(name(found.second), name(expected.second));
    ++m_kinds[expected];
    ++counts[expected.second];
  }

  void run(unsigned seed, int count)
  {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return std::size_t(random() % n); };
    const std::size_t size = m_parts.steps.size();
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", mutation " + std::to_string(i));
      std::vector<Step> steps = m_parts.steps;
      const std::size_t which = below(size);
      switch (i % 5) {
      case 0: // two lines change places
        std::swap(steps[which], steps[below(size)]);
        break;
      case 1: // a line is missing
        steps.erase(steps.begin() + std::ptrdiff_t(which));
        break;
      case 2: // goes the other way
        std::swap(steps[which].first, steps[which].second);
        break;
      case 3: // goes to a neighbour in the original
        steps[which].second = neighbour(steps[which].first, below(6));
        break;
      default: { // one too many, along an edge of the original
        const Index m = Index(below(m_soup.points.size()));
        steps.insert(steps.begin() + std::ptrdiff_t(below(size / 4 + 1)), {m, neighbour(m, below(6))});
      }
      }
      compare(steps);
    }
  }

  const std::vector<Step>& steps() const { return m_parts.steps; }
  static std::map<Violation_kind, int> counts;

private:
  Index neighbour(Index v, std::size_t which) const
  {
    std::vector<Index> found;
    for (const Index_triple& t : m_soup.triangles)
      for (int k = 0; k < 3; ++k)
        if (t[k] == v)
          found.insert(found.end(), {t[(k + 1) % 3], t[(k + 2) % 3]});
    return found[which % found.size()];
  }

  const Triangle_soup m_soup;
  Parts m_parts;
  Slow_judge m_judge;
  std::map<Verdict, int> m_kinds;
};

std::map<Violation_kind, int> Mutations::counts;

#ifdef NDEBUG
constexpr int s_mutants = 75;
#else
constexpr int s_mutants = 20;
#endif

TEST(Mutation, OfLogsIsJudgedAsTheOracleDoes)
{
  Mutations::counts.clear();
  unsigned seed = 1;
  for (const Triangle_soup& scene :
       {sheets(160, 2, 2e-3), nested_spheres(110, 1, 1e-2), folded_cloth(120, 2, 2e-3)}) {
    // In few bits, which keeps the rationals of the oracle short.
    const Triangle_soup soup = mapped(scene, [](const Point_3& p) {
      const auto rounded = [](double x) { return std::round(x * 65536) / 65536; };
      return Point_3(rounded(p.x()), rounded(p.y()), rounded(p.z()));
    });
    ASSERT_TRUE(is_embedded(soup));
    const Logged_reduction reduction = reduce_and_log(soup, without_limits(to_ratio(0.5)));
    Mutations mutations(soup, reduction.log);
    ASSERT_GT(mutations.steps().size(), 20u);
    mutations.compare(mutations.steps());
    mutations.run(seed++, s_mutants);
  }
  for (const auto& [kind, count] : Mutations::counts)
    std::cout << "  " << name(kind) << ": " << count << '\n';
  EXPECT_GT(Mutations::counts[Violation_kind::result], 0);
  EXPECT_GT(Mutations::counts[Violation_kind::intersection], 0);
}

TEST(Mutation, OfUnguardedLogsIsJudgedAsTheOracleDoes)
{
  for (const Triangle_soup& soup : {sheets(240, 3, 1e-4), folded_cloth(200, 3, 1e-4)}) {
    const Logged_reduction reduction = reduce_and_log(soup, without_check(without_limits(to_ratio(0.3))));
    Mutations mutations(soup, reduction.log);
    mutations.compare(mutations.steps());
    mutations.run(7, s_mutants / 3);
  }
}

TEST(Mutation, ATunnellingCollapsePutIntoALog)
{
  const Tunnel_scene scene = tunnel_scene();
  Triangle_soup bare; // without labels, which the sheet does not have
  bare.points = scene.soup.points;
  bare.triangles = scene.soup.triangles;
  const Triangle_soup soup =
      joined(bare, mapped(sheet(3, 3), [](const Point_3& p) { return Point_3(p.x() + 9, p.y(), p.z()); }));
  const Index offset = Index(scene.soup.points.size());
  Mutations mutations(soup, "selvedge-log 1\ninput " + std::to_string(soup.points.size()) + ' ' +
                                std::to_string(soup.triangles.size()) + " -\nc " +
                                std::to_string(offset + 5) + ' ' + std::to_string(offset + 6) +
                                "\nresult 1 " + std::to_string(soup.triangles.size() - 2) + " -\n");
  Mutations::counts.clear();
  std::vector<Step> steps = mutations.steps();
  mutations.compare(steps);
  steps.emplace_back(scene.moving, scene.target);
  mutations.compare(steps);
  EXPECT_EQ(Mutations::counts[Violation_kind::tunnelling], 1);
}

} // namespace
} // namespace selvedge::test
