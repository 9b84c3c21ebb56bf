// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_STAR_VIEW_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_STAR_VIEW_H

#include <selvedge/geometry/Certified_view.h>
#include <selvedge/geometry/Star_shadow.h>

#include <CGAL/Kernel_traits.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <type_traits>
#include <vector>

namespace selvedge {
namespace internal {

/// A star that moves, seen from far away along the sum of the normals of its faces, in floating point with
/// certified errors.
///
/// **Exactness** One-sided: true is proved, false is undecided. Where coordinates are not doubles, there is
/// no view.
template <class Star>
class Star_view
{
  using Point = typename Star::Point;
  using Local = typename Star::Local;
  static constexpr Local s_from = Star::s_from, s_to = Star::s_to;
  // Coordinates of other kernels may be exact numbers that no double is.
  static constexpr bool s_is_possible =
      std::is_same_v<typename CGAL::Kernel_traits<Point>::Kernel::FT, double>;

public:
  /// A face that stands still, its corners numbered by the star.
  struct Stationary_face
  {
    std::array<Local, 3> corners;
    Certified_view::Heights heights = {}; ///< of the star above its plane
  };

  enum class Clear { no, by_box, by_view };

  explicit Star_view(const Star& star) : m_star(star) {}

  /// Called for every motion; nothing below may be asked unless `has_view()` says so afterwards.
  void begin()
  {
    m_has_view = m_has_shadow = false;
    if constexpr (s_is_possible) {
      m_face_slabs.clear();
      begin_view();
      m_has_view = m_view.is_usable();
    }
  }
  bool has_view() const { return m_has_view; }

  /// Called for every point that the star has numbered since `begin`.
  void add(const Point& point)
  {
    if constexpr (s_is_possible)
      m_view.add(coordinates(point));
  }

  /// As `judge_star_motion` says it, seen from infinitely far away: the link is one cycle of distinct
  /// positions, and all faces turn the same way, before and after.
  bool is_star_clear()
  {
    const auto& link = m_star.link();
    if (!m_has_view || !m_star.is_cycle() || link.size() > Star_shadow::s_max_edges)
      return false;
    for (std::size_t j = 0; j < link.size(); ++j) {
      const auto& [a, b] = link[j];
      if (m_view.side(s_from, a, b) != 1 || (!m_star.is_contracted(j) && m_view.side(s_to, a, b) != 1))
        return false;
    }
    m_shadow.begin(m_view, s_from, link);
    return m_has_shadow = true;
  }

  /// Called before the first face is compared with the star.
  void enclose_star()
  {
    m_view.enclose();
    m_star_points.resize(m_star.size());
    std::iota(m_star_points.begin(), m_star_points.end(), Local(0));
    m_star_mask = m_view.mask(m_star_points);
  }

  /// Whether the face is clear of the whole star at all times. Stores its heights.
  Clear is_clear_of_star(Stationary_face& face)
  {
    if (m_view.is_clear_of_box(face.corners))
      return Clear::by_box;
    const auto is_clear_by_plane = [&] {
      face.heights = m_view.heights(face.corners, m_star.size());
      return face.heights.is_clear(m_star_mask);
    };
    const auto is_clear_beside = [&] {
      return m_has_shadow ? m_shadow.is_clear(m_view, face.corners)
                          : m_view.is_clear_by_edge(face.corners, m_star_points);
    };
    // Neighbours lie beside the star, other layers above or below.
    const bool is_neighbour = (std::min)({face.corners[0], face.corners[1], face.corners[2]}) < m_star.size();
    const bool is_clear =
        is_neighbour ? is_clear_beside() || is_clear_by_plane() : is_clear_by_plane() || is_clear_beside();
    return is_clear ? Clear::by_view : Clear::no;
  }

  /// Whether the sweep of the face at the j-th edge of the link is clear of a face of which the star is not.
  bool is_sweep_clear(std::size_t j, const Stationary_face& face)
  {
    const auto [a, b] = m_star.link()[j];
    const std::array<Local, 4> corners{a, b, s_from, s_to};
    if (face.heights.is_clear(m_view.mask(corners)))
      return true;
    if (m_face_slabs.empty())
      for (const auto& [start, end] : m_star.link())
        m_face_slabs.push_back(
            {m_view.slab({start, end, s_from}, s_to), m_view.slab({start, end, s_to}, s_from)});
    return m_view.is_clear_of_slab(face.corners, m_face_slabs[j][0]) ||
           m_view.is_clear_of_slab(face.corners, m_face_slabs[j][1]) ||
           m_view.is_clear_by_edge_of(corners, face.corners) ||
           m_view.is_clear_by_edge(face.corners, corners);
  }

private:
  // The planes of a face before and after it moves, as directions: between which heights its sweep lies in
  // each.
  using Face_slabs = std::array<Certified_view::Slab, 2>;

  void begin_view()
  {
    Certified_view::Vector normal{0, 0, 0};
    const auto add_normal = [&](Local apex, const std::array<Local, 2>& edge) {
      const Point &o = m_star[apex], &a = m_star[edge[0]], &b = m_star[edge[1]];
      const double ux = a.x() - o.x(), uy = a.y() - o.y(), uz = a.z() - o.z(), vx = b.x() - o.x(),
                   vy = b.y() - o.y(), vz = b.z() - o.z();
      normal[0] += uy * vz - uz * vy;
      normal[1] += uz * vx - ux * vz;
      normal[2] += ux * vy - uy * vx;
    };
    for (const auto& edge : m_star.link()) {
      add_normal(s_from, edge);
      if (!m_star.is_closed()) // otherwise the sum is the same before and after
        add_normal(s_to, edge);
    }
    m_view.begin(coordinates(m_star[s_from]), normal);
    for (const Point& point : m_star.points())
      m_view.add(coordinates(point));
  }

  static Certified_view::Vector coordinates(const Point& point) { return {point.x(), point.y(), point.z()}; }

  const Star& m_star;
  Certified_view m_view;
  bool m_has_view = false;
  Star_shadow m_shadow;
  bool m_has_shadow = false;
  std::vector<Local> m_star_points; // all of the star's
  Certified_view::Mask m_star_mask = 0;
  std::vector<Face_slabs> m_face_slabs; // by edge of the link, made when needed
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_STAR_VIEW_H
