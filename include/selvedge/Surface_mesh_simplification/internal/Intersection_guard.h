// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/internal/collapse_geometry.h>
#include <selvedge/geometry/Certified_view.h>
#include <selvedge/geometry/Vertex_motion.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <type_traits>
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
    std::size_t stars_clear_by_view = 0; ///< stars that one view settled
    std::size_t faces_near = 0;          ///< stationary faces whose box meets that of a star
    std::size_t faces_clear_by_box = 0;  ///< of these, clear of the whole star by boxes in the star's view
    std::size_t faces_clear_by_view = 0; ///< of the others, clear of the whole star by a plane
    std::size_t pairs_clear_by_view = 0; ///< of what remains, pairs of a sweep and a face clear by a plane
    std::size_t sweeps_tested = 0;       ///< pairs that took the exact test
    std::size_t refused_by_link = 0;     ///< condition 0
    std::size_t refused_by_star = 0;     ///< condition 2
    std::size_t refused_by_sweep = 0;    ///< condition 1
  };

  Intersection_guard(const TriangleMesh& mesh, const VertexPointMap& points, const GeomTraits& traits,
                     FaceIndex&& empty_index)
      : m_mesh(mesh), m_points(points), m_traits(traits), m_index(std::move(empty_index)),
        m_ids(get(CGAL::dynamic_face_property_t<Id>(), mesh)),
        m_twins(get(CGAL::dynamic_vertex_property_t<std::uint32_t>(), mesh)),
        m_marks(get(CGAL::dynamic_vertex_property_t<Mark>(), mesh))
  {
    find_twins();
    m_faces.reserve(num_faces(mesh));
    m_corners.reserve(num_faces(mesh));
    for (const Vertex v : vertices(mesh))
      put(m_marks, v, Mark());
    std::vector<Id> ids;
    ids.reserve(num_faces(mesh));
    for (const Face face : faces(mesh)) {
      const Id id = Id(m_faces.size());
      put(m_ids, face, id);
      m_faces.push_back(face);
      m_corners.push_back(face_corners(face));
      ids.push_back(id);
    }
    m_index.build(ids, [this](Id id) { return face_box(id); });
  }

  /// Conditions 0, 1 and 2 for the collapse of the profile's edge to `placement`.
  template <class Profile>
  bool is_clear(const Profile& profile, const Point& placement)
  {
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
      if (!is_border(h, m_mesh)) {
        const Id id = get(m_ids, face(h, m_mesh));
        m_corners[id] = face_corners(face(h, m_mesh));
        m_index.set(id, face_box(id));
      }
    // The position of the target lives on, under whichever name CGAL keeps.
    if (const std::uint32_t twins = get(m_twins, m_target); twins != 0 && kept != m_target) {
      put(m_twins, kept, twins);
      std::replace(m_twin_classes[twins].begin(), m_twin_classes[twins].end(), m_target, kept);
    }
  }

  bool has_twin(Vertex v) const { return get(m_twins, v) != 0; }

  /// The faces that kept placements from being clear since `forget_blockers`.
  const std::vector<Face>& blockers() const { return m_blockers; }
  void forget_blockers() { m_blockers.clear(); }
  const Statistics& statistics() const { return m_statistics; }
  const FaceIndex& index() const { return m_index; }

private:
  // Coordinates of other kernels may be exact numbers that no double is.
  static constexpr bool s_has_view = std::is_same_v<typename GeomTraits::FT, double>;
  static constexpr Certified_view::Index s_from = 0, s_to = 1; // among the points of a motion

  /// A vertex goes to a place: that of a neighbour with which it merges, or one that is no vertex.
  struct Motion
  {
    Vertex mover;
    std::optional<Vertex> target; ///< the neighbour
    Point place;
    bool is_target_moved; ///< the neighbour is judged as if it stood at `place` already
  };

  using Local = Certified_view::Index;

  /// Which point of the motion that is judged now a vertex is, if any.
  struct Mark
  {
    std::uint32_t motion = 0; ///< the number of the motion; others' marks do not count
    Local point = 0;
  };

  /// A face that stands still, its corners as the motion sees them.
  struct Stationary_face
  {
    Id id;
    std::array<Local, 3> corners;
  };

  bool is_motion_clear(const Motion& motion)
  {
    ++m_statistics.motions_judged;
    if (has_twin(motion.mover) || (motion.target && !is_link_condition_met(motion.mover, *motion.target))) {
      ++m_statistics.refused_by_link;
      return false;
    }
    gather_star(motion);
    gather_stationary_faces(motion);
    m_is_in_view = s_has_view && m_view.close();
    const bool is_star_seen_clear = m_is_in_view && is_star_clear_in_view();
    const Star_verdict verdict =
        is_star_seen_clear ? Star_verdict::clear_by_view : judge_star_motion(m_star, m_traits);
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

  // The star, with its points numbered: the mover, where it goes, then the link.
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
      (is_contracted ? m_link_of_contracted : m_link_of_moving).push_back({a, b});
    }
    begin_view();
    if (++m_motion == 0) { // after four thousand million motions, old marks would count again
      for (const Vertex v : vertices(m_mesh))
        put(m_marks, v, Mark());
      m_motion = 1;
    }
    m_local_points.clear();
    add_point(m_star.from);
    add_point(m_star.to);
    if (motion.target)
      mark(*motion.target, s_to);
    number_link(m_link_of_moving, m_moving);
    number_link(m_link_of_contracted, m_contracted);
    m_star_points.resize(m_local_points.size());
    std::iota(m_star_points.begin(), m_star_points.end(), Local(0));
  }

  void number_link(std::vector<std::array<Vertex, 2>>& edges, std::vector<std::array<Local, 2>>& numbered)
  {
    numbered.clear();
    for (const auto& [a, b] : edges) {
      const Local first = local(a);
      numbered.push_back({first, local(b)});
    }
    edges.clear();
  }

  // The number of a vertex among the points of the motion.
  Local local(Vertex v)
  {
    const Mark known = get(m_marks, v);
    if (known.motion == m_motion)
      return known.point;
    const Local point = add_point(get(m_points, v));
    mark(v, point);
    return point;
  }

  void mark(Vertex v, Local point)
  {
    if (!has_twin(v))
      put(m_marks, v, Mark{m_motion, point});
    else
      for (const Vertex twin : twin_class(v))
        put(m_marks, twin, Mark{m_motion, point});
  }

  Local add_point(const Point& point)
  {
    m_local_points.push_back(point);
    if constexpr (s_has_view)
      m_view.add({point.x(), point.y(), point.z()});
    return Local(m_local_points.size() - 1);
  }

  // Along the sum of the normals of the faces, before and after.
  void begin_view()
  {
    if constexpr (s_has_view) {
      std::array<double, 3> normal{0, 0, 0};
      const auto add = [&](const Point& apex, const std::array<Point, 2>& edge) {
        const double ux = edge[0].x() - apex.x(), uy = edge[0].y() - apex.y(), uz = edge[0].z() - apex.z(),
                     vx = edge[1].x() - apex.x(), vy = edge[1].y() - apex.y(), vz = edge[1].z() - apex.z();
        normal[0] += uy * vz - uz * vy;
        normal[1] += uz * vx - ux * vz;
        normal[2] += ux * vy - uy * vx;
      };
      for (const auto& edge : m_star.moving) {
        add(m_star.from, edge);
        add(m_star.to, edge);
      }
      for (const auto& edge : m_star.contracted)
        add(m_star.from, edge);
      m_view.begin({m_star.from.x(), m_star.from.y(), m_star.from.z()}, normal);
    }
  }

  // As in judge_star_motion(), seen from infinitely far away: the link is one cycle of distinct positions,
  // and all faces turn the same way, before and after.
  bool is_star_clear_in_view() const
  {
    if (m_star_points.size() > 64)
      return false;
    std::bitset<64> starts, ends;
    for (const auto* edges : {&m_moving, &m_contracted})
      for (const auto& [a, b] : *edges) {
        if (starts[a] || ends[b] || m_view.side(s_from, a, b) != 1)
          return false;
        starts.set(a);
        ends.set(b);
      }
    // Every position has one edge that leaves it and one that arrives: cycles; and one of them, since around
    // a vertex the faces follow upon each other.
    return starts == ends && std::all_of(m_moving.begin(), m_moving.end(), [this](const auto& edge) {
             return m_view.side(s_to, edge[0], edge[1]) == 1;
           });
  }

  /// Condition 1: every moving face against every face that does not contain the moving vertex.
  bool are_sweeps_clear(const Motion& motion)
  {
    m_sweeps.assign(m_moving.size(), std::nullopt);
    m_statistics.faces_near += m_stationary.size();
    if (m_is_in_view)
      bound_star();
    for (const Stationary_face& face : m_stationary) {
      if (m_is_in_view && is_clear_of_star_in_view(face))
        continue;
      for (std::size_t j = 0; j < m_moving.size(); ++j)
        if (!is_sweep_clear(j, face)) {
          m_blockers.push_back(m_faces[face.id]);
          return false;
        }
    }
    if (motion.target)
      return true;
    // A place that is no neighbour's must be no position of the mesh at all, or two would become one.
    for (const Stationary_face& face : m_stationary)
      for (const Local corner : face.corners)
        if (m_local_points[corner] == motion.place) {
          m_blockers.push_back(m_faces[face.id]);
          return false;
        }
    return true;
  }

  void bound_star()
  {
    m_star_lower = m_star_upper = m_view[s_from];
    for (const Local p : m_star_points)
      for (std::size_t i = 0; i < 3; ++i) {
        m_star_lower[i] = (std::min)(m_star_lower[i], m_view[p][i]);
        m_star_upper[i] = (std::max)(m_star_upper[i], m_view[p][i]);
      }
  }

  bool is_clear_of_star_in_view(const Stationary_face& face)
  {
    const auto &a = m_view[face.corners[0]], &b = m_view[face.corners[1]], &c = m_view[face.corners[2]];
    for (std::size_t i = 3; i-- > 0;)
      if ((std::min)({a[i], b[i], c[i]}) > m_star_upper[i] + m_view.length_error() ||
          (std::max)({a[i], b[i], c[i]}) < m_star_lower[i] - m_view.length_error()) {
        ++m_statistics.faces_clear_by_box;
        return true;
      }
    // Neighbours lie beside the star, other layers above or below.
    const bool is_clear = is_neighbour(face) ? m_view.is_clear_by_edge(face.corners, m_star_points) ||
                                                   m_view.is_clear_by_plane(face.corners, m_star_points)
                                             : m_view.is_clear_by_plane(face.corners, m_star_points) ||
                                                   m_view.is_clear_by_edge(face.corners, m_star_points);
    m_statistics.faces_clear_by_view += is_clear;
    return is_clear;
  }

  // Does it share a point with the star?
  bool is_neighbour(const Stationary_face& face) const
  {
    return (std::min)({face.corners[0], face.corners[1], face.corners[2]}) < m_star_points.size();
  }

  bool is_sweep_clear(std::size_t j, const Stationary_face& face)
  {
    const auto [a, b] = m_moving[j];
    if (m_is_in_view) {
      const std::array<Local, 4> corners{a, b, s_from, s_to};
      const auto is_clear_by_edge = [&] {
        return m_view.is_clear_by_edge_of(corners, face.corners) ||
               m_view.is_clear_by_edge(face.corners, corners);
      };
      if (is_neighbour(face) ? is_clear_by_edge() || m_view.is_clear_by_plane(face.corners, corners)
                             : m_view.is_clear_by_plane(face.corners, corners) || is_clear_by_edge()) {
        ++m_statistics.pairs_clear_by_view;
        return true;
      }
    }
    const auto box = [this](const auto&... points) { return (m_local_points[points].bbox() + ...); };
    if (!CGAL::do_overlap(box(s_from, s_to, a, b), box(face.corners[0], face.corners[1], face.corners[2])))
      return true;
    ++m_statistics.sweeps_tested;
    if (!m_sweeps[j])
      m_sweeps[j].emplace(m_star.from, m_star.to, m_local_points[a], m_local_points[b], m_traits);
    return m_sweeps[j]->is_clear(m_local_points[face.corners[0]], m_local_points[face.corners[1]],
                                 m_local_points[face.corners[2]]);
  }

  void gather_stationary_faces(const Motion& motion)
  {
    m_stationary.clear();
    CGAL::Bbox_3 box = m_star.from.bbox() + m_star.to.bbox();
    for (const auto& [a, b] : m_star.moving)
      box += a.bbox() + b.bbox();
    m_index.visit_overlapping(box, [&](Id id) {
      // A neighbour that is judged away from where it stands brings its faces along, below.
      if (!contains(m_corners[id], motion.mover) &&
          !(motion.is_target_moved && contains(m_corners[id], *motion.target)))
        push_stationary(id);
    });
    if (!motion.is_target_moved)
      return;
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(*motion.target, m_mesh), m_mesh))
      if (!is_border(h, m_mesh))
        if (const Id id = get(m_ids, face(h, m_mesh)); !contains(m_corners[id], motion.mover))
          push_stationary(id);
  }

  void push_stationary(Id id)
  {
    const std::array<Vertex, 3>& corners = m_corners[id];
    const Local first = local(corners[0]), second = local(corners[1]);
    m_stationary.push_back({id, {first, second, local(corners[2])}});
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

  CGAL::Bbox_3 face_box(Id id) const
  {
    const auto& [a, b, c] = m_corners[id];
    return get(m_points, a).bbox() + get(m_points, b).bbox() + get(m_points, c).bbox();
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
  std::vector<Face> m_faces;                    // by number
  std::vector<std::array<Vertex, 3>> m_corners; // by number: the mesh's own are five look-ups away
  typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<std::uint32_t>>::const_type
      m_twins;
  std::vector<std::vector<Vertex>> m_twin_classes;
  Vertex m_target{};
  std::vector<Face> m_blockers;
  Statistics m_statistics;

  // The motion that is judged now, in buffers that are kept so that judging allocates nothing.
  typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<Mark>>::const_type m_marks;
  std::uint32_t m_motion = 0;
  Vertex_motion<Point> m_star;
  std::vector<Point> m_local_points;
  std::vector<Local> m_star_points; // the first of them
  std::vector<std::array<Local, 2>> m_moving, m_contracted;
  std::vector<std::array<Vertex, 2>> m_link_of_moving, m_link_of_contracted;
  std::vector<Stationary_face> m_stationary;
  std::vector<std::optional<Sweep_test<GeomTraits>>> m_sweeps; // made when needed
  Certified_view m_view;
  bool m_is_in_view = false;
  Certified_view::Vector m_star_lower{}, m_star_upper{};
  mutable std::vector<Vertex> m_link;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
