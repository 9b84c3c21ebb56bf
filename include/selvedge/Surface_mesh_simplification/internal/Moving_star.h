// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MOVING_STAR_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MOVING_STAR_H

#include <selvedge/geometry/Vertex_motion.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace selvedge {
namespace internal {

/// Gathers the star of one vertex that moves, or of several at one position that move together, in points
/// that are numbered for this motion, and checks the link condition.
///
/// The numbers are short and local so that the questions that follow compare numbers, not coordinates: 0 is
/// where the vertex is, 1 where it goes, then come its link and all other points that are asked about.
/// Vertices at one position have one number. The buffers are kept from motion to motion, so that judging one
/// allocates nothing.
template <class TriangleMesh, class VertexTable>
class Moving_star
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Face = typename Graph_traits::face_descriptor;
  using Number = typename VertexTable::Number;

public:
  using Vertex = typename VertexTable::Vertex;
  using Point = typename VertexTable::Point;
  using Local = std::uint32_t; ///< the number of a point in this motion
  static constexpr Local s_from = 0, s_to = 1;

  /// The motion of a vertex to a place: the position of a neighbour with which it merges, or any other point.
  struct Motion
  {
    Vertex mover;
    std::optional<Vertex> target; ///< the neighbour, if it merges with one
    Point place;
    bool is_target_moved; ///< whether the neighbour is judged as if it stood at `place` already
    /// The other vertices at the position of the mover that move with it, each along its halfedge onto
    /// another vertex at `place`.
    const std::vector<Halfedge>* others = nullptr;

    bool is_joint() const { return others && !others->empty(); }
  };

  using Link_edge = std::array<Local, 2>; ///< counter-clockwise

  Moving_star(const TriangleMesh& mesh, VertexTable& vertices) : m_mesh(mesh), m_vertices(vertices) {}

  /// Lets every star know the faces at its link from now on.
  void keep_faces() { m_are_faces_kept = true; }

  /// Numbers the points of the star. Returns false when a face that is not contracted has a corner where the
  /// mover goes; then nothing else may be asked.
  bool gather(const Motion& motion)
  {
    m_vertices.unmark();
    m_points.clear();
    m_points.push_back(m_vertices.point(m_vertices.number(motion.mover)));
    m_points.push_back(motion.place);
    m_numbers = {m_vertices.number(motion.mover), motion.target ? m_vertices.number(*motion.target) : s_none};
    if (motion.target)
      m_vertices.mark(m_vertices.number(*motion.target), s_to);
    m_link.clear();
    m_is_contracted.clear();
    m_link_faces.clear();
    m_is_closed = true;
    m_has_target = motion.target.has_value();
    const bool is_gathered = all_of_movers(
        motion, [this](Vertex mover, const std::optional<Vertex>& goal) { return gather_at(mover, goal); });
    m_size = m_points.size();
    return is_gathered;
  }

  /// Returns whether the link condition holds: every position with an edge to both ends is the third corner
  /// of a contracted face. Besides, no contracted face has two other border edges, and the collapse joins no
  /// two stretches of a border.
  bool is_link_condition_met(const Motion& motion)
  {
    if (!motion.target)
      return true;
    const Vertex mover = motion.mover, end = *motion.target;
    m_contracted_apexes.clear();
    bool is_edge_border = false;
    const auto find_apexes = [&](Vertex from, const std::optional<Vertex>& to) {
      for (const Halfedge h : CGAL::halfedges_around_target(halfedge(from, m_mesh), m_mesh)) {
        if (source(h, m_mesh) != *to)
          continue;
        for (const Halfedge side : {h, opposite(h, m_mesh)}) {
          if (CGAL::is_border(side, m_mesh)) {
            is_edge_border = true;
            continue;
          }
          const Halfedge next_edge = next(side, m_mesh);
          if (CGAL::is_border(opposite(next_edge, m_mesh), m_mesh) &&
              CGAL::is_border(opposite(next(next_edge, m_mesh), m_mesh), m_mesh))
            return false;
          m_contracted_apexes.push_back(m_vertices.mark(m_vertices.number(target(next_edge, m_mesh))));
        }
      }
      return true;
    };
    if (!all_of_movers(motion, find_apexes))
      return false;
    const auto is_allowed = [&](Number neighbour) {
      return !m_vertices.is_marked(neighbour) || // not in the link
             std::find(m_contracted_apexes.begin(), m_contracted_apexes.end(), m_vertices.mark(neighbour)) !=
                 m_contracted_apexes.end();
    };
    bool is_end_on_border = false;
    const auto are_neighbours_allowed = [&](Vertex at) {
      for (const Halfedge h : CGAL::halfedges_around_target(halfedge(at, m_mesh), m_mesh)) {
        is_end_on_border |= CGAL::is_border(h, m_mesh);
        if (source(h, m_mesh) != mover && !is_allowed(m_vertices.number(source(h, m_mesh))))
          return false;
      }
      return true;
    };
    const Number number = m_vertices.number(end);
    if (!m_vertices.is_coincident(number)) {
      if (!are_neighbours_allowed(end))
        return false;
    } else {
      const std::vector<Vertex>& all = m_vertices.all_at(number);
      if (!std::all_of(all.begin(), all.end(), are_neighbours_allowed))
        return false;
    }
    return is_edge_border || m_is_closed || !is_end_on_border;
  }

  /// Returns the number of a vertex among the points, and adds it to them if it is new.
  Local local(Number v)
  {
    if (m_vertices.is_marked(v))
      return m_vertices.mark(v);
    const Local point = Local(m_points.size());
    m_points.push_back(m_vertices.point(v));
    m_numbers.push_back(v);
    m_vertices.mark(v, point);
    return point;
  }

  const std::vector<Point>& points() const { return m_points; }
  const Point& operator[](Local point) const { return m_points[point]; }

  /// The number in the vertex table of a vertex at each of the points, or `s_none` for a place without one.
  const std::vector<Number>& numbers() const { return m_numbers; }
  static constexpr Number s_none = (std::numeric_limits<Number>::max)();

  /// The number of points of the star itself, which come first.
  std::size_t size() const { return m_size; }
  auto own_points() const
  {
    return CGAL::make_range(m_points.begin(), m_points.begin() + std::ptrdiff_t(m_size));
  }

  /// The edges of the link, in order around the mover.
  const std::vector<Link_edge>& link() const { return m_link; }

  /// Returns whether the face at the j-th edge of the link is contracted: it has `s_to` as a corner.
  bool is_contracted(std::size_t j) const { return m_is_contracted[j]; }

  /// The face at each edge of the link, after `keep_faces`.
  const std::vector<Face>& link_faces() const { return m_link_faces; }

  bool is_closed() const { return m_is_closed; }

  /// Returns whether the link is one cycle of distinct positions.
  bool is_cycle() const { return m_is_closed && m_size + m_has_target == m_link.size() + 2; }

  /// Returns a box around the sweeps of all faces of the star.
  CGAL::Bbox_3 box() const
  {
    CGAL::Bbox_3 box;
    for (std::size_t i = 0; i < m_size; ++i)
      box += m_points[i].bbox();
    return box;
  }

  /// Returns the star as points, for `judge_star_motion`.
  const Vertex_motion<Point>& exact()
  {
    m_exact.from = m_points[s_from];
    m_exact.to = m_points[s_to];
    m_exact.moving.clear();
    m_exact.contracted.clear();
    for (std::size_t j = 0; j < m_link.size(); ++j)
      (m_is_contracted[j] ? m_exact.contracted : m_exact.moving)
          .push_back({m_points[m_link[j][0]], m_points[m_link[j][1]]});
    return m_exact;
  }

private:
  // Calls `is_fine(mover, goal)` for each vertex that moves, until a call returns false. Returns whether all
  // calls returned true.
  template <class Predicate>
  bool all_of_movers(const Motion& motion, const Predicate& is_fine) const
  {
    return is_fine(motion.mover, motion.target) &&
           (!motion.others || std::all_of(motion.others->begin(), motion.others->end(), [&](Halfedge h) {
             return is_fine(source(h, m_mesh), std::optional<Vertex>(target(h, m_mesh)));
           }));
  }

  bool gather_at(Vertex mover, const std::optional<Vertex>& goal)
  {
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(mover, m_mesh), m_mesh)) {
      if (CGAL::is_border(h, m_mesh)) {
        m_is_closed = false;
        continue;
      }
      const Vertex a = target(next(h, m_mesh), m_mesh), b = source(h, m_mesh);
      const Local first = local(m_vertices.number(a)), second = local(m_vertices.number(b));
      const bool is_contracted = goal && (a == *goal || b == *goal);
      if (!is_contracted && goal && (first == s_to || second == s_to))
        return false;
      m_link.push_back({first, second});
      m_is_contracted.push_back(is_contracted);
      if (m_are_faces_kept)
        m_link_faces.push_back(face(h, m_mesh));
    }
    return true;
  }

  const TriangleMesh& m_mesh;
  VertexTable& m_vertices;
  std::vector<Point> m_points;
  std::vector<Number> m_numbers; // by point
  std::size_t m_size = 0;
  std::vector<Link_edge> m_link;
  std::vector<char> m_is_contracted; // by edge
  std::vector<Face> m_link_faces;    // likewise, if they are kept
  bool m_are_faces_kept = false;
  std::vector<Local> m_contracted_apexes;
  bool m_is_closed = false, m_has_target = false;
  Vertex_motion<Point> m_exact;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_MOVING_STAR_H
