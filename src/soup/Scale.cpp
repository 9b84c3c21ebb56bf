// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/internal/Scale.h>

#include <selvedge/Error.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

namespace selvedge {
namespace {

using Limits = std::numeric_limits<double>;

// Every double is a multiple of 2^s_lowest, and its absolute value is less than 2^s_beyond.
constexpr int s_lowest = Limits::min_exponent - Limits::digits, s_beyond = Limits::max_exponent;

/// The powers of two between which the digits of coordinates lie: all coordinates that triangles use are
/// multiples of 2^lowest, and their absolute values are less than 2^beyond.
struct Digits
{
  int lowest = s_beyond;
  int beyond = s_lowest;

  explicit Digits(const Triangle_soup& soup)
  {
    for (const Index_triple& triangle : soup.triangles)
      for (const Index v : triangle) {
        add(soup.points[v]);
        for (const Pose& pose : soup.poses)
          add(pose.points[v]);
      }
  }

private:
  void add(const Point_3& point)
  {
    for (int axis = 0; axis < 3; ++axis)
      add(point[axis]);
  }
  void add(double x)
  {
    if (x == 0)
      return;
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    beyond = std::max(beyond, exponent);
    int last = exponent - Limits::digits;
    if (last >= lowest)
      return;
    for (auto digits = std::int64_t(std::ldexp(fraction, Limits::digits)); digits % 2 == 0; digits /= 2)
      ++last;
    lowest = std::min(lowest, last);
  }
};

// Returns two numbers whose product is 2^exponent. To multiply by the first and then by the second gives the
// bits that std::ldexp gives, since the second is 1 unless the first is large and its product exact.
std::array<double, 2> factors(int exponent)
{
  constexpr int largest = s_beyond - 1;
  return {std::ldexp(1, std::min(exponent, largest)), std::ldexp(1, std::max(exponent - largest, 0))};
}

std::string power_of_two(int exponent)
{
  return "2^" + std::to_string(exponent);
}

} // namespace

Scale::Scale(const Triangle_soup& soup, const Triangle_soup& obstacle)
{
  constexpr int tolerance = 140;
  const Digits own(soup), beside(obstacle);
  if (own.lowest > own.beyond)
    return; // all coordinates are 0
  // Division by 2^k is exact for every k in this range, and 0 is one of them, since coordinates are doubles.
  const int lowest = std::min(own.lowest, beside.lowest), beyond = std::max(own.beyond, beside.beyond);
  const int exponent = std::clamp(own.beyond, beyond - s_beyond, lowest - s_lowest);
  m_power = factors(exponent);
  m_inverse = factors(-exponent);
  if (std::abs(own.beyond - exponent) > tolerance)
    throw Input_error("the coordinates differ too much in size to be scaled without loss: the largest of the "
                      "mesh is below " +
                      power_of_two(own.beyond) + ", the largest of mesh and obstacle is below " +
                      power_of_two(beyond) + ", and the smallest binary digit stands for " +
                      power_of_two(lowest) +
                      (beyond > own.beyond ? "; bring mesh and obstacle to one unit"
                                           : "; round the smallest coordinates to 0"));
}

Point_3 Scale::operator()(const Point_3& point) const
{
  return {(*this)(point.x()), (*this)(point.y()), (*this)(point.z())};
}

double Scale::operator()(double length) const
{
  return length * m_inverse[0] * m_inverse[1];
}

Point_3 Scale::undone(const Point_3& point) const
{
  return {undone(point.x()), undone(point.y()), undone(point.z())};
}

double Scale::undone(double length) const
{
  return length * m_power[0] * m_power[1];
}

} // namespace selvedge
