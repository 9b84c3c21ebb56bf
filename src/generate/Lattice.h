// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GENERATE_LATTICE_H
#define SELVEDGE_GENERATE_LATTICE_H

#include "generate/Random.h"
#include "generate/Soup_builder.h"

#include <cstddef>
#include <vector>

namespace selvedge::internal {

/// A rectangle of cells of a lattice, cut out as one pattern piece. Sides that have a hem are closed when the
/// cloth has thickness; the others are left open, to lie at a seam.
struct Panel
{
  enum Hem : unsigned { NONE = 0, LEFT = 1, RIGHT = 2, BOTTOM = 4, TOP = 8, ALL = 15 };

  std::string name;
  std::size_t first_column, last_column;
  std::size_t first_row, last_row;
  unsigned hems;

  std::size_t columns() const { return last_column - first_column; }
  std::size_t rows() const { return last_row - first_row; }
};

/// The irregular triangulation of a surface that all layers share.
///
/// Vertex (i,j) has parameters (u,v) near (i/columns, j/rows), off by at most an eighth of a cell, and not at
/// all across the lines at which pieces are cut. A layer lies at `base + offset·direction`.
///
/// **Why layers at increasing offsets are embedded.** Let the base be embedded and every triangle, at every
/// offset in use, be seen from its front by the directions of its three corners: det(b−a, c−a, d) > 0 for d
/// each of them. Between two layers the map (point of the triangulation, t) → (1−t)·lower + t·upper then has
/// a positive determinant everywhere, as that is a convex combination of those of the corners. It is
/// continuous across edges, since on an edge it depends on the edge's two corners only: the slabs between
/// layers are stacked without overlap, like the pages of a bent book, however near the pages are and however
/// their distances vary. So near a layer there is no other; and as the whole stack is thinner than the
/// distance at which the base comes close to itself, nowhere else. Rounding moves a vertex by 1e-16 or so,
/// the smallest gap of a garment is 1e-9.
struct Lattice
{
  Lattice(std::size_t columns, std::size_t rows, bool closed);

  std::size_t vertex(std::size_t i, std::size_t j) const { return j * width + (closed ? i % columns : i); }
  std::size_t cell(std::size_t i, std::size_t j) const { return j * columns + i % columns; }

  /// Lines at which pieces are cut are to stay straight.
  void keep_straight(const Panel& panel);

  void disturb(Random& random);

  std::size_t columns, rows;
  bool closed;
  std::size_t width;
  std::vector<double> u, v;
  std::vector<Vector> base, direction;
  /// Per cell: which diagonal.
  std::vector<char> diagonals;

private:
  std::vector<char> m_straight_columns, m_straight_rows;
};

/// Faces of a panel's cloth; with thickness it has two sides and its hems.
std::size_t count_faces(const Panel& panel, bool thick);

/// One sheet of cloth as a piece, its vertices at the offsets given (one per lattice vertex).
void add_sheet(Soup_builder& builder, const Lattice& lattice, const Panel& panel,
               const std::vector<double>& offset, const std::vector<char>& diagonals);

/// Cloth with an inner and an outer side, closed at its hems, as a piece.
void add_cloth(Soup_builder& builder, const Lattice& lattice, const Panel& panel,
               const std::vector<double>& inner, const std::vector<double>& outer,
               const std::vector<char>& diagonals);

/// Columns and rows of about `cells` cells with columns/rows near `aspect`.
std::pair<std::size_t, std::size_t> divide(std::size_t cells, double aspect);

/// A closed surface made of rings of vertices between two poles.
struct Closed_surface
{
  /// Faces of a surface of `columns` vertices per ring and `bands` bands between the poles.
  static std::size_t count_faces(std::size_t columns, std::size_t bands) { return 2 * columns * (bands - 1); }

  /// The division into columns and bands that comes nearest to `faces`.
  static std::pair<std::size_t, std::size_t> divide(std::size_t faces, double aspect);

  Closed_surface(std::size_t columns, std::size_t bands, Random& random);

  /// Angle of vertex i of ring k, in turns; rings are numbered from 1 to bands − 1.
  double turns(std::size_t i, std::size_t k) const { return m_turns[ring_vertex(i, k) - 1]; }

  std::size_t south() const { return 0; }
  std::size_t north() const { return 1 + columns * (bands - 1); }
  std::size_t ring_vertex(std::size_t i, std::size_t k) const { return 1 + (k - 1) * columns + i % columns; }
  std::size_t size() const { return north() + 1; }

  /// Adds it as a piece, vertex i at points[i].
  void add(Soup_builder& builder, std::string name, const std::vector<Vector>& points) const;

  std::size_t columns, bands;

private:
  std::vector<double> m_turns;
  std::vector<char> m_diagonals;
};

} // namespace selvedge::internal

#endif // SELVEDGE_GENERATE_LATTICE_H
