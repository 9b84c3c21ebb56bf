// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_HINDRANCE_SEARCH_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_HINDRANCE_SEARCH_H

#include <selvedge/Surface_mesh_simplification/Border_rule.h>
#include <selvedge/Surface_mesh_simplification/Hindrances.h>
#include <selvedge/Surface_mesh_simplification/Optimal_placement.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_chain.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/Motion_filter.h>
#include <selvedge/Surface_mesh_simplification/internal/Topology_test.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <vector>

namespace selvedge {
namespace internal {

template <class Places>
constexpr bool has_places_between = false;
template <class... Parameters>
constexpr bool has_places_between<Optimal_placement<Parameters...>> = true;

/// Finds what holds back the edges of a mesh: for each, the reason that `Hindrances` describes. It asks the
/// rules of a reduction one by one, in their order.
///
/// **Preconditions** The mesh, the filters, the motions and the observer outlive it.
/// `Filter_chain::on_started` has been called since the mesh was changed last.
template <class TriangleMesh, class VertexPointMap, class Observer>
class Hindrance_search
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Edge = typename Graph_traits::edge_descriptor;
  using Geom_traits =
      typename CGAL::Kernel_traits<typename boost::property_traits<VertexPointMap>::value_type>::Kernel;
  using Filters = Filter_chain<TriangleMesh, VertexPointMap, Observer>;
  using Motions = Motion_filter<TriangleMesh, VertexPointMap, Observer>;

public:
  using Profile = Lazy_edge_profile<TriangleMesh, VertexPointMap, Geom_traits>;

  Hindrance_search(TriangleMesh& mesh, const VertexPointMap& points, const Filters& filters,
                   const Motions& motions, const Observer& observer)
      : m_mesh(mesh), m_points(points), m_filters(filters), m_motions(motions), m_observer(observer)
  {
  }

  /// Returns the weakest of the reasons of both directions and, if the placement may choose it, of the place
  /// between.
  template <class Places>
  Hindrance of_edge(const Profile& profile, const Places& places)
  {
    const bool is_topology_kept = m_topology.is_kept(profile, No_constrained_edges());
    Hindrance weakest = Hindrance::frozen;
    for (const Halfedge moving : {profile.v0_v1(), profile.v1_v0()}) {
      const Line_refusal refusal = m_filters.border_rule().refusal(moving);
      const Hindrance reason = refusal != Line_refusal::none ? of_lines(moving, refusal)
                               : !is_topology_kept           ? Hindrance::topology
                               : m_motions.joint().is_joint(source(moving, m_mesh))
                                   ? of_joint(profile, moving)
                                   : with_partner(profile, moving);
      weakest = (std::max)(weakest, reason);
    }
    if constexpr (has_places_between<Places>)
      for (unsigned rank = 0; const auto choice = places.choice(profile, rank); ++rank)
        if (choice->at == Merged_at::between && is_topology_kept)
          weakest = (std::max)(weakest, of_place(*places.collapse(profile, choice->at)));
    return weakest;
  }

private:
  // The lines, the topology, and then what `of_filters(collapse)` says.
  template <class Function>
  Hindrance of_motion(Halfedge moving, const Function& of_filters)
  {
    if (const Line_refusal refusal = m_filters.border_rule().refusal(moving); refusal != Line_refusal::none)
      return of_lines(moving, refusal);
    const Profile profile(moving, m_mesh, m_points, m_traits);
    return m_topology.is_kept(profile, No_constrained_edges())
               ? of_filters(Collapse<Profile>::along(profile, moving))
               : Hindrance::topology;
  }
  Hindrance of_motion(Halfedge moving)
  {
    return of_motion(moving, [this](const auto& collapse) { return m_filters.hindrance(collapse); });
  }

  // Neither end is on a line, so that only a spoke can be in the way.
  Hindrance of_place(const Collapse<Profile>& between) const
  {
    return m_filters.border_rule().allows(between) ? m_filters.hindrance(between) : Hindrance::line_end;
  }

  // A vertex that could go is held back by what holds its partner back.
  Hindrance with_partner(const Profile& profile, Halfedge moving)
  {
    const Hindrance reason = m_filters.hindrance(Collapse<Profile>::along(profile, moving));
    if (reason != Hindrance::by_loop)
      return reason;
    if (m_observer.is_led(moving)) // before its companions are listed: each edge has one in every other place
      return Hindrance::companions;
    const std::vector<Halfedge> companions = m_observer.companions(moving);
    const bool can_go_elsewhere =
        companions.empty() || (m_observer.are_companions_apart(moving, companions) &&
                               std::all_of(companions.begin(), companions.end(), [this](Halfedge h) {
                                 return of_motion(h) == Hindrance::by_loop;
                               }));
    if (!can_go_elsewhere)
      return Hindrance::companions;
    const auto motion = m_filters.partners().partner_motion(moving);
    return motion ? of_motion(*motion) : reason;
  }

  // Vertices that move together are held back by what holds one of them back, and then by contacts of all.
  Hindrance of_joint(const Profile& profile, Halfedge moving)
  {
    const auto others = m_motions.others(moving);
    if (!others)
      return Hindrance::non_manifold;
    for (const Halfedge h : *others) {
      const Hindrance reason =
          of_motion(h, [this](const auto& collapse) { return m_filters.hindrance_of_shape(collapse); });
      if (reason != Hindrance::by_loop)
        return reason;
    }
    return m_filters.hindrance(Collapse<Profile>::along(profile, moving).with_others(*others));
  }

  // The lines that stay when those of some reasons are taken away.
  struct Stronger_lines
  {
    const Hindrance_search* search;
    Hindrance weakest_gone;

    bool is_line_at_target(const Halfedge& h) const
    {
      return search->m_filters.border_rule().is_line_at_target(h) &&
             search->line_reason(edge(h, search->m_mesh)) < weakest_gone;
    }
  };

  Hindrance line_reason(const Edge& e) const
  {
    const Halfedge h = halfedge(e, m_mesh);
    return CGAL::is_border(h, m_mesh) || CGAL::is_border(opposite(h, m_mesh), m_mesh)
               ? Hindrance::border
               : m_observer.line_reason(e);
  }

  // Of the kinds of lines, names the weakest without which, and without all weaker ones, the vertex could go.
  Hindrance of_lines(Halfedge moving, Line_refusal refusal) const
  {
    switch (refusal) {
    case Line_refusal::locked:
      return m_observer.lock_reason(source(moving, m_mesh));
    case Line_refusal::turn:
      return line_reason(edge(moving, m_mesh)) == Hindrance::border ? Hindrance::border_turn
                                                                    : Hindrance::seam_turn;
    case Line_refusal::drift:
      return Hindrance::drift;
    default:
      break;
    }
    Hindrance reason = Hindrance::border;
    for (const Hindrance gone : {Hindrance::normals, Hindrance::texture, Hindrance::group, Hindrance::seam})
      if (m_filters.border_rule().may_move_along(moving, Stronger_lines{this, gone})) {
        reason = gone;
        break;
      }
    return refusal == Line_refusal::off_line || reason == Hindrance::normals ? reason : Hindrance::line_end;
  }

  TriangleMesh& m_mesh;
  const VertexPointMap& m_points;
  const Filters& m_filters;
  const Motions& m_motions;
  const Observer& m_observer;
  Geom_traits m_traits;
  Topology_test<TriangleMesh> m_topology;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_HINDRANCE_SEARCH_H
