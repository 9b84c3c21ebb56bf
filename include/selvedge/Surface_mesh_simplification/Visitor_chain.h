// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_VISITOR_CHAIN_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_VISITOR_CHAIN_H

#include <selvedge/Surface_mesh_simplification/internal/No_visitor.h>
#include <selvedge/Surface_mesh_simplification/internal/announce_collapse.h>

#include <tuple>
#include <type_traits>
#include <utility>

namespace selvedge {

/// Passes every call of the loop on to several visitors, in the order in which they are given.
///
/// A model of CGAL's concept `EdgeCollapseSimplificationVisitor` when all of `Visitors` are. It lets a
/// visitor of your own and that of a filter be given together:
///
/// ```
/// CGAL::parameters::filter(filter).visitor(selvedge::Visitor_chain(filter.visitor(), my_visitor))
/// ```
///
/// It holds copies of the visitors, as the loop does of its visitor: what they record must be outside them.
template <class... Visitors>
class Visitor_chain : public std::conditional_t<(std::is_base_of_v<internal::No_visitor, Visitors> && ...),
                                                internal::No_visitor, std::tuple<>>
{
public:
  explicit Visitor_chain(Visitors... visitors) : m_visitors(std::move(visitors)...) {}

  template <class TriangleMesh>
  void OnStarted(TriangleMesh& mesh)
  {
    for_each([&](auto& visitor) { visitor.OnStarted(mesh); });
  }
  template <class TriangleMesh>
  void OnFinished(TriangleMesh& mesh)
  {
    for_each([&](auto& visitor) { visitor.OnFinished(mesh); });
  }
  template <class Profile>
  void OnStopConditionReached(const Profile& profile)
  {
    for_each([&](auto& visitor) { visitor.OnStopConditionReached(profile); });
  }
  template <class Profile, class OptionalCost>
  void OnCollected(const Profile& profile, const OptionalCost& cost)
  {
    for_each([&](auto& visitor) { visitor.OnCollected(profile, cost); });
  }
  template <class Profile, class OptionalCost, class Size>
  void OnSelected(const Profile& profile, const OptionalCost& cost, Size initial, Size current)
  {
    for_each([&](auto& visitor) { visitor.OnSelected(profile, cost, initial, current); });
  }
  template <class Profile, class OptionalPoint>
  void OnCollapsing(const Profile& profile, const OptionalPoint& placement)
  {
    for_each([&](auto& visitor) { visitor.OnCollapsing(profile, placement); });
  }
  template <class Profile, class Vertex>
  void OnCollapsed(const Profile& profile, const Vertex& kept)
  {
    for_each([&](auto& visitor) { visitor.OnCollapsed(profile, kept); });
  }
  template <class Profile>
  void OnNonCollapsable(const Profile& profile)
  {
    for_each([&](auto& visitor) { visitor.OnNonCollapsable(profile); });
  }

  /// In place of `OnCollapsing`, for a loop that passes each collapse as a value.
  template <class Collapse>
  void before_collapse(const Collapse& collapse)
  {
    for_each([&](auto& visitor) { internal::announce_collapse(visitor, collapse); });
  }

private:
  template <class Function>
  void for_each(const Function& function)
  {
    std::apply([&](auto&... visitors) { (function(visitors), ...); }, m_visitors);
  }

  std::tuple<Visitors...> m_visitors;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_VISITOR_CHAIN_H
