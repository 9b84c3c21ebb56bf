// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_GENERATE_GARMENT_H
#define SELVEDGE_GENERATE_GARMENT_H

#include "generate/Lattice.h"

#include <selvedge/generate.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

// What a garment is made of: parts, each with its pattern pieces, patches, buttons and body.

namespace selvedge::internal {

/// Heights with their radii, joined by smooth steps.
using Profile = std::vector<std::array<double, 2>>;

double radius_at(const Profile& profile, double height);

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
  bool closed = false;
  /// Typical extent in metres; the bodies share their faces by these areas.
  double width = 0, height = 0;
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

/// Returns how many cells of a size a length has, at least `least`.
std::size_t cells_along(double length, double cell, double least);

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

  void shape(const Frame& frame, Lattice& lattice) const;
};

Part tube(const Tube& shape, const Frame& frame, double width, double height);

/// Returns the cells of a part that a pattern takes, one at least.
Panel place(const Pattern& pattern, const std::string& name, const Division& division);

/// Puts a garment together from its parts: cloths in layers, patches, buttons, and the bodies inside. Parts
/// have z up and their fronts at -y. The garment has y up and its front at z, as in glTF and in most programs
/// for garments; this turn is exact.
Triangle_soup make_garment(const Generate_options& options, std::vector<Part> parts);

} // namespace selvedge::internal

#endif // SELVEDGE_GENERATE_GARMENT_H
