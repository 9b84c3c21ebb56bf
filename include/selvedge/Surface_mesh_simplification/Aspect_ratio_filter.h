// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_ASPECT_RATIO_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_ASPECT_RATIO_FILTER_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_type_basic.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>

namespace selvedge {

/// Returns the aspect ratio of a triangle: the height on its longest edge, divided by the length of that edge
/// and scaled so that the equilateral triangle has 1 and a degenerate one 0. Computed in floating point.
template <class Point>
double aspect_ratio(const Point& a, const Point& b, const Point& c)
{
  const double longest = (std::max)({CGAL::to_double(CGAL::squared_distance(a, b)),
                                     CGAL::to_double(CGAL::squared_distance(b, c)),
                                     CGAL::to_double(CGAL::squared_distance(c, a))});
  if (!(longest > 0))
    return 0;
  // Twice the area is height × longest edge.
  const double twice_area = std::sqrt(CGAL::to_double(CGAL::cross_product(b - a, c - a).squared_length()));
  return 2 / std::sqrt(3.0) * twice_area / longest;
}

namespace internal {

/// Judges the shape of every face.
struct No_face_exempt
{
  template <class Collapse, class Halfedge>
  bool operator()(const Collapse&, const Halfedge&) const
  {
    return false;
  }
};

} // namespace internal

/// Refuses a collapse after which the worst of the changed faces has an aspect ratio below a limit, unless
/// that ratio is better than the worst of these faces had before. A face for which `is_exempt(collapse, h)`
/// is true, h being its halfedge to the vertex that moves, may have any afterwards.
///
/// A model of CGAL's concept `PlacementFilter`, usable with any placement.
///
/// **Exactness** Floating point: the filter limits quality; no statement about intersections rests on it.
///
/// **Reference** Derichs, Misiak, Fuhrmann, section 3.1 (with the limit 0.2).
template <class BaseFilter = No_filter, class IsExempt = internal::No_face_exempt>
class Aspect_ratio_filter
    : public internal::Filter_base<Aspect_ratio_filter<BaseFilter, IsExempt>, BaseFilter>
{
public:
  /// `min_aspect_ratio` lies in [0, 1], or `Argument_error` is thrown; 0 accepts everything.
  explicit Aspect_ratio_filter(double min_aspect_ratio = 0.05, const BaseFilter& base = {},
                               const IsExempt& is_exempt = {})
      : internal::Filter_base<Aspect_ratio_filter, BaseFilter>(base), m_min_aspect_ratio(min_aspect_ratio),
        m_is_exempt(is_exempt)
  {
    if (!(min_aspect_ratio >= 0 && min_aspect_ratio <= 1))
      throw Argument_error("the least aspect ratio lies between 0 and 1, that of the equilateral triangle");
  }

  template <class Collapse>
  bool accepts(const Collapse& collapse) const
  {
    using Point = typename Collapse::Point;
    const auto least = [&](bool is_after) {
      double ratio = 1;
      collapse.all_of_changed_faces(
          [&](const auto& h, const Point& before, const Point& after, const Point& a, const Point& b) {
            const double of_face = aspect_ratio(is_after ? after : before, a, b);
            if (of_face < ratio && !(is_after && m_is_exempt(collapse, h)))
              ratio = of_face;
            return true;
          });
      return ratio;
    };
    const double least_after = least(true);
    return least_after >= m_min_aspect_ratio || least_after > least(false);
  }

private:
  double m_min_aspect_ratio;
  IsExempt m_is_exempt;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_ASPECT_RATIO_FILTER_H
