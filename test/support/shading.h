// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_SHADING_H
#define SELVEDGE_TEST_SUPPORT_SHADING_H

#include <selvedge/internal/Vector_of_doubles.h>
#include <selvedge/normals.h>
#include <selvedge/prepare.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace selvedge::test {

/// A hem: cloth that goes down, around a thin rim of three edges, and up again on its inside, with waves
/// along it, and the normals of smooth shading.
inline Triangle_soup hem()
{
  const std::array<std::array<double, 2>, 12> profile{{{1, 0.02}, // outside
                                                       {0.75, 0.02},
                                                       {0.5, 0.02},
                                                       {0.25, 0.02},
                                                       {0, 0.02},
                                                       {-0.01, 0.012}, // the rim
                                                       {-0.01, -0.012},
                                                       {0, -0.02}, // inside
                                                       {0.25, -0.02},
                                                       {0.5, -0.02},
                                                       {0.75, -0.02},
                                                       {1, -0.02}}};
  constexpr Index columns = 40;
  Triangle_soup soup;
  for (Index i = 0; i <= columns; ++i)
    for (const auto& [y, z] : profile)
      soup.points.emplace_back(0.1 * i, y, z + 0.05 * std::sin(0.7 * i) * (1.5 + y));
  const Index rows = Index(profile.size());
  for (Index i = 0; i < columns; ++i)
    for (Index j = 0; j + 1 < rows; ++j) {
      const Index a = rows * i + j, b = a + 1, c = a + rows, d = c + 1;
      soup.triangles.push_back({a, b, d});
      soup.triangles.push_back({a, d, c});
    }
  soup.normals.values = {{0, 0, 1}};
  soup.normals.of_triangle.assign(soup.triangles.size(), {0, 0, 0});
  restore_normals(soup, Normals_treatment::smooth);
  return soup;
}

/// Returns how many triangles have a corner at which the normal points to their back.
inline std::size_t count_of_wrong_sides(const Triangle_soup& soup)
{
  std::size_t count = 0;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    std::array<internal::Vector_of_doubles, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& point = soup.points[soup.triangles[t][k]];
      p[k] = {point.x(), point.y(), point.z()};
    }
    const auto front = internal::cross(internal::difference(p[1], p[0]), internal::difference(p[2], p[0]));
    const Index_triple& normals = soup.normals.of_triangle[t];
    count += std::any_of(normals.begin(), normals.end(),
                         [&](Index number) { return internal::dot(front, soup.normals.values[number]) < 0; });
  }
  return count;
}

/// The options by which normals are mended, and not fitted.
inline Prepare_options mending()
{
  Prepare_options options;
  options.normals = Normals_choice::mend;
  return options;
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_SHADING_H
