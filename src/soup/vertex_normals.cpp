// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vertex_normals.h"

#include "triangle_normals.h"

#include <selvedge/Cancellation_scope.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace selvedge {
namespace {

using shading::Vector;

// Returns the chord of the angle between the directions of two edges that follow each other around a
// triangle: twice the sine of half the angle. Unlike the angle, it is the same on every machine, and so is
// the order of collapses.
double chord_between(const Vector& from, const Vector& on)
{
  const Vector chord{on[0] + from[0], on[1] + from[1], on[2] + from[2]};
  return std::sqrt(internal::dot(chord, chord));
}

} // namespace

Vertex_normals vertex_normals(const Triangle_soup& soup, const std::vector<Index>& positions,
                              const std::vector<char>& is_turned, const std::vector<Index>& fronts)
{
  Vertex_normals sums(soup.points.size(), {0, 0, 0}); // at the first vertex of each position
  Cancellation_poll poll;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    poll();
    if (!fronts.empty() && fronts[t] != t)
      continue;
    const Index_triple& corners = soup.triangles[t];
    std::array<Vector, 3> along; // of the edge that begins at each corner
    for (std::size_t k = 0; k < 3; ++k)
      along[k] =
          shading::unit(shading::difference(soup.points[corners[(k + 1) % 3]], soup.points[corners[k]]));
    const Vector normal = shading::unit(internal::cross(along[2], along[0]));
    const double side = !is_turned.empty() && is_turned[t] ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k)
      shading::add(sums[positions[corners[k]]], normal, side * chord_between(along[(k + 2) % 3], along[k]));
  }
  Vertex_normals normals;
  normals.reserve(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) // further positions are those of an obstacle
    normals.push_back(shading::unit(sums[positions[v]]));
  return normals;
}

} // namespace selvedge
