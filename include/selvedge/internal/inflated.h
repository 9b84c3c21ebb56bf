// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INTERNAL_INFLATED_H
#define SELVEDGE_INTERNAL_INFLATED_H

#include <CGAL/Bbox_3.h>

#include <cmath>
#include <limits>

namespace selvedge {
namespace internal {

/// Returns a box with room for every point at a distance of at most `distance` from a box: rounding makes it
/// larger. At the distance 0, it is the same box.
inline CGAL::Bbox_3 inflated(const CGAL::Bbox_3& box, double distance)
{
  if (distance == 0)
    return box;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto below = [=](double x) { return std::nextafter(x - distance, -infinity); };
  const auto above = [=](double x) { return std::nextafter(x + distance, infinity); };
  return {below(box.xmin()), below(box.ymin()), below(box.zmin()),
          above(box.xmax()), above(box.ymax()), above(box.zmax())};
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_INTERNAL_INFLATED_H
