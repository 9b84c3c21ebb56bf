// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Error.h>

#include "generate/scenes.h"

#include "generate/Lattice.h"

#include <algorithm>

// Makes scenes that are hard to reduce without intersections, as inputs for tests and benchmarks.

namespace selvedge {

namespace {

using internal::Closed_surface;
using internal::cosine_sine;
using internal::Lattice;
using internal::Panel;
using internal::Random;
using internal::Soup_builder;
using internal::Vector;

// Heights on a fixed binary grid can be moved by whole gaps without rounding. So sheets that are translates
// of one another keep their distance exactly, down to the spacing of doubles.
constexpr double HEIGHT_UNIT = 0x1p-52;

double on_grid(double height)
{
  return std::floor(height / HEIGHT_UNIT) * HEIGHT_UNIT;
}

/// Returns the gap, rounded up to an even number of units.
double gap_on_grid(double gap)
{
  return std::ceil(gap / (2 * HEIGHT_UNIT)) * (2 * HEIGHT_UNIT);
}

Panel whole(const Lattice& lattice, std::string name)
{
  return {std::move(name), 0, lattice.columns, 0, lattice.rows, Panel::NONE};
}

Lattice square(std::size_t faces, double aspect)
{
  const auto [columns, rows] = internal::divide(faces / 2, aspect);
  return Lattice(columns, rows, false);
}

/// Makes sheets that are translates of one graph over a rectangle one wide and `length` deep.
Triangle_soup stacked_sheets(const Generate_options& options, double length)
{
  const auto layers = static_cast<std::size_t>(options.layers);
  Random random(options.seed);
  Lattice lattice = square(options.faces / layers, 1);
  if (length < 1) // Needles lie along x only when their far ends have the same x.
    for (std::size_t i = 0; i <= lattice.columns; ++i)
      lattice.keep_straight({"", i, i, 0, lattice.rows, Panel::NONE});
  lattice.disturb(random);
  for (std::size_t k = 0; k < lattice.u.size(); ++k) {
    const double along = cosine_sine(options.folds * lattice.u[k])[1];
    const double across = cosine_sine(options.folds * 0.37 * length * lattice.v[k])[0];
    lattice.base.emplace_back(lattice.u[k], length * lattice.v[k],
                              on_grid(options.fold_depth * along * across));
    lattice.direction.emplace_back(0, 0, 1);
  }
  Soup_builder builder(layers, options.faces);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const double height = static_cast<double>(layer) * gap_on_grid(options.gap);
    internal::add_sheet(builder, lattice, whole(lattice, "sheet_" + std::to_string(layer)),
                        std::vector<double>(lattice.u.size(), height), lattice.diagonals);
  }
  return builder.take();
}

} // namespace

Triangle_soup internal::sheets(const Generate_options& options)
{
  return stacked_sheets(options, 1);
}

Triangle_soup internal::needles(const Generate_options& options)
{
  return stacked_sheets(options, 1e-6);
}

Triangle_soup internal::grid(const Generate_options& options)
{
  Lattice lattice = square(options.faces, 1);
  for (std::size_t j = 0; j <= lattice.rows; ++j)
    for (std::size_t i = 0; i <= lattice.columns; ++i) {
      lattice.u.push_back(static_cast<double>(i) / static_cast<double>(lattice.columns));
      lattice.v.push_back(static_cast<double>(j) / static_cast<double>(lattice.rows));
      // Steps are a power of two, so every cell is the same square to the last bit.
      lattice.base.emplace_back(static_cast<double>(i) * 0x1p-10, static_cast<double>(j) * 0x1p-10, 0);
      lattice.direction.emplace_back(0, 0, 1);
    }
  lattice.diagonals.assign(lattice.columns * lattice.rows, 0);
  Soup_builder builder(1, options.faces);
  add_sheet(builder, lattice, whole(lattice, "grid"), std::vector<double>(lattice.u.size()),
            lattice.diagonals);
  return builder.take();
}

// The cloth is a line in the plane of x and z, folded back and forth, and drawn along y. The vertices of a
// column all have its x and z, so the vertices of two neighbouring columns lie in one plane exactly, and the
// cloth is embedded as soon as the line is.
Triangle_soup internal::folded(const Generate_options& options)
{
  const auto runs = static_cast<std::size_t>(options.layers);
  Random random(options.seed);

  // Columns come in whole runs and two per fold; rows then make up the number of faces.
  const auto cells = static_cast<double>(options.faces) / 2;
  const auto columns_for = [&](std::size_t per_run) { return runs * per_run + 2 * (runs - 1); };
  const auto error = [&](std::size_t columns) {
    const double rows = std::floor(cells / static_cast<double>(columns) + 0.5);
    return std::abs(rows * static_cast<double>(columns) - cells);
  };
  std::size_t per_run = 2;
  const double wanted = std::sqrt(cells * static_cast<double>(runs));
  for (std::size_t n = 3; static_cast<double>(columns_for(n)) < 1.5 * wanted; ++n)
    if (static_cast<double>(columns_for(n)) < 0.75 * wanted ||
        error(columns_for(n)) < error(columns_for(per_run)))
      per_run = n;
  const std::size_t columns = columns_for(per_run);
  const auto rows = static_cast<std::size_t>(std::floor(cells / static_cast<double>(columns) + 0.5));
  if (rows == 0)
    throw Argument_error(std::to_string(runs) + " folds need more than " + std::to_string(options.faces) +
                         " faces; ask for more faces or fewer folds");
  Lattice lattice(columns, rows, false);
  lattice.disturb(random);

  const double gap = gap_on_grid(options.gap);
  const double step = 1 / static_cast<double>(per_run);
  std::vector<std::array<double, 2>> line;
  for (std::size_t run = 0; run < runs; ++run) {
    const double height = static_cast<double>(run) * gap;
    const bool back = run % 2 == 1;
    for (std::size_t k = 0; k <= per_run; ++k) {
      const double x = static_cast<double>(back ? per_run - k : k) * step;
      line.push_back({x, on_grid(options.fold_depth * cosine_sine(options.folds * x / 4)[1]) + height});
    }
    if (run + 1 < runs)
      line.push_back({back ? -step / 2 : 1 + step / 2, line.back()[1] + gap / 2});
  }
  for (std::size_t j = 0; j <= lattice.rows; ++j)
    for (std::size_t i = 0; i <= columns; ++i) {
      lattice.base.emplace_back(line[i][0], lattice.v[lattice.vertex(i, j)], line[i][1]);
      lattice.direction.emplace_back(0, 0, 1);
    }
  Soup_builder builder(1, options.faces);
  add_sheet(builder, lattice, whole(lattice, "cloth"), std::vector<double>(lattice.u.size()),
            lattice.diagonals);
  return builder.take();
}

// Concentric spheres: scaled copies of one closed surface.
Triangle_soup internal::nested(const Generate_options& options)
{
  const auto layers = static_cast<std::size_t>(options.layers);
  Random random(options.seed);
  const auto [columns, bands] = Closed_surface::divide(options.faces / layers, 2);
  const Closed_surface surface(columns, bands, random);

  std::vector<Vector> unit(surface.size());
  unit[surface.south()] = Vector(0, 0, -1);
  unit[surface.north()] = Vector(0, 0, 1);
  for (std::size_t k = 1; k < bands; ++k)
    for (std::size_t i = 0; i < columns; ++i) {
      const auto [height, radius] = cosine_sine(0.5 * static_cast<double>(k) / static_cast<double>(bands));
      const auto [x, y] = cosine_sine(surface.turns(i, k));
      unit[surface.ring_vertex(i, k)] = Vector(radius * x, radius * y, -height);
    }
  Soup_builder builder(layers, options.faces);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    std::vector<Vector> points;
    for (const Vector& d : unit)
      points.push_back((0.5 + static_cast<double>(layer) * options.gap) * d);
    surface.add(builder, "sphere_" + std::to_string(layer), points);
  }
  return builder.take();
}

// Five flat pieces. `left` meets `lower` and `upper` in the line where these begin, one above the other: a
// T-junction. `upright` stands on the lower half of that line: three sheets on one edge. `turned` continues
// `lower`, with its front where `lower` has its back.
Triangle_soup internal::seams(const Generate_options& options)
{
  Random random(options.seed);
  const auto half =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(static_cast<double>(options.faces) / 24)));
  const std::size_t total = std::max<std::size_t>(8, (options.faces + half) / (2 * half));
  const std::size_t columns = total / 6;
  const std::size_t upright = total - 5 * columns;

  struct Patch
  {
    const char* name;
    std::size_t columns, rows;
    std::size_t first_row;
    double x;
    Vector right;
  };
  const Patch pieces[] = {
      {"left", columns, 2 * half, 0, 0, Vector(1, 0, 0)}, {"lower", columns, half, 0, 1, Vector(1, 0, 0)},
      {"upper", columns, half, half, 1, Vector(1, 0, 0)}, {"upright", upright, half, 0, 1, Vector(0, 0, 1)},
      {"turned", columns, half, 0, 3, Vector(-1, 0, 0)},
  };
  Soup_builder builder(std::size(pieces), options.faces);
  for (const Patch& piece : pieces) {
    Lattice lattice(piece.columns, piece.rows, false);
    lattice.disturb(random);
    for (std::size_t j = 0; j <= piece.rows; ++j)
      for (std::size_t i = 0; i <= piece.columns; ++i) {
        const std::size_t k = lattice.vertex(i, j);
        // Border vertices are at multiples of the same unit in every piece, so sewn vertices agree to the
        // last bit.
        if (i == 0 || j == 0 || i == piece.columns || j == piece.rows) {
          lattice.u[k] = static_cast<double>(i) / static_cast<double>(piece.columns);
          lattice.v[k] = static_cast<double>(j) / static_cast<double>(piece.rows);
          lattice.base.emplace_back(piece.x + piece.right.x() * lattice.u[k],
                                    static_cast<double>(piece.first_row + j) / static_cast<double>(2 * half),
                                    piece.right.z() * lattice.u[k]);
        } else {
          const double row =
              static_cast<double>(piece.first_row) + lattice.v[k] * static_cast<double>(piece.rows);
          lattice.base.emplace_back(piece.x + piece.right.x() * lattice.u[k],
                                    row / static_cast<double>(2 * half), piece.right.z() * lattice.u[k]);
        }
        lattice.direction.emplace_back(0, 0, 1);
      }
    add_sheet(builder, lattice, whole(lattice, piece.name), std::vector<double>(lattice.u.size()),
              lattice.diagonals);
  }
  return builder.take();
}

namespace {

/// Adds a hexagon with its middle raised, and a triangle between it and the ground.
void add_bump(Soup_builder& builder, std::size_t number, double x, double y)
{
  const auto add = [&](double u, double v, double height) {
    return std::pair{builder.add_point(Vector(x + u, y + v, height)),
                     builder.add_uv((u + 2) / 4, (v + 2) / 4)};
  };
  builder.begin_piece("bump_" + std::to_string(number));
  const auto apex = add(0, 0, 0.5);
  const std::pair<Index, Index> ring[] = {add(2, 0, 0),  add(1, 2, 0),   add(-1, 2, 0),
                                          add(-2, 0, 0), add(-1, -2, 0), add(1, -2, 0)};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto& a = ring[k];
    const auto& b = ring[(k + 1) % 6];
    builder.add_triangle({apex.first, a.first, b.first}, {apex.second, a.second, b.second});
  }
  builder.begin_piece("patch_" + std::to_string(number));
  const auto a = add(-0.5, -0.25, 0.125);
  const auto b = add(0.5, -0.25, 0.125);
  const auto c = add(0, 0.5, 0.125);
  builder.add_triangle({a.first, b.first, c.first}, {a.second, b.second, c.second});
}

} // namespace

Triangle_soup internal::tunnels(const Generate_options& options)
{
  const std::size_t bumps = std::max<std::size_t>(1, (options.faces + 3) / 7);
  const auto width = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(bumps))));
  Soup_builder builder(2 * bumps, options.faces);
  for (std::size_t k = 0; k < bumps; ++k)
    add_bump(builder, k, 5 * static_cast<double>(k % width), 5 * static_cast<double>(k / width));
  return builder.take();
}

} // namespace selvedge
