// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_INTERNAL_PROJECTED_STAR_H
#define SELVEDGE_GEOMETRY_INTERNAL_PROJECTED_STAR_H

#include <selvedge/geometry/internal/Separation_filter.h>
#include <selvedge/internal/instructions.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace selvedge {

/// Proves cheaply that a face beside a star is clear of all sweeps of the star at once.
///
/// It holds what the faces around a vertex cover in a view while the vertex moves: a polygon, star-shaped
/// about the place where the vertex comes from.
///
/// **Why all sweeps lie in this polygon.** The star is closed, and the view shows it clear of itself: around
/// the vertex all faces turn the same way, before the motion and, except for the contracted ones, after it.
/// Since the star is embedded before, the link winds once about the vertex, and is a simple polygon. Wherever
/// the vertex is on its way, its faces then cover each point as often as the link winds about that point,
/// which does not depend on where the vertex is. So all sweeps lie in the *sectors*: the triangles of the
/// place where the vertex comes from and one edge of the link.
///
/// **Why a face is clear of them.** A face that does not contain the vertex is clear when the view has, for
/// each sector, a line with the sector on one side and the corners of the face on the other. The lines that
/// are tried are that of the link edge, the two rays from the vertex to the ends of this edge, and the edges
/// of the face. Corners of the face that are also corners of the link may lie on the line itself: what the
/// face has over the line is then the simplex of these corners, and a sweep reaches the rim of the polygon
/// only in what its own corners span.
///
/// **Guarantees** `is_clear` is one-sided: true is proved, false is undecided.
///
/// **Preconditions** the caller must ensure:
/// 1. The star is embedded at time 0, where the vertex comes from.
/// 2. Its link is one cycle of distinct positions.
/// 3. Its faces turn the same way, as above.
///
/// The first does not follow from the last: around a link that winds twice, a pentagram, all faces turn the
/// same way, and intersect. What `is_clear` proves about faces beside such a star is still true: where a face
/// of the star covers a point, the link winds about this point, so a sector covers it. But the same view is
/// taken as a proof that the star is clear of itself, and for a pentagram this would be wrong. The first
/// holds because an embedded mesh stays embedded (G1 in docs/guarantees.md), and in any other mesh the
/// vertices of all faces of offending pairs are locked: by `prepare`, or by callers who bring their own mesh.
/// So no star that moves winds twice.
///
/// **Exactness** As in `Separation_filter`, whose bound for areas also holds for the lines.
///
/// **Complexity** Linear in the number of link edges, once for each point. For a face, a few operations on
/// bits, and one question to the view for each sector that these leave undecided.
class Projected_star
{
public:
  using Index = Separation_filter::Index;
  static constexpr std::size_t s_max_edges = 64;

  /// Starts anew with the vertex at point `from` of the view, and with the edges of its link in their order
  /// around the vertex: `edges[i]` goes from a_i to b_i = a_(i−1). There are at most `s_max_edges`.
  void begin(const Separation_filter& view, Index from, const std::vector<std::array<Index, 2>>& edges)
  {
    m_from = from;
    m_edges = &edges;
    m_all = ~Mask(0) >> (s_max_edges - edges.size());
    if (++m_star == 0) { // after 2³² stars, sides of old stars would count again
      m_sides.clear();
      m_star = 1;
    }
    const auto& o = view[from];
    for (std::size_t j = 0; j < edges.size(); ++j) {
      const auto& a = view[edges[j][0]];
      m_lines.set(j, a, view[edges[j][1]]);
      m_rays.set(j, o, a);
    }
    for (m_padded = edges.size(); m_padded % 2 != 0; ++m_padded) {
      m_lines.set(m_padded, o, o); // no point is on a side of this line
      m_rays.set(m_padded, o, o);
    }
    for (std::size_t j = 0; j < edges.size(); ++j) {
      Sides& sides = sides_of(view, edges[j][0]);
      const Mask ray = Mask(1) << j;
      sides.beyond |= ray | turned(ray);
      sides.left |= ray;
      sides.right |= ray;
    }
  }

  /// Whether a face that does not have the vertex is clear of all sweeps of the star.
  bool is_clear(const Separation_filter& view, const std::array<Index, 3>& face)
  {
    sides_of(view, face[0]);
    sides_of(view, face[1]);
    sides_of(view, face[2]);
    const Sides &a = m_sides[face[0]], &b = m_sides[face[1]], &c = m_sides[face[2]];
    const Mask clear =
        (a.beyond & b.beyond & c.beyond) | (a.right & b.right & c.right) | turned(a.left & b.left & c.left);
    Mask unclear = m_all & ~clear;
    for (std::size_t j = 0; unclear != 0; ++j, unclear >>= 1)
      if ((unclear & 1) != 0 &&
          !view.is_clear_by_edge(face, std::array<Index, 3>{m_from, (*m_edges)[j][0], (*m_edges)[j][1]}))
        return false;
    return true;
  }

private:
  using Mask = std::uint64_t;
  /// Lines in the view, each as a function au + bv + c of a point: twice the area of the triangle of two
  /// points of the line and this point, positive on the left.
  struct Lines
  {
    std::array<double, s_max_edges> a, b, c;

    void set(std::size_t j, const Separation_filter::Vector& p, const Separation_filter::Vector& q)
    {
      a[j] = p[1] - q[1];
      b[j] = q[0] - p[0];
      c[j] = -(a[j] * p[0] + b[j] * p[1]);
    }

    internal::Signs sides(std::size_t count, const Separation_filter::Vector& p, double error) const
    {
      return internal::signs_of_sums(a.data(), b.data(), c.data(), count, p[0], p[1], error);
    }
  };

  /// On which side of each line a point surely lies: bit j is for the line of edge j (`beyond`), and for the
  /// ray to its start (`left`, `right`). A point of the link counts as on both sides of its own lines.
  struct Sides
  {
    std::uint32_t star = 0; // the number of the star for which this was computed
    Mask beyond = 0, left = 0, right = 0;
  };

  // Turns bits of the rays to the starts of edges into bits of the rays to their ends.
  Mask turned(Mask mask) const { return ((mask << 1) | (mask >> (m_edges->size() - 1))) & m_all; }

  Sides& sides_of(const Separation_filter& view, Index point)
  {
    if (point >= m_sides.size())
      m_sides.resize(point + std::size_t(1));
    Sides& sides = m_sides[point];
    if (sides.star == m_star)
      return sides;
    const auto& p = view[point];
    const double error = view.area_error();
    const internal::Signs of_lines = m_lines.sides(m_padded, p, error),
                          of_rays = m_rays.sides(m_padded, p, error);
    sides = {m_star, of_lines.negative, of_rays.positive, of_rays.negative};
    return sides;
  }

  Index m_from = 0;
  const std::vector<std::array<Index, 2>>* m_edges = nullptr;
  Mask m_all = 0;
  Lines m_lines, m_rays;
  std::size_t m_padded = 0;
  std::uint32_t m_star = 0;   // the number of the star
  std::vector<Sides> m_sides; // by point
};

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_INTERNAL_PROJECTED_STAR_H
