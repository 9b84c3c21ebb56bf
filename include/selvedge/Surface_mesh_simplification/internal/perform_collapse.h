// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_PERFORM_COLLAPSE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_PERFORM_COLLAPSE_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/announce_collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/call_with_profile.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <type_traits>

// `perform_collapse` is the one place where an edge is collapsed.

namespace selvedge {
namespace internal {

/// The edge map for meshes without constrained edges.
struct No_constrained_edges
{
  template <class Edge>
  friend bool get(const No_constrained_edges&, const Edge&)
  {
    return false;
  }
};

// Whether a cost asks for `initialize` and `update_after_collapse`.
template <class Cost, class = void>
struct Is_updated : std::false_type
{
};
template <class Cost>
struct Is_updated<Cost, std::void_t<typename Cost::Update_tag>> : std::bool_constant<Cost::Update_tag::value>
{
};

// Notifies a cost, and tells one that takes it where the merged vertex is.
template <class Cost, class Profile, class Vertex>
auto update_after_collapse(const Cost& cost, const Collapse<Profile>& collapse, const Vertex& kept, int)
    -> decltype(cost.update_after_collapse(collapse.profile(), kept, collapse.merged_at()))
{
  return cost.update_after_collapse(collapse.profile(), kept, collapse.merged_at());
}
template <class Cost, class Profile, class Vertex>
void update_after_collapse(const Cost& cost, const Collapse<Profile>& collapse, const Vertex& kept, long)
{
  cost.update_after_collapse(collapse.profile(), kept);
}

/// Collapses an edge, notifies the visitor and the cost, and returns the merged vertex.
///
/// Both the loop and the repetition of the collapses of cells use this function, so that the same is notified
/// in the same order: the visitor's `before_collapse(collapse)` or, where it has none, CGAL's `OnCollapsing`;
/// after the collapse, the visitor's `OnCollapsed`, and `update_after_collapse` of a cost that asks for it.
template <class TriangleMesh, class VertexPointMap, class EdgeIsConstrainedMap, class Profile, class Visitor,
          class Cost>
auto perform_collapse(TriangleMesh& mesh, const VertexPointMap& points,
                      const EdgeIsConstrainedMap& is_constrained, const Collapse<Profile>& collapse,
                      Visitor& visitor, const Cost& cost)
{
  const Profile& profile = collapse.profile();
  announce_collapse(visitor, collapse);
  // A lazy profile finds what is beside the edge when it is asked: this must be what is there now.
  static_cast<void>(profile.vL());
  const auto merge = [&] {
    if constexpr (std::is_same_v<EdgeIsConstrainedMap, No_constrained_edges>)
      return CGAL::Euler::collapse_edge(edge(profile.v0_v1(), mesh), mesh);
    else
      return CGAL::Euler::collapse_edge(edge(profile.v0_v1(), mesh), mesh, is_constrained);
  };
  const auto kept = merge();
  put(points, kept, collapse.place());
  call_with_profile([&](const auto& of_edge) -> decltype(visitor.OnCollapsed(
                                                 of_edge, kept)) { visitor.OnCollapsed(of_edge, kept); },
                    profile);
  if constexpr (Is_updated<Cost>::value)
    update_after_collapse(cost, collapse, kept, 0);
  return kept;
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_PERFORM_COLLAPSE_H
