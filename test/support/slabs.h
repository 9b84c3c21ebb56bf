// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SLABS_H
#define SELVEDGE_TEST_SLABS_H

#include <selvedge/spatial/Slab_box.h>

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace selvedge::test {

/// The least and the largest `normal` · (x − `origin`) of the points x of a box, exactly.
inline std::array<CGAL::Exact_rational, 2> range_along(const Slab_box& slab, const CGAL::Bbox_3& box)
{
  std::array<CGAL::Exact_rational, 2> range{0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    const CGAL::Exact_rational normal(slab.normal[axis]), origin(slab.origin[axis]);
    const CGAL::Exact_rational a = normal * (CGAL::Exact_rational((box.min)(axis)) - origin),
                               b = normal * (CGAL::Exact_rational((box.max)(axis)) - origin);
    range[0] += (std::min)(a, b);
    range[1] += (std::max)(a, b);
  }
  return range;
}

inline bool is_outside(const Slab_box& slab, const CGAL::Bbox_3& box)
{
  const auto [least, largest] = range_along(slab, box);
  return (std::isfinite(slab.upper) && least > CGAL::Exact_rational(slab.upper)) ||
         (std::isfinite(slab.lower) && largest < CGAL::Exact_rational(slab.lower));
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SLABS_H
