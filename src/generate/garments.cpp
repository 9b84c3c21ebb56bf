// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Error.h>

#include "generate/Lattice.h"
#include "generate/scenes.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

// Makes garments in layers (skirt, jacket, shorts) on bodies, as inputs of known properties for tests and
// benchmarks.

namespace selvedge {

namespace {

using internal::Closed_surface;
using internal::cosine_sine;
using internal::Lattice;
using internal::Panel;
using internal::Random;
using internal::Soup_builder;
using internal::Vector;

/// Heights with their radii, joined by smooth steps.
using Profile = std::vector<std::array<double, 2>>;

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

/// A pattern piece, given by its range of the parameters (u, v) of its part.
struct Pattern
{
  std::string name;
  double u_first, u_last, v_first, v_last;
  unsigned hems;
};

/// An affine frame: an axis with two directions across it, which need not be of equal length.
struct Frame
{
  Vector origin, across, depth, axis;

  Vector radial(double turns) const
  {
    const auto [c, s] = cosine_sine(turns);
    return c * across + s * depth;
  }
};

struct Division
{
  std::size_t columns, rows;
};

/// A part of a garment: one lattice with the pieces cut from it, the patches over it and the body under it.
struct Part
{
  std::string name;
  std::string body_name;
  bool closed;
  /// Typical extent in metres; the bodies share their faces by these areas.
  double width, height;
  /// Returns columns and rows for cells of a given size.
  std::function<Division(double cell)> divide;
  /// Sets base and direction of a lattice that has its parameters.
  std::function<void(Lattice& lattice)> shape;
  std::vector<Pattern> patterns;
  /// Patches over the outermost layer, level over level; those of one level lie apart.
  std::vector<std::vector<Pattern>> patches;
  /// Angles (in turns) and heights of buttons, in the frame of the body.
  std::vector<std::array<double, 2>> buttons;
  std::function<Frame(const Lattice& lattice)> frame;
  /// The radius of the body, unless the cloth leaves less room.
  Profile body;
};

std::size_t cells_along(double length, double cell, double least)
{
  return static_cast<std::size_t>(std::max(least, std::floor(length / cell + 0.5)));
}

/// A tube around an axis, all around or open along a line.
///
/// Its layers are graphs over the cylinder of angle and height. In the frame, the direction of stacking is
/// radial, and the radii of neighbouring vertices differ by less than 1.8 : 1. Although vertices are off
/// their lattice by up to an eighth of a cell, every triangle therefore shows its front to the directions of
/// its corners, as `Lattice` asks. Whatever the radii, the base never comes near itself across the cylinder.
struct Tube
{
  double first_turn, last_turn;
  double bottom, top;
  std::function<double(double turns, double height)> radius;

  void shape(const Frame& frame, Lattice& lattice) const
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
};

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

/// Puts a garment together from its parts: cloths in layers, patches, buttons, and the bodies inside.
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

/// Returns the largest thickness that all layers, pockets and bands have together.
double stack_of(const Generate_options& options)
{
  return (options.layers + 3) * (options.thickness + 2 * options.gap);
}

/// Refuses a stack that is thicker than `room`, which is far less than the width of the tubes.
void require_thin(const Generate_options& options, double room)
{
  const double stack = stack_of(options);
  if (stack > room)
    throw Argument_error("the layers with their gaps are " + std::to_string(stack) +
                         " m thick together, but this garment has room for " + std::to_string(room) +
                         " m; reduce layers, thickness or gap");
}

const Frame UPRIGHT{Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)};

/// A hole in the torso's lattice for a sleeve.
///
/// Around it the directions lean away from the hole. At its edge they are halfway between the normals of
/// torso and sleeve, so that both surfaces show their fronts to them. They lean less and less over twice the
/// room that the stack has, so leaning never turns a triangle over.
struct Armhole
{
  static constexpr double bottom = 0.54;
  static constexpr double top = 0.8;

  double first, last;
  Vector arm, forward;

  Panel place_in(const Division& division) const
  {
    return place({"", first, last, bottom, top, Panel::NONE}, "", division);
  }

  /// Returns half the width of what fits through the hole.
  double radius(const Lattice& torso) const
  {
    const std::vector<std::size_t> edge = ring(torso);
    const Vector up = CGAL::cross_product(arm, forward);
    double least = std::numeric_limits<double>::max();
    for (const Vector& across : {forward, -forward, up, -up}) {
      double most = 0;
      for (const std::size_t k : edge)
        most = std::max(most, (torso.base[k] - middle(torso)) * across);
      least = std::min(least, most);
    }
    return least;
  }

  Vector middle(const Lattice& torso) const
  {
    const std::vector<std::size_t> edge = ring(torso);
    Vector sum(0, 0, 0);
    for (const std::size_t k : edge)
      sum = sum + torso.base[k];
    return sum / static_cast<double>(edge.size());
  }

  /// Returns the frame of the sleeve, whose axis starts in the middle of the hole.
  Frame frame(const Lattice& torso) const
  {
    return {middle(torso), forward, CGAL::cross_product(arm, forward), arm};
  }

  /// Returns the vertices around the hole, counter-clockwise as seen from outside, from the lower left
  /// corner.
  std::vector<std::size_t> ring(const Lattice& lattice) const
  {
    const Panel panel = place_in({lattice.columns, lattice.rows});
    std::vector<std::size_t> vertices;
    for (std::size_t i = panel.first_column; i < panel.last_column; ++i)
      vertices.push_back(lattice.vertex(i, panel.first_row));
    for (std::size_t j = panel.first_row; j < panel.last_row; ++j)
      vertices.push_back(lattice.vertex(panel.last_column, j));
    for (std::size_t i = panel.last_column; i > panel.first_column; --i)
      vertices.push_back(lattice.vertex(i, panel.last_row));
    for (std::size_t j = panel.last_row; j > panel.first_row; --j)
      vertices.push_back(lattice.vertex(panel.first_column, j));
    return vertices;
  }

  void tilt_directions(Lattice& lattice, double width, double height) const
  {
    const Vector centre = middle(lattice);
    const Panel panel = place_in({lattice.columns, lattice.rows});
    const auto beyond = [](double x, std::size_t low, std::size_t high, std::size_t cells) {
      const double n = static_cast<double>(cells);
      return std::max({0.0, static_cast<double>(low) / n - x, x - static_cast<double>(high) / n});
    };
    for (std::size_t k = 0; k < lattice.base.size(); ++k) {
      const double dx = width * beyond(lattice.u[k], panel.first_column, panel.last_column, lattice.columns);
      const double dy = height * beyond(lattice.v[k], panel.first_row, panel.last_row, lattice.rows);
      const double lean = 1 - radius_at({{0, 0}, {0.06, 1}}, std::sqrt(dx * dx + dy * dy));
      const Vector away = lattice.base[k] - centre;
      const Vector across = away - (away * arm) * arm;
      if (lean == 0 || across == CGAL::NULL_VECTOR)
        continue;
      const Vector edge = (across / std::sqrt(across.squared_length()) + arm) / std::sqrt(2.0);
      const Vector d = (1 - lean) * lattice.direction[k] + lean * edge;
      lattice.direction[k] = d / std::sqrt(d.squared_length());
    }
  }
};

} // namespace

Triangle_soup internal::skirt(const Generate_options& options)
{
  require_thin(options, 0.05);
  Random random(options.seed + 1000003u);
  const double phase = random.unit();
  const double drift = 0.2 * random.symmetric();
  const Profile shape{{0.4, 0.33}, {0.85, 0.2}, {1.05, 0.14}};
  const auto radius = [=, &options](double turns, double height) {
    const double fall = (1.05 - height) / 0.65;
    const double pleat = cosine_sine(options.folds * turns + phase + drift * height)[0];
    const double uneven = cosine_sine(3 * turns - phase)[1];
    const double second = cosine_sine((options.folds / 2 + 1) * turns + 2 * phase - drift * height)[1];
    return radius_at(shape, height) +
           options.fold_depth * fall * (pleat * (0.75 + 0.25 * uneven) + 0.35 * second);
  };
  Frame frame = UPRIGHT;
  frame.depth = Vector(0, 0.85, 0);
  Part part = tube({0, 1, 0.4, 1.05, radius}, frame, 1.5, 0.65);
  part.patterns = {{"front", 0.5, 1, 0, 0.9, Panel::BOTTOM},
                   {"back", 0, 0.5, 0, 0.9, Panel::BOTTOM},
                   {"yoke_right", 0.25, 0.75, 0.9, 1, Panel::TOP},
                   {"yoke_left", 0.75, 1.25, 0.9, 1, Panel::TOP}};
  part.patches = {
      {{"pocket_left", 0.84, 0.91, 0.5, 0.72, Panel::ALL},
       {"pocket_right", 0.59, 0.66, 0.5, 0.72, Panel::ALL}},
      {{"waistband", 0, 1, 0.93, 0.99, Panel::BOTTOM | Panel::TOP}},
      {{"loop_left", 0.87, 0.885, 0.9, 1, Panel::ALL}, {"loop_right", 0.61, 0.625, 0.9, 1, Panel::ALL}}};
  part.buttons = {{0.75, 1.024}};
  part.body_name = "body";
  part.body = {{0.32, 0.05}, {0.36, 0.1},  {0.6, 0.155}, {0.85, 0.17}, {1.05, 0.125},
               {1.3, 0.155}, {1.42, 0.13}, {1.47, 0.05}, {1.52, 0.05}};
  return Garment(options, {part}).make();
}

// The sleeves are sewn in: the vertices around a hole in the torso's lattice are the first ring of the
// sleeve's.
Triangle_soup internal::jacket(const Generate_options& options)
{
  require_thin(options, 0.03);
  Random random(options.seed + 2000003u);
  const double phase = random.unit();

  // Open in front, where y is least.
  const Profile profile{{0.78, 0.19}, {1.0, 0.165}, {1.2, 0.175}, {1.33, 0.16}, {1.42, 0.09}, {1.47, 0.095}};
  const auto radius = [=, &options](double turns, double height) {
    const double loose = 0.25 + 0.6 * std::max(0.0, 1.0 - height) / 0.22;
    const double fold = cosine_sine(options.folds * turns * 0.5 + phase + 0.9 * height)[0];
    const double crease = cosine_sine(2 * turns - phase)[1] * cosine_sine(7 * height + 3 * turns)[0];
    return radius_at(profile, height) + options.fold_depth * loose * (0.3 * fold + 0.2 * crease);
  };
  Frame upright = UPRIGHT;
  upright.across = Vector(1.2, 0, 0);
  upright.depth = Vector(0, 0.8, 0);
  const double width = 1.1;
  const double height = 0.69;
  const Tube trunk{0.765, 1.735, 0.78, 1.47, radius};
  const Armhole left{0.172, 0.312, Vector(12.0 / 13, 0, -5.0 / 13), Vector(0, 1, 0)};
  const Armhole right{0.688, 0.828, Vector(-12.0 / 13, 0, -5.0 / 13), Vector(0, -1, 0)};

  const auto torso_lattice = std::make_shared<std::optional<Lattice>>();
  Part torso = tube(trunk, upright, width, height);
  torso.divide = [=](double cell) {
    return Division{cells_along(width, cell, 12), cells_along(height, cell, 8)};
  };
  torso.shape = [=](Lattice& lattice) {
    trunk.shape(upright, lattice);
    for (const Armhole& hole : {left, right})
      hole.tilt_directions(lattice, width, height);
    *torso_lattice = lattice;
  };
  torso.patterns = {
      {"front_left", 0, left.first, 0, 0.9, Panel::LEFT | Panel::BOTTOM},
      {"side_left", left.first, left.last, 0, Armhole::bottom, Panel::BOTTOM},
      {"shoulder_left", left.first, left.last, Armhole::top, 0.9, Panel::NONE},
      {"back", left.last, right.first, 0, 0.9, Panel::BOTTOM},
      {"side_right", right.first, right.last, 0, Armhole::bottom, Panel::BOTTOM},
      {"shoulder_right", right.first, right.last, Armhole::top, 0.9, Panel::NONE},
      {"front_right", right.last, 1, 0, 0.9, Panel::RIGHT | Panel::BOTTOM},
      {"collar", 0, 1, 0.9, 1, Panel::LEFT | Panel::RIGHT | Panel::TOP},
  };
  torso.patches = {{{"pocket_left", 0.06, 0.18, 0.12, 0.28, Panel::ALL},
                    {"pocket_right", 0.82, 0.94, 0.12, 0.28, Panel::ALL},
                    {"back_strap", 0.38, 0.62, 0.33, 0.37, Panel::ALL}},
                   {{"flap_left", 0.055, 0.185, 0.25, 0.3, Panel::ALL},
                    {"flap_right", 0.815, 0.945, 0.25, 0.3, Panel::ALL}}};
  torso.buttons = {{0.785, 0.87}, {0.785, 0.99}, {0.785, 1.11}, {0.785, 1.23}};
  torso.body_name = "body";
  torso.body = {{0.68, 0.06}, {0.72, 0.13}, {0.85, 0.16}, {1.0, 0.135}, {1.2, 0.16},   {1.33, 0.14},
                {1.42, 0.06}, {1.48, 0.05}, {1.53, 0.07}, {1.6, 0.08},  {1.68, 0.065}, {1.71, 0.03}};

  const auto sleeve = [&](const Armhole& hole, const std::string& name) {
    const double length = 0.5;
    Part part;
    part.name = "sleeve_" + name + "_";
    part.closed = true;
    part.width = 0.45;
    part.height = length;
    part.divide = [=, divide_torso = torso.divide](double cell) {
      const Panel panel = hole.place_in(divide_torso(cell));
      return Division{2 * (panel.columns() + panel.rows()), cells_along(length, cell, 4)};
    };
    part.frame = [=](const Lattice&) { return hole.frame(**torso_lattice); };
    part.shape = [=, &options](Lattice& lattice) {
      const std::vector<std::size_t> ring = hole.ring(**torso_lattice);
      const Frame frame = hole.frame(**torso_lattice);
      const double wide = 0.95 * hole.radius(**torso_lattice);
      const double columns = static_cast<double>(lattice.columns);
      for (std::size_t k = 0; k < lattice.u.size(); ++k) {
        if (k < lattice.columns) {
          lattice.u[k] = static_cast<double>(k) / columns;
          lattice.base.push_back((*torso_lattice)->base[ring[k]]);
          lattice.direction.push_back((*torso_lattice)->direction[ring[k]]);
          continue;
        }
        const double turns = lattice.u[k] - 0.375;
        const double t = lattice.v[k];
        const double crease = cosine_sine(5 * t + phase)[0] * cosine_sine(turns + phase + t)[0];
        const double tube_radius = wide + (0.065 - wide) * t + 0.15 * options.fold_depth * crease;
        const Vector radial = frame.radial(turns);
        const Vector along = length * t * frame.axis;
        const double x = lattice.u[k] * columns + columns;
        const auto before = static_cast<std::size_t>(x);
        const double between = x - static_cast<double>(before);
        const auto mix = [&](const std::vector<Vector>& values) {
          return (1 - between) * values[ring[before % ring.size()]] +
                 between * values[ring[(before + 1) % ring.size()]];
        };
        const double round = radius_at({{0, 0}, {0.4, 1}}, t);
        const Vector d = (1 - round) * mix((*torso_lattice)->direction) + round * radial;
        lattice.base.push_back((1 - round) * (mix((*torso_lattice)->base) + along) +
                               round * (frame.origin + along + tube_radius * radial));
        lattice.direction.push_back(d / std::sqrt(d.squared_length()));
      }
    };
    part.patterns = {{"under", 0, 0.5, 0, 1, Panel::TOP}, {"upper", 0.5, 1, 0, 1, Panel::TOP}};
    part.patches = {{{"cuff", 0, 1, 0.86, 0.97, Panel::BOTTOM | Panel::TOP}}};
    part.body_name = "arm_" + name;
    part.body = {{0.03, 0.02}, {0.06, 0.05}, {0.3, 0.045}, {0.5, 0.035}, {0.58, 0.035}, {0.64, 0.01}};
    return part;
  };
  return Garment(options, {torso, sleeve(left, "left"), sleeve(right, "right")}).make();
}

// The hips are a tube. Each leg begins with half of the lower ring of the hips and with a crotch seam in the
// plane x = 0, which both legs share. The directions of a leg never point up, and lean towards the other leg
// by less than the leg has already moved away from it. So the layers of the legs stay below those of the hips
// and on their own sides of that plane.
Triangle_soup internal::shorts(const Generate_options& options)
{
  require_thin(options, 0.025);
  Random random(options.seed + 3000017u);
  const double phase = random.unit();

  const double crotch_height = 0.75;
  const double hem_height = 0.47;
  const Profile profile{{0.75, 0.2}, {0.85, 0.195}, {1.0, 0.15}};
  const Tube trunk{0, 1, crotch_height, 1.0, [=, &options](double turns, double height) {
                     const double crease = cosine_sine(options.folds * turns + 2 * height + phase)[0];
                     return radius_at(profile, height) - 0.1 * options.fold_depth * (1 + crease);
                   }};
  Frame upright = UPRIGHT;
  upright.depth = Vector(0, 0.8, 0);

  const auto hips_lattice = std::make_shared<std::optional<Lattice>>();
  Part hips = tube(trunk, upright, 1.1, 0.26);
  // The seams in the middle of front and back are at quarters of the columns.
  hips.divide = [](double cell) {
    return Division{4 * cells_along(1.1 / 4, cell, 3), cells_along(0.26, cell, 4)};
  };
  hips.shape = [=](Lattice& lattice) {
    trunk.shape(upright, lattice);
    *hips_lattice = lattice;
  };
  hips.patterns = {
      {"left_front", 0.75, 1, 0, 0.8, Panel::NONE},   {"left_back", 0, 0.25, 0, 0.8, Panel::NONE},
      {"right_back", 0.25, 0.5, 0, 0.8, Panel::NONE}, {"right_front", 0.5, 0.75, 0, 0.8, Panel::NONE},
      {"yoke_left", 0.75, 1.25, 0.8, 1, Panel::TOP},  {"yoke_right", 0.25, 0.75, 0.8, 1, Panel::TOP}};
  hips.patches = {
      {{"pocket_left_front", 0.87, 0.95, 0.2, 0.62, Panel::ALL},
       {"pocket_left_back", 0.08, 0.18, 0.2, 0.62, Panel::ALL},
       {"pocket_right_back", 0.32, 0.42, 0.2, 0.62, Panel::ALL},
       {"pocket_right_front", 0.55, 0.63, 0.2, 0.62, Panel::ALL}},
      {{"waistband", 0, 1, 0.84, 0.98, Panel::BOTTOM | Panel::TOP}},
      {{"loop_left", 0.9, 0.92, 0.8, 1, Panel::ALL}, {"loop_right", 0.58, 0.6, 0.8, 1, Panel::ALL}}};
  hips.buttons = {{0.76, 0.975}};
  hips.body_name = "body";
  hips.body = {{0.74, 0.05}, {0.76, 0.12},  {0.85, 0.17}, {1.0, 0.13}, {1.22, 0.16},
               {1.34, 0.14}, {1.41, 0.055}, {1.46, 0.05}, {1.5, 0.05}};

  const auto leg = [&](double side, const std::string& name) {
    Part part;
    part.name = "leg_" + name + "_";
    part.closed = true;
    part.width = 0.6;
    part.height = crotch_height - hem_height;
    part.divide = [=, divide_hips = hips.divide](double cell) {
      const std::size_t half = divide_hips(cell).columns / 2;
      return Division{half + std::max<std::size_t>(2, half * 46 / 100),
                      cells_along(crotch_height - hem_height, cell, 4)};
    };
    Frame frame = UPRIGHT;
    frame.origin = Vector(side * 0.115, 0, 0);
    part.frame = [=](const Lattice&) { return frame; };
    part.shape = [=, &options](Lattice& lattice) {
      const Lattice& above = **hips_lattice;
      const std::size_t half = above.columns / 2;
      const std::size_t crotch = lattice.columns - half;
      const std::size_t first = (side > 0 ? 3 : 1) * half / 2;
      std::vector<Vector> ring, ring_direction;
      for (std::size_t i = 0; i <= half; ++i) {
        ring.push_back(above.base[above.vertex(first + i, 0)]);
        ring_direction.push_back(above.direction[above.vertex(first + i, 0)]);
      }
      const Vector front = side > 0 ? ring.front() : ring.back();
      const Vector back = side > 0 ? ring.back() : ring.front();
      for (std::size_t i = 1; i < crotch; ++i) {
        // Counted from the front in both legs, so that both compute the same bits.
        const double s = static_cast<double>(side > 0 ? crotch - i : i) / static_cast<double>(crotch);
        const auto [c, d] = cosine_sine(s / 2);
        ring.emplace_back(0, front.y() + (back.y() - front.y()) * s, crotch_height - 0.24 * s * (1 - s));
        ring_direction.emplace_back(0, -c, -d);
      }
      for (std::size_t k = 0; k < lattice.u.size(); ++k) {
        if (k >= lattice.rows * lattice.width) {
          const std::size_t i = k % lattice.width;
          lattice.u[k] = static_cast<double>(i) / static_cast<double>(lattice.columns);
          lattice.base.push_back(ring[i]);
          lattice.direction.push_back(ring_direction[i]);
          continue;
        }
        const double columns = static_cast<double>(lattice.columns);
        const double x = lattice.u[k] < 0 ? lattice.u[k] * columns + columns : lattice.u[k] * columns;
        const auto before = static_cast<std::size_t>(x);
        const double between = x - static_cast<double>(before);
        const auto mix = [&](const std::vector<Vector>& values) {
          return (1 - between) * values[before % ring.size()] + between * values[(before + 1) % ring.size()];
        };
        const double outside = static_cast<double>(half);
        const double turns =
            (side > 0 ? 0 : 0.5) +
            (x < outside ? 0.658 + 0.684 * x / outside : 1.342 + 0.316 * (x - outside) / (columns - outside));
        const double t = 1 - lattice.v[k];
        const double crease = cosine_sine(std::floor(options.folds * 0.5) * turns + phase + t)[0];
        const double radius = 0.085 - 0.15 * options.fold_depth * t * (1 + crease);
        const Vector radial = frame.radial(turns);
        // The leg leads away from the crotch first, then down, like a vault.
        const double out = t * (2 - t);
        const double down = t * (1 + t) / 2;
        const Vector top = mix(ring);
        const Vector bottom = frame.origin + hem_height * frame.axis + radius * radial;
        lattice.base.emplace_back((1 - out) * top.x() + out * bottom.x(),
                                  (1 - out) * top.y() + out * bottom.y(),
                                  (1 - down) * top.z() + down * bottom.z());
        const Vector d = (1 - t) * mix(ring_direction) + t * radial;
        lattice.direction.push_back(d / std::sqrt(d.squared_length()));
      }
    };
    const std::string first = side > 0 ? "back" : "front";
    const std::string second = side > 0 ? "front" : "back";
    part.patterns = {{first, 0.342, 0.842, 0, 1, Panel::BOTTOM}, {second, 0.842, 1.342, 0, 1, Panel::BOTTOM}};
    part.patches = {{{"cuff", 0, 1, 0.04, 0.16, Panel::BOTTOM | Panel::TOP}}};
    part.body_name = "thigh_" + name;
    part.body = {{0.3, 0.02}, {0.32, 0.05}, {0.55, 0.065}, {0.64, 0.06}, {0.7, 0.02}};
    return part;
  };
  return Garment(options, {hips, leg(1, "left"), leg(-1, "right")}).make();
}

} // namespace selvedge
