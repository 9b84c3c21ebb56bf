// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/Quadric_cost_options.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Symmetric_quadric.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/Surface_mesh_simplification/internal/mesh_diagonal.h>
#include <selvedge/Surface_mesh_simplification/internal/relative_face_weight.h>
#include <selvedge/internal/instructions.h>
#include <selvedge/internal/saturated_float.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace selvedge {

/// Says of every edge that it is not a line: the default, with which only borders are kept as lines.
struct No_line_map
{
  template <class Edge>
  friend bool get(const No_line_map&, const Edge&)
  {
    return false;
  }
};

/// Computes the cost of a collapse from two quadrics at each vertex: one of the mesh as it is, and one that
/// has accumulated since the original. Each sums the squared distances to the planes of the faces, to planes
/// that stand on border edges and on edges over which the surface folds, and, with a small weight, to the
/// vertices. The cost is how much the collapse *adds* to both, each taken at its vertex: what has been lost
/// before is no reason to keep a vertex.
///
/// The quadrics of the mesh as it is decide most of it. They say how far the next surface is from the last,
/// whereas planes of the original say less the farther apart their faces lie: with them alone, the error of
/// garments at 10 % of the faces is 27 to 41 % larger (scans: 15 to 30 %). `Quadric_cost_options::memory` is
/// the share of what has accumulated; a little of it keeps small errors from adding up in one direction.
///
/// The plane of a face of area A has the weight (A / D²)^¼, where D is the diagonal. An exponent of 1 would
/// give every patch of the surface the same error, and 0 every vertex. A mesh is dense where it has detail,
/// so ¼ keeps hands and faces, and still evens out what an artist or a scanner happened to divide.
///
/// A model of CGAL's concept `GetCost`, usable with any placement. The quadrics belong to the mesh that the
/// policy was made for. Copies share them, and a second run on the same mesh continues with what the first
/// has accumulated.
///
/// **Preconditions** The mesh outlives the policy. `EdgeIsLineMap` is a readable property map from edges to
/// `bool`: true for the edges inside the mesh that the cost is to keep as it keeps borders.
/// Once the quadrics are computed, no edge becomes a line unless it takes the place of one in a collapse.
///
/// **Exactness** Floating point. The cost orders the collapses, and its error can limit their quality; no
/// statement about intersections depends on it. Coordinates are taken relative to a vertex or to the centre
/// of the mesh, so that a mesh far from the origin loses no precision. Normals of faces and quadrics are kept
/// in single precision: relative to the vertex, through which the planes of its faces pass, or to a place
/// near it, what is rounded changes a cost by far less than the weight of the vertices does. A vertex takes
/// 92 bytes, 32 more when a place is asked for, and a face 12.
///
/// **Complexity** Linear in the size of the mesh to initialise; constant for a cost or an error; the number
/// of faces at the neighbours of the merged vertex for an update.
///
/// **Reference** Garland, Heckbert: Surface simplification using quadric error metrics, sections 3 to 6;
/// Lindstrom, Turk: Fast and memory efficient polygonal simplification, sections 3 and 4; Derichs, Misiak,
/// Fuhrmann, section 3.
template <class TriangleMesh, class EdgeIsLineMap = No_line_map>
class Quadric_cost
{
  using Matrix = internal::Symmetric_matrix;
  using Quadric = internal::Symmetric_quadric;
  using Vector = internal::Vector_of_doubles;
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Edge = typename Graph_traits::edge_descriptor;

  // The faces around a vertex: the sum of their normals, each as long as twice its area, unless the vertex is
  // on a border. It is computed when it is asked for, and forgotten when one of the faces changes.
  struct Enclosure
  {
    Vector normals{0, 0, 0};
    bool is_known = false;
    bool is_closed = true;

    void add(const Vector& normal)
    {
      for (std::size_t i = 0; i < 3; ++i)
        normals[i] += normal[i];
    }
  };

  // A vector as it is kept, in the unit of the state.
  using Float_vector = std::array<float, 3>;
  static Float_vector floats(const Vector& v, double unit)
  {
    return {internal::saturated_float(v[0] / unit), internal::saturated_float(v[1] / unit),
            internal::saturated_float(v[2] / unit)};
  }
  static Vector doubles(const Float_vector& v, double unit)
  {
    return {unit * v[0], unit * v[1], unit * v[2]};
  }

  // How much the quadrics of a vertex grow with its motion d: dᵀ M d + 2u l · d, where u is the unit of the
  // state. (The planes of the mesh as it is pass through the vertex, so that l is of the others alone.)
  struct Growth
  {
    internal::Float_symmetric_matrix matrix;
    Float_vector linear{0, 0, 0};
    bool has_lines = false; // whether a border or another line meets the vertex, or may have met it

    double operator()(const Vector& motion, double unit) const
    {
      return Matrix(matrix).square(motion) + 2 * unit * internal::dot(linear, motion);
    }
    Quadric quadric(double unit) const { return {matrix, doubles(linear, unit), 0}; }
  };
  // The sum of the quadrics that a vertex has accumulated, relative to a place near it, which never changes.
  // Lengths are in the unit of the state.
  struct Accumulated
  {
    internal::Float_symmetric_matrix matrix;
    Float_vector linear{0, 0, 0};
    float constant = 0;
    Float_vector place{0, 0, 0}; // relative to the origin

    Vector from_place(const Vector& point, double unit) const
    {
      return internal::difference(point, doubles(place, unit));
    }
    void set(const Quadric& quadric, double unit)
    {
      matrix = internal::Float_symmetric_matrix(quadric.matrix());
      linear = floats(quadric.b(), unit);
      constant = internal::saturated_float(quadric.c() / (unit * unit));
    }
    Quadric quadric(double unit) const { return {matrix, doubles(linear, unit), unit * unit * constant}; }
  };
  // What a face gives to the quadrics at its corners: kept, since each is asked for many times.
  struct Face_plane
  {
    Float_vector normal{0, 0, 0}; // as long as the square root of the weight
  };
  using Plane_map =
      typename boost::property_map<TriangleMesh, CGAL::dynamic_face_property_t<Face_plane>>::const_type;
  template <class Value>
  using Vertex_map =
      typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<Value>>::const_type;

public:
  /// Asks CGAL's loop to call `initialize` and `update_after_collapse`.
  using Update_tag = CGAL::Tag_true;

  explicit Quadric_cost(const TriangleMesh& mesh, const Quadric_cost_options& options = {},
                        const EdgeIsLineMap& edge_is_line = {})
      : m_state(std::make_shared<State>(mesh, options, edge_is_line))
  {
    for (const double weight : {options.border_weight, options.stabiliser})
      if (!is_weight(weight))
        throw Argument_error("the weights of a cost are finite and at least 0, not " +
                             std::to_string(weight));
    if (!(options.memory >= 0 && options.memory <= 1))
      throw Argument_error("the memory of a cost is a share, from 0 to 1, not " +
                           std::to_string(options.memory));
  }

  /// Multiplies the quadric of every vertex by a factor; a merged vertex has the larger one of both.
  /// `weights` has one finite factor of at least 0 for each vertex, in the order of `vertices(mesh)`, or is
  /// empty for all 1; otherwise it throws `Argument_error`. A factor below 1e-38 of the largest one may count
  /// as 0. Call it before the first run.
  void weigh(const TriangleMesh& mesh, const std::vector<double>& weights)
  {
    const std::size_t wanted = vertices(mesh).size();
    if (!weights.empty() &&
        (weights.size() != wanted || !std::all_of(weights.begin(), weights.end(), is_weight)))
      throw Argument_error("weights of vertices are finite numbers of at least 0, one for each of " +
                           std::to_string(wanted) + " vertices");
    m_state->weights.reset();
    m_state->weight_unit = 1;
    if (weights.empty())
      return;
    m_state->weights = get(CGAL::dynamic_vertex_property_t<double>(), mesh);
    if (const double largest = *std::max_element(weights.begin(), weights.end()); largest > 0)
      m_state->weight_unit = std::ldexp(1, std::ilogb(largest));
    auto weight = weights.begin();
    for (const Vertex v : vertices(mesh))
      put(*m_state->weights, v, *weight++ / m_state->weight_unit);
  }

  /// Sets the length D to which areas are relative; by default, it is the diagonal of the mesh. A mesh that
  /// is a part of another needs the diagonal of the whole. Call it before the first run.
  void measure_by(double diagonal) { m_state->diagonal = diagonal; }

  /// Computes the quadrics when it is called for the first time. The loop calls it.
  template <class VertexPointMap, class GeomTraits>
  void initialize(const TriangleMesh& mesh, const VertexPointMap& points, const GeomTraits&) const
  {
    if (m_state->is_initialised)
      return;
    const CGAL::Bbox_3 box = internal::bounding_box(mesh, points);
    for (int i = 0; i < 3 && (box.min)(i) <= (box.max)(i); ++i)
      m_state->origin[std::size_t(i)] = 0.5 * (box.min)(i) + 0.5 * (box.max)(i);
    if (!(m_state->diagonal > 0))
      m_state->diagonal = internal::diagonal_of(box);
    if (!(m_state->diagonal > 0))
      m_state->diagonal = 1; // all points are one
    m_state->unit = std::ldexp(1, std::ilogb(m_state->diagonal));
    compute_planes(mesh, points);
    Cancellation_poll poll;
    for (const Vertex v : vertices(mesh)) {
      poll();
      Growth growth;
      growth.has_lines = is_at_line(v, mesh);
      compute_growth(v, mesh, points, 0, growth);
      put(m_state->growths, v, growth);
      Accumulated accumulated;
      const Vector place = m_state->vector(get(points, v));
      accumulated.place = floats(place, m_state->unit);
      const Vector from_place = accumulated.from_place(place, m_state->unit);
      accumulated.set(growth.quadric(m_state->unit).moved_by(from_place), m_state->unit);
      put(m_state->accumulated, v, accumulated);
    }
    m_state->is_initialised = true;
  }

  /// Throws `Argument_error` unless a loop, or the caller, has called `initialize`. A placement or filter
  /// that uses a cost needs the very object that is the cost of the loop, or a copy of it.
  void require_initialised() const
  {
    if (!m_state->is_initialised)
      throw Argument_error("a placement or filter uses a Quadric_cost that is not the cost of the loop: give "
                           "the same object to both, or copies of one");
  }

  /// Returns the cost of merging the ends of the profile's edge at `placement`, in units of squared length,
  /// or none when there is no placement.
  template <class Profile, class Point>
  internal::Optional<typename Profile::FT> operator()(const Profile& profile,
                                                      const internal::Optional<Point>& placement) const
  {
    if (!placement)
      return {};
    return typename Profile::FT(cost_at(profile, *placement));
  }

  /// Returns the same cost for a point.
  template <class Profile, class Point>
  double cost_at(const Profile& profile, const Point& point) const
  {
    const Vector x = vector(point);
    return positive(growth(profile.v0(), internal::difference(x, vector(profile.p0()))) +
                    growth(profile.v1(), internal::difference(x, vector(profile.p1()))));
  }

  /// Returns the same cost for moving the source of `moving`, a halfedge of the profile's edge, onto its
  /// target; faster than `cost_at`.
  template <class Profile>
  internal::Optional<double> cost_along(const Profile& profile, Halfedge moving) const
  {
    const Vector p0 = vector(profile.p0()), p1 = vector(profile.p1());
    return positive(moving == profile.v0_v1() ? growth(profile.v0(), internal::difference(p1, p0))
                                              : growth(profile.v1(), internal::difference(p0, p1)));
  }

  /// Returns the costs of both motions along the profile's edge: of v0 onto v1, and of v1 onto v0. They are
  /// those of `cost_along`, and take less time than two calls of it.
  template <class Profile>
  std::array<internal::Optional<double>, 2> costs_along(const Profile& profile) const
  {
    const Vector p0 = vector(profile.p0()), p1 = vector(profile.p1());
    return {positive(growth(profile.v0(), internal::difference(p1, p0))),
            positive(growth(profile.v1(), internal::difference(p0, p1)))};
  }

  /// Returns where the merged vertex costs least among the points that leave the volume on both sides of the
  /// surface as it is, in coordinates, or none when that is at an end of the edge.
  ///
  /// Where an end is on a border, or the memory is 1, no volume is kept. Where the least is farther from the
  /// middle of the edge than `reach` times the length of the edge, or is not one point, the best point inside
  /// the edge takes its place.
  template <class Profile>
  std::optional<internal::Vector_of_doubles> least_place(const Profile& profile, double reach) const
  {
    using internal::cross;
    using internal::difference;
    using internal::dot;
    // All of this is relative to one end.
    const Vector origin = vector(profile.p0()), along = difference(vector(profile.p1()), origin);
    const Quadric sum = sum_from(profile, along);
    std::optional<Vector> least;
    if (m_state->options.memory < 1) {
      Enclosure both = enclosure_of(profile.v0(), profile);
      const Enclosure second = enclosure_of(profile.v1(), profile);
      if (both.is_closed && second.is_closed) {
        // A merged vertex x encloses the same volume as before when normals * x is the sum of the products of
        // each normal with a corner. This is an end of the edge, which is 0 for the first.
        both.add(second.normals);
        const auto third = [&](Halfedge h) { // the corner beside the edge, of a face that is in both
          const auto& mesh = profile.surface_mesh();
          return difference(vector(get(profile.vertex_point_map(), target(next(h, mesh), mesh))), origin);
        };
        both.add(cross(along, difference(third(profile.v1_v0()), third(profile.v0_v1()))));
        least = sum.least_point_on_plane(both.normals, dot(second.normals, along), {0, 0, 0});
      }
    }
    if (!least)
      least = sum.least_point();
    if (least) {
      Vector off = *least;
      for (std::size_t i = 0; i < 3; ++i)
        off[i] -= 0.5 * along[i];
      if (!(dot(off, off) <= reach * reach * dot(along, along)))
        least.reset();
    }
    if (!least) {
      const std::optional<double> share = sum.least_along({0, 0, 0}, along);
      if (!share || !(*share > 0 && *share < 1))
        return std::nullopt;
      least = along;
      for (double& coordinate : *least)
        coordinate *= *share;
    }
    for (std::size_t i = 0; i < 3; ++i)
      (*least)[i] += origin[i];
    return least;
  }

  /// Returns what the merged vertex costs at the place of least cost, whatever volume it leaves, or 0 where
  /// this is not one point; faster than `least_place`.
  template <class Profile>
  double least_cost(const Profile& profile) const
  {
    const Quadric sum = sum_from(profile, internal::difference(vector(profile.p1()), vector(profile.p0())));
    const auto least = sum.least_point();
    return least ? m_state->weight_unit * positive(sum(*least)) : 0;
  }

  /// Returns the root mean square distance of `point` to the planes accumulated at both ends of the edge, in
  /// units of the mesh, with the weights that they have in the cost.
  template <class Profile, class Point>
  double error_at(const Profile& profile, const Point& point) const
  {
    const Vector x = m_state->vector(point);
    double sum = 0, weight = 0;
    for (const Vertex v : {profile.v0(), profile.v1()}) {
      const Accumulated& accumulated = get(m_state->accumulated, v);
      const Quadric quadric = accumulated.quadric(m_state->unit);
      sum += quadric(accumulated.from_place(x, m_state->unit));
      weight += quadric.trace();
    }
    return weight > 0 ? std::sqrt(positive(sum) / weight) : 0;
  }

  /// See `Collapse_locality`: what a collapse changes around its vertex changes the costs at its neighbours,
  /// unless the cost is of what has accumulated alone.
  bool reaches_neighbours(Vertex /*kept*/) const { return m_state->options.memory < 1; }
  bool reaches(Vertex /*kept*/, Edge /*edge*/) const { return m_state->options.memory < 1; }
  bool can_wait(Vertex /*kept*/, Edge /*edge*/) const { return true; }

  /// Gives the merged vertex what both have accumulated, and computes what there is around it. The loop calls
  /// it.
  template <class Profile>
  void update_after_collapse(const Profile& profile, Vertex kept) const
  {
    update(profile, kept, std::nullopt);
  }

  /// The same in less time, for a loop that says where the merged vertex is, and whose profile says what was
  /// beside the edge before the collapse. When it is at one end of the edge, only the faces that were at the
  /// other have changed, and only what is around their corners is computed anew.
  template <class Profile>
  void update_after_collapse(const Profile& profile, Vertex kept, internal::Merged_at at) const
  {
    // On both sides of the edge there must be a corner where the faces of one end begin.
    const bool is_part =
        at != internal::Merged_at::between && profile.left_face_exists() && profile.right_face_exists();
    if (!is_part)
      update(profile, kept, std::nullopt);
    else if (at == internal::Merged_at::v1)
      update(profile, kept, Part_of_star{profile.vR(), profile.vL()});
    else
      update(profile, kept, Part_of_star{profile.vL(), profile.vR()});
  }

  /// Gives the merged vertex what both have accumulated. Between the first of many collapses of which nobody
  /// asks for a cost and the call of `recompute`, it takes the place of `update_after_collapse`.
  template <class Profile>
  void accumulate(const Profile& profile, Vertex kept) const
  {
    const Vertex gone = kept == profile.v0() ? profile.v1() : profile.v0();
    const double unit = m_state->unit;
    const Accumulated& of_gone = get(m_state->accumulated, gone);
    change(m_state->accumulated, kept, [&](Accumulated& merged) {
      Quadric sum = of_gone.quadric(unit).moved_by(merged.from_place(doubles(of_gone.place, unit), unit));
      sum += merged.quadric(unit);
      merged.set(sum, unit);
    });
    change(m_state->growths, kept,
           [&](Growth& merged) { merged.has_lines |= get(m_state->growths, gone).has_lines; });
    if (m_state->weights)
      put(*m_state->weights, kept, (std::max)(get(*m_state->weights, kept), get(*m_state->weights, gone)));
  }

  /// Computes for the whole mesh what there is around each vertex.
  template <class VertexPointMap>
  void recompute(const TriangleMesh& mesh, const VertexPointMap& points) const
  {
    compute_planes(mesh, points);
    m_state->enclosures.reset();
    Cancellation_poll poll;
    for (const Vertex v : vertices(mesh)) {
      poll();
      change(m_state->growths, v,
             [&](Growth& growth) { compute_growth(v, mesh, points, m_state->options.memory, growth); });
    }
  }

private:
  struct State
  {
    State(const TriangleMesh& mesh, const Quadric_cost_options& options_, const EdgeIsLineMap& edge_is_line_)
        : options(options_), edge_is_line(edge_is_line_),
          planes(get(CGAL::dynamic_face_property_t<Face_plane>(), mesh)),
          growths(get(CGAL::dynamic_vertex_property_t<Growth>(), mesh)),
          accumulated(get(CGAL::dynamic_vertex_property_t<Accumulated>(), mesh))
    {
    }

    // Relative to the origin.
    template <class Point>
    Vector vector(const Point& p) const
    {
      return internal::difference(Quadric_cost::vector(p), origin);
    }

    Quadric_cost_options options;
    EdgeIsLineMap edge_is_line;
    Plane_map planes;
    Vertex_map<Growth> growths; // which every cost asks for, apart from the rest
    Vertex_map<Accumulated> accumulated;
    std::optional<Vertex_map<Enclosure>> enclosures; // none until a place is asked for
    std::optional<Vertex_map<double>> weights;       // in their unit; none when all are 1
    double weight_unit = 1;                          // the power of two below the largest
    Vector origin{0, 0, 0};
    double diagonal = 0; // not known yet
    double unit = 1;     // the power of two below the diagonal
    bool is_initialised = false;
    std::vector<Vertex> changed; // by the last collapse: a buffer
  };

  template <class Point>
  static Vector vector(const Point& p)
  {
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }

  static bool is_weight(double number) { return number >= 0 && std::isfinite(number); }

  // Calls a function with what a map has of a key, in its place where the map tells it.
  template <class Map, class Key, class Function>
  static void change(const Map& map, const Key& key, const Function& function)
  {
    using Value = typename boost::property_traits<Map>::value_type;
    if constexpr (std::is_same_v<decltype(get(map, key)), Value&>) {
      function(get(map, key));
    } else {
      Value value = get(map, key);
      function(value);
      put(map, key, value);
    }
  }

  // Asks the processor to load what a map has of a key, where the map tells its place.
  template <class Map, class Key>
  static void prefetch_value(const Map& map, const Key& key)
  {
    if constexpr (std::is_lvalue_reference_v<decltype(get(map, key))>)
      internal::prefetch(get(map, key));
  }

  // The neighbours of a vertex from one to another, in the order of `halfedges_around_target`, and the faces
  // between them.
  struct Part_of_star
  {
    Vertex first, last;
  };

  // Updates what a collapse has changed: in a part of the star of the merged vertex, or in all of it.
  template <class Profile>
  void update(const Profile& profile, Vertex kept, const std::optional<Part_of_star>& part) const
  {
    const auto& mesh = profile.surface_mesh();
    const auto& points = profile.vertex_point_map();
    State& state = *m_state;
    const double memory = state.options.memory;
    state.changed = {kept};
    if (memory < 1)
      compute_planes_around(kept, part, mesh, points);
    accumulate(profile, kept);
    for (const Vertex v : state.changed) {
      change(state.growths, v, [&](Growth& growth) { compute_growth(v, mesh, points, memory, growth); });
      if (state.enclosures)
        change(*state.enclosures, v, [](Enclosure& enclosure) { enclosure.is_known = false; });
    }
  }

  // Computes the planes of the faces in a part of the star of a vertex, or in all of it, and notes that its
  // neighbours there have changed.
  template <class VertexPointMap>
  void compute_planes_around(Vertex v, const std::optional<Part_of_star>& part, const TriangleMesh& mesh,
                             const VertexPointMap& points) const
  {
    Halfedge h = halfedge(v, mesh);
    const auto advance = [&] { h = opposite(next(h, mesh), mesh); };
    if (part)
      while (source(h, mesh) != part->first)
        advance();
    const Halfedge first = h;
    bool is_changed = true;
    do {
      const Vertex neighbour = source(h, mesh);
      if (is_changed) {
        m_state->changed.push_back(neighbour);
        prefetch_around(h, mesh);
      } else {
        prefetch_value(m_state->growths, neighbour); // the loop is about to ask what its edge costs
      }
      is_changed = is_changed && !(part && neighbour == part->last);
      if (is_changed && !CGAL::is_border(h, mesh))
        compute_plane(face(h, mesh), mesh, points);
      advance();
    } while (h != first);
  }

  // Prefetches what `compute_growth` reads at the source of a halfedge. It is spread over memory, and would
  // be waited for piece by piece.
  void prefetch_around(Halfedge h, const TriangleMesh& mesh) const
  {
    prefetch_value(m_state->growths, source(h, mesh));
    prefetch_value(m_state->accumulated, source(h, mesh));
    for (const Halfedge g : CGAL::halfedges_around_source(h, mesh))
      if (!CGAL::is_border(g, mesh))
        prefetch_value(m_state->planes, face(g, mesh));
  }

  // The factor that brings areas of which faces differ by orders of magnitude nearer to each other.
  double weight_of_area(double area) const
  {
    return internal::relative_face_weight(area / (m_state->diagonal * m_state->diagonal));
  }

  // Rounding may leave a sum slightly below zero.
  static double positive(double sum) { return (std::max)(0.0, sum); }

  // Scales `v` to length 1 and returns the length that it had. Leaves the zero vector as it is.
  static double normalise(Vector& v)
  {
    const double length = std::sqrt(internal::dot(v, v));
    if (length > 0)
      for (double& coordinate : v)
        coordinate /= length;
    return length;
  }

  template <class VertexPointMap>
  void compute_plane(typename Graph_traits::face_descriptor face, const TriangleMesh& mesh,
                     const VertexPointMap& points) const
  {
    const Halfedge h = halfedge(face, mesh);
    const Vector corner = vector(get(points, source(h, mesh)));
    const auto side_to = [&](Vertex v) { return internal::difference(vector(get(points, v)), corner); };
    Vector normal = internal::cross(side_to(target(h, mesh)), side_to(target(next(h, mesh), mesh)));
    const double length = std::sqrt(weight_of_area(0.5 * normalise(normal)));
    Face_plane plane;
    for (std::size_t i = 0; i < 3; ++i)
      plane.normal[i] = internal::saturated_float(length * normal[i]);
    put(m_state->planes, face, plane);
  }

  template <class VertexPointMap>
  void compute_planes(const TriangleMesh& mesh, const VertexPointMap& points) const
  {
    for (const auto face : faces(mesh))
      compute_plane(face, mesh, points);
  }

  double growth(Vertex v, const Vector& motion) const
  {
    return m_state->weight_unit * get(m_state->growths, v)(motion, m_state->unit);
  }

  // Returns the cost of merging the ends of an edge, relative to the first; `along` is the edge.
  template <class Profile>
  Quadric sum_from(const Profile& profile, const Vector& along) const
  {
    Quadric sum = get(m_state->growths, profile.v0()).quadric(m_state->unit);
    sum += get(m_state->growths, profile.v1()).quadric(m_state->unit).moved_by(along);
    return sum;
  }

  template <class Profile>
  Enclosure enclosure_of(Vertex v, const Profile& profile) const
  {
    const auto& mesh = profile.surface_mesh();
    std::optional<Vertex_map<Enclosure>>& enclosures = m_state->enclosures;
    if (!enclosures)
      enclosures = get(CGAL::dynamic_vertex_property_t<Enclosure>(), mesh);
    Enclosure result = get(*enclosures, v);
    if (result.is_known)
      return result;
    result = {};
    result.is_known = true;
    const auto& points = profile.vertex_point_map();
    const Vector at_v = vector(get(points, v));
    const auto spoke_to = [&](Vertex w) { return internal::difference(vector(get(points, w)), at_v); };
    Vector spoke = spoke_to(source(halfedge(v, mesh), mesh));
    for (const Halfedge to_v : CGAL::halfedges_around_target(v, mesh)) {
      result.is_closed &= !CGAL::is_border(to_v, mesh);
      if (!result.is_closed)
        break;
      const Vector next_spoke = spoke_to(target(next(to_v, mesh), mesh));
      result.add(internal::cross(next_spoke, spoke));
      spoke = next_spoke;
    }
    put(*enclosures, v, result);
    return result;
  }

  // Computes the growth at a vertex from the planes of the faces around it, which a memory of 1 does not ask
  // for, and, as far as `memory` says, from what it has accumulated.
  template <class VertexPointMap>
  void compute_growth(Vertex v, const TriangleMesh& mesh, const VertexPointMap& points, double memory,
                      Growth& growth) const
  {
    const State& state = *m_state;
    Matrix matrix;
    const Halfedge first = halfedge(v, mesh);
    if (memory < 1 && first != Graph_traits::null_halfedge()) {
      Matrix of_lines;
      if (growth.has_lines || !add_planes_around(first, mesh, matrix))
        add_planes_and_lines_around(first, growth.has_lines, mesh, points, matrix, of_lines);
      matrix.add_identity(state.options.stabiliser * matrix.trace()); // which is the weight of the planes
      matrix += of_lines;
      matrix *= (1 - memory) * (state.weights ? get(*state.weights, v) : 1);
    }
    growth.linear = {0, 0, 0};
    if (memory > 0) {
      const Accumulated& accumulated = get(state.accumulated, v);
      Quadric remembered = accumulated.quadric(state.unit);
      remembered *= memory;
      matrix += remembered.matrix();
      const Vector from_place = accumulated.from_place(state.vector(get(points, v)), state.unit);
      growth.linear = floats(remembered.half_gradient(from_place), state.unit);
    }
    growth.matrix = internal::Float_symmetric_matrix(matrix);
  }

  // Adds up the planes of the faces around the target of `first`, in single precision, in which the sum is
  // kept. Returns false, and adds nothing, where there is a border or the surface folds.
  bool add_planes_around(Halfedge first, const TriangleMesh& mesh, Matrix& sum) const
  {
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    bool is_folded = false;
    const Halfedge before = opposite(first, mesh);
    if (CGAL::is_border(before, mesh))
      return false;
    Float_vector last = get(m_state->planes, face(before, mesh)).normal;
    for (const Halfedge to_v : CGAL::halfedges_around_target(first, mesh)) {
      if (CGAL::is_border(to_v, mesh))
        return false;
      const Float_vector here = get(m_state->planes, face(to_v, mesh)).normal;
      const auto [x, y, z] = here;
      xx += x * x;
      xy += x * y;
      xz += x * z;
      yy += y * y;
      yz += y * z;
      zz += z * z;
      is_folded |= x * last[0] + y * last[1] + z * last[2] < 0;
      last = here;
    }
    if (!is_folded)
      sum += Matrix{xx, xy, xz, yy, yz, zz};
    return !is_folded;
  }

  // Adds up the planes of the faces around the target of `first`, and those that stand on lines and folds.
  template <class VertexPointMap>
  void add_planes_and_lines_around(Halfedge first, bool has_lines, const TriangleMesh& mesh,
                                   const VertexPointMap& points, Matrix& planes, Matrix& lines) const
  {
    Side before = side_at(opposite(first, mesh), mesh), here = side_at(first, mesh);
    double fold_before = internal::dot(here.normal, before.normal);
    Halfedge to_v = first;
    do { // in the order of `halfedges_around_target`
      const Halfedge from_v = next(to_v, mesh), next_to_v = opposite(from_v, mesh);
      const Side after = side_at(next_to_v, mesh);
      const double fold_after = internal::dot(here.normal, after.normal);
      if (here.has_face) {
        planes.add_square(here.normal, 1);
        if (has_lines || fold_after < 0)
          add_line_between(here, after, from_v, has_lines, mesh, points, lines);
        if (has_lines || fold_before < 0)
          add_line_between(here, before, to_v, has_lines, mesh, points, lines);
      }
      fold_before = fold_after;
      before = std::exchange(here, after);
      to_v = next_to_v;
    } while (to_v != first);
  }

  bool is_at_line(Vertex v, const TriangleMesh& mesh) const
  {
    if (halfedge(v, mesh) == Graph_traits::null_halfedge())
      return false;
    const auto around = CGAL::halfedges_around_target(v, mesh);
    return std::any_of(around.begin(), around.end(), [&](Halfedge h) {
      return CGAL::is_border(h, mesh) ||
             share_of_line(edge(h, mesh), CGAL::is_border(opposite(h, mesh), mesh)) > 0;
    });
  }

  // Returns which share of the weight of a border an edge has: 1 for a border, 0 for an edge that is no line.
  double share_of_line(Edge edge, bool is_border) const
  {
    if (is_border)
      return 1;
    // The surface on both sides holds a line inside it, so that little is enough.
    constexpr double share_of_inner_line = 0.1;
    return get(m_state->edge_is_line, edge) ? share_of_inner_line : 0;
  }

  // What is on the side of an edge to which a halfedge belongs.
  struct Side
  {
    bool has_face;
    Vector normal; // as long as the square root of the weight of the face
  };
  Side side_at(Halfedge h, const TriangleMesh& mesh) const
  {
    if (CGAL::is_border(h, mesh))
      return {false, {0, 0, 0}};
    const Face_plane& plane = get(m_state->planes, face(h, mesh));
    return {true, {plane.normal[0], plane.normal[1], plane.normal[2]}};
  }

  // Returns which share of the weight of a border an edge has on one of its sides because the surface folds
  // over it. Where both sides lie on each other, the planes of their faces do not say how far the surface
  // goes, as at a border; so the planes of both together have the weight of one. Where the surface turns by
  // 90° or less, each side says where the other ends. A side without a face has a normal of 0.
  static double share_of_fold(const Side& a, const Side& b)
  {
    const double product = internal::dot(a.normal, b.normal);
    return product < 0 ? -0.5 * product /
                             std::sqrt(internal::dot(a.normal, a.normal) * internal::dot(b.normal, b.normal))
                       : 0;
  }

  // Adds the plane that stands on an edge of the face of `here`, if the edge is a line or the surface folds
  // over it.
  template <class VertexPointMap>
  void add_line_between(const Side& here, const Side& beyond, Halfedge h, bool may_be_line,
                        const TriangleMesh& mesh, const VertexPointMap& points, Matrix& sum) const
  {
    const double of_line = may_be_line ? share_of_line(edge(h, mesh), !beyond.has_face) : 0;
    const double share = (std::max)(share_of_fold(here, beyond), of_line);
    if (share == 0)
      return;
    Vector normal = here.normal;
    normalise(normal);
    Vector along =
        internal::difference(vector(get(points, target(h, mesh))), vector(get(points, source(h, mesh))));
    const double length = normalise(along);
    sum.add_square(internal::cross(normal, along),
                   m_state->options.border_weight * share * weight_of_area(length * length));
  }

  std::shared_ptr<State> m_state;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_QUADRIC_COST_H
