// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_PLACED_VERTICES_H
#define SELVEDGE_SOUP_PLACED_VERTICES_H

#include "Corner_mesh.h"
#include "Vertex_values.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge {

/// The vertices at new places, with the values that they have there.
///
/// Where a collapse puts the merged vertex to a new place (`Placement::optimal`), the vertex has the number
/// and the corners of the end that was nearer, and its own values: those that the surface around both ends
/// has at the point nearest to this place, by barycentric coordinates (`Vertex_values` says of what). Only
/// vertices on no line are placed so; all their corners have the same values.
///
/// **Preconditions** The mesh outlives the object.
class Placed_vertices
{
public:
  using Halfedge = Corner_mesh::Halfedge;
  using Uv = std::array<double, 2>;

  /// Makes an object without placed vertices. `values`, of the soup, may be null when none is placed later.
  explicit Placed_vertices(const Corner_mesh& corners, std::shared_ptr<const Vertex_values> values = nullptr)
      : m_corners(corners), m_values(std::move(values))
  {
  }

  const std::shared_ptr<const Vertex_values>& values() const { return m_values; }
  void set_values(std::shared_ptr<const Vertex_values> values) { m_values = std::move(values); }

  /// The texture coordinates of a corner as they are now. The soup must have some.
  Uv uv_at(Index corner) const;

  /// Those that the vertex of both ends of an edge would have at a place.
  Uv uv_at(Halfedge moving, const Point_3& place) const;

  /// The normal of a corner as it is now. The soup must have some.
  std::array<double, 3> normal_at(Index corner) const;

  /// Places the vertex of both ends of an edge, before they merge. `point` is the place in the unit of the
  /// soup.
  void merge_at(Halfedge moving, const Point_3& place, const Point_3& point);

  bool has_any() const { return !m_placed.empty(); } ///< or has had some

  /// Forgets a vertex of the soup, of which no corner is left.
  void erase(Index vertex)
  {
    if (has_any())
      m_placed[vertex].reset();
  }

  /// Puts the vertices into a soup that was selected from that of the mesh, whose triangles have these
  /// corners. Returns which of its vertices they are, nothing if there are none.
  std::vector<char> put(const std::vector<Index_triple>& corners, Triangle_soup& result) const;

private:
  struct Placed_vertex
  {
    Point_3 point; // in the unit of the soup
    Vertex_values::Numbers values;
  };
  struct Mixture
  {
    Vertex_values::Shares shares;
    Vertex_values::Share own; // of the end that is kept
  };
  // The mixture that was asked for last: that of a collapse is asked for when it is judged and when it is
  // done.
  struct Last_mixture
  {
    Halfedge moving;
    Point_3 place;
    std::size_t collapse_count; // of the mesh at that time
    Mixture mixture;
  };
  const Mixture& mixture_at(Halfedge moving, const Point_3& place) const;
  Mixture computed_mixture_at(Halfedge moving, const Point_3& place) const;
  Vertex_values::Share share(Index corner, double weight) const;
  const Placed_vertex* find(Index corner) const;

  const Corner_mesh& m_corners;
  std::shared_ptr<const Vertex_values> m_values;
  std::vector<std::unique_ptr<Placed_vertex>> m_placed; // by vertex of the soup; empty until one is placed
  mutable std::optional<Last_mixture> m_last;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_PLACED_VERTICES_H
