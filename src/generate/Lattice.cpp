// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "generate/Lattice.h"

#include <algorithm>

// Lays out the panels and closed surfaces of generated meshes: their vertices, triangles and texture
// coordinates.

namespace selvedge::internal {

namespace {

/// A rectangle within a piece's tile of the texture.
struct Texture_window
{
  double left, right, bottom, top;
};

/// The vertices of one side of a panel, numbered row by row.
struct Side
{
  Index first;
  std::size_t width;

  Index operator()(std::size_t i, std::size_t j) const { return first + static_cast<Index>(j * width + i); }
};

/// Adds the vertices and triangles of one side of a panel. The back is turned over in space and in the
/// texture.
Side add_side(Soup_builder& builder, const Lattice& lattice, const Panel& panel,
              const std::vector<double>& offset, const std::vector<char>& diagonals, bool back,
              const Texture_window& window)
{
  const auto parameter = [&](std::size_t i, std::size_t j) {
    return lattice.u[lattice.vertex(i, j)] + (lattice.closed && i >= lattice.columns ? 1 : 0);
  };
  const double u_first = parameter(panel.first_column, panel.first_row);
  const double u_last = parameter(panel.last_column, panel.first_row);
  const double v_first = lattice.v[lattice.vertex(panel.first_column, panel.first_row)];
  const double v_last = lattice.v[lattice.vertex(panel.first_column, panel.last_row)];

  Side side{0, panel.columns() + 1};
  Side texture = side;
  for (std::size_t j = panel.first_row; j <= panel.last_row; ++j)
    for (std::size_t i = panel.first_column; i <= panel.last_column; ++i) {
      const std::size_t vertex = lattice.vertex(i, j);
      const Index point =
          builder.add_point(lattice.base[vertex] + offset[vertex] * lattice.direction[vertex]);
      const double u = (parameter(i, j) - u_first) / (u_last - u_first);
      const double v = (lattice.v[vertex] - v_first) / (v_last - v_first);
      const Index uv = builder.add_uv(window.left + (window.right - window.left) * (back ? 1 - u : u),
                                      window.bottom + (window.top - window.bottom) * v);
      if (i == panel.first_column && j == panel.first_row) {
        side.first = point;
        texture.first = uv;
      }
    }
  const auto add = [&](std::array<std::size_t, 2> a, std::array<std::size_t, 2> b,
                       std::array<std::size_t, 2> c) {
    if (back)
      std::swap(b, c);
    builder.add_triangle({side(a[0], a[1]), side(b[0], b[1]), side(c[0], c[1])},
                         {texture(a[0], a[1]), texture(b[0], b[1]), texture(c[0], c[1])});
  };
  for (std::size_t j = 0; j < panel.rows(); ++j)
    for (std::size_t i = 0; i < panel.columns(); ++i)
      if (diagonals[lattice.cell(panel.first_column + i, panel.first_row + j)]) {
        add({i, j}, {i + 1, j}, {i, j + 1});
        add({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
      } else {
        add({i, j}, {i + 1, j}, {i + 1, j + 1});
        add({i, j}, {i + 1, j + 1}, {i, j + 1});
      }
  return side;
}

/// Adds the triangles between the two sides of a panel at one border. `outer` and `inner` run along it with
/// the cloth at their left.
void add_hem(Soup_builder& builder, const std::vector<Index>& outer, const std::vector<Index>& inner,
             const Texture_window& window)
{
  const std::size_t edges = outer.size() - 1;
  Index previous_outer = 0;
  Index previous_inner = 0;
  for (std::size_t k = 0; k <= edges; ++k) {
    // Seen from outside with its inner side up, the hem runs from right to left.
    const double u =
        window.right + (window.left - window.right) * (static_cast<double>(k) / static_cast<double>(edges));
    const Index uv_outer = builder.add_uv(u, window.bottom);
    const Index uv_inner = builder.add_uv(u, window.top);
    if (k > 0) {
      builder.add_triangle({outer[k], outer[k - 1], inner[k - 1]},
                           {uv_outer, previous_outer, previous_inner});
      builder.add_triangle({outer[k], inner[k - 1], inner[k]}, {uv_outer, previous_inner, uv_inner});
    }
    previous_outer = uv_outer;
    previous_inner = uv_inner;
  }
}

} // namespace

Lattice::Lattice(std::size_t columns_, std::size_t rows_, bool closed_)
    : columns(columns_), rows(rows_), closed(closed_), width(closed_ ? columns_ : columns_ + 1),
      m_straight_columns(columns_ + 1), m_straight_rows(rows_ + 1)
{
  m_straight_rows.front() = m_straight_rows.back() = 1;
  if (!closed)
    m_straight_columns.front() = m_straight_columns.back() = 1;
}

void Lattice::keep_straight(const Panel& panel)
{
  for (const std::size_t i : {panel.first_column, panel.last_column})
    m_straight_columns[closed ? i % columns : i] = 1;
  for (const std::size_t j : {panel.first_row, panel.last_row})
    m_straight_rows[j] = 1;
}

void Lattice::disturb(Random& random)
{
  u.resize(width * (rows + 1));
  v.resize(u.size());
  Cancellation_poll poll;
  for (std::size_t j = 0; j <= rows; ++j)
    for (std::size_t i = 0; i < width; ++i) {
      poll();
      const double right = random.symmetric() / 8;
      const double up = random.symmetric() / 8;
      u[vertex(i, j)] =
          (static_cast<double>(i) + (m_straight_columns[i] ? 0 : right)) / static_cast<double>(columns);
      v[vertex(i, j)] = (static_cast<double>(j) + (m_straight_rows[j] ? 0 : up)) / static_cast<double>(rows);
    }
  diagonals.resize(columns * rows);
  for (char& diagonal : diagonals)
    diagonal = random.coin();
}

std::size_t count_faces(const Panel& panel, bool thick)
{
  const std::size_t side = 2 * panel.columns() * panel.rows();
  if (!thick)
    return side;
  std::size_t hem = 0;
  for (const unsigned h : {Panel::BOTTOM, Panel::TOP})
    hem += (panel.hems & h) != 0 ? 2 * panel.columns() : 0;
  for (const unsigned h : {Panel::LEFT, Panel::RIGHT})
    hem += (panel.hems & h) != 0 ? 2 * panel.rows() : 0;
  return 2 * side + hem;
}

void add_sheet(Soup_builder& builder, const Lattice& lattice, const Panel& panel,
               const std::vector<double>& offset, const std::vector<char>& diagonals)
{
  builder.begin_piece(panel.name);
  add_side(builder, lattice, panel, offset, diagonals, false, {0, 1, 0, 1});
}

void add_cloth(Soup_builder& builder, const Lattice& lattice, const Panel& panel,
               const std::vector<double>& inner, const std::vector<double>& outer,
               const std::vector<char>& diagonals)
{
  builder.begin_piece(panel.name);
  const Side front = add_side(builder, lattice, panel, outer, diagonals, false, {0, 0.49, 0.1, 1});
  const Side back = add_side(builder, lattice, panel, inner, diagonals, true, {0.51, 1, 0.1, 1});

  const std::size_t columns = panel.columns();
  const std::size_t rows = panel.rows();
  const auto border = [&](const Side& side, Panel::Hem hem) {
    std::vector<Index> line;
    switch (hem) {
    case Panel::BOTTOM:
      for (std::size_t i = 0; i <= columns; ++i)
        line.push_back(side(i, 0));
      break;
    case Panel::RIGHT:
      for (std::size_t j = 0; j <= rows; ++j)
        line.push_back(side(columns, j));
      break;
    case Panel::TOP:
      for (std::size_t i = 0; i <= columns; ++i)
        line.push_back(side(columns - i, rows));
      break;
    default:
      for (std::size_t j = 0; j <= rows; ++j)
        line.push_back(side(0, rows - j));
    }
    return line;
  };
  double bottom = 0;
  for (const Panel::Hem hem : {Panel::BOTTOM, Panel::RIGHT, Panel::TOP, Panel::LEFT}) {
    if ((panel.hems & hem) != 0)
      add_hem(builder, border(front, hem), border(back, hem), {0, 1, bottom, bottom + 0.02});
    bottom += 0.025;
  }
}

std::pair<std::size_t, std::size_t> divide(std::size_t cells, double aspect)
{
  const auto middle = static_cast<std::size_t>(std::sqrt(static_cast<double>(cells) * aspect));
  std::pair<std::size_t, std::size_t> best{1, 1};
  double best_error = static_cast<double>(cells);
  for (std::size_t columns = std::max<std::size_t>(1, middle - middle / 3);
       columns <= middle + middle / 3 + 1; ++columns) {
    const std::size_t rows = std::max<std::size_t>(1, (cells + columns / 2) / columns);
    const double error = std::abs(static_cast<double>(columns * rows) - static_cast<double>(cells));
    if (error < best_error) {
      best = {columns, rows};
      best_error = error;
    }
  }
  return best;
}

std::pair<std::size_t, std::size_t> Closed_surface::divide(std::size_t faces, double aspect)
{
  const std::size_t columns = std::max<std::size_t>(5, internal::divide(faces / 2, aspect).first);
  return {columns, std::max<std::size_t>(3, (faces / 2 + columns / 2) / columns) + 1};
}

Closed_surface::Closed_surface(std::size_t columns_, std::size_t bands_, Random& random)
    : columns(columns_), bands(bands_), m_turns(columns_ * (bands_ - 1)), m_diagonals(columns_ * bands_)
{
  Cancellation_poll poll;
  for (std::size_t k = 0; k < m_turns.size(); ++k, poll())
    m_turns[k] = (static_cast<double>(k % columns) + random.symmetric() / 4) / static_cast<double>(columns);
  for (char& diagonal : m_diagonals)
    diagonal = random.coin();
}

void Closed_surface::add(Soup_builder& builder, std::string name, const std::vector<Vector>& points) const
{
  builder.begin_piece(std::move(name));
  Index first = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Index point = builder.add_point(points[i]);
    if (i == 0)
      first = point;
  }
  const double width = static_cast<double>(columns);
  // Row k of the texture: the vertices of ring k, the first of them once more at the end; a pole has one per
  // column.
  std::vector<Index> rows;
  for (std::size_t k = 0; k <= bands; ++k)
    for (std::size_t i = 0; i <= columns; ++i) {
      const bool pole = k == 0 || k == bands;
      const double u =
          pole ? static_cast<double>(i) + 0.5 : 0.5 + turns(i, k) * width + (i == columns ? width : 0);
      rows.push_back(builder.add_uv(u / (width + 1), static_cast<double>(k) / static_cast<double>(bands)));
    }
  const auto point = [&](std::size_t i, std::size_t k) {
    return first + static_cast<Index>(k == 0 ? south() : k == bands ? north() : ring_vertex(i, k));
  };
  const auto uv = [&](std::size_t i, std::size_t k) { return rows[k * (columns + 1) + i]; };
  const auto add = [&](std::array<std::size_t, 2> a, std::array<std::size_t, 2> b,
                       std::array<std::size_t, 2> c) {
    builder.add_triangle({point(a[0], a[1]), point(b[0], b[1]), point(c[0], c[1])},
                         {uv(a[0], a[1]), uv(b[0], b[1]), uv(c[0], c[1])});
  };
  for (std::size_t k = 0; k < bands; ++k)
    for (std::size_t i = 0; i < columns; ++i) {
      if (k == 0)
        add({i, 0}, {i + 1, 1}, {i, 1});
      else if (k == bands - 1)
        add({i, k}, {i + 1, k}, {i, k + 1});
      else if (m_diagonals[k * columns + i]) {
        add({i, k}, {i + 1, k}, {i, k + 1});
        add({i + 1, k}, {i + 1, k + 1}, {i, k + 1});
      } else {
        add({i, k}, {i + 1, k}, {i + 1, k + 1});
        add({i, k}, {i + 1, k + 1}, {i, k + 1});
      }
    }
}

} // namespace selvedge::internal
