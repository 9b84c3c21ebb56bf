// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_FILTER_H

#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>

#include <utility>

namespace selvedge {

/// Refuses a collapse for which a predicate on the halfedge along which a vertex moves, `bool(halfedge)`, is
/// false: for rules about what hangs on a mesh rather than on its geometry.
///
/// A model of CGAL's concept `PlacementFilter`, for placements at an end of the edge, as `Halfedge_placement`
/// chooses them. The source of the halfedge is the vertex that moves.
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
    return m_predicate(collapse.moving());
  }

private:
  Predicate m_predicate;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_HALFEDGE_FILTER_H
