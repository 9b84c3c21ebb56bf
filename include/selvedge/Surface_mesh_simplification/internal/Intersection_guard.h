// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/internal/collapse_geometry.h>
#include <selvedge/geometry/Vertex_motion.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// The state that `Intersection_filter` and its visitor share: the mesh, the index of its faces, and which
/// vertices share a position. Judges one collapse; told of every collapse.
template <class TriangleMesh, class VertexPointMap, class GeomTraits, class FaceIndex>
class Intersection_guard
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Face = typename Graph_traits::face_descriptor;
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  using Id = typename FaceIndex::Id;

public:
  struct Statistics
  {
    std::size_t motions_judged = 0;
    std::size_t sweeps_tested = 0;       ///< pairs of a sweep and a stationary face, past their boxes
    std::size_t stars_clear_by_view = 0; ///< stars that one view settled
    std::size_t refused_by_link = 0;     ///< condition 0
    std::size_t refused_by_star = 0;     ///< condition 2
    std::size_t refused_by_sweep = 0;    ///< condition 1
  };

  Intersection_guard(const TriangleMesh& mesh, const VertexPointMap& points, const GeomTraits& traits,
                     FaceIndex&& empty_index)
      : m_mesh(mesh), m_points(points), m_traits(traits), m_index(std::move(empty_index)),
        m_ids(get(CGAL::dynamic_face_property_t<Id>(), mesh)),
        m_twins(get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh))
  {
    find_twins();
    m_faces.reserve(num_faces(mesh));
    std::vector<Id> ids;
    ids.reserve(num_faces(mesh));
    for (const Face face : faces(mesh)) {
      const Id id = Id(m_faces.size());
      put(m_ids, face, id);
      m_faces.push_back(face);
      ids.push_back(id);
    }
    m_index.build(ids, [this](Id id) { return face_box(m_faces[id]); });
  }

  /// Conditions 0, 1 and 2 for the collapse of the profile's edge to `placement`.
  template <class Profile>
  bool is_clear(const Profile& profile, const Point& placement)
  {
    m_blockers.clear();
    if (!is_v0_moved(profile, placement))
      return is_motion_clear({profile.v1(), profile.v0(), placement, false});
    if (!is_v1_moved(profile, placement))
      return is_motion_clear({profile.v0(), profile.v1(), placement, false});
    // Two motions of single vertices: one end goes to the place, then the other after it; in either order.
    const auto are_both_clear = [&](Vertex first, Vertex second) {
      return is_motion_clear({first, std::nullopt, placement, false}) &&
             is_motion_clear({second, first, placement, true});
    };
    return !has_twin(profile.v0()) && !has_twin(profile.v1()) &&
           (are_both_clear(profile.v1(), profile.v0()) || are_both_clear(profile.v0(), profile.v1()));
  }

  template <class Profile>
  void before_collapse(const Profile& profile, const Point& placement)
  {
    // Read before the collapse frees them.
    for (const Halfedge h : {profile.v0_v1(), profile.v1_v0()})
      if (!is_border(h, m_mesh))
        m_index.remove(get(m_ids, face(h, m_mesh)));
    m_target = is_v0_moved(profile, placement) ? profile.v1() : profile.v0();
  }

  void after_collapse(Vertex kept)
  {
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(kept, m_mesh), m_mesh))
      if (!is_border(h, m_mesh))
        m_index.set(get(m_ids, face(h, m_mesh)), face_box(face(h, m_mesh)));
    // The position of the target lives on, under whichever name CGAL keeps.
    if (const std::uint32_t twins = get(m_twins, m_target); twins != 0 && kept != m_target) {
      put(m_twins, kept, twins);
      std::replace(m_twin_classes[twins].begin(), m_twin_classes[twins].end(), m_target, kept);
    }
  }

  bool has_twin(Vertex v) const { return get(m_twins, v) != 0; }

  const std::vector<Face>& blockers() const { return m_blockers; }
  const Statistics& statistics() const { return m_statistics; }
  const FaceIndex& index() const { return m_index; }

private:
  /// A vertex goes to a place: that of a neighbour with which it merges, or one that is no vertex.
  struct Motion
  {
    Vertex mover;
    std::optional<Vertex> target; ///< the neighbour
    Point place;
    bool is_target_moved; ///< the neighbour is judged as if it stood at `place` already
  };

  /// A face that stands still, its corners as the motion sees them.
  struct Stationary_face
  {
    Face face;
    std::array<Point, 3> points;
    CGAL::Bbox_3 box;
  };

  bool is_motion_clear(const Motion& motion)
  {
    ++m_statistics.motions_judged;
    if (has_twin(motion.mover) || (motion.target && !is_link_condition_met(motion.mover, *motion.target))) {
      ++m_statistics.refused_by_link;
      return false;
    }
    gather_star(motion);
    const Star_verdict verdict = judge_star_motion(m_star, m_traits);
    m_statistics.stars_clear_by_view += verdict == Star_verdict::clear_by_view;
    if (verdict == Star_verdict::refused) {
      ++m_statistics.refused_by_star;
      return false;
    }
    if (!are_sweeps_clear(motion)) {
      ++m_statistics.refused_by_sweep;
      return false;
    }
    return true;
  }

  /// Condition 0: every position joined by an edge to both ends is the third corner of a contracted face.
  bool is_link_condition_met(Vertex mover, Vertex target) const
  {
    std::array<std::optional<Vertex>, 2> contracted;
    std::size_t contracted_count = 0;
    bool is_edge_border = false;
    bool is_mover_on_border = false;
    std::vector<Vertex>& link = m_link;
    link.clear();
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(mover, m_mesh), m_mesh)) {
      const bool is_h_border = is_border(h, m_mesh) || is_border(opposite(h, m_mesh), m_mesh);
      is_mover_on_border |= is_h_border;
      if (source(h, m_mesh) != target) {
        link.push_back(source(h, m_mesh));
        continue;
      }
      is_edge_border = is_h_border;
      for (const Halfedge side : {h, opposite(h, m_mesh)}) {
        if (is_border(side, m_mesh))
          continue;
        const Halfedge next_edge = next(side, m_mesh);
        if (is_border(opposite(next_edge, m_mesh), m_mesh) &&
            is_border(opposite(next(next_edge, m_mesh), m_mesh), m_mesh))
          return false;
        contracted[contracted_count++] = source(next(next_edge, m_mesh), m_mesh);
      }
    }
    const auto is_allowed = [&](Vertex neighbour) {
      if (std::none_of(link.begin(), link.end(), [&](Vertex v) { return is_same_position(v, neighbour); }))
        return true;
      return std::any_of(contracted.begin(), contracted.begin() + contracted_count,
                         [&](const std::optional<Vertex>& v) { return is_same_position(*v, neighbour); });
    };
    bool is_target_on_border = false;
    const auto are_neighbours_allowed = [&](Vertex at) {
      for (const Halfedge h : CGAL::halfedges_around_target(halfedge(at, m_mesh), m_mesh)) {
        is_target_on_border |= is_border(h, m_mesh);
        if (source(h, m_mesh) != mover && !is_allowed(source(h, m_mesh)))
          return false;
      }
      return true;
    };
    if (!has_twin(target)
            ? !are_neighbours_allowed(target)
            : !std::all_of(twin_class(target).begin(), twin_class(target).end(), are_neighbours_allowed))
      return false;
    return is_edge_border || !is_mover_on_border || !is_target_on_border;
  }

  void gather_star(const Motion& motion)
  {
    m_star.from = get(m_points, motion.mover);
    m_star.to = motion.place;
    m_star.moving.clear();
    m_star.contracted.clear();
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(motion.mover, m_mesh), m_mesh)) {
      if (is_border(h, m_mesh))
        continue;
      const Vertex a = target(next(h, m_mesh), m_mesh);
      const Vertex b = source(h, m_mesh);
      const bool is_contracted = motion.target && (a == *motion.target || b == *motion.target);
      (is_contracted ? m_star.contracted : m_star.moving)
          .push_back({place_of(a, motion), place_of(b, motion)});
    }
  }

  /// Condition 1: every moving face against every face that does not contain the moving vertex.
  bool are_sweeps_clear(const Motion& motion)
  {
    gather_stationary_faces(motion);
    const CGAL::Bbox_3 path = m_star.from.bbox() + m_star.to.bbox();
    for (const auto& [a, b] : m_star.moving) {
      const CGAL::Bbox_3 sweep_box = path + a.bbox() + b.bbox();
      const Sweep_test<GeomTraits> sweep(m_star.from, m_star.to, a, b, m_traits);
      for (const Stationary_face& face : m_stationary) {
        if (!CGAL::do_overlap(sweep_box, face.box))
          continue;
        ++m_statistics.sweeps_tested;
        if (!sweep.is_clear(face.points[0], face.points[1], face.points[2])) {
          m_blockers.push_back(face.face);
          return false;
        }
      }
    }
    // A place that is no neighbour's must be no position of the mesh at all, or two would become one.
    if (motion.target)
      return true;
    for (const Stationary_face& face : m_stationary)
      if (std::find(face.points.begin(), face.points.end(), motion.place) != face.points.end()) {
        m_blockers.push_back(face.face);
        return false;
      }
    return true;
  }

  void gather_stationary_faces(const Motion& motion)
  {
    m_stationary.clear();
    CGAL::Bbox_3 box = m_star.from.bbox() + m_star.to.bbox();
    for (const auto& [a, b] : m_star.moving)
      box += a.bbox() + b.bbox();
    m_index.visit_overlapping(box, [&](Id id) {
      const std::array<Vertex, 3> corners = face_corners(m_faces[id]);
      // A neighbour that is judged away from where it stands brings its faces along, below.
      if (!contains(corners, motion.mover) && !(motion.is_target_moved && contains(corners, *motion.target)))
        push_stationary(m_faces[id], corners, motion);
    });
    if (!motion.is_target_moved)
      return;
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(*motion.target, m_mesh), m_mesh))
      if (!is_border(h, m_mesh))
        if (const auto corners = face_corners(face(h, m_mesh)); !contains(corners, motion.mover))
          push_stationary(face(h, m_mesh), corners, motion);
  }

  void push_stationary(Face of_mesh, const std::array<Vertex, 3>& corners, const Motion& motion)
  {
    Stationary_face face;
    face.face = of_mesh;
    for (std::size_t i = 0; i < 3; ++i)
      face.points[i] = place_of(corners[i], motion);
    face.box = face.points[0].bbox() + face.points[1].bbox() + face.points[2].bbox();
    m_stationary.push_back(face);
  }

  Point place_of(Vertex v, const Motion& motion) const
  {
    return motion.is_target_moved && v == *motion.target ? motion.place : Point(get(m_points, v));
  }

  static bool contains(const std::array<Vertex, 3>& corners, Vertex v)
  {
    return corners[0] == v || corners[1] == v || corners[2] == v;
  }

  std::array<Vertex, 3> face_corners(Face face) const
  {
    const Halfedge h = halfedge(face, m_mesh);
    return {source(h, m_mesh), target(h, m_mesh), target(next(h, m_mesh), m_mesh)};
  }

  CGAL::Bbox_3 face_box(Face face) const
  {
    const std::array<Vertex, 3> corners = face_corners(face);
    return get(m_points, corners[0]).bbox() + get(m_points, corners[1]).bbox() +
           get(m_points, corners[2]).bbox();
  }

  void find_twins()
  {
    std::vector<Vertex> sorted;
    sorted.reserve(num_vertices(m_mesh));
    for (const Vertex v : vertices(m_mesh))
      if (halfedge(v, m_mesh) != Graph_traits::null_halfedge())
        sorted.push_back(v);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [this](Vertex a, Vertex b) { return get(m_points, a) < get(m_points, b); });
    m_twin_classes.resize(1); // class 0 is that of the vertices without twins
    for (std::size_t first = 0, beyond; first < sorted.size(); first = beyond) {
      for (beyond = first + 1; beyond < sorted.size(); ++beyond)
        if (get(m_points, sorted[beyond]) != get(m_points, sorted[first]))
          break;
      if (beyond - first == 1)
        continue;
      for (std::size_t i = first; i < beyond; ++i)
        put(m_twins, sorted[i], std::uint32_t(m_twin_classes.size()));
      m_twin_classes.emplace_back(sorted.begin() + first, sorted.begin() + beyond);
    }
    for (const auto edge : edges(m_mesh)) {
      const Halfedge h = halfedge(edge, m_mesh);
      if (get(m_points, source(h, m_mesh)) == get(m_points, target(h, m_mesh)))
        throw Argument_error("the mesh has an edge of length zero; remove its degenerate faces first");
    }
  }

  const std::vector<Vertex>& twin_class(Vertex v) const { return m_twin_classes[get(m_twins, v)]; }

  bool is_same_position(Vertex a, Vertex b) const
  {
    return a == b || (has_twin(a) && get(m_twins, a) == get(m_twins, b));
  }

  const TriangleMesh& m_mesh;
  VertexPointMap m_points;
  GeomTraits m_traits;
  FaceIndex m_index;
  typename boost::property_map<TriangleMesh, CGAL::dynamic_face_property_t<Id>>::const_type m_ids;
  std::vector<Face> m_faces;
  typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<std::uint32_t>>::const_type
      m_twins;
  std::vector<std::vector<Vertex>> m_twin_classes;
  Vertex m_target{};
  std::vector<Face> m_blockers; // of the last placement judged
  Statistics m_statistics;

  // Buffers, kept so that judging allocates nothing.
  Vertex_motion<Point> m_star;
  std::vector<Stationary_face> m_stationary;
  mutable std::vector<Vertex> m_link;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
