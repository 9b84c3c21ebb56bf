// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "generate/Garment.h"

#include <selvedge/Error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace selvedge::internal {

double radius_at(const Profile& profile, double height)
{
  if (height <= profile.front()[0])
    return profile.front()[1];
  for (std::size_t k = 1; k < profile.size(); ++k)
    if (height < profile[k][0]) {
      const auto& [h0, r0] = profile[k - 1];
      const auto& [h1, r1] = profile[k];
      const double t = (height - h0) / (h1 - h0);
      return r0 + (r1 - r0) * t * t * (3 - 2 * t);
    }
  return profile.back()[1];
}

std::size_t cells_along(double length, double cell, double least)
{
  return static_cast<std::size_t>(std::max(least, std::floor(length / cell + 0.5)));
}

void Tube::shape(const Frame& frame, Lattice& lattice) const
{
  Cancellation_poll poll;
  for (std::size_t k = 0; k < lattice.u.size(); ++k) {
    poll();
    const double turns = first_turn + (last_turn - first_turn) * lattice.u[k];
    const double height = bottom + (top - bottom) * lattice.v[k];
    const Vector d = frame.radial(turns);
    lattice.base.push_back(frame.origin + height * frame.axis + radius(turns, height) * d);
    lattice.direction.push_back(d / std::sqrt(d.squared_length()));
  }
}

Part tube(const Tube& shape, const Frame& frame, double width, double height)
{
  Part part;
  part.closed = shape.last_turn - shape.first_turn == 1;
  part.width = width;
  part.height = height;
  part.divide = [=](double cell) {
    return Division{cells_along(width, cell, 8), cells_along(height, cell, 4)};
  };
  part.shape = [=](Lattice& lattice) { shape.shape(frame, lattice); };
  part.frame = [=](const Lattice&) { return frame; };
  return part;
}

Panel place(const Pattern& pattern, const std::string& name, const Division& division)
{
  // In coarse lattices, a line inside the part stays inside, so that the pieces on both sides keep a cell at
  // least.
  const auto line = [](double parameter, std::size_t cells) {
    const auto nearest = static_cast<std::size_t>(std::floor(parameter * static_cast<double>(cells) + 0.5));
    if (parameter <= 0 || parameter >= 1)
      return nearest;
    return std::min(std::max<std::size_t>(nearest, 1), cells - 1);
  };
  Panel panel{name,
              line(pattern.u_first, division.columns),
              line(pattern.u_last, division.columns),
              line(pattern.v_first, division.rows),
              line(pattern.v_last, division.rows),
              pattern.hems};
  // A patch is at least one cell.
  if (panel.columns() == 0)
    panel.first_column < division.columns ? ++panel.last_column : --panel.first_column;
  if (panel.rows() == 0)
    panel.first_row < division.rows ? ++panel.last_row : --panel.first_row;
  return panel;
}

namespace {

std::size_t button_corners(const Generate_options& options)
{
  return options.faces < 20'000 ? 6 : 24;
}

std::size_t count_faces(const Part& part, double cell, const Generate_options& options)
{
  const Division division = part.divide(cell);
  const bool thick = options.thickness > 0;
  std::size_t count = 4 * button_corners(options) * part.buttons.size();
  for (const Pattern& pattern : part.patterns)
    count += static_cast<std::size_t>(options.layers) * count_faces(place(pattern, "", division), thick);
  for (const std::vector<Pattern>& level : part.patches)
    for (const Pattern& pattern : level)
      count += count_faces(place(pattern, "", division), thick);
  return count;
}

std::string layer_name(std::size_t layer, std::size_t layers)
{
  if (layer + 1 == layers)
    return "shell";
  return layer == 0 ? "lining" : "interlining_" + std::to_string(layer);
}

/// Adds a button, a flat disc over the outermost layer. It lies beyond a plane that no triangle near it
/// reaches.
void add_button(Soup_builder& builder, std::string name, const Vector& middle, const Vector& axis,
                const Vector& up, double radius, double distance, double thickness, std::size_t corners)
{
  builder.begin_piece(std::move(name));
  const Vector right = CGAL::cross_product(up, axis);
  const auto add = [&](double turns, double r, double height, double u, double v) {
    const auto [c, s] = cosine_sine(turns);
    return std::pair{builder.add_point(middle + r * (c * right + s * up) + (distance + height) * axis),
                     builder.add_uv(u + r / radius * 0.2 * c, v + r / radius * 0.2 * s)};
  };
  const auto bottom = add(0, 0, 0, 0.25, 0.25);
  const auto top = add(0, 0, thickness, 0.75, 0.25);
  std::vector<Index> lower, upper, lower_uv, upper_uv;
  const double width = static_cast<double>(corners);
  for (std::size_t k = 0; k < corners; ++k) {
    const double turns = static_cast<double>(k) / width;
    const auto a = add(turns, radius, 0, 0.25, 0.25);
    const auto b = add(turns, radius, thickness, 0.75, 0.25);
    lower.push_back(a.first);
    lower_uv.push_back(a.second);
    upper.push_back(b.first);
    upper_uv.push_back(b.second);
  }
  for (std::size_t k = 0; k < corners; ++k) {
    const std::size_t next = (k + 1) % corners;
    const double u = static_cast<double>(k) / width;
    const double u_next = static_cast<double>(k + 1) / width;
    builder.add_triangle({top.first, upper[k], upper[next]}, {top.second, upper_uv[k], upper_uv[next]});
    // The underside, seen from below, is a mirror image.
    const Index m = builder.add_uv(0.25, 0.25);
    const auto mirrored = [&](double turns) {
      const auto [c, s] = cosine_sine(turns);
      return builder.add_uv(0.25 - 0.2 * c, 0.25 + 0.2 * s);
    };
    const Index mk = mirrored(u);
    builder.add_triangle({bottom.first, lower[next], lower[k]}, {m, mirrored(u_next), mk});
    const Index a = builder.add_uv(u, 0.6);
    const Index b = builder.add_uv(u_next, 0.6);
    const Index c = builder.add_uv(u_next, 0.7);
    const Index d = builder.add_uv(u, 0.7);
    builder.add_triangle({lower[k], lower[next], upper[next]}, {a, b, c});
    builder.add_triangle({lower[k], upper[next], upper[k]}, {a, c, d});
  }
}

class Garment
{
public:
  Garment(const Generate_options& options, std::vector<Part> parts)
      : m_options(options), m_layers(static_cast<std::size_t>(options.layers)), m_parts(std::move(parts)),
        m_random(options.seed), m_phase(m_random.unit())
  {
  }

  Triangle_soup make()
  {
    // Bodies take the faces that the cloth leaves, about a twelfth, so that the total is the number wanted.
    const std::size_t least = 50 * m_parts.size();
    const double room = std::min(0.92 * static_cast<double>(m_options.faces),
                                 static_cast<double>(m_options.faces) - static_cast<double>(least));
    double coarse = 0.2;
    double fine = 1e-5;
    if (static_cast<double>(count(coarse)) > room)
      throw Argument_error("this garment in " + std::to_string(m_layers) + " layers needs at least " +
                           std::to_string(std::max(count(coarse) * 100 / 92 + 1, count(coarse) + least)) +
                           " faces; ask for more faces or fewer layers");
    for (int k = 0; k < 60; ++k) {
      const double middle = (coarse + fine) / 2;
      (static_cast<double>(count(middle)) <= room ? coarse : fine) = middle;
    }
    const std::size_t rest = m_options.faces - count(coarse);

    std::size_t pieces = 0;
    double bodies = 0;
    for (const Part& part : m_parts) {
      pieces += m_layers * part.patterns.size() + part.buttons.size() + 1;
      for (const std::vector<Pattern>& level : part.patches)
        pieces += level.size();
      bodies += part.width * part.height;
    }
    Soup_builder builder(pieces, m_options.faces);
    std::vector<Lattice> lattices;
    for (const Part& part : m_parts)
      lattices.push_back(add_cloths(builder, part, coarse));
    // The largest body comes last and makes up for the differences that the others have left.
    std::size_t left = rest;
    for (std::size_t k = m_parts.size(); k-- > 0;) {
      const Part& part = m_parts[k];
      const double share =
          k == 0 ? 1
                 : static_cast<double>(rest) / static_cast<double>(left) * part.width * part.height / bodies;
      left -= std::min(left, add_body(builder, part, lattices[k],
                                      static_cast<std::size_t>(share * static_cast<double>(left))));
    }
    return builder.take();
  }

private:
  std::size_t count(double cell) const
  {
    std::size_t faces = 0;
    for (const Part& part : m_parts)
      faces += count_faces(part, cell, m_options);
    return faces;
  }

  Lattice add_cloths(Soup_builder& builder, const Part& part, double cell)
  {
    const Division division = part.divide(cell);
    Lattice lattice(division.columns, division.rows, part.closed);
    for (const Pattern& pattern : part.patterns)
      lattice.keep_straight(place(pattern, "", division));
    for (const std::vector<Pattern>& level : part.patches)
      for (const Pattern& pattern : level)
        lattice.keep_straight(place(pattern, "", division));
    lattice.disturb(m_random);

    part.shape(lattice);
    const double thickness = m_options.thickness;
    std::vector<double> offset(lattice.u.size(), 0.0);
    std::vector<double> outer = offset;
    const std::vector<char> may_differ = loose_cells(lattice);
    const auto add = [&](const Panel& panel, const std::vector<char>& diagonals) {
      if (thickness > 0)
        add_cloth(builder, lattice, panel, offset, outer, diagonals);
      else
        add_sheet(builder, lattice, panel, offset, diagonals);
    };
    // The distance of two layers depends on the place only, so that sewn parts agree where they meet.
    const auto rise = [&](double wave) {
      for (std::size_t k = 0; k < offset.size(); ++k) {
        const Vector& p = lattice.base[k];
        const double swell =
            cosine_sine(wave * p.x() + m_phase)[0] * cosine_sine(wave * p.y() + 1.3 * p.z() - m_phase)[0];
        offset[k] = outer[k] + m_options.gap * (1.5 + 0.5 * swell);
      }
    };
    const auto thicken = [&] {
      for (std::size_t k = 0; k < offset.size(); ++k)
        outer[k] = offset[k] + thickness;
    };
    const auto vary = [&] {
      std::vector<char> diagonals = lattice.diagonals;
      for (std::size_t k = 0; k < diagonals.size(); ++k)
        if (const bool other = m_random.coin(); other && may_differ[k])
          diagonals[k] = !diagonals[k];
      return diagonals;
    };
    for (std::size_t layer = 0; layer < m_layers; ++layer) {
      if (layer > 0)
        rise(static_cast<double>(2 + layer % 3));
      thicken();
      const std::vector<char> diagonals = vary();
      for (const Pattern& pattern : part.patterns)
        add(place(pattern, layer_name(layer, m_layers) + "_" + part.name + pattern.name, division),
            diagonals);
    }
    for (const std::vector<Pattern>& level : part.patches) {
      rise(1);
      thicken();
      for (const Pattern& pattern : level)
        add(place(pattern, part.name + pattern.name, division), vary());
    }
    for (std::size_t k = 0; k < part.buttons.size(); ++k)
      place_button(builder, part, lattice, outer, k);
    return lattice;
  }

  /// Marks the cells in which a layer may have the other diagonal. The two ways to divide a cell are at most
  /// as far apart as the midpoints of its diagonals; where that is less than a quarter of the gap, measured
  /// across the cloth, layers stay apart.
  std::vector<char> loose_cells(const Lattice& lattice) const
  {
    std::vector<char> loose(lattice.columns * lattice.rows);
    const auto across = [](const Vector& e, const Vector& f, const Vector& d) {
      const Vector n = CGAL::cross_product(e, f);
      return (n * d) / std::sqrt(n.squared_length());
    };
    Cancellation_poll poll;
    for (std::size_t j = 0; j < lattice.rows; ++j)
      for (std::size_t i = 0; i < lattice.columns; ++i) {
        poll();
        const std::size_t corners[] = {lattice.vertex(i, j), lattice.vertex(i + 1, j),
                                       lattice.vertex(i + 1, j + 1), lattice.vertex(i, j + 1)};
        double least = std::numeric_limits<double>::max();
        for (std::size_t k = 0; k < 4; ++k) {
          const Vector& p = lattice.base[corners[k]];
          for (const std::size_t d : corners)
            least = std::min(least, across(lattice.base[corners[(k + 1) % 4]] - p,
                                           lattice.base[corners[(k + 3) % 4]] - p, lattice.direction[d]));
        }
        const Vector apart = (lattice.base[corners[0]] + lattice.base[corners[2]] - lattice.base[corners[1]] -
                              lattice.base[corners[3]]) /
                             2;
        loose[lattice.cell(i, j)] = 4 * std::sqrt(apart.squared_length()) < m_options.gap * least;
      }
    return loose;
  }

  /// Adds the body of a part and returns its number of faces.
  ///
  /// The radius of a ring is at most nine tenths of the smallest distance of the cloth from the axis anywhere
  /// between the neighbours of the ring, less what straight edges cut off from the circle. So the cone
  /// between two rings stays inside the cloth as well.
  std::size_t add_body(Soup_builder& builder, const Part& part, const Lattice& lattice, std::size_t faces)
  {
    const double low = part.body.front()[0];
    const double high = part.body.back()[0];
    const auto [columns, bands] = Closed_surface::divide(faces, part.width * 0.7 / (high - low));
    const Closed_surface surface(columns, bands, m_random);
    const double band = (high - low) / static_cast<double>(bands);
    const double chord = cosine_sine(0.625 / static_cast<double>(lattice.columns))[0];

    const Frame frame = part.frame(lattice);
    const auto coordinate = [](const Vector& p, const Vector& axis) {
      return p * axis / axis.squared_length();
    };
    struct Row
    {
      double low = std::numeric_limits<double>::max();
      double high = std::numeric_limits<double>::lowest();
      double room = std::numeric_limits<double>::max();
    };
    std::vector<Row> rows(lattice.rows);
    for (std::size_t k = 0; k < lattice.base.size(); ++k) {
      const Vector p = lattice.base[k] - frame.origin;
      const double x = coordinate(p, frame.across);
      const double y = coordinate(p, frame.depth);
      const double height = coordinate(p, frame.axis);
      const std::size_t j = k / lattice.width;
      for (std::size_t row = j == 0 ? 0 : j - 1; row <= j && row < lattice.rows; ++row) {
        rows[row].low = std::min(rows[row].low, height);
        rows[row].high = std::max(rows[row].high, height);
        rows[row].room = std::min(rows[row].room, 0.9 * chord * std::sqrt(x * x + y * y));
      }
    }
    std::vector<Vector> points(surface.size());
    points[surface.south()] = frame.origin + low * frame.axis;
    points[surface.north()] = frame.origin + high * frame.axis;
    for (std::size_t k = 1; k < bands; ++k) {
      const double height = low + band * static_cast<double>(k);
      double radius = radius_at(part.body, height);
      for (const Row& row : rows)
        if (height + band >= row.low && height - band <= row.high)
          radius = std::min(radius, row.room);
      for (std::size_t i = 0; i < columns; ++i)
        points[surface.ring_vertex(i, k)] =
            frame.origin + height * frame.axis + radius * frame.radial(surface.turns(i, k));
    }
    surface.add(builder, part.body_name, points);
    return Closed_surface::count_faces(columns, bands);
  }

  void place_button(Soup_builder& builder, const Part& part, const Lattice& lattice,
                    const std::vector<double>& outer, std::size_t number) const
  {
    const double radius = 0.009;
    const auto [turns, height] = part.buttons[number];
    const Frame frame = part.frame(lattice);
    const Vector radial = frame.radial(turns);
    const Vector axis = radial / std::sqrt(radial.squared_length());
    const Vector middle = frame.origin + height * frame.axis;

    // A triangle under the button has all its corners within the radius plus the longest edge.
    double longest = 0;
    const auto position = [&](std::size_t k) { return lattice.base[k] + outer[k] * lattice.direction[k]; };
    Cancellation_poll poll;
    for (std::size_t j = 0; j < lattice.rows; ++j)
      for (std::size_t i = 0; i < lattice.columns; ++i) {
        poll();
        const Vector p = position(lattice.vertex(i, j));
        const Vector q = position(lattice.vertex(i + 1, j));
        const Vector r = position(lattice.vertex(i + 1, j + 1));
        const Vector s = position(lattice.vertex(i, j + 1));
        for (const Vector& e : {q - p, r - p, s - p, s - q, r - q, r - s})
          longest = std::max(longest, e.squared_length());
      }
    const double reach = radius + std::sqrt(longest);
    double distance = 0;
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const Vector p = position(k) - middle;
      const double along = p * axis;
      if (along > 0 && (p - along * axis).squared_length() <= reach * reach)
        distance = std::max(distance, along);
    }
    add_button(builder, part.name + "button_" + std::to_string(number), middle, axis, frame.axis, radius,
               distance + m_options.gap, 0.003, button_corners(m_options));
  }

  const Generate_options& m_options;
  std::size_t m_layers;
  std::vector<Part> m_parts;
  Random m_random;
  double m_phase;
};

} // namespace

Triangle_soup make_garment(const Generate_options& options, std::vector<Part> parts)
{
  Triangle_soup soup = Garment(options, std::move(parts)).make();
  for (Point_3& p : soup.points)
    p = Point_3(p.x(), p.z(), 0 - p.y()); // -y, but never -0
  return soup;
}

} // namespace selvedge::internal
