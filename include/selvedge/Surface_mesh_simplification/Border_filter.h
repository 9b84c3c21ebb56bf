// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_BORDER_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_BORDER_FILTER_H

#include <selvedge/Surface_mesh_simplification/Border_rule.h>
#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>
#include <selvedge/Surface_mesh_simplification/internal/No_visitor.h>

namespace selvedge {

/// Refuses a placement that a `Border_rule` does not allow.
///
/// A model of CGAL's concept `PlacementFilter`, usable with any placement. Give the loop a `Border_visitor`
/// of the same rule as well: it updates marks, locks and drift as edges collapse.
template <class Rule, class BaseFilter = No_filter>
class Border_filter : public internal::Filter_base<Border_filter<Rule, BaseFilter>, BaseFilter>
{
public:
  explicit Border_filter(const Rule& rule, const BaseFilter& base = {})
      : internal::Filter_base<Border_filter, BaseFilter>(base), m_rule(rule)
  {
  }

  template <class Collapse>
  bool accepts(const Collapse& collapse) const
  {
    return m_rule.allows(collapse);
  }

private:
  Rule m_rule;
};

/// Updates a `Border_rule` while edges collapse. CGAL's loop begins by collapsing edges of length zero
/// without asking or announcing it; the vertices that are left there are locked.
///
/// A model of CGAL's concept `EdgeCollapseSimplificationVisitor`.
template <class TriangleMesh, class Rule = Border_rule<TriangleMesh>>
class Border_visitor : public internal::No_visitor
{
public:
  explicit Border_visitor(const Rule& rule) : m_rule(rule) {}

  template <class Profile, class OptionalPoint>
  void OnCollapsing(const Profile& profile, const OptionalPoint& placement)
  {
    before_collapse(internal::Collapse<Profile>(profile, *placement));
  }

  /// The same for a loop that passes each collapse as a value, which says which end moves.
  template <class Collapse>
  void before_collapse(const Collapse& collapse)
  {
    m_rule.before_collapse(collapse);
  }
  template <class Profile, class Vertex>
  void OnCollapsed(const Profile&, const Vertex& kept)
  {
    m_rule.after_collapse(kept);
  }

private:
  Rule m_rule;
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_BORDER_FILTER_H
