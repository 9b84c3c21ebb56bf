// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_TEST_SUPPORT_SOUPS_H
#define SELVEDGE_TEST_SUPPORT_SOUPS_H

#include <selvedge/Triangle_soup.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <random>
#include <utility>
#include <vector>

/// Tiny soups made by hand, each with the one property that its name says.
namespace selvedge::test {

inline Triangle_soup soup(std::vector<Point_3> points, std::vector<Index_triple> triangles)
{
  Triangle_soup soup;
  soup.points = std::move(points);
  soup.triangles = std::move(triangles);
  return soup;
}

/// Both soups side by side, sharing no vertex number.
inline Triangle_soup joined(Triangle_soup first, const Triangle_soup& second)
{
  const Index offset = static_cast<Index>(first.points.size());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (const auto& [a, b, c] : second.triangles)
    first.triangles.push_back({a + offset, b + offset, c + offset});
  return first;
}

/// The same with every point replaced.
template <class Function>
Triangle_soup mapped(Triangle_soup soup, Function function)
{
  for (Point_3& point : soup.points)
    point = function(point);
  return soup;
}

inline Triangle_soup moved(const Triangle_soup& soup, double x, double y, double z)
{
  return mapped(soup, [&](const Point_3& p) { return Point_3(p.x() + x, p.y() + y, p.z() + z); });
}

/// The same with every coordinate rounded to a multiple of 1 / `steps`, so that it has few bits.
inline Triangle_soup in_steps(const Triangle_soup& soup, double steps)
{
  const auto rounded = [&](double x) { return std::round(x * steps) / steps; };
  return mapped(soup,
                [&](const Point_3& p) { return Point_3(rounded(p.x()), rounded(p.y()), rounded(p.z())); });
}

/// No two triangles share a vertex number any more; the positions stay.
inline Triangle_soup unshared(const Triangle_soup& soup)
{
  Triangle_soup result;
  for (const Index_triple& triangle : soup.triangles) {
    const Index first = static_cast<Index>(result.points.size());
    for (const Index vertex : triangle)
      result.points.push_back(soup.points[vertex]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

/// PLY files have several vertices for such a one, or no normals.
inline bool has_vertices_of_several_normals(const Triangle_soup& soup)
{
  std::map<Index, std::array<double, 3>> known;
  for (std::size_t t = 0; t < soup.normals.of_triangle.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& normal = soup.normals.values[soup.normals.of_triangle[t][k]];
      const auto found = known.emplace(soup.triangles[t][k], normal).first;
      if (std::memcmp(&found->second, &normal, sizeof normal) != 0)
        return true;
    }
  return false;
}

/// A flat sheet of width × depth squares of side 1 at height z, two triangles each.
inline Triangle_soup sheet(Index width, Index depth, double z = 0)
{
  Triangle_soup result;
  for (Index y = 0; y <= depth; ++y)
    for (Index x = 0; x <= width; ++x)
      result.points.emplace_back(x, y, z);
  for (Index y = 0; y < depth; ++y)
    for (Index x = 0; x < width; ++x) {
      const Index a = y * (width + 1) + x, b = a + 1, c = b + width + 1, d = c - 1;
      result.triangles.push_back({a, b, c});
      result.triangles.push_back({a, c, d});
    }
  return result;
}

/// A strip whose lower border turns to the right by 23° at vertex 1, and to the left by 48° at vertex 2: by
/// 37° once vertex 1 is gone. Vertex 2 is 0.65 beside the segment from 1 to 3, and 0.55 beside that from 0 to
/// 3. Vertex 1 is 0.72 beside the latter. Vertices 4 to 7 are its upper border, opposite them.
inline Triangle_soup strip_with_low_corner()
{
  return soup(
      {{0, 0, 0}, {5, 1, 0}, {10, 0, 0}, {10.8, 0.6, 0}, {0, 5, 0}, {5, 5, 0}, {10, 5, 0}, {10.8, 5, 0}},
      {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 7, 6}});
}

/// The same with texture coordinates, of which every triangle at one vertex has its own there.
inline Triangle_soup with_own_uvs_at(Triangle_soup soup, Index vertex)
{
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.x(), p.y()});
  soup.uvs.of_triangle = soup.triangles;
  for (Index_triple& triangle : soup.uvs.of_triangle)
    for (Index& corner : triangle)
      if (corner == vertex) {
        corner = Index(soup.uvs.values.size());
        soup.uvs.values.push_back({soup.points[vertex].x() + 0.01 * corner, soup.points[vertex].y()});
      }
  return soup;
}

inline Triangle_soup tetrahedron()
{
  return soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

inline Triangle_soup one_triangle()
{
  return soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
}

/// Embedded: all that two triangles share is one vertex.
inline Triangle_soup bowtie()
{
  return soup({{0, 0, 0}, {2, 1, 0}, {2, -1, 0}, {-2, 1, 0}, {-2, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
}

/// Embedded: three sheets on one edge.
inline Triangle_soup book()
{
  return soup({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
}

inline Triangle_soup vertex_touching_face()
{
  return joined(one_triangle(), soup({{1, 1, 0}, {1, 1, 2}, {2, 1, 2}}, {{0, 1, 2}}));
}

inline Triangle_soup edge_touching_edge()
{
  return joined(one_triangle(), soup({{1, 0, -1}, {1, 0, 1}, {1, -3, 0}}, {{0, 1, 2}}));
}

inline Triangle_soup crossing()
{
  return joined(one_triangle(), soup({{1, 1, -1}, {1, 1, 1}, {9, 9, 0}}, {{0, 1, 2}}));
}

inline Triangle_soup coplanar_overlap()
{
  return joined(one_triangle(), soup({{1, 1, 0}, {5, 1, 0}, {1, 5, 0}}, {{0, 1, 2}}));
}

inline Triangle_soup coplanar_inside()
{
  return joined(one_triangle(), soup({{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}, {{0, 1, 2}}));
}

inline Triangle_soup duplicate()
{
  return soup(one_triangle().points, {{0, 1, 2}, {1, 2, 0}});
}

inline Triangle_soup opposite_duplicate()
{
  return soup(one_triangle().points, {{0, 1, 2}, {0, 2, 1}});
}

/// The middle of an edge is the corner of two triangles beyond it: both touch the first without sharing its
/// edge.
inline Triangle_soup t_junction()
{
  return soup({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {2, -2, 0}}, {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}});
}

/// Two triangles on one edge, folded flat onto each other.
inline Triangle_soup folded_over()
{
  return soup({{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {2, 2, 0}}, {{0, 1, 2}, {1, 0, 3}});
}

/// A crooked sheet with size × size squares. On some of its inner edges stands a triangle more, so that three
/// faces share the edge, and no halfedge mesh can hold it unless the faces at both its ends are torn apart.
inline Triangle_soup finned_sheet(Index size, unsigned seed)
{
  std::mt19937 random(seed);
  const auto up_to = [&](double length) { return length * double(random()) / 4294967296.0; };
  Triangle_soup result = mapped(sheet(size, size), [&](const Point_3& p) {
    const double x = p.x() + up_to(0.6), y = p.y() + up_to(0.4);
    return Point_3(1.2 * x, y, up_to(0.05));
  });
  for (Index y = 1; y < size; ++y)
    for (Index x = 1; x + 1 < size; ++x) {
      if (random() % 4 != 0)
        continue;
      const Index a = y * (size + 1) + x, b = a + 1;
      const Point_3 &p = result.points[a], &q = result.points[b];
      result.triangles.push_back({a, b, Index(result.points.size())});
      result.points.emplace_back((p.x() + q.x()) / 2, (p.y() + q.y()) / 2, 1);
    }
  return result;
}

/// Three collinear corners, all different.
inline Triangle_soup collinear_triangle()
{
  return soup({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, {{0, 1, 2}});
}

/// Divides a triangle at the middle of a side, and fills the T-junction there with a needle: a triangle that
/// has the side, its middle, and no area where the middle is exact.
inline void add_needle(Triangle_soup& soup, std::size_t triangle, std::size_t side)
{
  const Index_triple corners = soup.triangles[triangle];
  const Index a = corners[side], b = corners[(side + 1) % 3], c = corners[(side + 2) % 3];
  const Index middle = Index(soup.points.size());
  soup.points.push_back(CGAL::midpoint(soup.points[a], soup.points[b]));
  soup.triangles[triangle] = {a, middle, c};
  soup.triangles.push_back({middle, b, c});
  soup.triangles.push_back({a, b, middle});
}

} // namespace selvedge::test

#endif // SELVEDGE_TEST_SUPPORT_SOUPS_H
