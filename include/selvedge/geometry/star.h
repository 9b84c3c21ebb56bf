// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_STAR_H
#define SELVEDGE_GEOMETRY_STAR_H

#include <selvedge/geometry/Vertex_motion.h>
#include <selvedge/geometry/sweep.h>
#include <selvedge/internal/exact_predicates.h>

#include <CGAL/Point_3.h>
#include <CGAL/enum.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace selvedge {

/// Says whether a star keeps clear of itself, and which step of the test settled it.
enum class Star_verdict {
  clear_by_view,  ///< seen from one point, all faces keep turning the same way
  clear_by_pairs, ///< every sweep is clear of every other link edge
  refused         ///< a face degenerates on the way, or two faces meet in more than they share
};

namespace internal {

// The link edges of all faces of the star.
template <class Point>
class Link
{
public:
  explicit Link(const Vertex_motion<Point>& motion) : m_motion(motion) {}

  std::size_t size() const { return m_motion.moving.size() + m_motion.contracted.size(); }

  const std::array<Point, 2>& operator[](std::size_t i) const
  {
    const std::size_t moving = m_motion.moving.size();
    return i < moving ? m_motion.moving[i] : m_motion.contracted[i - moving];
  }

private:
  const Vertex_motion<Point>& m_motion;
};

// Whether the link is one simple cycle of positions: the walk from edge to next edge passes through all of
// them before it returns. Of two edges that start at one position, the walk only ever reaches the first, so a
// link that has such edges is never a cycle.
template <class Kernel>
bool is_cycle(const Link<typename Kernel::Point_3>& link, const Kernel& kernel)
{
  const auto is_equal = kernel.equal_3_object();
  std::size_t edge = 0;
  for (std::size_t length = 1; length <= link.size(); ++length) {
    std::size_t next = 0;
    while (next < link.size() && !is_equal(link[next][0], link[edge][1]))
      ++next;
    if (next == 0 || next == link.size())
      return next == 0 && length == link.size();
    edge = next;
  }
  return false;
}

template <class Point>
std::array<double, 3> to_double_vector(const Point& p, const Point& q)
{
  return {CGAL::to_double(q.x()) - CGAL::to_double(p.x()), CGAL::to_double(q.y()) - CGAL::to_double(p.y()),
          CGAL::to_double(q.z()) - CGAL::to_double(p.z())};
}

// Returns a point well off the surface, along the mean of the faces' normals before and after the motion. It
// is rounded, because any point will do. Returns nothing where a normal vanishes.
template <class Point>
std::optional<Point> find_viewpoint(const Vertex_motion<Point>& motion)
{
  using Vector = std::array<double, 3>;
  const auto dot = [](const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };

  Vector normal{0, 0, 0};
  double squared_size = 0;
  const auto add = [&](const Point& apex, const std::array<Point, 2>& edge) {
    const Vector u = to_double_vector(apex, edge[0]), v = to_double_vector(apex, edge[1]);
    const Vector w{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    for (std::size_t i = 0; i < 3; ++i)
      normal[i] += w[i] / std::sqrt(dot(w, w));
    squared_size = std::fmax(squared_size, dot(u, u));
  };
  for (const auto& edge : motion.moving) {
    add(motion.from, edge);
    add(motion.to, edge);
  }
  for (const auto& edge : motion.contracted)
    add(motion.from, edge);

  // Eight times the size of the star: far enough to see all of it from almost the same direction.
  const double scale = 8 * std::sqrt(squared_size / dot(normal, normal));
  const Vector q{CGAL::to_double(motion.to.x()) + scale * normal[0],
                 CGAL::to_double(motion.to.y()) + scale * normal[1],
                 CGAL::to_double(motion.to.z()) + scale * normal[2]};
  // Not finite where a normal vanishes.
  if (!std::isfinite(q[0]) || !std::isfinite(q[1]) || !std::isfinite(q[2]))
    return std::nullopt;
  return Point(q[0], q[1], q[2]);
}

// The first step. Claim: the star is clear of itself when its link is one simple cycle and, seen from a point
// q, all faces around the vertex turn the same way, both before the motion and (for the moving faces) after
// it. Why: the orientations are linear in time, so a sign that is the same at both ends is that sign all the
// way. When all faces turn the same way seen from q, each lies in a sector of its own about the line from q
// to the vertex, because a simple closed link winds about that line only once. The link is simple because the
// star is embedded at `from`, which judge_star_motion() requires.
template <class Kernel>
bool is_star_clear_by_view(const Vertex_motion<typename Kernel::Point_3>& motion, const Kernel& kernel)
{
  const Link<typename Kernel::Point_3> link(motion);
  if (!is_cycle(link, kernel))
    return false;
  const auto q = find_viewpoint(motion);
  if (!q)
    return false;

  const auto orientation = kernel.orientation_3_object();
  const CGAL::Sign turn = orientation(*q, motion.from, link[0][0], link[0][1]);
  for (std::size_t i = 1; i < link.size(); ++i) {
    if (orientation(*q, motion.from, link[i][0], link[i][1]) != turn)
      return false;
  }
  for (const auto& edge : motion.moving) {
    if (orientation(*q, motion.to, edge[0], edge[1]) != turn)
      return false;
  }
  return turn != CGAL::ZERO;
}

// Whether the face (from, a, b), which is a triangle, stays one all the way to (to, a, b).
template <class Kernel>
bool is_face_kept(const Vertex_motion<typename Kernel::Point_3>& motion,
                  const std::array<typename Kernel::Point_3, 2>& edge, const Kernel& kernel)
{
  if (kernel.orientation_3_object()(motion.from, motion.to, edge[0], edge[1]) != CGAL::ZERO)
    return true;
  const auto planar_orientation = kernel.coplanar_orientation_3_object();
  return planar_orientation(edge[0], edge[1], motion.from) == planar_orientation(edge[0], edge[1], motion.to);
}

// The second step. Claim: the star is clear of itself when no moving face degenerates and the sweep of every
// moving face is clear of the link edges of all other faces.
//
// Why link edges are enough: suppose that two faces with the common corner v meet in a point that they do not
// share. Go from v through that point until one of the two faces ends: there its link edge meets the other
// face.
//
// Why one static question covers all times: link edges of moving faces stand still. So "does this happen at
// some time?" is one static question: whether the sweep of one face is clear of the link edge of the other.
//
// Contracted faces: a contracted face is judged by the link edge that it becomes, which lies in its boundary
// all the time. The link edges of the moving faces cannot meet a contracted face, since that only shrinks
// within its first position.
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
/// A contracted face counts as a face while it is a triangle, and at the end as the edge that it has become.
/// In a mesh this is never too strict: it refuses nothing that is not refused anyway. For a moving face can
/// enter a contracted face only across the corner x opposite to the edge (from, to).
/// - If the edge (from, x) has another face, that face is in the star and is met at the same time.
/// - If not, the link condition forbids that (to, x) is a border edge, too. So (to, x) has a stationary face
///   behind it, and that face is met.
///
/// **Preconditions**: the star is embedded at `from`; in particular, its faces are not degenerate and no two
/// have the same three positions. `from` and `to` differ. `from` is not an end of a link edge. The star may
/// be open.
///
/// **Exactness**: the answer is exact for every kernel with exact predicates. It depends only on signs of
/// orientations of the given points and, in the first step, of one more point. That point is rounded, but
/// whatever point it is, what it proves is true.
///
/// **Complexity**: about two orientations per face when the first step settles it, as it does for nearly all
/// legal collapses inside a smooth surface; otherwise, as for all open stars, about two per ordered pair of
/// faces.
///
/// **Reference**: this is condition 2, "within the star", of docs/guarantees.md. It is stated for all times,
/// but an illegal contact of two faces always shows at a link edge, which makes it a static question: no time
/// of contact is ever computed.
template <class Kernel>
Star_verdict judge_star_motion(const Vertex_motion<CGAL::Point_3<Kernel>>& motion,
                               const Kernel& kernel = Kernel())
{
  internal::require_exact_predicates<Kernel>();
  if (internal::is_star_clear_by_view(motion, kernel))
    return Star_verdict::clear_by_view;
  return internal::is_star_clear_by_pairs(motion, kernel) ? Star_verdict::clear_by_pairs
                                                          : Star_verdict::refused;
}

/// Whether judge_star_motion() does not refuse the motion.
template <class Kernel>
bool is_star_motion_clear(const Vertex_motion<CGAL::Point_3<Kernel>>& motion, const Kernel& kernel = Kernel())
{
  return judge_star_motion(motion, kernel) != Star_verdict::refused;
}

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_STAR_H
