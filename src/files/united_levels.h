// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_UNITED_LEVELS_H
#define SELVEDGE_SRC_FILES_UNITED_LEVELS_H

#include <selvedge/Triangle_soup.h>

#include <vector>

namespace selvedge::files {

/// Returns one soup with the triangles of all levels of detail of a mesh, one level after another. Vertices
/// of the same position and attributes are one; where a level has several such, as at a seam, each of them is
/// one with a different one of any other level. Corner values and labels are those of the levels; poses,
/// polygons and attributes of triangles are left out.
///
/// There is one level at least. Throws `Argument_error` when the levels do not have the same names and kinds
/// of attributes. O(n log n).
Triangle_soup united(const std::vector<const Triangle_soup*>& levels);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_UNITED_LEVELS_H
