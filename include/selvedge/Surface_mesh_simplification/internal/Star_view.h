// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_STAR_VIEW_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_STAR_VIEW_H

#include <selvedge/geometry/internal/Projected_star.h>
#include <selvedge/geometry/internal/Separation_filter.h>
#include <selvedge/geometry/internal/Star_pack_filter.h>

#include <CGAL/Kernel_traits.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <type_traits>
#include <vector>

namespace selvedge {
namespace internal {

/// Proves, in floating point with certified error bounds, that a moving star is clear of itself or of
/// stationary faces: a filter before the exact tests, which cost far more.
///
/// The *view* is a projection of the star along the sum of the normals of its faces.
///
/// **Exactness** One-sided: true is proved, false is undecided. There is no view where coordinates are not
/// doubles.
template <class Star>
class Star_view
{
  using Point = typename Star::Point;
  using Local = typename Star::Local;
  static constexpr Local s_from = Star::s_from, s_to = Star::s_to;
  // In other kernels, coordinates may be exact numbers that no double represents.
  static constexpr bool s_is_possible =
      std::is_same_v<typename CGAL::Kernel_traits<Point>::Kernel::FT, double>;

public:
  /// A stationary face, its corners numbered by the star.
  struct Stationary_face
  {
    std::array<Local, 3> corners;
    Separation_filter::Heights heights = {}; ///< which points of the star lie above and below its plane
  };

  enum class Clear { no, by_box, by_view };

  explicit Star_view(const Star& star) : m_star(star) {}

  /// Called at the start of every motion. Unless `has_view()` returns true afterwards, only `is_star_clear`
  /// may be called.
  void begin()
  {
    m_has_view = m_has_projection = false;
    if constexpr (s_is_possible) {
      m_face_slabs.clear();
      begin_view();
      m_has_view = m_view.is_usable();
    }
  }
  bool has_view() const { return m_has_view; }

  /// Called for every point that the star numbers after `begin`.
  void add(const Point& point)
  {
    if constexpr (s_is_possible)
      m_view.add(coordinates(point));
  }

  /// Returns whether the star is clear of itself, by the first step of `judge_star_motion` with a viewpoint
  /// at infinity: the link is one cycle of distinct positions, and all faces turn the same way, before and
  /// after.
  bool is_star_clear()
  {
    const auto& link = m_star.link();
    if (!m_has_view || !m_star.is_cycle() || link.size() > Projected_star::s_max_edges)
      return false;
    for (std::size_t j = 0; j < link.size(); ++j) {
      const auto& [a, b] = link[j];
      if (m_view.side(s_from, a, b) != 1 || (!m_star.is_contracted(j) && m_view.side(s_to, a, b) != 1))
        return false;
    }
    m_projection.begin(m_view, s_from, link);
    return m_has_projection = true;
  }

  /// Called before the first face is compared with the star.
  void enclose_star()
  {
    m_pack_filter.begin_without_star();
    if (!m_has_view)
      return;
    m_view.enclose();
    m_star_points.resize(m_star.size());
    std::iota(m_star_points.begin(), m_star_points.end(), Local(0));
    m_star_mask = m_view.mask(m_star_points);
    if constexpr (s_is_possible) {
      m_pack_filter.begin(m_view, coordinates(m_star[s_from]), m_star.numbers(), m_star.link());
      if (m_has_projection)
        m_pack_filter.begin_sectors();
    }
  }

  /// Proves faces clear of the whole star, many at a time, before they are asked about one by one.
  Star_pack_filter& pack_filter() { return m_pack_filter; }

  /// Says whether the face is proved clear of the whole star at all times, and how. Stores its heights.
  Clear is_clear_of_star(Stationary_face& face)
  {
    if (m_view.is_clear_of_box(face.corners))
      return Clear::by_box;
    const auto is_clear_by_plane = [&] {
      face.heights = m_view.heights(face.corners, m_star.size());
      return face.heights.is_clear(m_star_mask);
    };
    const auto is_clear_beside = [&] {
      return m_has_projection ? m_projection.is_clear(m_view, face.corners)
                              : m_view.is_clear_by_edge(face.corners, m_star_points);
    };
    // Neighbours lie beside the star, other layers above or below.
    const bool is_neighbour = (std::min)({face.corners[0], face.corners[1], face.corners[2]}) < m_star.size();
    const bool is_clear =
        is_neighbour ? is_clear_beside() || is_clear_by_plane() : is_clear_by_plane() || is_clear_beside();
    return is_clear ? Clear::by_view : Clear::no;
  }

  /// Returns whether the sweep at the j-th edge of the link is clear of a face for which `is_clear_of_star`
  /// returned `no`.
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
  // The slabs in which the sweep of a face lies: between two planes parallel to the face before its motion,
  // and between two parallel to the face after it.
  using Face_slabs = std::array<Separation_filter::Slab, 2>;

  void begin_view()
  {
    Separation_filter::Vector normal{0, 0, 0};
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

  static Separation_filter::Vector coordinates(const Point& point)
  {
    return {point.x(), point.y(), point.z()};
  }

  const Star& m_star;
  Separation_filter m_view;
  bool m_has_view = false;
  Projected_star m_projection;
  bool m_has_projection = false;
  Star_pack_filter m_pack_filter;
  std::vector<Local> m_star_points; // the numbers of all points of the star
  Separation_filter::Mask m_star_mask = 0;
  std::vector<Face_slabs> m_face_slabs; // by edge of the link, made when needed
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_STAR_VIEW_H
