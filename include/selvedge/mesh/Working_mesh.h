// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_WORKING_MESH_H
#define SELVEDGE_MESH_WORKING_MESH_H

#include <selvedge/Surface_mesh_simplification/Border_rule.h>
#include <selvedge/Surface_mesh_simplification/No_observer.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/Uv_quadric.h>
#include <selvedge/mesh/Parts.h>
#include <selvedge/mesh/Scale.h>
#include <selvedge/mesh/Triangle_soup.h>
#include <selvedge/mesh/Welding_notes.h>
#include <selvedge/mesh/selection.h>

#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace selvedge {

class Sewing;

/// A soup as one mesh in which coincident borders are sewn: what `simplify` works on, and the way back.
///
/// Vertices at one position become one vertex when that keeps every edge manifold and oriented; where it does
/// not, they stay apart, as twins, which never move. Edges across which a vertex number, a texture coordinate
/// or a group changes are lines: vertices move along them only, and both sides move together, so that no gap
/// can open.
///
/// Every face knows for each of its corners which corner of the soup it now is. A collapse gives a moved
/// corner that of the vertex it merges with, in the contracted face on the same side of the lines, so every
/// attribute of the result is one of the input's at that position and on that side.
///
/// An obstacle may lie beside the soup: triangles that are in the mesh, do not change, and are not in the
/// result. Nothing of the soup is sewn to it: where the soup lies along an obstacle it has the border that it
/// has alone, and where both have a position its vertices are twins of the obstacle's. The shares of the
/// diagonal in the limits are of the soup's own.
class Working_mesh : public No_observer
{
public:
  using Mesh = CGAL::Surface_mesh<Point_3>;

  /// `positions[v]` numbers the position of vertex v: what is equal is welded. `is_frozen[t]`: the vertices
  /// of triangle t do not move. In both, as in the faces of the mesh, vertices and triangles of the obstacle
  /// follow those of the soup; of the obstacle only these count, and all its triangles are frozen. The points
  /// of the mesh are those of both, divided by the scale; the result has them as they were.
  ///
  /// **Preconditions** No triangle has two corners at one position. The soup outlives the mesh.
  ///
  /// **Complexity** O(n log n).
  Working_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
               const std::vector<char>& is_frozen, const Triangle_soup& obstacle = {},
               const Scale& scale = Scale());

  /// Makes a mesh of some faces of another, so that a part of that can be reduced apart: its face i is
  /// `faces[i]` there.
  ///
  /// **Guarantees** It decides nothing anew:
  /// 1. Two faces have an edge in common exactly where they have it in the whole. A vertex of the whole all
  /// of whose faces are here has them here, in the same order. Of any other vertex, what is left is locked,
  /// and is several vertices where it does not hang together.
  /// 2. The rule of the whole says which other vertices are locked, and which edges are lines.
  /// 3. Points, corners of the soup, weights, and texture are those of the whole.
  ///
  /// What concerns the soup, `result` and counts by its parts, is asked of the whole.
  ///
  /// **Preconditions** `faces` ascend; nothing has been collapsed in `whole`, whose soup outlives this mesh.
  ///
  /// **Complexity** O(n log n) for n faces of the part.
  Working_mesh(const Working_mesh& whole, const Border_rule<Mesh>& rule, const std::vector<Index>& faces);

  Mesh& mesh() { return m_mesh; }
  const Mesh& mesh() const { return m_mesh; }
  Simplify_constraints<Mesh>& constraints() { return m_constraints; }
  const Simplify_constraints<Mesh>& constraints() const { return m_constraints; }
  const Welding_notes& notes() const { return m_notes; }

  /// Weighs vertices by numbers that the vertices of the soup have; where several are sewn, by the largest of
  /// theirs.
  void weigh(const std::vector<double>& weights);

  /// From now on `uv_cost` says how far the texture is displaced; it is 0 before, and where there is no
  /// texture. Weights that are to count are set before. `unit` is the `uv_unit` of the soup at the scale.
  void measure_uvs(double unit);

  /// From now on refusals are counted by the parts of the soup to which the moving vertex belongs.
  void count_refusals(std::vector<Part_kind> kinds);

  /// What was refused so far, for each kind and each of its parts.
  const std::vector<std::vector<Refusals>>& refused_by_part() const { return m_refused; }

  /// Who is told of every collapse, as `Simplify_options::on_collapse` is.
  void tell(std::function<void(std::size_t removed, std::size_t kept)> listener)
  {
    m_listener = std::move(listener);
  }

  /// Names a halfedge so that it is found again in another mesh made of the same triangles, when the same
  /// collapses have been done to both.
  struct Side
  {
    Index triangle;      ///< of a face beside it
    unsigned char place; ///< of the corner from which that face's halfedge comes
    bool is_beyond;      ///< it is the opposite of that halfedge
  };
  Side side(Mesh::Halfedge_index h) const;

  /// Throws `std::logic_error` when there is no such side, because the face is gone, say.
  Mesh::Halfedge_index halfedge(const Side& side) const;

  /// Who is told of every collapse by the halfedge that moves, before it.
  void record(std::function<void(const Side& moving)> recorder) { m_recorder = std::move(recorder); }

  // Called by `simplify`, as an observer.
  void before_collapse(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule);
  void on_refused(Mesh::Halfedge_index moving, const Refusals& refusals);
  bool keeps_pieces(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const;
  bool keeps_uv_orientation(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule) const;
  double uv_cost(Mesh::Halfedge_index moving) const;

  /// What is left: which triangles of the soup, in their order, and which of its corners each now has.
  struct Result
  {
    Triangle_soup soup;
    std::vector<Index> triangles;
    std::vector<Index_triple> corners; ///< each 3 × triangle + place in it
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
  bool is_own(Mesh::Face_index face) const { return std::size_t(face) < m_corners.size(); }
  bool is_line(Corner a, Corner b) const;

  /// The corner at the target of a halfedge of the face beside it.
  Corner corner_at(Mesh::Halfedge_index h) const { return m_corners[m_mesh.face(h)][m_places[h]]; }

  /// Of the face beside a halfedge of a motion, the halfedges to the source and to the target of the motion.
  std::pair<Mesh::Halfedge_index, Mesh::Halfedge_index> halfedges_to_ends(Mesh::Halfedge_index moving,
                                                                          Mesh::Halfedge_index side) const
  {
    const Mesh::Halfedge_index before = m_mesh.prev(side);
    return side == moving ? std::make_pair(before, side) : std::make_pair(side, before);
  }

  template <class Function>
  std::vector<Mesh::Halfedge_index> make_mesh(const Sewing& sewing, const Function& point_of);
  void lock(const std::vector<char>& is_locked);
  template <class Function>
  void for_each_changed_face(Mesh::Halfedge_index moving, const Border_rule<Mesh>& rule,
                             const Function& function) const;
  template <class Function>
  void for_each_moved_wedge(Mesh::Halfedge_index moving, const Function& function) const;

  Index& wedge_at(Mesh::Halfedge_index h) { return m_wedge_numbers[m_mesh.face(h)][m_places[h]]; }
  Index wedge_at(Mesh::Halfedge_index h) const { return m_wedge_numbers[m_mesh.face(h)][m_places[h]]; }
  std::vector<Mesh::Vertex_index> number_wedges();
  Uv_quadric::Vector relative(const Point_3& point) const;
  Uv relative(const Uv& uv) const;

  const Triangle_soup& m_soup;
  Scale m_scale;
  Mesh m_mesh;
  std::vector<Index_triple> m_corners; // by face, which has the number of its triangle
  std::vector<unsigned char> m_places; // by halfedge that is no border: at its target, in its face's corners
  Simplify_constraints<Mesh> m_constraints;
  Welding_notes m_notes;
  std::function<void(std::size_t removed, std::size_t kept)> m_listener;
  std::function<void(const Side&)> m_recorder;

  // The corners at a vertex between two lines.
  struct Wedge
  {
    Uv_quadric quadric;
    Uv uv;
    double own_cost; // what the quadric says of where the wedge is
    bool is_alone;   // at its vertex: lines neither come nor go
  };
  std::vector<Index_triple> m_wedge_numbers; // by face, for each of its corners
  std::vector<Wedge> m_wedges;
  Uv_quadric::Vector m_origin{};
  Uv m_uv_origin{};
  double m_uv_unit = 0; // in units of the mesh

  std::vector<Part_kind> m_kinds;
  std::vector<std::vector<Refusals>> m_refused;
};

/// Numbers positions: vertices with equal coordinates (−0 is 0) get the number of the first of them.
std::vector<Index> number_positions(const std::vector<Point_3>& points);

} // namespace selvedge

#endif // SELVEDGE_MESH_WORKING_MESH_H
