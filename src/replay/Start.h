// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REPLAY_START_H
#define SELVEDGE_REPLAY_START_H

#include "Lineage.h"
#include "Offences.h"
#include "contact.h"

#include <selvedge/Triangle_soup.h>
#include <selvedge/collapse_log.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace selvedge {
namespace reference {

/// The original as the writer of the log took it: rounded if the log says so, and without triangles that have
/// two corners at one position. In all that is by triangle, those of the obstacle follow those of `soup`.
struct Start
{
  Triangle_soup soup;
  std::vector<Point_3> points_of_first_pose;  // if `soup` is in a further one
  std::vector<std::array<Place, 3>> obstacle; // its corners have positions of `soup`, or others
  std::vector<Index> numbers;                 // of the triangles, in the original and the obstacle
  std::vector<char> is_locked;                // by position
  Offences offences;
  Lineage lineage;
  std::size_t offending_pairs = 0;

  /// For every triangle, the first with the same three positions, where pairs may descend and neither is
  /// frozen or without an area. `offences` and `lineage` are of first ones alone.
  std::vector<Index> fronts;

  /// For each pair of parts that may intersect, in which of the two each triangle is: 1, 2, or 0 for
  /// neither.
  std::vector<std::vector<char>> parts;
  /// Whether a pair of triangles may intersect because their parts may.
  bool is_permitted(Index f, Index g) const
  {
    for (const std::vector<char>& part_of : parts)
      if (part_of[f] + part_of[g] == 3)
        return true;
    return false;
  }
};

/// Takes the original as the header of a log says, and an obstacle as it is, in the pose of a number, or in
/// the first. Throws `Input_error` when parts that may intersect are not there, or have a position in common.
Start start_of(const Triangle_soup& original, const Triangle_soup& obstacle, const Log_header& header,
               std::optional<std::size_t> pose);

} // namespace reference
} // namespace selvedge

#endif // SELVEDGE_REPLAY_START_H
