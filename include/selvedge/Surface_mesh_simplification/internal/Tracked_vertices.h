// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRACKED_VERTICES_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRACKED_VERTICES_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace selvedge {
namespace internal {

/// Knows for every vertex of the original a face of the present mesh that is near it, its *carrier*, and so
/// how far a collapse would leave original vertices from the surface.
///
/// The carrier of a vertex is at first the first face, in the order of `faces(mesh)`, at this vertex. A
/// collapse hands the vertices of the faces that it changes or removes to the nearest of the faces that it
/// changes; if it changes none, to those beyond the faces that it removes. A face that no collapse changes
/// keeps its vertices.
///
/// **Guarantees** When `error_at` is at most E for every collapse that is done, every original vertex is at
/// most E away from the mesh, at any time. This also holds when the same collapses are found in parts of a
/// mesh, and done to the whole.
///
/// It serves `Error_filter` as the error, and is a listener of collapses. Copies share one state.
///
/// **Preconditions** The mesh outlives this object. `before_collapse` is called before every collapse.
///
/// **Exactness** Floating point.
///
/// **Complexity** Linear in the size of the mesh to begin; for each collapse, the number of vertices that its
/// faces carry, times the number of these faces. Without `begin`, it does nothing, and all errors are 0.
///
/// **Reference** Klein, Liebich, Strasser: Mesh reduction with error control, 1996.
template <class TriangleMesh>
class Tracked_vertices
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Face = typename Graph_traits::face_descriptor;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point = Kernel::Point_3;
  using Number = std::uint32_t;

public:
  explicit Tracked_vertices(const TriangleMesh& mesh) : m_state(std::make_shared<State>(mesh)) {}

  /// Begins to track the vertices of the mesh as it is now. `diagonal` is the length of its diagonal, or
  /// another one of that order.
  template <class VertexPointMap>
  void begin(const VertexPointMap& points, double diagonal)
  {
    State& state = *m_state;
    // A power of two brings the mesh to a size at which sixth powers of lengths are numbers.
    if (diagonal > 0)
      state.scale = std::ldexp(1, -std::ilogb(diagonal));
    state.is_tracking = true;
    const auto is_tracked = get(CGAL::dynamic_vertex_property_t<unsigned char>(), state.mesh);
    for (const Vertex v : vertices(state.mesh))
      put(is_tracked, v, false);
    for (const Face face : faces(state.mesh)) {
      put(state.first_of_face, face, s_none);
      for (const Vertex v : CGAL::vertices_around_face(halfedge(face, state.mesh), state.mesh)) {
        if (get(is_tracked, v))
          continue;
        put(is_tracked, v, true);
        state.points.push_back(point(get(points, v)));
        state.next.push_back(s_none);
        give(Number(state.points.size() - 1), face);
      }
    }
  }

  /// Returns the largest distance from a vertex that the changed faces carry to its new carrier, in units of
  /// the mesh; infinity when no face is left to carry it.
  template <class Profile, class Place>
  double error_at(const Profile& profile, const Place& place) const
  {
    if (!m_state->is_tracking)
      return 0;
    find_carriers(Collapse<Profile>(profile, place));
    return std::sqrt(m_state->squared_error) / m_state->scale;
  }

  template <class Collapse>
  void before_collapse(const Collapse& collapse)
  {
    State& state = *m_state;
    if (!state.is_tracking)
      return;
    find_carriers(collapse);
    for (const Face face : state.emptied)
      put(state.first_of_face, face, s_none);
    for (const Move& move : state.moves)
      give(move.number, move.carrier);
  }

private:
  static constexpr Number s_none = std::numeric_limits<Number>::max();

  struct Candidate
  {
    Face face;
    Kernel::Triangle_3 triangle; // after the collapse
  };

  struct Move
  {
    Number number;
    Face carrier;
  };

  struct State
  {
    explicit State(const TriangleMesh& mesh_)
        : mesh(mesh_), first_of_face(get(CGAL::dynamic_face_property_t<Number>(), mesh_))
    {
    }

    const TriangleMesh& mesh;
    bool is_tracking = false;
    double scale = 1;
    std::vector<Point> points; // the vertices of the original, times the scale
    // The vertices of a face are a list: the first one of the face, and for each vertex the next one.
    std::vector<Number> next;
    typename boost::property_map<TriangleMesh, CGAL::dynamic_face_property_t<Number>>::const_type
        first_of_face;

    // What a collapse does: the faces whose vertices it hands on, the faces that can take them, and who does.
    std::vector<Face> emptied;
    std::vector<Candidate> candidates;
    std::vector<Move> moves;
    double squared_error = 0;
  };

  template <class Any_point>
  Point point(const Any_point& p) const
  {
    const double scale = m_state->scale;
    return Point(scale * CGAL::to_double(p.x()), scale * CGAL::to_double(p.y()),
                 scale * CGAL::to_double(p.z()));
  }

  void give(Number number, Face face) const
  {
    m_state->next[number] = get(m_state->first_of_face, face);
    put(m_state->first_of_face, face, number);
  }

  template <class Collapse>
  void find_carriers(const Collapse& collapse) const
  {
    State& state = *m_state;
    state.emptied.clear();
    state.candidates.clear();
    state.moves.clear();
    const auto& profile = collapse.profile();
    if (collapse.is_v0_moved())
      find_faces(collapse, profile.v0_v1(), true);
    if (collapse.is_v1_moved())
      find_faces(collapse, profile.v1_v0(), !collapse.is_v0_moved());
    if (state.candidates.empty())
      for (const Halfedge h : {profile.v0_v1(), profile.v1_v0()})
        if (!CGAL::is_border(h, state.mesh)) {
          const Halfedge of_goal = collapse.moving() == h ? next(h, state.mesh) : prev(h, state.mesh);
          const Halfedge beyond = opposite(of_goal, state.mesh);
          if (!CGAL::is_border(beyond, state.mesh))
            add_candidate(beyond, profile, get(profile.vertex_point_map(), target(beyond, state.mesh)));
        }

    state.squared_error = 0;
    for (const Face face : state.emptied)
      for (Number number = get(state.first_of_face, face); number != s_none; number = state.next[number]) {
        double least = std::numeric_limits<double>::infinity();
        Face carrier = Graph_traits::null_face();
        for (const Candidate& candidate : state.candidates)
          if (const double distance = CGAL::squared_distance(state.points[number], candidate.triangle);
              distance < least) {
            least = distance;
            carrier = candidate.face;
          }
        state.squared_error = (std::max)(state.squared_error, least);
        if (carrier != Graph_traits::null_face())
          state.moves.push_back({number, carrier});
      }
  }

  // Lists the faces at the source of `out`, which moves along it. Both ends of an edge may move; the faces at
  // the edge are listed once.
  template <class Collapse>
  void find_faces(const Collapse& collapse, Halfedge out, bool is_first) const
  {
    State& state = *m_state;
    const TriangleMesh& mesh = state.mesh;
    for (const Halfedge h : CGAL::halfedges_around_target(opposite(out, mesh), mesh)) {
      if (CGAL::is_border(h, mesh))
        continue;
      const bool is_removed = h == opposite(out, mesh) || next(h, mesh) == out;
      if (!is_removed)
        add_candidate(h, collapse.profile(), collapse.place());
      if (!is_removed || is_first)
        state.emptied.push_back(face(h, mesh));
    }
  }

  // Adds the face beside `h`, with the target of `h` at `place`.
  template <class Profile, class Place>
  void add_candidate(Halfedge h, const Profile& profile, const Place& place) const
  {
    const TriangleMesh& mesh = m_state->mesh;
    const auto points = profile.vertex_point_map();
    m_state->candidates.push_back(
        {face(h, mesh), Kernel::Triangle_3(point(place), point(get(points, target(next(h, mesh), mesh))),
                                           point(get(points, source(h, mesh))))});
  }

  std::shared_ptr<State> m_state;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRACKED_VERTICES_H
