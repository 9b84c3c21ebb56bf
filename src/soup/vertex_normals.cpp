// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vertex_normals.h"

#include "triangle_normals.h"

#include <selvedge/Cancellation_scope.h>

#include <cmath>
#include <cstddef>

namespace selvedge {
namespace {

using shading::Vector;

// Returns the chord of the angle of a triangle at a corner: twice the sine of its half. Unlike the angle, it
// is the same on every machine, and so is the order of collapses.
double chord_at(const Triangle_soup& soup, Index corner)
{
  const auto [u, v] = shading::directions_at(soup, corner);
  const Vector chord = internal::difference(u, v);
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
    const Vector normal = shading::unit_normal(soup, t);
    const double side = !is_turned.empty() && is_turned[t] ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k)
      shading::add(sums[positions[soup.triangles[t][k]]], normal, side * chord_at(soup, 3 * t + Index(k)));
  }
  Vertex_normals normals;
  normals.reserve(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) // further positions are those of an obstacle
    normals.push_back(shading::unit(sums[positions[v]]));
  return normals;
}

} // namespace selvedge
