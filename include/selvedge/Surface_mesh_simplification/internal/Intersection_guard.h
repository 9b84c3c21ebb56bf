// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/Intersection_statistics.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Face_table.h>
#include <selvedge/Surface_mesh_simplification/internal/Moving_star.h>
#include <selvedge/Surface_mesh_simplification/internal/Star_view.h>
#include <selvedge/Surface_mesh_simplification/internal/Vertex_table.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>
#include <selvedge/internal/exact_predicates.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Decides whether a collapse is *clear*: no face touches or passes through another on the way. It asks its
/// questions in order, from the cheapest to the exact one.
///
/// It exists as the one state that `Intersection_filter`, its copies and its visitor share: an index of the
/// faces, the positions of the vertices, and buffers. The visitor must call it at every collapse.
///
/// A motion of one vertex is clear when it meets the three conditions of docs/guarantees.md, which has the
/// proofs (section 4 of Derichs, Misiak, Fuhrmann):
/// 0. *Link*: the link condition holds, by positions, and no other vertex shares the position of the mover.
/// 1. *Against stationary faces*: a moving face meets a stationary one only in what they share.
/// 2. *Within the star*: moving faces do not degenerate, and meet each other only in what they share.
///
/// A collapse onto one end of its edge is one motion. Any other takes two: one end moves, and then the other.
template <class TriangleMesh, class VertexPointMap, class GeomTraits, class FaceIndex>
class Intersection_guard
{
  using Vertices = Vertex_table<TriangleMesh, VertexPointMap>;
  using Faces = Face_table<TriangleMesh, Vertices, FaceIndex>;
  using Star = Moving_star<TriangleMesh, Vertices>;
  using View = Star_view<Star>;
  using Motion = typename Star::Motion;
  using Vertex = typename Vertices::Vertex;
  using Id = typename Faces::Id;

public:
  using Face = typename Faces::Face;

  Intersection_guard(const TriangleMesh& mesh, const VertexPointMap& points, const GeomTraits& traits,
                     FaceIndex&& empty_index)
      : m_mesh(mesh), m_traits(traits), m_vertices(mesh, points),
        m_faces(mesh, m_vertices, std::move(empty_index)), m_star(mesh, m_vertices), m_view(m_star)
  {
    require_exact_predicates<GeomTraits>();
  }
  Intersection_guard(const Intersection_guard&) = delete; // its parts refer to each other
  Intersection_guard& operator=(const Intersection_guard&) = delete;

  template <class Profile>
  bool is_clear(const Collapse<Profile>& collapse)
  {
    refuse_missing_visitor();
    m_is_announcement_due = are_motions_clear(collapse);
    return m_is_announcement_due;
  }

  /// Returns, for the last collapse that was clear and had a place at neither end, whether its mover went
  /// there before its goal.
  bool is_mover_first() const { return m_is_mover_first; }

  /// Called at the start and at the end of each run of a loop.
  void on_started() { m_is_run_announced = m_is_announcement_due = true; }
  void on_finished() { m_is_run_announced = false; }

  template <class Profile>
  void before_collapse(const Collapse<Profile>& collapse)
  {
    m_is_announcement_due = false;
    // Must be read before the collapse removes these faces.
    m_faces.on_removing(collapse.profile().v0_v1());
    m_faces.on_removing(collapse.profile().v1_v0());
    m_goal = collapse.goal();
    m_place = collapse.place();
  }
  void after_collapse(Vertex kept)
  {
    m_vertices.on_collapsed(m_goal, kept);
    m_faces.on_collapsed(kept);
    if (m_vertices.point(m_vertices.number(kept)) != m_place)
      throw Argument_error(
          "the vertex point map holds another point than the one put into it and judged, perhaps because it "
          "rounds; let the placement return points that the map can hold, such as an end of the edge, or use "
          "a map of doubles");
  }

  /// Returns the faces that kept motions from being clear since `forget_blockers`, one at most for each
  /// motion.
  const std::vector<Face>& blockers() const { return m_blockers; }
  void forget_blockers() { m_blockers.clear(); }
  const Intersection_statistics& statistics() const { return m_statistics; }
  const FaceIndex& index() const { return m_faces.index(); }

private:
  struct Stationary_face : View::Stationary_face
  {
    Id id;
  };

  // A loop calls its visitor before it asks a filter, so that a loop without the visitor is noticed when it
  // asks for the first time. A visitor that announces runs and not all collapses is noticed by the number of
  // faces, which is counted for the first question of a run, and after a collapse that was accepted and not
  // announced.
  void refuse_missing_visitor() const
  {
    if (!m_is_run_announced)
      throw Argument_error("the loop has not called the visitor of its intersection filter; give the loop "
                           "this visitor as well, `visitor(filter.visitor())`, or a `Visitor_chain` with it");
    if (m_is_announcement_due && current_faces(m_mesh) != m_faces.size())
      throw Argument_error("the mesh has changed without the knowledge of its intersection filter; pass all "
                           "calls of the loop on to the filter's visitor, as a `Visitor_chain` does, and "
                           "make the filter when the mesh is as the loop is to begin with");
  }

  template <class Profile>
  bool are_motions_clear(const Collapse<Profile>& collapse)
  {
    const auto& place = collapse.place();
    if (!collapse.are_both_moved())
      return is_motion_clear({collapse.mover(), collapse.goal(), place, false});
    // One end moves to the place, and then the other moves there and merges with it; in either order.
    const auto are_both_clear = [&](Vertex first, Vertex second) {
      return is_motion_clear({first, std::nullopt, place, false}) &&
             is_motion_clear({second, first, place, true});
    };
    m_is_mover_first = !are_both_clear(collapse.goal(), collapse.mover());
    return !m_is_mover_first || are_both_clear(collapse.mover(), collapse.goal());
  }

  bool is_coincident(Vertex v) const { return m_vertices.is_coincident(m_vertices.number(v)); }

  bool is_motion_clear(const Motion& motion)
  {
    ++m_statistics.motions_judged;
    if (is_coincident(motion.mover) || !m_star.gather(motion) || !m_star.is_link_condition_met(motion)) {
      ++m_statistics.refused_by_link;
      return false;
    }
    m_view.begin();
    if (m_view.is_star_clear()) {
      ++m_statistics.stars_clear_by_view;
    } else {
      const Star_verdict verdict = judge_star_motion(m_star.exact(), m_traits);
      m_statistics.stars_clear_by_view += verdict == Star_verdict::clear_by_view;
      if (verdict == Star_verdict::refused) {
        ++m_statistics.refused_by_star;
        return false;
      }
    }
    if (!are_sweeps_clear(motion)) {
      ++m_statistics.refused_by_sweep;
      return false;
    }
    return true;
  }

  bool are_sweeps_clear(const Motion& motion)
  {
    if (m_view.has_view())
      m_view.enclose_star();
    gather_faces_near(motion);
    m_stationary.clear();
    // A vertex that does not merge with a neighbour must not come to the position of any other vertex.
    std::optional<Id> face_at_place;
    for (const Id id : m_near) {
      const auto& corners = m_faces.corners(id);
      const auto a = local(corners[0]), b = local(corners[1]);
      Stationary_face face{{{a, b, local(corners[2])}}, id};
      if (!motion.target)
        for (const auto corner : face.corners)
          if (m_star[corner] == motion.place)
            face_at_place = id;
      if (!m_view.has_view() || !is_clear_of_star_in_view(face))
        m_stationary.push_back(face);
    }
    m_sweeps.clear();
    for (const Stationary_face& face : m_stationary)
      for (std::size_t j = 0; j < m_star.link().size(); ++j)
        if (!m_star.is_contracted(j) && !is_sweep_clear(j, face)) {
          m_blockers.push_back(m_faces.descriptor(face.id));
          return false;
        }
    if (face_at_place)
      m_blockers.push_back(m_faces.descriptor(*face_at_place));
    return !face_at_place;
  }

  // Finds the stationary faces that a moving face might meet.
  void gather_faces_near(const Motion& motion)
  {
    const auto mover = m_vertices.number(motion.mover);
    m_faces.find_near(m_star.box(), mover, m_near);
    if (motion.is_target_moved)
      m_faces.add_all_at(*motion.target, mover, m_near);
    for (const Id id : m_near)
      for (const auto corner : m_faces.corners(id))
        m_vertices.prefetch(corner);
    m_statistics.faces_near += m_near.size();
  }

  // Returns the number of a vertex among the star's points. A new point is added to the view as well.
  typename Star::Local local(typename Vertices::Number v)
  {
    const std::size_t points = m_star.points().size();
    const auto point = m_star.local(v);
    if (m_view.has_view() && point == points)
      m_view.add(m_star[point]);
    return point;
  }

  bool is_clear_of_star_in_view(Stationary_face& face)
  {
    const auto clear = m_view.is_clear_of_star(face);
    m_statistics.faces_clear_by_box += clear == View::Clear::by_box;
    m_statistics.faces_clear_by_view += clear == View::Clear::by_view;
    return clear != View::Clear::no;
  }

  bool is_sweep_clear(std::size_t j, const Stationary_face& face)
  {
    if (m_view.has_view() && m_view.is_sweep_clear(j, face)) {
      ++m_statistics.pairs_clear_by_view;
      return true;
    }
    const auto& link = m_star.link();
    const auto &from = m_star[Star::s_from], &to = m_star[Star::s_to];
    const auto &a = m_star[link[j][0]], &b = m_star[link[j][1]];
    const auto &p = m_star[face.corners[0]], &q = m_star[face.corners[1]], &r = m_star[face.corners[2]];
    if (!CGAL::do_overlap(from.bbox() + to.bbox() + a.bbox() + b.bbox(), p.bbox() + q.bbox() + r.bbox()))
      return true;
    ++m_statistics.sweeps_tested;
    m_sweeps.resize(link.size());
    if (!m_sweeps[j])
      m_sweeps[j].emplace(from, to, a, b, m_traits);
    return m_sweeps[j]->is_clear(p, q, r);
  }

  const TriangleMesh& m_mesh;
  GeomTraits m_traits;
  Vertices m_vertices;
  Faces m_faces;
  Star m_star;
  View m_view;
  Vertex m_goal{};                    // of the collapse that is being done
  typename Vertices::Point m_place{}; // likewise
  bool m_is_run_announced = false;    // whether a loop that calls the visitor is running
  bool m_is_announcement_due = true;  // whether the mesh may have changed unannounced
  bool m_is_mover_first = false;
  std::vector<Face> m_blockers;
  Intersection_statistics m_statistics;

  // Buffers, so that judging a motion allocates nothing.
  std::vector<Id> m_near;
  std::vector<Stationary_face> m_stationary; // those of them not yet clear of the whole star
  std::vector<std::optional<Sweep_test<GeomTraits>>> m_sweeps; // by edge of the link, made when needed
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
