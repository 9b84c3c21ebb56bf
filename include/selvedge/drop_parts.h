// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_DROP_PARTS_H
#define SELVEDGE_DROP_PARTS_H

#include <selvedge/Triangle_soup.h>

#include <CGAL/Bbox_3.h>

#include <cstddef>
#include <string>
#include <vector>

namespace selvedge {

/// Triangles that are connected by positions, as stitches and buttons are that touch nothing larger.
struct Sized_piece
{
  CGAL::Bbox_3 box; ///< in the first pose
  double size = 0;  ///< the length of the box's diagonal, in the unit of the file
  std::size_t triangles = 0;
};

/// Returns the pieces of a mesh that are connected by positions, from small to large. **Complexity** O(n log
/// n).
std::vector<Sized_piece> sized_pieces(const Triangle_soup& soup);

/// Which triangles of a mesh are left out before anything else is done with it.
struct Parts_to_drop
{
  /// Names of groups, objects or materials, as `triangles_named` takes them.
  std::vector<std::string> names;

  /// Pieces of a smaller size (`Sized_piece`) go. 0 leaves out none.
  double smaller_than = 0;

  bool empty() const { return names.empty() && smaller_than == 0; }
};

/// What `drop_parts` has left of a mesh.
struct Parts_left
{
  std::vector<Index> triangles; ///< their numbers before, ascending
  std::size_t named = 0;        ///< triangles left out for their names
  std::size_t small = 0;        ///< and of the others, for their size,
  std::size_t small_pieces = 0; ///< in so many pieces
};

/// Leaves out triangles of a mesh. Vertices keep their numbers, used or not. In glTF, the textures go that
/// only primitives without a triangle show, and their images, where no extension that is not known here may
/// refer to them; so the materials of these primitives have none. Pieces are those of the mesh as it comes,
/// together with the parts that go by name.
///
/// Throws `Argument_error` when the size is negative or no number, or the mesh has no part of a name
/// (`triangles_named`), and `Input_error` when nothing would be left.
///
/// **Complexity** O(n log n); without a size, linear for each name.
Parts_left drop_parts(Triangle_soup& soup, const Parts_to_drop& parts);

} // namespace selvedge

#endif // SELVEDGE_DROP_PARTS_H
