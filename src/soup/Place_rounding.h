// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_PLACE_ROUNDING_H
#define SELVEDGE_SOUP_PLACE_ROUNDING_H

#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/internal/Scale.h>

#include <functional>
#include <utility>

namespace selvedge {

/// Rounds new places of vertices to those that the result can store.
///
/// Multiplied by the scale, the coordinates of a place are doubles without loss, and 32-bit floats when
/// `is_float32`. They have no more digits than such floats also where all coordinates of the soup have no
/// more. A place of a vertex from glTF is, unless `is_float32`, the world position of 32-bit floats in its
/// node. Where the scale does not allow that, because the mesh is too large or too small for the type of
/// number, there are no new places.
///
/// **Preconditions** The soup outlives the object.
class Place_rounding
{
public:
  Place_rounding(const Triangle_soup& soup, const Scale& scale, bool is_float32);

  /// Restricts places to those for which `is_allowed` returns true.
  void restrict(std::function<bool(const Point_3&)> is_allowed) { m_is_allowed = std::move(is_allowed); }

  /// Whether places depend on the vertex.
  bool is_by_vertex() const { return m_are_places_in_scene; }

  /// Returns the place at which a vertex of the soup will be stored, at the scale, or none. It does not ask
  /// for the vertex unless places depend on it.
  internal::Optional<Point_3> operator()(const Point_3& place, Index vertex) const;

private:
  const Triangle_soup& m_soup;
  Scale m_scale;
  bool m_are_places_in_scene, m_have_float32_digits, m_is_scale_lossless;
  std::function<bool(const Point_3&)> m_is_allowed;
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_PLACE_ROUNDING_H
