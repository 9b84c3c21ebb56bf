// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_EDGE_COLLAPSE_H
#define SELVEDGE_EDGE_COLLAPSE_H

#include <selvedge/Surface_mesh_simplification/internal/Edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <cstddef>

namespace selvedge {

namespace internal {

// Names what the class template does not deduce.
template <class TriangleMesh, class GeomTraits, class Stop, class VertexPointMap, class HalfedgeIndexMap,
          class EdgeIsConstrainedMap, class Cost, class Placement, class Filter, class Visitor>
std::size_t collapse_edges(TriangleMesh& mesh, const Stop& stop, const GeomTraits& traits,
                           const VertexPointMap& points, const HalfedgeIndexMap& numbers,
                           const EdgeIsConstrainedMap& is_constrained, const Cost& cost,
                           const Placement& placement, const Filter& filter, const Visitor& visitor)
{
  return Edge_collapse<TriangleMesh, GeomTraits, Stop, VertexPointMap, HalfedgeIndexMap, EdgeIsConstrainedMap,
                       Cost, Placement, Filter, Visitor>(mesh, traits, stop, points, numbers, is_constrained,
                                                         cost, placement, filter, visitor)
      .run();
}

} // namespace internal

/// Collapses edges, the cheapest first, until a predicate says stop or no edge is left that may collapse: in
/// place of `CGAL::Surface_mesh_simplification::edge_collapse`, with the same policies, and faster.
///
/// To be called by its full name, since arguments of CGAL's types make the compiler find CGAL's as well.
/// Returns the number of edges removed. Named parameters, with CGAL's meanings and defaults: `get_cost`,
/// `get_placement`, `filter`, `visitor`, `edge_is_constrained_map`, `vertex_point_map`,
/// `halfedge_index_map`, `geom_traits`. Policies, filters and visitors are models of CGAL's concepts. What
/// they may have beyond these:
///
/// - a cost or placement says which edges a collapse concerns, see `Collapse_locality`;
/// - a placement with `second(profile)`, as `Halfedge_placement` has it, gets its edge back when the first
///   placement was refused, at the cost of the second;
/// - a filter with `blockers()`, as `Intersection_filter` has it, names the faces, wherever they are, because
///   of which it refused; an edge so refused is considered again when one of them changes or goes.
///
/// **Guarantees**
/// 1. *Order*: by (cost, edge number) alone. Where no two edges cost the same, neither extra is in use, and
///    what CGAL's loop tests beyond its filter is in the filter (`Dihedral_angle_filter`), both loops
///    collapse the same edges in the same order.
/// 2. *Completeness*: when it ends without a stop, every edge has been refused since the last change of
///    anything that it was refused for.
/// 3. Only collapses that keep the mesh a manifold with the same topology, as CGAL's loop does.
///
/// **Preconditions** Triangle mesh; policies as their concepts say. Unlike CGAL's loop it does not begin by
/// collapsing edges of length zero unasked: they are edges like any other.
///
/// **Exactness** That of the policies; no decision of its own but comparing costs. A cost that is not a
/// number counts as none.
///
/// **Complexity** O(n log n) and, between the building of its tables and the end, no allocation of its own
/// but for edges that wait for blockers; those of filters and visitors are theirs. About 28 bytes per edge.
template <class TriangleMesh, class StopPredicate,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t edge_collapse(TriangleMesh& mesh, const StopPredicate& stop,
                          const NamedParameters& parameters = CGAL::parameters::default_values())
{
  namespace SMS = CGAL::Surface_mesh_simplification;
  namespace np = CGAL::internal_np;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using Geom_traits = typename CGAL::GetGeomTraits<TriangleMesh, NamedParameters>::type;
  return internal::collapse_edges(
      mesh, stop, choose_parameter<Geom_traits>(get_parameter(parameters, np::geom_traits)),
      choose_parameter(get_parameter(parameters, np::vertex_point),
                       CGAL::get_property_map(CGAL::vertex_point, mesh)),
      CGAL::get_initialized_halfedge_index_map(mesh, parameters),
      choose_parameter<internal::No_constrained_edges>(get_parameter(parameters, np::edge_is_constrained)),
      choose_parameter<SMS::LindstromTurk_cost<TriangleMesh>>(get_parameter(parameters, np::get_cost_policy)),
      choose_parameter<SMS::LindstromTurk_placement<TriangleMesh>>(
          get_parameter(parameters, np::get_placement_policy)),
      choose_parameter<No_filter>(get_parameter(parameters, np::filter)),
      choose_parameter<internal::No_visitor>(get_parameter(parameters, np::visitor)));
}

} // namespace selvedge

#endif // SELVEDGE_EDGE_COLLAPSE_H
