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
double chord_at(const Triangle_soup& soup, Index triangle, std::size_t place)
{
  const Index_triple& v = soup.triangles[triangle];
  const Point_3& p = soup.points[v[place]];
  const Vector u = shading::unit(shading::difference(soup.points[v[(place + 1) % 3]], p)),
               w = shading::unit(shading::difference(soup.points[v[(place + 2) % 3]], p));
  const Vector chord = internal::difference(u, w);
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
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = side * chord_at(soup, t, k);
      Vector& sum = sums[positions[soup.triangles[t][k]]];
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += weight * normal[i];
    }
  }
  Vertex_normals normals;
  normals.reserve(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) // further positions are those of an obstacle
    normals.push_back(shading::unit(sums[positions[v]]));
  return normals;
}

} // namespace selvedge
