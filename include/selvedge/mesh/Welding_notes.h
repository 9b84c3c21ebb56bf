// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_WELDING_NOTES_H
#define SELVEDGE_MESH_WELDING_NOTES_H

#include <cstddef>

namespace selvedge {

/// What welding found, to be told to the user.
struct Welding_notes
{
  std::size_t unused_vertices = 0; ///< in no triangle
  std::size_t welded_vertices = 0; ///< joined to another at the same position
  std::size_t seam_edges = 0; ///< edges where two pieces, or two sides of a texture seam or group, are sewn
  std::size_t non_manifold_edges = 0; ///< of more than two triangles; not joined, their vertices do not move
  std::size_t misoriented_edges = 0;  ///< of two triangles that run along them the same way; likewise
  std::size_t unwelded_positions =
      0; ///< where vertices stay apart because one could not serve all; they do not move
};

} // namespace selvedge

#endif // SELVEDGE_MESH_WELDING_NOTES_H
