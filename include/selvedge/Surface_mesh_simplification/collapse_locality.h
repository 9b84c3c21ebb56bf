// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_COLLAPSE_LOCALITY_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_COLLAPSE_LOCALITY_H

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>

#include <type_traits>

namespace selvedge {

/// Tells the loop about which edges it must ask a cost or placement policy again after a collapse.
///
/// The loop always asks again about the edges at the merged vertex, `kept`. `reaches_neighbours(policy,
/// kept)` says whether the policy may also have a new answer for other edges at the neighbours of `kept`:
/// where every vertex has 6 edges, 36 questions instead of 6. True is always correct, and is what CGAL's own
/// loop assumes. Where it is true, `reaches(policy, kept, edge)` says the same of a single one of these
/// edges.
///
/// `can_wait(policy, kept, edge)` says of an edge that the policy reaches whether the loop may ask again
/// later. It then asks when the queue comes to the cost that the edge had, unless that is near already. So it
/// asks once about many changes, but notices late when a high cost has become low. False is always correct.
///
/// A policy of your own either has members `bool reaches_neighbours(vertex) const`, `bool reaches(vertex,
/// edge) const` and, if it likes, `bool can_wait(vertex, edge) const`, or specialises this trait, with all
/// three. A wrong answer harms order and quality, but no guarantee, since the filters are asked when an edge
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
  template <class Vertex, class Edge>
  static bool can_wait(const Policy&, const Vertex&, const Edge&)
  {
    return false;
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
  template <class Vertex, class Edge>
  static bool can_wait(const Policy& policy, const Vertex& kept, const Edge& edge)
  {
    return can_wait_if_said(policy, kept, edge, 0);
  }

private:
  template <class P, class Vertex, class Edge> // P is Policy, so that a missing member is no error
  static auto can_wait_if_said(const P& policy, const Vertex& kept, const Edge& edge, int)
      -> decltype(bool(policy.can_wait(kept, edge)))
  {
    return policy.can_wait(kept, edge);
  }
  template <class P, class Vertex, class Edge>
  static bool can_wait_if_said(const P&, const Vertex&, const Edge&, long)
  {
    return false;
  }
};

/// The trait of policies that look only at the ends of an edge.
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
  template <class Policy, class Vertex, class Edge>
  static bool can_wait(const Policy&, const Vertex&, const Edge&)
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
