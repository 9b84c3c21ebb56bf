// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_SOUP_BUILDER_H
#define SELVEDGE_SRC_FILES_SOUP_BUILDER_H

#include "files/triangulate_polygon.h"

#include <selvedge/Error.h>
#include <selvedge/mesh/mesh_files.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace selvedge::files {

/// Fills a `Mesh_file`, whatever its format: cuts polygons, and takes the notes.
class Soup_builder
{
public:
  explicit Soup_builder(Mesh_format format) { m_file.format = format; }

  Triangle_soup& soup() { return m_file.soup; }
  void ignore(const std::string& name, std::size_t count = 1) { m_file.notes.ignored[name] += count; }

  /// `first_number` is what the format counts vertices from, `fail(message)` reports an error at the present
  /// place of the file and does not return.
  template <class Fail>
  void add_point(double x, double y, double z, int first_number, const Fail& fail)
  {
    std::vector<Point_3>& points = m_file.soup.points;
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      fail("vertex " + std::to_string(points.size() + first_number) +
           " has a coordinate that is not finite; remove or repair it");
    if (points.size() == std::numeric_limits<Index>::max())
      fail("the mesh has more than 4294967295 vertices; split it");
    points.emplace_back(x, y, z);
  }

  /// Adds a face whose corners are in range; `uvs` is empty or as long as `corners`. Returns how many
  /// triangles it became.
  std::size_t add_face(const std::vector<Index>& corners, const std::vector<Index>& uvs = {})
  {
    Triangle_soup& mesh = m_file.soup;
    if (corners.size() < 3) {
      ++m_file.notes.fewer_than_three;
      return 0;
    }
    if (has_repeated(corners))
      ++m_file.notes.repeated_corner;
    if (corners.size() == 3) {
      mesh.triangles.push_back({corners[0], corners[1], corners[2]});
      if (!uvs.empty())
        mesh.uvs.of_triangle.push_back({uvs[0], uvs[1], uvs[2]});
      return 1;
    }
    ++m_file.notes.polygons_cut;
    const std::vector<Index_triple> cut = triangulate_polygon(mesh.points, corners);
    for (const auto& [a, b, c] : cut) {
      mesh.triangles.push_back({corners[a], corners[b], corners[c]});
      if (!uvs.empty())
        mesh.uvs.of_triangle.push_back({uvs[a], uvs[b], uvs[c]});
    }
    return cut.size();
  }

  Mesh_file take(const std::string& name)
  {
    if (m_file.soup.triangles.empty())
      throw Input_error(name + ": the file has no faces" +
                        (m_file.notes.fewer_than_three != 0 ? " of three or more corners" : "") +
                        "; export the mesh as polygons");
    return std::move(m_file);
  }

private:
  static bool has_repeated(const std::vector<Index>& corners)
  {
    if (corners.size() == 3)
      return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    std::vector<Index> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  }

  Mesh_file m_file;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_SOUP_BUILDER_H
