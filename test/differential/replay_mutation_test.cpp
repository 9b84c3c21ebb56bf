// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Logs with one thing changed, judged by the replay and by a slow oracle that asks linear programs over
// rationals about every pair: the same step is refused for the same reason, or only the result is another.

#include "support/Slow_judge.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <random>

namespace selvedge::test {
namespace {

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
  Log_parts m_parts;
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
