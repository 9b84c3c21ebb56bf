// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vertex_normals.h"

#include "triangle_normals.h"

#include <selvedge/Cancellation_scope.h>

#include <cstddef>

namespace selvedge {

Vertex_normals vertex_normals(const Triangle_soup& soup, const std::vector<Index>& positions,
                              const std::vector<char>& is_turned, const std::vector<Index>& fronts)
{
  Vertex_normals sums(soup.points.size(), {0, 0, 0}); // at the first vertex of each position
  Cancellation_poll poll;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    poll();
    if (!fronts.empty() && fronts[t] != t)
      continue;
    const shading::Vector normal = shading::unit_normal(soup, t);
    const double side = !is_turned.empty() && is_turned[t] ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = side * shading::angle_at(soup, 3 * t + Index(k));
      std::array<double, 3>& sum = sums[positions[soup.triangles[t][k]]];
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += weight * normal[i];
    }
  }
  Vertex_normals normals;
  normals.reserve(sums.size());
  for (const Index position : positions)
    normals.push_back(shading::unit(sums[position]));
  return normals;
}

} // namespace selvedge
