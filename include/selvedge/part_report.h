// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_PART_REPORT_H
#define SELVEDGE_PART_REPORT_H

#include <selvedge/mesh/Parts.h>
#include <selvedge/simplify_soup.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge {

/// How far a texture has swum: for the centre of each triangle of the original, the distance in the plane of
/// the texture between its texture coordinates and those of the nearest point of the result on the same
/// chart, in units in which the texture is as large as the surface; as shares of the diagonal of the
/// original.
struct Uv_deviation
{
  double mean; ///< weighted by area
  double maximum;
};

/// None where nothing has a texture. A chart is what hangs together by texture coordinates and vertices.
///
/// **Exactness** Floating point. **Complexity** O(n log n) in practice.
std::optional<Uv_deviation> uv_deviation(const Simplified_soup& result, const Prepared_soup& original);

/// What became of a part of a soup.
struct Part_report
{
  Part_kind::Name kind;
  std::string name;     ///< empty for a piece
  Index first_triangle; ///< of the original
  std::size_t faces_input = 0;
  std::size_t faces_output = 0;
  Refusals refused;  ///< to its vertices
  Distance distance; ///< from its original vertices to what is left of it, as shares of the diagonal of the
                     ///< original
  std::optional<Uv_deviation> uv_deviation;
};

/// One for each piece, group, object and material that has triangles, by kinds; of the pieces only the
/// largest hundred.
std::vector<Part_report> part_reports(const Simplified_soup& result, const Prepared_soup& original);

} // namespace selvedge

#endif // SELVEDGE_PART_REPORT_H
