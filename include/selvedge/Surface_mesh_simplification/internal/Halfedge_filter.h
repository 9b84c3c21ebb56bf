// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_HALFEDGE_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_HALFEDGE_FILTER_H

#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>

#include <type_traits>
#include <utility>

namespace selvedge {

/// Refuses a collapse when a predicate is false for it: `bool(collapse)` or, for predicates that only need to
/// know which end merges into which, `bool(halfedge)` with the halfedge `collapse.moving()`.
///
/// It exists for rules about what is attached to a mesh, such as pieces, texture and shares of faces, rather
/// than about its geometry. A model of CGAL's concept `PlacementFilter`.
template <class Predicate, class BaseFilter = No_filter>
class Halfedge_filter : public internal::Filter_base<Halfedge_filter<Predicate, BaseFilter>, BaseFilter>
{
public:
  explicit Halfedge_filter(Predicate predicate, const BaseFilter& base = {})
      : internal::Filter_base<Halfedge_filter, BaseFilter>(base), m_predicate(std::move(predicate))
  {
  }

  template <class Collapse>
  bool accepts(const Collapse& collapse) const
  {
    if constexpr (std::is_invocable_v<const Predicate&, const Collapse&>)
      return m_predicate(collapse);
    else
      return m_predicate(collapse.moving());
  }

private:
  Predicate m_predicate;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_HALFEDGE_FILTER_H
