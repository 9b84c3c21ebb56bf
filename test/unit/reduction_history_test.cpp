// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Reduction_history.h>

#include <gtest/gtest.h>

namespace selvedge {
namespace {

Refusals refusals(std::size_t border)
{
  Refusals result;
  result.border = border;
  return result;
}

// Collapse i costs i, and i edges were refused before it.
Reduction_history history_of(std::size_t collapses)
{
  Reduction_history history;
  for (std::size_t i = 0; i < collapses; ++i)
    history.add(double(i), refusals(i));
  return history;
}

TEST(Reduction_history, HasASampleForEveryCollapseOfAFew)
{
  const Reduction_history history = history_of(256);
  ASSERT_EQ(history.samples().size(), 256u);
  for (std::size_t i = 0; i < 256; ++i) {
    const Reduction_history::Sample& sample = history.samples()[i];
    EXPECT_EQ(sample.collapses, i + 1);
    EXPECT_EQ(sample.least_cost, double(i));
    EXPECT_EQ(sample.largest_cost, double(i));
    EXPECT_EQ(sample.refused.border, i);
  }
}

TEST(Reduction_history, UnitesSamplesOfManyCollapses)
{
  constexpr std::size_t collapses = 1000, per_sample = 4;
  const Reduction_history history = history_of(collapses);
  ASSERT_EQ(history.samples().size(), collapses / per_sample);
  for (std::size_t i = 0; i < history.samples().size(); ++i) {
    const Reduction_history::Sample& sample = history.samples()[i];
    const std::size_t last = per_sample * (i + 1) - 1;
    EXPECT_EQ(sample.collapses, last + 1);
    EXPECT_EQ(sample.least_cost, double(per_sample * i));
    EXPECT_EQ(sample.largest_cost, double(last));
    EXPECT_EQ(sample.refused.border, last);
  }
  EXPECT_EQ(history_of(collapses + 1).samples().back().collapses, collapses + 1);
}

TEST(Reduction_history, EndsWithWhatIsRefusedAfterTheLastCollapse)
{
  Reduction_history history = history_of(3);
  history.finish(refusals(9));
  EXPECT_EQ(history.samples()[1].refused.border, 1u);
  EXPECT_EQ(history.samples()[2].refused.border, 9u);
  Reduction_history empty;
  empty.finish(refusals(9));
  EXPECT_TRUE(empty.samples().empty());
}

TEST(Reduction_history, CanBeCutAfterACollapse)
{
  const Reduction_history history = history_of(1000); // of which a sample has 4
  const Reduction_history within_a_sample = history.until(10);
  ASSERT_EQ(within_a_sample.samples().size(), 3u);
  EXPECT_EQ(within_a_sample.samples()[1].collapses, 8u);
  EXPECT_EQ(within_a_sample.samples()[2].collapses, 10u);
  EXPECT_EQ(within_a_sample.samples()[2].least_cost, 8);
  const Reduction_history between_samples = history.until(8);
  ASSERT_EQ(between_samples.samples().size(), 2u);
  EXPECT_EQ(between_samples.samples()[1].collapses, 8u);
  EXPECT_EQ(history.until(1000).samples().size(), history.samples().size());
}

} // namespace
} // namespace selvedge
