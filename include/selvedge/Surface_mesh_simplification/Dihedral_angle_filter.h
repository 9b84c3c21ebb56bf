// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_DIHEDRAL_ANGLE_FILTER_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_DIHEDRAL_ANGLE_FILTER_H

#include <selvedge/Surface_mesh_simplification/internal/Filter_base.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace selvedge {

/// Refuses a collapse after which a changed face and a neighbour of it make a dihedral angle of less than one
/// degree, so that they are folded onto each other, or differ in area by a factor of 10⁴ or more.
///
/// This is the geometric test that CGAL's loop, and `selvedge::edge_collapse` unless it is told otherwise,
/// makes of every placement before asking the filter.
///
/// A model of CGAL's concept `PlacementFilter`, usable with any placement.
///
/// **Exactness** That of the number type. The filter limits quality.
template <class BaseFilter = No_filter>
class Dihedral_angle_filter : public internal::Filter_base<Dihedral_angle_filter<BaseFilter>, BaseFilter>
{
public:
  Dihedral_angle_filter() : Dihedral_angle_filter(BaseFilter()) {}
  explicit Dihedral_angle_filter(const BaseFilter& base)
      : internal::Filter_base<Dihedral_angle_filter, BaseFilter>(base)
  {
  }

  template <class Collapse>
  bool accepts(const Collapse& collapse) const
  {
    const auto& profile = collapse.profile();
    const auto& placement = collapse.place();
    const auto& link = profile.link();
    for (std::size_t i = 0; i < link.size(); ++i) {
      const auto before = link[(i + link.size() - 1) % link.size()], here = link[i],
                 after = link[(i + 1) % link.size()];
      const auto to_here = connection(profile, before, here);
      const auto from_here = after == before ? decltype(to_here)() : connection(profile, here, after);
      if (to_here && from_here &&
          !is_open(placement, point(profile, before), point(profile, here), point(profile, after)))
        return false;
      for (const auto& h : {to_here, from_here}) {
        if (!h)
          continue;
        const auto beyond = third_corner_outside(profile, *h);
        if (beyond && !is_open(point(profile, source(*h, profile.surface_mesh())), point(profile, *beyond),
                               point(profile, target(*h, profile.surface_mesh())), placement))
          return false;
      }
    }
    return true;
  }

private:
  template <class Profile>
  static auto point(const Profile& profile, typename Profile::vertex_descriptor v)
  {
    return get(profile.vertex_point_map(), v);
  }

  template <class Profile>
  static std::optional<typename Profile::halfedge_descriptor>
  connection(const Profile& profile, typename Profile::vertex_descriptor from,
             typename Profile::vertex_descriptor to)
  {
    const auto& mesh = profile.surface_mesh();
    for (const auto h : CGAL::halfedges_around_source(from, mesh))
      if (target(h, mesh) == to)
        return h;
    return std::nullopt;
  }

  // Returns the third corner of the face at a link edge that contains neither end of the profile's edge.
  template <class Profile>
  static std::optional<typename Profile::vertex_descriptor>
  third_corner_outside(const Profile& profile, typename Profile::halfedge_descriptor h)
  {
    const auto& mesh = profile.surface_mesh();
    for (const auto side : {h, opposite(h, mesh)}) {
      const auto corner = target(next(side, mesh), mesh);
      if (corner == source(prev(side, mesh), mesh) && corner != profile.v0() && corner != profile.v1())
        return corner;
    }
    return std::nullopt;
  }

  // Whether the triangles (p0, p1, p2) and (p0, p2, p3) pass the test.
  template <class Point>
  static bool is_open(const Point& p0, const Point& p1, const Point& p2, const Point& p3)
  {
    const auto first = CGAL::cross_product(p1 - p0, p2 - p0);
    const auto second = CGAL::cross_product(p2 - p0, p3 - p0);
    const auto a = first * first, b = second * second, product = first * second;
    if (!((std::max)(a, b) < 1e8 * (std::min)(a, b)))
      return false;
    const double cosine = std::cos(CGAL_PI / 180);
    return CGAL::is_positive(product) || product * product <= cosine * cosine * (a * b);
  }
};

} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_DIHEDRAL_ANGLE_FILTER_H
