// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_TRIANGLE_SOUP_H
#define SELVEDGE_MESH_TRIANGLE_SOUP_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace selvedge {

/// The kernel of the compiled part: coordinates are doubles, predicates on them are exact.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;

/// Number of a vertex, a triangle or an attribute; 0-based, in the order of the file.
using Index = std::uint32_t;
using Index_triple = std::array<Index, 3>;

/// A mesh as a file holds it: vertices, triangles that name three of them, and what hangs on the corners.
///
/// Nothing is assumed of the triangles: a vertex may be unused, several may lie at one position, a triangle may
/// be degenerate, doubled or cross another, more than two may share an edge. Two triangles belong to one
/// *piece* when a chain of triangles joins them in which neighbours share a vertex number.
///
/// **Preconditions** of every function that takes a soup: coordinates are finite; indices are in range; each
/// array of per-triangle data is empty or as long as `triangles`. The readers of mesh_files.h see to it.
struct Triangle_soup
{
  /// One per vertex of the file, used or not.
  std::vector<Point_3> points;

  /// Three indices into `points`, counter-clockwise seen from outside.
  std::vector<Index_triple> triangles;

  /// Texture coordinates, in [0,1]² as a rule; empty when there are none.
  std::vector<std::array<double, 2>> uvs;

  /// For every triangle three indices into `uvs`; empty when there are none.
  std::vector<Index_triple> uv_triangles;

  /// For every triangle an index into `group_names`; empty when the file has no groups.
  std::vector<Index> groups;
  std::vector<std::string> group_names;
};

} // namespace selvedge

#endif // SELVEDGE_MESH_TRIANGLE_SOUP_H
