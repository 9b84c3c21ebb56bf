// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Hull.h"

#include <CGAL/intersections.h>
#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <vector>

namespace selvedge::test {

Hull::Hull(const Place& p, const Place& q, const Place& r)
    : m_corners{p, q, r, r}, m_size(3), m_orientation(CGAL::COPLANAR)
{
  add_triangle(0, 1, 2);
}

Hull::Hull(const Place& m, const Place& t, const Place& a, const Place& b)
    : m_corners{m, t, a, b}, m_size(4), m_orientation(CGAL::orientation(m.at, t.at, a.at, b.at))
{
  for (std::size_t opposite = 0; opposite < 4; ++opposite) {
    m_opposite_corners[m_triangle_count] = opposite;
    add_triangle(opposite == 0 ? 1 : 0, opposite <= 1 ? 2 : 1, opposite <= 2 ? 3 : 2);
  }
}

// Only proper triangles are added. Those of four coplanar points cover the hull of these.
void Hull::add_triangle(std::size_t i, std::size_t j, std::size_t k)
{
  const Point_3 &p = m_corners[i].at, &q = m_corners[j].at, &r = m_corners[k].at;
  if (m_orientation != CGAL::COPLANAR || !CGAL::collinear(p, q, r))
    m_triangles[m_triangle_count++] = Triangle(p, q, r);
}

bool Hull::has_corner(const Place& place) const
{
  return std::any_of(m_corners.begin(), m_corners.begin() + m_size,
                     [&](const Place& corner) { return corner.position == place.position; });
}

bool Hull::contains(const Point_3& point) const
{
  if (m_orientation == CGAL::COPLANAR)
    return std::any_of(m_triangles.begin(), m_triangles.begin() + m_triangle_count,
                       [&](const Triangle& triangle) { return CGAL::do_intersect(triangle, point); });
  for (std::size_t i = 0; i < 4; ++i) {
    const Triangle& facet = m_triangles[i];
    const Point_3& inside = m_corners[m_opposite_corners[i]].at;
    if (CGAL::orientation(facet[0], facet[1], facet[2], point) ==
        -CGAL::orientation(facet[0], facet[1], facet[2], inside))
      return false;
  }
  return true;
}

namespace {

using Places = boost::container::static_vector<Place, 4>;

/// Whether a plane parts two sets of places: the others are on one side, but for some in the plane that are
/// shared, and the own ones are not on that side. Then the hulls meet in the hull of what they share.
template <class Side_of>
bool parts(const Places& own, const Places& others, const Side_of& side_of)
{
  CGAL::Orientation beyond = CGAL::COPLANAR;
  for (const Place& place : others) {
    const CGAL::Orientation side = side_of(place);
    const auto is_this = [&](const Place& other) { return other.position == place.position; };
    if (side == CGAL::COPLANAR ? std::none_of(own.begin(), own.end(), is_this) : beyond == -side)
      return false;
    beyond = side == CGAL::COPLANAR ? beyond : side;
  }
  return std::none_of(own.begin(), own.end(), [&](const Place& place) {
    return beyond != CGAL::COPLANAR && side_of(place) == beyond;
  });
}

/// Does the plane through some three of the own places?
bool parts_by_triple(const Places& own, const Places& others)
{
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Place &p = own[i], &q = own[j], &r = own[k];
        const auto side_of = [&](const Place& place) {
          const bool is_one =
              place.position == p.position || place.position == q.position || place.position == r.position;
          return is_one ? CGAL::COPLANAR : CGAL::orientation(p.at, q.at, r.at, place.at);
        };
        if (parts(own, others, side_of))
          return true;
      }
  return false;
}

/// Does the plane through some two of the own places and along an axis?
bool parts_by_pair(const Places& own, const Places& others, int axis)
{
  const auto seen = [u = (axis + 1) % 3, v = (axis + 2) % 3](const Place& place) {
    return Kernel::Point_2(place.at[u], place.at[v]);
  };
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto side_of = [&](const Place& place) {
        const bool is_one = place.position == own[i].position || place.position == own[j].position;
        return is_one ? CGAL::COPLANAR : CGAL::orientation(seen(own[i]), seen(own[j]), seen(place));
      };
      if (parts(own, others, side_of))
        return true;
    }
  return false;
}

} // namespace

// Whether the two surely meet in no more than they share.
template <class Object>
bool Hull::is_parted_from(const Object& object) const
{
  const Places own(m_corners.begin(), m_corners.begin() + m_size), others(object.begin(), object.end());
  if (parts_by_triple(own, others) || parts_by_triple(others, own))
    return true;
  for (int axis = 0; axis < 3; ++axis)
    if (parts_by_pair(own, others, axis) || parts_by_pair(others, own, axis))
      return true;
  return false;
}

template <class Object>
bool Hull::meets(const Object& object) const
{
  return std::any_of(m_triangles.begin(), m_triangles.begin() + m_triangle_count,
                     [&](const Triangle& triangle) { return CGAL::do_intersect(triangle, object); }) ||
         (m_orientation != CGAL::COPLANAR && contains(object[0]));
}

namespace {

bool is_between(const Point_3& p, const Point_3& x, const Point_3& q)
{
  return CGAL::do_overlap(x.bbox(), p.bbox() + q.bbox()) && CGAL::are_ordered_along_line(p, x, q);
}

} // namespace

// Whether the part of the boundary through which rays from a corner leave meets an object that is no point.
template <class Object>
bool Hull::side_without_meets(const Place& corner, const Object& object) const
{
  if (m_orientation != CGAL::COPLANAR) {
    for (std::size_t i = 0; i < 4; ++i)
      if (m_corners[m_opposite_corners[i]].position == corner.position)
        return CGAL::do_intersect(m_triangles[i], object);
  }
  for (std::size_t i = 0; i < m_size; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Place &p = m_corners[i], &q = m_corners[j];
      const bool has_corner =
          p.position == corner.position || q.position == corner.position || is_between(p.at, corner.at, q.at);
      if (!has_corner && CGAL::do_intersect(Segment(p.at, q.at), object))
        return true;
    }
  return false;
}

// Beyond its source, which is a corner.
bool Hull::meets_segment_beyond(const Place& shared, const Place& end) const
{
  return contains(end.at) || side_without_meets(shared, Segment(shared.at, end.at));
}

// Of a proper face (x, y, z) whose edge xy is between two corners.
bool Hull::meets_face_at_edge(const Place& x, const Place& y, const Place& z) const
{
  std::array<Point_3, 2> others;
  std::size_t count = 0;
  for (std::size_t i = 0; i < m_size; ++i)
    if (m_corners[i].position != x.position && m_corners[i].position != y.position)
      others[count++] = m_corners[i].at;
  if (m_orientation != CGAL::COPLANAR) {
    // At inner points of the edge the tetrahedron is a wedge between two of its facets.
    const auto& [p, q] = others;
    const CGAL::Orientation inward = CGAL::orientation(x.at, y.at, p, q);
    return CGAL::orientation(x.at, y.at, p, z.at) != -inward &&
           CGAL::orientation(x.at, y.at, z.at, q) != -inward;
  }
  return std::any_of(others.begin(), others.begin() + count, [&](const Point_3& p) {
    return !CGAL::collinear(x.at, y.at, p) && CGAL::coplanar(x.at, y.at, p, z.at) &&
           CGAL::coplanar_orientation(x.at, y.at, p, z.at) == CGAL::POSITIVE;
  });
}

bool Hull::meets_collinear_face(const Standing_face& face) const
{
  Standing_face f = face; // its middle first, or one of two corners at one place
  for (std::size_t k = 0; k < 3; ++k)
    if (const Place& next = face[(k + 1) % 3], &last = face[(k + 2) % 3];
        face[k].at == next.at ||
        CGAL::collinear_are_strictly_ordered_along_line(next.at, face[k].at, last.at))
      f = {face[k], next, last};
  const bool is_shared[3] = {has_corner(f[0]), has_corner(f[1]), has_corner(f[2])};
  if (!is_shared[0] && is_shared[1] != is_shared[2])
    return is_shared[1] ? meets_segment_beyond(f[1], f[2]) : meets_segment_beyond(f[2], f[1]);
  if (!is_shared[0])
    return !is_shared[1] && (f[1].at == f[2].at ? contains(f[1].at) : meets(Segment(f[1].at, f[2].at)));
  return (!is_shared[1] && meets_segment_beyond(f[0], f[1])) ||
         (!is_shared[2] && meets_segment_beyond(f[0], f[2]));
}

bool Hull::meets_beyond_shared(const Standing_face& face) const
{
  Standing_face f = face; // what is shared first
  const auto end_of_shared =
      std::stable_partition(f.begin(), f.end(), [this](const Place& place) { return has_corner(place); });
  const auto shared = end_of_shared - f.begin();
  if (shared == 3)
    return true;
  if (is_parted_from(f))
    return false;
  if (CGAL::collinear(f[0].at, f[1].at, f[2].at))
    return meets_collinear_face(face);
  if (shared == 2)
    return meets_face_at_edge(f[0], f[1], f[2]);
  const Triangle triangle(f[0].at, f[1].at, f[2].at);
  if (shared == 1)
    return meets(Segment(f[1].at, f[2].at)) || side_without_meets(f[0], triangle);
  return meets(triangle);
}

bool Hull::meets_beyond_shared(const Standing_edge& edge) const
{
  const bool is_first_shared = has_corner(edge[0]), is_second_shared = has_corner(edge[1]);
  if ((is_first_shared && is_second_shared) || is_parted_from(edge))
    return false;
  if (is_first_shared || is_second_shared)
    return meets_segment_beyond(edge[is_first_shared ? 0 : 1], edge[is_first_shared ? 1 : 0]);
  return meets(Segment(edge[0].at, edge[1].at));
}

bool do_segments_meet_beyond_shared(const Standing_face& f, const Standing_face& g)
{
  const auto comes_before = [](const Place& p, const Place& q) { return p.at < q.at; };
  const auto ends = [&](const auto& places) {
    const auto [first, last] = std::minmax_element(places.begin(), places.end(), comes_before);
    return std::array{first->at, last->at};
  };
  std::vector<Place> shared;
  for (const Place& p : f)
    for (const Place& q : g)
      if (p.position == q.position)
        shared.push_back(p);
  const auto [a, b] = ends(f);
  const auto [c, d] = ends(g);
  if (shared.size() == 3)
    return true;
  if (!CGAL::do_intersect(Kernel::Segment_3(a, b), Kernel::Segment_3(c, d)))
    return false;
  if (shared.empty())
    return true;
  return CGAL::collinear(a, b, c) && CGAL::collinear(a, b, d) &&
         ends(shared) != std::array{std::max(a, c), std::min(b, d)};
}

bool degenerates_on_the_way(const Point_3& m, const Point_3& t, const Point_3& a, const Point_3& b)
{
  return CGAL::coplanar(m, t, a, b) && CGAL::coplanar_orientation(a, b, m, t) != CGAL::POSITIVE;
}

} // namespace selvedge::test
