// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_SHARED_PLACES_H
#define SELVEDGE_SOUP_SHARED_PLACES_H

#include "Corner_mesh.h"
#include "shared_meshes.h"

#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge {

/// The places of shared meshes, which are reduced alike: a motion in one place has companions in all others.
///
/// **Preconditions** The mesh outlives the object.
class Shared_places
{
public:
  using Mesh = Corner_mesh::Mesh;
  using Halfedge = Corner_mesh::Halfedge;
  using Face = Corner_mesh::Face;

  /// Finds the faces of the mesh in each place. Motions in places no farther from each other than
  /// `clearance`, in the unit of the mesh, are not apart.
  ///
  /// **Preconditions** Nothing has been collapsed.
  Shared_places(const Corner_mesh& corners, std::vector<Shared_mesh> meshes, double clearance);

  /// Locks in all places what is locked in one. Where the faces of a mesh are not joined alike in all places,
  /// because something is sewn to them in some, vertices are locked, too, and so are those that would have to
  /// move with others at their positions. Returns, for every vertex of the soup, whether only another place
  /// locks it.
  std::vector<char> lock_in_all_places(Simplify_constraints<Mesh>& constraints) const;

  bool is_shared(Face face) const
  {
    return std::size_t(face) < m_copies.size() && m_copies[face].mesh != s_no_mesh;
  }

  /// Returns whether an edge collapses only as a companion: it is in any place of its mesh but the first.
  bool is_led(Halfedge edge) const;

  /// Returns the same motion in all other places of its mesh.
  std::vector<Halfedge> companions(Halfedge moving) const;

  /// Returns whether the boxes around the stars of a motion and its companions are disjoint.
  bool are_apart(Halfedge moving, const std::vector<Halfedge>& companions) const;

private:
  // What a face is in a shared mesh.
  struct Copy
  {
    Index mesh, place, row;
  };
  static constexpr Index s_no_mesh = Index(-1);

  const Mesh& mesh() const { return m_corners.mesh(); }
  bool is_flipped(Index face) const;
  Corner_mesh::Side in_place(const Corner_mesh::Side& side, Index place) const;
  bool is_sewn_inside(Halfedge h) const;
  void lock_joint_vertices(Simplify_constraints<Mesh>& constraints) const;

  const Corner_mesh& m_corners;
  std::vector<Shared_mesh> m_meshes; // with faces in place of triangles, the null face for doubles
  std::vector<std::vector<std::pair<Index, Index>>> m_near_places; // by mesh: their boxes meet
  double m_clearance;                                              // between the boxes of companions
  std::vector<Copy> m_copies;                                      // by face
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_SHARED_PLACES_H
