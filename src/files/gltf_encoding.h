// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_GLTF_ENCODING_H
#define SELVEDGE_SRC_FILES_GLTF_ENCODING_H

#include "soup/Gltf_scene.h"

#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::files {

/// A primitive as KHR_draco_mesh_compression holds it.
struct Draco_primitive
{
  std::string bytes;
  Gltf_scene::Json attributes; ///< numbers in the bytes, by name
  std::size_t vertices;        ///< that decoding gives
  std::size_t unquantised;     ///< columns that are not quantised any more
};

/// Compresses a primitive by Draco, such that decoding gives the very same bits: columns are quantised as
/// they were in the file if that loses nothing, and are kept as they are otherwise. Vertices and triangles
/// stay in their order unless they may be reordered, which takes about a third of the space. Then a vertex at
/// which fans of faces meet may become several that differ in nothing, one for each fan.
///
/// The columns have one row for each vertex; there is one at least. `corners`, three for each triangle,
/// counts the rows. Returns nothing where the result would not be smaller, or there is no Draco. O(n log n).
std::optional<Draco_primitive> encoded_by_draco(const std::vector<Gltf_scene::Column>& columns,
                                                const std::vector<Index>& corners, bool may_reorder);

/// Returns the direction nearest to that of a normal or tangent, or of what a morph target adds to it, among
/// those that its column could give in the file: of whole numbers by KHR_mesh_quantization, from -1 to 1, or
/// quantised by Draco. Nothing where the column held floats, or where the direction is farther beyond the box
/// in which Draco quantised it than a hundredth of its size.
std::optional<std::array<double, 3>> quantised_direction(const Gltf_scene::Column& column,
                                                         const std::array<double, 3>& direction);

/// Compresses the bytes of a buffer view as EXT_meshopt_compression has it: rows of so many bytes, or
/// triangles of indices of so many bytes. Decoding gives the same bytes; where `may_rotate` is given, the
/// corners of triangles may be rotated, which takes less space.
///
/// Rows of directions in whole numbers are filtered as the extension has it, where that takes less space.
///
/// Returns nothing where the result would not be smaller, rows are none that the extension takes, or there is
/// no meshoptimizer. Linear. What the extension says is without the place of the bytes.
std::optional<Gltf_scene::Meshopt_view> encoded_by_meshopt(const std::string& bytes, std::size_t row_size,
                                                           bool are_triangles, bool may_rotate);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_GLTF_ENCODING_H
