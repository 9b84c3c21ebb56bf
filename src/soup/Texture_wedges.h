// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_TEXTURE_WEDGES_H
#define SELVEDGE_SOUP_TEXTURE_WEDGES_H

#include "Corner_mesh.h"

#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/internal/Uv_quadric.h>
#include <selvedge/internal/Scale.h>

#include <vector>

namespace selvedge {

/// The wedges of a mesh in its texture: where each is, and how far the texture is displaced when it moves.
///
/// **Preconditions** The mesh outlives the object, which is told of every collapse before it is done.
class Texture_wedges
{
public:
  using Mesh = Corner_mesh::Mesh;
  using Halfedge = Corner_mesh::Halfedge;
  using Uv = Uv_quadric::Uv;

  /// Measures a texture, in which `unit` is the `uv_unit` of the soup at the scale. The constraints say which
  /// edges are lines, and weigh the vertices.
  ///
  /// **Preconditions** Nothing has been collapsed, and the soup has a texture.
  Texture_wedges(const Corner_mesh& corners, const Scale& scale,
                 const Simplify_constraints<Mesh>& constraints, double unit);

  double unit() const { return m_unit; }

  /// Returns by how much a motion displaces the texture, see `No_observer::uv_cost`.
  double cost(Halfedge moving) const;

  /// Returns the same for the motions of both ends of an edge to a place.
  double cost_at(Halfedge edge, const Point_3& place) const;

  /// Adds what the wedges that move know to those at the goal.
  void merge(Halfedge moving);

  /// Adds up what the wedges at both ends know, and moves them to a place with its own texture coordinates.
  void merge_at(Halfedge moving, const Point_3& place, const Uv& uv_of_soup);

  /// Puts the corner at the target of h into the wedge at the target of `from`.
  void carry(Halfedge h, Halfedge from) { number_at(h) = number_at(from); }

private:
  struct Wedge
  {
    Uv_quadric quadric; // its origin is the wedge
    Uv uv;
    bool is_alone; // the only wedge at its vertex, and stays so: lines neither begin nor end later

    Uv uv_motion(const Uv& to) const { return {to[0] - uv[0], to[1] - uv[1]}; }
  };

  const Mesh& mesh() const { return m_corners.mesh(); }
  Index& number_at(Halfedge h) { return m_numbers[mesh().face(h)][m_corners.place(h)]; }
  Index number_at(Halfedge h) const { return m_numbers[mesh().face(h)][m_corners.place(h)]; }
  template <class Function>
  void for_each_moved_wedge(Halfedge moving, const Function& function) const;
  Uv_quadric::Vector motion(Mesh::Vertex_index v, const Point_3& place) const;
  Uv_quadric::Vector along(Halfedge h) const;
  Uv at_unit(const Uv& uv) const { return {uv[0] * m_unit, uv[1] * m_unit}; }

  const Corner_mesh& m_corners;
  double m_unit;
  std::vector<Index_triple> m_numbers; // of wedges: by face, for each of its corners
  std::vector<Wedge> m_wedges;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_TEXTURE_WEDGES_H
