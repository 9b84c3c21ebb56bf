// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_STAR_SHADOW_H
#define SELVEDGE_GEOMETRY_STAR_SHADOW_H

#include <selvedge/geometry/Certified_view.h>
#include <selvedge/internal/instructions.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace selvedge {

/// What the faces around a vertex cover while it moves, in a view: a polygon, star-shaped about where the
/// vertex comes from. A cheap way to prove that faces beside the star are clear of all its sweeps at once.
///
/// The star is closed, and seen to be clear: around the vertex all faces turn the same way, before and, but
/// for the contracted ones, after. Since it is embedded before, the link winds once about the vertex, and is
/// a simple polygon. Wherever on its way the vertex is, its faces then cover each point as often as the link
/// winds about it, which does not depend on where it is: all sweeps lie in the *sectors*, the triangles of
/// the place it comes from and one edge of the link.
///
/// A face that does not contain the vertex is clear when for each sector it has, in the view, its own corners
/// beyond a line that has the sector on this side: the line of the link edge, one of the two rays from the
/// vertex to the ends of this edge, or an edge of the face. On the line there may be corners that are also
/// those of the link: what lies over the line of a face is the simplex of these corners, and no sweep comes
/// to the rim of the polygon elsewhere than at its own corners.
///
/// **Guarantees** What `is_clear` answers with yes is so. No means "not proved".
///
/// **Preconditions** the caller must ensure: the star is embedded at time 0, where the vertex comes from; its
/// link is one cycle of distinct positions; its faces turn the same way, as above. The first does not follow
/// from the last: around a link that winds twice, a pentagram, all faces turn the same way, and intersect.
/// Of faces beside such a star `is_clear` still tells the truth: where a face of the star covers a point, the
/// link winds about it, so a sector covers it. But the same view is taken for a proof that the star is clear
/// of itself, and of a pentagram it proves that wrongly. Who guarantees it: an embedded mesh stays embedded
/// (G1 in docs/guarantees.md), and in any other the vertices of all faces of offending pairs are locked
/// (`prepare`; on a mesh of the caller, himself). So no star that moves winds twice.
///
/// **Exactness** As `Certified_view`, whose bound for areas holds for the lines, too.
///
/// **Complexity** Linear in the number of link edges, once for a point; a few operations on bits for a face.
class Star_shadow
{
public:
  using Index = Certified_view::Index;
  static constexpr std::size_t s_max_edges = 64;

  /// Starts anew with the vertex at point `from` of the view and `edges[i]` from a_i to b_i = a_(i−1), in
  /// this order around the vertex; at most `s_max_edges`.
  void begin(const Certified_view& view, Index from, const std::vector<std::array<Index, 2>>& edges)
  {
    m_from = from;
    m_edges = &edges;
    m_all = ~Mask(0) >> (s_max_edges - edges.size());
    if (++m_star == 0) { // after four thousand million stars, old sides would count again
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
      m_lines.set(m_padded, o, o); // on the side of which is nothing
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

  /// Is a face without the vertex clear of all sweeps of the star?
  bool is_clear(const Certified_view& view, const std::array<Index, 3>& face)
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
  /// Each as a function of a point, au + bv + c: twice the area of the triangle of two points of the line and
  /// this one, positive on the left.
  struct Lines
  {
    std::array<double, s_max_edges> a, b, c;

    void set(std::size_t j, const Certified_view::Vector& p, const Certified_view::Vector& q)
    {
      a[j] = p[1] - q[1];
      b[j] = q[0] - p[0];
      c[j] = -(a[j] * p[0] + b[j] * p[1]);
    }

    internal::Signs sides(std::size_t count, const Certified_view::Vector& p, double error) const
    {
      return internal::signs_of_sums(a.data(), b.data(), c.data(), count, p[0], p[1], error);
    }
  };

  /// Bit j tells on which side of the line of edge j, or of the ray to its start, a point surely lies. A
  /// point of the link counts as on either side of its own lines.
  struct Sides
  {
    std::uint32_t star = 0; // the last star that it is of
    Mask beyond = 0, left = 0, right = 0;
  };

  // From bits of rays at the starts of edges to bits of rays at their ends.
  Mask turned(Mask mask) const { return ((mask << 1) | (mask >> (m_edges->size() - 1))) & m_all; }

  Sides& sides_of(const Certified_view& view, Index point)
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
  std::uint32_t m_star = 0;   // its number
  std::vector<Sides> m_sides; // by point
};

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_STAR_SHADOW_H
