// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_SEWN_MESH_H
#define SELVEDGE_SOUP_SEWN_MESH_H

#include "Corner_mesh.h"

#include <selvedge/Sewing_notes.h>
#include <selvedge/Surface_mesh_simplification/Border_rule.h>
#include <selvedge/Surface_mesh_simplification/Hindrances.h>
#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/internal/Scale.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge {

/// A soup as one mesh in which coincident borders are sewn, with what is locked in it and what is a line.
///
/// Vertices at one position become one vertex when that keeps every edge manifold and oriented. Where it does
/// not, they stay separate, as coincident vertices. These move together along a line where several sheets
/// meet, one on each sheet, and nowhere else. Edges across which a vertex number, a texture coordinate, a
/// normal, a group, an object or a material changes are lines: vertices on a line move only along it, and
/// both sides move together, so that no gap can open. An edge is a line also where the doubles of its two
/// faces are not as many, run other ways, or differ as faces may.
///
/// An obstacle may lie beside the soup: triangles that are in the mesh, do not change, and are not in the
/// result. Nothing of the soup is sewn to it. Where the soup lies along an obstacle, it has the same border
/// as without it; where both have a vertex at one position, the two are coincident vertices. Limits that are
/// shares of a diagonal refer to the diagonal of the soup alone.
class Sewn_mesh : public Corner_mesh
{
public:
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
  Sewn_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
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
  /// 3. Points, corners of the soup, and weights are those of the whole.
  ///
  /// Reasons for locks are asked of the whole only.
  ///
  /// **Preconditions** `faces` are in ascending order. Nothing has been collapsed in `whole`, whose soup
  /// outlives this mesh.
  ///
  /// **Complexity** O(n log n) for n faces of the part.
  Sewn_mesh(const Sewn_mesh& whole, const Border_rule<Mesh>& rule, const std::vector<Index>& faces);

  Simplify_constraints<Mesh>& constraints() { return m_constraints; }
  const Simplify_constraints<Mesh>& constraints() const { return m_constraints; }
  const Sewing_notes& notes() const { return m_notes; }

  /// The number of faces, without those of the obstacle; doubles are none.
  std::size_t face_count() const { return mesh().number_of_faces() - m_constraints.uncounted_faces.size(); }

  /// Locks vertices of the soup because the user wants it so, and all others at their positions, which
  /// `positions` numbers as the constructor's does. Throws `Argument_error` for a vertex that the soup does
  /// not have.
  void lock_by_wish(const std::vector<Index>& vertices, const std::vector<Index>& positions);

  /// Weighs the vertices by `weights` of the vertices of the soup. A vertex to which several are sewn gets
  /// the largest of their weights.
  void weigh(const std::vector<double>& weights);

  /// Returns for every vertex of the mesh one of the vertices from which it was made: its number in the soup
  /// or, after those, in the obstacle that the constructor was given.
  ///
  /// **Preconditions** Nothing has been collapsed.
  std::vector<Index> vertices_of_soup(const Triangle_soup& obstacle) const;

  /// The sides of the soup's triangles, 3 × triangle + place as they are turned, along which two faces face
  /// opposite ways.
  const std::vector<Index>& misoriented_sides() const { return m_misoriented_sides; }

  /// Returns why a locked vertex is locked.
  Hindrance lock_reason(Mesh::Vertex_index v) const;

  /// Returns why an edge is a line.
  Hindrance line_reason(Mesh::Edge_index e) const;

protected:
  /// Makes `companions` the reason for which vertices of the soup are locked.
  void set_held_elsewhere(std::vector<char> vertices) { m_is_held_elsewhere = std::move(vertices); }

private:
  char frozen(Face face) const { return m_is_frozen.empty() ? char(false) : m_is_frozen[face]; }
  std::vector<Index_triple> add_faces(const std::vector<Index>& positions, const std::vector<char>& is_frozen,
                                      const Triangle_soup& obstacle);
  void note_vertices(const std::vector<Index>& positions);
  void lock(const std::vector<char>& is_locked);
  void find_misoriented(const Sewing& sewing);
  void find_lines(const Sewing& sewing, const std::vector<Halfedge>& halfedges);
  void find_locked(const Sewing& sewing, const std::vector<Index>& position_of,
                   const std::vector<Index>& vertices_at);
  void find_spokes();
  void find_joint_vertices(std::vector<char>& is_locked, const std::vector<char>& is_in_frozen_face,
                           const std::vector<Index>& vertices_at, const std::vector<Index>& position_of);
  void find_no_strip_vertices(const std::vector<Index>& position_of);

  std::vector<char> m_is_frozen;         // by face: as given, of one of its plies; or empty
  std::vector<char> m_is_wished;         // by vertex: locked because the user wants it so; or empty
  std::vector<char> m_is_misoriented;    // by vertex of the soup: at such a side; or empty
  std::vector<char> m_is_held_elsewhere; // by vertex of the soup: only another place locks it; or empty
  std::vector<Index> m_misoriented_sides;
  Simplify_constraints<Mesh> m_constraints;
  Sewing_notes m_notes;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_SEWN_MESH_H
