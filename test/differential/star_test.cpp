// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/geometry/star.h>

#include <support/Exact_oracle.h>
#include <support/Exact_unit.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// Wide enough for the determinants of small integers at rational times.
__extension__ using Integer = __int128;
using Star = selvedge::oracle::Star<Integer>;
using Grid_point = selvedge::oracle::Point<Integer>;
using selvedge::Star_verdict;

#ifdef NDEBUG
constexpr int case_scale = 1;
#else
constexpr int case_scale = 4;
#endif

template <class To>
typename To::Point_3 to_kernel(const Grid_point& p)
{
  return typename To::Point_3(double(p[0]), double(p[1]), double(p[2]));
}

template <class To>
selvedge::Vertex_motion<typename To::Point_3> to_kernel(const Star& star)
{
  selvedge::Vertex_motion<typename To::Point_3> motion{
      to_kernel<To>(star.from), to_kernel<To>(star.to), {}, {}};
  for (const auto& edge : star.moving)
    motion.moving.push_back({to_kernel<To>(edge[0]), to_kernel<To>(edge[1])});
  for (const auto& edge : star.contracted)
    motion.contracted.push_back({to_kernel<To>(edge[0]), to_kernel<To>(edge[1])});
  return motion;
}

std::string to_string(const Star& star)
{
  std::ostringstream out;
  const auto print = [&](const Grid_point& p) {
    out << '(' << int(p[0]) << ' ' << int(p[1]) << ' ' << int(p[2]) << ')';
  };
  print(star.from);
  out << " to ";
  print(star.to);
  for (const auto* edges : {&star.moving, &star.contracted}) {
    out << (edges == &star.moving ? ", moving " : ", contracted ");
    for (const auto& edge : *edges) {
      print(edge[0]);
      print(edge[1]);
      out << ' ';
    }
  }
  return out.str();
}

struct Class
{
  bool is_closed, is_collapse, is_flat;

  bool operator<(const Class& other) const
  {
    return std::tie(is_closed, is_collapse, is_flat) <
           std::tie(other.is_closed, other.is_collapse, other.is_flat);
  }
};

std::string to_string(const Class& c)
{
  return std::string(c.is_closed ? "closed" : "open") + (c.is_flat ? ", flat" : "") +
         (c.is_collapse ? ", collapse" : ", other placement");
}

/// Random stars that are embedded before the motion: any polygon of the grid {0..3}³ as a link, or a fan that
/// is flat but for one unit.
class Stars
{
public:
  explicit Stars(unsigned seed) : m_random(seed) {}

  std::pair<Star, Class> next()
  {
    for (;;) {
      const Class c{below(2) == 0, below(4) != 0, below(3) == 0};
      const bool is_fan = below(2) == 0;
      const std::size_t size = 3 + below(4);
      std::vector<Grid_point> link;
      Star star;
      if (is_fan) {
        std::vector<std::pair<double, Grid_point>> around;
        for (std::size_t i = 0; i < size; ++i) {
          const Grid_point p{Integer(below(9)) - 4, Integer(below(9)) - 4, c.is_flat ? 0 : Integer(below(2))};
          around.emplace_back(std::atan2(double(p[1]), double(p[0])), p);
        }
        std::sort(around.begin(), around.end());
        for (const auto& p : around)
          link.push_back(p.second);
        std::rotate(link.begin(), link.begin() + below(size), link.end());
        star.from = {0, 0, 0};
        star.to = {Integer(below(7)) - 3, Integer(below(7)) - 3, c.is_flat ? 0 : Integer(below(3)) - 1};
      } else {
        const auto point = [&] {
          return Grid_point{Integer(below(4)), Integer(below(4)), c.is_flat ? 0 : Integer(below(4))};
        };
        for (std::size_t i = 0; i < size; ++i)
          link.push_back(point());
        star.from = point();
        star.to = point();
      }
      if (c.is_collapse)
        star.to = link[below(size)];
      if (star.to == star.from || (!c.is_closed && link.front() == link.back()))
        continue;

      std::vector<std::array<Grid_point, 2>> edges;
      for (std::size_t i = 0; i + (c.is_closed ? 0 : 1) < size; ++i)
        edges.push_back({link[i], link[(i + 1) % size]});
      if (!selvedge::oracle::is_star_embedded(star.from, edges))
        continue;
      std::shuffle(edges.begin(), edges.end(), m_random);
      for (const auto& edge : edges) {
        const bool is_contracted = c.is_collapse && (edge[0] == star.to || edge[1] == star.to);
        (is_contracted ? star.contracted : star.moving).push_back(edge);
      }
      if (!star.moving.empty())
        return {star, c};
    }
  }

private:
  std::size_t below(std::size_t n) { return m_random() % n; }

  std::mt19937 m_random;
};

TEST(Star, AgreesWithLinearProgrammingAtAllTimesThatMatter)
{
  constexpr unsigned seed = 99;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Stars stars(seed);
  std::map<Class, std::map<Star_verdict, int>> counts;
  for (int i = 0; i < 100000 / case_scale; ++i) {
    const auto [star, c] = stars.next();
    const bool is_clear = selvedge::oracle::is_star_motion_clear(star);
    const auto motion = to_kernel<Kernel>(star);
    const Star_verdict verdict = selvedge::judge_star_motion<Kernel>(motion);
    ASSERT_EQ(verdict != Star_verdict::refused, is_clear) << to_string(star);
    ASSERT_EQ(selvedge::is_star_motion_clear<Kernel>(motion), is_clear) << to_string(star);
    // The second step alone decides everything, too.
    ASSERT_EQ(selvedge::internal::is_star_clear_by_pairs(motion, Kernel()), is_clear) << to_string(star);
    ++counts[c][verdict];
  }

  for (const bool is_closed : {false, true}) {
    for (const bool is_collapse : {false, true}) {
      for (const bool is_flat : {false, true}) {
        const Class c{is_closed, is_collapse, is_flat};
        EXPECT_GT(counts[c][Star_verdict::refused], 0) << to_string(c);
        if (is_closed)
          EXPECT_GT(counts[c][Star_verdict::clear_by_view], 0) << to_string(c);
        else
          EXPECT_EQ(counts[c][Star_verdict::clear_by_view], 0) << to_string(c);
        // What is flat and legal is legal in the plane, where the view from above is as good as any.
        if (!is_closed || !is_flat) {
          EXPECT_GT(counts[c][Star_verdict::clear_by_pairs], 0) << to_string(c);
        }
      }
    }
  }
}

TEST(Star, IsTheSameForExactKernels)
{
  constexpr unsigned seed = 8;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Stars stars(seed);
  for (int i = 0; i < 3000 / case_scale; ++i) {
    const Star star = stars.next().first;
    const bool is_clear = selvedge::is_star_motion_clear<Kernel>(to_kernel<Kernel>(star));
    using Lazy = CGAL::Exact_predicates_exact_constructions_kernel;
    using Rational = CGAL::Simple_cartesian<CGAL::Gmpq>;
    ASSERT_EQ(selvedge::is_star_motion_clear<Lazy>(to_kernel<Lazy>(star)), is_clear) << to_string(star);
    ASSERT_EQ(selvedge::is_star_motion_clear<Rational>(to_kernel<Rational>(star)), is_clear)
        << to_string(star);
  }
}

TEST(Star, ContractedFacesMatterOnlyAtTheEndOfAnOpenStar)
{
  // What the header says of contracted faces: without them the answer is the same, unless one of them has no
  // neighbour in the star across its edge (from, x). The others must occur, so that this says something.
  constexpr unsigned seed = 31;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Stars stars(seed);
  int inside = 0, at_the_end = 0;
  for (int i = 0; i < 100000 / case_scale; ++i) {
    const Star star = stars.next().first;
    if (star.contracted.empty())
      continue;
    auto motion = to_kernel<Kernel>(star);
    const bool is_clear = selvedge::internal::is_star_clear_by_pairs(motion, Kernel());
    motion.contracted.clear();
    const bool is_clear_without = selvedge::internal::is_star_clear_by_pairs(motion, Kernel());
    bool has_end = false;
    for (const auto& edge : star.contracted) {
      const Grid_point& x = edge[0] == star.to ? edge[1] : edge[0];
      has_end = has_end || std::none_of(star.moving.begin(), star.moving.end(),
                                        [&](const auto& other) { return other[0] == x || other[1] == x; });
    }
    if (has_end)
      at_the_end += is_clear != is_clear_without;
    else {
      ASSERT_EQ(is_clear, is_clear_without) << to_string(star);
      inside += !is_clear;
    }
  }
  EXPECT_GT(inside, 0);
  EXPECT_GT(at_the_end, 0);
}

TEST(Star, AgreesWithLinearProgrammingOnNearlyFlatDoubles)
{
  // Fans in a tilted plane, bent by rounding only or by a little more.
  constexpr unsigned seed = 12;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::map<Star_verdict, int> counts;
  for (int i = 0; i < 400 / case_scale;) {
    std::array<Kernel::Vector_3, 3> frame;
    for (auto& axis : frame)
      axis = Kernel::Vector_3(unit(random), unit(random), unit(random));
    const double height = i % 2 == 0 ? 0 : 1e-3;
    const auto place = [&](double x, double y) {
      return CGAL::ORIGIN + (x * frame[0] + y * frame[1] + height * unit(random) * frame[2]);
    };
    const std::size_t size = 4 + random() % 2;
    const bool is_closed = i % 4 != 3;
    std::vector<Kernel::Point_3> link;
    for (std::size_t k = 0; k < size; ++k) {
      const double angle = (k + 0.4 * unit(random)) * 2 * CGAL_PI / size, radius = 1 + 0.7 * unit(random);
      link.push_back(place(radius * std::cos(angle), radius * std::sin(angle)));
    }
    selvedge::Vertex_motion<Kernel::Point_3> motion{place(0, 0), link[random() % size], {}, {}};
    for (std::size_t k = 0; k + (is_closed ? 0 : 1) < size; ++k) {
      const auto &a = link[k], &b = link[(k + 1) % size];
      (a == motion.to || b == motion.to ? motion.contracted : motion.moving).push_back({a, b});
    }

    selvedge::test::Exact_axes to_exact;
    to_exact.consider(motion.from);
    for (const Kernel::Point_3& p : link)
      to_exact.consider(p);
    selvedge::oracle::Star<CGAL::Gmpz> star{to_exact(motion.from), to_exact(motion.to), {}, {}};
    for (const auto& edge : motion.moving)
      star.moving.push_back({to_exact(edge[0]), to_exact(edge[1])});
    for (const auto& edge : motion.contracted)
      star.contracted.push_back({to_exact(edge[0]), to_exact(edge[1])});
    auto faces = star.moving;
    faces.insert(faces.end(), star.contracted.begin(), star.contracted.end());
    if (!selvedge::oracle::is_star_embedded(star.from, faces))
      continue;
    ++i;

    const Star_verdict verdict = selvedge::judge_star_motion<Kernel>(motion);
    const bool is_clear = selvedge::oracle::is_star_motion_clear(star);
    ASSERT_EQ(verdict != Star_verdict::refused, is_clear) << "case " << i;
    ASSERT_EQ(selvedge::internal::is_star_clear_by_pairs(motion, Kernel()), is_clear) << "case " << i;
    ++counts[verdict];
  }
  EXPECT_GT(counts[Star_verdict::clear_by_view], 0);
  EXPECT_GT(counts[Star_verdict::clear_by_pairs], 0);
  EXPECT_GT(counts[Star_verdict::refused], 0);
}

} // namespace
