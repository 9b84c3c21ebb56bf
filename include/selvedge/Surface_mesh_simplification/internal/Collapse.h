// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_H
#define SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_H

#include <selvedge/Surface_mesh_simplification/internal/cgal_compatibility.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <cmath>
#include <tuple>
#include <vector>

namespace selvedge {
namespace internal {

/// Where the merged vertex of an edge is placed: at one of its ends, or at a point that is neither.
enum class Merged_at : unsigned char { v0, v1, between };

/// A place that a placement policy offers for the merged vertex, and its cost; none when the edge has no
/// cost.
struct Placement_choice
{
  Merged_at at;
  Optional<double> cost;
};

/// Describes one collapse of an edge: the profile of the edge, the place of the merged vertex, and which ends
/// move to get there. Where all vertices at a position move together, the collapses of the others go along.
///
/// Whoever decides on a collapse makes this value once and hands it to the filters, the border rule and the
/// listeners, so that none of them has to compare coordinates. It is valid as long as the profile is.
template <class Profile_>
class Collapse
{
public:
  using Profile = Profile_;
  using Point = typename Profile::Point;
  using Vertex = typename Profile::vertex_descriptor;
  using Halfedge = typename Profile::halfedge_descriptor;

  /// Makes the collapse in which the source of `moving`, a halfedge of the profile's edge, moves onto its
  /// target.
  static Collapse along(const Profile& profile, Halfedge moving)
  {
    const bool is_onto_v0 = moving == profile.v1_v0();
    return Collapse(profile, is_onto_v0 ? profile.p0() : profile.p1(), !is_onto_v0, is_onto_v0, is_onto_v0);
  }

  /// Makes the collapse for a placement chosen by any other policy. An end moves unless it is at `place`.
  Collapse(const Profile& profile, const Point& place)
      : Collapse(profile, place, place != profile.p0(), place != profile.p1(), is_v0_nearer(profile, place))
  {
  }

  /// Returns whether all coordinates of a place are finite: there is no collapse to any other.
  static bool is_place(const Point& place)
  {
    const CGAL::Bbox_3 box = place.bbox();
    return std::isfinite(box.x_span()) && std::isfinite(box.y_span()) && std::isfinite(box.z_span());
  }

  const Profile& profile() const { return *m_profile; }
  const Point& place() const { return m_place; }
  bool is_v0_moved() const { return m_is_v0_moved; }
  bool is_v1_moved() const { return m_is_v1_moved; }

  /// Returns this collapse, onto an end of its edge, with the collapses that go along with it: those of all
  /// other vertices at the position of its mover, onto vertices at the position of its goal. They are given
  /// as halfedges from the vertices that move, and outlive what is returned. All are judged as one motion;
  /// the others are done after this one, and nothing is asked in between.
  Collapse with_others(const std::vector<Halfedge>& others) const
  {
    Collapse collapse = *this;
    collapse.m_others = &others;
    return collapse;
  }
  const std::vector<Halfedge>& others() const
  {
    static const std::vector<Halfedge> none;
    return m_others ? *m_others : none;
  }

  /// Returns whether the merged vertex is placed at neither end.
  bool are_both_moved() const { return m_is_v0_moved && m_is_v1_moved; }

  /// Returns where the merged vertex is placed.
  Merged_at merged_at() const
  {
    if (are_both_moved())
      return Merged_at::between;
    return m_is_v1_moved ? Merged_at::v0 : Merged_at::v1;
  }

  /// The halfedge along which a vertex moves, its source and its target. Where both ends move, the target is
  /// the end that is nearer to the place (v1 if both are as near), so that what belongs to vertices and
  /// cannot be mixed is that of the nearer end.
  Halfedge moving() const { return m_is_onto_v0 ? m_profile->v1_v0() : m_profile->v0_v1(); }
  Vertex mover() const { return m_is_onto_v0 ? m_profile->v1() : m_profile->v0(); }
  Vertex goal() const { return m_is_onto_v0 ? m_profile->v0() : m_profile->v1(); }

  /// Distinguishes this collapse from all others of the same mesh, apart from those that go along with it.
  using Key = std::tuple<Halfedge, bool, Point>;
  Key key() const { return {moving(), are_both_moved(), m_place}; }

  /// Calls `is_fine(h, before, after, a, b)` for every face (v, a, b), counter-clockwise, that the collapse
  /// changes but does not remove, until a call returns false. `h` is its halfedge to v, `before` the position
  /// of v, `after` that of the merged vertex. Returns whether all calls returned true.
  ///
  /// It walks halfedges and allocates nothing, unlike `Profile::triangles()`.
  template <class Predicate>
  bool all_of_changed_faces(Predicate&& is_fine) const
  {
    const auto& mesh = m_profile->surface_mesh();
    const auto points = m_profile->vertex_point_map();
    const auto are_fine_around = [&](Vertex vertex, Vertex other, const Point& before) {
      for (const Halfedge h : CGAL::halfedges_around_target(halfedge(vertex, mesh), mesh)) {
        if (CGAL::is_border(h, mesh))
          continue;
        const Vertex a = target(next(h, mesh), mesh), b = source(h, mesh);
        if (a != other && b != other && !is_fine(h, before, m_place, get(points, a), get(points, b)))
          return false;
      }
      return true;
    };
    return (!m_is_v0_moved || are_fine_around(m_profile->v0(), m_profile->v1(), m_profile->p0())) &&
           (!m_is_v1_moved || are_fine_around(m_profile->v1(), m_profile->v0(), m_profile->p1()));
  }

private:
  Collapse(const Profile& profile, const Point& place, bool is_v0_moved, bool is_v1_moved, bool is_onto_v0)
      : m_profile(&profile), m_place(place), m_is_v0_moved(is_v0_moved), m_is_v1_moved(is_v1_moved),
        m_is_onto_v0(is_onto_v0)
  {
  }

  static bool is_v0_nearer(const Profile& profile, const Point& place)
  {
    if (place == profile.p0() || place == profile.p1())
      return place == profile.p0();
    return CGAL::has_smaller_distance_to_point(place, profile.p0(), profile.p1());
  }

  const Profile* m_profile;
  Point m_place;
  bool m_is_v0_moved, m_is_v1_moved, m_is_onto_v0;
  const std::vector<Halfedge>* m_others = nullptr;
};

} // namespace internal
} // namespace selvedge

#endif // SELVEDGE_SURFACE_MESH_SIMPLIFICATION_INTERNAL_COLLAPSE_H
