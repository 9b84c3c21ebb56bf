// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_STAR_H
#define SELVEDGE_GEOMETRY_STAR_H

#include <selvedge/geometry/Vertex_motion.h>
#include <selvedge/geometry/sweep.h>

#include <CGAL/Point_3.h>
#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace selvedge {

/// What became of the question whether a star keeps clear of itself, and which step settled it.
enum class Star_verdict {
  clear_by_view,  ///< seen from one point, all faces keep turning the same way
  clear_by_pairs, ///< every sweep is clear of every other link edge
  refused         ///< a face degenerates on the way, or two faces meet in more than they share
};

namespace internal {

// Whether the link edges, taken together, are one simple cycle of positions.
template <class Kernel>
bool is_link_a_cycle(const std::vector<std::array<typename Kernel::Point_3, 2>>& edges, const Kernel& kernel)
{
  const auto is_equal = kernel.equal_3_object();
  std::size_t edge = 0;
  for (std::size_t length = 1; length <= edges.size(); ++length) {
    std::size_t next = edges.size();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (is_equal(edges[i][0], edges[edge][1])) {
        if (next != edges.size())
          return false;
        next = i;
      }
    }
    if (next == edges.size())
      return false;
    if (next == 0)
      return length == edges.size() && length > 2;
    edge = next;
  }
  return false;
}

// A point well off the surface, along the mean normal of the star before and after; rounded, for any point
// will do.
template <class Kernel>
bool find_viewpoint(const Vertex_motion<typename Kernel::Point_3>& motion,
                    typename Kernel::Point_3& viewpoint)
{
  using Point_3 = typename Kernel::Point_3;
  using Vector = std::array<double, 3>;
  const auto difference = [](const Point_3& p, const Point_3& q) -> Vector {
    return {CGAL::to_double(p.x()) - CGAL::to_double(q.x()), CGAL::to_double(p.y()) - CGAL::to_double(q.y()),
            CGAL::to_double(p.z()) - CGAL::to_double(q.z())};
  };
  const auto dot = [](const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };

  Vector normal{0, 0, 0};
  double squared_size = 0;
  const auto add = [&](const Point_3& apex, const std::array<Point_3, 2>& edge) {
    const Vector u = difference(edge[0], apex), v = difference(edge[1], apex);
    for (std::size_t i = 0; i < 3; ++i)
      normal[i] += u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    squared_size = std::fmax(squared_size, dot(u, u));
  };
  for (const auto& edge : motion.moving) {
    add(motion.from, edge);
    add(motion.to, edge);
  }
  for (const auto& edge : motion.contracted)
    add(motion.from, edge);

  const double scale = 8 * std::sqrt(squared_size / dot(normal, normal));
  const Vector q{CGAL::to_double(motion.to.x()) + scale * normal[0],
                 CGAL::to_double(motion.to.y()) + scale * normal[1],
                 CGAL::to_double(motion.to.z()) + scale * normal[2]};
  if (!std::isfinite(q[0]) || !std::isfinite(q[1]) || !std::isfinite(q[2]))
    return false;
  viewpoint = Point_3(q[0], q[1], q[2]);
  return true;
}

// The first step. When the faces around the vertex turn the same way seen from q, each lies in a wedge of its
// own about the line from q to the vertex: a simple closed link winds about that line only once. The
// orientations are linear in time, so the same sign at both ends is that sign all the way.
template <class Kernel>
bool is_star_clear_from(const typename Kernel::Point_3& q,
                        const Vertex_motion<typename Kernel::Point_3>& motion, const Kernel& kernel)
{
  const auto orientation = kernel.orientation_3_object();
  const CGAL::Sign turn = orientation(q, motion.from, motion.moving[0][0], motion.moving[0][1]);
  if (turn == CGAL::ZERO)
    return false;
  for (const auto& edge : motion.moving) {
    if (orientation(q, motion.from, edge[0], edge[1]) != turn ||
        orientation(q, motion.to, edge[0], edge[1]) != turn)
      return false;
  }
  for (const auto& edge : motion.contracted) {
    if (orientation(q, motion.from, edge[0], edge[1]) != turn)
      return false;
  }
  return true;
}

template <class Kernel>
bool is_star_clear_by_view(const Vertex_motion<typename Kernel::Point_3>& motion, const Kernel& kernel)
{
  std::vector<std::array<typename Kernel::Point_3, 2>> link = motion.moving;
  link.insert(link.end(), motion.contracted.begin(), motion.contracted.end());
  typename Kernel::Point_3 viewpoint;
  return is_link_a_cycle(link, kernel) && find_viewpoint<Kernel>(motion, viewpoint) &&
         is_star_clear_from(viewpoint, motion, kernel);
}

// Whether the face (from, a, b) stays a triangle until it is (to, a, b).
template <class Kernel>
bool is_face_kept(const Vertex_motion<typename Kernel::Point_3>& motion,
                  const std::array<typename Kernel::Point_3, 2>& edge, const Kernel& kernel)
{
  const auto orientation = kernel.orientation_3_object();
  const auto planar_orientation = kernel.coplanar_orientation_3_object();
  return orientation(motion.from, motion.to, edge[0], edge[1]) != CGAL::ZERO ||
         (planar_orientation(edge[0], edge[1], motion.from) != CGAL::ZERO &&
          planar_orientation(edge[0], edge[1], motion.from) ==
              planar_orientation(edge[0], edge[1], motion.to));
}

// The second step. When two faces with the common corner v meet in a point that they do not share, go from v
// through that point until one of the two faces ends: there its link edge meets the other face. Link edges of
// moving faces stand still, so that at some time this happens is one static question: whether the sweep of
// one is clear of the link edge of the other. A contracted face is judged by the link edge that it becomes,
// which lies in its boundary all the time; the link edges of the moving faces cannot meet a contracted face,
// which only shrinks within its first position.
template <class Kernel>
bool is_star_clear_by_pairs(const Vertex_motion<typename Kernel::Point_3>& motion, const Kernel& kernel)
{
  for (const auto& edge : motion.moving) {
    if (!is_face_kept(motion, edge, kernel))
      return false;
  }
  for (const auto& edge : motion.moving) {
    const Sweep_test<Kernel> sweep(motion.from, motion.to, edge[0], edge[1], kernel);
    for (const auto& other : motion.moving) {
      if (&other != &edge && !sweep.is_clear(other[0], other[1]))
        return false;
    }
    for (const auto& other : motion.contracted) {
      if (!sweep.is_clear(other[0], other[1]))
        return false;
    }
  }
  return true;
}

} // namespace internal

/// Judges whether the faces around a vertex keep clear of each other while it moves: no moving face
/// degenerates, and any two faces of the star meet only in the simplex of the positions that they share, at
/// every time and at the end.
///
/// A contracted face counts as long as it is a triangle, and at the end as the edge that it has become. That
/// matters where this edge is on a border: no stationary face stands there, and only this function sees a
/// moving face that passes through the contracted one. Elsewhere a stationary face contains the edge, and
/// what is refused here because of a contracted face would be refused there too.
///
/// **Preconditions**: the star is embedded at `from`, in particular its faces are not degenerate and no two
/// have the same three positions; `from` and `to` differ; `from` is no end of a link edge. The star may be
/// open.
///
/// **Exactness**: the answer is exact for every kernel with exact predicates. Signs of orientations of the
/// given points decide, and in the first step of one more point, which is rounded, but any point proves what
/// it proves.
///
/// **Complexity**: linear in the number of faces when the first step settles it, as it does for nearly all
/// motions on a smooth surface; quadratic otherwise.
template <class Kernel>
Star_verdict judge_star_motion(const Vertex_motion<CGAL::Point_3<Kernel>>& motion,
                               const Kernel& kernel = Kernel())
{
  if (motion.moving.empty() || internal::is_star_clear_by_view(motion, kernel))
    return Star_verdict::clear_by_view;
  return internal::is_star_clear_by_pairs(motion, kernel) ? Star_verdict::clear_by_pairs
                                                          : Star_verdict::refused;
}

/// Whether judge_star_motion() does not refuse.
template <class Kernel>
bool is_star_motion_clear(const Vertex_motion<CGAL::Point_3<Kernel>>& motion, const Kernel& kernel = Kernel())
{
  return judge_star_motion(motion, kernel) != Star_verdict::refused;
}

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_STAR_H
