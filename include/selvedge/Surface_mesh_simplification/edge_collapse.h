// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_EDGE_COLLAPSE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_EDGE_COLLAPSE_H

#include <selvedge/Surface_mesh_simplification/internal/Edge_collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/boost/graph/named_params_helper.h>

namespace selvedge {

namespace internal {

// Deduces the template arguments of `Edge_collapse`.
template <class TriangleMesh, class GeomTraits, class Stop, class VertexPointMap, class HalfedgeIndexMap,
          class EdgeIsConstrainedMap, class Cost, class Placement, class Filter, class Visitor>
int collapse_edges(TriangleMesh& mesh, const Stop& stop, const GeomTraits& traits,
                   const VertexPointMap& points, const HalfedgeIndexMap& numbers,
                   const EdgeIsConstrainedMap& is_constrained, const Cost& cost, const Placement& placement,
                   const Filter& filter, const Visitor& visitor, bool is_geometry_tested,
                   bool is_order_relaxed, std::size_t expected_collapses)
{
  return int(Edge_collapse<TriangleMesh, GeomTraits, Stop, VertexPointMap, HalfedgeIndexMap,
                           EdgeIsConstrainedMap, Cost, Placement, Filter, Visitor>(
                 mesh, traits, stop, points, numbers, is_constrained, cost, placement, filter, visitor,
                 is_geometry_tested, is_order_relaxed, expected_collapses)
                 .run());
}

} // namespace internal

/// Collapses edges, the cheapest first, until a predicate says stop or no edge can be collapsed any more.
/// Returns the number of edges removed.
///
/// It takes the place of `CGAL::Surface_mesh_simplification::edge_collapse`, with the same policies, and is
/// faster. Call it by its full name, `selvedge::edge_collapse`: for arguments of CGAL's types, the compiler
/// finds CGAL's function as well.
///
/// Named parameters, with CGAL's meanings and defaults: `get_cost`, `get_placement`, `filter`, `visitor`,
/// `edge_is_constrained_map`, `vertex_point_map`, `halfedge_index_map`, `geom_traits`, and
/// `vertex_index_map`, which is taken and not needed. Besides, `selvedge::parameters::geometric_test(false)`
/// leaves out CGAL's geometric test, `use_relaxed_order(true)`, or `Tag_true`, relaxes the order a little,
/// and `selvedge::parameters::expected_collapses(n)` relaxes it further. Any other parameter does not
/// compile.
///
/// Policies, filters and visitors are models of CGAL's concepts. The loop also uses the following, where it
/// exists:
///
/// - A cost or placement can say which edges a collapse concerns, see `Collapse_locality`.
/// - A placement can have `second(profile)`, as `Halfedge_placement` has. When its first placement was
///   refused, the edge returns to the queue with the cost of the second. `Optimal_placement` has up to three
///   placements for an edge.
/// - A filter can have `blockers()`, as `Intersection_filter` has: the faces, wherever they are, because of
///   which it refused. The edge is considered again when one of them changes or vanishes.
///
/// **Guarantees**
/// 1. *Order*: edges are considered by (cost, edge number) alone. Both loops collapse the same edges in the
///    same order where no two edges cost the same, none has length zero, and `second`, `blockers` and
///    `can_wait` are not in use. An edge that waits and has become cheaper comes as late as its former cost
///    says; a stop by cost may then leave it. Where costs tie, CGAL's order depends on its heap, and the
///    counts of edges removed may differ. In relaxed order, edges are considered by (class of cost, tile,
///    cost, edge number). Costs of one class differ by at most an eighth; a tile is 8,192 edges with
///    consecutive numbers. A large mesh in which near edges have near numbers is reduced in a third less
///    time, since what is needed next is in the cache. A stop by cost may leave edges that cost up to an
///    eighth less than the one at which it stops. With `expected_collapses`, the cheapest edges are one
///    class, half as many as collapses are expected; when they are gone, half as many as are still expected,
///    and so on until there are few in a tile, or more edges have been refused than collapsed. That saves
///    another third of the time.
/// 2. *Completeness*: when the loop ends without a stop, every edge that is not constrained and has a cost
///    has been refused since the last collapse at one of its ends or at a neighbour of one, and since the
///    last change of a face that was named as its blocker.
/// 3. *Topology*: collapses keep the mesh a manifold of the same topology, as in CGAL's loop.
///
/// **Preconditions** The mesh is a triangle mesh, and the policies are as their concepts say.
/// `halfedge_index_map` gives the two halfedges of an edge the numbers 2i and 2i + 1, as CGAL's loop expects,
/// too. Unlike CGAL's loop, this one does not begin by collapsing all edges of length zero without asking a
/// filter: they are edges like any other.
///
/// **Exactness** That of the policies. The loop itself only compares costs. A cost that is not a number
/// counts as none.
///
/// **Complexity** O(n log n) for n edges, if the policies take constant time. About 28 bytes per edge. After
/// its tables are built, the loop allocates memory only for edges that wait for blockers; filters and
/// visitors may allocate their own.
template <class TriangleMesh, class StopPredicate,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
int edge_collapse(TriangleMesh& mesh, const StopPredicate& stop,
                  const NamedParameters& parameters = CGAL::parameters::default_values())
{
  namespace SMS = CGAL::Surface_mesh_simplification;
  namespace np = CGAL::internal_np;
  static_assert(
      internal::Are_tags_among<NamedParameters, np::all_default_t, np::get_cost_policy_t,
                               np::get_placement_policy_t, np::filter_t, np::visitor_t,
                               np::edge_is_constrained_t, np::vertex_point_t, np::vertex_index_t,
                               np::halfedge_index_t, np::geom_traits_t, np::use_relaxed_order_t,
                               internal::Geometric_test_t, internal::Expected_collapses_t>::value,
      "selvedge::edge_collapse does not know one of these named parameters; its documentation lists "
      "those that it takes");
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
      choose_parameter<internal::No_visitor>(get_parameter(parameters, np::visitor)),
      choose_parameter(get_parameter(parameters, internal::Geometric_test_t()), true),
      choose_parameter(get_parameter(parameters, np::use_relaxed_order), false),
      choose_parameter(get_parameter(parameters, internal::Expected_collapses_t()), std::size_t(0)));
}

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_EDGE_COLLAPSE_H
