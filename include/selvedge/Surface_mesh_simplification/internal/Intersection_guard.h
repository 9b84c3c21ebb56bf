// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/Intersection_statistics.h>
#include <selvedge/Surface_mesh_simplification/internal/Clearance.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Exempt_pairs.h>
#include <selvedge/Surface_mesh_simplification/internal/Face_table.h>
#include <selvedge/Surface_mesh_simplification/internal/Moving_star.h>
#include <selvedge/Surface_mesh_simplification/internal/Permitted_pairs.h>
#include <selvedge/Surface_mesh_simplification/internal/Star_view.h>
#include <selvedge/Surface_mesh_simplification/internal/Vertex_table.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>
#include <selvedge/internal/exact_predicates.h>

#include <algorithm>
#include <cstddef>
#include <limits>
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
/// Coincident vertices move together, in one motion of the faces at all of them, or not at all.
///
/// Conditions 1 and 2 are not asked of exempt pairs (`Exempt_pairs`), but a collapse must not make more of
/// them offend, or shallow ones deep. A degenerate face does not move: it stays as it is until it is
/// contracted onto an end of an edge.
///
/// Condition 1 is not asked of permitted pairs (`Permitted_pairs`) either; no star has faces of two
/// parts that may intersect.
///
/// Where a clearance is asked for, a motion must also keep it from stationary faces of other pieces
/// (`Clearance_test`). It is not asked of exempt and of permitted pairs.
template <class TriangleMesh, class VertexPointMap, class GeomTraits, class FaceIndex>
class Intersection_guard
{
  using Vertices = Vertex_table<TriangleMesh, VertexPointMap>;
  using Faces = Face_table<TriangleMesh, Vertices, FaceIndex>;
  using Star = Moving_star<TriangleMesh, Vertices>;
  using View = Star_view<Star>;
  using Motion = typename Star::Motion;
  using Vertex = typename Vertices::Vertex;
  using Halfedge = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  using Id = typename Faces::Id;
  using Sweeps = typename Faces::Sweeps;

public:
  using Face = typename Faces::Face;

  Intersection_guard(const TriangleMesh& mesh, const VertexPointMap& points, const GeomTraits& traits,
                     FaceIndex&& empty_index)
      : m_mesh(mesh), m_traits(traits), m_vertices(mesh, points),
        m_faces(mesh, m_vertices, std::move(empty_index)), m_star(mesh, m_vertices), m_view(m_star),
        m_exempt(mesh, m_vertices, m_faces, m_traits, m_permitted),
        m_last_refusals(m_vertices.size(), s_nothing_known)
  {
    require_exact_predicates<GeomTraits>();
    require_default_arithmetic();
  }

  /// Exempts all pairs that descend from these, which offend at the start. A face of several triangles makes
  /// as many pairs. For `shallow` see `Intersection_filter::exempt`. Call it before the first question.
  void exempt(const std::vector<std::pair<Face, Face>>& offending,
              const std::vector<std::pair<Face, unsigned>>& multiplicities, double shallow)
  {
    m_exempt.begin(offending, multiplicities, shallow);
  }

  /// Permits pairs between two parts. Call it before the first question.
  void let_intersect(const std::vector<std::pair<std::vector<Face>, std::vector<Face>>>& parts)
  {
    m_permitted.begin(parts, m_faces);
    if (m_permitted.is_any())
      m_star.keep_faces();
  }

  /// Keeps a distance between pieces, and from the faces of an obstacle. Call it before the first question.
  void keep_clearance(double distance, const std::vector<Face>& obstacle)
  {
    m_clearance.begin(m_vertices, m_faces, distance, obstacle);
  }

  Intersection_guard(const Intersection_guard&) = delete; // its parts refer to each other
  Intersection_guard& operator=(const Intersection_guard&) = delete;

  template <class Profile>
  bool is_clear(const Collapse<Profile>& collapse)
  {
    refuse_missing_visitor();
    m_exempt.consider(collapse);
    m_is_announcement_due = may_degenerate_faces_go(collapse) && are_motions_and_pairs_fine(collapse);
    return m_is_announcement_due;
  }

  /// Returns, for the last collapse that was clear and had a place at neither end, whether its mover went
  /// there before its goal.
  bool is_mover_first() const { return m_is_mover_first; }

  /// Called at the start and at the end of each run of a loop.
  void on_started(const TriangleMesh& mesh)
  {
    require_default_arithmetic();
    if (&mesh != &m_mesh)
      throw Argument_error(
          "the loop runs on another mesh than that of its intersection filter; make the filter "
          "of the mesh that the loop changes, not of a copy");
    if (m_is_collapsing)
      throw Argument_error(
          "an exception has ended an earlier run within a collapse, of which the intersection filter was not "
          "told the end; make the filter anew");
    if (!(m_vertices.are_in_place(mesh) && m_faces.are_in_place()))
      refuse_changed_mesh();
    m_is_run_announced = m_is_announcement_due = true;
  }
  void on_finished() { m_is_run_announced = false; }

  template <class Profile>
  void before_collapse(const Collapse<Profile>& collapse)
  {
    m_is_announcement_due = false;
    m_is_collapsing = true;
    const bool is_with_another = m_others_left > 0; // then all changes of descent have been made
    m_others_left = is_with_another ? m_others_left - 1 : collapse.others().size();
    if (is_with_another)
      m_exempt.consider_done();
    else
      m_exempt.consider(collapse);
    m_exempt.before_collapse(collapse);
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
    m_exempt.after_collapse();
    if (m_vertices.point(m_vertices.number(kept)) != m_place)
      throw Argument_error(
          "the vertex point map holds another point than the one put into it and judged, perhaps because it "
          "rounds; let the placement return points that the map can hold, such as an end of the edge, or use "
          "a map of doubles");
    m_is_collapsing = m_others_left > 0;
  }

  /// Returns the faces that kept motions from being clear since `forget_blockers`: one at most for each
  /// motion, or those with which exempt pairs would offend.
  const std::vector<Face>& blockers() const { return m_blockers; }
  void forget_blockers()
  {
    m_blockers.clear();
    m_is_clearance_lacking = false;
  }

  /// Returns whether the last motion asked about since `forget_blockers` lacked nothing but clearance.
  bool is_clearance_lacking() const { return m_is_clearance_lacking; }

  const Intersection_statistics& statistics() const { return m_statistics; }
  const FaceIndex& index() const { return m_faces.index(); }

private:
  struct Stationary_face : View::Stationary_face
  {
    Id id;
    Sweeps unclear;
  };

  // What refused the last motion of a vertex: a face that a sweep met, or one of these.
  static constexpr Id s_nothing_known = Id(-1), s_more_pairs = Id(-2);
  Id& last_refusal(Vertex mover) { return m_last_refusals[m_vertices.number(mover)]; }

  // A loop calls its visitor before it asks a filter, so that a loop without the visitor is noticed when it
  // asks for the first time. A visitor that announces runs and not all collapses is noticed by the number of
  // faces, which is counted for the first question of a run, and after a collapse that was accepted and not
  // announced.
  void refuse_missing_visitor() const
  {
    if (!m_is_run_announced)
      throw Argument_error("the loop has not called the visitor of its intersection filter; give the loop "
                           "this visitor as well, `visitor(filter.visitor())`, or a `Visitor_chain` with it");
    if (m_is_announcement_due && !m_faces.are_all_in_mesh())
      refuse_changed_mesh();
  }
  [[noreturn]] static void refuse_changed_mesh()
  {
    throw Argument_error(
        "the mesh has changed without the knowledge of its intersection filter; pass all calls "
        "of the loop on to the filter's visitor, as a `Visitor_chain` does, and make the "
        "filter when the mesh is as the loop is to begin with");
  }

  template <class Profile>
  bool are_motions_clear(const Collapse<Profile>& collapse)
  {
    const auto& place = collapse.place();
    if (!collapse.are_both_moved())
      return is_motion_clear({collapse.mover(), collapse.goal(), place, false, &collapse.others()});
    // One end moves to the place, and then the other moves there and merges with it; in either order.
    const auto are_both_clear = [&](Vertex first, Vertex second) {
      return is_motion_clear({first, std::nullopt, place, false}) &&
             is_motion_clear({second, first, place, true});
    };
    m_is_mover_first = !are_both_clear(collapse.goal(), collapse.mover());
    return !m_is_mover_first || are_both_clear(collapse.mover(), collapse.goal());
  }

  template <class Profile>
  bool may_degenerate_faces_go(const Collapse<Profile>& collapse)
  {
    const bool may_go = m_exempt.may_degenerate_faces_go(collapse);
    m_statistics.refused_by_star += !may_go;
    return may_go;
  }

  // Asks both questions; the one that refused this mover last comes first.
  template <class Profile>
  bool are_motions_and_pairs_fine(const Collapse<Profile>& collapse)
  {
    if (last_refusal(collapse.mover()) == s_more_pairs)
      return are_pairs_kept(collapse) && are_motions_clear(collapse);
    return are_motions_clear(collapse) && are_pairs_kept(collapse);
  }

  template <class Profile>
  bool are_pairs_kept(const Collapse<Profile>& collapse)
  {
    if (m_exempt.are_pairs_kept(collapse, m_blockers))
      return true;
    ++m_statistics.refused_by_descent;
    last_refusal(collapse.mover()) = s_more_pairs;
    return false;
  }

  // Whether other vertices at the position of the mover do not move with it.
  bool is_held(const Motion& motion) const
  {
    const auto mover = m_vertices.number(motion.mover);
    return m_vertices.is_coincident(mover) &&
           !(motion.is_joint() && m_vertices.all_at(mover).size() == motion.others->size() + 1);
  }

  bool is_motion_clear(const Motion& motion)
  {
    ++m_statistics.motions_judged;
    m_is_clearance_lacking = false;
    if (is_held(motion) || !m_star.gather(motion) || !m_star.is_link_condition_met(motion)) {
      ++m_statistics.refused_by_link;
      return false;
    }
    if (!is_star_clear(motion)) {
      ++m_statistics.refused_by_star;
      return false;
    }
    if (!are_sweeps_clear(motion)) {
      ++m_statistics.refused_by_sweep;
      return false;
    }
    if (m_clearance.is_asked() && !is_clearance_kept(motion)) {
      ++m_statistics.refused_by_clearance;
      m_is_clearance_lacking = true;
      return false;
    }
    return true;
  }

  bool is_star_clear(const Motion& motion)
  {
    m_view.begin();
    if (m_exempt.is_exempt_inside()) {
      const auto& star = m_star.exact();
      return std::all_of(star.moving.begin(), star.moving.end(),
                         [&](const auto& edge) { return is_face_kept(star, edge, m_traits); });
    }
    if (m_exempt.has_degenerate()) {
      // What is contracted within a segment meets nothing on the way, and has no side in any view.
      Vertex_motion<typename Vertices::Point> star = m_star.exact();
      star.contracted.erase(std::remove_if(star.contracted.begin(), star.contracted.end(),
                                           [&](const auto& edge) {
                                             return m_traits.collinear_3_object()(star.from, edge[0],
                                                                                  edge[1]);
                                           }),
                            star.contracted.end());
      return is_star_motion_clear(star, m_traits);
    }
    if (motion.is_joint()) // the link is no cycle
      return is_star_motion_clear(m_star.exact(), m_traits);
    if (m_view.is_star_clear()) {
      ++m_statistics.stars_clear_by_view;
      return true;
    }
    const Star_verdict verdict = judge_star_motion(m_star.exact(), m_traits);
    m_statistics.stars_clear_by_view += verdict == Star_verdict::clear_by_view;
    return verdict != Star_verdict::refused;
  }

  bool are_sweeps_clear(const Motion& motion)
  {
    m_view.enclose_star();
    m_sweeps.clear();
    if (is_refused_by_last_blocker(motion))
      return false;
    gather_faces_near(motion);
    m_stationary.clear();
    if (m_permitted.is_any())
      m_permitted.begin_star(m_star, m_faces);
    std::optional<Id> face_of_both_parts;
    // A vertex that does not merge with a neighbour must not come to the position of any other vertex.
    std::optional<Id> face_at_place;
    for (std::size_t i = 0; i < m_near.size(); ++i) {
      const Id id = m_near[i];
      Stationary_face face = stationary_face(id, m_unclear[i]);
      if (!motion.target)
        for (const auto corner : face.corners)
          if (m_star[corner] == motion.place)
            face_at_place = lowest(face_at_place, id);
      if (m_permitted.is_any() && m_permitted.has_some(id)) {
        if (motion.target && std::count(face.corners.begin(), face.corners.end(), Star::s_to) > 0)
          face_of_both_parts = lowest(face_of_both_parts, id);
        if (m_permitted.has_all(id))
          continue;
      }
      if (m_exempt.is_exempt(id))
        continue;
      if (!m_view.has_view() || !is_clear_of_star_in_view(face))
        m_stationary.push_back(face);
    }
    if (face_of_both_parts)
      return refuse(*face_of_both_parts);
    std::sort(m_stationary.begin(), m_stationary.end(),
              [](const Stationary_face& f, const Stationary_face& g) { return f.id < g.id; });
    for (const Stationary_face& face : m_stationary)
      if (!are_sweeps_clear_of(face)) {
        last_refusal(motion.mover) = face.id;
        return refuse(face.id);
      }
    return !face_at_place || refuse(*face_at_place);
  }

  Stationary_face stationary_face(Id id, Sweeps unclear)
  {
    const auto& corners = m_faces.corners(id);
    const auto a = local(corners[0]), b = local(corners[1]);
    return {{{a, b, local(corners[2])}}, id, unclear};
  }

  // Whether the face that refused the last motion of this vertex refuses this one as well. So it mostly is,
  // and then no other need be found. (In other cases the answer may be no, and all faces are looked at.)
  bool is_refused_by_last_blocker(const Motion& motion)
  {
    const Id blocker = last_refusal(motion.mover);
    if (blocker == s_nothing_known || blocker == s_more_pairs || motion.is_joint() || m_permitted.is_any() ||
        !m_faces.is_left(blocker) || m_faces.is_at(blocker, m_vertices.number(motion.mover)) ||
        m_exempt.is_exempt(blocker))
      return false;
    Stationary_face face = stationary_face(blocker, ~Sweeps(0));
    if ((m_view.has_view() && is_clear_of_star_in_view(face)) || are_sweeps_clear_of(face))
      return false;
    refuse(blocker);
    return true;
  }

  bool are_sweeps_clear_of(const Stationary_face& face)
  {
    for (std::size_t j = 0; j < m_star.link().size(); ++j)
      if (is_unclear(j, face) && !m_star.is_contracted(j) && !m_permitted.has_at(j, face.id) &&
          !is_sweep_clear(j, face))
        return false;
    return true;
  }

  // Indices find the same faces in different orders. Of several that are in the way, the one with the lowest
  // number is named, so that every index leads to the same collapses.
  static Id lowest(std::optional<Id> known, Id found) { return known ? std::min(*known, found) : found; }

  bool refuse(Id blocker)
  {
    m_blockers.push_back(m_faces.descriptor(blocker));
    return false;
  }

  // Finds the stationary faces that a moving face might meet.
  void gather_faces_near(const Motion& motion)
  {
    const auto mover = m_vertices.number(motion.mover);
    m_faces.find_near(m_star.box(), m_star.own_points(), mover, m_near);
    if (motion.is_joint())
      for (const Halfedge h : *motion.others)
        m_faces.remove_at(m_vertices.number(source(h, m_mesh)), m_near);
    if (motion.is_target_moved) // its faces are in the table where it was
      m_faces.remove_at(m_vertices.number(*motion.target), m_near);
    const std::size_t faces_near = m_near.size();
    m_statistics.faces_near += faces_near;
    m_unclear.clear();
    // Faces at the target matter for permitted pairs even where they are clear.
    if (!m_permitted.is_any()) {
      m_faces.remove_clear(m_view.pack_filter(), m_near, m_unclear);
      m_statistics.faces_clear_in_packs += faces_near - m_near.size();
    }
    if (motion.is_target_moved)
      m_faces.add_all_at(*motion.target, mover, m_near);
    m_unclear.resize(m_near.size(), ~Sweeps(0));
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

  static bool is_unclear(std::size_t j, const Stationary_face& face)
  {
    return j >= std::numeric_limits<Sweeps>::digits || (face.unclear >> j & 1) != 0;
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

  bool is_clearance_kept(const Motion& motion)
  {
    if (!m_exempt.is_concerned() && is_star_flat())
      return true; // all that it sweeps over is the star itself
    const auto mover = m_vertices.number(motion.mover);
    m_faces.find_near(m_clearance.reach(m_star.box()), mover, m_near);
    std::sort(m_near.begin(), m_near.end());
    m_clearance.begin_motion(m_star.exact(), mover);
    for (const Id id : m_near) {
      const auto& [a, b, c] = m_faces.corners(id);
      if (m_clearance.is_own(id, a) || m_exempt.is_exempt(id) ||
          (m_permitted.is_any() && m_permitted.has_some(id)))
        continue;
      if (!m_clearance.is_kept(m_vertices.point(a), m_vertices.point(b), m_vertices.point(c)))
        return refuse(id);
    }
    return true;
  }

  // Whether the star is a polygon around the mover. By condition 2, it is the same polygon at every time of
  // the motion. On flat layers, distances are equal, which the test of clearance is slow to find out.
  bool is_star_flat() const
  {
    const auto& base = m_star.link().front(); // of a face
    return m_star.is_cycle() &&
           std::all_of(m_star.points().begin(), m_star.points().begin() + std::ptrdiff_t(m_star.size()),
                       [&](const auto& p) {
                         return m_traits.coplanar_3_object()(m_star[Star::s_from], m_star[base[0]],
                                                             m_star[base[1]], p);
                       });
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
  bool m_is_collapsing = false;       // whether a collapse has been announced, and not what it has left
  bool m_is_mover_first = false;
  std::size_t m_others_left = 0; // collapses that go along with the last one, and have not been done
  Permitted_pairs<Id> m_permitted;
  Exempt_pairs<TriangleMesh, Vertices, Faces, GeomTraits> m_exempt;
  Clearance<Vertices, GeomTraits> m_clearance;
  bool m_is_clearance_lacking = false;
  std::vector<Face> m_blockers;
  std::vector<Id> m_last_refusals; // by vertex
  Intersection_statistics m_statistics;

  // Buffers, so that judging a motion allocates nothing.
  std::vector<Id> m_near;
  std::vector<Sweeps> m_unclear;             // the sweeps that each of them may meet
  std::vector<Stationary_face> m_stationary; // those of them not yet clear of the whole star
  std::vector<std::optional<Sweep_test<GeomTraits>>> m_sweeps; // by edge of the link, made when needed
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
