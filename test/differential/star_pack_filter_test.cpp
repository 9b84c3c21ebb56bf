// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What is proved of eight triangles at a time in single precision, against the exact test of every sweep: it
// may be silent, never wrong, and does not depend on the instructions that the processor has.

#include <selvedge/Triangle_soup.h>
#include <selvedge/geometry/internal/Separation_filter.h>
#include <selvedge/geometry/internal/Star_pack_filter.h>
#include <selvedge/geometry/sweep.h>

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

using internal::Star_pack_filter;
using Local = Separation_filter::Index;
using Random = std::mt19937_64;
using Draw = std::function<Point_3(Random&)>;
using Face = std::array<Point_3, 3>;
using Link = std::vector<Point_3>;
constexpr Local s_from = 0, s_to = 1;

internal::Vector_of_doubles coordinates(const Point_3& p)
{
  return {p.x(), p.y(), p.z()};
}

/// A closed star, seen from above, or an open one: without its last face.
class Star
{
public:
  Star(const Point_3& from, const Point_3& to, const Link& link, bool is_closed)
      : m_points{from, to}, m_is_closed(is_closed)
  {
    m_view.begin(coordinates(from), {0.1, 0.07, 1});
    m_view.add(coordinates(from));
    m_view.add(coordinates(to));
    m_numbers = {0, std::find(link.begin(), link.end(), to) != link.end() ? 1 : Star_pack_filter::s_none};
    for (std::size_t i = link.size() - !is_closed; i-- > 0;)
      m_edges.push_back({local(link[i]), local(link[(i + 1) % link.size()])});
  }

  bool is_usable() const { return m_view.is_usable() && m_points[s_from] != m_points[s_to]; }

  /// Whether all faces of a closed star turn the same way, as the view of one that is clear of itself shows
  /// them.
  bool is_seen_clear() const
  {
    return m_is_closed && std::all_of(m_edges.begin(), m_edges.end(), [this](const auto& edge) {
             return m_view.side(s_from, edge[0], edge[1]) == 1 &&
                    (is_contracted(edge) || m_view.side(s_to, edge[0], edge[1]) == 1);
           });
  }

  Star_pack_filter filter(bool has_sectors) const
  {
    Star_pack_filter filter;
    filter.begin(m_view, coordinates(m_points[s_from]), m_numbers, m_edges);
    if (has_sectors)
      filter.begin_sectors();
    EXPECT_TRUE(filter.is_usable());
    return filter;
  }

  /// The number of a vertex of the star at this point, or one of no vertex of it.
  std::uint32_t number(const Point_3& p) const
  {
    const auto found = std::find(m_points.begin() + 1, m_points.end(), p);
    return found == m_points.end() ||
                   m_numbers[std::size_t(found - m_points.begin())] == Star_pack_filter::s_none
               ? 1000
               : m_numbers[std::size_t(found - m_points.begin())];
  }

  std::size_t edges() const { return m_edges.size(); }
  bool is_contracted(std::size_t j) const { return is_contracted(m_edges[j]); }

  /// What the exact test says, which asks that the moving face is one.
  bool is_clear_of_sweep(std::size_t j, const Face& face) const
  {
    const Point_3 &a = m_points[m_edges[j][0]], &b = m_points[m_edges[j][1]];
    return CGAL::collinear(m_points[s_from], a, b) ||
           Sweep_test<Kernel>(m_points[s_from], m_points[s_to], a, b).is_clear(face[0], face[1], face[2]);
  }

private:
  static bool is_contracted(const std::array<Local, 2>& edge) { return edge[0] == s_to || edge[1] == s_to; }

  Local local(const Point_3& p)
  {
    const auto found = std::find(m_points.begin(), m_points.end(), p);
    if (found != m_points.end())
      return Local(found - m_points.begin());
    m_points.push_back(p);
    m_numbers.push_back(std::uint32_t(m_numbers.size()));
    return m_view.add(coordinates(p));
  }

  Separation_filter m_view;
  std::vector<Point_3> m_points;
  bool m_is_closed;
  std::vector<std::uint32_t> m_numbers;
  std::vector<std::array<Local, 2>> m_edges;
};

/// Uses the instructions that every processor has, while it lives.
class Plain_instructions
{
public:
  Plain_instructions() : m_was_used(Star_pack_filter::is_avx2_used())
  {
    Star_pack_filter::is_avx2_used() = false;
  }
  ~Plain_instructions() { Star_pack_filter::is_avx2_used() = m_was_used; }

private:
  bool m_was_used;
};

struct Counts
{
  std::size_t stars = 0, clear = 0, meeting = 0;
  std::size_t proved_at_once = 0,
              proved = 0; // triangles clear of all sweeps, before the sweeps are asked and after

  void judge(const Star& star, const std::array<Face, Star_pack_filter::width>& faces)
  {
    Star_pack_filter filter = star.filter(star.is_seen_clear());
    Star_pack_filter::Pack pack;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      std::array<internal::Vector_of_doubles, 3> corners;
      std::array<std::uint32_t, 3> numbers;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = internal::difference(coordinates(faces[i][k]), filter.origin());
        numbers[k] = star.number(faces[i][k]);
      }
      pack.set(i, numbers, corners);
    }
    const auto unclear = filter.unclear(pack, faces.size());
    Star_pack_filter::Sweeps unclear_sweeps;
    filter.find_unclear(pack, unclear_sweeps);
    {
      const Plain_instructions plain;
      Star_pack_filter::Sweeps plain_sweeps;
      filter.find_unclear(pack, plain_sweeps);
      EXPECT_EQ(filter.unclear(pack, faces.size()), unclear);
      EXPECT_EQ(plain_sweeps, unclear_sweeps);
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
      bool are_all_clear = true;
      for (std::size_t j = 0; j < star.edges(); ++j) {
        if (star.is_contracted(j))
          continue;
        const bool is_clear = star.is_clear_of_sweep(j, faces[i]);
        are_all_clear &= is_clear;
        EXPECT_TRUE(is_clear || (unclear >> i & 1) != 0) << "star " << stars << ", face " << i;
        EXPECT_TRUE(is_clear || (unclear_sweeps[i] >> j & 1) != 0) << "star " << stars << ", sweep " << j;
      }
      clear += are_all_clear;
      meeting += !are_all_clear;
      proved_at_once += (unclear >> i & 1) == 0;
      proved += (unclear >> i & 1) == 0 || unclear_sweeps[i] == 0;
    }
  }
};

/// Random stars among random faces, all of points that are drawn; corners are often points of the star.
Counts compare(const Draw& draw, std::size_t cases)
{
  Random random(13);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  Counts counts;
  for (std::size_t i = 0; i < cases; ++i) {
    const Point_3 from = draw(random);
    Link link(3 + below(6));
    std::generate(link.begin(), link.end(), [&] { return draw(random); });
    const auto angle = [&](const Point_3& p) { return std::atan2(p.y() - from.y(), p.x() - from.x()); };
    std::sort(link.begin(), link.end(),
              [&](const Point_3& p, const Point_3& q) { return angle(p) < angle(q); });
    const Point_3 to = below(4) != 0 ? link[below(link.size())] : draw(random);
    const bool is_closed = below(4) != 0;
    if (std::find(link.begin(), link.end(), from) != link.end() || to == from)
      continue;
    // The exact test does not take a sweep whose goal is on its edge by another number.
    const Star star(from, to, link, is_closed);
    if (!star.is_usable() || (is_closed && !star.is_seen_clear() && below(4) != 0))
      continue;
    ++counts.stars;
    std::array<Face, Star_pack_filter::width> faces;
    for (Face& face : faces)
      do {
        for (Point_3& corner : face)
          corner = below(2) != 0 ? link[below(link.size())] : draw(random);
      } while (std::find(face.begin(), face.end(), from) != face.end() || face[0] == face[1] ||
               face[1] == face[2] || face[2] == face[0]);
    counts.judge(star, faces);
  }
  return counts;
}

TEST(Star_pack_filter, IsNeverWrongOnASmallGrid)
{
  const Counts counts = compare(
      [](Random& random) {
        std::uniform_int_distribution<int> coordinate(0, 4), height(0, 1);
        const int x = coordinate(random), y = coordinate(random);
        return Point_3(x, y, height(random));
      },
      60000);
  EXPECT_GT(counts.stars, 3000u);
  EXPECT_GT(counts.meeting, 10000u);
  EXPECT_GT(counts.proved_at_once, counts.clear / 10);
  EXPECT_GT(counts.proved, counts.clear / 4);
}

TEST(Star_pack_filter, IsNeverWrongOnAGridShakenByUnitsInTheLastPlaceOfFloats)
{
  for (const double unit : {0x1p-24, 0x1p-22, 0x1p-20, 0x1p-18}) {
    const Counts counts = compare(
        [unit](Random& random) {
          std::uniform_int_distribution<int> coordinate(1, 4);
          std::uniform_real_distribution<double> shift(-unit, unit);
          const auto shaken = [&] { return coordinate(random) * (1 + shift(random)); };
          const double x = shaken(), y = shaken();
          return Point_3(x, y, shaken());
        },
        15000);
    EXPECT_GT(counts.stars, 500u);
    EXPECT_GT(counts.proved, counts.clear / 10);
  }
}

TEST(Star_pack_filter, IsNeverWrongFarFromTheOrigin)
{
  for (const double distance : {1e2, 1e4, 1e8}) {
    const Counts counts = compare(
        [distance](Random& random) {
          std::uniform_real_distribution<double> shift(-0x1p-22, 0x1p-22);
          std::uniform_int_distribution<int> coordinate(0, 4);
          const double x = distance + coordinate(random) + shift(random),
                       y = -distance + coordinate(random) + shift(random);
          return Point_3(x, y, distance / 3 + coordinate(random) + shift(random));
        },
        15000);
    EXPECT_GT(counts.stars, 500u);
    EXPECT_GT(counts.proved, counts.clear / 20);
  }
}

TEST(Star_pack_filter, IsNeverWrongAcrossScales)
{
  const Counts counts = compare(
      [](Random& random) {
        std::uniform_real_distribution<double> exponent(-9, 0), sign(-1, 1);
        const auto coordinate = [&] { return std::copysign(std::pow(10, exponent(random)), sign(random)); };
        const double x = coordinate(), y = coordinate();
        return Point_3(x, y, coordinate());
      },
      60000);
  EXPECT_GT(counts.stars, 1000u);
  EXPECT_GT(counts.proved, counts.clear / 20);
}

TEST(Star_pack_filter, IsNeverWrongBetweenSheetsThatNearlyTouch)
{
  // Heights are about as large as rounding errors of floats.
  for (const double gap : {0x1p-24, 0x1p-21, 0x1p-18, 0x1p-12}) {
    const Counts counts = compare(
        [gap](Random& random) {
          std::uniform_real_distribution<double> coordinate(0, 4);
          std::uniform_int_distribution<int> height(0, 2);
          const double x = coordinate(random), y = coordinate(random);
          return Point_3(x, y, 1 + 0.3 * x + gap * height(random));
        },
        15000);
    EXPECT_GT(counts.meeting, 1000u);
    EXPECT_GT(counts.proved, counts.clear / 5);
  }
}

TEST(Star_pack_filter, ProvesNothingAboutTrianglesTooLargeForFloats)
{
  const Link link{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const Star star({0, 0, 0}, link[0], link, true);
  Star_pack_filter filter = star.filter(true);
  const auto is_clear = [&](double x) {
    Star_pack_filter::Pack pack;
    for (std::size_t i = 0; i < Star_pack_filter::width; ++i)
      pack.set(i, {7, 8, 9}, {{{x, 50, 50}, {60, 50, 50}, {50, 60, 50}}});
    Star_pack_filter::Sweeps unclear_sweeps;
    filter.find_unclear(pack, unclear_sweeps);
    const bool is_some_sweep_clear = unclear_sweeps[0] != (1u << star.edges()) - 1;
    return filter.unclear(pack, 1) == 0 || is_some_sweep_clear;
  };
  EXPECT_TRUE(is_clear(50));
  EXPECT_TRUE(is_clear(1e5));
  for (const double x :
       {1e7, 1e20, 3e38, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(is_clear(x)) << x;
}

} // namespace
} // namespace selvedge::test
