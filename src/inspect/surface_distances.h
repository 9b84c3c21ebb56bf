// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_INSPECT_SURFACE_DISTANCES_H
#define SELVEDGE_SRC_INSPECT_SURFACE_DISTANCES_H

#include <selvedge/verify.h>

#include <limits>
#include <vector>

namespace selvedge::internal {

/// How far a surface is from the nearest other one.
struct Surface_distance
{
  double distance = std::numeric_limits<double>::infinity();
  Index nearest = std::numeric_limits<Index>::max(); ///< none when the distance is infinite
};

/// Returns, for each of `count` surfaces, how far the nearest other one is. `surface_of[t]` is the surface of
/// triangle t; surfaces have no position in common. `pairs` are the offending pairs of the soup. Of several
/// surfaces at the same distance, it returns the one that it finds first, always the same.
///
/// Distances are computed in double and do not overflow when coordinates are at most 1. They are 0 where two
/// triangles offend, and nowhere else: distances of less than 1e-153 may be rounded up to that.
std::vector<Surface_distance> surface_distances(const std::vector<Point_3>& points,
                                                const std::vector<Index_triple>& triangles,
                                                const std::vector<Index>& surface_of, std::size_t count,
                                                const std::vector<Offending_pair>& pairs);

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_INSPECT_SURFACE_DISTANCES_H
