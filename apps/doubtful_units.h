// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_DOUBTFUL_UNITS_H
#define SELVEDGE_APPS_DOUBTFUL_UNITS_H

#include "text.h"

#include <selvedge/Surface_mesh_simplification/internal/mesh_diagonal.h>
#include <selvedge/Triangle_soup.h>

#include <CGAL/Bbox_3.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace selvedge::app {

inline CGAL::Bbox_3 box_of(const std::vector<Point_3>& points, const std::vector<Index_triple>& triangles)
{
  CGAL::Bbox_3 box;
  for (const Index_triple& triangle : triangles)
    for (const Index v : triangle)
      box += points[v].bbox();
  return box;
}

/// Returns what suggests that something is in another unit than the mesh; else nothing.
inline std::string doubt_of_unit(const CGAL::Bbox_3& of_mesh, const CGAL::Bbox_3& of_other)
{
  // Metres and centimetres differ by 100, and a body is not much larger than what it wears.
  constexpr double doubtful = 30, countable = 1e15;
  const double own = internal::diagonal_of(of_mesh), other = internal::diagonal_of(of_other);
  const double larger = other / own, smaller = own / other;
  const auto times = [](double ratio) { return with_commas(static_cast<std::size_t>(std::round(ratio))); };
  if (larger >= doubtful && larger < countable)
    return times(larger) + " times as large as the mesh; is one of the two in another unit?";
  if (smaller >= doubtful && smaller < countable)
    return times(smaller) + " times smaller than the mesh; is one of the two in another unit?";
  return {};
}

/// Returns what suggests that an obstacle is in another unit or place than the mesh; else nothing.
inline std::string doubt_of_obstacle(const Triangle_soup& mesh, const Triangle_soup& obstacle)
{
  const CGAL::Bbox_3 of_mesh = box_of(mesh.points, mesh.triangles),
                     of_obstacle = box_of(obstacle.points, obstacle.triangles);
  const std::string doubt = doubt_of_unit(of_mesh, of_obstacle);
  if (doubt.empty() && mesh.poses.empty() && !CGAL::do_overlap(of_mesh, of_obstacle))
    return "away from the mesh (their boxes are apart); is one of the two in another unit or place?";
  return doubt;
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_DOUBTFUL_UNITS_H
