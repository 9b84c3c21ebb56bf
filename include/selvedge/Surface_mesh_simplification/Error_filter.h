// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_ERROR_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_ERROR_FILTER_H

#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/internal/require_initialised.h>

namespace selvedge {

/// Refuses a collapse whose error is larger than a limit.
///
/// The error is what `Cost::error_at(profile, point)` returns. For `Quadric_cost`, it is the root mean square
/// distance of the merged vertex to the original planes that its quadric has accumulated.
///
/// A model of CGAL's concept `PlacementFilter`, usable with any placement. A `Quadric_cost` must be the cost
/// of the loop, or a copy of it; otherwise the first question throws `Argument_error`.
///
/// **Exactness** Floating point: the filter limits quality.
template <class Cost, class BaseFilter = No_filter>
class Error_filter : public internal::Filter_base<Error_filter<Cost, BaseFilter>, BaseFilter>
{
public:
  /// `max_error` is a length in units of the mesh; infinity sets no limit.
  Error_filter(double max_error, const Cost& cost, const BaseFilter& base = {})
      : internal::Filter_base<Error_filter, BaseFilter>(base), m_max_error(max_error), m_cost(cost)
  {
  }

  template <class Collapse>
  bool accepts(const Collapse& collapse) const
  {
    internal::require_initialised(m_cost);
    return m_cost.error_at(collapse.profile(), collapse.place()) <= m_max_error;
  }

private:
  double m_max_error;
  Cost m_cost;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_ERROR_FILTER_H
