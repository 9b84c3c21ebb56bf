// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What lies flat in a plane across an axis is judged without rational numbers, and as with them.

#include "../../src/replay/contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace selvedge::test {
namespace {

using reference::Place;

/// Places in a plane, by numbers that they share when they are the same.
class Plane
{
public:
  Plane(std::mt19937& random, int axis, double unit, unsigned size)
      : m_random(random), m_axis(axis), m_unit(unit), m_size(size)
  {
  }

  Place any()
  {
    reference::Coordinates at;
    for (double& coordinate : at)
      coordinate = m_unit * double(m_random() % m_size);
    at[m_axis] = 7 * m_unit;
    for (const Place& place : m_places)
      if (place.at == at)
        return place;
    m_places.push_back({Index(m_places.size()), at});
    return m_places.back();
  }

private:
  std::mt19937& m_random;
  int m_axis;
  double m_unit;
  unsigned m_size;
  std::vector<Place> m_places;
};

struct Counts
{
  int clear = 0, touching = 0;
};

void compare(std::mt19937& random, Plane plane, Counts& counts, reference::Contact_statistics& of_clear)
{
  const Place m = plane.any(), t = plane.any(), a = plane.any(), b = plane.any();
  std::array<Place, 3> f;
  for (Place& corner : f)
    corner = random() % 3 == 0 ? std::array{t, a, b}[random() % 3] : plane.any();
  const std::size_t size = 2 + random() % 2;
  if (std::any_of(f.begin(), f.end(), [&](const Place& corner) { return corner.id == m.id; }) ||
      reference::is_degenerate({m, a, b}) || (size == 3 ? reference::is_degenerate(f) : f[0].id == f[1].id))
    return;
  reference::Contact_statistics statistics;
  const reference::Sweep sweep(m, t, a, b, statistics);
  const bool is_touching = sweep.contact({f, size}).has_value();
  if (!sweep.degenerates()) {
    // The fast way may presume that they do not meet at the start.
    const bool meets_at_start =
        reference::meeting_point({m, a, b}, size == 3 ? f : std::array{f[0], f[1], f[1]}).has_value();
    if (!meets_at_start) {
      ASSERT_EQ(sweep.touches({f, size}), is_touching);
    }
  }
  const std::array<Place, 3> end{t, a, b};
  if (size == 3 && !reference::is_degenerate(end)) {
    ASSERT_EQ(reference::do_meet(end, f, statistics), reference::meeting_point(end, f).has_value());
  }
  (is_touching ? counts.touching : counts.clear) += statistics.pairs > 0;
  if (!is_touching) {
    of_clear.pairs += statistics.pairs;
    of_clear.exact += statistics.exact;
  }
}

#ifdef NDEBUG
constexpr int s_cases = 20000;
#else
constexpr int s_cases = 3000;
#endif

TEST(Flat, IsJudgedAsByRationalsAndWithoutThem)
{
  std::mt19937 random(11);
  for (const int axis : {0, 1, 2})
    for (const double unit : {1.0, 0.1}) // tenths are no doubles: what should be collinear hardly is
      for (const unsigned size : {4u, 6u}) {
        SCOPED_TRACE("seed 11, axis " + std::to_string(axis) + ", unit " + std::to_string(unit) + ", size " +
                     std::to_string(size));
        Counts counts;
        reference::Contact_statistics of_clear;
        for (int i = 0; i < s_cases / 6 && !HasFatalFailure(); ++i)
          compare(random, Plane(random, axis, unit, size), counts, of_clear);
        EXPECT_GT(counts.clear, 50);
        EXPECT_GT(counts.touching, 50);
        EXPECT_EQ(of_clear.exact, 0u) << "of " << of_clear.pairs;
      }
}

} // namespace
} // namespace selvedge::test
