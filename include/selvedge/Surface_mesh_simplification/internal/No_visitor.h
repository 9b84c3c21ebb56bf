// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_NO_VISITOR_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_NO_VISITOR_H

namespace selvedge {
namespace internal {

/// A visitor that does nothing: the base class of visitors that name no type of profile.
///
/// `Edge_collapse_visitor_base` of CGAL is not such a class: it names the profile of one vertex point map.
struct No_visitor
{
  template <class TriangleMesh>
  void OnStarted(TriangleMesh&)
  {
  }
  template <class TriangleMesh>
  void OnFinished(TriangleMesh&)
  {
  }
  template <class Profile>
  void OnStopConditionReached(const Profile&)
  {
  }
  template <class Profile, class OptionalCost>
  void OnCollected(const Profile&, const OptionalCost&)
  {
  }
  template <class Profile, class OptionalCost, class Size>
  void OnSelected(const Profile&, const OptionalCost&, Size, Size)
  {
  }
  template <class Profile, class OptionalPoint>
  void OnCollapsing(const Profile&, const OptionalPoint&)
  {
  }
  template <class Profile, class Vertex>
  void OnCollapsed(const Profile&, const Vertex&)
  {
  }
  template <class Profile>
  void OnNonCollapsable(const Profile&)
  {
  }
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_NO_VISITOR_H
