// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What a view proves in floating point, against the exact test: it may be silent, never wrong.

#include <selvedge/Triangle_soup.h>
#include <selvedge/geometry/internal/Separation_filter.h>
#include <selvedge/geometry/sweep.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace selvedge::test {
namespace {

using Local = Separation_filter::Index;

/// A moving face (m, a, b), which goes to (t, a, b), and one that stands still.
struct Case
{
  std::array<Point_3, 4> moving; // a, b, m, t
  std::array<Point_3, 3> still;

  /// As the test's preconditions ask, and with nothing to share for m.
  bool is_valid() const
  {
    const auto& [a, b, m, t] = moving;
    return !CGAL::collinear(m, a, b) && t != m && t != a && t != b &&
           std::find(still.begin(), still.end(), m) == still.end() && still[0] != still[1] &&
           still[1] != still[2] && still[2] != still[0];
  }
};

struct Proofs
{
  bool by_box = false, by_edge = false, by_plane = false, by_edge_of_sweep = false, by_slab = false;
  bool any() const { return by_box || by_edge || by_plane || by_edge_of_sweep || by_slab; }
};

std::optional<Proofs> proofs(const Case& c, const Separation_filter::Vector& normal)
{
  Separation_filter view;
  std::vector<Point_3> points;
  const auto number = [&](const Point_3& p) {
    const auto found = std::find(points.begin(), points.end(), p);
    if (found != points.end())
      return Local(found - points.begin());
    points.push_back(p);
    return view.add({p.x(), p.y(), p.z()});
  };
  const Point_3& origin = c.moving[2];
  view.begin({origin.x(), origin.y(), origin.z()}, normal);
  std::array<Local, 4> moving;
  std::array<Local, 3> still;
  std::transform(c.moving.begin(), c.moving.end(), moving.begin(), number);
  view.enclose();
  std::transform(c.still.begin(), c.still.end(), still.begin(), number);
  if (!view.is_usable())
    return std::nullopt;
  const auto [a, b, m, t] = moving;
  return Proofs{view.is_clear_of_box(still), view.is_clear_by_edge(still, moving),
                view.heights(still, points.size()).is_clear(Separation_filter::mask(moving)),
                view.is_clear_by_edge_of(moving, still),
                view.is_clear_of_slab(still, view.slab({a, b, m}, t)) ||
                    view.is_clear_of_slab(still, view.slab({a, b, t}, m))};
}

/// Which proofs there were.
Proofs compare(const std::function<Point_3(std::mt19937_64&)>& draw, std::size_t cases, double least_share)
{
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::size_t> seventh(0, 6);
  std::normal_distribution<double> component;
  std::size_t clear = 0, proved = 0, meeting = 0;
  Proofs seen;
  for (std::size_t i = 0; i < cases; ++i) {
    Case c;
    std::generate(c.moving.begin(), c.moving.end(), [&] { return draw(random); });
    for (Point_3& p : c.still) {
      // Shared positions must not be rare.
      const std::size_t which = seventh(random);
      p = which < 4 && which != 2 ? c.moving[which] : draw(random);
    }
    if (!c.is_valid())
      continue;
    const std::optional<Proofs> found = proofs(c, {component(random), component(random), component(random)});
    if (!found)
      continue;
    const auto& [a, b, m, t] = c.moving;
    const bool is_clear = Sweep_test<Kernel>(m, t, a, b).is_clear(c.still[0], c.still[1], c.still[2]);
    clear += is_clear;
    meeting += !is_clear;
    proved += found->any();
    seen.by_box |= found->by_box;
    seen.by_edge |= found->by_edge;
    seen.by_plane |= found->by_plane;
    seen.by_edge_of_sweep |= found->by_edge_of_sweep;
    seen.by_slab |= found->by_slab;
    EXPECT_TRUE(is_clear || !found->any()) << "case " << i << ": " << found->by_box << found->by_edge
                                           << found->by_plane << found->by_edge_of_sweep << found->by_slab;
  }
  EXPECT_GT(meeting, cases / 100);
  EXPECT_GT(double(proved), least_share * double(clear));
  return seen;
}

TEST(Separation_filter, IsNeverWrongOnASmallGrid)
{
  const Proofs seen = compare(
      [](std::mt19937_64& random) {
        std::uniform_int_distribution<int> coordinate(0, 3);
        const int x = coordinate(random), y = coordinate(random);
        return Point_3(x, y, coordinate(random));
      },
      300000, 0.3);
  EXPECT_TRUE(seen.by_box && seen.by_edge && seen.by_plane && seen.by_edge_of_sweep && seen.by_slab);
}

TEST(Separation_filter, IsNeverWrongNearAPlane)
{
  // Heights of a few units in the last place of the coordinates: less than any plane of a triangle can prove.
  const Proofs seen = compare(
      [](std::mt19937_64& random) {
        std::uniform_int_distribution<int> coordinate(0, 4), height(-2, 2);
        const double unit = std::numeric_limits<double>::epsilon();
        const int x = coordinate(random), y = coordinate(random);
        return Point_3(x, y, 1 + unit * height(random));
      },
      300000, 0.05);
  EXPECT_TRUE(seen.by_edge && seen.by_edge_of_sweep && !seen.by_plane);
}

TEST(Separation_filter, IsNeverWrongOnAGridShakenByUnitsInTheLastPlace)
{
  compare(
      [](std::mt19937_64& random) {
        std::uniform_int_distribution<int> coordinate(1, 3), shift(-1, 1);
        const auto shaken = [&] {
          return coordinate(random) * (1 + std::numeric_limits<double>::epsilon() * shift(random));
        };
        const double x = shaken(), y = shaken();
        return Point_3(x, y, shaken());
      },
      300000, 0.1);
}

TEST(Separation_filter, IsNeverWrongFarFromTheOrigin)
{
  compare(
      [](std::mt19937_64& random) {
        std::uniform_int_distribution<int> coordinate(0, 3);
        const int x = coordinate(random), y = coordinate(random);
        return Point_3(1e15 + x, -1e15 + y, 3e14 + coordinate(random));
      },
      100000, 0.3);
}

TEST(Separation_filter, IsNeverWrongAcrossScales)
{
  compare(
      [](std::mt19937_64& random) {
        std::uniform_real_distribution<double> exponent(-12, 0), sign(-1, 1);
        const auto coordinate = [&] { return std::copysign(std::pow(10, exponent(random)), sign(random)); };
        const double x = coordinate(), y = coordinate();
        return Point_3(x, y, coordinate());
      },
      300000, 0.1);
}

/// Draws points of integer coordinates, and makes others from them that are collinear or coplanar exactly,
/// though their coordinates in a view are rounded.
class Integer_points
{
public:
  using Vector = Separation_filter::Vector;

  explicit Integer_points(std::uint64_t seed) : m_random(seed) {}

  double integer(int size) { return std::uniform_int_distribution<int>(-size, size)(m_random); }

  Vector draw()
  {
    const int size = 1 << std::uniform_int_distribution<int>(2, 19)(m_random);
    const double x = integer(size), y = integer(size);
    return {x, y, integer(size)};
  }

  /// A view along any direction, with the extent of a few points near its origin: as that of a small star is
  /// before faces beside it are seen.
  Separation_filter view() { return view(draw()); }
  Separation_filter view(const Vector& normal)
  {
    Separation_filter result;
    result.begin({0, 0, 0}, normal);
    for (double i = integer(4); i > 0; --i)
      result.add({integer(1), integer(1), integer(1)});
    return result;
  }

private:
  std::mt19937_64 m_random;
};

/// o + i u + j v.
Separation_filter::Vector sum(const Separation_filter::Vector& o, double i,
                              const Separation_filter::Vector& u, double j = 0,
                              const Separation_filter::Vector& v = {})
{
  return {o[0] + i * u[0] + j * v[0], o[1] + i * u[1] + j * v[1], o[2] + i * u[2] + j * v[2]};
}

TEST(Separation_filter, KnowsNoSideOfALineForAPointOnIt)
{
  Integer_points points(7);
  for (int i = 0; i < 100000; ++i) {
    Separation_filter view = points.view();
    const auto start = points.draw(), step = points.draw();
    const auto add = [&] { return view.add(sum(start, points.integer(40), step)); };
    const Local p = add(), q = add(), r = add();
    ASSERT_EQ(view.side(p, q, r), 0) << "case " << i;
  }
}

TEST(Separation_filter, KnowsNoSideOfAPlaneForAPointInIt)
{
  Integer_points points(7);
  for (int i = 0; i < 100000; ++i) {
    Separation_filter view = points.view();
    const auto start = points.draw(), u = points.draw(), v = points.draw();
    const auto add = [&] { return view.add(sum(start, points.integer(20), u, points.integer(20), v)); };
    const Local a = add(), b = add(), c = add(), p = add();
    const Separation_filter::Heights heights = view.heights({a, b, c}, p + 1);
    ASSERT_EQ((heights.above | heights.below) >> p & 1, 0u) << "case " << i;
    ASSERT_FALSE(view.is_clear_of_slab({p, p, p}, view.slab({a, b, c}, a))) << "case " << i;
  }
}

TEST(Separation_filter, KnowsNoPointInTheRimOfABoxToBeOutside)
{
  Integer_points points(7);
  for (int i = 0; i < 100000; ++i) {
    // Along this direction, points whose coordinates have the same sum are at the same height, exactly.
    Separation_filter view = points.view({1, 1, 1});
    const auto start = points.draw(), u = points.draw(), v = points.draw();
    const Separation_filter::Vector across{u[0], -u[0], 0}, along{v[0], v[1], -v[0] - v[1]};
    for (const auto& [j, k] : {std::pair(40, 0), std::pair(-40, 0), std::pair(0, 40), std::pair(0, -40)})
      view.add(sum(start, j, across, k, along));
    view.enclose();
    const Local p = view.add(sum(start, points.integer(20), across, points.integer(20), along));
    ASSERT_FALSE(view.is_clear_of_box({p, p, p})) << "case " << i;
  }
}

// The error bounds are derived for axes of which no component is larger than 1.
TEST(Separation_filter, SeesNoDistanceLargerThanItIs)
{
  std::size_t usable = 0;
  for (const double longest : {1.0, 0x1p-400, 0x1p-490, 0x1p-500, 0x1p-530, 0x1p-537, 0x1p-538, 0x1p-1074})
    for (int i = 0; i < 512; ++i) {
      const auto component = [&](int digits) { return longest * (digits % 8) / 7; };
      Separation_filter view;
      view.begin({0, 0, 0}, {component(i), component(i / 8), component(i / 64)});
      for (const auto& axis : {Separation_filter::Vector{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        const Local p = view.add(axis);
        usable += view.is_usable();
        for (const double coordinate : view[p])
          EXPECT_TRUE(!view.is_usable() || std::fabs(coordinate) <= 1 + 1e-15)
              << coordinate << " for a normal as short as " << longest;
      }
    }
  EXPECT_GT(usable, 512u);
}

// Of the points from the 65th on no mask knows anything, least of all that they may be left out.
TEST(Separation_filter, ProvesNothingByThePlaneOfPointsThatNoMaskHolds)
{
  Separation_filter view;
  view.begin({0, 0, 0}, {0, 0, 1});
  for (int i = 0; i < 70; ++i)
    view.add({double(i % 10), double(i / 10), 0});
  const std::array<Local, 3> above{view.add({0, 0, 1}), view.add({9, 0, 1}), view.add({0, 9, 1})};
  const Local beyond = view.add({1, 1, 2});
  const Separation_filter::Heights heights = view.heights(above, beyond + 1);
  using Points = std::vector<Local>;
  EXPECT_TRUE(heights.is_clear(view.mask(Points{0, 1, 63})));
  for (const Points& points : {Points{0, 1, 64}, Points{0, 1, beyond}, Points{beyond, 0, 1}})
    EXPECT_FALSE(heights.is_clear(view.mask(points)));
}

TEST(Separation_filter, SaysNothingWhereProductsLeaveTheRangeOfDoubles)
{
  for (const double size : {1e-120, 1e120}) {
    Case c{{Point_3(size, 0, 0), Point_3(0, size, 0), Point_3(0, 0, 0), Point_3(0.1 * size, 0.1 * size, 0)},
           {Point_3(5 * size, 5 * size, 0), Point_3(6 * size, 5 * size, 0), Point_3(5 * size, 6 * size, 0)}};
    EXPECT_FALSE(proofs(c, {0, 0, 1}).has_value());
    for (auto* points : {c.moving.data(), c.still.data()})
      for (std::size_t i = 0; i < (points == c.moving.data() ? 4u : 3u); ++i)
        points[i] = Point_3(points[i].x() / size, points[i].y() / size, 0);
    EXPECT_TRUE(proofs(c, {0, 0, 1})->by_edge);
  }
  // No direction to look along.
  const Case c{{Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 0), Point_3(0.1, 0.1, 0)},
               {Point_3(5, 5, 0), Point_3(6, 5, 0), Point_3(5, 6, 0)}};
  EXPECT_FALSE(proofs(c, {0, 0, 0}).has_value());
}

} // namespace
} // namespace selvedge::test
