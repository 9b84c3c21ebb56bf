// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BORDER_GAPS_H
#define SELVEDGE_BORDER_GAPS_H

#include <cstddef>
#include <optional>
#include <vector>

namespace selvedge {

/// How far apart the two sides of open seams are, by the partners of border vertices, which
/// `Prepare_options::weld_distance` defines. Vertices are counted by position, and lengths are in the unit of
/// the coordinates. Borders that coincide are sewn anyhow: they are no borders here.
///
/// A length is *clear* when seams end at it, and something else begins well beyond:
/// - it is the least distance at which some vertex has a partner, and at most half the `limit`,
/// - at least half of the vertices that have a partner within half the limit have one within it,
/// - those that have one only beyond it, but within twice of it, are at most a twentieth as many,
/// - for at least a third of the vertices that have a partner within it, the surface continues beyond the
///   gap: the directions into the surface at the two partners make an obtuse angle. (They do not where layers
///   of cloth lie upon each other, or folds of one.)
///
/// Of several clear lengths, the one counts that is followed by the largest step, as a quotient, to the next
/// distance, which is infinite after the last; and of those with as large a step the least. From 0, which is
/// the distance of lips that part in some pose alone, every step to another distance is the least of all.
struct Border_gaps
{
  std::size_t border_vertices = 0;

  /// How far partners were looked for: the median length of border edges.
  double limit = 0;

  /// Of each vertex that has a partner, the least distance at which it has; ascending.
  std::vector<double> lengths;

  /// The clear length, or none. It closes the seams when it is used as `Prepare_options::weld_distance`.
  std::optional<double> clear_length;

  /// How many vertices have a partner within it; 0 without it.
  std::size_t within_clear_length = 0;

  /// The clear length of distances to edges, beyond that to partners, if there is one: seams whose two sides
  /// have different numbers of vertices have no partners at clear distances. Such a gap is the distance of a
  /// vertex to the nearest edge of another border (or of another part of its own) at which the surface
  /// continues, and along which that border runs the opposite way, give or take 60°. It counts
  /// - in rows of at least four vertices that face the border of one piece, and
  /// - if at least half of the vertices of this piece, or of their own, are inside. (Else, cards of hair and
  ///   small tiles would be seams.)
  ///
  /// Distances of less than 1/4096 of the limit count as that. This length closes nothing.
  std::optional<double> clear_length_to_edges;

  /// How many of the vertices that count have an edge within it; 0 without it.
  std::size_t within_clear_length_to_edges = 0;
};

} // namespace selvedge

#endif // SELVEDGE_BORDER_GAPS_H
