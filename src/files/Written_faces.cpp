// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Written_faces.h"

#include "files/triangulate_polygon.h"
#include "soup/selection.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <tuple>

namespace selvedge::files {
namespace {

std::size_t most_corners(const Triangle_soup& soup, Mesh_format format)
{
  switch (format) {
  case Mesh_format::obj:
  case Mesh_format::off:
    return std::numeric_limits<std::size_t>::max();
  case Mesh_format::ply: // its lists have at most 255 entries, and two of them are a texture coordinate
    return soup.uvs.empty() ? 255 : 127;
  default:
    return 3;
  }
}

template <std::size_t dimension>
bool have_same_value(const Corner_values<dimension>& values, Index a, Index b)
{
  if (values.empty())
    return true;
  const Index of_a = values.of_triangle[a / 3][a % 3], of_b = values.of_triangle[b / 3][b % 3];
  return of_a == of_b || (of_a != values.missing && of_b != values.missing &&
                          std::memcmp(&values.values[of_a], &values.values[of_b],
                                      sizeof(std::array<double, dimension>)) == 0);
}

bool have_same_name(const Triangle_labels& labels, Index a, Index b)
{
  return labels.empty() || labels.of_triangle[a] == labels.of_triangle[b];
}

} // namespace

Written_faces::Written_faces(const Triangle_soup& soup, Mesh_format format) : m_soup(soup)
{
  const std::size_t most = most_corners(soup, format);
  std::size_t end = 0; // of the triangles of the polygons so far
  Cancellation_poll poll;
  for (const Cut_polygon& polygon : soup.polygons) {
    poll();
    const std::size_t triangles = polygon.corners - std::size_t(2), first = polygon.first_triangle;
    if (polygon.corners <= 3 || polygon.corners > most || first < end || first > soup.triangles.size() ||
        triangles > soup.triangles.size() - first || polygon.start >= 3 * triangles)
      continue;
    if (!find_loop(polygon) || !is_uniform(polygon) || !is_cut_the_same(polygon))
      continue;
    m_first_triangles.push_back(polygon.first_triangle);
    m_corners.insert(m_corners.end(), m_loop.begin(), m_loop.end());
    m_ends.push_back(m_corners.size());
    m_triangles_saved += triangles - 1;
    end = first + triangles;
  }
}

const Written_faces::Edge* Written_faces::border_edge_from(Index from) const
{
  const auto edge = std::lower_bound(m_border.begin(), m_border.end(), from,
                                     [](const Edge& e, Index v) { return e.from < v; });
  return edge != m_border.end() && edge->from == from ? &*edge : nullptr;
}

// Finds the corners of the polygon that the triangles form, from its first one on.
bool Written_faces::find_loop(const Cut_polygon& polygon)
{
  const auto comes_before = [](const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  };
  const Index first = 3 * polygon.first_triangle, end = first + 3 * (polygon.corners - 2);
  m_edges.clear();
  for (Index corner = first; corner < end; ++corner)
    m_edges.push_back({vertex(corner), vertex(corner % 3 == 2 ? corner - 2 : corner + 1), corner});
  std::sort(m_edges.begin(), m_edges.end(), comes_before);
  m_border.clear();
  for (const Edge& edge : m_edges)
    if (!std::binary_search(m_edges.begin(), m_edges.end(), Edge{edge.to, edge.from, 0}, comes_before)) {
      if (!m_border.empty() && m_border.back().from == edge.from)
        return false; // it names a vertex twice
      m_border.push_back(edge);
    }
  m_loop.clear();
  const Index start = vertex(first + polygon.start);
  for (Index at = start; m_loop.empty() || at != start;) {
    const Edge* const edge = border_edge_from(at);
    if (!edge || m_loop.size() == polygon.corners)
      return false;
    m_loop.push_back(edge->corner);
    at = edge->to;
  }
  return m_loop.size() == polygon.corners && m_border.size() == polygon.corners;
}

bool Written_faces::is_uniform(const Cut_polygon& polygon) const
{
  const Index first = polygon.first_triangle, end = first + polygon.corners - 2;
  for (Index t = first; t < end; ++t) {
    for (const Triangle_labels* labels :
         {&m_soup.groups, &m_soup.objects, &m_soup.materials, &m_soup.smoothing_groups})
      if (!have_same_name(*labels, first, t))
        return false;
    for (const Attribute& attribute : m_soup.triangle_attributes) {
      const std::size_t size = row_size(attribute);
      if (std::memcmp(&attribute.rows[first * size], &attribute.rows[t * size], size) != 0)
        return false;
    }
  }
  for (Index corner = 3 * first; corner < 3 * end; ++corner) {
    const Edge* const edge = border_edge_from(vertex(corner));
    if (!edge || !have_same_value(m_soup.uvs, edge->corner, corner) ||
        !have_same_value(m_soup.normals, edge->corner, corner))
      return false;
  }
  return true;
}

bool Written_faces::is_cut_the_same(const Cut_polygon& polygon)
{
  std::vector<Index> vertices;
  for (const Index corner : m_loop)
    vertices.push_back(vertex(corner));
  if (m_start_of(m_soup.points, vertices) != 0)
    return false;
  const std::vector<Index_triple> cut = triangulate_polygon(m_soup.points, vertices);
  return std::equal(cut.begin(), cut.end(), m_soup.triangles.begin() + polygon.first_triangle,
                    [&](const Index_triple& places, const Index_triple& triangle) {
                      return vertices[places[0]] == triangle[0] && vertices[places[1]] == triangle[1] &&
                             vertices[places[2]] == triangle[2];
                    });
}

} // namespace selvedge::files
