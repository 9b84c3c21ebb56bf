// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_TRIANGULATE_POLYGON_H
#define SELVEDGE_SRC_FILES_TRIANGULATE_POLYGON_H

#include <selvedge/Triangle_soup.h>

#include <vector>

namespace selvedge::files {

/// Cuts a polygon of at least three corners into triangles, by the rule that mesh_files.h states; readers
/// call it through `Soup_builder`. The triangles name corners by their places in `corners`.
std::vector<Index_triple> triangulate_polygon(const std::vector<Point_3>& points,
                                              const std::vector<Index>& corners);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_TRIANGULATE_POLYGON_H
