// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_VERIFY_LINES_H
#define SELVEDGE_VERIFY_LINES_H

#include <selvedge/compare.h>

#include <vector>

namespace selvedge::internal {

/// The borders or the seams of a mesh, as `compare` measures them. Each edge is stored as a triangle (a, b,
/// b), which is a segment, with the corner opposite it.
struct Lines
{
  Triangle_soup edges;
  std::vector<Index> opposite; ///< of each edge, in the first of its triangles
};

struct Borders_and_seams
{
  Lines borders, seams;
};

/// Finds borders and seams. Edges are identified by their positions; triangles that have two corners at one
/// position do not count.
Borders_and_seams borders_and_seams(const Triangle_soup& soup);

Line_comparison compare_lines(const Lines& result, const Lines& original);

Gaps find_gaps(const Borders_and_seams& result, const Borders_and_seams& original);

} // namespace selvedge::internal

#endif // SELVEDGE_VERIFY_LINES_H
