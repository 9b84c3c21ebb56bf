// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_VALUE_WEDGES_H
#define SELVEDGE_SOUP_VALUE_WEDGES_H

#include "Corner_mesh.h"
#include "Wedge_table.h"

#include <selvedge/Surface_mesh_simplification/Simplify_constraints.h>
#include <selvedge/Surface_mesh_simplification/internal/Value_quadric.h>
#include <selvedge/internal/Scale.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace selvedge {

/// The values that the wedges of a mesh have, two numbers for the texture or three for normals, and how far
/// those of the surface beside a wedge are displaced when it moves.
///
/// **Preconditions** The mesh outlives the object, the members of which are called before every collapse.
template <std::size_t dimension>
class Value_wedges
{
public:
  using Mesh = Corner_mesh::Mesh;
  using Halfedge = Corner_mesh::Halfedge;
  using Quadric = Value_quadric<dimension>;
  using Vector = typename Quadric::Vector;
  using Value = typename Quadric::Value;

  /// Measures a texture, in which `unit` is the `uv_unit` of the soup at the scale, or normals, in which it
  /// is the `normal_unit`. The constraints say which edges are lines, and weigh the vertices. The values are
  /// those of the corners of the soup, or `of_vertices`, by vertex of the soup.
  ///
  /// **Preconditions** Nothing has been collapsed, and every corner of the soup has a value.
  Value_wedges(const Corner_mesh& corners, const Scale& scale, const Simplify_constraints<Mesh>& constraints,
               double unit, const std::vector<Value>* of_vertices = nullptr);

  /// Returns by how much a motion displaces the values, see `No_observer::uv_cost`.
  double cost(Halfedge moving) const;

  /// Returns the same for the motions of both ends of an edge to a place.
  double cost_at(Halfedge edge, const Point_3& place) const;

  /// Adds what the wedges that move know to those at the goal.
  void merge(Halfedge moving);

  /// Adds up what the wedges at both ends know, and moves them to a place with a value, in no unit. Without
  /// one, they get that for which the displacement is least.
  void merge_at(Halfedge moving, const Point_3& place, const std::optional<Value>& of_soup);

private:
  struct Wedge
  {
    Quadric quadric; // its origin is the wedge
    Index value;     // its number among those of the soup or, after these, among the new ones
  };

  Value_wedges(const Corner_mesh& corners, const Wedge_numbers& numbers, const Scale& scale,
               const Simplify_constraints<Mesh>& constraints, double unit,
               const std::vector<Value>* of_vertices);

  const Mesh& mesh() const { return m_corners.mesh(); }
  template <class Function>
  void for_each_moved_wedge(Halfedge moving, const Function& function) const;
  Vector motion(Mesh::Vertex_index v, const Point_3& place) const;
  Vector along(Halfedge h) const;
  Value at_unit(Value value) const
  {
    for (double& x : value)
      x *= m_unit;
    return value;
  }
  const Corner_values<dimension>& of_corners() const
  {
    if constexpr (dimension == 2)
      return m_corners.soup().uvs;
    else
      return m_corners.soup().normals;
  }
  Value value(Index number) const
  {
    return number < m_values.size() ? at_unit(m_values[number]) : m_new_values[number - m_values.size()];
  }
  static Value motion_between(const Value& from, const Value& to)
  {
    Value result;
    for (std::size_t k = 0; k < dimension; ++k)
      result[k] = to[k] - from[k];
    return result;
  }
  Value value_motion(const Wedge& from, const Wedge& to) const
  {
    return motion_between(value(from.value), value(to.value));
  }

  const Corner_mesh& m_corners;
  double m_unit;
  const std::vector<Value>& m_values; // of the soup, in no unit
  std::vector<Value> m_new_values;    // of wedges at new places
  Wedge_table m_table;
  std::vector<Wedge> m_wedges;
};

using Texture_wedges = Value_wedges<2>;
using Shading_wedges = Value_wedges<3>;

} // namespace selvedge

#endif // SELVEDGE_SOUP_VALUE_WEDGES_H
