// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_CORNER_MESH_H
#define SELVEDGE_SOUP_CORNER_MESH_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Packed_numbers.h>

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace selvedge {

class Sewing;

/// A mesh that knows for every corner of its faces which corner of a soup this now is.
///
/// A collapse gives a moved corner the corner at the vertex with which it merges, taken from the contracted
/// face on the same side of the lines. So every attribute of the result is one that the input has at that
/// position and on that side.
///
/// Several triangles with the same three positions, as of a double-sided mesh, are one face: the first of
/// them, their front, stands for all. The others are its doubles. They have corners of their own, which a
/// collapse moves alike. All of them are the plies of the face; any other face has one.
///
/// Faces that follow those of the soup belong to an obstacle and have no corners.
///
/// Faces, edges and vertices are numbered along a curve that fills space, so that what is near in the mesh is
/// mostly near in memory, whatever the order of the triangles.
class Corner_mesh
{
public:
  using Mesh = CGAL::Surface_mesh<Point_3>;
  using Halfedge = Mesh::Halfedge_index;
  using Face = Mesh::Face_index;
  using Corner = Index; ///< of the soup: 3 × triangle + place in it

  Corner_mesh(const Corner_mesh&) = delete;
  Corner_mesh& operator=(const Corner_mesh&) = delete;

  const Triangle_soup& soup() const { return m_soup; }
  Mesh& mesh() { return m_mesh; }
  const Mesh& mesh() const { return m_mesh; }

  Index vertex_of(Corner corner) const { return m_soup.triangles[corner / 3][corner % 3]; }
  const std::array<double, 2>& uv_of(Corner corner) const
  {
    return m_soup.uvs.values[m_soup.uvs.of_triangle[corner / 3][corner % 3]];
  }
  const std::array<double, 3>& normal_of(Corner corner) const
  {
    return m_soup.normals.values[m_soup.normals.of_triangle[corner / 3][corner % 3]];
  }

  bool has_face(Face face) const { return m_mesh.has_valid_index(face) && !m_mesh.is_removed(face); }
  bool is_own(Face face) const { return std::size_t(face) < own_face_count(); } ///< is none of an obstacle
  std::size_t own_face_count() const { return m_corners.size(); }               ///< with those that are gone
  bool is_turned(Face face) const { return !m_is_turned.empty() && m_is_turned[face]; }
  bool may_have_doubles() const { return !m_first_ply.empty(); }
  bool has_doubles(Face face) const
  {
    return !m_first_ply.empty() && is_own(face) && m_first_ply[face] < m_first_ply[face + 1];
  }
  Index ply_count(Face face) const
  {
    return has_doubles(face) ? m_first_ply[face + 1] - m_first_ply[face] : 1;
  }

  /// Returns whether all plies of a face have the same vertex of the soup at a place of it.
  bool have_plies_one_vertex(Face face, unsigned char place) const
  {
    for (Index i = 1; i < ply_count(face); ++i)
      if (vertex_of(corners(face, i)[place]) != vertex_of(corners(face)[place]))
        return false;
    return true;
  }

  /// The triangle of a ply. Triangles of an obstacle are numbered after those of the soup.
  Index triangle(Face face, Index i = 0) const
  {
    return has_doubles(face) ? ply(face, i).triangle : m_triangles[face];
  }

  /// The triangle from which the face was made: of its doubles, the first in the soup, which decides for what
  /// target they count. A face that was turned may have another as its first ply.
  Index front(Face face) const { return m_triangles[face]; }

  /// Returns the face of each triangle, of the soup and then of the obstacle; the null face for doubles. Some
  /// faces may be gone. **Precondition** This is no part of another mesh.
  std::vector<Face> faces_of_triangles() const;

  /// The number of collapses until now. What was computed from the mesh is still true where it is the same.
  std::size_t collapse_count() const { return m_collapse_count; }

  /// The place of the target of a halfedge among the corners of its face.
  unsigned char place(Halfedge h) const { return m_places[h]; }

  /// The corners that a ply has now, at the places of its face.
  const Index_triple& corners(Face face, Index i = 0) const
  {
    return i == 0 ? m_corners[face] : ply(face, i).corners;
  }

  /// The same in the order that the triangle of the ply has in the soup.
  Index_triple corners_in_soup(Face face, Index i) const;

  /// The halfedge itself, or its opposite where it is on a border: the one that has a face.
  Halfedge with_face(Halfedge h) const { return m_mesh.is_border(h) ? m_mesh.opposite(h) : h; }

  /// The corner that a ply of the face beside a halfedge has at the target of the halfedge.
  Corner corner_at(Halfedge h, Index i = 0) const { return corners(m_mesh.face(h), i)[m_places[h]]; }

  /// Returns the halfedges to the source and to the target of a motion, in the face beside `side`, which is
  /// `moving` or its opposite.
  std::pair<Halfedge, Halfedge> halfedges_to_ends(Halfedge moving, Halfedge side) const
  {
    const Halfedge before = m_mesh.prev(side);
    return side == moving ? std::make_pair(before, side) : std::make_pair(side, before);
  }

  /// Returns the vertices of the soup at both ends of a motion, in one face beside it.
  std::pair<Index, Index> ends_in_soup(Halfedge moving) const;

  /// Identifies a halfedge such that it is found again in another mesh of the same triangles, when the same
  /// collapses have been done to both.
  struct Side
  {
    Index face;          ///< the number of a face beside the edge
    unsigned char place; ///< at which corner of that face its halfedge of the edge begins
    bool is_beyond;      ///< whether the halfedge is the opposite of that one
  };
  Side side(Halfedge h) const;

  /// Returns the halfedge of a side. Throws `std::logic_error` when there is none, for instance because the
  /// face is gone.
  Halfedge halfedge(const Side& side) const;

  /// What differs across an edge, at either end of it, in the corners that its two faces have now.
  struct Differences
  {
    bool in_vertex = false, in_uv = false, in_normal = false, in_label = false;
    bool in_region = false;  ///< in a value of faces that is the same in large regions
    bool in_doubles = false; ///< in their number or directions

    bool any() const { return in_vertex || in_uv || in_normal || in_label || in_region || in_doubles; }
    Differences& operator|=(const Differences& other);
  };
  Differences differences(Mesh::Edge_index e) const;

  /// The same at the target of a halfedge inside the mesh alone; doubles are not looked at.
  Differences differences_at_target(Halfedge h) const;

  /// Calls function(h, from) for each face that a motion changes. The corner at the target of h, a halfedge
  /// of this face, becomes the corner at the target of `from`, a halfedge of a contracted face.
  template <class Rule, class Function>
  void for_each_changed_face(Halfedge moving, const Rule& rule, const Function& function) const;

  /// Calls function(h) for each face that changes when both ends of an edge inside the mesh move to one
  /// place. The corner that moves is at the target of h, a halfedge of this face.
  template <class Function>
  void for_each_changed_face(Halfedge moving, const Function& function) const;

protected:
  /// Gives the faces corners; they become a mesh when `build` is called. `triangles` has the triangle of each
  /// face, those of an obstacle last. The other arguments are those of `Sewn_mesh`.
  Corner_mesh(const Triangle_soup& soup, const std::vector<Index>& positions,
              const std::vector<char>& is_turned, const std::vector<Index>& fronts,
              const std::vector<Index>& triangles);

  /// Takes the corners of some faces of another mesh.
  Corner_mesh(const Corner_mesh& whole, const std::vector<Index>& faces);

  /// Makes vertices, edges in the order of the sides, and faces. Returns the halfedge of each side.
  std::vector<Halfedge> build(const Sewing& sewing, const std::function<Point_3(Index vertex)>& point_of);

  /// Finds the regions of triangles that attributes tell apart (`attributes_of_regions`), in the points of
  /// the soup, so that vertices which only rounding has brought together are one, as for a replay, though
  /// nothing is sewn there. Called once, of the whole mesh. Parts of this mesh have the same regions.
  void find_regions();

  /// Gives all plies at the target of h the corners that those beside `from` have at the target of `from`.
  void carry(Halfedge h, Halfedge from);

  /// Called before a collapse, for what it does to the edges of contracted faces.
  void carry_places(Halfedge moving);

private:
  struct Ply
  {
    Index triangle;
    Index_triple corners; // at the places of the face; of the first ply, they are in `m_corners`
    std::array<unsigned char, 3> places; // of these corners in the triangle

    bool is_against_face() const { return places[1] != (places[0] + 1) % 3; }
  };
  const Ply& ply(Face face, Index i) const { return m_plies[m_first_ply[face] + i]; }
  void find_plies(const std::vector<Index>& fronts, const std::vector<Index>& positions);
  Differences differences(Corner a, Corner b) const;

  const Triangle_soup& m_soup;
  Mesh m_mesh;
  internal::Packed_numbers m_triangles; // by face, its front
  std::vector<Index_triple> m_corners;  // by face
  std::vector<Ply> m_plies;             // by face, if it has doubles
  std::vector<Index> m_first_ply;       // by face, and one more; or empty
  std::vector<char> m_is_turned;        // by face, or empty
  std::vector<unsigned char> m_places;  // by halfedge that is no border
  std::size_t m_collapse_count = 0;
  std::shared_ptr<const std::vector<Index>> m_regions; // by triangle of the soup; or null
};

template <class Rule, class Function>
void Corner_mesh::for_each_changed_face(Halfedge moving, const Rule& rule, const Function& function) const
{
  // Walks from a contracted face, away from the other one, up to the next line. Returns whether it comes to
  // the other one without meeting a line. The rule is asked, because it knows more lines than corners show:
  // the corners on both sides of a line may become equal.
  const auto goes_all_the_way = [&](Halfedge from, Halfedge other, const auto& across) {
    if (m_mesh.is_border(from))
      return false;
    const Halfedge carried = halfedges_to_ends(moving, from).second;
    for (Halfedge h = across(from); m_mesh.face(h) != m_mesh.face(other); h = across(h)) {
      if (rule.is_line_at_target(from == moving ? m_mesh.opposite(h) : h))
        return false;
      function(from == moving ? m_mesh.prev(h) : h, carried);
    }
    return true;
  };
  const Halfedge back = m_mesh.opposite(moving);
  if (!goes_all_the_way(moving, back, [this](Halfedge h) { return m_mesh.opposite(m_mesh.prev(h)); }))
    goes_all_the_way(back, moving, [this](Halfedge h) { return m_mesh.opposite(m_mesh.next(h)); });
}

template <class Function>
void Corner_mesh::for_each_changed_face(Halfedge moving, const Function& function) const
{
  const Halfedge back = m_mesh.opposite(moving);
  for (const Halfedge end : {moving, back})
    for (const Halfedge h : m_mesh.halfedges_around_target(end))
      if (m_mesh.face(h) != m_mesh.face(moving) && m_mesh.face(h) != m_mesh.face(back))
        function(h);
}

} // namespace selvedge

#endif // SELVEDGE_SOUP_CORNER_MESH_H
