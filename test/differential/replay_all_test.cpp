// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// All bad steps of unguarded runs, as the replay lists them and as a slow oracle does.

#include "support/Slow_judge.h"
#include "support/logged_reduction.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <iostream>
#include <map>

namespace selvedge::test {
namespace {

std::vector<Verdict> all_violations(const Triangle_soup& soup, const std::string& log)
{
  Replay_options options;
  options.are_limits_judged = false;
  options.is_all_wanted = true;
  std::vector<Verdict> verdicts;
  for (const Violation& violation : replay_text(soup, log, options).violations)
    verdicts.emplace_back(violation.step, violation.kind);
  return verdicts;
}

TEST(Replay_all, ListsTheBadStepsThatTheOracleFinds)
{
  std::map<Violation_kind, int> counts;
  const auto compare = [&](const Triangle_soup& scene, double ratio) {
    // Few bits keep the rationals of the oracle short.
    const Triangle_soup soup = in_steps(scene, 1048576);
    ASSERT_TRUE(is_embedded(soup));
    const Logged_reduction reduction = reduce_and_log(soup, without_check(without_limits(to_ratio(ratio))));
    const std::vector<Verdict> found = all_violations(soup, reduction.log);
    const std::vector<Verdict> expected = Slow_judge(soup).judge_all(Log_parts(reduction.log).steps);
    EXPECT_EQ(found, expected);
    EXPECT_GT(expected.size(), 1u) << "there is nothing to list";
    for (const Verdict& verdict : expected)
      ++counts[verdict.second];
  };
  {
    SCOPED_TRACE("sheets");
    compare(sheets(300, 3, 1e-4), 0.3);
  }
  {
    SCOPED_TRACE("folded");
    compare(folded_cloth(200, 5, 2e-5), 0.15);
  }
  {
    SCOPED_TRACE("skirt");
    compare(skirt(520, 2), 0.4);
  }
  for (const auto& [kind, count] : counts)
    std::cout << "  " << name(kind) << ": " << count << '\n';
}

// A guarded run has none, which the same oracle says.
TEST(Replay_all, ListsNothingOfAGuardedRun)
{
  const Triangle_soup soup = sheets(200, 2, 1e-3);
  const Logged_reduction reduction = reduce_and_log(soup, without_limits(to_ratio(0.5)));
  EXPECT_TRUE(all_violations(soup, reduction.log).empty());
  EXPECT_TRUE(Slow_judge(soup).judge_all(Log_parts(reduction.log).steps).empty());
}

} // namespace
} // namespace selvedge::test
