// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/geometry/sweep.h>

#include <support/Exact_oracle.h>
#include <support/Exact_unit.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <tuple>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Integer = std::int64_t;
using Grid_point = selvedge::oracle::Point<Integer>;

#ifdef NDEBUG
constexpr int case_scale = 1;
#else
constexpr int case_scale = 4;
#endif

/// m, t, a, b and a face; the coordinates are small integers or any doubles.
template <class Coordinate>
struct Case
{
  std::array<selvedge::oracle::Point<Coordinate>, 4> sweep;
  std::array<selvedge::oracle::Point<Coordinate>, 3> face;
};

template <class Coordinate>
std::string to_string(const Case<Coordinate>& c)
{
  std::ostringstream out;
  out.precision(17);
  for (const auto& p : c.sweep)
    out << '(' << p[0] << ' ' << p[1] << ' ' << p[2] << ") ";
  out << "against";
  for (const auto& p : c.face)
    out << " (" << p[0] << ' ' << p[1] << ' ' << p[2] << ')';
  return out.str();
}

template <class To, class Coordinate>
typename To::Point_3 to_kernel(const selvedge::oracle::Point<Coordinate>& p)
{
  return
      typename To::Point_3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
}

template <class With, class Coordinate>
bool judge(const Case<Coordinate>& c)
{
  const auto to = to_kernel<With, Coordinate>;
  return selvedge::is_sweep_clear<With>(to(c.sweep[0]), to(c.sweep[1]), to(c.sweep[2]), to(c.sweep[3]),
                                        to(c.face[0]), to(c.face[1]), to(c.face[2]));
}

template <class Number, class Coordinate>
bool judge_by_oracle(const Case<Coordinate>& c)
{
  Case<Number> exact;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      exact.sweep[j][i] = Number(c.sweep[j][i]);
    for (std::size_t j = 0; j < 3; ++j)
      exact.face[j][i] = Number(c.face[j][i]);
  }
  return selvedge::oracle::is_sweep_clear<Number>(exact.sweep[0], exact.sweep[1], exact.sweep[2],
                                                  exact.sweep[3], exact.face);
}

bool are_coplanar(const std::array<Grid_point, 4>& p)
{
  using namespace selvedge::oracle;
  return dot(cross(difference(p[1], p[0]), difference(p[2], p[0])), difference(p[3], p[0])) == 0;
}

/// The preconditions of is_sweep_clear(), apart from those on numbers.
bool is_allowed(const Case<Integer>& c)
{
  const auto& [m, t, a, b] = c.sweep;
  if (selvedge::oracle::are_collinear(m, a, b) || t == m || t == a || t == b)
    return false;
  for (std::size_t j = 0; j < 3; ++j) {
    if (c.face[j] == m || c.face[j] == c.face[(j + 1) % 3])
      return false;
  }
  return true;
}

enum Sweep_kind { full, flat, needle_at_end, needle_beside, sweep_kinds };

Sweep_kind kind_of(const std::array<Grid_point, 4>& sweep)
{
  const auto& [m, t, a, b] = sweep;
  if (!are_coplanar(sweep))
    return full;
  if (selvedge::oracle::are_collinear(t, a, b))
    return needle_at_end;
  if (selvedge::oracle::are_collinear(m, t, a) || selvedge::oracle::are_collinear(m, t, b))
    return needle_beside;
  return flat;
}

/// What tells one class of configurations from another: which of t, a, b (bits 0, 1, 2) the face has, the
/// kind of sweep, and whether the face is collinear or in the plane of a flat sweep.
struct Class
{
  unsigned shared;
  Sweep_kind kind;
  bool is_face_collinear;
  bool is_face_in_plane;

  bool operator<(const Class& other) const
  {
    return std::tie(shared, kind, is_face_collinear, is_face_in_plane) <
           std::tie(other.shared, other.kind, other.is_face_collinear, other.is_face_in_plane);
  }
};

Class class_of(const Case<Integer>& c)
{
  Class result{0, kind_of(c.sweep), selvedge::oracle::are_collinear(c.face[0], c.face[1], c.face[2]), false};
  for (unsigned i = 0; i < 3; ++i) {
    if (std::find(c.face.begin(), c.face.end(), c.sweep[i + 1]) != c.face.end())
      result.shared |= 1u << i;
  }
  if (result.kind != full) {
    const auto& [m, t, a, b] = c.sweep;
    result.is_face_in_plane = true;
    for (const Grid_point& p : c.face)
      result.is_face_in_plane = result.is_face_in_plane && are_coplanar({m, a, b, p});
  }
  return result;
}

std::string to_string(const Class& c)
{
  std::ostringstream out;
  out << "shares {" << (c.shared & 1 ? " t" : "") << (c.shared & 2 ? " a" : "") << (c.shared & 4 ? " b" : "")
      << " }, "
      << std::array<const char*, sweep_kinds>{"full sweep", "flat sweep", "sweep that ends as a needle",
                                              "flat sweep with m, t in line with a or b"}[c.kind]
      << (c.is_face_collinear ? ", collinear face" : "") << (c.is_face_in_plane ? ", all in one plane" : "");
  return out.str();
}

/// Random cases on the grid {0..3}³, in which all kinds are frequent.
class Grid_cases
{
public:
  explicit Grid_cases(unsigned seed) : m_random(seed) {}

  Case<Integer> next()
  {
    Case<Integer> c;
    do {
      const Sweep_kind kind = static_cast<Sweep_kind>(m_random() % sweep_kinds);
      const bool is_face_collinear = m_random() % 3 == 0, is_face_in_plane = m_random() % 2 == 0;
      do
        c.sweep = {point(), point(), point(), point()};
      while (selvedge::oracle::are_collinear(c.sweep[0], c.sweep[2], c.sweep[3]) || kind_of(c.sweep) != kind);
      const unsigned shared = m_random() % 8;
      std::size_t n = 0;
      for (unsigned i = 0; i < 3; ++i) {
        if (shared & (1u << i))
          c.face[n++] = c.sweep[i + 1];
      }
      // A bounded search: not every wish can be fulfilled for every sweep.
      for (int trial = 0; trial < 200; ++trial) {
        for (std::size_t j = n; j < 3; ++j)
          c.face[j] = point();
        if (is_face_collinear && !selvedge::oracle::are_collinear(c.face[0], c.face[1], c.face[2]))
          continue;
        if (!is_face_in_plane || class_of(c).is_face_in_plane)
          break;
      }
      std::shuffle(c.face.begin(), c.face.end(), m_random);
    } while (!is_allowed(c));
    return c;
  }

private:
  Grid_point point()
  {
    const auto bits = m_random();
    return {Integer(bits & 3), Integer(bits >> 2 & 3), Integer(bits >> 4 & 3)};
  }

  std::mt19937 m_random;
};

/// Whether geometry allows a class with this answer at all; where it does not, none must be found.
bool can_exist(const Class& c, bool is_clear)
{
  // With all of t, a, b the face is the moving face at its end.
  if (c.shared == 7)
    return !is_clear && c.is_face_collinear == (c.kind == needle_at_end) &&
           c.is_face_in_plane == (c.kind != full);

  const bool has_two = c.shared == 3 || c.shared == 5 || c.shared == 6;
  // A line through two corners of a full sweep meets it in their edge only.
  if (c.kind == full)
    return !c.is_face_in_plane && (is_clear || !has_two || !c.is_face_collinear);

  if (!c.is_face_in_plane) {
    // With two points in the plane, a collinear face lies in it; any other meets it only in their edge.
    if (has_two)
      return is_clear && !c.is_face_collinear;
    // With one point in the plane, a collinear face has no other there.
    return is_clear || c.shared == 0 || !c.is_face_collinear;
  }
  // When mt passes through a or b, but t is not on the line ab, this line meets the sweep in the edge ab
  // only.
  return is_clear || c.shared != 6 || c.kind != needle_beside || !c.is_face_collinear;
}

TEST(Sweep, AgreesWithLinearProgrammingInEveryClassOnTheGrid)
{
  constexpr unsigned seed = 20240611;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Grid_cases cases(seed);
  std::map<Class, std::array<int, 2>> counts;
  for (int i = 0; i < 1000000 / case_scale; ++i) {
    const Case<Integer> c = cases.next();
    const bool is_clear = judge_by_oracle<Integer>(c);
    ASSERT_EQ(judge<Kernel>(c), is_clear) << to_string(c);
    ++counts[class_of(c)][is_clear];
  }

  for (unsigned shared = 0; shared < 8; ++shared) {
    for (int kind = 0; kind < sweep_kinds; ++kind) {
      for (const bool is_face_collinear : {false, true}) {
        for (const bool is_face_in_plane : {false, true}) {
          const Class c{shared, static_cast<Sweep_kind>(kind), is_face_collinear, is_face_in_plane};
          for (const bool is_clear : {false, true}) {
            const std::string name = to_string(c) + (is_clear ? ": clear" : ": not clear");
            const int count = counts[c][is_clear];
            if (can_exist(c, is_clear))
              EXPECT_GT(count, 0) << name;
            else
              EXPECT_EQ(count, 0) << name;
          }
        }
      }
    }
  }
}

TEST(Sweep, DoesNotDependOnTheOrderOfItsArguments)
{
  constexpr unsigned seed = 77;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Grid_cases cases(seed);
  for (int i = 0; i < 50000 / case_scale; ++i) {
    Case<Integer> c = cases.next();
    const bool is_clear = judge_by_oracle<Integer>(c);
    std::sort(c.face.begin(), c.face.end());
    do {
      for (int swap = 0; swap < 2; ++swap) {
        std::swap(c.sweep[2], c.sweep[3]);
        ASSERT_EQ(judge<Kernel>(c), is_clear) << to_string(c);
      }
    } while (std::next_permutation(c.face.begin(), c.face.end()));
  }
}

TEST(Sweep, IsTheSameForExactKernels)
{
  constexpr unsigned seed = 5;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Grid_cases cases(seed);
  for (int i = 0; i < 20000 / case_scale; ++i) {
    const Case<Integer> c = cases.next();
    const bool is_clear = judge<Kernel>(c);
    ASSERT_EQ(judge<CGAL::Exact_predicates_exact_constructions_kernel>(c), is_clear) << to_string(c);
    ASSERT_EQ(judge<CGAL::Simple_cartesian<CGAL::Gmpq>>(c), is_clear) << to_string(c);
  }
}

/// Cases with arbitrary doubles: anywhere, near a common plane, or a case of the grid that rounding has bent
/// a little.
class Double_cases
{
public:
  explicit Double_cases(unsigned seed) : m_random(seed), m_grid(seed) {}

  Case<double> next()
  {
    const auto kind = m_random() % 3;
    if (kind == 2)
      return bent();
    Case<double> c;
    const std::array<Point, 3> frame{point(), point(), point()};
    const auto draw = [&] { return kind == 0 ? point() : combine(frame); };
    for (Point& p : c.sweep)
      p = draw();
    // Some faces are small and near the middle of the sweep, so that they may lie inside.
    const bool is_small = m_random() % 4 == 0;
    for (Point& p : c.face) {
      p = draw();
      for (std::size_t i = 0; is_small && i < 3; ++i)
        p[i] = (c.sweep[0][i] + c.sweep[1][i] + c.sweep[2][i] + c.sweep[3][i]) / 4 + p[i] / 8;
    }
    for (const std::size_t i : {0, 1}) {
      if (m_random() % 2 == 0 && !is_small)
        c.face[i] = c.sweep[1 + (m_random() + i) % 3];
    }
    return c.face[0] == c.face[1] ? next() : c;
  }

private:
  using Point = selvedge::oracle::Point<double>;

  Point point() { return {uniform(), uniform(), uniform()}; }

  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(m_random); }

  Point combine(const std::array<Point, 3>& frame)
  {
    const double u = uniform(), v = uniform();
    Point p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = frame[0][i] + u * frame[1][i] + v * frame[2][i];
    return p;
  }

  // The same map for all points, so that shared positions stay shared; its rounding bends lines and planes.
  Case<double> bent()
  {
    const Case<Integer> c = m_grid.next();
    const std::array<Point, 3> frame{point(), point(), point()};
    const auto bend = [&](const Grid_point& p) {
      Point result;
      for (std::size_t i = 0; i < 3; ++i)
        result[i] = frame[0][i] * double(p[0]) + frame[1][i] * double(p[1]) + frame[2][i] * double(p[2]);
      return result;
    };
    Case<double> result;
    std::transform(c.sweep.begin(), c.sweep.end(), result.sweep.begin(), bend);
    std::transform(c.face.begin(), c.face.end(), result.face.begin(), bend);
    return result;
  }

  std::mt19937 m_random;
  Grid_cases m_grid;
};

Case<CGAL::Gmpz> integers(const Case<double>& c)
{
  selvedge::test::Exact_axes axes;
  for (const auto& p : c.sweep)
    axes.consider(p);
  for (const auto& p : c.face)
    axes.consider(p);
  Case<CGAL::Gmpz> exact;
  std::transform(c.sweep.begin(), c.sweep.end(), exact.sweep.begin(), std::cref(axes));
  std::transform(c.face.begin(), c.face.end(), exact.face.begin(), std::cref(axes));
  return exact;
}

TEST(Sweep, AgreesWithLinearProgrammingOnNearlyDegenerateDoubles)
{
  constexpr unsigned seed = 4711;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Double_cases cases(seed);
  std::array<std::array<int, 2>, 4> counts{};
  for (int i = 0; i < 30000 / case_scale; ++i) {
    const Case<double> c = cases.next();
    const bool is_clear = judge_by_oracle<CGAL::Gmpz>(integers(c));
    ASSERT_EQ(judge<Kernel>(c), is_clear) << to_string(c);
    std::size_t shared = 0;
    for (std::size_t k = 1; k < 4; ++k)
      shared += std::count(c.face.begin(), c.face.end(), c.sweep[k]);
    ++counts[shared][is_clear];
  }
  for (std::size_t shared = 0; shared < 3; ++shared) {
    EXPECT_GT(counts[shared][true], 0) << shared;
    EXPECT_GT(counts[shared][false], 0) << shared;
  }
  EXPECT_EQ(counts[3][true], 0);
}

} // namespace
