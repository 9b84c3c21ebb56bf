// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_LIKENESS_H
#define SELVEDGE_SRC_VERIFY_LIKENESS_H

#include "Shape.h"

#include <algorithm>

namespace selvedge::internal {

/// The largest root mean square distance of matching pieces, as a share of the diagonal of the original's.
constexpr double most_distance = 0.25;

/// A piece counts as turned inside out when at least this share of its area is, and no border shows that it
/// is not. Half is not enough: thin cloth that is reduced far has half of its area nearest to its other side.
constexpr double least_turned = 0.9;

/// A piece whose two sides are nearer to each other than this share of its diagonal is flat.
constexpr double most_thickness = 0.02;

/// How far a piece of the result is from one of the original, and how much of it is turned inside out.
struct Likeness
{
  Likeness(const Shape& now, const Shape& before)
      : distance(std::max(before.root_mean_square_distance(now), now.root_mean_square_distance(before)) /
                 before.diagonal()),
        turned(now.turned_against(before)),
        is_turned(turned >= least_turned && !now.has_border_of(before) &&
                  now.turned_against(before, std::min(distance, most_thickness) * before.diagonal()) >=
                      least_turned)
  {
  }
  bool is_wrong() const { return distance > most_distance || is_turned; }

  double distance, turned; // as in `Piece_match`
  /// A bag that is drawn flat to its mouth lies nearest to what is around the mouth, of which the outside
  /// looks away from it, and what is left of a thread lies nearest to its other side. But triangles that are
  /// turned turn their border, too. And where the two sides of a flat piece are nearer to each other than
  /// the pieces are, which one a triangle lies next to shows nothing.
  bool is_turned;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_LIKENESS_H
