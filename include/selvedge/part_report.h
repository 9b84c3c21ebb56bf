// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_PART_REPORT_H
#define SELVEDGE_PART_REPORT_H

#include <selvedge/Parts.h>
#include <selvedge/simplify.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge {

/// How far the texture has been displaced on the surface. The displacement is measured at the centre of each
/// triangle of the original: it is the distance, in the plane of the texture, between the texture coordinates
/// there and those of the nearest point of the result on the same chart. The texture is scaled such that it
/// is as large as the surface, and displacements are shares of the diagonal of the original.
struct Uv_deviation
{
  double mean = 0; ///< weighted by area
  double maximum = 0;
};

/// Returns the displacement of the texture over the whole original; none when nothing has a texture. A
/// *chart* is a set of triangles that are connected by both vertices and texture coordinates.
///
/// **Exactness** Floating point. **Complexity** O(n log n) in practice.
std::optional<Uv_deviation> uv_deviation(const Simplified_soup& result, const Prepared_soup& original);

/// The triangles of one part of a soup, and those of a result that are left of them.
struct Part_triangles
{
  std::vector<Index> before, after;
};

/// Returns the triangles of each part, in the order of their numbers.
std::vector<Part_triangles> triangles_of_parts(const Part_kind& kind, const Simplified_soup& result);

/// How far a part is from what is left of it, both divided by the scale of the original.
struct Part_distance
{
  Distance distance;   ///< from the original's vertices; infinite when nothing is left
  double diagonal = 0; ///< of the part, in the original
};

/// Returns how far each of some parts is from what is left of it.
///
/// **Exactness** Floating point. **Complexity** O(n log n) in practice for all parts together, in parallel.
std::vector<Part_distance> part_distances(const Simplified_soup& result, const Prepared_soup& original,
                                          const std::vector<Part_triangles>& parts);

/// What became of one part of a soup.
struct Part_report
{
  Part_kind::Name kind = Part_kind::Name::piece;
  std::string name;         ///< empty for a piece
  Index first_triangle = 0; ///< of the original
  std::size_t faces_input = 0;
  std::size_t faces_output = 0;
  Refusals refused; ///< see `Simplified_soup::refused_by_part`

  /// From the original vertices of the part to what is left of it, as shares of the diagonal of the original;
  /// infinite when nothing is left.
  Distance distance;
  std::optional<Uv_deviation> uv_deviation;
};

/// What became of the parts of a soup, and the displacement of its texture over all of them.
struct Part_reports
{
  std::vector<Part_report> parts;
  std::optional<Uv_deviation> uv_deviation; ///< what the function of this name returns
};

/// Returns a report for each piece, group, object and material that has triangles, kind by kind. Of the
/// pieces, only the hundred largest have one.
Part_reports part_reports(const Simplified_soup& result, const Prepared_soup& original);

} // namespace selvedge

#endif // SELVEDGE_PART_REPORT_H
