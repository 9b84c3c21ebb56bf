// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_WORKING_MESH_H
#define SELVEDGE_SOUP_WORKING_MESH_H

#include "Vertex_values.h"
#include "selection.h"
#include "shared_meshes.h"
#include <selvedge/Parts.h>
#include <selvedge/Progression.h>
#include <selvedge/Sewing_notes.h>
#include <selvedge/Simplify_options.h>
#include <selvedge/Surface_mesh_simplification/Border_rule.h>
#include <selvedge/Surface_mesh_simplification/No_observer.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/internal/Uv_quadric.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Scale.h>

#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace selvedge {

class Sewing;

/// A soup as one mesh in which coincident borders are sewn. The reduction works on this mesh; `result` makes
/// a soup of it again.
///
/// Vertices at one position become one vertex when that keeps every edge manifold and oriented. Where it does
/// not, they stay separate, as coincident vertices. These move together along a line where several sheets
/// meet, one on each sheet, and nowhere else. Edges across which a vertex number, a
/// texture coordinate, a normal, a group, an object or a material changes are lines: vertices on a line move
/// only along it, and both sides move together, so that no gap can open.
///
/// Every face knows for each of its corners which corner of the soup this now is. A collapse gives a moved
/// corner the corner at the vertex with which it merges, taken from the contracted face on the same side of
/// the lines. So every attribute of the result is one that the input has at that position and on that side.
///
/// Where a collapse puts the merged vertex to a new place (`Placement::optimal`), the vertex has the number
/// and the corners of the end that was nearer, and its own values: those that the surface around both ends
/// has at the point nearest to this place, by barycentric coordinates (`Vertex_values` says of what). Only
/// vertices on no line are placed so; all their corners have the same values.
///
/// Several triangles with the same three positions, as of a double-sided mesh, are one face: the first of
/// them, their front, stands for all. The others are its doubles. They have corners of their own, which a
/// collapse moves alike, and are in the result when the face is. An edge is a line also where the doubles of
/// its two faces are not as many, run other ways, or differ as faces may.
///
/// An obstacle may lie beside the soup: triangles that are in the mesh, do not change, and are not in the
/// result. Nothing of the soup is sewn to it. Where the soup lies along an obstacle, it has the same border
/// as without it; where both have a vertex at one position, the two are coincident vertices. Limits that are
/// shares of a diagonal refer to the diagonal of the soup alone.
class Working_mesh : public No_observer
{
public:
  using Mesh = CGAL::Surface_mesh<Point_3>;

  static constexpr char by_wish = 2;

  /// Sews a soup, and puts the obstacle beside it. `positions[v]` is the number of the position of vertex v;
  /// vertices with equal numbers are sewn. `is_frozen[t]` says that the vertices of triangle t do not move:
  /// `by_wish` when the user wants it so, another number but 0 for any other reason.
  /// In both arrays, as in the faces of the mesh, vertices and triangles of the obstacle follow those of the
  /// soup. Nothing else of the obstacle is used, and all its triangles are frozen. The points of the mesh are
  /// those of both, divided by the scale; the result has the original ones. Triangle t of the soup is turned
  /// in the mesh when `is_turned[t]`, and back again in the result; none is when the array is empty.
  /// `fronts[t]` is the front of triangle t, or t itself, as in `Prepared_soup`; no triangle is a double when
  /// the array is empty. The mesh has no face of the number of a double.
  ///
  /// **Preconditions** No triangle has two corners at one position. No double is turned. The soup outlives
  /// the mesh.
  ///
  /// **Complexity** O(n log n).
  Working_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
               const std::vector<char>& is_frozen, const Triangle_soup& obstacle = {},
               const Scale& scale = Scale(), const std::vector<char>& is_turned = {},
               const std::vector<Index>& fronts = {});

  /// Makes a mesh of some faces of another, so that this part can be reduced separately. Face i of the part
  /// is face `faces[i]` of the whole.
  ///
  /// **Guarantees** Nothing is decided anew:
  /// 1. Two faces have an edge in common exactly where they have it in the whole. A vertex of the whole with
  ///    all its faces in the part has them there in the same order. What is left of any other vertex is
  ///    locked, and is several vertices where its faces are not connected.
  /// 2. The rule of the whole says which other vertices are locked, and which edges are lines.
  /// 3. Points, corners of the soup, weights, and texture are those of the whole.
  ///
  /// `result`, and counts by the parts of the soup, are asked of the whole only.
  ///
  /// **Preconditions** `faces` are in ascending order. Nothing has been collapsed in `whole`, whose soup
  /// outlives this mesh.
  ///
  /// **Complexity** O(n log n) for n faces of the part.
  Working_mesh(const Working_mesh& whole, const Border_rule<Mesh>& rule, const std::vector<Index>& faces);

  Mesh& mesh() { return m_mesh; }
  const Mesh& mesh() const { return m_mesh; }
  Simplify_constraints<Mesh>& constraints() { return m_constraints; }
  const Simplify_constraints<Mesh>& constraints() const { return m_constraints; }
  const Sewing_notes& notes() const { return m_notes; }

  /// Makes the places of shared meshes one for the reduction: what holds a vertex in one place does so in
  /// all, and motions have companions. Where the faces of a mesh are not joined alike in all places, because
  /// something is sewn to them in some, vertices are locked. Motions in places no farther from each other
  /// than `clearance`, in the unit of the working mesh, are no companions.
  ///
  /// **Preconditions** Nothing has been collapsed.
  void share(std::vector<Shared_mesh> meshes, double clearance = 0);

  /// The number of faces, without those of the obstacle; doubles are none.
  std::size_t face_count() const { return m_mesh.number_of_faces() - m_constraints.uncounted_faces.size(); }

  bool is_shared(Mesh::Face_index face) const
  {
    return std::size_t(face) < m_copies.size() && m_copies[face].mesh != s_no_mesh;
  }

  /// Locks vertices of the soup because the user wants it so, and all others at their positions, which
  /// `positions` numbers as the constructor's does. Throws `Argument_error` for a vertex that the soup does
  /// not have.
  void lock_by_wish(const std::vector<Index>& vertices, const std::vector<Index>& positions);

  /// Weighs the vertices by `weights` of the vertices of the soup. A vertex to which several are sewn gets
  /// the largest of their weights.
  void weigh(const std::vector<double>& weights);

  /// Makes `uv_cost` say from now on how far the texture is displaced. Before, and where there is no texture,
  /// it is 0. Weights that should count must be set before. `unit` is the `uv_unit` of the soup at the scale.
  void measure_uvs(double unit);

  /// Starts to count refusals by the parts of the soup to which the moving vertex belongs.
  void count_refusals(std::vector<Part_kind> kinds);

  /// The refusals so far, for each kind and each of its parts.
  const std::vector<std::vector<Refusals>>& refused_by_part() const { return m_refused; }

  /// Sets a function that is called before each collapse, as `Simplify_options::on_collapse` is.
  void on_collapse(std::function<void(const Soup_collapse&)> listener) { m_listener = std::move(listener); }

  /// Makes `rounded_place` return places from now on; before, it returns none. Multiplied by the scale, the
  /// coordinates of a place are doubles without loss, and 32-bit floats when `is_float32`. They have no more
  /// digits than such floats also where all coordinates of the soup have no more. A place of a vertex from
  /// glTF is, unless `is_float32`, the world position of 32-bit floats in its node. Where the scale does not
  /// allow that, because the mesh is too large or too small for the type of number, there are no new places.
  void allow_new_places(bool is_float32);

  /// Restricts these places to those for which `is_allowed` returns true.
  void restrict_new_places(std::function<bool(const Point_3&)> is_allowed)
  {
    m_is_place_allowed = std::move(is_allowed);
  }

  /// Returns for every vertex of the mesh one of the vertices from which it was made: its number in the soup
  /// or, after those, in the obstacle that the constructor was given.
  ///
  /// **Preconditions** Nothing has been collapsed.
  std::vector<Index> vertices_of_soup(const Triangle_soup& obstacle) const;

  /// Identifies a halfedge such that it is found again in another mesh of the same triangles, when the same
  /// collapses have been done to both.
  struct Side
  {
    Index triangle;      ///< the number of a face beside the edge
    unsigned char place; ///< at which corner of that face its halfedge of the edge begins
    bool is_beyond;      ///< whether the halfedge is the opposite of that one
  };
  Side side(Mesh::Halfedge_index h) const;

  /// Returns the halfedge of a side. Throws `std::logic_error` when there is none, for instance because the
  /// face is gone.
  Mesh::Halfedge_index halfedge(const Side& side) const;

  /// A collapse such that it can be repeated in another mesh of the same triangles.
  struct Collapse
  {
    Side moving;
    std::optional<Point_3> place; ///< where both ends go, if that is not an end
    bool is_mover_first = false;
  };

  /// Sets a function that is called before each collapse.
  void record(std::function<void(const Collapse&)> recorder) { m_recorder = std::move(recorder); }

  /// Makes `progression` hold the wedges of the soup, and records every step in it from now on.
  ///
  /// **Preconditions** Nothing has been collapsed, and no vertex goes to a new place. `progression` outlives
  /// the mesh.
  void record_progression(Progression& progression);

  /// What differs across an edge, at either end of it, in the corners that its two faces have now.
  struct Differences
  {
    bool in_vertex = false, in_uv = false, in_normal = false, in_label = false;
    bool in_doubles = false; ///< in their number or directions

    bool any() const { return in_vertex || in_uv || in_normal || in_label || in_doubles; }
    Differences& operator|=(const Differences& other);
  };
  Differences differences(Mesh::Edge_index e) const;

  /// The sides of the soup's triangles, 3 × triangle + place as they are turned, along which two faces face
  /// opposite ways.
  const std::vector<Index>& misoriented_sides() const { return m_misoriented_sides; }

  // Called by the reduction, whose observer this is.
  void before_collapse(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule);
  void before_joint_collapse(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule)
  {
    carry(moving, rule);
  }
  void before_placement(Mesh::Halfedge_index moving, const Point_3& place, bool is_mover_first);
  void after_step();
  internal::Optional<Point_3> rounded_place(Mesh::Halfedge_index edge, const Point_3& place) const;
  void on_refused(Mesh::Halfedge_index moving, const Refusals& refusals);
  bool keeps_pieces(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const;
  bool keeps_joints(Mesh::Halfedge_index moving, const std::vector<Mesh::Halfedge_index>& others) const;
  bool keeps_uv_orientation(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const;
  bool keeps_uv_orientation_at(Mesh::Halfedge_index moving, const Point_3& place) const;
  std::vector<Mesh::Halfedge_index> companions(Mesh::Halfedge_index moving) const;
  bool are_companions_apart(Mesh::Halfedge_index moving,
                            const std::vector<Mesh::Halfedge_index>& companions) const;
  bool is_led(Mesh::Halfedge_index edge) const { return !m_shared.empty() && is_led_from_elsewhere(edge); }
  Hindrance lock_reason(Mesh::Vertex_index v) const;
  Hindrance line_reason(Mesh::Edge_index e) const;
  void on_hindered(Mesh::Edge_index e, Hindrance reason);
  double uv_cost(Mesh::Halfedge_index moving) const;
  double uv_cost_at(Mesh::Halfedge_index edge, const Point_3& place) const;

  /// What is left of the soup.
  struct Result
  {
    Triangle_soup soup;
    std::vector<Index> triangles;      ///< of the input, in its order
    std::vector<Index_triple> corners; ///< of the input, now of each triangle: 3 × triangle + place in it
    std::size_t placed_vertices = 0;   ///< vertices of `soup` at new places, with values of their own
    std::vector<Hindrance> held_by;    ///< as in `Simplified_soup`
  };
  Result result() const;

private:
  using Corner = Index; // 3 × triangle + place in it
  using Uv = Uv_quadric::Uv;

  Index vertex_of(Corner corner) const { return m_soup.triangles[corner / 3][corner % 3]; }
  const Uv& uv_of(Corner corner) const
  {
    return m_soup.uvs.values[m_soup.uvs.of_triangle[corner / 3][corner % 3]];
  }
  Uv uv_at(Corner corner) const; // as it is now
  CGAL::Orientation uv_orientation(const Index_triple& corners, unsigned char place, const Uv& uv) const;
  bool keeps_uv_orientation_of(Mesh::Halfedge_index h, Index ply, const Uv& uv) const;
  bool is_led_from_elsewhere(Mesh::Halfedge_index edge) const;
  bool is_own(Mesh::Face_index face) const { return std::size_t(face) < m_corners.size(); }
  Differences differences(Corner a, Corner b) const;

  /// The corner that the face beside a halfedge has at the target of the halfedge.
  Corner corner_at(Mesh::Halfedge_index h) const { return m_corners[m_mesh.face(h)][m_places[h]]; }

  /// One of the triangles for which a face with doubles stands.
  struct Ply
  {
    Index triangle;
    Index_triple corners; ///< at the places of the face; of the first ply, they are in `m_corners`
    std::array<unsigned char, 3> places; ///< of these corners in the triangle

    bool is_against_face() const { return places[1] != (places[0] + 1) % 3; }
  };
  Index ply_count(Mesh::Face_index face) const
  {
    return has_doubles(face) ? m_first_ply[face + 1] - m_first_ply[face] : 1;
  }
  bool has_face(Mesh::Face_index face) const
  {
    return m_mesh.has_valid_index(face) && !m_mesh.is_removed(face);
  }
  bool has_doubles(Mesh::Face_index face) const
  {
    return !m_first_ply.empty() && is_own(face) && m_first_ply[face] < m_first_ply[face + 1];
  }
  const Ply& ply(Mesh::Face_index face, Index i) const { return m_plies[m_first_ply[face] + i]; }
  const Index_triple& corners(Mesh::Face_index face, Index i) const
  {
    return i == 0 ? m_corners[face] : ply(face, i).corners;
  }
  Corner corner_at(Mesh::Halfedge_index h, Index i) const { return corners(m_mesh.face(h), i)[m_places[h]]; }
  void find_plies(const std::vector<Index>& fronts, const std::vector<Index>& positions);
  bool keeps_pieces_of_doubles(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const;

  /// Returns the halfedges to the source and to the target of a motion, in the face beside `side`, which is
  /// `moving` or its opposite.
  std::pair<Mesh::Halfedge_index, Mesh::Halfedge_index> halfedges_to_ends(Mesh::Halfedge_index moving,
                                                                          Mesh::Halfedge_index side) const
  {
    const Mesh::Halfedge_index before = m_mesh.prev(side);
    return side == moving ? std::make_pair(before, side) : std::make_pair(side, before);
  }

  template <class Function>
  std::vector<Mesh::Halfedge_index> make_mesh(const Sewing& sewing, const std::vector<Index>& faces,
                                              const Function& point_of);
  void lock(const std::vector<char>& is_locked);
  template <class Function>
  void find_joint_vertices(std::vector<char>& is_locked, const std::vector<char>& is_in_frozen_face,
                           const std::vector<Index>& vertices_at, const Function& position_of);
  template <class Function>
  void find_no_strip_vertices(const Function& position_of);
  template <class Function>
  void for_each_changed_face(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule,
                             const Function& function) const;
  std::pair<Index, Index> ends_in_soup(Mesh::Halfedge_index moving) const;
  void carry(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule);
  void carry_places(Mesh::Halfedge_index moving);
  void record_moves(Mesh::Halfedge_index moving);
  struct Mixture
  {
    Vertex_values::Shares shares;
    Vertex_values::Share own; // of the end that is kept
  };
  Mixture mixture_at(Mesh::Halfedge_index moving, const Point_3& place) const;
  Vertex_values::Share share(Corner corner, double weight) const;
  template <class Function>
  void for_each_moved_wedge(Mesh::Halfedge_index moving, const Function& function) const;

  Hindrance hindrance_of(Mesh::Face_index face) const;

  Index& wedge_at(Mesh::Halfedge_index h) { return m_wedge_numbers[m_mesh.face(h)][m_places[h]]; }
  Index wedge_at(Mesh::Halfedge_index h) const { return m_wedge_numbers[m_mesh.face(h)][m_places[h]]; }
  struct Wedge_numbers
  {
    std::vector<Index_triple> of_face;        // by face, for each of its corners
    std::vector<Mesh::Vertex_index> vertices; // by wedge
  };
  Wedge_numbers number_wedges() const;
  Uv_quadric::Vector motion(Mesh::Vertex_index v, const Point_3& place) const;
  Uv_quadric::Vector along(Mesh::Halfedge_index h) const;
  Uv at_unit(const Uv& uv) const;

  const Triangle_soup& m_soup;
  Scale m_scale;
  Mesh m_mesh;
  std::vector<Index_triple> m_corners; // by face; those of the obstacle have none
  std::vector<Ply> m_plies;            // by face, if it has doubles
  std::vector<Index> m_first_ply;      // by face, and one more; or empty
  std::vector<char> m_is_frozen;       // by face: as given, of one of its plies
  std::vector<char> m_is_turned;       // by face, or empty
  std::vector<char> m_is_wished;       // by vertex: locked because the user wants it so; or empty
  std::vector<Index> m_misoriented_sides;
  std::vector<char> m_is_misoriented;  // by vertex of the soup: at such a side
  std::vector<unsigned char> m_places; // by halfedge that is no border: the place of its target in its face
  Simplify_constraints<Mesh> m_constraints;
  Sewing_notes m_notes;
  std::function<void(const Soup_collapse&)> m_listener;
  std::function<void(const Collapse&)> m_recorder;
  Progression* m_progression = nullptr;

  // A vertex at a new place: where it is in the soup's unit, and its values there.
  struct Placed_vertex
  {
    Point_3 point;
    Vertex_values::Numbers values;
  };
  std::shared_ptr<const Vertex_values> m_values; // null until new places are allowed
  bool m_have_places_float32_digits = false, m_is_scale_lossless = false, m_are_places_in_scene = false;
  std::function<bool(const Point_3&)> m_is_place_allowed;
  std::unordered_map<Index, Placed_vertex> m_placed; // by the number that the vertex has in the soup

  // The corners at a vertex between two lines, which share their attributes.
  struct Wedge
  {
    Uv_quadric quadric; // its origin is the wedge
    Uv uv;
    bool is_alone; // the only wedge at its vertex, and stays so: lines neither begin nor end later

    Uv uv_motion(const Uv& to) const { return {to[0] - uv[0], to[1] - uv[1]}; }
  };
  std::vector<Index_triple> m_wedge_numbers; // by face, for each of its corners
  std::vector<Wedge> m_wedges;
  double m_uv_unit = 0; // at the scale

  // What a face is in a shared mesh.
  struct Copy
  {
    Index mesh, place, row;
  };
  static constexpr Index s_no_mesh = Index(-1);
  Side in_place(const Side& side, Index place) const;
  bool is_flipped(Index face) const;
  bool is_sewn_inside(Mesh::Halfedge_index h) const;
  void lock_joint_vertices_of_shared_meshes();
  void lock_in_all_places();

  std::vector<Shared_mesh> m_shared;
  std::vector<std::vector<std::pair<Index, Index>>> m_near_places; // by mesh: their boxes meet
  double m_clearance = 0;                                          // between the boxes of companions
  std::vector<Copy> m_copies;                                      // by face, or empty
  std::vector<char> m_is_held_elsewhere; // by vertex of the soup: only another place locks it

  // What holds back the three edges of each face; empty until the reduction says so.
  std::vector<std::array<std::optional<Hindrance>, 3>> m_hindrances;

  std::vector<Part_kind> m_kinds;
  std::vector<std::vector<Refusals>> m_refused;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_WORKING_MESH_H
