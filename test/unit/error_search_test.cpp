// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Error_search.h>

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace selvedge::test {
namespace {

TEST(Error_search, EndsWhereTheErrorIsKept)
{
  Error_search search(2);
  EXPECT_EQ(search.max_error(), 2);
  EXPECT_FALSE(search.advance(2));
  EXPECT_EQ(search.max_error(), 2);
  EXPECT_EQ(search.reductions(), 1u);
}

TEST(Error_search, LowersTheErrorByWhatIsTooMuch)
{
  Error_search search(2);
  EXPECT_TRUE(search.advance(4));
  EXPECT_LT(search.max_error(), 1);
  EXPECT_GT(search.max_error(), 0.9);
  EXPECT_EQ(search.reductions(), 2u);
  EXPECT_FALSE(search.advance(1.9));
}

TEST(Error_search, AsksForNoErrorWhenNothingHelps)
{
  for (const double upper : {2 + 1e-9, 1e300, std::numeric_limits<double>::infinity()}) {
    Error_search search(2);
    double last = search.max_error();
    while (search.advance(upper)) {
      EXPECT_LT(search.max_error(), last);
      last = search.max_error();
    }
    EXPECT_EQ(search.max_error(), 0) << upper;
    EXPECT_LE(search.reductions(), 8u) << upper;
  }
}

// Runs a search where a reduction with an error e keeps upper(e) everywhere; returns the last error.
template <class Function>
double last_error(Error_search& search, const Function& upper)
{
  while (search.advance(upper(search.max_error())))
    EXPECT_LE(search.reductions(), 10u);
  EXPECT_LE(upper(search.max_error()), 1);
  return search.max_error();
}

TEST(Error_search, TriesLargerErrorsWhereTheLimitIsKeptByFar)
{
  // As on a dress: the bound stays, whatever the error, until it falls at once.
  Error_search search(1);
  const double error = last_error(search, [](double e) { return e > 0.6 ? 1.2 : 0.5 * e; });
  EXPECT_GT(error, 0.53);
  EXPECT_LE(error, 0.6);
}

TEST(Error_search, ReturnsToTheBestErrorWhereLargerOnesDoNotKeepTheLimit)
{
  Error_search search(1);
  double first_kept = 0;
  const double error = last_error(search, [&](double e) {
    if (first_kept == 0 && e <= 0.6)
      first_kept = e;
    return e == first_kept ? 0.5 : 1.1;
  });
  EXPECT_EQ(error, first_kept);
}

TEST(Error_search, IsContentWithAnErrorThatComesNearTheLimit)
{
  Error_search search(1);
  last_error(search, [](double e) { return 1.3 * e; });
  EXPECT_EQ(search.reductions(), 2u);
}

TEST(Error_search, EndsWithAReductionThatKeepsTheLimit)
{
  for (unsigned seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    // Bounds differ from the error in no order that could be foreseen, but are the same for the same error.
    const auto upper = [seed](double e) {
      std::mt19937 random(seed + unsigned(e * 1e6));
      return e * std::uniform_real_distribution<double>(0.5, 3)(random);
    };
    Error_search search(1);
    last_error(search, upper);
  }
}

TEST(Error_search, GoesOnWhereAnErrorKeepsTheLimitNoMore)
{
  Error_search search(1);
  EXPECT_TRUE(search.advance(1.2));
  EXPECT_TRUE(search.advance(0.5)); // far below the limit
  EXPECT_TRUE(search.advance(1.1));
  EXPECT_TRUE(search.advance(1.1)); // the first that kept it is due again
  const double kept = search.max_error();
  EXPECT_TRUE(search.advance(1.2)); // and does not keep it in a further pose
  EXPECT_LT(search.max_error(), kept);
  EXPECT_FALSE(search.advance(0.5));
}

TEST(Error_search, HasNothingLessThanNoError)
{
  Error_search search(0);
  EXPECT_FALSE(search.advance(1e-17));
}

TEST(Error_search, GuardsThePoseWhereTheLargestDistanceIsBeforeItLowersTheError)
{
  const auto upper_in = [](double upper, std::optional<std::size_t> pose = {}) {
    Bounds_over_poses bounds;
    bounds.upper = upper;
    bounds.pose = pose;
    return bounds;
  };
  Error_search search(2);
  std::vector<std::size_t> guarded{1, 4};
  EXPECT_TRUE(search.advance({upper_in(1, 0), upper_in(3, 2), upper_in(2.5)}, guarded));
  EXPECT_EQ(guarded, (std::vector<std::size_t>{1, 2, 4}));
  EXPECT_EQ(search.max_error(), 2);
  EXPECT_EQ(search.reductions(), 1u);
  // It is guarded now, or it is the first pose, or the limit is kept.
  EXPECT_TRUE(search.advance({upper_in(3, 2), upper_in(1, 0)}, guarded));
  EXPECT_LT(search.max_error(), 2);
  EXPECT_EQ(search.reductions(), 2u);
  EXPECT_TRUE(search.advance({upper_in(2.5, 0), upper_in(3)}, guarded));
  EXPECT_FALSE(search.advance({upper_in(1.99, 0), upper_in(1.9)}, guarded));
  EXPECT_EQ(guarded, (std::vector<std::size_t>{1, 2, 4}));
}

} // namespace
} // namespace selvedge::test
