// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_VERIFY_BORDER_LINES_H
#define SELVEDGE_SRC_VERIFY_BORDER_LINES_H

#include "Surface_tree.h"

#include <cstddef>
#include <map>
#include <vector>

namespace selvedge::internal {

/// The lines that the border of a surface forms: its edges of one triangle, whatever the numbers of vertices,
/// one after another as these triangles run. A line ends at a point from which several edges go on.
class Border_lines
{
public:
  explicit Border_lines(const Surface& surface);

  /// Whether the border of another surface has edges between points of one line, and more of them run with
  /// the line than against it; compared exactly. An edge runs with a closed line if that is the shorter way,
  /// in edges. So of a closed line that has lost all but some points, in whatever places, more edges run with
  /// it; and more run against it when the triangles are turned.
  bool are_followed_by(const Surface& other) const;

private:
  struct Place
  {
    std::size_t line, number; // along the line
  };
  struct Line
  {
    std::size_t size;
    bool is_closed;
  };

  int direction(const Place& from, const Place& to) const;

  std::map<Point_3, Place> m_places;
  std::vector<Line> m_lines;
};

} // namespace selvedge::internal

#endif // SELVEDGE_SRC_VERIFY_BORDER_LINES_H
