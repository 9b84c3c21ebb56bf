// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/geometry/clearance.h>

#include <support/Exact_oracle.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Rational_kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Rational = CGAL::Gmpq;
using Point = selvedge::oracle::Point<double>;

/// A star that moves, a face beside it, and the clearance.
struct Case
{
  selvedge::Vertex_motion<Point> motion;
  std::array<Point, 3> face;
  double distance;
};

std::string to_string(const Case& c)
{
  std::ostringstream out;
  out.precision(17);
  const auto print = [&](const Point& p) { out << '(' << p[0] << ' ' << p[1] << ' ' << p[2] << ") "; };
  print(c.motion.from);
  out << "to ";
  print(c.motion.to);
  for (const auto* edges : {&c.motion.moving, &c.motion.contracted}) {
    out << (edges == &c.motion.moving ? "moving " : "contracted ");
    for (const auto& edge : *edges) {
      print(edge[0]);
      print(edge[1]);
    }
  }
  out << "against ";
  for (const Point& p : c.face)
    print(p);
  out << "at " << c.distance;
  return out.str();
}

template <class To>
typename To::Point_3 to_kernel(const Point& p)
{
  return typename To::Point_3(p[0], p[1], p[2]);
}

template <class With>
bool judge(const Case& c, std::size_t* exact_decisions = nullptr)
{
  const auto to = to_kernel<With>;
  selvedge::Vertex_motion<typename With::Point_3> motion{to(c.motion.from), to(c.motion.to), {}, {}};
  for (const auto& [a, b] : c.motion.moving)
    motion.moving.push_back({to(a), to(b)});
  for (const auto& [a, b] : c.motion.contracted)
    motion.contracted.push_back({to(a), to(b)});
  selvedge::Clearance_test<With> test(c.distance);
  test.begin(motion);
  const bool is_kept = test.is_kept(to(c.face[0]), to(c.face[1]), to(c.face[2]));
  if (exact_decisions)
    *exact_decisions += test.exact_decisions();
  return is_kept;
}

/// The oracle: the least of CGAL's distances between all corners, edges and facets of two disjoint simplices.
Rational squared_distance(const std::vector<Point>& a, const std::vector<Point>& b)
{
  using Triangle = Rational_kernel::Triangle_3;
  const auto to = to_kernel<Rational_kernel>;
  Rational least = CGAL::squared_distance(to(a[0]), to(b[0]));
  const auto take = [&](const Rational& squared) { least = (std::min)(least, squared); };
  const auto for_each_edge = [&](const std::vector<Point>& simplex, const auto& call) {
    for (std::size_t i = 0; i < simplex.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        call(Rational_kernel::Segment_3(to(simplex[i]), to(simplex[j])));
  };
  for_each_edge(a, [&](const auto& of_a) {
    for_each_edge(b, [&](const auto& of_b) { take(CGAL::squared_distance(of_a, of_b)); });
  });
  for (const auto& [of, from] : {std::make_pair(&a, &b), std::make_pair(&b, &a)})
    for (std::size_t i = 0; i < of->size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k) {
          const Triangle facet(to((*of)[i]), to((*of)[j]), to((*of)[k]));
          for (const Point& p : *from)
            if (!facet.is_degenerate())
              take(CGAL::squared_distance(to(p), facet));
        }
  return least;
}

bool judge_by_oracle(const Case& c)
{
  const std::vector<Point> f(c.face.begin(), c.face.end());
  Rational least = CGAL::square(Rational(c.distance));
  for (const auto* edges : {&c.motion.moving, &c.motion.contracted})
    for (const auto& [a, b] : *edges)
      least = (std::min)(least, squared_distance({c.motion.from, a, b}, f));
  return std::all_of(c.motion.moving.begin(), c.motion.moving.end(), [&](const auto& edge) {
    return squared_distance({c.motion.from, c.motion.to, edge[0], edge[1]}, f) >= least;
  });
}

/// The preconditions of `Clearance_test`.
bool is_allowed(const Case& c)
{
  if (c.motion.moving.empty())
    return false;
  using selvedge::oracle::Point;
  const auto exact = [](const ::Point& p) {
    return Point<Rational>{Rational(p[0]), Rational(p[1]), Rational(p[2])};
  };
  const std::vector<Point<Rational>> f{exact(c.face[0]), exact(c.face[1]), exact(c.face[2])};
  for (const auto* edges : {&c.motion.moving, &c.motion.contracted})
    for (const auto& [a, b] : *edges)
      if (selvedge::oracle::meets_beyond<Rational>(
              {exact(c.motion.from), exact(c.motion.to), exact(a), exact(b)}, f, {false, false, false}))
        return false;
  return true;
}

/// Makes random cases out of points that `draw` returns.
class Cases
{
public:
  Cases(unsigned seed, std::function<Point(std::mt19937&)> draw, std::vector<double> distances)
      : m_random(seed), m_draw(std::move(draw)), m_distances(std::move(distances))
  {
  }

  Case next()
  {
    for (;;) {
      Case c;
      // The link is a closed or an open line of distinct points, and the goal is one of them or another.
      std::vector<Point> points;
      const std::size_t count = 3 + m_random() % 4;
      while (points.size() < count + 2)
        if (const Point p = m_draw(m_random); std::find(points.begin(), points.end(), p) == points.end())
          points.push_back(p);
      c.motion.from = points.back();
      c.motion.to = points[m_random() % 3 == 0 ? count : 0];
      const bool is_closed = m_random() % 2 == 0;
      for (std::size_t i = is_closed ? 0 : 1; i < count; ++i) {
        const Point &a = points[(i + count - 1) % count], &b = points[i];
        (a == c.motion.to || b == c.motion.to ? c.motion.contracted : c.motion.moving).push_back({a, b});
      }
      for (Point& p : c.face)
        p = m_draw(m_random);
      c.distance = m_distances[m_random() % m_distances.size()];
      if (c.face[0] != c.face[1] && c.face[1] != c.face[2] && c.face[2] != c.face[0] && is_allowed(c))
        return c;
    }
  }

private:
  std::mt19937 m_random;
  std::function<Point(std::mt19937&)> m_draw;
  std::vector<double> m_distances;
};

// All of them are frequent distances on the grid, or a little more or less.
Cases grid_cases(unsigned seed)
{
  return Cases(seed,
               [](std::mt19937& random) {
                 const auto bits = random();
                 return Point{double(bits & 3), double(bits >> 2 & 3), double(bits >> 4 & 3)};
               },
               {0.25, 0.5, std::sqrt(0.5), 1, std::nextafter(1., 2.), std::sqrt(2.), 2, 4});
}

Cases double_cases(unsigned seed)
{
  return Cases(seed,
               [](std::mt19937& random) {
                 std::uniform_real_distribution<double> coordinate(-1, 1);
                 return Point{coordinate(random), coordinate(random), coordinate(random) / 4};
               },
               {0.01, 0.1, 0.3, 1});
}

void compare(Cases cases, int count)
{
  std::array<int, 2> answers{};
  for (int i = 0; i < count; ++i) {
    const Case c = cases.next();
    const bool is_kept = judge_by_oracle(c);
    ASSERT_EQ(judge<Kernel>(c), is_kept) << to_string(c);
    ++answers[is_kept];
  }
  EXPECT_GT(answers[false], count / 20);
  EXPECT_GT(answers[true], count / 20);
}

TEST(Clearance, AgreesWithDistancesInRationalNumbersOnTheGrid)
{
  compare(grid_cases(20261124), 1500);
}

TEST(Clearance, AgreesWithDistancesInRationalNumbersBetweenAnyPoints)
{
  compare(double_cases(18), 300);
}

TEST(Clearance, IsTheSameForExactKernels)
{
  Cases cases = grid_cases(6);
  for (int i = 0; i < 500; ++i) {
    const Case c = cases.next();
    const bool is_kept = judge<Kernel>(c);
    ASSERT_EQ(judge<CGAL::Exact_predicates_exact_constructions_kernel>(c), is_kept) << to_string(c);
    ASSERT_EQ(judge<Rational_kernel>(c), is_kept) << to_string(c);
  }
}

TEST(Clearance, TakesExactNumbersWhereDistancesAreEqualAndSeldomElsewhere)
{
  std::size_t on_grid = 0, elsewhere = 0;
  Cases grid = grid_cases(7), doubles = double_cases(7);
  for (int i = 0; i < 500; ++i) {
    judge<Kernel>(grid.next(), &on_grid);
    judge<Kernel>(doubles.next(), &elsewhere);
  }
  EXPECT_GT(on_grid, 0u);
  EXPECT_LT(elsewhere, 5u);
}

TEST(Clearance, RefusesADistanceThatIsNone)
{
  for (const double distance : {0., -1., HUGE_VAL, std::nan("")})
    EXPECT_THROW(selvedge::Clearance_test<Kernel>{distance}, selvedge::Argument_error);
}

} // namespace
