// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_SIDES_H
#define SELVEDGE_VERIFY_SIDES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <vector>

// The sides of triangles in an order in which those at one edge follow each other.

namespace selvedge::internal {

/// The side of a triangle, from the end with the lower vertex number to the other. Corner i of triangle t has
/// the number 3t + i.
struct Side
{
  Index low, high;
  std::size_t corner_at_low, corner_at_high;
};

/// Whether the corners of a triangle are three.
inline bool is_face(const Index_triple& corners)
{
  return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

/// Returns the sides of all triangles that have three corners, sorted by their lower ends (in linear time),
/// then by their other ends, then by corners. All corners are below `vertices`.
std::vector<Side> sorted_sides(const std::vector<Index_triple>& triangles, std::size_t vertices);

/// Returns them with the numbers of positions in place of those of vertices.
std::vector<Side> sides_between_positions(const std::vector<Point_3>& points,
                                          std::vector<Index_triple> triangles);

} // namespace selvedge::internal

#endif // SELVEDGE_VERIFY_SIDES_H
