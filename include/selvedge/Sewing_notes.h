// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SEWING_NOTES_H
#define SELVEDGE_SEWING_NOTES_H

#include <cstddef>

namespace selvedge {

/// What sewing found in a soup, for the user. An obstacle is not counted.
struct Sewing_notes
{
  std::size_t unused_vertices = 0;     ///< vertices of no triangle
  std::size_t coincident_vertices = 0; ///< vertices at the same position as an earlier one

  /// Sewn edges across which a vertex number, texture coordinate, normal, group, object or material changes.
  std::size_t seam_edges = 0;

  std::size_t non_manifold_edges = 0; ///< edges of more than two triangles; not sewn
  std::size_t misoriented_edges = 0;  ///< edges along which both triangles run the same way; likewise

  std::size_t misoriented_pieces = 0; ///< pieces that have such an edge

  /// Positions at which several vertices stay apart, to keep edges manifold. They move together, or not at
  /// all.
  std::size_t unsewn_positions = 0;
};

} // namespace selvedge

#endif // SELVEDGE_SEWING_NOTES_H
