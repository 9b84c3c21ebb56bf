// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_INTERNAL_STAR_PACK_FILTER_H
#define SELVEDGE_GEOMETRY_INTERNAL_STAR_PACK_FILTER_H

#include <selvedge/geometry/internal/Separation_filter.h>
#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/internal/instructions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace selvedge {
namespace internal {

/// Proves in single precision, for eight triangles at a time, that they are clear of a moving star.
///
/// It comes before `Star_view` and everything that is exact, and spares these most of the triangles that an
/// index finds near a star. It sees them in the view of the star (`Separation_filter`). Where the processor
/// has AVX2, one instruction does the same with all eight, elsewhere with four; both do the same operations
/// in the same order.
///
/// A triangle is proved clear of all sweeps of the star by one of these:
/// 1. a side of the box around the star in the view;
/// 2. the plane of the triangle, unless all three corners are points of the star;
/// 3. for each sector of the star (see `Projected_star`), the line of its link edge, of one of its rays, or
/// of
///    an edge of the triangle. This is asked only where the star has such a projection.
///
/// Of a triangle for which this does not do, each sweep may still be proved clear by the plane or an edge of
/// the triangle, or by a plane parallel to the moving face before or after its motion.
///
/// Each of these has the triangle on one side and the star, at all times of its motion, strictly on the
/// other, except for corners of the triangle that are points of the star; they lie in the plane or line.
/// Corners are points of the star when they have its numbers. A corner at the same position with another
/// number is not on any side for certain, so that nothing is proved.
///
/// **Guarantees** `unclear` and `find_unclear` are one-sided: what they leave out is clear, in the sense of
/// `Separation_filter`.
///
/// **Preconditions** Those of `Projected_star`, where `begin_sectors` is called. No triangle has the vertex
/// that moves as a corner.
///
/// **Exactness** Floats count only beyond the bounds derived below. These hold for rounding to nearest.
///
/// **Complexity** About 400 vector instructions for eight triangles, and 100 where the box settles all.
class Star_pack_filter
{
public:
  using Index = Separation_filter::Index;
  using Mask = std::uint32_t;
  static constexpr std::size_t width = 8;
  using Sweeps = std::array<Mask, width>; ///< sweeps of the star, for each triangle of a pack

  /// Eight triangles, coordinate by coordinate, relative to the vertex that moves.
  struct alignas(32) Pack
  {
    std::array<std::array<float, width>, 9> coordinates;
    std::array<std::array<std::uint32_t, width>, 3> corners;

    /// Takes a triangle: the numbers of its corners, and the floats next to their coordinates, which are
    /// those in the mesh minus `origin()`, rounded once. What no float reaches becomes infinite, as IEEE 754
    /// says, and then nothing is proved.
    void set(std::size_t i, const std::array<std::uint32_t, 3>& numbers,
             const std::array<Vector_of_doubles, 3>& points)
    {
      for (std::size_t row = 0; row < 9; ++row)
        coordinates[row][i] = float(points[row / 3][row % 3]);
      for (std::size_t row = 0; row < 3; ++row)
        corners[row][i] = numbers[row];
    }
    void set(std::size_t i, const Pack& other, std::size_t j)
    {
      for (std::size_t row = 0; row < 9; ++row)
        coordinates[row][i] = other.coordinates[row][j];
      for (std::size_t row = 0; row < 3; ++row)
        corners[row][i] = other.corners[row][j];
    }
  };

  /// Starts anew with nothing about which anything could be proved.
  void begin_without_star()
  {
    m_is_usable = m_has_slabs = false;
    m_sectors = 0;
  }

  /// Starts anew with a star: its points, which are the first of the view and have these numbers, and the
  /// edges of its link in their order. A point that is no vertex has the number `s_none`. Point 0 is the
  /// vertex that moves, at the view's origin, and point 1 is where it goes.
  void begin(const Separation_filter& view, const Vector_of_doubles& origin,
             const std::vector<std::uint32_t>& numbers, const std::vector<std::array<Index, 2>>& link)
  {
    begin_without_star();
    const double extent = view.extent();
    if (!s_is_possible || !view.is_usable() || !(extent > 0x1p-100 && extent < 0x1p100) ||
        numbers.size() > s_most_points || link.size() > s_most_points)
      return;
    m_view = &view;
    m_origin = origin;
    m_scale = std::ldexp(1.0, -std::ilogb(extent) - 1); // so that distances within the star are less than 1
    m_reach_by_size = float(1.75 * m_scale);            // 1.75 is more than √3
    m_least_size = float(1 / (1.75 * m_scale));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        m_axes[i][j] = float(view.axis(i)[j] * m_scale);
    m_points = numbers.size();
    std::copy(numbers.begin(), numbers.end(), m_numbers.begin());
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < m_points; ++k)
        m_star[i][k] = float(view[Index(k)][i] * m_scale);
      m_lower[i] = *std::min_element(m_star[i].begin(), m_star[i].begin() + std::ptrdiff_t(m_points));
      m_upper[i] = *std::max_element(m_star[i].begin(), m_star[i].begin() + std::ptrdiff_t(m_points));
    }
    m_edges = link.size();
    for (std::size_t j = 0; j < m_edges; ++j) {
      m_starts[j] = link[j][0];
      m_ends[j] = link[j][1];
    }
    m_is_usable = true;
  }
  static constexpr std::uint32_t s_none = (std::numeric_limits<std::uint32_t>::max)();

  /// Says that the star that has begun has a projection as in `Projected_star`.
  void begin_sectors()
  {
    if (!m_is_usable)
      return;
    m_sectors = m_edges;
    for (std::size_t j = 0; j < m_sectors; ++j) {
      const Index a = m_starts[j], b = m_ends[j];
      m_line_u[j] = m_star[1][a] - m_star[1][b];
      m_line_v[j] = m_star[0][b] - m_star[0][a];
      m_line[j] = -(m_line_u[j] * m_star[0][a] + m_line_v[j] * m_star[1][a]);
    }
  }

  /// Whether anything can be proved about the star that has begun.
  bool is_usable() const { return m_is_usable; }
  /// Where the vertex is that moves.
  const Vector_of_doubles& origin() const { return m_origin; }

  /// Returns which of the first `count` triangles of a pack are not proved clear of the star.
  Mask unclear(const Pack& pack, std::size_t count) const
  {
    const Mask asked = (Mask(1) << count) - 1;
#ifdef __GNUC__
#if defined(__x86_64__) || defined(__i386__)
    if (is_avx2_used())
      return asked & ~clear_with_avx2(pack);
#endif
    return asked & ~(clear<4>(pack, 0) | clear<4>(pack, 4) << 4);
#else
    (void)pack;
    return asked;
#endif
  }

  /// Finds for each triangle of a pack the sweeps that are not proved clear of it: bit j is for the face at
  /// edge j of the link. It proves more than `unclear`, and takes longer. The view that the star has begun
  /// with must still have its points.
  void find_unclear(const Pack& pack, Sweeps& unclear)
  {
    if (!m_has_slabs)
      find_slabs();
#ifdef __GNUC__
#if defined(__x86_64__) || defined(__i386__)
    if (is_avx2_used())
      return find_unclear_with_avx2(pack, unclear);
#endif
    find_unclear<4>(pack, 0, unclear);
    find_unclear<4>(pack, 4, unclear);
#else
    (void)pack;
    unclear.fill(~Mask(0));
#endif
  }

  /// Whether the eight-fold version is used: true where the processor has AVX2. Tests switch it off.
  static bool& is_avx2_used()
  {
    static bool is_used = has_avx2();
    return is_used;
  }

private:
  static constexpr Index s_from = 0, s_to = 1;
  static constexpr std::size_t s_most_points = 32;
#ifdef __GNUC__
  static constexpr bool s_is_possible = true;
#else
  static constexpr bool s_is_possible = false; // there are no vectors of floats
#endif

  // The bounds. All lengths are in units in which the star lies within 1 of the view's origin, and ε = 2⁻²⁴.
  // Let R, for each triangle, be at least 1 and the largest distance of its corners from the view's origin.
  // - A corner, relative to the view's origin, is rounded to a double and then to a float. So it is moved by
  //   a vector not longer than 1.01 ε R.
  // - The axes of the view are perpendicular, not longer than 1, and rounded to floats. A coordinate in the
  //   view is a sum of three products. With the motion of the corner, its error is at most 6.1 ε R, and it is
  //   at most 1.01 R. Coordinates of the star have errors of at most 1.01 ε. Let e = 16 ε R.
  // - A coordinate of the triangle and one of the box: e would do; 2 e is asked for.
  // - A line is A u + B v + C, with A and B differences of coordinates of the star, at most 2 together. The
  //   sum of errors is at most 22 e, of which 10 e are those of C. 32 e is asked for.
  // - A height along the normal of a slab is as exact as a coordinate, and is compared likewise.
  // - A line through two corners of the triangle. Let D be the largest coordinate of an edge of the triangle.
  //   The errors are at most 6 e (R + D), also where the third corner is compared; 8 e (R + D) is asked for.
  // - A plane. Its normal is at most 2 D² in each coordinate. Arithmetic changes the height of a point of the
  //   star over the plane by at most 37 D e (1 + R) + 12 D² e, which is less than the 64 D e (1 + R + D) that
  //   is asked for.
  // None of this is larger than any float while R is at most 2²⁰. Of a larger triangle, nothing is proved.
  static constexpr double s_unit = 0x1p-24;
  static constexpr float s_rounding = float(16 * s_unit), s_largest_reach = 0x1p20f;

  // A direction of at most the length 1, and the heights along it between which a sweep lies.
  struct Slab
  {
    std::array<float, 3> normal;
    float lower, upper;
  };

  void find_slabs()
  {
    for (std::size_t j = 0; j < m_edges; ++j)
      m_slabs[j] = {float_slab(m_view->slab({m_starts[j], m_ends[j], s_from}, s_to)),
                    float_slab(m_view->slab({m_starts[j], m_ends[j], s_to}, s_from))};
    m_has_slabs = true;
  }

  Slab float_slab(const Separation_filter::Slab& slab) const
  {
    const double length = std::sqrt(dot(slab.normal, slab.normal)),
                 inverse = length > 0 ? 1 / length : 0; // of no direction: nothing is beyond it
    return {
        {float(slab.normal[0] * inverse), float(slab.normal[1] * inverse), float(slab.normal[2] * inverse)},
        float(slab.lower * inverse * m_scale),
        float(slab.upper * inverse * m_scale)};
  }

  static bool has_avx2()
  {
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
    return __builtin_cpu_supports("avx2") != 0;
#else
    return false;
#endif
  }

#ifdef __GNUC__
  template <std::size_t lanes>
  struct Vectors
  {
    typedef float Floats __attribute__((vector_size(4 * lanes), may_alias));
    typedef std::int32_t Answers __attribute__((vector_size(4 * lanes), may_alias)); // 0 or −1
    typedef std::uint32_t Numbers __attribute__((vector_size(4 * lanes), may_alias));
  };

  // As many triangles of a pack as one instruction takes, seen in the view. All of its functions are compiled
  // anew into each of their callers, for the instructions that these have.
  template <std::size_t lanes>
  struct Seen_triangles
  {
    using Floats = typename Vectors<lanes>::Floats;
    using Answers = typename Vectors<lanes>::Answers;

    __attribute__((always_inline))
    Seen_triangles(const Star_pack_filter& star, const Pack& pack, std::size_t first)
        : m_star(star)
    {
      Floats largest = Floats{} + star.m_least_size;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        Floats d[3];
        for (std::size_t i = 0; i < 3; ++i) {
          // Of `memcpy`, GCC makes two copies of half the size and waits for both.
          d[i] = *reinterpret_cast<const Floats*>(&pack.coordinates[3 * corner + i][first]);
          enlarge(largest, d[i]);
        }
        for (std::size_t i = 0; i < 3; ++i)
          m_corners[corner][i] =
              d[0] * star.m_axes[i][0] + d[1] * star.m_axes[i][1] + d[2] * star.m_axes[i][2];
      }
      m_reach = largest * star.m_reach_by_size; // R
      // No comparison with NaN is true.
      const Floats nothing = Floats{} + std::numeric_limits<float>::quiet_NaN();
      m_rounding = m_reach <= s_largest_reach ? m_reach * s_rounding : nothing; // e
    }

    // These functions do not return vectors but add to them, since how vectors are returned depends on the
    // instructions that a function may use.

    // Adds whether the triangle is beyond an interval along an axis, along which its corners have these
    // heights.
    __attribute__((always_inline)) void add_beyond(const Floats (&heights)[3], float lower, float upper,
                                                   Answers& is_clear) const
    {
      const Floats error = m_rounding * 2;
      Answers are_below = ~Answers{}, are_above = ~Answers{};
      for (const Floats& height : heights) {
        are_below &= height < lower - error;
        are_above &= height > upper + error;
      }
      is_clear |= are_below | are_above;
    }

    __attribute__((always_inline)) void add_clear_by_box(Answers& is_clear) const
    {
      for (std::size_t i = 0; i < 3; ++i) {
        const Floats heights[] = {m_corners[0][i], m_corners[1][i], m_corners[2][i]};
        add_beyond(heights, m_star.m_lower[i], m_star.m_upper[i], is_clear);
      }
    }

    // Finds out which corners are points of the star, and on which side of its plane these points are.
    __attribute__((always_inline)) void find_heights(const Pack& pack, std::size_t first)
    {
      Answers are_all_shared = ~Answers{};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto number =
            *reinterpret_cast<const typename Vectors<lanes>::Numbers*>(&pack.corners[corner][first]);
        Answers is_shared{};
        for (std::size_t k = 0; k < m_star.m_points; ++k)
          is_shared |= m_is_corner[corner][k] = number == m_star.m_numbers[k];
        are_all_shared &= is_shared;
      }
      const auto &p = m_corners[0], &q = m_corners[1], &r = m_corners[2];
      m_widest = Floats{};
      Floats a[3], b[3];
      for (std::size_t i = 0; i < 3; ++i) {
        a[i] = q[i] - p[i];
        b[i] = r[i] - p[i];
        enlarge(m_widest, a[i]);
        enlarge(m_widest, b[i]);
      }
      const Floats x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2],
                   z = a[0] * b[1] - a[1] * b[0];
      const Floats level = x * p[0] + y * p[1] + z * p[2];
      const Floats error = m_widest * m_rounding * 64 * (m_reach + m_widest + 1);
      const Floats highest = level + error, lowest = level - error;
      for (std::size_t k = 0; k < m_star.m_points; ++k) {
        const Floats height = x * m_star.m_star[0][k] + y * m_star.m_star[1][k] + z * m_star.m_star[2][k];
        const Answers is_shared = m_is_corner[0][k] | m_is_corner[1][k] | m_is_corner[2][k];
        m_is_above[k] = ~are_all_shared & (is_shared | (height > highest));
        m_is_below[k] = ~are_all_shared & (is_shared | (height < lowest));
      }
    }

    __attribute__((always_inline)) void add_clear_by_plane(Answers& is_clear) const
    {
      Answers are_above = ~Answers{}, are_below = ~Answers{};
      for (std::size_t k = 0; k < m_star.m_points; ++k) {
        are_above &= m_is_above[k];
        are_below &= m_is_below[k];
      }
      is_clear |= are_above | are_below;
    }

    // Adds whether each sector has a line that proves it clear: its own, or that of an edge of the triangle,
    // which are asked after `find_points_beyond_edges`.
    template <bool are_edges_asked>
    __attribute__((always_inline)) void add_clear_beside(Answers& is_clear) const
    {
      const Floats error = m_rounding * 32;
      Answers is_left, is_right, was_left, are_clear = ~Answers{};
      find_sides_of_ray(m_star.m_sectors - 1, error, was_left, is_right);
      for (std::size_t j = 0; j < m_star.m_sectors; ++j) {
        const std::size_t a = m_star.m_starts[j], b = m_star.m_ends[j];
        find_sides_of_ray(j, error, is_left, is_right);
        Answers is_beyond = ~Answers{};
        for (std::size_t corner = 0; corner < 3; ++corner)
          is_beyond &= m_is_corner[corner][a] | m_is_corner[corner][b] |
                       (m_corners[corner][0] * m_star.m_line_u[j] +
                            m_corners[corner][1] * m_star.m_line_v[j] + m_star.m_line[j] <
                        -error);
        if constexpr (are_edges_asked)
          add_edge_between({a, b, s_from, s_from}, is_beyond);
        are_clear &= is_beyond | is_right | was_left;
        was_left = is_left;
      }
      is_clear |= are_clear;
    }

    // On which sides of the ray from the vertex to the start of edge j the triangle is.
    __attribute__((always_inline)) void find_sides_of_ray(std::size_t j, const Floats& error,
                                                          Answers& is_left, Answers& is_right) const
    {
      const std::size_t a = m_star.m_starts[j];
      is_left = is_right = ~Answers{};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Floats side =
            m_corners[corner][1] * m_star.m_star[0][a] - m_corners[corner][0] * m_star.m_star[1][a];
        is_left &= m_is_corner[corner][a] | (side > error);
        is_right &= m_is_corner[corner][a] | (side < -error);
      }
    }

    // Finds out which points of the star are seen beyond each edge of the triangle. Call it after
    // `find_heights`.
    __attribute__((always_inline)) void find_points_beyond_edges()
    {
      const Floats error = m_rounding * 8 * (m_reach + m_widest);
      for (std::size_t edge = 0; edge < 3; ++edge) {
        const std::size_t next = (edge + 1) % 3, third = (edge + 2) % 3;
        const auto &p = m_corners[edge], &q = m_corners[next], &r = m_corners[third];
        const Floats u = p[1] - q[1], v = q[0] - p[0], w = -(u * p[0] + v * p[1]);
        const Floats own = u * r[0] + v * r[1] + w;
        const Answers is_own_left = own > error, is_own_right = own < -error;
        for (std::size_t k = 0; k < m_star.m_points; ++k) {
          const Floats side = u * m_star.m_star[0][k] + v * m_star.m_star[1][k] + w;
          const Answers is_shared = m_is_corner[edge][k] | m_is_corner[next][k];
          m_is_beyond_edge[edge][k] =
              (is_own_left & (is_shared | (side < -error))) | (is_own_right & (is_shared | (side > error)));
        }
      }
    }

    // Adds whether an edge of the triangle has these points of the star beyond it.
    __attribute__((always_inline)) void add_edge_between(const std::array<std::size_t, 4>& points,
                                                         Answers& is_clear) const
    {
      for (const auto& is_beyond : m_is_beyond_edge)
        is_clear |= is_beyond[points[0]] & is_beyond[points[1]] & is_beyond[points[2]] & is_beyond[points[3]];
    }

    // Adds whether the sweep at edge j of the link is proved clear of the triangle.
    __attribute__((always_inline)) void add_clear_of_sweep(std::size_t j, Answers& is_clear) const
    {
      const std::size_t a = m_star.m_starts[j], b = m_star.m_ends[j];
      add_edge_between({a, b, s_from, s_to}, is_clear);
      is_clear |= (m_is_above[a] & m_is_above[b] & m_is_above[s_from] & m_is_above[s_to]) |
                  (m_is_below[a] & m_is_below[b] & m_is_below[s_from] & m_is_below[s_to]);
      for (const Slab& slab : m_star.m_slabs[j]) {
        Floats heights[3];
        for (std::size_t corner = 0; corner < 3; ++corner)
          heights[corner] = m_corners[corner][0] * slab.normal[0] + m_corners[corner][1] * slab.normal[1] +
                            m_corners[corner][2] * slab.normal[2];
        add_beyond(heights, slab.lower, slab.upper, is_clear);
      }
    }

  private:
    static __attribute__((always_inline)) void enlarge(Floats& largest, const Floats& x)
    {
      const Floats size = Floats(Answers(x) & 0x7fffffff); // |x|
      largest = size > largest ? size : largest;
    }

    const Star_pack_filter& m_star;
    Floats m_corners[3][3];               // in the view, by corner, then by axis
    Floats m_reach, m_rounding, m_widest; // R, e and D
    Answers m_is_corner[3][s_most_points], m_is_above[s_most_points], m_is_below[s_most_points];
    Answers m_is_beyond_edge[3][s_most_points];
  };

#if defined(__x86_64__) || defined(__i386__)
  __attribute__((target("avx2"))) Mask clear_with_avx2(const Pack& pack) const
  {
    return clear<8>(pack, 0);
  }
  __attribute__((target("avx2"))) void find_unclear_with_avx2(const Pack& pack, Sweeps& unclear) const
  {
    find_unclear<8>(pack, 0, unclear);
  }
#endif

  template <std::size_t lanes>
  __attribute__((always_inline)) Mask clear(const Pack& pack, std::size_t first) const
  {
    Seen_triangles<lanes> seen(*this, pack, first);
    typename Vectors<lanes>::Answers is_clear{};
    seen.add_clear_by_box(is_clear);
    if (!are_all(is_clear)) {
      seen.find_heights(pack, first);
      seen.add_clear_by_plane(is_clear);
      if (m_sectors > 0 && !are_all(is_clear))
        seen.template add_clear_beside<false>(is_clear);
    }
    return bits(is_clear);
  }

  template <std::size_t lanes>
  __attribute__((always_inline)) void find_unclear(const Pack& pack, std::size_t first, Sweeps& unclear) const
  {
    using Answers = typename Vectors<lanes>::Answers;
    Seen_triangles<lanes> seen(*this, pack, first);
    seen.find_heights(pack, first);
    seen.find_points_beyond_edges();
    Answers is_star_clear{}, unclear_sweeps{};
    if (m_sectors > 0)
      seen.template add_clear_beside<true>(is_star_clear);
    for (std::size_t j = 0; j < m_edges; ++j) {
      Answers is_clear = is_star_clear;
      seen.add_clear_of_sweep(j, is_clear);
      unclear_sweeps |= ~is_clear & std::int32_t(Mask(1) << j);
    }
    std::memcpy(&unclear[first], &unclear_sweeps, sizeof unclear_sweeps);
  }

  template <class Answers>
  static __attribute__((always_inline)) bool are_all(const Answers& answers)
  {
    std::array<std::uint64_t, sizeof(Answers) / 8> words;
    std::memcpy(words.data(), &answers, sizeof answers);
    return std::all_of(words.begin(), words.end(), [](std::uint64_t word) { return ~word == 0; });
  }

  template <class Answers>
  static __attribute__((always_inline)) Mask bits(const Answers& answers)
  {
    std::array<std::int32_t, sizeof(Answers) / 4> numbers;
    std::memcpy(numbers.data(), &answers, sizeof answers);
    return negative(numbers);
  }
#endif

  bool m_is_usable = false, m_has_slabs = false;
  const Separation_filter* m_view = nullptr;
  Vector_of_doubles m_origin{};
  double m_scale = 1;
  float m_reach_by_size = 0, m_least_size = 0; // how R follows from the largest coordinate, which is not less
  std::array<std::array<float, 3>, 3> m_axes{};
  std::array<float, 3> m_lower{}, m_upper{}; // of the star, in the view
  std::size_t m_points = 0, m_edges = 0, m_sectors = 0;
  template <class T>
  using Row = std::array<T, s_most_points>;
  std::array<Row<float>, 3> m_star{};          // the points of the star, by axis
  Row<std::uint32_t> m_numbers{};              // of these points
  Row<Index> m_starts{}, m_ends{};             // of the link edges
  Row<float> m_line_u{}, m_line_v{}, m_line{}; // their lines
  Row<std::array<Slab, 2>> m_slabs{};          // of their sweeps
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_INTERNAL_STAR_PACK_FILTER_H
