// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NORMAL_CHANGE_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NORMAL_CHANGE_FILTER_H

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_type_basic.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>

namespace selvedge {

/// Refuses a collapse that turns the normal of a face by more than a limit, unless the face is low.
///
/// A face is low where the corner that moves is near the line through the other two, before and after.
/// However far it turns, the surface hardly changes: so the ends of bevels, rims and small parts need not
/// keep faces.
///
/// A face whose normal cannot be computed before the collapse, because it is degenerate, may get any normal.
/// A collapse after which the normal of another face could not be computed is refused.
///
/// A model of CGAL's concept `PlacementFilter`, usable with any placement.
///
/// **Exactness** Floating point: the filter limits quality; no statement about intersections rests on it.
///
/// **Reference** Derichs, Misiak, Fuhrmann, section 3.1 and figure 3 (with a limit of 45°).
template <class BaseFilter = No_filter>
class Normal_change_filter : public internal::Filter_base<Normal_change_filter<BaseFilter>, BaseFilter>
{
public:
  /// `max_change` is an angle in degrees from 0 to 180, and `max_height`, in units of the mesh and at least
  /// 0, what a low face is nearer than, or `Argument_error` is thrown. With 0, no face is low.
  explicit Normal_change_filter(double max_change = 45, const BaseFilter& base = {}, double max_height = 0)
      : internal::Filter_base<Normal_change_filter, BaseFilter>(base),
        m_min_cosine(max_change == 180 ? -2 : std::cos(max_change * CGAL_PI / 180)), m_max_height(max_height)
  {
    if (!(max_change >= 0 && max_change <= 180))
      throw Argument_error("the change allowed to a normal is an angle between 0 and 180 degrees");
    if (!(max_height >= 0))
      throw Argument_error("the height of a low face is a length of at least 0");
  }

  template <class Collapse>
  bool accepts(const Collapse& collapse) const
  {
    using Point = typename Collapse::Point;
    return collapse.all_of_changed_faces(
        [this](const auto&, const Point& before, const Point& after, const Point& a, const Point& b) {
          const auto normal_before = CGAL::cross_product(a - before, b - before);
          const auto normal_after = CGAL::cross_product(a - after, b - after);
          const double length_before = std::sqrt(CGAL::to_double(normal_before.squared_length()));
          const double length_after = std::sqrt(CGAL::to_double(normal_after.squared_length()));
          if (!(length_before > 0))
            return true;
          if (!(length_after > 0))
            return false;
          if (CGAL::to_double(normal_before * normal_after) >= m_min_cosine * length_before * length_after)
            return true;
          const double side = std::sqrt(CGAL::to_double(CGAL::squared_distance(a, b)));
          return (std::max)(length_before, length_after) < m_max_height * side;
        });
  }

private:
  double m_min_cosine, m_max_height;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_NORMAL_CHANGE_FILTER_H
