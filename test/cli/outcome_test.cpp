// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "apps/Outcome.h"

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
