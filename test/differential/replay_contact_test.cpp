// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The two ways of the replay to a contact, against linear programming.

#include "../../src/replay/contact.h"
#include "support/Exact_oracle.h"
#include "support/Exact_unit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace selvedge::test {
namespace {

using Number = CGAL::Gmpz;
using Exact_point = oracle::Point<Number>;
using reference::Place;

struct Counts
{
  int cases = 0, touching = 0;
};

// The units of the axes: where one is small, layers are nearly flat.
void compare(std::mt19937& random, const std::array<double, 3>& units, bool is_on_grid, Counts& counts,
             reference::Contact_statistics& statistics)
{
  const auto coordinate = [&] {
    return is_on_grid ? double(random() % 4) : double(random() % 100000) / 30000;
  };
  std::vector<Place> places;
  const auto some_place = [&] {
    const reference::Coordinates at{units[0] * coordinate(), units[1] * coordinate(),
                                    units[2] * coordinate()};
    for (const Place& place : places)
      if (place.at == at)
        return place;
    places.push_back({Index(places.size()), at});
    return places.back();
  };
  const Place m = some_place(), t = some_place(), a = some_place(), b = some_place();
  std::array<Place, 3> f;
  for (Place& corner : f)
    corner = random() % 3 == 0 ? std::array{t, a, b}[random() % 3] : some_place();
  Exact_axes axes;
  for (const Place& place : places)
    axes.consider(place.at);
  const auto exact = [&](const Place& place) { return axes(place.at); };
  const auto is_proper = [&](const Place& x, const Place& y, const Place& z) {
    return !oracle::are_collinear(exact(x), exact(y), exact(z));
  };
  if (!is_proper(m, a, b) || !is_proper(f[0], f[1], f[2]) || m.id == t.id)
    return;
  std::vector<bool> shared;
  for (const Place& corner : f) {
    if (corner.id == m.id)
      return;
    shared.push_back(corner.id == a.id || corner.id == b.id);
  }
  const std::vector<Exact_point> standing{exact(f[0]), exact(f[1]), exact(f[2])};
  const reference::Sweep sweep(m, t, a, b, statistics);
  if (sweep.degenerates() || oracle::meets_beyond<Number>({exact(m), exact(a), exact(b)}, standing, shared))
    return;
  const bool is_touching = !oracle::is_sweep_clear<Number>(exact(m), exact(t), exact(a), exact(b),
                                                           {standing[0], standing[1], standing[2]});
  ++counts.cases;
  counts.touching += is_touching;
  ASSERT_EQ(sweep.touches({f, 3}), is_touching);
  ASSERT_EQ(sweep.contact({f, 3}).has_value(), is_touching);

  // At rest, at the end.
  const std::array<Place, 3> end{t, a, b};
  if (!is_proper(t, a, b))
    return;
  for (std::size_t k = 0; k < 3; ++k)
    shared[k] = f[k].id == t.id || f[k].id == a.id || f[k].id == b.id;
  const bool do_meet = (shared[0] && shared[1] && shared[2]) ||
                       oracle::meets_beyond<Number>({exact(t), exact(a), exact(b)}, standing, shared);
  ASSERT_EQ(reference::do_meet(end, f, statistics), do_meet);
  ASSERT_EQ(reference::meeting_point(end, f).has_value(), do_meet);
}

#ifdef NDEBUG
constexpr int s_cases = 12000;
#else
constexpr int s_cases = 3000;
#endif

TEST(Contact, BothWaysAgreeWithLinearProgramming)
{
  std::mt19937 random(5);
  reference::Contact_statistics statistics;
  for (const bool is_on_grid : {true, false})
    for (const double height : {1.0, 1e-9, 0.0}) {
      SCOPED_TRACE("seed 5, " + std::string(is_on_grid ? "grid" : "random") + ", height " +
                   std::to_string(height));
      Counts counts;
      for (int i = 0; i < s_cases / (is_on_grid ? 1 : 4) && !HasFatalFailure(); ++i)
        compare(random, {1, 1, height}, is_on_grid, counts, statistics);
      EXPECT_GT(counts.cases, 100);
      EXPECT_GT(counts.touching, 10);
      EXPECT_GT(counts.cases - counts.touching, 10);
    }
  EXPECT_LT(statistics.exact, statistics.pairs) << "the fast way was never gone";
}

TEST(Contact, BothWaysAgreeWithLinearProgrammingUpToTheEndsOfTheDoubles)
{
  std::mt19937 random(6);
  reference::Contact_statistics statistics;
  Counts counts;
  for (int i = 0; i < s_cases / 4 && !HasFatalFailure(); ++i) {
    constexpr std::array<int, 8> exponents{-1074, -1060, -700, -360, 0, 340, 700, 1021};
    std::array<double, 3> units;
    for (double& unit : units)
      unit = std::ldexp(1, exponents[random() % exponents.size()]);
    if (random() % 2 == 0)
      units = {units[0], units[0], units[0]};
    compare(random, units, true, counts, statistics);
  }
  EXPECT_GT(counts.cases, 100);
  EXPECT_GT(counts.touching, 10);
  EXPECT_GT(counts.cases - counts.touching, 10);
}

} // namespace
} // namespace selvedge::test
