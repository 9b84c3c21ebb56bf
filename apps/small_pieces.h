// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_SMALL_PIECES_H
#define SELVEDGE_APPS_SMALL_PIECES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <optional>
#include <string>

namespace selvedge::app {

/// The many pieces of a mesh, connected by positions, that are clearly smaller than all others, as stitches
/// and buttons are.
struct Small_pieces
{
  std::string length; ///< below which they are, and no other is: for --drop-smaller
  std::size_t count = 0;
  std::size_t triangles = 0;
};

/// Returns the small pieces of a mesh: at least eight, and half of all, none larger than a twentieth of the
/// largest piece, and the next at least half as large again. Together they spread over half of the size of
/// the mesh, as stitches do, and the parts of a figure in a large room do not. Where several lengths do, it
/// is the one with the largest step. **Complexity** O(n log n).
std::optional<Small_pieces> small_pieces(const Triangle_soup& soup);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_SMALL_PIECES_H
