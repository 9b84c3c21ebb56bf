// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_POLAR_SPHERE_H
#define SELVEDGE_TEST_SUPPORT_POLAR_SPHERE_H

#include <selvedge/Triangle_soup.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

namespace selvedge::test {

/// A sphere with poles at z = ±1: every triangle there has a texture coordinate of its own at the pole, and a
/// vertex of its own if `is_split`.
inline Triangle_soup polar_sphere(Index segments, Index rings, bool is_split)
{
  Triangle_soup sphere;
  const auto add_corner = [&](double u, double v) {
    sphere.uvs.values.push_back({u, v});
    return Index(sphere.uvs.values.size() - 1);
  };
  std::vector<std::vector<Index>> vertices(rings - 1), uvs(rings - 1);
  for (Index r = 0; r + 1 < rings; ++r)
    for (Index s = 0; s <= segments; ++s) {
      const double height = CGAL_PI * (r + 1) / rings, angle = 2 * CGAL_PI * s / segments;
      if (s < segments) {
        vertices[r].push_back(Index(sphere.points.size()));
        sphere.points.emplace_back(std::sin(height) * std::cos(angle), std::sin(height) * std::sin(angle),
                                   std::cos(height));
      } else
        vertices[r].push_back(vertices[r].front());
      uvs[r].push_back(add_corner(double(s) / segments, 1 - double(r + 1) / rings));
    }
  const auto add_triangle = [&](const Index_triple& of_vertices, const Index_triple& of_uvs) {
    sphere.triangles.push_back(of_vertices);
    sphere.uvs.of_triangle.push_back(of_uvs);
  };
  for (Index r = 0; r + 2 < rings; ++r)
    for (Index s = 0; s < segments; ++s) {
      const auto &v = vertices[r], &w = vertices[r + 1], &a = uvs[r], &b = uvs[r + 1];
      add_triangle({v[s], w[s], w[s + 1]}, {a[s], b[s], b[s + 1]});
      add_triangle({v[s], w[s + 1], v[s + 1]}, {a[s], b[s + 1], a[s + 1]});
    }
  for (const double z : {1., -1.}) {
    const auto &v = z > 0 ? vertices.front() : vertices.back(), &a = z > 0 ? uvs.front() : uvs.back();
    for (Index s = 0; s < segments; ++s) {
      if (s == 0 || is_split)
        sphere.points.emplace_back(0, 0, z);
      const Index pole = Index(sphere.points.size() - 1), corner = add_corner((s + 0.5) / segments, z > 0);
      const Index next = s + 1;
      add_triangle(z > 0 ? Index_triple{pole, v[s], v[next]} : Index_triple{pole, v[next], v[s]},
                   z > 0 ? Index_triple{corner, a[s], a[next]} : Index_triple{corner, a[next], a[s]});
    }
  }
  return sphere;
}

inline bool is_pole(const Point_3& p)
{
  return p.x() == 0 && p.y() == 0;
}

/// Returns how many triangles have a corner at a pole.
inline std::size_t faces_at_poles(const Triangle_soup& soup)
{
  return std::size_t(std::count_if(soup.triangles.begin(), soup.triangles.end(), [&](const Index_triple& t) {
    return std::any_of(t.begin(), t.end(), [&](Index v) { return is_pole(soup.points[v]); });
  }));
}

/// Position and texture coordinates of a corner.
using Corner_facts = std::tuple<double, double, double, double, double>;
inline std::set<Corner_facts> facts_of_corners(const Triangle_soup& soup)
{
  std::set<Corner_facts> result;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& p = soup.points[soup.triangles[t][k]];
      const auto& uv = soup.uvs.values[soup.uvs.of_triangle[t][k]];
      result.emplace(p.x(), p.y(), p.z(), uv[0], uv[1]);
    }
  return result;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_POLAR_SPHERE_H
