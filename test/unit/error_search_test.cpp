// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Error_search.h>

#include <gtest/gtest.h>

#include <limits>

namespace selvedge::test {
namespace {

TEST(Error_search, EndsWhereTheErrorIsKept)
{
  Error_search search(2);
  EXPECT_EQ(search.max_error(), 2);
  EXPECT_FALSE(search.lower(2));
  EXPECT_EQ(search.max_error(), 2);
  EXPECT_EQ(search.reductions(), 1u);
}

TEST(Error_search, LowersTheErrorByWhatIsTooMuch)
{
  Error_search search(2);
  EXPECT_TRUE(search.lower(4));
  EXPECT_LT(search.max_error(), 1);
  EXPECT_GT(search.max_error(), 0.9);
  EXPECT_EQ(search.reductions(), 2u);
  EXPECT_FALSE(search.lower(1.9));
}

TEST(Error_search, AsksForNoErrorWhenNothingHelps)
{
  for (const double upper : {2 + 1e-9, 1e300, std::numeric_limits<double>::infinity()}) {
    Error_search search(2);
    double last = search.max_error();
    while (search.lower(upper)) {
      EXPECT_LT(search.max_error(), last);
      last = search.max_error();
    }
    EXPECT_EQ(search.max_error(), 0) << upper;
    EXPECT_LE(search.reductions(), 8u) << upper;
  }
}

TEST(Error_search, HasNothingLessThanNoError)
{
  Error_search search(0);
  EXPECT_FALSE(search.lower(1e-17));
}

} // namespace
} // namespace selvedge::test
