// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/internal/collapse_geometry.h>
#include <selvedge/geometry/Certified_view.h>
#include <selvedge/geometry/Star_shadow.h>
#include <selvedge/geometry/Vertex_motion.h>
#include <selvedge/geometry/star.h>
#include <selvedge/geometry/sweep.h>
#include <selvedge/internal/instructions.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <array>
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
    std::size_t faces_clear_by_view = 0; ///< of the others, clear of the whole star in its view
    std::size_t pairs_clear_by_view = 0; ///< of what remains, pairs of a sweep and a face clear by a plane
    std::size_t sweeps_tested = 0;       ///< pairs that took the exact test
    std::size_t refused_by_link = 0;     ///< condition 0
    std::size_t refused_by_star = 0;     ///< condition 2
    std::size_t refused_by_sweep = 0;    ///< condition 1
  };

  Intersection_guard(const TriangleMesh& mesh, const VertexPointMap& points, const GeomTraits& traits,
                     FaceIndex&& empty_index)
      : m_mesh(mesh), m_points(points), m_traits(traits), m_index(std::move(empty_index)),
        m_vertex_numbers(get(CGAL::dynamic_vertex_property_t<Number>(), mesh)),
        m_face_numbers(get(CGAL::dynamic_face_property_t<Id>(), mesh))
  {
    m_vertices.reserve(num_vertices(mesh));
    for (const Vertex v : vertices(mesh)) {
      put(m_vertex_numbers, v, Number(m_vertices.size()));
      m_vertices.push_back({get(m_points, v), 0, 0, false});
    }
    find_twins();
    m_faces.reserve(num_faces(mesh));
    m_corners.reserve(num_faces(mesh));
    std::vector<Id> ids;
    ids.reserve(num_faces(mesh));
    for (const Face face : faces(mesh)) {
      const Id id = Id(m_faces.size());
      put(m_face_numbers, face, id);
      m_faces.push_back(face);
      m_corners.push_back(face_corners(halfedge(face, mesh)));
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
      if (!CGAL::is_border(h, m_mesh))
        m_index.remove(get(m_face_numbers, face(h, m_mesh)));
    m_target = is_v0_moved(profile, placement) ? profile.v1() : profile.v0();
  }

  void after_collapse(Vertex kept)
  {
    Vertex_record& of_kept = m_vertices[number(kept)];
    of_kept.point = get(m_points, kept);
    // The position of the target lives on, under whichever name CGAL keeps.
    if (has_twin(m_target) && kept != m_target) {
      of_kept.has_twin = true;
      m_twin_class_of_vertex[number(kept)] = m_twin_class_of_vertex[number(m_target)];
      std::replace(twins(kept).begin(), twins(kept).end(), m_target, kept);
    }
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(kept, m_mesh), m_mesh))
      if (!CGAL::is_border(h, m_mesh)) {
        const Id id = get(m_face_numbers, face(h, m_mesh));
        m_corners[id] = face_corners(h);
        m_index.set(id, face_box(id));
      }
  }

  /// The faces that kept placements from being clear since `forget_blockers`.
  const std::vector<Face>& blockers() const { return m_blockers; }
  void forget_blockers() { m_blockers.clear(); }
  const Statistics& statistics() const { return m_statistics; }
  const FaceIndex& index() const { return m_index; }

private:
  // Coordinates of other kernels may be exact numbers that no double is.
  static constexpr bool s_has_view = std::is_same_v<typename GeomTraits::FT, double>;
  static constexpr Certified_view::Index s_from = 0, s_to = 1; // among the points of a motion

  using Number = std::uint32_t; // of a vertex
  using Local = Certified_view::Index;

  /// All that is asked of a vertex when a face near it is judged, in one line of a cache.
  struct alignas(32) Vertex_record
  {
    Point point;
    std::uint32_t motion = 0;   ///< the last motion that it was a point of
    std::uint32_t local : 31;   ///< which
    std::uint32_t has_twin : 1; ///< others share its position
  };

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
    Id id;
    std::array<Local, 3> corners;
    Certified_view::Heights heights; ///< of the star above its plane
  };

  /// Two planes near a sweep, those of the face that moves before and after, as directions: between which
  /// heights it lies in each.
  using Lids = std::array<Certified_view::Slab, 2>;

  bool is_motion_clear(const Motion& motion)
  {
    ++m_statistics.motions_judged;
    if (has_twin(motion.mover) || !gather_star(motion) || !is_link_condition_met(motion)) {
      ++m_statistics.refused_by_link;
      return false;
    }
    m_is_in_view = begin_view();
    m_has_shadow = m_is_in_view && is_star_clear_in_view(motion);
    if (m_has_shadow)
      m_shadow.begin(m_view, s_from, m_link);
    const Star_verdict verdict =
        m_has_shadow ? Star_verdict::clear_by_view : judge_star_motion(exact_star(), m_traits);
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

  // Numbers the points of the star: the mover, where it goes, then the link. False when a face other than the
  // contracted ones has a corner where the mover goes.
  bool gather_star(const Motion& motion)
  {
    if (++m_motion == 0) { // after four thousand million motions, old marks would count again
      for (Vertex_record& record : m_vertices)
        record.motion = 0;
      m_motion = 1;
    }
    m_local_points.clear();
    m_local_points.push_back(record(motion.mover).point);
    m_local_points.push_back(motion.place);
    if (motion.target)
      mark(number(*motion.target), s_to);
    m_link.clear();
    m_is_contracted.clear();
    m_is_star_closed = true;
    m_is_in_view = false;
    m_sweeps.clear();
    m_lids.clear();
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(motion.mover, m_mesh), m_mesh)) {
      if (CGAL::is_border(h, m_mesh)) {
        m_is_star_closed = false;
        continue;
      }
      const Vertex a = target(next(h, m_mesh), m_mesh), b = source(h, m_mesh);
      const Local first = local(number(a)), second = local(number(b));
      const bool is_contracted = motion.target && (a == *motion.target || b == *motion.target);
      if (!is_contracted && motion.target && (first == s_to || second == s_to))
        return false;
      m_link.push_back({first, second});
      m_is_contracted.push_back(is_contracted);
    }
    m_star_size = m_local_points.size();
    return true;
  }

  /// Condition 0: every position joined by an edge to both ends is the third corner of a contracted face.
  bool is_link_condition_met(const Motion& motion)
  {
    if (!motion.target)
      return true;
    const Vertex mover = motion.mover, end = *motion.target;
    std::array<Local, 2> contracted;
    std::size_t contracted_count = 0;
    bool is_edge_border = false;
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(mover, m_mesh), m_mesh)) {
      if (source(h, m_mesh) != end)
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
        contracted[contracted_count++] = local(number(target(next_edge, m_mesh)));
      }
    }
    const auto is_allowed = [&](Vertex neighbour) {
      const Vertex_record& of_neighbour = record(neighbour);
      return of_neighbour.motion != m_motion || // not in the link
             std::find(contracted.begin(), contracted.begin() + contracted_count, of_neighbour.local) !=
                 contracted.begin() + contracted_count;
    };
    bool is_end_on_border = false;
    const auto are_neighbours_allowed = [&](Vertex at) {
      for (const Halfedge h : CGAL::halfedges_around_target(halfedge(at, m_mesh), m_mesh)) {
        is_end_on_border |= CGAL::is_border(h, m_mesh);
        if (source(h, m_mesh) != mover && !is_allowed(source(h, m_mesh)))
          return false;
      }
      return true;
    };
    if (!has_twin(end) ? !are_neighbours_allowed(end)
                       : !std::all_of(twins(end).begin(), twins(end).end(), are_neighbours_allowed))
      return false;
    return is_edge_border || m_is_star_closed || !is_end_on_border;
  }

  // The number of a vertex among the points of the motion.
  Local local(Number v)
  {
    const Vertex_record& of_vertex = m_vertices[v];
    return of_vertex.motion == m_motion ? Local(of_vertex.local) : add_point(v);
  }

  Local add_point(Number v)
  {
    const Local point = Local(m_local_points.size());
    m_local_points.push_back(m_vertices[v].point);
    if constexpr (s_has_view)
      if (m_is_in_view)
        m_view.add(coordinates(m_vertices[v].point));
    mark(v, point);
    return point;
  }

  void mark(Number v, Local point)
  {
    const auto mark_one = [&](Vertex_record& record) {
      record.motion = m_motion;
      record.local = point;
    };
    if (!m_vertices[v].has_twin)
      mark_one(m_vertices[v]);
    else
      for (const Vertex twin : m_twin_classes[m_twin_class_of_vertex[v]])
        mark_one(m_vertices[number(twin)]);
  }

  // From the star, along the sum of the normals of its faces. Whether there is a view.
  bool begin_view()
  {
    if constexpr (s_has_view) {
      Certified_view::Vector normal{0, 0, 0};
      const auto add = [&](Local apex, const std::array<Local, 2>& edge) {
        const Point &o = m_local_points[apex], &a = m_local_points[edge[0]], &b = m_local_points[edge[1]];
        const double ux = a.x() - o.x(), uy = a.y() - o.y(), uz = a.z() - o.z(), vx = b.x() - o.x(),
                     vy = b.y() - o.y(), vz = b.z() - o.z();
        normal[0] += uy * vz - uz * vy;
        normal[1] += uz * vx - ux * vz;
        normal[2] += ux * vy - uy * vx;
      };
      for (const auto& edge : m_link) {
        add(s_from, edge);
        if (!m_is_star_closed) // otherwise the sum is the same before and after
          add(s_to, edge);
      }
      m_view.begin(coordinates(m_local_points[s_from]), normal);
      for (const Point& point : m_local_points)
        m_view.add(coordinates(point));
      return m_view.is_usable();
    }
    return false;
  }

  static Certified_view::Vector coordinates(const Point& point) { return {point.x(), point.y(), point.z()}; }

  // As in judge_star_motion(), seen from infinitely far away: the link is one cycle of distinct positions,
  // and all faces turn the same way, before and after.
  bool is_star_clear_in_view(const Motion& motion) const
  {
    const bool is_cycle = m_is_star_closed && m_star_size + motion.target.has_value() == m_link.size() + 2;
    if (!is_cycle || m_link.size() > Star_shadow::s_max_edges)
      return false;
    for (std::size_t j = 0; j < m_link.size(); ++j) {
      const auto& [a, b] = m_link[j];
      if (m_view.side(s_from, a, b) != 1 || (!m_is_contracted[j] && m_view.side(s_to, a, b) != 1))
        return false;
    }
    return true;
  }

  // The faces without the mover that a moving face might meet. Memory is fetched for all before any is looked
  // at.
  void gather_faces_near(const Motion& motion)
  {
    m_near.clear();
    m_index.visit_overlapping(star_box(), [this](Id id) {
      prefetch(m_corners[id]);
      m_near.push_back(id);
    });
    const auto remove_faces_at = [this](Vertex v) {
      const auto is_at = [this, v = number(v)](Id id) {
        const auto& [a, b, c] = m_corners[id];
        return a == v || b == v || c == v;
      };
      m_near.erase(std::remove_if(m_near.begin(), m_near.end(), is_at), m_near.end());
    };
    if (motion.is_target_moved) {
      // The index knows them where they stand.
      remove_faces_at(*motion.target);
      for (const Halfedge h : CGAL::halfedges_around_target(halfedge(*motion.target, m_mesh), m_mesh))
        if (!CGAL::is_border(h, m_mesh))
          m_near.push_back(get(m_face_numbers, face(h, m_mesh)));
    }
    remove_faces_at(motion.mover);
    for (const Id id : m_near)
      for (const Number corner : m_corners[id])
        prefetch(m_vertices[corner]);
    m_statistics.faces_near += m_near.size();
  }

  /// Condition 1: every moving face against every face that does not contain the moving vertex.
  bool are_sweeps_clear(const Motion& motion)
  {
    if (m_is_in_view)
      bound_star();
    gather_faces_near(motion);
    m_stationary.clear();
    // A place that is no neighbour's must be no position of the mesh at all, or two would become one.
    std::optional<Id> face_at_place;
    for (const Id id : m_near) {
      const std::array<Number, 3>& corners = m_corners[id];
      const Local a = local(corners[0]), b = local(corners[1]);
      Stationary_face face{id, {a, b, local(corners[2])}, {}};
      if (!motion.target && std::any_of(face.corners.begin(), face.corners.end(),
                                        [&](Local corner) { return m_local_points[corner] == motion.place; }))
        face_at_place = id;
      if (!m_is_in_view || !is_clear_of_star_in_view(face))
        m_stationary.push_back(face);
    }
    for (const Stationary_face& face : m_stationary)
      for (std::size_t j = 0; j < m_link.size(); ++j)
        if (!m_is_contracted[j] && !is_sweep_clear(j, face)) {
          m_blockers.push_back(m_faces[face.id]);
          return false;
        }
    if (face_at_place)
      m_blockers.push_back(m_faces[*face_at_place]);
    return !face_at_place;
  }

  CGAL::Bbox_3 star_box() const
  {
    CGAL::Bbox_3 box;
    for (std::size_t i = 0; i < m_star_size; ++i)
      box += m_local_points[i].bbox();
    return box;
  }

  void bound_star()
  {
    m_view.enclose();
    m_star_points.resize(m_star_size);
    std::iota(m_star_points.begin(), m_star_points.end(), Local(0));
    m_star_mask = m_view.mask(m_star_points);
  }

  bool is_clear_of_star_in_view(Stationary_face& face)
  {
    if (m_view.is_clear_of_box(face.corners)) {
      ++m_statistics.faces_clear_by_box;
      return true;
    }
    const auto is_clear_by_plane = [&] {
      face.heights = m_view.heights(face.corners, m_star_size);
      return face.heights.is_clear(m_star_mask);
    };
    const auto is_clear_beside = [&] {
      return m_has_shadow ? m_shadow.is_clear(m_view, face.corners)
                          : m_view.is_clear_by_edge(face.corners, m_star_points);
    };
    // Neighbours lie beside the star, other layers above or below.
    const bool is_clear = is_neighbour(face) ? is_clear_beside() || is_clear_by_plane()
                                             : is_clear_by_plane() || is_clear_beside();
    m_statistics.faces_clear_by_view += is_clear;
    return is_clear;
  }

  // Does it share a point with the star?
  bool is_neighbour(const Stationary_face& face) const
  {
    return (std::min)({face.corners[0], face.corners[1], face.corners[2]}) < m_star_size;
  }

  bool is_sweep_clear(std::size_t j, const Stationary_face& face)
  {
    const auto [a, b] = m_link[j];
    if (m_is_in_view && is_sweep_clear_in_view(j, face)) {
      ++m_statistics.pairs_clear_by_view;
      return true;
    }
    const auto box = [this](const auto&... points) { return (m_local_points[points].bbox() + ...); };
    if (!CGAL::do_overlap(box(s_from, s_to, a, b), box(face.corners[0], face.corners[1], face.corners[2])))
      return true;
    ++m_statistics.sweeps_tested;
    m_sweeps.resize(m_link.size());
    if (!m_sweeps[j])
      m_sweeps[j].emplace(m_local_points[s_from], m_local_points[s_to], m_local_points[a], m_local_points[b],
                          m_traits);
    return m_sweeps[j]->is_clear(m_local_points[face.corners[0]], m_local_points[face.corners[1]],
                                 m_local_points[face.corners[2]]);
  }

  bool is_sweep_clear_in_view(std::size_t j, const Stationary_face& face)
  {
    const auto [a, b] = m_link[j];
    const std::array<Local, 4> corners{a, b, s_from, s_to};
    if (face.heights.is_clear(m_view.mask(corners)))
      return true;
    if (m_lids.empty())
      for (const auto& [start, end] : m_link)
        m_lids.push_back({m_view.slab({start, end, s_from}, s_to), m_view.slab({start, end, s_to}, s_from)});
    return m_view.is_clear_of_slab(face.corners, m_lids[j][0]) ||
           m_view.is_clear_of_slab(face.corners, m_lids[j][1]) ||
           m_view.is_clear_by_edge_of(corners, face.corners) ||
           m_view.is_clear_by_edge(face.corners, corners);
  }

  const Vertex_motion<Point>& exact_star()
  {
    m_star.from = m_local_points[s_from];
    m_star.to = m_local_points[s_to];
    m_star.moving.clear();
    m_star.contracted.clear();
    for (std::size_t j = 0; j < m_link.size(); ++j)
      (m_is_contracted[j] ? m_star.contracted : m_star.moving)
          .push_back({m_local_points[m_link[j][0]], m_local_points[m_link[j][1]]});
    return m_star;
  }

  std::array<Number, 3> face_corners(Halfedge h) const
  {
    return {number(source(h, m_mesh)), number(target(h, m_mesh)), number(target(next(h, m_mesh), m_mesh))};
  }

  CGAL::Bbox_3 face_box(Id id) const
  {
    const auto& [a, b, c] = m_corners[id];
    return m_vertices[a].point.bbox() + m_vertices[b].point.bbox() + m_vertices[c].point.bbox();
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
    for (std::size_t first = 0, beyond; first < sorted.size(); first = beyond) {
      for (beyond = first + 1; beyond < sorted.size(); ++beyond)
        if (get(m_points, sorted[beyond]) != get(m_points, sorted[first]))
          break;
      if (beyond - first == 1)
        continue;
      for (std::size_t i = first; i < beyond; ++i)
        note_twin(sorted[i]);
      m_twin_classes.emplace_back(sorted.begin() + first, sorted.begin() + beyond);
    }
    for (const auto edge : edges(m_mesh)) {
      const Halfedge h = halfedge(edge, m_mesh);
      if (get(m_points, source(h, m_mesh)) == get(m_points, target(h, m_mesh)))
        throw Argument_error("the mesh has an edge of length zero; remove its degenerate faces first");
    }
  }

  // In the class that comes next.
  void note_twin(Vertex v)
  {
    m_twin_class_of_vertex.resize(m_vertices.size());
    m_twin_class_of_vertex[number(v)] = Number(m_twin_classes.size());
    m_vertices[number(v)].has_twin = true;
  }

  Number number(Vertex v) const { return get(m_vertex_numbers, v); }
  const Vertex_record& record(Vertex v) const { return m_vertices[number(v)]; }
  bool has_twin(Vertex v) const { return record(v).has_twin; }
  std::vector<Vertex>& twins(Vertex v) { return m_twin_classes[m_twin_class_of_vertex[number(v)]]; }

  const TriangleMesh& m_mesh;
  VertexPointMap m_points;
  GeomTraits m_traits;
  FaceIndex m_index;
  typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<Number>>::const_type
      m_vertex_numbers;
  typename boost::property_map<TriangleMesh, CGAL::dynamic_face_property_t<Id>>::const_type m_face_numbers;
  std::vector<Vertex_record> m_vertices;           // by number
  std::vector<Face> m_faces;                       // by number
  std::vector<std::array<Number, 3>> m_corners;    // by number: the mesh's own are five look-ups away
  std::vector<std::vector<Vertex>> m_twin_classes; // the vertices at one position
  std::vector<Number> m_twin_class_of_vertex;      // by number, empty without twins
  Vertex m_target{};
  std::vector<Face> m_blockers;
  Statistics m_statistics;

  // The motion that is judged now, in buffers that are kept so that judging allocates nothing.
  std::uint32_t m_motion = 0;
  std::vector<Point> m_local_points;
  std::size_t m_star_size = 0;              // so many of them are the star's
  std::vector<std::array<Local, 2>> m_link; // edges, in order around the mover
  std::vector<char> m_is_contracted;        // by edge
  bool m_is_star_closed = false;
  Certified_view m_view;
  bool m_is_in_view = false;
  Star_shadow m_shadow;
  bool m_has_shadow = false;
  std::vector<Local> m_star_points; // the first m_star_size
  Certified_view::Mask m_star_mask = 0;
  std::vector<Id> m_near;
  std::vector<Stationary_face> m_stationary; // those of them that one look at the star did not settle
  std::vector<Lids> m_lids;                  // by edge of the link, made when needed
  Vertex_motion<Point> m_star;               // made when needed
  std::vector<std::optional<Sweep_test<GeomTraits>>> m_sweeps; // made when needed
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_INTERSECTION_GUARD_H
