// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_WORKING_MESH_H
#define SELVEDGE_MESH_WORKING_MESH_H

#include <selvedge/mesh/Triangle_soup.h>
#include <selvedge/mesh/Welding_notes.h>
#include <selvedge/mesh/selection.h>
#include <selvedge/simplify.h>

#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// A soup as one mesh in which coincident borders are sewn: what `simplify` works on, and the way back.
///
/// Vertices at one position become one vertex when that keeps every edge manifold and oriented; where it does not, they
/// stay apart, as twins, which never move. Edges across which a vertex number, a texture coordinate or a group
/// changes are lines: vertices move along them only, and both sides move together, so that no gap can open.
///
/// Every face knows for each of its corners which corner of the soup it now is. A collapse gives a moved corner that of
/// the vertex it merges with, in the contracted face on the same side of the lines, so every attribute of the
/// result is one of the input's at that position and on that side.
class Working_mesh
{
public:
  using Mesh = CGAL::Surface_mesh<Point_3>;

  /// `positions[v]` numbers the position of vertex v: what is equal is welded. `is_frozen[t]`: the vertices of
  /// triangle t do not move.
  ///
  /// **Preconditions** No triangle has two corners at one position. The soup outlives the mesh.
  ///
  /// **Complexity** O(n log n).
  Working_mesh(const Triangle_soup& soup, const std::vector<Index>& positions, const std::vector<char>& is_frozen);

  Mesh& mesh() { return m_mesh; }
  const Simplify_constraints<Mesh>& constraints() const { return m_constraints; }
  const Welding_notes& notes() const { return m_notes; }

  /// Moves corners; called by `simplify`, as an observer.
  void before_collapse(Mesh::Halfedge_index moving);

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

  Index vertex_of(Corner corner) const { return m_soup.triangles[corner / 3][corner % 3]; }
  Corner* find_corner(Mesh::Face_index face, Mesh::Vertex_index vertex);
  bool is_line(Corner a, Corner b) const;

  const Triangle_soup& m_soup;
  Mesh m_mesh;
  std::vector<Index_triple> m_corners;          // by face, which has the number of its triangle
  Simplify_constraints<Mesh> m_constraints;
  Welding_notes m_notes;
};

/// Numbers positions: vertices with equal coordinates (−0 is 0) get the number of the first of them.
std::vector<Index> number_positions(const std::vector<Point_3>& points);

} // namespace selvedge

#endif // SELVEDGE_MESH_WORKING_MESH_H
