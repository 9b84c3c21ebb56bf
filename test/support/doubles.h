// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_DOUBLES_H
#define SELVEDGE_TEST_SUPPORT_DOUBLES_H

#include "soups.h"

#include <vector>

// A small piece that lies on a sheet, whose vertices a file numbers apart.

namespace selvedge::test {

/// A square of four triangles, with more triangles of its corners (0 to 3) and its middle (4) on it. These
/// have vertices of their own, and their normals have the number `normal`: of the sheet's, or of another.
inline Triangle_soup with_double(const std::vector<Index_triple>& more, Index normal)
{
  const std::vector<Point_3> points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 0}};
  Triangle_soup result = soup(points, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  result.points.insert(result.points.end(), points.begin(), points.end());
  result.normals.values = {{0, 0, 1}, {0, 1, 0}};
  result.normals.of_triangle.assign(4, {0, 0, 0});
  for (const auto& [a, b, c] : more) {
    result.triangles.push_back({a + 5, b + 5, c + 5});
    result.normals.of_triangle.push_back({normal, normal, normal});
  }
  return result;
}

/// A sheet with a piece on its lower right half.
inline Triangle_soup original_with_double()
{
  return with_double({{0, 1, 4}, {1, 2, 4}}, 0);
}

/// What a reduction leaves of it, with new normals, for which a reader joins its vertices with the sheet's.
inline Triangle_soup reduced_double()
{
  return with_double({{0, 1, 2}}, 1);
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_DOUBLES_H
