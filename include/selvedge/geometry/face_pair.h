// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GEOMETRY_FACE_PAIR_H
#define SELVEDGE_GEOMETRY_FACE_PAIR_H

#include <selvedge/internal/exact_predicates.h>

#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/Point_3.h>
#include <CGAL/enum.h>

#include <array>
#include <cstddef>
#include <utility>

namespace selvedge {

/// Decides whether two faces that stand still offend: they meet in more than the simplex that their common
/// positions span (nothing, a point, or an edge), or have the same three positions.
///
/// **Preconditions**: the corners of each face are distinct positions, and those of `face` are not collinear.
/// `other` may be collinear; it is judged as the segment that it is.
///
/// **Exactness**: the answer is exact for every kernel with exact predicates; nothing is constructed.
///
/// **Complexity**: constant.
template <class Kernel>
bool do_faces_offend(std::array<CGAL::Point_3<Kernel>, 3> face, std::array<CGAL::Point_3<Kernel>, 3> other,
                     const Kernel& kernel = Kernel())
{
  internal::require_exact_predicates<Kernel>();
  const auto orientation = kernel.orientation_3_object();
  const auto planar_orientation = kernel.coplanar_orientation_3_object();
  const auto do_intersect = kernel.do_intersect_3_object();
  const auto triangle = kernel.construct_triangle_3_object();
  const auto segment = kernel.construct_segment_3_object();

  // Common positions come first in both.
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = shared; j < 3; ++j)
      if (kernel.equal_3_object()(face[i], other[j])) {
        std::swap(face[i], face[shared]);
        std::swap(other[j], other[shared]);
        ++shared;
        break;
      }
  const auto &a = face[0], &b = face[1], &c = face[2]; // C++17 lets no lambda use structured bindings
  const auto& [p, q, r] = other;
  if (shared == 3)
    return true;
  // Beyond a common edge they meet where both lie on one side of it in one plane. A collinear face lies on
  // the line of that edge, which has no other point of the proper face.
  if (shared == 2)
    return orientation(a, b, c, r) == CGAL::COPLANAR &&
           planar_orientation(a, b, c) == planar_orientation(a, b, r);

  const bool is_proper = !kernel.collinear_3_object()(p, q, r);
  if (shared == 1) {
    // A ray from the common corner lies in both. Where it first leaves one of them, it crosses the side of
    // that one opposite to the corner, within the other.
    if (is_proper)
      return do_intersect(triangle(a, b, c), segment(q, r)) || do_intersect(triangle(p, q, r), segment(b, c));
    const auto turn = planar_orientation(a, b, c);
    const auto is_ray_in_face = [&](const CGAL::Point_3<Kernel>& end) {
      return orientation(a, b, c, end) == CGAL::COPLANAR && planar_orientation(a, b, end) != -turn &&
             planar_orientation(a, end, c) != -turn;
    };
    return is_ray_in_face(q) || is_ray_in_face(r);
  }
  if (is_proper)
    return do_intersect(triangle(a, b, c), triangle(p, q, r));
  return do_intersect(triangle(a, b, c), segment(p, q)) || do_intersect(triangle(a, b, c), segment(q, r));
}

} // namespace selvedge

#endif // SELVEDGE_GEOMETRY_FACE_PAIR_H
