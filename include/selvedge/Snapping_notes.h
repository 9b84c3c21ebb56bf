// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SNAPPING_NOTES_H
#define SELVEDGE_SNAPPING_NOTES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// One snap: all vertices at one position went to another. Each position is given by the first vertex that
/// was there before anything was snapped.
struct Snap
{
  Index from = 0;
  Index to = 0;
};

/// What snapping found and did, for the user; `Prepare_options::weld_distance` explains partners. Vertices
/// are counted by position. Without a weld distance everything is 0.
struct Snapping_notes
{
  double distance = 0; ///< the weld distance

  std::size_t border_vertices = 0; ///< vertices on borders, before snapping
  std::size_t partnered = 0;       ///< how many of them have a partner
  std::size_t snapped = 0;         ///< how many of the partnered now share a position with a partner

  /// Partnered vertices that were left as they were, by reason. With `snapped` they add up to `partnered`.
  std::size_t left_ambiguous = 0;  ///< every partner has a nearer one, or went with another
  std::size_t left_frozen = 0;     ///< the vertex, or every partner of it, belongs to a frozen face
  std::size_t left_foreign = 0;    ///< every partner is under another transform of a glTF scene, or frozen
  std::size_t left_unmanifold = 0; ///< an edge would get a third face, or two that run along it the same way
  std::size_t left_folding = 0;    ///< the faces that move would degenerate or meet each other
  std::size_t left_blocked = 0;    ///< the faces that move would meet others

  /// Vertices near another vertex of a border that are not partnered: there are no border edges to sew beside
  /// the two, or a short stretch of border joins them.
  std::size_t near_without_edge = 0;

  std::size_t seam_edges = 0;  ///< pairs of border edges that have become one edge
  double largest_distance = 0; ///< of one snap; where several pieces meet, a vertex may snap more than once
  std::vector<Snap> snaps;     ///< in the order in which they were done
};

} // namespace selvedge

#endif // SELVEDGE_SNAPPING_NOTES_H
