// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_BASE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_BASE_H

#include <cstddef>
#include <memory>

namespace selvedge {

/// The base filter that lets every placement pass.
struct No_filter
{
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint& placement) const
  {
    return placement;
  }
};

namespace internal {

/// What all filters share: ask the base filter first, then the derived class, and count what the latter
/// refuses. CGAL's loop copies its filter, so the count stands behind a pointer.
template <class Derived, class BaseFilter>
class Filter_base
{
public:
  explicit Filter_base(const BaseFilter& base) : m_base(base), m_refusals(std::make_shared<std::size_t>(0)) {}

  /// The placement itself when base and filter accept it, none otherwise.
  template <class Profile, class OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    const OptionalPoint accepted = m_base(profile, placement);
    if (!accepted || static_cast<const Derived&>(*this).accepts(profile, *accepted))
      return accepted;
    ++*m_refusals;
    return {};
  }

  /// How many placements this filter refused that its base had accepted; copies count together.
  std::size_t refusals() const { return *m_refusals; }

private:
  BaseFilter m_base;
  std::shared_ptr<std::size_t> m_refusals;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_FILTER_BASE_H
