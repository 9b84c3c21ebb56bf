// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_COLLAPSE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_COLLAPSE_H

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Surface_mesh_simplification/Dihedral_angle_filter.h>
#include <selvedge/Surface_mesh_simplification/collapse_locality.h>
#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/Edge_queue.h>
#include <selvedge/Surface_mesh_simplification/internal/Element_numbers.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/internal/Lazy_edge_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/No_visitor.h>
#include <selvedge/Surface_mesh_simplification/internal/Topology_test.h>
#include <selvedge/Surface_mesh_simplification/internal/Waiting_edges.h>
#include <selvedge/Surface_mesh_simplification/internal/call_with_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>
#include <selvedge/Surface_mesh_simplification/internal/perform_collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/require_initialised.h>

#include <CGAL/Dynamic_property_map.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

// The loop behind `selvedge::edge_collapse`: the class `Edge_collapse` says what it does and why it exists.
// Before it stand the traits by which it recognises what policies offer beyond CGAL's concepts.

namespace selvedge {
namespace internal {

// Whether a class derives from a placement of ours, as `Constrained_placement` of CGAL does. Its call
// operator may say more than the choices that it inherits.
template <class Placement, class = void>
struct Only_inherits_choices : std::false_type
{
};
template <class Placement>
struct Only_inherits_choices<Placement, std::void_t<typename Placement::Choosing_placement>>
    : std::negation<std::is_same<typename Placement::Choosing_placement, Placement>>
{
};

template <class Placement, class Profile, class = void>
struct Has_second : std::false_type
{
};
template <class Placement, class Profile>
struct Has_second<
    Placement, Profile,
    std::void_t<decltype(std::declval<const Placement&>().second(std::declval<const Profile&>()))>>
    : std::negation<Only_inherits_choices<Placement>>
{
};

// Whether the placement offers choices in order, with the costs of this very cost policy.
template <class Placement, class Cost, class = void>
struct Has_choice : std::false_type
{
};
template <class Placement, class Cost>
struct Has_choice<Placement, Cost, std::void_t<typename Placement::Cost_policy>>
    : std::conjunction<std::is_same<typename Placement::Cost_policy, Cost>,
                       std::negation<Only_inherits_choices<Placement>>>
{
};

// Whether a placement with choices has a bound of the cost of the first.
template <class Placement, class Profile, class = void>
struct Has_cost_bound : std::false_type
{
};
template <class Placement, class Profile>
struct Has_cost_bound<
    Placement, Profile,
    std::void_t<decltype(std::declval<const Placement&>().first_cost_bound(std::declval<const Profile&>()))>>
    : std::true_type
{
};

// Whether the visitor may name a motion that is tried next, after a collapse.
template <class Visitor, class = void>
struct Has_follow_up : std::false_type
{
};
template <class Visitor>
struct Has_follow_up<Visitor, std::void_t<decltype(std::declval<const Visitor&>().follow_up())>>
    : std::true_type
{
};

// Whether the visitor may name motions that go with a collapse.
template <class Visitor, class = void>
struct Has_companions : std::false_type
{
};
template <class Visitor>
struct Has_companions<Visitor, std::void_t<decltype(std::declval<const Visitor&>().companions())>>
    : std::true_type
{
};

/// Collapses the edges of a mesh in the order of their costs: the loop behind `selvedge::edge_collapse`.
///
/// It exists because CGAL's loop drops a refused edge until its neighbourhood changes, and builds a full
/// profile, with allocations, for every cost. This loop tries the next placement of an edge at its own
/// cost, considers a refused edge again when a face that blocked it changes, and asks policies again only
/// where their answers may have changed, or, where they allow it, when the edge is about to collapse.
///
/// Each step takes the cheapest edge from the queue and asks the stop predicate, the topology, the placement,
/// the geometric test and the filter, in this order (`try_cheapest`). It then performs the collapse, or puts
/// the edge back for its next placement, or leaves it until something nearby or one of its blockers changes
/// (`refresh_around`).
template <class TriangleMesh, class GeomTraits, class Stop, class VertexPointMap, class HalfedgeIndexMap,
          class EdgeIsConstrainedMap, class Cost, class Placement, class Filter, class Visitor>
class Edge_collapse
{
  using Graph_traits = boost::graph_traits<TriangleMesh>;
  using Vertex = typename Graph_traits::vertex_descriptor;
  using Halfedge = typename Graph_traits::halfedge_descriptor;
  using Edge = typename Graph_traits::edge_descriptor;
  using Face = typename Graph_traits::face_descriptor;
  using Size = typename Graph_traits::edges_size_type;
  using Profile = Lazy_edge_profile<TriangleMesh, VertexPointMap, GeomTraits>;
  using Collapse_of_edge = Collapse<Profile>;
  using FT = typename GeomTraits::FT;
  using Optional_cost = Optional<FT>;
  using Optional_point = Optional<typename Profile::Point>;
  using Queue = Edge_queue<FT>;
  using Id = typename Queue::Id;

  // An edge is *stale* when it is out of the queue, or in it for a placement that is not its first: a change
  // nearby may make its first placement possible again.
  static constexpr unsigned char s_gone = 255;
  struct Edge_record
  {
    // The class and `is_queued` repeat what the queue knows, so that a look at an edge mostly reads one
    // place.
    std::uint16_t class_of_cost = 0; // of an edge in the queue
    unsigned char rank = s_gone;     // of the placement that is next, from 0
    Merged_at at : 2;                // which place this is, if the placement has `choice`
    bool is_queued : 1;
    bool is_outdated : 1; // the cost is computed again when the edge leaves the queue

    Edge_record() : at(Merged_at::v0), is_queued(false), is_outdated(false) {}
  };

  // Changes of costs that can wait are noticed at once up to this multiple of the cost of the last edge taken
  // from the queue. With 4 or more, the error of the results is the same to 0.5 %, as a mean over meshes.
  static constexpr float s_near = 6;

public:
  Edge_collapse(TriangleMesh& mesh, const GeomTraits& traits, const Stop& stop, const VertexPointMap& points,
                const HalfedgeIndexMap& numbers, const EdgeIsConstrainedMap& is_constrained, const Cost& cost,
                const Placement& placement, const Filter& filter, const Visitor& visitor,
                bool is_geometry_tested, bool is_order_relaxed, std::size_t expected_collapses)
      : m_mesh(mesh), m_traits(traits), m_stop(stop), m_points(points), m_numbers(numbers),
        m_is_constrained(is_constrained), m_cost(cost), m_placement(placement), m_filter(filter),
        m_visitor(visitor), m_is_geometry_tested(is_geometry_tested),
        m_expected_collapses(expected_collapses), m_records(num_edges(mesh)),
        m_queue(num_edges(mesh), is_order_relaxed), m_waiting(mesh),
        m_has_stale_edges(get(CGAL::dynamic_vertex_property_t<unsigned char>(), mesh))
  {
  }

  /// Returns the number of edges removed.
  Size run()
  {
    m_visitor.OnStarted(m_mesh);
    if constexpr (Is_updated<Cost>::value)
      m_cost.initialize(m_mesh, m_points, m_traits);
    require_initialised(m_placement);
    collect();
    while (!m_queue.is_empty() && try_cheapest())
      ;
    m_visitor.OnFinished(m_mesh);
    return m_initial_edges - m_edges;
  }

private:
  // Stores the halfedges of edges unless these have the numbers that the mesh gives them.
  void find_halfedges()
  {
    if constexpr (Are_numbers<Halfedge>::value)
      if (std::all_of(edges(m_mesh).begin(), edges(m_mesh).end(), [this](Edge e) {
            const Halfedge h = halfedge(e, m_mesh);
            return std::size_t(h) == 2 * std::size_t(id(h));
          }))
        return;
    m_halfedges.resize(num_edges(m_mesh));
    for (const Edge e : edges(m_mesh))
      m_halfedges[id(halfedge(e, m_mesh))] = halfedge(e, m_mesh);
  }

  Halfedge halfedge_of(Id edge) const
  {
    if constexpr (Are_numbers<Halfedge>::value)
      if (m_halfedges.empty())
        return Halfedge(2 * edge);
    return m_halfedges[edge];
  }

  void collect()
  {
    for (const Vertex v : vertices(m_mesh))
      put(m_has_stale_edges, v, false);
    find_halfedges();
    Cancellation_poll poll;
    for (const Edge e : edges(m_mesh)) {
      poll();
      const Halfedge h = halfedge(e, m_mesh);
      m_records[id(h)].rank = 0;
      ++m_edges;
      if (get(m_is_constrained, e))
        continue;
      const Profile of_edge = profile(h);
      const Optional_cost cost = initial_cost_of(of_edge, m_records[id(h)]);
      if (cost) {
        m_queue.append(id(h), *cost);
        note_queued(id(h), *cost);
      }
      call_with_profile(
          [&](const auto& p) -> decltype(m_visitor.OnCollected(p, cost)) { m_visitor.OnCollected(p, cost); },
          of_edge);
    }
    m_initial_edges = m_edges;
    m_queue.sort();
  }

  // Takes the cheapest edge from the queue and collapses it if allowed. Returns whether the loop goes on.
  bool try_cheapest()
  {
    m_poll();
    if (m_expected_collapses > 0 && m_queue.are_merged_classes_gone())
      merge_classes();
    const auto [cost, edge_id] = m_queue.pop();
    Edge_record& record = m_records[edge_id];
    record.is_queued = false;
    const Profile of_edge = profile(halfedge_of(edge_id));
    Optional_cost selected_at(cost);
    if (record.is_outdated) {
      record.is_outdated = false;
      selected_at = cost_of(of_edge, record);
      if (!selected_at)
        return true;
      if (*selected_at > cost && !m_queue.would_be_first(edge_id, *selected_at)) {
        enqueue(edge_id, *selected_at);
        return true;
      }
    }
    m_front = as_float(*selected_at);
    call_with_profile(
        [&](const auto& p) -> decltype(m_visitor.OnSelected(p, selected_at, m_initial_edges, m_edges)) {
          m_visitor.OnSelected(p, selected_at, m_initial_edges, m_edges);
        },
        of_edge);
    if (is_stop(*selected_at, of_edge)) {
      call_with_profile([&](const auto& p) -> decltype(m_visitor.OnStopConditionReached(
                                               p)) { m_visitor.OnStopConditionReached(p); },
                        of_edge);
      return false;
    }
    if (!m_topology.is_kept(of_edge, m_is_constrained)) {
      on_refused(of_edge);
      return true;
    }
    const Optional<Collapse_of_edge> collapse = collapse_of(of_edge, record);
    const bool is_asked = collapse && (!m_is_geometry_tested || Dihedral_angle_filter<>().accepts(*collapse));
    if (is_asked && is_allowed(m_filter, *collapse)) {
      perform(*collapse, edge_id);
      if constexpr (Has_follow_up<Visitor>::value)
        if (const auto moving = m_visitor.follow_up())
          try_along(*moving);
      return true;
    }
    on_refused(of_edge);
    if constexpr (Has_blockers<Filter>::value)
      if (is_asked)
        for (const Face face : m_filter.blockers())
          m_waiting.add(face, edge_id);
    if constexpr (Has_choice<Placement, Cost>::value || Has_second<Placement, Profile>::value) {
      ++record.rank;
      if (const Optional_cost next = cost_of(of_edge, record))
        enqueue(edge_id, *next);
    }
    return true;
  }

  // Lets the cheapest edges come tile by tile, half as many as collapses are expected. So there are collapses
  // to come when they are gone: tiles differ on the way, but not in the end. Where more has been refused than
  // done, the end may come before.
  void merge_classes()
  {
    if (m_refused > m_done || !m_queue.merge_classes(m_expected_collapses / 2))
      m_expected_collapses = 0;
  }

  // Moves the source of `moving` onto its target if allowed. Otherwise its edge stays as it is in the queue.
  void try_along(Halfedge moving)
  {
    const Id edge_id = id(moving);
    const Profile of_edge = profile(halfedge_of(edge_id));
    if (get(m_is_constrained, edge(moving, m_mesh)) || !m_topology.is_kept(of_edge, m_is_constrained))
      return;
    const Collapse_of_edge collapse = Collapse_of_edge::along(of_edge, moving);
    if (is_allowed(m_filter, collapse))
      perform(collapse, edge_id);
    else
      on_refused(of_edge);
  }

  // Does the collapses that were allowed together with the one that has left `first`. Only then the costs
  // around all that are left are those of a whole motion.
  void perform_companions(Vertex first)
  {
    const std::vector<Halfedge> companions = m_visitor.companions(); // which have no companions of their own
    if (companions.empty())
      return;
    std::vector<Vertex> all{first};
    for (const Halfedge moving : companions) {
      const Profile of_companion = profile(halfedge_of(id(moving)));
      all.push_back(perform(Collapse_of_edge::along(of_companion, moving), id(moving)));
    }
    for (const Vertex kept : all)
      refresh_around(kept);
  }

  // Returns the vertex that is left.
  Vertex perform(const Collapse_of_edge& collapse, Id edge_id)
  {
    const Profile& of_edge = collapse.profile();
    if constexpr (!std::is_base_of_v<No_visitor, Visitor>)
      of_edge.full(); // the visitor may ask for it when the edge is gone
    forget(edge_id);
    if (of_edge.left_face_exists())
      forget(of_edge.vL_v0(), of_edge.v1_vL());
    if (of_edge.right_face_exists())
      forget(of_edge.vR_v1(), of_edge.v0_vR());
    if constexpr (Has_blockers<Filter>::value) {
      if (collapse.is_v0_moved())
        m_waiting.release_around(of_edge.v0());
      if (collapse.is_v1_moved())
        m_waiting.release_around(of_edge.v1());
    }
    const Vertex kept = perform_collapse(m_mesh, m_points, m_is_constrained, collapse, m_visitor, m_cost);
    ++m_done;
    m_expected_collapses -= m_expected_collapses > 0;
    refresh_around(kept);
    if constexpr (Has_companions<Visitor>::value)
      perform_companions(kept);
    return kept;
  }

  // Called for each edge that a collapse is about to remove.
  void forget(Id edge_id)
  {
    dequeue(edge_id);
    m_records[edge_id].rank = s_gone;
    --m_edges;
  }
  // The same for two edges of a vanishing face that become one: `h` goes, or `other` if `h` is constrained.
  void forget(Halfedge h, Halfedge other) { forget(id(get(m_is_constrained, edge(h, m_mesh)) ? other : h)); }

  void refresh_around(Vertex kept)
  {
    const bool is_wide = Collapse_locality<Cost>::reaches_neighbours(m_cost, kept) ||
                         Collapse_locality<Placement>::reaches_neighbours(m_placement, kept);
    for (const Halfedge h : CGAL::halfedges_around_target(halfedge(kept, m_mesh), m_mesh)) {
      refresh(h);
      const Halfedge to_neighbour = opposite(h, m_mesh);
      const Vertex neighbour = target(to_neighbour, m_mesh);
      if (!is_wide && !get(m_has_stale_edges, neighbour))
        continue;
      // An edge between two neighbours is looked at from one of them.
      const Halfedge looked_at_beyond =
          CGAL::is_border(to_neighbour, m_mesh) ? to_neighbour : next(to_neighbour, m_mesh);
      for (const Halfedge g : CGAL::halfedges_around_target(to_neighbour, m_mesh)) {
        if (g == to_neighbour)
          continue;
        Edge_record& record = m_records[id(g)];
        if (is_stale(record))
          refresh(g);
        else if (is_wide && opposite(g, m_mesh) != looked_at_beyond && is_reached(kept, edge(g, m_mesh))) {
          if (is_far(id(g)) && can_wait(kept, edge(g, m_mesh)))
            record.is_outdated = true;
          else
            refresh(g);
        }
      }
      put(m_has_stale_edges, neighbour, false);
    }
    put(m_has_stale_edges, kept, false);
    if constexpr (Has_blockers<Filter>::value)
      m_waiting.take_released([this](Id edge_id) {
        if (m_records[edge_id].rank != s_gone && is_stale(m_records[edge_id]))
          refresh(halfedge_of(edge_id));
      });
  }

  bool is_reached(Vertex kept, Edge e) const
  {
    return Collapse_locality<Cost>::reaches(m_cost, kept, e) ||
           Collapse_locality<Placement>::reaches(m_placement, kept, e);
  }

  // Of an edge that one of both policies reaches.
  bool can_wait(Vertex kept, Edge e) const
  {
    return (!Collapse_locality<Cost>::reaches(m_cost, kept, e) ||
            Collapse_locality<Cost>::can_wait(m_cost, kept, e)) &&
           (!Collapse_locality<Placement>::reaches(m_placement, kept, e) ||
            Collapse_locality<Placement>::can_wait(m_placement, kept, e));
  }

  // Whether an edge in the queue costs so much that changes of its cost can wait.
  bool is_far(Id edge_id) const
  {
    const float limit = s_near * m_front;
    const std::uint32_t of_edge = m_records[edge_id].class_of_cost, of_limit = class_of_cost(limit);
    return of_edge != of_limit ? of_edge > of_limit : as_float(m_queue.cost(edge_id)) > limit;
  }

  static bool is_stale(const Edge_record& record) { return record.rank > 0 || !record.is_queued; }

  // Puts an edge into the queue with the cost of its first placement, or takes it out if that has no cost.
  void refresh(Halfedge h)
  {
    const Id edge_id = id(h);
    if (get(m_is_constrained, edge(h, m_mesh)))
      return;
    Edge_record& record = m_records[edge_id];
    record.rank = 0;
    record.is_outdated = false;
    if (const Optional_cost cost = bound_or_cost_of(profile(halfedge_of(edge_id)), record))
      enqueue(edge_id, *cost);
    else
      dequeue(edge_id);
  }

  // Visitors of CGAL's concept are told the cost itself.
  Optional_cost initial_cost_of(const Profile& of_edge, Edge_record& record) const
  {
    if constexpr (std::is_base_of_v<No_visitor, Visitor>)
      return bound_or_cost_of(of_edge, record);
    else
      return cost_of(of_edge, record);
  }

  // Returns a bound of the cost of the first placement, and notes that the cost itself is still to be
  // computed; or that cost where the placement has no bound.
  Optional_cost bound_or_cost_of(const Profile& of_edge, Edge_record& record) const
  {
    if constexpr (Has_choice<Placement, Cost>::value && Has_cost_bound<Placement, Profile>::value)
      if (const auto bound = m_placement.first_cost_bound(of_edge)) {
        record.is_outdated = true;
        return FT(*bound);
      }
    return cost_of(of_edge, record);
  }

  void enqueue(Id edge_id, const FT& cost)
  {
    m_queue.set(edge_id, cost);
    note_queued(edge_id, cost);
  }
  void note_queued(Id edge_id, const FT& cost)
  {
    m_records[edge_id].class_of_cost = std::uint16_t(class_of_cost(as_float(cost)));
    m_records[edge_id].is_queued = true;
  }
  void dequeue(Id edge_id)
  {
    m_queue.erase(edge_id);
    m_records[edge_id].is_queued = false;
  }
  static float as_float(const FT& cost) { return float(CGAL::to_double(cost)); }

  bool is_stop(const FT& cost, const Profile& of_edge) const
  {
    return call_with_profile(
        [&](const auto& p) -> decltype(bool(m_stop(cost, p, m_initial_edges, m_edges))) {
          return bool(m_stop(cost, p, m_initial_edges, m_edges));
        },
        of_edge);
  }

  void on_refused(const Profile& of_edge)
  {
    ++m_refused;
    call_with_profile(
        [&](const auto& p) -> decltype(m_visitor.OnNonCollapsable(p)) { m_visitor.OnNonCollapsable(p); },
        of_edge);
    put(m_has_stale_edges, of_edge.v0(), true);
    put(m_has_stale_edges, of_edge.v1(), true);
  }

  // Returns the cost of the placement that is next for the edge, or none when there is none any more.
  Optional_cost cost_of(const Profile& of_edge, Edge_record& record) const
  {
    Optional_cost cost;
    if constexpr (Has_choice<Placement, Cost>::value) {
      if (const auto choice = m_placement.choice(of_edge, record.rank)) {
        record.at = choice->at;
        cost = choice->cost ? FT(*choice->cost) : Optional_cost();
      }
    } else if (const Optional_point placement = placement_of(of_edge, record);
               placement || record.rank == 0) {
      cost = ask_policy(m_cost, of_edge, placement);
    }
    return cost && *cost == *cost ? cost : Optional_cost();
  }

  Optional<Collapse_of_edge> collapse_of(const Profile& of_edge, const Edge_record& record) const
  {
    if constexpr (Has_choice<Placement, Cost>::value)
      return m_placement.collapse(of_edge, record.at);
    else if (const Optional_point placement = placement_of(of_edge, record);
             placement && Collapse_of_edge::is_place(*placement))
      return Collapse_of_edge(of_edge, *placement);
    else
      return {};
  }

  Optional_point placement_of(const Profile& of_edge, const Edge_record& record) const
  {
    if (record.rank == 0)
      return ask_policy(m_placement, of_edge);
    if constexpr (Has_second<Placement, Profile>::value)
      if (record.rank == 1)
        return m_placement.second(of_edge);
    return {};
  }

  Profile profile(Halfedge h) const { return Profile(h, m_mesh, m_points, m_traits); }
  Id id(Halfedge h) const { return Id(get(m_numbers, h) / 2); }

  TriangleMesh& m_mesh;
  const GeomTraits& m_traits;
  const Stop& m_stop;
  const VertexPointMap& m_points;
  const HalfedgeIndexMap& m_numbers;
  const EdgeIsConstrainedMap& m_is_constrained;
  const Cost& m_cost;
  const Placement& m_placement;
  const Filter& m_filter;
  Visitor m_visitor;
  bool m_is_geometry_tested;
  std::size_t m_expected_collapses;      // still to come; 0 when this is not known, or no longer of use
  std::size_t m_done = 0, m_refused = 0; // collapses
  float m_front = 0;                     // the cost of the edge taken last from the queue

  Cancellation_poll m_poll;

  std::vector<Halfedge> m_halfedges;  // by edge; or empty
  std::vector<Edge_record> m_records; // by edge
  Queue m_queue;
  Waiting_edges<TriangleMesh> m_waiting;
  // Whether an edge was refused at either end of it and the edges at this vertex have not been refreshed
  // since. (A property of bool does not compile on meshes of OpenMesh.)
  typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<unsigned char>>::type
      m_has_stale_edges;
  Size m_initial_edges = 0, m_edges = 0;
  Topology_test<TriangleMesh> m_topology;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_EDGE_COLLAPSE_H
