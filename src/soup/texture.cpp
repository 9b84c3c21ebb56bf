// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "texture.h"

#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace selvedge {

namespace {

// Rounds to fewer digits, which hardly ever depend on the order in which areas were added.
double rounded_unit(double unit)
{
  constexpr int bits = 24;
  int exponent = 0;
  const double fraction = std::frexp(unit, &exponent);
  return std::ldexp(std::round(std::ldexp(fraction, bits)), exponent - bits);
}

// Across a thinner triangle, normals turn by what lies on its two sides, over a width that means nothing.
constexpr double s_aspect_ratio_of_sliver = 0.01;

bool is_sliver(const std::array<Point_3, 3>& points, double area)
{
  const auto squared = [&](std::size_t k, std::size_t l) {
    return CGAL::to_double(CGAL::squared_distance(points[k], points[l]));
  };
  const double longest = std::max({squared(0, 1), squared(1, 2), squared(2, 0)});
  return !(4 / std::sqrt(3.0) * area >= s_aspect_ratio_of_sliver * longest);
}

} // namespace

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
  return rounded_unit(std::sqrt(area / uv_area));
}

double normal_unit(const Triangle_soup& soup, const Scale& scale, const Vertex_normals* of_vertices)
{
  if (!of_vertices && soup.normals.empty())
    return 0;
  using Direction = std::array<double, 3>;
  double area = 0, turns = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    std::array<Point_3, 3> points;
    std::array<Direction, 3> normals;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = soup.triangles[t][k];
      points[k] = scale(soup.points[v]);
      normals[k] = of_vertices ? (*of_vertices)[v] : soup.normals.values[soup.normals.of_triangle[t][k]];
    }
    const double of_triangle = std::sqrt(CGAL::squared_area(points[0], points[1], points[2]));
    if (!(of_triangle > 0) || is_sliver(points, of_triangle))
      continue;
    // The integral of the squared gradient: the sum of cot(angle) / 2 × squared turn along the edge beyond.
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      const double cotangent = (points[l] - points[k]) * (points[m] - points[k]) / (2 * of_triangle);
      double squared = 0;
      for (std::size_t i = 0; i < 3; ++i)
        squared += (normals[l][i] - normals[m][i]) * (normals[l][i] - normals[m][i]);
      sum += cotangent * squared / 2;
    }
    area += of_triangle;
    turns += std::max(0.0, sum);
  }
  return turns > 0 ? rounded_unit(std::sqrt(2 * area / turns)) : 0;
}

} // namespace selvedge
