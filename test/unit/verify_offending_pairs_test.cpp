// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/verify.h>

#include "support/soups.h"

#include <CGAL/Gmpq.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace selvedge {

using namespace test;

bool operator==(const Offending_pair& a, const Offending_pair& b)
{
  return std::tie(a.first, a.second, a.offence) == std::tie(b.first, b.second, b.offence);
}

std::ostream& operator<<(std::ostream& out, const Offending_pair& pair)
{
  return out << '(' << pair.first << ", " << pair.second << ", " << static_cast<int>(pair.offence) << ')';
}

namespace {

// The oracle: the definition, computed. The common points of two triangles are constructed, in rational
// arithmetic, by cutting one with the half-spaces whose intersection the other is; no predicate of CGAL, no
// case for the number of shared positions.
namespace oracle {

using Rational = CGAL::Gmpq;
using Vector = std::array<Rational, 3>;
using Polygon = std::vector<Vector>;

struct Half_space // where normal · x >= offset
{
  Vector normal;
  Rational offset;
};

Vector operator-(const Vector& a, const Vector& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Rational dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Vector& a)
{
  return a == Vector{0, 0, 0};
}

Polygon cut(const Polygon& polygon, const Half_space& half_space)
{
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational at_p = dot(half_space.normal, p) - half_space.offset;
    const Rational at_q = dot(half_space.normal, q) - half_space.offset;
    if (at_p >= 0)
      result.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const Rational s = at_p / (at_p - at_q);
      result.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
    }
  }
  return result;
}

/// Half-spaces whose intersection is the convex hull of some of three points.
std::vector<Half_space> half_spaces(const std::vector<Vector>& points)
{
  std::vector<Half_space> result;
  const auto add = [&](const Vector& normal, const Vector& on) {
    result.push_back({normal, dot(normal, on)});
  };
  const auto add_both = [&](const Vector& normal, const Vector& on) {
    add(normal, on);
    add({-normal[0], -normal[1], -normal[2]}, on);
  };
  const std::array<Vector, 3> axes = {Vector{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (points.size() == 3) {
    const Vector normal = cross(points[1] - points[0], points[2] - points[0]);
    if (!is_zero(normal)) {
      add_both(normal, points[0]);
      for (int i = 0; i < 3; ++i)
        add(cross(normal, points[(i + 1) % 3] - points[i]), points[i]);
      return result;
    }
  }
  // Collinear: the line through the two points farthest apart, and its two ends.
  Vector from = points[0], to = points[0];
  for (const Vector& p : points)
    for (const Vector& q : points)
      if (dot(q - p, q - p) > dot(to - from, to - from))
        from = p, to = q;
  const Vector direction = to - from;
  for (const Vector& axis : axes)
    add_both(is_zero(direction) ? axis : cross(direction, axis), from);
  if (!is_zero(direction)) {
    add(direction, from);
    add({-direction[0], -direction[1], -direction[2]}, to);
  }
  return result;
}

std::vector<Vector> corners(const Triangle_soup& soup, Index triangle)
{
  std::vector<Vector> result;
  for (const Index vertex : soup.triangles[triangle]) {
    const Point_3& p = soup.points[vertex];
    result.push_back({Rational(p.x()), Rational(p.y()), Rational(p.z())});
  }
  return result;
}

bool is_degenerate(const Triangle_soup& soup, Index triangle)
{
  const std::vector<Vector> p = corners(soup, triangle);
  return is_zero(cross(p[1] - p[0], p[2] - p[0]));
}

bool boxes_are_apart(const Triangle_soup& soup, Index first, Index second)
{
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = [&](Index triangle) {
      const auto& [a, b, c] = soup.triangles[triangle];
      return std::minmax({soup.points[a][axis], soup.points[b][axis], soup.points[c][axis]});
    };
    if (along(first).second < along(second).first || along(second).second < along(first).first)
      return true;
  }
  return false;
}

std::optional<Offence> judge(const Triangle_soup& soup, Index first, Index second)
{
  if (boxes_are_apart(soup, first, second))
    return std::nullopt;
  const std::vector<Vector> p = corners(soup, first), q = corners(soup, second);
  const std::set<Vector> positions(p.begin(), p.end()), others(q.begin(), q.end());
  if (positions == others)
    return Offence::duplicate;
  std::vector<Vector> shared;
  std::set_intersection(positions.begin(), positions.end(), others.begin(), others.end(),
                        std::back_inserter(shared));

  Polygon common = p;
  for (const Half_space& half_space : half_spaces(q))
    common = cut(common, half_space);
  if (shared.empty())
    return common.empty() ? std::nullopt : std::optional(Offence::intersection);
  for (const Half_space& half_space : half_spaces(shared))
    for (const Vector& point : common)
      if (dot(half_space.normal, point) < half_space.offset)
        return Offence::intersection;
  return std::nullopt;
}

std::vector<Offending_pair> offending_pairs(const Triangle_soup& soup)
{
  std::vector<Offending_pair> pairs;
  for (Index i = 0; i < soup.triangles.size(); ++i) {
    if (is_degenerate(soup, i))
      pairs.push_back({i, i, Offence::degenerate});
    for (Index j = i + 1; j < soup.triangles.size(); ++j)
      if (const std::optional<Offence> offence = judge(soup, i, j))
        pairs.push_back({i, j, *offence});
  }
  return pairs;
}

} // namespace oracle

#ifdef NDEBUG
constexpr int scale = 4;
#else
constexpr int scale = 1;
#endif

/// Triangles with corners on a small grid: every degeneracy there is occurs, again and again.
Triangle_soup grid_soup(std::mt19937& random, std::array<int, 3> size, int triangles)
{
  Triangle_soup soup;
  for (int x = 0; x < size[0]; ++x)
    for (int y = 0; y < size[1]; ++y)
      for (int z = 0; z < size[2]; ++z)
        soup.points.emplace_back(x, y, z);
  std::uniform_int_distribution<Index> vertex(0, static_cast<Index>(soup.points.size()) - 1);
  for (int i = 0; i < triangles; ++i)
    soup.triangles.push_back({vertex(random), vertex(random), vertex(random)});
  return soup;
}

struct Class // of a pair: shared positions, degenerate ones of the two, verdict
{
  std::size_t shared;
  int degenerate;
  bool offending;
  bool operator<(const Class& other) const
  {
    return std::tie(shared, degenerate, offending) <
           std::tie(other.shared, other.degenerate, other.offending);
  }
};

TEST(OffendingPairs, AreThoseOfTheRationalOracleOnGrids)
{
  std::map<Class, int> seen;
  const std::vector<std::array<int, 3>> sizes = {{4, 4, 4}, {3, 3, 3}, {2, 2, 2}, {4, 4, 1},
                                                 {4, 1, 3}, {1, 3, 2}, {1, 6, 1}};
  for (int seed = 0; seed < 210 * scale; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Triangle_soup soup = grid_soup(random, sizes[seed % sizes.size()], 20);
    const std::vector<Offending_pair> expected = oracle::offending_pairs(soup);
    ASSERT_EQ(offending_pairs(soup), expected);
    ASSERT_EQ(is_embedded(soup), expected.empty());

    for (Index i = 0; i < soup.triangles.size(); ++i)
      for (Index j = i + 1; j < soup.triangles.size(); ++j) {
        const std::set<Index> s(soup.triangles[i].begin(), soup.triangles[i].end());
        const bool offending = std::any_of(expected.begin(), expected.end(), [&](const Offending_pair& p) {
          return p.first == i && p.second == j;
        });
        const std::set<Index> t(soup.triangles[j].begin(), soup.triangles[j].end());
        const auto shared = std::count_if(s.begin(), s.end(), [&](Index v) { return t.count(v) == 1; });
        ++seen[{static_cast<std::size_t>(shared),
                oracle::is_degenerate(soup, i) + oracle::is_degenerate(soup, j), offending}];
      }
  }
  // What cannot occur: three shared positions that do not offend.
  for (const std::size_t shared : {0, 1, 2, 3})
    for (const int degenerate : {0, 1, 2})
      for (const bool offending : {false, true}) {
        const bool possible =
            shared == 3 ? offending && degenerate != 1 : shared < 2 || degenerate != 1 || !offending;
        SCOPED_TRACE(testing::Message()
                     << shared << " shared, " << degenerate << " degenerate, offending: " << offending);
        const int count = seen[{shared, degenerate, offending}];
        if (possible)
          EXPECT_GT(count, 10);
        else
          EXPECT_EQ(count, 0);
        RecordProperty("pairs_" + std::to_string(shared) + "_" + std::to_string(degenerate) + "_" +
                           std::to_string(offending),
                       count);
      }
}

TEST(OffendingPairs, DoNotDependOnTheOrderOfArguments)
{
  for (int seed = 0; seed < 2500 * scale; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Triangle_soup soup = grid_soup(random, {3, 3, 2}, 2);
    const std::size_t count = offending_pairs(soup).size();
    for (int swap = 0; swap < 2; ++swap, std::swap(soup.triangles[0], soup.triangles[1])) {
      std::sort(soup.triangles[0].begin(), soup.triangles[0].end());
      do {
        std::sort(soup.triangles[1].begin(), soup.triangles[1].end());
        do
          ASSERT_EQ(offending_pairs(soup).size(), count);
        while (std::next_permutation(soup.triangles[1].begin(), soup.triangles[1].end()));
      } while (std::next_permutation(soup.triangles[0].begin(), soup.triangles[0].end()));
    }
  }
}

/// Corners anywhere in a cube, triangles of all sizes: hundreds at once, so that the boxes have work to do.
Triangle_soup random_soup(std::mt19937& random, int triangles)
{
  std::uniform_real_distribution<double> coordinate(0, 1);
  const auto point = [&] { return Point_3(coordinate(random), coordinate(random), coordinate(random)); };
  Triangle_soup soup;
  for (int i = 0; i < triangles; ++i) {
    const Point_3 p = point();
    const double size = std::pow(10, -3 * coordinate(random));
    const Index first = static_cast<Index>(soup.points.size());
    for (int k = 0; k < 3; ++k)
      soup.points.push_back(p + size * (point() - CGAL::ORIGIN));
    // Now and then a corner of an earlier triangle.
    const Index third =
        i > 0 && i % 3 == 0 ? std::uniform_int_distribution<Index>(0, first)(random) : first + 2;
    soup.triangles.push_back({first, first + 1, third});
  }
  return soup;
}

TEST(OffendingPairs, MissNoneOfAllPairs)
{
  const std::vector<std::array<double, 3>> stretches = {
      {1, 1, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {100, 1, 0.01}};
  for (std::size_t seed = 0; seed < stretches.size(); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto [x, y, z] = stretches[seed];
    const Triangle_soup soup =
        mapped(random_soup(random, 200 * scale), [&, x = x, y = y, z = z](const Point_3& p) {
          return Point_3(x * p.x(), y * p.y(), z * p.z());
        });
    const std::vector<Offending_pair> expected = oracle::offending_pairs(soup);
    ASSERT_GT(expected.size(), 50u);
    EXPECT_EQ(offending_pairs(soup), expected);
  }
}

// Maps that change no verdict, on soups full of degeneracies: what was coplanar still is, to the last bit.
TEST(OffendingPairs, AreTheSameAtAnyScaleAndInAnyPlace)
{
  const double huge = std::ldexp(1, 1000), smallest = std::numeric_limits<double>::denorm_min();
  for (int seed = 0; seed < 40 * scale; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Triangle_soup soup = grid_soup(random, {3, 3, 3}, 20);
    const std::vector<Offending_pair> expected = offending_pairs(soup);
    const auto same = [&](auto map) { return offending_pairs(mapped(soup, map)) == expected; };

    for (const double factor : {1e30, huge, 1e-30, 1 / huge, 3 * smallest, smallest, -1.0})
      EXPECT_TRUE(same([&](const Point_3& p) { return CGAL::ORIGIN + factor * (p - CGAL::ORIGIN); }))
          << factor;
    EXPECT_TRUE(same([&](const Point_3& p) { return Point_3(p.x() * huge, p.y() * smallest, p.z()); }));
    EXPECT_TRUE(same([](const Point_3& p) { return Point_3(p.x() + 0x1p51, p.y() - 0x1p52, p.z() + 1e15); }));
    EXPECT_TRUE(same([](const Point_3& p) {
      const auto [x, y, z] = std::tuple(p.x(), p.y(), p.z());
      return Point_3(99991 * x + 31337 * y - 5 * z, 17 * x - 65537 * y + 12345 * z, x + 7 * y + 1000003 * z);
    }));
    EXPECT_TRUE(same([](const Point_3& p) { return Point_3(p.x() - 1, p.y() - 2, p.z()); }));
    // Neither a vertex number nor the sign of a zero is part of a position.
    const auto either = [&](double c) { return c == 0 && random() % 2 == 0 ? -c : c; };
    EXPECT_EQ(offending_pairs(mapped(
                  unshared(soup),
                  [&](const Point_3& p) { return Point_3(either(p.x()), either(p.y()), either(p.z())); })),
              expected);
  }
}

using Pairs = std::vector<Offending_pair>;

TEST(OffendingPairs, AreNoneInEmbeddedSoups)
{
  EXPECT_EQ(offending_pairs({}), Pairs());
  EXPECT_EQ(offending_pairs(soup({{0, 0, 0}}, {})), Pairs());
  EXPECT_EQ(offending_pairs(one_triangle()), Pairs());
  EXPECT_EQ(offending_pairs(bowtie()), Pairs());
  EXPECT_EQ(offending_pairs(book()), Pairs());
  EXPECT_EQ(offending_pairs(tetrahedron()), Pairs());
  EXPECT_EQ(offending_pairs(sheet(9, 7)), Pairs());
  EXPECT_EQ(offending_pairs(joined(sheet(9, 7), sheet(9, 7, std::numeric_limits<double>::denorm_min()))),
            Pairs());
}

TEST(OffendingPairs, NameWhateverTouchesBeyondSharedPositions)
{
  const Pairs intersection = {{0, 1, Offence::intersection}};
  EXPECT_EQ(offending_pairs(vertex_touching_face()), intersection);
  EXPECT_EQ(offending_pairs(edge_touching_edge()), intersection);
  EXPECT_EQ(offending_pairs(crossing()), intersection);
  EXPECT_EQ(offending_pairs(coplanar_overlap()), intersection);
  EXPECT_EQ(offending_pairs(coplanar_inside()), intersection);
  EXPECT_EQ(offending_pairs(folded_over()), intersection);
  EXPECT_EQ(offending_pairs(t_junction()),
            Pairs({{0, 1, Offence::intersection}, {0, 2, Offence::intersection}}));
}

TEST(OffendingPairs, ComeOneUlpApart)
{
  // The tip of the second triangle moves out of the plane of the first by the smallest step there is.
  Triangle_soup soup = vertex_touching_face();
  EXPECT_FALSE(is_embedded(soup));
  const Point_3 tip = soup.points[3];
  soup.points[3] = Point_3(tip.x(), tip.y(), std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(is_embedded(soup));
  soup.points[3] = Point_3(tip.x(), tip.y(), -std::numeric_limits<double>::denorm_min());
  EXPECT_FALSE(is_embedded(soup));
}

TEST(OffendingPairs, AreDuplicatesWhateverTheirNumbersAndOrientation)
{
  const Pairs duplicates = {{0, 1, Offence::duplicate}};
  EXPECT_EQ(offending_pairs(duplicate()), duplicates);
  EXPECT_EQ(offending_pairs(opposite_duplicate()), duplicates);
  EXPECT_EQ(offending_pairs(unshared(opposite_duplicate())), duplicates);
  EXPECT_EQ(offending_pairs(joined(sheet(1, 1), sheet(1, 1))),
            Pairs({{0, 2, Offence::duplicate}, {1, 3, Offence::duplicate}}));
}

// Three collinear corners with a neighbour on each of the three edges: the neighbours meet, not the one
// between.
TEST(OffendingPairs, JudgeCollinearTriangleAsSegment)
{
  const Triangle_soup soup = test::soup({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -3, 0}},
                                        {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 4}});
  EXPECT_EQ(
      offending_pairs(soup),
      Pairs({{0, 0, Offence::degenerate}, {1, 3, Offence::intersection}, {2, 3, Offence::intersection}}));
  // What runs through it meets it as it would a segment.
  const Triangle_soup blade = test::soup({{3, 1, 1}, {3, -1, 1}, {3, 0, -1}}, {{0, 1, 2}});
  EXPECT_EQ(offending_pairs(joined(collinear_triangle(), blade)),
            Pairs({{0, 0, Offence::degenerate}, {0, 1, Offence::intersection}}));
}

// An edge of no length between two neighbours, and a triangle that is but a point of its neighbour.
TEST(OffendingPairs, JudgeTriangleWithoutLengthAsSegmentOrPoint)
{
  const Triangle_soup soup = test::soup({{0, 0, 0}, {0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -3, 0}},
                                        {{0, 1, 2}, {0, 2, 3}, {2, 1, 4}, {0, 0, 1}});
  EXPECT_EQ(offending_pairs(soup), Pairs({{0, 0, Offence::degenerate}, {3, 3, Offence::degenerate}}));

  const Triangle_soup point = test::soup({{1, 1, 0}}, {{0, 0, 0}});
  EXPECT_EQ(offending_pairs(joined(one_triangle(), point)),
            Pairs({{0, 1, Offence::intersection}, {1, 1, Offence::degenerate}}));
}

} // namespace
} // namespace selvedge
