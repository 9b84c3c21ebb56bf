// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRACKED_POINTS_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRACKED_POINTS_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Original_surface.h>
#include <selvedge/Surface_mesh_simplification/internal/Triangle_grid.h>
#include <selvedge/Surface_mesh_simplification/internal/Triangle_union.h>
#include <selvedge/internal/Packed_numbers.h>
#include <selvedge/internal/Vector_of_doubles.h>

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace selvedge {
namespace internal {

/// Knows for every vertex of the original, and for further points of its large faces, a face of the present
/// mesh that is near it, its *carrier*; and so how far a collapse would leave them from the surface.
///
/// The carrier of a vertex is at first the first face, in the order of `faces(mesh)`, at this vertex. A
/// collapse hands the points of the faces that it changes or removes to one of the faces that it changes: one
/// that is at most E / 8 away, or else the nearest. If it changes none, it hands them to those beyond the
/// faces that it removes. A face that no collapse changes keeps its points.
///
/// Between the points, surfaces are compared at the points of *grids*: a grid divides each side of a triangle
/// into as many parts as it takes for none to be longer than E, and into 8 at most. For an original of many
/// long sides it is less than 8, so that there are no more points of grids than 100,000, or twice as many as
/// faces.
///
/// **Guarantees** When `error_at` is at most E, as given to `begin`, for every collapse that is done, then at
/// any time
/// 1. every vertex of the original, and every point of the grids of its triangles, is at most E away from the
///    mesh,
/// 2. every point of the grid of each triangle that has changed is at most E away from the original, and so
///    is every vertex that is at a new place,
/// 3. when E is 0, or not more than rounding, the surface is the original as a set of points: each collapse
///    leaves what its faces cover together. (Between the points of grids, holes could else be closed.)
///
/// This also holds when the same collapses are found in parts of a mesh, and done to the whole.
///
/// It serves `Error_filter` as the error, and is a listener of collapses. Copies share one state.
///
/// **Preconditions** The mesh outlives this object. `before_collapse` is called before every collapse.
///
/// **Exactness** Floating point.
///
/// **Complexity** Linear in the size of the mesh to begin; for each collapse, the number of points that its
/// faces carry, times the number of these faces. At a vertex of many faces, to ask about one that is then not
/// done takes about as long as there are points, or less. What `error_at` has found is not computed again
/// when this collapse is the next one done. Without `begin`, it does nothing, and all errors are 0.
///
/// **Reference** Klein, Liebich, Strasser: Mesh reduction with error control, 1996.
template <class TriangleMesh>
class Tracked_points
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Face = typename Graph_traits::face_descriptor;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point = Kernel::Point_3;
  using Number = std::uint32_t;

public:
  explicit Tracked_points(const TriangleMesh& mesh) : m_state(std::make_shared<State>(mesh)) {}

  /// Begins to track the points of the mesh as it is now. `diagonal` is the length of its diagonal, or
  /// another one of that order. `max_error`, the length E above, is infinite if there are to be no grids.
  template <class VertexPointMap>
  void begin(const VertexPointMap& points, double diagonal,
             double max_error = std::numeric_limits<double>::infinity())
  {
    State& state = *m_state;
    // A power of two brings the mesh to a size at which sixth powers of lengths are numbers.
    if (diagonal > 0)
      state.scale = std::ldexp(1, -std::ilogb(diagonal));
    state.max_error = max_error * state.scale;
    if (std::isfinite(max_error))
      state.squared_near = s_near * s_near * state.max_error * state.max_error;
    state.is_tracking = true;
    state.original.reserve(num_faces(state.mesh), num_vertices(state.mesh));
    state.triangles = Packed_numbers(num_faces(state.mesh));
    state.reserve(num_vertices(state.mesh));
    const auto number_of = get(CGAL::dynamic_vertex_property_t<Number>(), state.mesh);
    for (const Vertex v : vertices(state.mesh))
      put(number_of, v, s_none);
    for (const Face face : faces(state.mesh)) {
      put(state.first_of_face, face, s_none);
      std::array<Number, 3> corners;
      auto corner = corners.begin();
      for (const Vertex v : CGAL::vertices_around_face(halfedge(face, state.mesh), state.mesh)) {
        if (get(number_of, v) == s_none) {
          put(number_of, v, Number(state.points.size()));
          track(point(get(points, v)), face, state.original.number_of_triangles());
        }
        *corner++ = get(number_of, v);
      }
      state.original.add(corners);
    }
    if (std::isfinite(max_error))
      track_grids();
  }

  /// Returns the largest distance from a point that the changed faces carry to its new carrier, in units of
  /// the mesh; infinity when no face is left to carry it, or a changed face would be too far from the
  /// original. When it is larger than E, or when there are many changed faces, it may be another number,
  /// which is at most E when this one is.
  template <class Profile, class Place>
  double error_at(const Profile& profile, const Place& place) const
  {
    if (!m_state->is_tracking)
      return 0;
    const Collapse<Profile> collapse(profile, place);
    State& state = *m_state;
    find_candidates(collapse);
    if (state.candidates.size() <= s_few || !std::isfinite(state.max_error)) {
      state.found.reset();
      if (find_carriers(state.max_error))
        state.found = question(collapse);
    } else {
      find_near_candidates();
      state.found.reset();
    }
    const double error = std::sqrt(state.squared_error);
    const bool is_decided = error > state.max_error;
    return is_decided || (are_changed_faces_near(collapse.are_both_moved()) && is_surface_kept(collapse))
               ? error / state.scale
               : std::numeric_limits<double>::infinity();
  }

  template <class Collapse>
  void before_collapse(const Collapse& collapse)
  {
    State& state = *m_state;
    if (!state.is_tracking)
      return;
    if (!state.found || *state.found != question(collapse)) {
      find_candidates(collapse);
      find_carriers();
    }
    state.found.reset();
    state.has_new_places |= collapse.are_both_moved();
    for (const Face face : state.emptied)
      put(state.first_of_face, face, s_none);
    for (const Move& move : state.moves)
      give(move.number, state.candidates[move.carrier].face());
  }

private:
  static constexpr Number s_none = std::numeric_limits<Number>::max();

  // Lengths that may come from rounding: the size of the mesh is about 1.
  static constexpr double s_rounding = 1e-12;

  // Of so few candidates, carriers are found at once: most collapses that are asked about are done.
  static constexpr std::size_t s_few = 32;

  // A candidate takes a point without a look at the others when its distance is at most this share of E.
  static constexpr double s_near = 0.125;

  // So many points of the original, and triangles that have them, are compared with a point one by one,
  // before an index of all is made.
  static constexpr std::size_t s_few_moves = 64;

  // A face that can take points, as it is after the collapse.
  class Candidate
  {
    using Vector = Vector_of_doubles;

  public:
    /// The first corner was at `before`, until the collapse.
    Candidate(Face face, const Point& a, const Point& b, const Point& c, const Point& before)
        : m_face(face), m_triangle(a, b, c), m_before(before)
    {
      const std::array<Vector, 3> corners = {vector(a), vector(b), vector(c)};
      std::array<Vector, 3> sides;
      double longest = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        sides[i] = difference(corners[(i + 1) % 3], corners[i]);
        longest = (std::max)(longest, dot(sides[i], sides[i]));
      }
      const Vector normal = cross(sides[0], sides[1]);
      const double length = std::sqrt(dot(normal, normal));
      m_longest = longest;
      // Of needles, rounding may turn the normal.
      m_is_bounded = length > 1e-4 * longest;
      if (!m_is_bounded)
        return;
      m_planes[3] = plane(normal, 1 / length, {0, 0, 0});
      for (std::size_t i = 0; i < 3; ++i)
        m_planes[i] = plane(cross(sides[i], normal), 1 / (length * std::sqrt(dot(sides[i], sides[i]))),
                            difference(corners[i], corners[0]));
    }

    Face face() const { return m_face; }
    std::array<Point, 3> corners() const { return {m_triangle[0], m_triangle[1], m_triangle[2]}; }
    std::array<Point, 3> corners_before() const { return {m_before, m_triangle[1], m_triangle[2]}; }

    /// The square of the length of the longest side.
    double longest() const { return m_longest; }

    /// Returns the squared distance of a point. Infinity may stand for any that is larger than `most`.
    double squared_distance(const Point& p, double most = std::numeric_limits<double>::infinity()) const
    {
      constexpr double rounding = s_rounding * s_rounding;
      if (m_is_bounded) {
        // The distance from the plane, and the largest distance beyond a side, in the plane.
        const Vector at = difference(vector(p), vector(m_triangle[0]));
        const double height = distance(m_planes[3], at);
        const double beside =
            (std::max)({0., distance(m_planes[0], at), distance(m_planes[1], at), distance(m_planes[2], at)});
        const double least = height * height + beside * beside;
        if (least > most * (1 + 1e-6) + rounding)
          return std::numeric_limits<double>::infinity();
        if (beside == 0 && least > rounding)
          return least; // nearest is the foot of the perpendicular
      }
      return CGAL::squared_distance(p, m_triangle);
    }

  private:
    // A unit normal, and what its product with a point of the plane is, relative to the first corner: far
    // from the origin, rounding would else be larger than distances.
    using Plane = std::array<double, 4>;

    static Vector vector(const Point& p) { return {p.x(), p.y(), p.z()}; }
    static Plane plane(const Vector& normal, double scale, const Vector& at)
    {
      const Vector unit = {scale * normal[0], scale * normal[1], scale * normal[2]};
      return {unit[0], unit[1], unit[2], dot(unit, at)};
    }
    static double distance(const Plane& plane, const Vector& p)
    {
      return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] - plane[3];
    }

    Face m_face;
    Kernel::Triangle_3 m_triangle;
    Point m_before;
    std::array<Plane, 4>
        m_planes; // through the sides, pointing out of the triangle, and that of the triangle
    double m_longest;
    bool m_is_bounded;
  };

  // What distinguishes one collapse from others of the same mesh.
  using Question = std::tuple<Halfedge, Halfedge, bool, bool, Point>;
  template <class Collapse>
  Question question(const Collapse& collapse) const
  {
    return {collapse.profile().v0_v1(), collapse.moving(), collapse.is_v0_moved(), collapse.is_v1_moved(),
            point(collapse.place())};
  }

  struct Move
  {
    Number number;
    Number carrier; // among the candidates
  };

  struct State
  {
    explicit State(const TriangleMesh& mesh_)
        : mesh(mesh_), first_of_face(get(CGAL::dynamic_face_property_t<Number>(), mesh_))
    {
    }

    const TriangleMesh& mesh;
    bool is_tracking = false;
    bool has_new_places = false; // of vertices: all others are of the original
    double scale = 1;
    double max_error = std::numeric_limits<double>::infinity(); // times the scale
    double squared_near = 0;   // up to which a candidate need not be the nearest one
    std::vector<Point> points; // of the original, times the scale
    Original_surface original{points};
    // The points of a face are a list: the first one of the face, and for each point the next one.
    std::vector<Number> next;
    Packed_numbers triangles; // of the original, of each point one that has it
    typename boost::property_map<TriangleMesh, CGAL::dynamic_face_property_t<Number>>::const_type
        first_of_face;

    // What a collapse does: the faces whose points it hands on, the faces that can take them, and who does.
    std::vector<Face> emptied;
    std::vector<Candidate> candidates;
    bool are_candidates_changed = false; // by this collapse
    std::vector<Move> moves;
    std::vector<Triangle_grid> grids; // of candidates
    double squared_error = 0;
    std::optional<Question> found; // the collapse that this is about, until the next one is done

    void reserve(std::size_t points_to_come)
    {
      points.reserve(points_to_come);
      next.reserve(points_to_come);
      triangles.reserve(points_to_come);
    }
  };

  template <class Any_point>
  Point point(const Any_point& p) const
  {
    const double scale = m_state->scale;
    return Point(scale * CGAL::to_double(p.x()), scale * CGAL::to_double(p.y()),
                 scale * CGAL::to_double(p.z()));
  }

  void track(const Point& p, Face face, std::size_t triangle) const
  {
    m_state->points.push_back(p);
    m_state->next.push_back(s_none);
    m_state->triangles.push_back(Number(triangle));
    give(Number(m_state->points.size() - 1), face);
  }

  // Tracks the points of the grids of all triangles, which are the faces of the mesh in their order.
  void track_grids()
  {
    State& state = *m_state;
    const auto corners = [&](std::size_t i) {
      const auto [a, b, c] = state.original.triangle(i);
      return Triangle_grid::Triangle{state.points[a], state.points[b], state.points[c]};
    };
    const std::size_t triangles = state.original.number_of_triangles();
    int most_parts = Triangle_grid::s_most_parts;
    std::size_t points = 0;
    for (; most_parts > 1; --most_parts) {
      points = 0;
      for (std::size_t i = 0; i < triangles; ++i)
        if (const int parts = Triangle_grid::parts_of(corners(i), state.max_error, most_parts); parts > 1)
          points += std::size_t(Triangle_grid::size_of(parts));
      if (points <= (std::max)(std::size_t(100'000), 2 * triangles))
        break;
    }
    if (most_parts == 1 || points == 0)
      return;
    state.reserve(state.points.size() + points);
    std::vector<unsigned char> parts; // of triangles
    const auto number_of = get(CGAL::dynamic_face_property_t<Number>(), state.mesh);
    for (const Face face : faces(state.mesh)) {
      put(number_of, face, Number(parts.size()));
      parts.push_back(static_cast<unsigned char>(
          Triangle_grid::parts_of(corners(parts.size()), state.max_error, most_parts)));
    }
    // Where the grids on both sides of an edge have the same points on it, one of them is enough.
    const auto has_side = [&](Halfedge h) {
      const Halfedge beyond = opposite(h, state.mesh);
      if (CGAL::is_border(beyond, state.mesh))
        return true;
      const Number own = get(number_of, face(h, state.mesh)),
                   other = get(number_of, face(beyond, state.mesh));
      return parts[own] != parts[other] || own < other;
    };
    for (const Face face : faces(state.mesh)) {
      const Number number = get(number_of, face);
      if (parts[number] == 1)
        continue;
      const Halfedge to_first = halfedge(face, state.mesh), to_second = next(to_first, state.mesh);
      const std::array<bool, 3> sides{has_side(to_second), has_side(next(to_second, state.mesh)),
                                      has_side(to_first)};
      Triangle_grid(corners(number), parts[number], sides).all_of([&](const Point& p) {
        track(p, face, number);
        return true;
      });
    }
  }

  // Whether the grids of the faces that `find_carriers` has found, and their common corner if it is at a new
  // place, are near enough to the original.
  bool are_changed_faces_near(bool is_new_place) const
  {
    State& state = *m_state;
    if (!std::isfinite(state.max_error))
      return true;
    const double squared = state.max_error * state.max_error * (1 + 1e-6) + s_rounding * s_rounding;
    const auto near_point = [&](const Point& p) {
      // The points that these faces carry are of the original, and so are triangles at hand. An index answers
      // sooner, once there is one.
      const std::size_t few = state.original.has_index() ? 0 : (std::min)(state.moves.size(), s_few_moves);
      for (std::size_t i = 0; i < few; ++i)
        if (const Point& of_original = state.points[state.moves[i].number];
            CGAL::squared_distance(of_original, p) <= squared)
          return std::make_optional(of_original);
      std::optional<Point> found = state.original.near_point_beside(p, squared);
      for (std::size_t i = 0; i < few && !found; ++i)
        found = state.original.near_point(p, squared, state.triangles[state.moves[i].number]);
      return found ? found : state.original.near_point(p, squared);
    };
    if (is_new_place && !state.candidates.empty() && !near_point(state.candidates.front().corners()[0]))
      return false;
    const bool are_corners_original = !is_new_place && !state.has_new_places;
    // In a grid of two parts, all points are in the middle of a side.
    const double squared_small = are_corners_original ? 4 * squared : state.max_error * state.max_error;
    state.grids.clear();
    for (std::size_t i = 0; i < state.candidates.size(); ++i) {
      if (state.candidates[i].longest() <= squared_small)
        continue;
      state.grids.resize(state.candidates.size());
      const std::array<Point, 3> corners = state.candidates[i].corners();
      const int parts = Triangle_grid::parts_of(corners, state.max_error);
      state.grids[i] = Triangle_grid(corners, parts, new_sides(i, parts));
      if (are_corners_original)
        for (const Point& corner : corners)
          state.grids[i].remove_near(corner, squared);
    }
    if (state.grids.empty())
      return true;
    for (const Move& move : state.moves)
      state.grids[move.carrier].remove_near(state.points[move.number], squared);
    if (!state.moves.empty())
      state.original.start_at(state.triangles[state.moves.front().number]);
    for (Triangle_grid& grid : state.grids) {
      const bool is_near = grid.all_of([&](const Point& p) {
        const std::optional<Point> found = near_point(p);
        if (found)
          grid.remove_near(*found, squared);
        return found.has_value();
      });
      if (!is_near)
        return false;
    }
    return true;
  }

  // Which sides of a candidate, whose grid has so many parts, have points that are not also those of the next
  // candidate, or of the face as it was.
  std::array<bool, 3> new_sides(std::size_t number, int parts) const
  {
    const std::vector<Candidate>& candidates = m_state->candidates;
    const auto has_same_parts = [&](const std::array<Point, 3>& corners) {
      return Triangle_grid::parts_of(corners, m_state->max_error) == parts;
    };
    const bool is_next_beside = number + 1 < candidates.size() &&
                                candidates[number + 1].corners()[2] == candidates[number].corners()[1];
    return {!is_next_beside || !has_same_parts(candidates[number + 1].corners()),
            !has_same_parts(candidates[number].corners_before()), true};
  }

  // Whether the faces of a collapse cover the same after it as before, if nothing else will do.
  template <class Collapse>
  bool is_surface_kept(const Collapse& collapse) const
  {
    const State& state = *m_state;
    if (state.max_error > s_rounding)
      return true;
    const Point origin = point(collapse.place());
    const auto triangle = [&](const std::array<Point, 3>& corners) {
      Triangle_union::Triangle result;
      for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          result[i][std::size_t(k)] = corners[i][k] - origin[k];
      return result;
    };
    std::vector<Triangle_union::Triangle> before, after;
    for (const Face face : state.emptied) {
      std::array<Point, 3> corners;
      auto corner = corners.begin();
      for (const Vertex v : CGAL::vertices_around_face(halfedge(face, state.mesh), state.mesh))
        *corner++ = point(get(collapse.profile().vertex_point_map(), v));
      before.push_back(triangle(corners));
    }
    for (const Candidate& candidate : state.candidates)
      after.push_back(triangle(candidate.corners()));
    const auto are_covered = [](const auto& triangles, const auto& others) {
      Triangle_union all(s_rounding);
      for (const auto& other : others)
        all.add(other);
      return std::all_of(triangles.begin(), triangles.end(),
                         [&](const auto& each) { return all.covers(each); });
    };
    return are_covered(before, after) && (!state.are_candidates_changed || are_covered(after, before));
  }

  void give(Number number, Face face) const
  {
    m_state->next[number] = get(m_state->first_of_face, face);
    put(m_state->first_of_face, face, number);
  }

  // Finds the faces whose points a collapse hands on, and those that can take them.
  template <class Collapse>
  void find_candidates(const Collapse& collapse) const
  {
    State& state = *m_state;
    state.emptied.clear();
    state.candidates.clear();
    const auto& profile = collapse.profile();
    if (collapse.is_v0_moved())
      find_faces(collapse, profile.v0_v1(), true);
    if (collapse.is_v1_moved())
      find_faces(collapse, profile.v1_v0(), !collapse.is_v0_moved());
    state.are_candidates_changed = !state.candidates.empty();
    if (!state.are_candidates_changed)
      for (const Halfedge h : {profile.v0_v1(), profile.v1_v0()})
        if (!CGAL::is_border(h, state.mesh)) {
          const Halfedge of_goal = collapse.moving() == h ? next(h, state.mesh) : prev(h, state.mesh);
          const Halfedge beyond = opposite(of_goal, state.mesh);
          if (!CGAL::is_border(beyond, state.mesh))
            add_candidate(beyond, profile, get(profile.vertex_point_map(), target(beyond, state.mesh)));
        }
  }

  // Finds for each point a candidate that takes it, until one is farther away than `most`. Returns whether
  // none was.
  bool find_carriers(double most = std::numeric_limits<double>::infinity()) const
  {
    State& state = *m_state;
    state.moves.clear();
    state.squared_error = 0;
    std::size_t likely = 0;
    for (const Face face : state.emptied) {
      likely = candidate_of(face, likely);
      for (Number number = get(state.first_of_face, face); number != s_none; number = state.next[number]) {
        const auto [carrier, squared] = carrier_of(state.points[number], likely);
        if (squared > state.squared_error) {
          state.squared_error = squared;
          if (std::sqrt(squared) > most)
            return false;
        }
        if (carrier == state.candidates.size())
          continue;
        state.moves.push_back({number, Number(carrier)});
        likely = carrier;
      }
    }
    return true;
  }

  // Finds for each point a candidate that is at most E away, until a point has none. At a vertex of many
  // faces this takes a small part of the time in which the nearest are found.
  void find_near_candidates() const
  {
    State& state = *m_state;
    const double most = state.max_error * state.max_error;
    const auto is_far = [&](double squared) { return std::sqrt(squared) > state.max_error; };
    state.moves.clear();
    state.squared_error = 0;
    std::size_t likely = 0;
    for (const Face face : state.emptied) {
      likely = candidate_of(face, likely);
      for (Number number = get(state.first_of_face, face); number != s_none; number = state.next[number]) {
        const Point& p = state.points[number];
        double squared = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < state.candidates.size() && is_far(squared); ++i) {
          squared = state.candidates[likely].squared_distance(p, most);
          if (is_far(squared))
            likely = (likely + 1) % state.candidates.size();
        }
        state.squared_error = (std::max)(state.squared_error, squared);
        if (is_far(squared))
          return;
        state.moves.push_back({number, Number(likely)});
      }
    }
  }

  // Returns the candidate that is this face itself, or else the one that was likely for the face beside it.
  std::size_t candidate_of(Face face, std::size_t likely) const
  {
    const auto& candidates = m_state->candidates;
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [&](const Candidate& candidate) { return candidate.face() == face; });
    return found == candidates.end() ? likely : std::size_t(found - candidates.begin());
  }

  // Returns a candidate that is near enough to a point to take it, or else the first of the nearest ones, and
  // its squared distance; the number of candidates and infinity when there are none. It asks the likely one
  // before the others.
  std::pair<std::size_t, double> carrier_of(const Point& p, std::size_t likely) const
  {
    const auto& candidates = m_state->candidates;
    std::pair<std::size_t, double> nearest(candidates.size(), std::numeric_limits<double>::infinity());
    const auto ask = [&](std::size_t i) {
      const double squared = candidates[i].squared_distance(p, nearest.second);
      if (squared < nearest.second ||
          (std::isfinite(squared) && squared == nearest.second && i < nearest.first))
        nearest = {i, squared};
    };
    if (likely < candidates.size())
      ask(likely);
    for (std::size_t i = 0; i < candidates.size() && nearest.second > m_state->squared_near; ++i)
      if (i != likely)
        ask(i);
    return nearest;
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
    m_state->candidates.emplace_back(
        face(h, mesh), point(place), point(get(points, target(next(h, mesh), mesh))),
        point(get(points, source(h, mesh))), point(get(points, target(h, mesh))));
  }

  std::shared_ptr<State> m_state;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_TRACKED_POINTS_H
