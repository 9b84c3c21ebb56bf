// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_POLYGON_STARTS_H
#define SELVEDGE_SRC_FILES_POLYGON_STARTS_H

#include <selvedge/Triangle_soup.h>

#include <boost/functional/hash.hpp>

#include <unordered_map>
#include <vector>

namespace selvedge::files {

/// Selects the corner from which a polygon is cut: its first one, or the one that lies where an earlier
/// polygon with the same corners, in any order, was cut from. The two sides of a garment that has a back of
/// its own, and names its quads backwards there, are so cut along the same diagonals.
///
/// Every position of a corner is a valid place to start. So polygons that are confused, because their hashes
/// are the same, are cut otherwise, but not wrongly.
class Polygon_starts
{
public:
  /// Returns the place in `corners` at which to start. Takes constant time for each corner.
  std::size_t operator()(const std::vector<Point_3>& points, const std::vector<Index>& corners)
  {
    std::size_t hash = 0; // the same for any order of the corners
    for (const Index corner : corners)
      hash += hash_of(points[corner]);
    const Point_3& first = points[m_vertices.try_emplace(hash, corners[0]).first->second];
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (points[corners[k]] == first)
        return k;
    return 0;
  }

private:
  static std::size_t hash_of(const Point_3& point)
  {
    std::size_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
      boost::hash_combine(hash, point[axis] + 0.0); // −0 becomes 0
    return hash;
  }

  std::unordered_map<std::size_t, Index> m_vertices; // by the hash of a polygon
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_POLYGON_STARTS_H
