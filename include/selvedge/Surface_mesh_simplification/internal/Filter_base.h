// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_BASE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_BASE_H

#include <selvedge/Surface_mesh_simplification/internal/Collapse.h>
#include <selvedge/Surface_mesh_simplification/internal/call_with_profile.h>
#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace selvedge {

/// Accepts every placement: the base filter by default.
struct No_filter
{
  using Judging_filter = No_filter; // see `is_allowed`

  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint& placement) const
  {
    return placement;
  }

  template <class Collapse>
  bool allows(const Collapse&) const
  {
    return true;
  }
};

namespace internal {

template <class Filter, class = void>
struct Has_blockers : std::false_type
{
};
template <class Filter>
struct Has_blockers<Filter, std::void_t<decltype(std::declval<const Filter&>().blockers())>> : std::true_type
{
};

template <class Filter, class = void>
struct Judges_collapses : std::false_type
{
};
template <class Filter>
struct Judges_collapses<Filter, std::void_t<typename Filter::Judging_filter>>
    : std::is_same<typename Filter::Judging_filter, Filter>
{
};

/// Returns whether a filter allows a collapse. The filter is one of ours, which takes the collapse itself and
/// says so by naming itself `Judging_filter`, or any model of CGAL's concept `PlacementFilter`. A class that
/// derives from one of ours is such a model, since its call operator may say more than what it inherits.
template <class Filter, class Collapse>
bool is_allowed(const Filter& filter, const Collapse& collapse)
{
  if constexpr (Judges_collapses<Filter>::value)
    return filter.allows(collapse);
  else
    return bool(ask_policy(filter, collapse.profile(), Optional<typename Collapse::Point>(collapse.place())));
}

/// Chains filters: it asks the base filter first, then `accepts(collapse)` of the derived class, and counts
/// what the latter refuses.
///
/// All filters derive from it, so that each says only what it refuses itself, and the cheap ones are asked
/// first. CGAL's loop copies its filter; copies share the count.
template <class Derived, class BaseFilter>
class Filter_base
{
public:
  using Judging_filter = Derived;

  explicit Filter_base(const BaseFilter& base) : m_base(base), m_refusals(std::make_shared<std::size_t>(0)) {}

  /// Returns the placement itself when the base and this filter accept it, none otherwise. If the base filter
  /// returns another placement, this counts as accepting.
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    const bool is_allowed = placement && Collapse<Profile>::is_place(*placement) &&
                            derived().allows(Collapse<Profile>(profile, *placement));
    return is_allowed ? placement : OptionalPoint();
  }

  /// The same for a loop that passes each collapse as a value, which says which end moves.
  template <class Collapse>
  bool allows(const Collapse& collapse) const
  {
    if (!is_allowed(m_base, collapse))
      return false;
    if (derived().accepts(collapse))
      return true;
    ++*m_refusals;
    return false;
  }

  /// Returns the faces because of which the base has refused, if the base names such faces
  /// (`Intersection_filter::blockers`).
  template <class Base = BaseFilter>
  auto blockers() const -> decltype(std::declval<const Base&>().blockers())
  {
    return m_base.blockers();
  }

  /// Returns how many placements this filter has refused that its base had accepted.
  std::size_t refusals() const { return *m_refusals; }

private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }

protected:
  const BaseFilter& base() const { return m_base; }

private:
  BaseFilter m_base;
  std::shared_ptr<std::size_t> m_refusals;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_BASE_H
