// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Logs with one thing changed, judged by the replay and by a slow oracle that asks linear programs over
// rationals about every pair: the same step is refused for the same reason, or only the result is another.

#include "support/Slow_judge.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"
#include "support/tunnel_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <random>

namespace selvedge::test {
namespace {

class Mutations
{
public:
  Mutations(const Triangle_soup& soup, const std::string& log, double weld_distance = 0)
      : m_soup(soup), m_parts(log), m_judge(soup, weld_distance)
  {
  }

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

  /// Changes snaps; what follows them stays.
  void run_on_snaps(unsigned seed, int count)
  {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return std::size_t(random() % n); };
    const std::size_t size = std::size_t(std::count_if(m_parts.steps.begin(), m_parts.steps.end(),
                                                       [](const Step& step) { return step.is_snap; }));
    ASSERT_GT(size, 2u);
    std::vector<Index> ends;
    for (std::size_t i = 0; i < size; ++i)
      ends.insert(ends.end(), {m_parts.steps[i].first, m_parts.steps[i].second});
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", mutation " + std::to_string(i));
      std::vector<Step> steps = m_parts.steps;
      Step& step = steps[below(size)];
      switch (i % 9) {
      case 8: { // one too many, somewhere between the others, to a vertex nearby
        const Index m = ends[below(ends.size())];
        steps.insert(steps.begin() + std::ptrdiff_t(below(size + 1)), {m, nearest(m, below(3)), true});
        break;
      }
      case 0: // to the partner of another
        step.second = ends[below(ends.size())];
        break;
      case 1: // to a vertex nearby, mostly another partner, or one of its own piece
        step.second = nearest(step.first, below(6));
        break;
      case 2: // to any vertex, mostly far away, and not on a border
        step.second = Index(below(m_soup.points.size()));
        break;
      case 3: // of any vertex
        step.first = Index(below(m_soup.points.size()));
        break;
      case 4: // of a vertex near the partner
        step.first = nearest(step.second, below(6));
        break;
      case 5: // the other way
        std::swap(step.first, step.second);
        break;
      case 6: // two in the other order, so that others are partners, or none are
        std::swap(step, steps[below(size)]);
        break;
      default: // missing, so that the collapses after it are of another mesh
        steps.erase(steps.begin() + (&step - steps.data()));
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

  // Of the vertices that have no triangle in common with v, that which `rank` of them are nearer than.
  Index nearest(Index v, std::size_t rank) const
  {
    std::vector<std::pair<double, Index>> others;
    for (Index w = 0; w < m_soup.points.size(); ++w)
      if (std::none_of(m_soup.triangles.begin(), m_soup.triangles.end(), [&](const Index_triple& t) {
            return std::count(t.begin(), t.end(), v) > 0 && std::count(t.begin(), t.end(), w) > 0;
          }))
        others.emplace_back(CGAL::squared_distance(m_soup.points[v], m_soup.points[w]), w);
    std::nth_element(others.begin(), others.begin() + std::ptrdiff_t(rank), others.end());
    return others[rank].second;
  }

  const Triangle_soup m_soup;
  Log_parts m_parts;
  Slow_judge m_judge;
  std::map<Verdict, int> m_kinds;
};

std::map<Violation_kind, int> Mutations::counts;

#ifdef NDEBUG
constexpr int s_mutants = 40;
#else
constexpr int s_mutants = 20;
#endif

TEST(Mutation, OfLogsIsJudgedAsTheOracleDoes)
{
  Mutations::counts.clear();
  unsigned seed = 1;
  for (const Triangle_soup& scene :
       {sheets(160, 2, 2e-3), nested_spheres(110, 1, 1e-2), folded_cloth(120, 2, 2e-3)}) {
    // Few bits keep the rationals of the oracle short.
    const Triangle_soup soup = in_steps(scene, 65536);
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

/// Sheets around a corner, and one beneath, all jagged and apart by about `gap`; in few bits.
Triangle_soup gaping_sheets(Index size, double gap, unsigned seed)
{
  std::mt19937 random(seed);
  const auto jitter = [&] { return double(random() % 64) / 64; };
  Triangle_soup soup;
  for (const auto& [x, y, z] : {std::array{0.0, 0.0, 0.0},
                                {3 + gap, 0.0, 0.0},
                                {0.0, 3 + gap, 0.0},
                                {size + gap, size + gap, 0.0},
                                {size + gap, 0.0, -gap}})
    soup = joined(soup, mapped(sheet(size, size), [&, x = x, y = y, z = z](const Point_3& p) {
                    return Point_3(p.x() + x + gap * jitter() / 4, p.y() + y + gap * jitter() / 4,
                                   p.z() + z + gap * jitter() / 2);
                  }));
  return soup;
}

TEST(Mutation, OfSnapsIsJudgedAsTheOracleDoes)
{
  Mutations::counts.clear();
  for (unsigned seed = 1; seed <= 2; ++seed)
    for (const double gap : {1.0 / 32, 1.0 / 2}) { // the second is not small beside the squares of side 1
      const Triangle_soup soup = gaping_sheets(2, gap, seed);
      ASSERT_TRUE(is_embedded(soup));
      Prepare_options snapping;
      snapping.weld_distance = 2 * gap;
      const Logged_reduction reduction = reduce_and_log(soup, without_limits(to_ratio(0.6)), snapping);
      Mutations mutations(soup, reduction.log, snapping.weld_distance);
      mutations.compare(mutations.steps());
      mutations.run_on_snaps(seed, 75); // with fewer, some kind is missing
    }
  for (const auto& [kind, count] : Mutations::counts)
    std::cout << "  " << name(kind) << ": " << count << '\n';
  for (const Violation_kind kind :
       {Violation_kind::weld_distance, Violation_kind::partner, Violation_kind::link, Violation_kind::result})
    EXPECT_GT(Mutations::counts[kind], 0) << name(kind);
}

// Distances are not small beside edges, so that what one snap moves decides who is a partner of whom later.
TEST(Mutation, OwnSnapsAreAcceptedHoweverWideTheGap)
{
  std::size_t snaps = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
    for (const double gap : {1.0 / 16, 1.0 / 4, 1.0 / 2}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", gap " + std::to_string(gap));
      const Triangle_soup soup = gaping_sheets(3, gap, seed);
      Prepare_options snapping;
      snapping.weld_distance = 2 * gap;
      const Logged_reduction reduction = reduce_and_log(soup, to_ratio(0.5), snapping);
      const Replay_verdict verdict = replay_text(soup, reduction.log);
      EXPECT_TRUE(verdict.is_accepted())
          << verdict.violations.front().step << ": " << verdict.violations.front().message;
      snaps += verdict.snaps;
    }
  EXPECT_GT(snaps, 1000u);
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
  Mutations mutations(soup, head_of(soup) + "c " + std::to_string(offset + 5) + ' ' +
                                std::to_string(offset + 6) + "\nresult 1 " +
                                std::to_string(soup.triangles.size() - 2) + " -\n");
  Mutations::counts.clear();
  std::vector<Step> steps = mutations.steps();
  mutations.compare(steps);
  steps.emplace_back(scene.moving, scene.target);
  mutations.compare(steps);
  EXPECT_EQ(Mutations::counts[Violation_kind::tunnelling], 1);
}

} // namespace
} // namespace selvedge::test
