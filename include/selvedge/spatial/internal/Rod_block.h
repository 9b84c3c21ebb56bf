// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SPATIAL_INTERNAL_ROD_BLOCK_H
#define SELVEDGE_SPATIAL_INTERNAL_ROD_BLOCK_H

#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/spatial/internal/Box_block.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace selvedge {
namespace internal {

// For a rod or beam whose coordinates are not larger than m, and ε = 2⁻²⁴:
// - Ends of rods are rounded by less than 2 ε m, and all else that a rod is computed from, in doubles, by far
//   less. A margin of 2⁴ ε m on the radius covers this.
// - A coordinate in the plane of a beam is a product with a vector of length 1, up to rounding, minus
// another.
//   It is wrong by at most 2⁵ ε m.
// - The height of an end along a vector c of this plane is wrong by at most 2⁶ ε m |c|, as it comes from such
//   coordinates, and by 2³ ε m |c| for its own rounding.
// - The sum r of two radii is below 4 m when rods are proved apart. Its product with |c|, as it is compared,
//   is wrong by at most 2³ ε r |c| for rounding, and so are radii in the plane, as its axes are not quite of
//   length 1: together 2⁶ ε m |c|.
// A margin of 2⁸ ε m on the radius of a beam covers the last three. It holds as well where the compiler
// contracts a product and a sum into one operation. Between the limits, no fourth power of a length that
// counts vanishes or overflows.
constexpr double rod_margin = 0x1p-20, beam_margin = 0x1p-16;
constexpr double least_rod_extent = 1e-3, largest_rod_extent = 1e8;

/// The points within a radius of a segment. It encloses a sliver in any direction far more tightly than a box
/// with sides along the axes. The radius is infinite when nothing is known.
struct Rod
{
  using Vector = Vector_of_doubles;

  std::array<std::array<float, 3>, 2> ends{};
  float radius = std::numeric_limits<float>::infinity();

  /// Makes a rod along the longest side of a triangle.
  static Rod around_triangle(const std::array<Vector, 3>& corners)
  {
    std::array<Vector, 3> sides;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sides[i] = difference(corners[(i + 1) % 3], corners[i]);
      if (dot(sides[i], sides[i]) > dot(sides[longest], sides[longest]))
        longest = i;
    }
    Enclosure enclosure(corners[longest], sides[longest]);
    for (const Vector& corner : corners)
      enclosure.add(corner, 0);
    return enclosure.rod();
  }

  /// Makes a rod around others, parallel to the longest of them.
  template <class Rods>
  static Rod around(const Rods& rods)
  {
    const Rod* longest = nullptr;
    Vector centre{0, 0, 0};
    for (const Rod& rod : rods) {
      if (longest == nullptr || dot(rod.axis(), rod.axis()) > dot(longest->axis(), longest->axis()))
        longest = &rod;
      for (std::size_t axis = 0; axis < 3; ++axis)
        centre[axis] += (double(rod.ends[0][axis]) + double(rod.ends[1][axis])) / (2 * double(rods.size()));
    }
    if (longest == nullptr)
      return {};
    Enclosure enclosure(centre, longest->axis());
    for (const Rod& rod : rods)
      enclosure.add(rod);
    return enclosure.rod();
  }

  /// Makes it so long and thick that it encloses another. Returns whether it did not do so before.
  bool enclose(const Rod& other)
  {
    if (std::isinf(radius))
      return false;
    Enclosure enclosure(end(0), axis());
    enclosure.add(*this);
    const Enclosure before = enclosure;
    enclosure.add(other);
    if (enclosure == before)
      return false;
    *this = enclosure.rod();
    return true;
  }

  Vector end(std::size_t i) const { return {ends[i][0], ends[i][1], ends[i][2]}; }
  Vector axis() const { return difference(end(1), end(0)); }

  double extent() const
  {
    double largest = 0;
    for (const auto& place : ends)
      for (const float coordinate : place)
        largest = (std::max)(largest, std::fabs(double(coordinate)));
    return largest;
  }

private:
  // A cylinder around balls that are added to it. The rod on its axis contains it.
  class Enclosure
  {
  public:
    Enclosure(const Vector& origin, const Vector& direction)
        : m_origin(origin), m_direction(direction), m_square(dot(direction, direction))
    {
    }

    void add(const Vector& centre, double around)
    {
      const double along = m_square > 0 ? dot(difference(centre, m_origin), m_direction) / m_square : 0;
      const Vector away = difference(centre, at(along));
      m_first = (std::min)(m_first, along);
      m_last = (std::max)(m_last, along);
      m_radius = (std::max)(m_radius, std::sqrt(dot(away, away)) + around);
      for (const double coordinate : centre)
        m_extent = (std::max)(m_extent, std::fabs(coordinate));
    }
    void add(const Rod& rod)
    {
      for (std::size_t i = 0; i < 2; ++i)
        add(rod.end(i), rod.radius);
    }

    bool operator==(const Enclosure& other) const
    {
      return m_first == other.m_first && m_last == other.m_last && m_radius == other.m_radius;
    }

    Rod rod() const
    {
      const std::array<Vector, 2> limits{at(m_first), at(m_last)};
      double largest = m_extent;
      for (const Vector& limit : limits)
        for (const double coordinate : limit)
          largest = (std::max)(largest, std::fabs(coordinate));
      Rod result;
      if (!(largest > least_rod_extent && largest < largest_rod_extent && m_radius < largest_rod_extent))
        return result;
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
          result.ends[i][axis] = float(limits[i][axis]);
      result.radius = float(m_radius + rod_margin * largest);
      return result;
    }

  private:
    Vector at(double along) const
    {
      return {m_origin[0] + along * m_direction[0], m_origin[1] + along * m_direction[1],
              m_origin[2] + along * m_direction[2]};
    }

    Vector m_origin, m_direction;
    double m_square;
    double m_first = std::numeric_limits<double>::infinity(), m_last = -m_first, m_radius = 0, m_extent = 0;
  };
};

/// Returns whether a triangle is so thin, and its box so wide in two directions, that the box says little
/// about it. A wrong answer costs time, and nothing else.
inline bool is_askew_sliver(const std::array<Vector_of_doubles, 3>& corners)
{
  const auto& [a, b, c] = corners;
  Vector_of_doubles width;
  for (std::size_t axis = 0; axis < 3; ++axis)
    width[axis] = (std::max)({a[axis], b[axis], c[axis]}) - (std::min)({a[axis], b[axis], c[axis]});
  const Vector_of_doubles normal = cross(difference(b, a), difference(c, a));
  const double second =
      (std::max)((std::min)(width[0], width[1]), (std::min)((std::max)(width[0], width[1]), width[2]));
  constexpr double thin = 8; // the second width of the box, in widths of the triangle
  return second * second * dot(width, width) > thin * thin * dot(normal, normal);
}

/// The points that are seen in a disc, in a view along a long thin set of points.
class Beam
{
public:
  /// Makes a beam around the hull of some points, of which the first is somewhere on their axis. `extent` is
  /// the largest coordinate of the rods that it is compared with. The beam is usable if the points are long
  /// and thin.
  template <class Points>
  Beam(const Points& points, double extent)
  {
    Vector_of_doubles axis{0, 0, 0};
    for (const Vector_of_doubles& point : points) {
      const Vector_of_doubles d = difference(point, points.front());
      if (dot(d, d) > dot(axis, axis))
        axis = d;
      for (const double coordinate : point)
        extent = (std::max)(extent, std::fabs(coordinate));
    }
    const double length = std::sqrt(dot(axis, axis));
    if (!(extent > least_rod_extent && extent < largest_rod_extent && length > beam_margin * extent))
      return;
    std::size_t least = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      axis[i] /= length;
      if (std::fabs(axis[i]) < std::fabs(axis[least]))
        least = i;
    }
    Vector_of_doubles other{0, 0, 0};
    other[least] = 1;
    other = cross(other, axis);
    const double other_length = std::sqrt(dot(other, other));
    for (double& component : other)
      component /= other_length;
    const std::array<Vector_of_doubles, 2> axes{other, cross(axis, other)};
    for (std::size_t i = 0; i < 2; ++i) {
      double lower = std::numeric_limits<double>::infinity(), upper = -lower;
      for (const Vector_of_doubles& point : points) {
        lower = (std::min)(lower, dot(axes[i], point));
        upper = (std::max)(upper, dot(axes[i], point));
      }
      for (std::size_t k = 0; k < 3; ++k)
        m_axes[i][k] = float(axes[i][k]);
      m_centre[i] = float((lower + upper) / 2);
      m_radius = std::hypot(m_radius, float((upper - lower) / 2));
    }
    constexpr double least_length = 4; // in radii
    m_is_usable = length > least_length * double(m_radius);
    m_radius += float(beam_margin * extent);
  }

  bool is_usable() const { return m_is_usable; }

private:
  friend class Rod_block;

  std::array<std::array<float, 3>, 2> m_axes{};
  std::array<float, 2> m_centre{};
  float m_radius = 0;
  bool m_is_usable = false;
};

/// Sixteen rods, stored like the boxes of a `Box_block`.
class alignas(64) Rod_block
{
public:
  static constexpr std::size_t width = Box_block::width;
  using Mask = Box_block::Mask;

  Rod_block()
  {
    for (std::size_t i = 0; i < width; ++i)
      set(i, {});
  }

  void set(std::size_t i, const Rod& rod)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m_first[axis][i] = rod.ends[0][axis];
      m_second[axis][i] = rod.ends[1][axis];
    }
    m_radius[i] = rod.radius;
  }

  Rod operator[](std::size_t i) const
  {
    return {
        {{{m_first[0][i], m_first[1][i], m_first[2][i]}, {m_second[0][i], m_second[1][i], m_second[2][i]}}},
        m_radius[i]};
  }

  /// Returns the rods that may have a point in common with a beam; the others surely have none.
  Mask near(const Beam& beam) const
  {
    const auto& [u, v] = beam.m_axes;
    std::array<std::int32_t, width> answers;
    for (std::size_t i = 0; i < width; ++i) {
      // The rod's ends in the plane of the beam, and the centre of the beam at 0.
      const float au = u[0] * m_first[0][i] + u[1] * m_first[1][i] + u[2] * m_first[2][i] - beam.m_centre[0];
      const float av = v[0] * m_first[0][i] + v[1] * m_first[1][i] + v[2] * m_first[2][i] - beam.m_centre[1];
      const float bu =
          u[0] * m_second[0][i] + u[1] * m_second[1][i] + u[2] * m_second[2][i] - beam.m_centre[0];
      const float bv =
          v[0] * m_second[0][i] + v[1] * m_second[1][i] + v[2] * m_second[2][i] - beam.m_centre[1];
      const float du = bu - au, dv = bv - av;
      // Whichever point of the segment this is, the line across it proves what it does.
      const float along = -(au * du + av * dv) / (du * du + dv * dv);
      const float share = along > 0 ? (along < 1 ? along : 1) : 0;
      const float cu = au + share * du, cv = av + share * dv;
      const float square = cu * cu + cv * cv;
      const float a = cu * au + cv * av, b = cu * bu + cv * bv;
      const float gap = a < b ? a : b;
      const float radii = m_radius[i] + beam.m_radius;
      const float squared_radii = radii * radii;
      const bool is_apart = (gap > 0) & (square > squared_radii) & (gap * gap > squared_radii * square);
      answers[i] = is_apart ? 0 : -1;
    }
    return negative(answers);
  }

private:
  using Row = std::array<float, width>;

  std::array<Row, 3> m_first, m_second; // ends: x, y, z
  Row m_radius;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SPATIAL_INTERNAL_ROD_BLOCK_H
