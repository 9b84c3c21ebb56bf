// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the shadow of a star proves in floating point, against the exact test of every sweep: it may be
// silent, never wrong.

#include "support/Exact_oracle.h"
#include "support/reduction.h"

#include <selvedge/Triangle_soup.h>
#include <selvedge/geometry/internal/Projected_star.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>

#include <CGAL/Exact_rational.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace selvedge::test {
namespace {

using Local = Separation_filter::Index;
using Random = std::mt19937_64;
constexpr Local s_from = 0, s_to = 1;

/// A closed star in a view from above.
class Star
{
public:
  /// `link` winds about `from`; `to` is one of it or none.
  Star(const Point_3& from, const Point_3& to, const std::vector<Point_3>& link) : m_points{from, to}
  {
    // Askew, so that the coordinates of the view are rounded.
    m_view.begin({from.x(), from.y(), from.z()}, {0.1, 0.07, 1});
    for (const Point_3& p : m_points)
      m_view.add({p.x(), p.y(), p.z()});
    // In the order of halfedges around a vertex: clockwise, each edge counter-clockwise.
    for (std::size_t i = link.size(); i-- > 0;)
      m_edges.push_back({number(link[i]), number(link[(i + 1) % link.size()])});
  }

  const Point_3& from() const { return m_points[s_from]; }

  /// The preconditions.
  bool is_seen_clear() const
  {
    return m_view.is_usable() && std::all_of(m_edges.begin(), m_edges.end(), [this](const auto& edge) {
             return m_view.side(s_from, edge[0], edge[1]) == 1 &&
                    (is_contracted(edge) || m_view.side(s_to, edge[0], edge[1]) == 1);
           });
  }

  bool is_seen_clear_of(const std::array<Point_3, 3>& face)
  {
    Projected_star projection;
    projection.begin(m_view, s_from, m_edges);
    const Local a = number(face[0]), b = number(face[1]);
    return projection.is_clear(m_view, {a, b, number(face[2])});
  }

  bool is_clear_of(const std::array<Point_3, 3>& face) const
  {
    return std::all_of(m_edges.begin(), m_edges.end(), [&](const auto& edge) {
      return is_contracted(edge) ||
             Sweep_test<Kernel>(m_points[s_from], m_points[s_to], m_points[edge[0]], m_points[edge[1]])
                 .is_clear(face[0], face[1], face[2]);
    });
  }

private:
  static bool is_contracted(const std::array<Local, 2>& edge) { return edge[0] == s_to || edge[1] == s_to; }

  Local number(const Point_3& p)
  {
    const auto found = std::find(m_points.begin(), m_points.end(), p);
    if (found != m_points.end())
      return Local(found - m_points.begin());
    m_points.push_back(p);
    return m_view.add({p.x(), p.y(), p.z()});
  }

  Separation_filter m_view;
  std::vector<Point_3> m_points;
  std::vector<std::array<Local, 2>> m_edges;
};

struct Counts
{
  std::size_t stars = 0, clear = 0, proved = 0, meeting = 0;

  /// Judges twenty random faces beside a star, exactly and by its projection. Each corner is drawn, or a
  /// vertex of the link.
  template <class Draw>
  void judge_faces(Star& star, const std::vector<Point_3>& link, const Draw& draw, Random& random)
  {
    std::uniform_int_distribution<std::size_t> vertex(0, link.size() - 1);
    std::bernoulli_distribution is_of_link(0.5);
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::array<Point_3, 3> face;
      std::generate(face.begin(), face.end(),
                    [&] { return is_of_link(random) ? link[vertex(random)] : draw(); });
      if (std::find(face.begin(), face.end(), star.from()) != face.end() || face[0] == face[1] ||
          face[1] == face[2] || face[2] == face[0])
        continue;
      const bool is_clear = star.is_clear_of(face), is_proved = star.is_seen_clear_of(face);
      EXPECT_TRUE(is_clear || !is_proved) << "star " << stars;
      clear += is_clear;
      meeting += !is_clear;
      proved += is_proved;
    }
  }
};

/// Random stars among random faces, all of points that are drawn.
Counts compare(const std::function<Point_3(Random&)>& draw, std::size_t cases)
{
  Random random(11);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  Counts counts;
  for (std::size_t i = 0; i < cases; ++i) {
    const Point_3 from = draw(random);
    std::vector<Point_3> link(3 + below(6));
    std::generate(link.begin(), link.end(), [&] { return draw(random); });
    const auto angle = [&](const Point_3& p) { return std::atan2(p.y() - from.y(), p.x() - from.x()); };
    std::sort(link.begin(), link.end(),
              [&](const Point_3& p, const Point_3& q) { return angle(p) < angle(q); });
    const Point_3 to = below(4) != 0 ? link[below(link.size())] : draw(random);
    Star star(from, to, link);
    // Distinct angles make distinct positions.
    if (to == from || !star.is_seen_clear())
      continue;
    ++counts.stars;
    counts.judge_faces(
        star, link, [&] { return draw(random); }, random);
  }
  return counts;
}

TEST(Projected_star, IsNeverWrongOnASmallGrid)
{
  const Counts counts = compare(
      [](Random& random) {
        std::uniform_int_distribution<int> coordinate(0, 4), height(0, 1);
        const int x = coordinate(random), y = coordinate(random);
        return Point_3(x, y, height(random));
      },
      200000);
  EXPECT_GT(counts.stars, 3000u);
  EXPECT_GT(counts.meeting, 10000u);
  EXPECT_GT(counts.proved, counts.clear / 5);
}

TEST(Projected_star, ProvesNearlyAllThatIsClearInAPlane)
{
  // Where all is flat, nothing can pass above or below.
  const Counts counts = compare(
      [](Random& random) {
        std::uniform_real_distribution<double> coordinate(0, 1);
        const double x = coordinate(random);
        return Point_3(x, coordinate(random), 0);
      },
      50000);
  EXPECT_GT(counts.meeting, 10000u);
  EXPECT_GT(counts.clear, 10000u);
  EXPECT_GT(double(counts.proved), 0.99 * double(counts.clear));
}

TEST(Projected_star, IsNeverWrongOnAGridShakenByUnitsInTheLastPlace)
{
  const Counts counts = compare(
      [](Random& random) {
        std::uniform_int_distribution<int> coordinate(1, 4), shift(-1, 1);
        const auto shaken = [&] {
          return coordinate(random) * (1 + std::numeric_limits<double>::epsilon() * shift(random));
        };
        const double x = shaken(), y = shaken();
        return Point_3(x, y, shaken());
      },
      200000);
  EXPECT_GT(counts.stars, 1000u);
  EXPECT_GT(counts.proved, counts.clear / 10);
}

TEST(Projected_star, IsNotClearOfFacesThatTouchItsRim)
{
  // One corner of the face is on an edge of the link. That is so exactly, for all is integers; in the view
  // the corner lies beside the edge by a rounding error.
  Random random(11);
  const auto integer = [&](int low, int high) {
    return double(std::uniform_int_distribution<int>(low, high)(random));
  };
  constexpr int size = 1 << 20;
  std::size_t stars = 0;
  for (int i = 0; i < 50000; ++i) {
    const auto corner = [&](int x, int y) {
      const double right = x * integer(size / 2, size), back = y * integer(size / 2, size);
      return Point_3(right, back, integer(-size / 8, size / 8));
    };
    const Point_3 a = corner(1, -1), c = corner(-1, 1), d = corner(-1, -1);
    const std::array<double, 3> step{integer(-256, 256), integer(1024, 2048), integer(-128, 128)};
    const auto on_edge = [&](double k) {
      return Point_3(a.x() + k * step[0], a.y() + k * step[1], a.z() + k * step[2]);
    };
    Star star(Point_3(0, 0, 0), c, {a, on_edge(1024), c, d});
    if (!star.is_seen_clear())
      continue;
    ++stars;
    const Point_3 touching = on_edge(integer(1, 1023));
    const auto beyond = [&] {
      return Point_3(touching.x() + integer(1000, 2000), touching.y() + integer(-99, 99), touching.z());
    };
    const std::array<Point_3, 3> face{touching, beyond(), beyond()};
    EXPECT_FALSE(star.is_clear_of(face)) << "case " << i;
    EXPECT_FALSE(star.is_seen_clear_of(face)) << "case " << i;
  }
  EXPECT_GT(stars, 40000u);
}

TEST(Projected_star, IsNeverWrongAcrossScales)
{
  const Counts counts = compare(
      [](Random& random) {
        std::uniform_real_distribution<double> exponent(-12, 0), sign(-1, 1);
        const auto coordinate = [&] { return std::copysign(std::pow(10, exponent(random)), sign(random)); };
        const double x = coordinate(), y = coordinate();
        return Point_3(x, y, coordinate());
      },
      200000);
  EXPECT_GT(counts.stars, 1000u);
  EXPECT_GT(counts.proved, counts.clear / 10);
}

// The precondition: a star that is embedded at the start
// ------------------------------------------------------------------------------------------------------------

/// The link winds twice about the vertex, which is the first point.
Triangle_soup pentagram()
{
  Triangle_soup soup;
  soup.points = {{0, 0, 1}, {8, 0, 0}, {-6, 5, 1}, {2, -8, 0}, {2, 8, 1}, {-6, -5, 0}};
  soup.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}};
  return soup;
}

TEST(Projected_star, SeesNothingWrongInAPentagram)
{
  using Number = CGAL::Exact_rational;
  const auto exact = [](const Point_3& p) {
    return oracle::Point<Number>{Number(p.x()), Number(p.y()), Number(p.z())};
  };
  const Triangle_soup soup = pentagram();
  const std::vector<Point_3> link(soup.points.begin() + 1, soup.points.end());
  const Point_3 from = soup.points[0], to(0.25, 0, 2);
  Vertex_motion<Point_3> motion{from, to, {}, {}};
  oracle::Star<Number> star{exact(from), exact(to), {}, {}};
  for (std::size_t i = 0; i < link.size(); ++i) {
    const Point_3 &a = link[i], &b = link[(i + 1) % link.size()];
    motion.moving.push_back({a, b});
    star.moving.push_back({exact(a), exact(b)});
  }
  // Its faces meet at the start, on the way and at the end, ...
  EXPECT_FALSE(oracle::is_star_embedded(star.from, star.moving));
  EXPECT_FALSE(oracle::is_star_motion_clear(star));
  // ... and every look at it from above takes it for clear.
  EXPECT_TRUE(Star(from, to, link).is_seen_clear());
  EXPECT_EQ(judge_star_motion<Kernel>(motion), Star_verdict::clear_by_view);

  // So its faces are locked, and nothing of it moves, or its faces are exempt, and no view is used.
  const Reduction frozen = reduce(soup, without_limits(to_ratio(0)), with(Defects::freeze));
  EXPECT_EQ(frozen.prepared.frozen_faces, soup.triangles.size());
  EXPECT_EQ(frozen.simplified.report.collapses, 0u);
  const Reduction exempt = reduce(soup, without_limits(to_ratio(0)), with(Defects::descend));
  EXPECT_EQ(exempt.simplified.report.intersections.stars_clear_by_view, 0u);
}

TEST(Projected_star, IsNeverWrongBesideStarsThatWindTwice)
{
  Random random(13);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const auto draw = [&] {
    const double x = double(below(9)) - 4, y = double(below(9)) - 4;
    return Point_3(x, y, double(below(3)));
  };
  const Point_3 from(0, 0, 1);
  const auto turn = [](const Point_3& p, const Point_3& q) {
    const double angle = std::atan2(q.y(), q.x()) - std::atan2(p.y(), p.x());
    return angle > 0 ? angle : angle + 2 * CGAL_PI;
  };
  Counts counts;
  for (int i = 0; i < 100000; ++i) {
    std::vector<Point_3> link;
    double angle = 0;
    while (angle < 4 * CGAL_PI) {
      const Point_3 p = draw();
      if (p.x() == 0 && p.y() == 0)
        continue;
      angle += link.empty() ? 0 : turn(link.back(), p);
      link.push_back(p);
    }
    link.pop_back(); // beyond twice around
    std::vector<Point_3> sorted = link;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      continue;
    const Point_3 to = below(2) == 0 ? link[below(link.size())] : Point_3(0.0625 * below(4), 0, below(3));
    Star star(from, to, link);
    if (to == from || !star.is_seen_clear())
      continue;
    ++counts.stars;
    counts.judge_faces(star, link, draw, random);
  }
  EXPECT_GT(counts.stars, 100u);
  EXPECT_GT(counts.meeting, 1000u);
  EXPECT_GT(counts.proved, 100u);
}

} // namespace
} // namespace selvedge::test
