// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_COVERING_H
#define SELVEDGE_SRC_VERIFY_COVERING_H

#include "Surface_tree.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace selvedge::internal {

/// Knows which triangles of a surface are neighbours, for searches that cover a triangle with them.
///
/// Edges are identified by the positions of their ends, so that a surface continues across its seams.
class Neighbours
{
public:
  /// **Preconditions** The surface outlives this object.
  ///
  /// **Complexity** O(n log n).
  explicit Neighbours(const Surface& surface);

  const Surface& surface() const { return m_surface; }

  /// Returns the next of the sides at one edge, in a circle. Side i of triangle t, from its corner i to the
  /// next one, has the number 3t + i. At a border, and in a triangle with two corners at one position, a side
  /// is alone.
  Index next_at_edge(Index side) const { return m_next[side]; }

private:
  const Surface& m_surface;
  std::vector<Index> m_next; // by side
};

/// Bounds how far the points of a triangle are from a surface.
///
/// It projects triangles of the surface onto the plane of the given one, which their projections divide into
/// convex polygons. As the distance to one triangle is convex, no point of a polygon is farther from the
/// triangle above it than some corner of the polygon is.
///
/// **Guarantees** The polygons cover the triangle. The search begins at a triangle whose projection overlaps
/// it, and goes across each edge whose projection crosses its interior to a neighbour on the other side of
/// this edge; it fails where there is none. So nothing that is covered ends inside, but perhaps at the
/// projection of a vertex, around which all is covered.
///
/// **Exactness** Projected points are rounded. How they lie to each other is decided exactly, and equal
/// points have equal projections. Corners of polygons and distances are rounded; cuts keep what rounding
/// leaves undecided, so that the polygons cover the triangle all the same.
///
/// **Complexity** Linear in the number of times that it looks at a triangle of the surface. In one search
/// that is not much more than 16,000 times, unless more triangles share an edge.
class Covering_search
{
public:
  /// **Preconditions** The argument outlives the search. One thread at a time uses it.
  explicit Covering_search(const Neighbours& neighbours);

  struct Farthest
  {
    Point_3 point;           ///< of the triangle
    double squared_distance; ///< from the triangle of the surface above it: no point is farther
  };

  /// Returns the corner of a polygon that is farthest from the triangle above it; none when the triangle is
  /// not covered, or when a squared distance is not less than `limit`. The search begins near three triangles
  /// of the surface.
  std::optional<Farthest> farthest(const std::array<Point_3, 3>& corners, const Index_triple& near,
                                   double limit);

  /// Returns how many times it has looked at a triangle of the surface, in all searches.
  std::size_t looks() const { return m_looks; }

private:
  using Point_2 = Kernel::Point_2;

  /// A triangle of the surface in the plane of the given one.
  struct Projection
  {
    Index triangle;
    std::array<Point_2, 3> corners;
    int turn; // 1 when they run as those of the given one, −1 when against it, 0 when on a line
    // On which side of line i, which joins corner i to the next one, corner j of the other triangle lies: 1
    // on the inner side, −1 on the outer one. Of lines of the given triangle, and of those of this one.
    std::array<std::array<int, 3>, 3> at_given, at_this;
  };

  bool set_plane(const std::array<Point_3, 3>& corners);
  Point_2 projected(const Point_3& point) const;
  Projection projected(Index triangle);
  static bool overlaps(const Projection& projection);
  static bool crosses(const Projection& projection, int side);
  std::optional<Index> neighbour_beyond(const Projection& projection, int side);
  std::optional<Index> overlapping(const Index_triple& near);
  void find_farther(const Projection& projection, Farthest& farthest) const;

  void forget_visits() { ++m_time; }
  bool visit(Index triangle); // returns whether it is new

  const Neighbours& m_neighbours;
  std::vector<Index> m_visited; // by triangle of the surface: when it was
  Index m_time = 0;
  std::vector<Index> m_queue;
  std::size_t m_looks = 0;

  // The given triangle.
  Point_3 m_origin;
  Vector_3 m_x, m_y;
  std::array<Point_2, 3> m_corners;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_COVERING_H
