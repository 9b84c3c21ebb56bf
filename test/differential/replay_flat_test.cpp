// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What lies flat in a plane is judged without rational numbers, and as with them; so is what nearly does.

#include "../../src/replay/contact.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace selvedge::test {
namespace {

using reference::Place;

enum class Position { across_axis, slanted, off_by_ulps };

/// Places in a plane across an axis, or in one that contains no axis but one, or there but for some units in
/// the last place; by numbers that they share when they are the same.
class Plane
{
public:
  Plane(std::mt19937& random, Position position, int axis, double unit, unsigned size)
      : m_random(random), m_position(position), m_axis(axis), m_unit(unit), m_size(size)
  {
  }

  Place any()
  {
    reference::Coordinates at;
    for (double& coordinate : at)
      coordinate = m_unit * double(m_random() % m_size);
    at[m_axis] = m_position == Position::across_axis ? 7 * m_unit : at[(m_axis + 1) % 3];
    if (m_position == Position::off_by_ulps && m_random() % 2 == 0)
      for (unsigned i = m_random() % 3 + 1; i > 0; --i) {
        double& coordinate = at[m_random() % 3];
        coordinate = std::nextafter(coordinate, m_random() % 2 == 0 ? -m_unit : 9 * m_unit);
      }
    for (const Place& place : m_places)
      if (place.at == at)
        return place;
    m_places.push_back({Index(m_places.size()), at});
    return m_places.back();
  }

private:
  std::mt19937& m_random;
  Position m_position;
  int m_axis;
  double m_unit;
  unsigned m_size;
  std::vector<Place> m_places;
};

struct Counts
{
  int clear = 0, touching = 0;
};

// By rational numbers.
bool has_no_area_at_some_time(const Place& m, const Place& t, const Place& a, const Place& b)
{
  using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const auto exact = [](const Place& p) { return Kernel::Point_3(p.at[0], p.at[1], p.at[2]); };
  const auto area = [&](const Place& p) {
    return CGAL::cross_product(exact(a) - exact(p), exact(b) - exact(p));
  };
  return CGAL::coplanar(exact(m), exact(t), exact(a), exact(b)) && area(m) * area(t) <= 0;
}

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
  ASSERT_EQ(sweep.degenerates(), has_no_area_at_some_time(m, t, a, b));
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

constexpr int s_cases = 20000;

// Calls `check` with the statistics of what was clear, for each plane.
template <class Check>
void compare_all(Position position, unsigned seed, const Check& check)
{
  std::mt19937 random(seed);
  for (const int axis : {0, 1, 2})
    for (const double unit : {1.0, 0.1}) // tenths are no doubles: what should be collinear hardly is
      for (const unsigned size : {4u, 6u}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", axis " + std::to_string(axis) + ", unit " +
                     std::to_string(unit) + ", size " + std::to_string(size));
        Counts counts;
        reference::Contact_statistics of_clear;
        for (int i = 0; i < s_cases / 12 && !testing::Test::HasFatalFailure(); ++i)
          compare(random, Plane(random, position, axis, unit, size), counts, of_clear);
        EXPECT_GT(counts.clear, 50);
        EXPECT_GT(counts.touching, 50);
        check(of_clear);
      }
}

TEST(Flat, IsJudgedAsByRationalsAndWithoutThem)
{
  for (const Position position : {Position::across_axis, Position::slanted})
    compare_all(position, 11, [](const reference::Contact_statistics& of_clear) {
      EXPECT_EQ(of_clear.exact, 0u) << "of " << of_clear.pairs;
    });
}

TEST(Flat, IsJudgedAsByRationalsWhenUnitsInTheLastPlaceDecide)
{
  compare_all(Position::off_by_ulps, 12, [](const reference::Contact_statistics& of_clear) {
    EXPECT_LT(of_clear.exact, of_clear.pairs / 5) << "of " << of_clear.pairs;
  });
}

} // namespace
} // namespace selvedge::test
