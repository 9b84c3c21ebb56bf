// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_SHAPE_H
#define SELVEDGE_SRC_VERIFY_SHAPE_H

#include "Border_lines.h"
#include "Diagonal.h"
#include "Lists.h"

#include <map>
#include <memory>

namespace selvedge::internal {

/// Returns the centroid of a triangle whose points are divided by 2^exponent.
inline Point_3 centre(const Triangle_soup& soup, Index triangle, int exponent)
{
  const auto& [a, b, c] = soup.triangles[triangle];
  return CGAL::centroid(scaled(soup.points[a], -exponent), scaled(soup.points[b], -exponent),
                        scaled(soup.points[c], -exponent));
}

/// A part of a mesh whose distance from parts of another mesh the judge measures: at least one triangle of a
/// soup, with all points divided by 2^exponent. Triangles are numbered by their places in the list given.
class Shape
{
public:
  template <class Triangles>
  Shape(const Triangle_soup& soup, const Triangles& triangles, int exponent)
      : m_soup(submesh(soup, {triangles.begin(), triangles.end()})), m_surface(m_soup, exponent),
        m_tree(m_surface), m_diagonal(internal::diagonal(m_surface.points))
  {
  }
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;

  const std::vector<Point_3>& points() const { return m_surface.points; }
  double diagonal() const { return m_diagonal; }
  Index nearest(const Point_3& point, Index guess = 0) const { return m_tree.nearest(point, guess).triangle; }

  /// Returns the root mean square distance from the points of this shape to the surface of `to`, in scaled
  /// coordinates.
  double root_mean_square_distance(const Shape& to) const;

  /// Returns the share of this shape's area whose normal is more than 104° from that of the triangle of
  /// `other` that is nearest to the centroid of its own triangle, and for which no triangle of `other` that
  /// is as near faces the same side, nor one nearer than `margin` to the nearest point that is turned by at
  /// most 76°.
  double turned_against(const Shape& other, double margin = 0) const;

  /// Returns whether the border of this shape runs as that of `other` does, where both have points in common
  /// (`Border_lines`).
  bool has_border_of(const Shape& other) const
  {
    return Border_lines(other.m_surface).are_followed_by(m_surface);
  }

private:
  static Triangle_soup submesh(const Triangle_soup& soup, const std::vector<Index>& triangles);

  Triangle_soup m_soup;
  Surface m_surface;
  Surface_tree m_tree;
  double m_diagonal;
};

/// Makes the shape of each piece when it is first asked for, and keeps it.
class Shapes
{
public:
  /// `soup` and `triangles_of_pieces` must outlive this object.
  Shapes(const Triangle_soup& soup, const Lists& triangles_of_pieces, int exponent)
      : m_soup(soup), m_triangles(triangles_of_pieces), m_exponent(exponent)
  {
  }

  const Shape& operator[](Index piece)
  {
    std::unique_ptr<Shape>& shape = m_shapes[piece];
    if (!shape)
      shape = std::make_unique<Shape>(m_soup, m_triangles[piece], m_exponent);
    return *shape;
  }

private:
  const Triangle_soup& m_soup;
  const Lists& m_triangles;
  int m_exponent;
  std::map<Index, std::unique_ptr<Shape>> m_shapes;
};

/// Finds the piece of a mesh that is nearest to a point. The mesh must have a piece.
class Nearest_pieces
{
public:
  Nearest_pieces(const Triangle_soup& soup, const std::vector<Index>& piece_of_triangle, int exponent);

  Index piece_near(const Point_3& point) const;

  /// Returns the pieces that are nearest to some point of a shape, those nearest to most points first, at
  /// most 16.
  std::vector<Index> pieces_near(const Shape& shape) const;

private:
  std::vector<Index> m_triangles;
  std::vector<Index> m_pieces; // the piece of each of these triangles
  Shape m_shape;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_SHAPE_H
