// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "obstacle.h"

namespace selvedge {

void append_obstacle(Triangle_soup& soup, const Triangle_soup& obstacle)
{
  const Index offset = Index(soup.points.size());
  soup.points.insert(soup.points.end(), obstacle.points.begin(), obstacle.points.end());
  for (const auto& [a, b, c] : obstacle.triangles)
    soup.triangles.push_back({a + offset, b + offset, c + offset});
}

void remove_obstacle(Triangle_soup& soup, const Triangle_soup& obstacle)
{
  soup.points.erase(soup.points.end() - obstacle.points.size(), soup.points.end());
  soup.triangles.resize(soup.triangles.size() - obstacle.triangles.size());
}

Triangle_soup geometry_with_obstacle(const Triangle_soup& soup, const Triangle_soup& obstacle)
{
  Triangle_soup both;
  both.points = soup.points;
  both.triangles = soup.triangles;
  append_obstacle(both, obstacle);
  return both;
}

} // namespace selvedge
