// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_COLLAPSE_LOCALITY_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_COLLAPSE_LOCALITY_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>

#include <type_traits>
#include <utility>

namespace selvedge {

/// Which edges a cost or placement policy must be asked about again after a collapse.
///
/// What a policy says of the edges at the merged vertex always counts as changed. This trait says whether
/// `policy` may also say something new of other edges at the neighbours of `kept`, the merged vertex: 36
/// edges instead of 6, on average. Yes is always right, and is what CGAL's own loop assumes. Where it does,
/// `reaches(policy, kept, edge)` says of one of these edges whether it may. A policy of one's own either has
/// members `bool reaches_neighbours(vertex) const` and `bool reaches(vertex, edge) const` or specialises this
/// trait; a wrong "no" costs order and quality, never a guarantee, since the filters are asked when an edge
/// collapses.
template <class Policy, class = void>
struct Collapse_locality
{
  template <class Vertex>
  static bool reaches_neighbours(const Policy&, const Vertex&)
  {
    return true;
  }
  template <class Vertex, class Edge>
  static bool reaches(const Policy&, const Vertex&, const Edge&)
  {
    return true;
  }
};

template <class Policy>
struct Collapse_locality<Policy, std::void_t<decltype(&Policy::reaches_neighbours)>>
{
  template <class Vertex>
  static bool reaches_neighbours(const Policy& policy, const Vertex& kept)
  {
    return policy.reaches_neighbours(kept);
  }
  template <class Vertex, class Edge>
  static bool reaches(const Policy& policy, const Vertex& kept, const Edge& edge)
  {
    return policy.reaches(kept, edge);
  }
};

/// Policies that look at nothing but the ends of an edge.
struct Looks_at_ends_alone
{
  template <class Policy, class Vertex>
  static bool reaches_neighbours(const Policy&, const Vertex&)
  {
    return false;
  }
  template <class Policy, class Vertex, class Edge>
  static bool reaches(const Policy&, const Vertex&, const Edge&)
  {
    return false;
  }
};
template <class TriangleMesh>
struct Collapse_locality<CGAL::Surface_mesh_simplification::Edge_length_cost<TriangleMesh>>
    : Looks_at_ends_alone
{
};
template <class TriangleMesh>
struct Collapse_locality<CGAL::Surface_mesh_simplification::Midpoint_placement<TriangleMesh>>
    : Looks_at_ends_alone
{
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_COLLAPSE_LOCALITY_H
