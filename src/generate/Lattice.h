// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GENERATE_LATTICE_H
#define SELVEDGE_GENERATE_LATTICE_H

#include "generate/Random.h"
#include "generate/Soup_builder.h"

#include <cstddef>
#include <vector>

namespace selvedge::internal {

/// A rectangle of cells of a lattice, cut out as one pattern piece of a generated mesh. Sides that have a hem
/// are closed when the cloth has thickness; the others are left open, to lie at a seam.
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

/// The irregular triangulation that all layers of a surface share.
///
/// Vertex (i,j) has parameters (u,v) near (i/columns, j/rows): each is off by at most an eighth of a cell,
/// and across the lines at which pieces are cut it is not off at all. A layer lies at `base +
/// offset·direction`.
///
/// **Why layers at increasing offsets are embedded.** Let the base be embedded. Let every triangle, at every
/// offset in use, show its front to the directions of its three corners: det(b−a, c−a, d) > 0 for each such
/// direction d. Between two layers the map (point of the triangulation, t) → (1−t)·lower + t·upper then has a
/// positive determinant everywhere, because that is a convex combination of the determinants at the corners.
/// The map is continuous across edges, because on an edge it depends on the two corners of the edge only. So
/// the slabs between layers are stacked without overlap, like the pages of a bent book, however near the
/// layers are and however their distances vary. Near a layer there is therefore no other layer. Elsewhere
/// there is none either, because the whole stack is thinner than the distance at which the base comes close
/// to itself. Rounding moves a vertex by 1e-16 or so; the smallest gap of a garment is 1e-9.
struct Lattice
{
  Lattice(std::size_t columns, std::size_t rows, bool closed);

  std::size_t vertex(std::size_t i, std::size_t j) const { return j * width + (closed ? i % columns : i); }
  std::size_t cell(std::size_t i, std::size_t j) const { return j * columns + i % columns; }

  /// Keeps the sides of a panel straight, because pieces are cut there. Called before `disturb`.
  void keep_straight(const Panel& panel);

  /// Sets the parameters of all vertices and the diagonals of all cells at random.
  void disturb(Random& random);

  std::size_t columns, rows;
  bool closed;
  std::size_t width;
  std::vector<double> u, v;
  std::vector<Vector> base, direction;
  /// For each cell, which diagonal divides it.
  std::vector<char> diagonals;

private:
  std::vector<char> m_straight_columns, m_straight_rows;
};

/// Returns the number of faces of a panel's cloth; with thickness it has two sides and its hems.
std::size_t count_faces(const Panel& panel, bool thick);

/// Adds one sheet of cloth as a piece. `offset` has one entry for each vertex of the lattice.
void add_sheet(Soup_builder& builder, const Lattice& lattice, const Panel& panel,
               const std::vector<double>& offset, const std::vector<char>& diagonals);

/// Adds cloth with an inner and an outer side, closed at its hems, as a piece.
void add_cloth(Soup_builder& builder, const Lattice& lattice, const Panel& panel,
               const std::vector<double>& inner, const std::vector<double>& outer,
               const std::vector<char>& diagonals);

/// Returns columns and rows that make about `cells` cells, with columns/rows near `aspect`.
std::pair<std::size_t, std::size_t> divide(std::size_t cells, double aspect);

/// A closed surface made of rings of vertices between two poles.
struct Closed_surface
{
  /// Returns the number of faces of a surface with `columns` vertices per ring and `bands` bands between the
  /// poles.
  static std::size_t count_faces(std::size_t columns, std::size_t bands) { return 2 * columns * (bands - 1); }

  /// Returns columns and bands that make about `faces` faces, with columns/bands near `aspect`.
  static std::pair<std::size_t, std::size_t> divide(std::size_t faces, double aspect);

  Closed_surface(std::size_t columns, std::size_t bands, Random& random);

  /// Returns the angle of vertex i of ring k, in turns; rings are numbered from 1 to bands − 1.
  double turns(std::size_t i, std::size_t k) const { return m_turns[ring_vertex(i, k) - 1]; }

  std::size_t south() const { return 0; }
  std::size_t north() const { return 1 + columns * (bands - 1); }
  std::size_t ring_vertex(std::size_t i, std::size_t k) const { return 1 + (k - 1) * columns + i % columns; }
  std::size_t size() const { return north() + 1; }

  /// Adds the surface as a piece, with vertex i at points[i].
  void add(Soup_builder& builder, std::string name, const std::vector<Vector>& points) const;

  std::size_t columns, bands;

private:
  std::vector<double> m_turns;
  std::vector<char> m_diagonals;
};

} // namespace selvedge::internal

#endif // SELVEDGE_GENERATE_LATTICE_H
