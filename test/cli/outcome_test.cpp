// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "apps/Outcome.h"
#include "apps/cost_of_poses.h"
#include "apps/fate_of_limit.h"

#include <gtest/gtest.h>

namespace selvedge::app {
namespace {

TEST(App_outcome, AGuardedResultThatTheJudgeRefusesIsNotWritten)
{
  Outcome outcome;
  EXPECT_TRUE(outcome.is_written());
  EXPECT_EQ(outcome.exit_code(), exit_done);
  outcome.is_accepted = false;
  EXPECT_FALSE(outcome.is_written());
  EXPECT_EQ(outcome.exit_code(), exit_not_verified);
  outcome.is_interrupted = true;
  EXPECT_EQ(outcome.exit_code(), exit_not_verified);
}

TEST(App_poses, SayEarlyWhatManyCost)
{
  EXPECT_EQ(cost_of_poses(0, 1'000'000, 0, 0), "");
  EXPECT_EQ(cost_of_poses(100, 60'000, 100, 1), "");
  EXPECT_EQ(cost_of_poses(1309, 61'666, 1309, 1),
            "1,309 further poses of 61,666 faces: all guarded, they take about 33 GB and 27 minutes; "
            "--every 9 takes 146 of them");
  EXPECT_EQ(
      cost_of_poses(1309, 61'666, 37, 2),
      "1,309 further poses of 61,666 faces: all guarded, they take about 33 GB and 27 minutes; 37 are at "
      "first, then those in which the judge finds new pairs; --every 18 takes 146 of them");
  EXPECT_EQ(cost_of_poses(200, 60'000, 200, 0),
            "200 further poses of 60,000 faces: all guarded, they take about 5 GB and 4 minutes; "
            "--key-poses auto guards few at first");
}

TEST(App_limit, IsSaidToHoldWhereItDoes)
{
  Bounds_over_poses largest;
  largest.upper = 0.0012;
  EXPECT_EQ(fate_of_limit(0.001, largest, {}, {}),
            "limit: 0.1 % holds at vertices and at points between them; --error-everywhere keeps it at every "
            "point");
  Error_search search(0.001);
  EXPECT_EQ(fate_of_limit(0.001, largest, search, {}), // as when it is interrupted
            "limit: 0.1 % holds at vertices and at points between them; the search for one that keeps it at "
            "every point did not end");
  largest.upper = 0.001;
  EXPECT_EQ(fate_of_limit(0.001, largest, {}, {}), "");
  EXPECT_EQ(fate_of_limit(0.001, largest, search, {}), "limit: 0.1 % holds at every point");
  search.advance(0.002);
  EXPECT_EQ(fate_of_limit(0.001, largest, search, {}).rfind("limit: 0.1 % holds at every point; found in 2 "),
            0u);
  Error_search least(1e-7);
  largest.upper = 1e-6;
  while (least.advance(largest.upper))
    ;
  EXPECT_EQ(
      fate_of_limit(1e-7, largest, least, {}).rfind("limit: whether 1e-05 % holds at every point is not"),
      0u);
  largest.lower = 9e-7;
  EXPECT_EQ(fate_of_limit(1e-7, largest, least, {}),
            "limit: 1e-05 % holds at vertices and at points between them; elsewhere it does not, nor with a "
            "smaller --error");
}

TEST(App_outcome, AnUnguardedResultIsWrittenAndNeverVerified)
{
  Outcome outcome;
  outcome.is_guarded = false;
  for (const bool is_accepted : {true, false}) {
    outcome.is_accepted = is_accepted;
    EXPECT_TRUE(outcome.is_written());
    EXPECT_EQ(outcome.exit_code(), exit_not_verified);
  }
}

TEST(App_outcome, AMissedTargetCountsOnlyWhereItIsRequired)
{
  Outcome outcome;
  outcome.is_reached = false;
  EXPECT_EQ(outcome.exit_code(), exit_done);
  outcome.is_target_required = true;
  EXPECT_EQ(outcome.exit_code(), exit_not_verified);
  outcome.is_interrupted = true;
  EXPECT_EQ(outcome.exit_code(), exit_interrupted);
}

} // namespace
} // namespace selvedge::app
