// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ANNOUNCE_COLLAPSE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ANNOUNCE_COLLAPSE_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/call_with_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>

#include <type_traits>
#include <utility>

namespace selvedge {
namespace internal {

// Whether a visitor takes each collapse as a value.
template <class Visitor, class Collapse, class = void>
struct Takes_collapses : std::false_type
{
};
template <class Visitor, class Collapse>
struct Takes_collapses<
    Visitor, Collapse,
    std::void_t<decltype(std::declval<Visitor&>().before_collapse(std::declval<const Collapse&>()))>>
    : std::true_type
{
};

/// Tells a visitor that an edge is about to collapse: by `before_collapse(collapse)` or, where it has none,
/// by CGAL's `OnCollapsing`.
template <class Visitor, class Profile>
void announce_collapse(Visitor& visitor, const Collapse<Profile>& collapse)
{
  if constexpr (Takes_collapses<Visitor, Collapse<Profile>>::value) {
    visitor.before_collapse(collapse);
  } else {
    const Optional<typename Profile::Point> place(collapse.place());
    call_with_profile([&](const auto& profile) -> decltype(visitor.OnCollapsing(
                                                   profile, place)) { visitor.OnCollapsing(profile, place); },
                      collapse.profile());
  }
}

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_ANNOUNCE_COLLAPSE_H
