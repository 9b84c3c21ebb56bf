// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "texture.h"

#include <CGAL/Kernel/global_functions.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace selvedge {

double uv_unit(const Triangle_soup& soup, const Scale& scale)
{
  double area = 0, uv_area = 0;
  for (std::size_t t = 0; t < soup.uvs.of_triangle.size(); ++t) {
    const auto uv = [&](std::size_t k) -> const std::array<double, 2>& {
      return soup.uvs.values[soup.uvs.of_triangle[t][k]];
    };
    const double twice =
        (uv(1)[0] - uv(0)[0]) * (uv(2)[1] - uv(0)[1]) - (uv(1)[1] - uv(0)[1]) * (uv(2)[0] - uv(0)[0]);
    if (twice == 0)
      continue; // no texture on this triangle
    const auto& [a, b, c] = soup.triangles[t];
    uv_area += std::abs(twice) / 2;
    area +=
        std::sqrt(CGAL::squared_area(scale(soup.points[a]), scale(soup.points[b]), scale(soup.points[c])));
  }
  if (!(uv_area > 0))
    return 0;
  // Rounded to fewer digits, which hardly ever depend on the order in which areas were added.
  constexpr int bits = 24;
  int exponent = 0;
  const double fraction = std::frexp(std::sqrt(area / uv_area), &exponent);
  return std::ldexp(std::round(std::ldexp(fraction, bits)), exponent - bits);
}

} // namespace selvedge
