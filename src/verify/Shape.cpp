// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Shape.h"

#include "pieces.h"

#include <selvedge/Cancellation_scope.h>

// Measures how far pieces of a result lie from pieces of its original, for `match_pieces`.

namespace selvedge::internal {

Triangle_soup Shape::submesh(const Triangle_soup& soup, const std::vector<Index>& triangles)
{
  std::vector<Index> vertices;
  for (const Index t : triangles)
    vertices.insert(vertices.end(), soup.triangles[t].begin(), soup.triangles[t].end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Triangle_soup result;
  for (const Index vertex : vertices)
    result.points.push_back(soup.points[vertex]);
  for (const Index t : triangles) {
    Index_triple corners = soup.triangles[t];
    for (Index& vertex : corners)
      vertex = Index(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
    result.triangles.push_back(corners);
  }
  return result;
}

double Shape::root_mean_square_distance(const Shape& to) const
{
  double sum = 0;
  Index guess = 0;
  Cancellation_poll poll;
  for (const Point_3& point : points()) {
    poll();
    const Surface_tree::Nearest nearest = to.m_tree.nearest(point, guess);
    sum += CGAL::squared_distance(point, nearest.point);
    guess = nearest.triangle;
  }
  return std::sqrt(sum / double(points().size()));
}

namespace {

Vector_3 unit(const Vector_3& v)
{
  const double length = std::sqrt(v.squared_length());
  return length > 0 ? v / length : v;
}

} // namespace

double Shape::turned_against(const Shape& other, double margin) const
{
  // Of some 104°. Where little is left of a piece, as the cap of a tube, the nearest triangle of the original
  // may well be at a right angle, and neither side is that of the other.
  constexpr double cosine_of_turned = -0.25;
  double all = 0, turned = 0;
  Index guess = 0;
  std::vector<Vector_3> directions; // of the triangles of `other`; few pieces need them
  Cancellation_poll poll;
  for (Index t = 0; t < m_surface.triangles.size(); ++t) {
    poll();
    const Vector_3 normal = m_surface.normal(t);
    const double area = std::sqrt(normal.squared_length());
    const Triangle_3 triangle = m_surface.triangle(t);
    const Point_3 centre = CGAL::centroid(triangle[0], triangle[1], triangle[2]);
    const Surface_tree::Nearest nearest = other.m_tree.nearest(centre, guess);
    guess = nearest.triangle;
    all += area;
    const Vector_3 other_normal = other.m_surface.normal(guess);
    if (normal * other_normal >= cosine_of_turned * area * std::sqrt(other_normal.squared_length()))
      continue;
    // Both sides of a closed piece that is flat lie in one place, and either may be found.
    for (Index u = Index(directions.size()); u < other.m_surface.triangles.size(); ++u)
      directions.push_back(unit(other.m_surface.normal(u)));
    const double as_near = 1.000001 * std::sqrt(CGAL::squared_distance(centre, nearest.point)) + 1e-12;
    if (!other.m_tree.nearest_facing(centre, directions, normal, as_near) &&
        !other.m_tree.nearest_facing(nearest.point, directions, normal, margin, -cosine_of_turned * area))
      turned += area;
  }
  return all > 0 ? turned / all : 0;
}

namespace {

std::vector<Index> triangles_with_a_piece(const std::vector<Index>& piece_of_triangle)
{
  std::vector<Index> triangles;
  for (Index t = 0; t < piece_of_triangle.size(); ++t)
    if (piece_of_triangle[t] != no_piece)
      triangles.push_back(t);
  return triangles;
}

} // namespace

Nearest_pieces::Nearest_pieces(const Triangle_soup& soup, const std::vector<Index>& piece_of_triangle,
                               int exponent)
    : m_triangles(triangles_with_a_piece(piece_of_triangle)), m_shape(soup, m_triangles, exponent)
{
  for (const Index t : m_triangles)
    m_pieces.push_back(piece_of_triangle[t]);
}

Index Nearest_pieces::piece_near(const Point_3& point) const
{
  return m_pieces[m_shape.nearest(point)];
}

std::vector<Index> Nearest_pieces::pieces_near(const Shape& shape) const
{
  constexpr std::size_t most = 16;
  std::map<Index, std::size_t> votes;
  Index guess = 0;
  Cancellation_poll poll;
  for (const Point_3& point : shape.points()) {
    poll();
    guess = m_shape.nearest(point, guess);
    ++votes[m_pieces[guess]];
  }
  std::vector<std::pair<Index, std::size_t>> sorted(votes.begin(), votes.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  sorted.resize(std::min(sorted.size(), most));
  std::vector<Index> pieces;
  for (const auto& [piece, count] : sorted)
    pieces.push_back(piece);
  return pieces;
}

} // namespace selvedge::internal
