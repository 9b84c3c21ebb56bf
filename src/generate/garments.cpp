// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "generate/Garment.h"
#include "generate/scenes.h"

#include <selvedge/Error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// The garments: skirt, jacket and shorts, in layers on bodies, as inputs of known properties for tests and
// benchmarks.

namespace selvedge::internal {

namespace {

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

Triangle_soup skirt(const Generate_options& options)
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
  return make_garment(options, {part});
}

// The sleeves are sewn in: the vertices around a hole in the torso's lattice are the first ring of the
// sleeve's.
Triangle_soup jacket(const Generate_options& options)
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
  return make_garment(options, {torso, sleeve(left, "left"), sleeve(right, "right")});
}

// The hips are a tube. Each leg begins with half of the lower ring of the hips and with a crotch seam in the
// plane x = 0, which both legs share. The directions of a leg never point up, and lean towards the other leg
// by less than the leg has already moved away from it. So the layers of the legs stay below those of the hips
// and on their own sides of that plane.
Triangle_soup shorts(const Generate_options& options)
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
  return make_garment(options, {hips, leg(1, "left"), leg(-1, "right")});
}

} // namespace selvedge::internal
