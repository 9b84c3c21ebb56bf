// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "verify/Capsule.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace selvedge {
namespace {

using internal::difference;
using internal::dot;
using Vector = Capsule::Vector;
using Segment = std::array<Vector, 2>;

/// Moves a parameter of a line into its segment; what is not a number becomes 0.
double clamped(double parameter)
{
  return parameter > 0 ? (std::min)(parameter, 1.0) : 0;
}

Vector interpolated(const Segment& segment, double parameter)
{
  const Vector direction = difference(segment[1], segment[0]);
  Vector point;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = segment[0][axis] + parameter * direction[axis];
  return point;
}

double squared_length(const Segment& segment)
{
  const Vector direction = difference(segment[1], segment[0]);
  return dot(direction, direction);
}

double distance(const Vector& point, const Segment& segment)
{
  const Vector direction = difference(segment[1], segment[0]);
  const double parameter = clamped(dot(difference(point, segment[0]), direction) / dot(direction, direction));
  return std::sqrt(squared_length({interpolated(segment, parameter), point}));
}

Vector middle(const Vector& a, const Vector& b)
{
  return interpolated({a, b}, 0.5);
}

/// Returns a vector from a point of the second segment to one of the first, as a rule the shortest.
Vector shortest_between(const Segment& first, const Segment& second)
{
  const Vector u = difference(first[1], first[0]), v = difference(second[1], second[0]),
               w = difference(first[0], second[0]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  double s = clamped((uv * vw - uw * vv) / (uu * vv - uv * uv));
  const double t = clamped((uv * s + vw) / vv);
  s = clamped((uv * t - uw) / uu);
  return difference(interpolated(first, s), interpolated(second, t));
}

} // namespace

// Let m be the largest coordinate, and ε = 2⁻⁵³. Ends of capsules are no larger than m. The sum r of the
// radii of two capsules that are found apart is below the distance of two ends, and so below 4 m.
// - A distance from a segment, plus a radius, is too small by at most 2⁶ ε m: a coordinate of the point on
//   the segment is wrong by at most 6 ε m, one of the difference by 8 ε m, its length by 14 ε m for these and
//   14 ε m for its own rounding, and the sum with a radius by 8 ε m.
// - For any vector n, a product with an end is wrong by at most 3 ε m (|n₁| + |n₂| + |n₃|) < 6 ε m |n|. The
//   gap between two capsules' segments along n, the least of four differences, is wrong by less than
//   2⁴ ε m |n|.
// - The product of r and |n|, as it is compared, is wrong by at most 2⁴ ε r |n| < 2⁶ ε m |n|.
// A margin of 2⁹ ε m for each capsule covers the first and half of the others, and that of either capsule
// covers all of the others. It holds as well where the compiler contracts a product and a sum into one
// operation.
double Capsule::margin_for(double largest)
{
  constexpr double least = 1e-50;
  return largest > least && largest < 1 / least ? 0x1p-44 * largest : 0;
}

Capsule::Capsule(const Vector& low, const Vector& high, double margin)
{
  m_ends.fill(middle(low, high));
  m_radius = std::sqrt(squared_length({m_ends[0], high})) + margin;
}

Capsule::Capsule(const Vector& a, const Vector& b, const Vector& c, double margin)
{
  const double ab = squared_length({a, b}), bc = squared_length({b, c}), ca = squared_length({c, a});
  const bool is_ab = ab >= bc && ab >= ca, is_bc = !is_ab && bc >= ca;
  m_ends = is_ab ? Segment{a, b} : is_bc ? Segment{b, c} : Segment{c, a};
  m_radius = distance(is_ab ? c : is_bc ? a : b, m_ends) + margin;
}

Capsule::Capsule(const Capsule& a, const Capsule& b, double margin)
{
  // The ends of b in the order in which they lie along a.
  Segment other = b.m_ends;
  if (dot(difference(a.m_ends[1], a.m_ends[0]), difference(other[1], other[0])) < 0)
    std::swap(other[0], other[1]);
  const Segment across{a.m_ends[0], other[1]}, back{other[0], a.m_ends[1]};
  // Suited to a long and a short one, to two in a row, and to two side by side.
  const std::array<Segment, 3> candidates{
      squared_length(a.m_ends) < squared_length(other) ? other : a.m_ends,
      squared_length(across) < squared_length(back) ? back : across,
      Segment{middle(a.m_ends[0], other[0]), middle(a.m_ends[1], other[1])}};
  const auto radius_around = [&](const Segment& segment) {
    return (std::max)((std::max)(distance(a.m_ends[0], segment), distance(a.m_ends[1], segment)) + a.m_radius,
                      (std::max)(distance(other[0], segment), distance(other[1], segment)) + b.m_radius) +
           margin;
  };
  m_radius = HUGE_VAL;
  for (const Segment& candidate : candidates)
    if (const double radius = radius_around(candidate); radius < m_radius) {
      m_ends = candidate;
      m_radius = radius;
    }
}

bool Capsule::is_slender() const
{
  constexpr double least_length = 4; // in radii
  return least_length * least_length * m_radius * m_radius < squared_length(m_ends);
}

bool are_apart(const Capsule& a, const Capsule& b)
{
  // Two planes perpendicular to n prove it: they leave more than both radii between the segments.
  const Vector n = shortest_between(a.m_ends, b.m_ends);
  const double radii = a.m_radius + b.m_radius, squared = dot(n, n);
  // A shorter vector joins points of both capsules. Besides, its square may have vanished.
  if (!(squared > radii * radii))
    return false;
  const double gap = (std::min)(dot(n, a.m_ends[0]), dot(n, a.m_ends[1])) -
                     (std::max)(dot(n, b.m_ends[0]), dot(n, b.m_ends[1]));
  return gap > 0 && gap * gap > radii * radii * squared;
}

} // namespace selvedge
