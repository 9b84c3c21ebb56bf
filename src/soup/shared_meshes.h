// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_SOUP_SHARED_MESHES_H
#define SELVEDGE_SRC_SOUP_SHARED_MESHES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// A mesh of a glTF file that stands in several places of its scene: in nodes, or in instances of one. Meshes
/// with the same accessors, of which materials differ, count as one.
struct Shared_mesh
{
  struct Place
  {
    std::vector<Index> triangles; ///< in every place the same ones, in the same order
    bool is_mirrored;             ///< the second and third corner have changed places
  };
  std::vector<Place> places; ///< the one in which the mesh is largest comes first
};

/// Which places of meshes are not reduced like others.
enum class Apart : char {
  no,
  from_other_meshes, ///< only like those of the same mesh of the file
  from_all
};

struct Shared_meshes
{
  std::vector<Shared_mesh> meshes;
  std::size_t apart = 0; ///< meshes in several places that differ there
};

/// Returns the meshes that can be reduced in all of their places alike. All places must still have the same
/// triangles, with all vertices where the file has them, and none of the triangles that `apart` sets apart.
///
/// **Complexity** O(n log n).
Shared_meshes shared_meshes(const Triangle_soup& soup, const std::vector<Apart>& apart);

} // namespace selvedge

#endif // SELVEDGE_SRC_SOUP_SHARED_MESHES_H
