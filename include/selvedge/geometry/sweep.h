// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_SWEEP_H
#define SELVEDGE_GEOMETRY_SWEEP_H

#include <selvedge/internal/exact_predicates.h>

#include <CGAL/Point_3.h>
#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace selvedge {

/// Decides whether a moving face keeps clear of stationary faces and segments.
///
/// The face (m, a, b) moves as m goes straight to t. Its *sweep*, the union of all its positions on the way,
/// is the closed tetrahedron conv(m, t, a, b). A stationary face or segment is *clear* of the sweep when the
/// two have in common exactly the simplex spanned by the positions that they share: nothing, a point, or an
/// edge. For an embedded mesh this is the same as "they meet only in what they share, at every time on the
/// way".
///
/// **Preconditions**, checked where CGAL checks its own: m, a and b are not collinear; t is none of m, a, b;
/// the positions of the stationary face or segment are distinct, and none of them is m. Everything else is
/// allowed and decided: a flat sweep (all four points coplanar), t on the line ab, a stationary face of three
/// collinear positions (it is judged as the segment that it is).
///
/// **Exactness**: only signs of orientations of the given points are used, and nothing is constructed. The
/// answer is exact: a kernel whose predicates are not does not compile. −0 equals 0.
///
/// **Complexity**: constant. The constructor computes the orientation of the sweep once. A face that shares a
/// position costs 1 to 9 further orientations. A face that shares none, but whose box overlaps that of the
/// sweep (the caller compares boxes first), costs 7 on average on cloth. Planar orientations are computed
/// only where orientations are zero.
///
/// **Reference**: Derichs, Misiak, Fuhrmann, "Intersection-free mesh decimation for high resolution cloth
/// models", the section on edge and face sweeps. Its two tests are stated as one here.
template <class Kernel>
class Sweep_test
{
public:
  using Point_3 = typename Kernel::Point_3;

  Sweep_test(const Point_3& m, const Point_3& t, const Point_3& a, const Point_3& b,
             const Kernel& kernel = Kernel())
      : m_kernel(kernel), m_points{m, t, a, b}, m_sign(orientation(m, t, a, b))
  {
    internal::require_exact_predicates<Kernel>();
    CGAL_precondition(!m_kernel.collinear_3_object()(m, a, b));
    CGAL_precondition(!is_equal(t, m) && !is_equal(t, a) && !is_equal(t, b));
  }

  /// Whether the stationary face is clear of the sweep. Also false when it has all three of t, a and b, for
  /// then the moving face ends on top of it.
  bool is_clear(const Point_3& f0, const Point_3& f1, const Point_3& f2) const
  {
    return judge<3>({&f0, &f1, &f2});
  }

  /// Whether the stationary segment is clear of the sweep.
  bool is_clear(const Point_3& f0, const Point_3& f1) const { return judge<2>({&f0, &f1}); }

private:
  using Sign = CGAL::Sign;
  // The vertices of a stationary face or segment.
  template <std::size_t n>
  using Vertices = std::array<const Point_3*, n>;

  // The corners 0 to 3 of the sweep are m, t, a, b. For every i the permutation (i, i^1, i^2, i^3) is even,
  // and stays so when its last three are rotated: all these orders have the orientation m_sign.
  const Point_3& corner(std::size_t i) const { return m_points[i]; }

  bool is_flat() const { return m_sign == CGAL::ZERO; }

  bool is_equal(const Point_3& p, const Point_3& q) const { return m_kernel.equal_3_object()(p, q); }

  Sign orientation(const Point_3& p, const Point_3& q, const Point_3& r, const Point_3& s) const
  {
    return m_kernel.orientation_3_object()(p, q, r, s);
  }

  // CGAL promises that planar orientation is coherent for all triples of points of one plane.
  Sign planar_orientation(const Point_3& p, const Point_3& q, const Point_3& r) const
  {
    return m_kernel.coplanar_orientation_3_object()(p, q, r);
  }

  // On which side of the facet opposite to corner k the point p lies: a sweep that is not flat lies on the
  // positive side.
  Sign side_of_facet(std::size_t k, const Point_3& p) const
  {
    const Sign side = orientation(p, corner(k ^ 1), corner(k ^ 2), corner(k ^ 3));
    return m_sign == CGAL::NEGATIVE ? -side : side;
  }

  template <std::size_t n>
  bool judge(Vertices<n> f) const
  {
    std::size_t shared = 0;
    std::array<std::size_t, n> corners{};
    for (std::size_t j = 0; j < n; ++j) {
      CGAL_precondition(!is_equal(*f[j], corner(0)));
      for (std::size_t i = 1; i < 4; ++i) {
        if (is_equal(*f[j], corner(i))) {
          std::swap(f[shared], f[j]);
          corners[shared++] = i;
          break;
        }
      }
    }
    if (shared == 0)
      return is_disjoint<n>(f);
    if constexpr (n == 2)
      return shared == 2 || !is_in_cone(corners[0], *f[1]);
    else if (shared == 1)
      return is_clear_at_vertex(corners[0], *f[1], *f[2]);
    else
      return shared == 2 && is_clear_at_edge(corners[0], corners[1], *f[2]);
  }

  // Two positions are shared. Seen along the common edge xy, the sweep is the sector between the directions
  // of its other corners p and q, and the face is the direction of z.
  bool is_clear_at_edge(std::size_t i, std::size_t j, const Point_3& z) const
  {
    const std::size_t turn = i ^ j;
    const Point_3 &x = corner(i), &y = corner(j), &p = corner(i ^ (turn % 3 + 1)),
                  &q = corner(i ^ ((turn + 1) % 3 + 1));
    const Sign from_p = orientation(x, y, p, z);
    if (from_p * m_sign == CGAL::NEGATIVE)
      return true;
    const Sign to_q = orientation(x, y, z, q);
    if (to_q * m_sign == CGAL::NEGATIVE)
      return true;
    if (from_p != CGAL::ZERO || to_q != CGAL::ZERO)
      return is_flat();

    const Sign side = planar_orientation(x, y, z);
    if (side != CGAL::ZERO)
      return planar_orientation(x, y, p) != side && planar_orientation(x, y, q) != side;

    // The face is collinear: what extends beyond the common edge is a segment at one of its ends.
    const auto is_between = m_kernel.collinear_are_ordered_along_line_3_object();
    return is_between(x, z, y) || !is_in_cone(is_between(x, y, z) ? j : i, z);
  }

  // One position x is shared. Let the rays u span the cone of the sweep at x, and the rays w the sector of
  // the face at x. The two have more than x in common when one contains a ray of the other, or else when the
  // inside of the sector crosses the inside of the cone of two of the u.
  bool is_clear_at_vertex(std::size_t i, const Point_3& w0, const Point_3& w1) const
  {
    const Point_3& x = corner(i);
    const std::array<const Point_3*, 3> u{&corner(i ^ 1), &corner(i ^ 2), &corner(i ^ 3)};

    const std::array<Sign, 3> height{orientation(x, w0, w1, *u[0]), orientation(x, w0, w1, *u[1]),
                                     orientation(x, w0, w1, *u[2])};
    if (height[0] != CGAL::ZERO && height[0] == height[1] && height[0] == height[2])
      return true;

    std::array<std::array<Sign, 2>, 3> side;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      side[k] = {orientation(x, *u[k], *u[next], w0), orientation(x, *u[k], *u[next], w1)};
      if (side[k][0] != CGAL::ZERO && side[k][0] == side[k][1] && side[k][0] != m_sign)
        return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (height[k] != CGAL::ZERO && height[next] == -height[k] && side[k][0] == -height[k] &&
          side[k][1] == height[k])
        return false;
    }
    for (std::size_t j = 0; j < 2; ++j) {
      const std::array<Sign, 3> sides{side[0][j], side[1][j], side[2][j]};
      if (is_in_cone(i, j == 0 ? w0 : w1, sides))
        return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (height[k] == CGAL::ZERO && is_in_planar_cone(x, w0, w1, *u[k]))
        return false;
    }
    return true;
  }

  // Whether the ray from corner i to w lies in the closed cone of the rays from there to the other corners.
  bool is_in_cone(std::size_t i, const Point_3& w) const
  {
    std::array<Sign, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      sides[k] = orientation(corner(i), corner(i ^ (k + 1)), corner(i ^ ((k + 1) % 3 + 1)), w);
      if (sides[k] != CGAL::ZERO && sides[k] != m_sign)
        return false;
    }
    return is_in_cone(i, w, sides);
  }

  bool is_in_cone(std::size_t i, const Point_3& w, const std::array<Sign, 3>& sides) const
  {
    for (const Sign side : sides) {
      if (side != CGAL::ZERO && side != m_sign)
        return false;
    }
    // A flat cone is the union of the cones of those pairs of its rays that are not collinear: the sweep is
    // never less than two-dimensional, so every ray belongs to such a pair.
    return !is_flat() || is_in_planar_cone(corner(i), corner(i ^ 1), corner(i ^ 2), w) ||
           is_in_planar_cone(corner(i), corner(i ^ 2), corner(i ^ 3), w) ||
           is_in_planar_cone(corner(i), corner(i ^ 3), corner(i ^ 1), w);
  }

  // Whether the ray xw lies in the closed cone of the rays xu and xv, all in one plane. False whenever xu and
  // xv are collinear.
  bool is_in_planar_cone(const Point_3& x, const Point_3& u, const Point_3& v, const Point_3& w) const
  {
    const Sign turn = planar_orientation(x, u, v);
    return turn != CGAL::ZERO && planar_orientation(x, u, w) != -turn && planar_orientation(x, w, v) != -turn;
  }

  // No position is shared. Separating planes are tried first, since they settle most cases. Computing a few
  // signs again for the others is cheaper than computing all signs always.
  template <std::size_t n>
  bool is_disjoint(const Vertices<n>& f) const
  {
    if (is_flat()) {
      // Of all facets, facet 1, the first position of the moving face, is sure to span the plane.
      const Sign side = side_of_facet(1, *f[0]);
      if (std::all_of(f.begin() + 1, f.end(), [&](const Point_3* p) { return side_of_facet(1, *p) == side; }))
        return side != CGAL::ZERO || is_disjoint_in_plane<n>(f);
    } else {
      for (std::size_t k = 0; k < 4; ++k) {
        if (std::all_of(f.begin(), f.end(),
                        [&](const Point_3* p) { return side_of_facet(k, *p) == CGAL::NEGATIVE; }))
          return true;
      }
    }
    if constexpr (n == 3) {
      const Sign side = orientation(*f[0], *f[1], *f[2], corner(0));
      if (side != CGAL::ZERO && side == orientation(*f[0], *f[1], *f[2], corner(1)) &&
          side == orientation(*f[0], *f[1], *f[2], corner(2)) &&
          side == orientation(*f[0], *f[1], *f[2], corner(3)))
        return true;
    }
    return !is_met<n>(f);
  }

  // Whether f meets the sweep, where the two do not lie in one plane. They meet when a vertex of f lies in
  // the sweep, or when an edge of one that does not lie in the plane of a face of the other pierces that
  // face. Edges that lie in the plane of a face can be left out: where such an edge meets the face, another
  // edge of the same triangle or tetrahedron leaves that plane.
  template <std::size_t n>
  bool is_met(const Vertices<n>& f) const
  {
    std::array<std::array<Sign, n>, 4> side;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t j = 0; j < n; ++j)
        side[k][j] = side_of_facet(k, *f[j]);
    }
    for (std::size_t j = 0; j < n; ++j) {
      if (!is_flat() && side[0][j] != CGAL::NEGATIVE && side[1][j] != CGAL::NEGATIVE &&
          side[2][j] != CGAL::NEGATIVE && side[3][j] != CGAL::NEGATIVE)
        return true;
      for (std::size_t l = 0; l < j; ++l) {
        for (std::size_t k = 0; k < 4; ++k) {
          if (side[k][j] != side[k][l] &&
              is_pierced(corner(k ^ 1), corner(k ^ 2), corner(k ^ 3), *f[j], *f[l]))
            return true;
        }
      }
    }
    if constexpr (n == 3) {
      std::array<Sign, 4> height;
      for (std::size_t i = 0; i < 4; ++i) {
        height[i] = orientation(*f[0], *f[1], *f[2], corner(i));
        for (std::size_t j = 0; j < i; ++j) {
          if (height[i] != height[j] && is_pierced(*f[0], *f[1], *f[2], corner(i), corner(j)))
            return true;
        }
      }
    }
    return false;
  }

  // Whether the line pq passes through the closed triangle uvw. The line does not lie in the triangle's
  // plane.
  bool is_pierced(const Point_3& u, const Point_3& v, const Point_3& w, const Point_3& p,
                  const Point_3& q) const
  {
    const Sign uv = orientation(p, q, u, v);
    const Sign vw = orientation(p, q, v, w);
    if (uv * vw == CGAL::NEGATIVE)
      return false;
    const Sign wu = orientation(p, q, w, u);
    return uv * wu != CGAL::NEGATIVE && vw * wu != CGAL::NEGATIVE;
  }

  // The sweep and f lie in one plane. They are disjoint when the line through an edge of one of them has the
  // other strictly on its far side.
  template <std::size_t n>
  bool is_disjoint_in_plane(const Vertices<n>& f) const
  {
    const Vertices<4> sweep{&corner(0), &corner(1), &corner(2), &corner(3)};
    return has_separating_edge(sweep, f) || has_separating_edge(f, sweep);
  }

  template <std::size_t n, std::size_t n_other>
  bool has_separating_edge(const Vertices<n>& own, const Vertices<n_other>& other) const
  {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Sign far = planar_orientation(*own[i], *own[j], *other[0]);
        bool separates = far != CGAL::ZERO;
        for (std::size_t k = 1; separates && k < n_other; ++k)
          separates = planar_orientation(*own[i], *own[j], *other[k]) == far;
        for (std::size_t k = 0; separates && k < n; ++k)
          separates = k == i || k == j || planar_orientation(*own[i], *own[j], *own[k]) != far;
        if (separates)
          return true;
      }
    }
    return false;
  }

  Kernel m_kernel;
  std::array<Point_3, 4> m_points;
  Sign m_sign;
};

/// Whether the stationary face (f0, f1, f2) is clear of the face (m, a, b) while m goes straight to t. See
/// Sweep_test for preconditions and exactness; for several stationary faces, it computes the common part
/// once.
template <class Kernel>
bool is_sweep_clear(const CGAL::Point_3<Kernel>& m, const CGAL::Point_3<Kernel>& t,
                    const CGAL::Point_3<Kernel>& a, const CGAL::Point_3<Kernel>& b,
                    const CGAL::Point_3<Kernel>& f0, const CGAL::Point_3<Kernel>& f1,
                    const CGAL::Point_3<Kernel>& f2, const Kernel& kernel = Kernel())
{
  return Sweep_test<Kernel>(m, t, a, b, kernel).is_clear(f0, f1, f2);
}

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_SWEEP_H
