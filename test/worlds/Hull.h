// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_WORLDS_HULL_H
#define SELVEDGE_TEST_WORLDS_HULL_H

#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstddef>

namespace selvedge::test {

/// A point that knows which position of the mesh it is. Positions are shared when their numbers are equal.
struct Place
{
  Index position;
  Point_3 at;
};

using Standing_face = std::array<Place, 3>;
using Standing_edge = std::array<Place, 2>;

/// The convex hull of three places, a proper triangle, or of four, the sweep of one: what is asked of it is
/// whether something that stands still meets it beyond the positions that they share.
///
/// Everything is decided by CGAL's `do_intersect`, orientations where an edge is shared, and one thought:
/// where two convex sets have a corner x in common and another point y, the ray from x through y leaves one
/// of them in a side that does not have x, and there the other still is. Nothing is shared with the filter or
/// with the replay.
class Hull
{
public:
  Hull(const Place& p, const Place& q, const Place& r);
  Hull(const Place& m, const Place& t, const Place& a, const Place& b);

  /// A face of three collinear corners counts as the segment that it is.
  bool meets_beyond_shared(const Standing_face& face) const;
  bool meets_beyond_shared(const Standing_edge& edge) const;

private:
  using Segment = Kernel::Segment_3;
  using Triangle = Kernel::Triangle_3;

  void add_triangle(std::size_t i, std::size_t j, std::size_t k);
  bool has_corner(const Place& place) const;
  bool contains(const Point_3& point) const;
  template <class Object>
  bool is_parted_from(const Object& object) const;
  template <class Object>
  bool meets(const Object& object) const;
  template <class Object>
  bool side_without_meets(const Place& corner, const Object& object) const;
  bool meets_segment_beyond(const Place& shared, const Place& end) const;
  bool meets_face_at_edge(const Place& x, const Place& y, const Place& z) const;
  bool meets_collinear_face(const Standing_face& face) const;

  std::array<Place, 4> m_corners;
  std::size_t m_size;
  CGAL::Orientation m_orientation;                 // of the four; zero when they are coplanar, or three
  std::array<Triangle, 4> m_triangles;             // proper ones: facets, or a cover of what is flat
  std::array<std::size_t, 4> m_opposite_corners{}; // of facets
  std::size_t m_triangle_count = 0;
};

/// Whether two faces of three collinear corners each, which are segments, meet beyond what they share.
bool do_segments_meet_beyond_shared(const Standing_face& f, const Standing_face& g);

/// Whether a triangle has no area at some time while its corner goes from m to t, and ab stands still; at
/// time 0 it has.
bool degenerates_on_the_way(const Point_3& m, const Point_3& t, const Point_3& a, const Point_3& b);

} // namespace selvedge::test

#endif // SELVEDGE_TEST_WORLDS_HULL_H
