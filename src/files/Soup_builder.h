// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_SOUP_BUILDER_H
#define SELVEDGE_SRC_FILES_SOUP_BUILDER_H

#include "files/Polygon_starts.h"
#include "files/row_unlike.h"
#include "files/triangulate_polygon.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace selvedge::files {

/// Fills the `Mesh_file` that the readers of all formats but glTF return: cuts polygons into triangles, and
/// counts what the notes report.
class Soup_builder
{
public:
  explicit Soup_builder(Mesh_format format) { m_file.format = format; }

  Triangle_soup& soup() { return m_file.soup; }
  void ignore(const std::string& name, std::size_t count = 1) { m_file.notes.ignored[name] += count; }

  /// Adds a vertex. `first_number` is the number of the format's first vertex, for messages. `fail(message)`
  /// reports an error at the present place of the file and does not return.
  template <class Fail>
  void add_point(double x, double y, double z, int first_number, const Fail& fail)
  {
    m_poll();
    std::vector<Point_3>& points = m_file.soup.points;
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      fail("vertex " + std::to_string(points.size() + first_number) +
           " has a coordinate that is not finite; remove or repair it");
    if (points.size() == std::numeric_limits<Index>::max())
      fail("the mesh has more than 4294967295 vertices; split it");
    points.emplace_back(x, y, z);
  }

  /// Adds a face whose corners are in range; `uvs` and `normals` are empty or as long as `corners`. Returns
  /// how many triangles it became.
  std::size_t add_face(const std::vector<Index>& corners, const std::vector<Index>& uvs = {},
                       const std::vector<Index>& normals = {})
  {
    if (corners.size() > 3)
      if (const std::size_t start = m_start_of(m_file.soup.points, corners))
        return add_face(rotated(corners, start), rotated(uvs, start), rotated(normals, start));
    m_poll();
    Triangle_soup& mesh = m_file.soup;
    if (corners.size() < 3) {
      ++m_file.notes.fewer_than_three;
      return 0;
    }
    const bool is_simple = !has_repeated(corners);
    if (!is_simple)
      ++m_file.notes.repeated_corner;
    const std::size_t first = mesh.triangles.size();
    if (corners.size() == 3) {
      m_cut = {{0, 1, 2}};
    } else {
      ++m_file.notes.polygons_cut;
      m_cut = triangulate_polygon(mesh.points, corners);
      if (is_simple)
        mesh.polygons.push_back({Index(first), Index(corners.size()), place_of_first_corner()});
    }
    for (const auto& [a, b, c] : m_cut)
      mesh.triangles.push_back({corners[a], corners[b], corners[c]});
    add_values(mesh.uvs, uvs, first);
    add_values(mesh.normals, normals, first);
    return m_cut.size();
  }

  /// Gives the values of every vertex, in the order of the vertices, to all its corners. Called after the
  /// last face.
  template <std::size_t dimension>
  void set_vertex_values(Corner_values<dimension>& values,
                         std::vector<std::array<double, dimension>> of_vertex)
  {
    values = {std::move(of_vertex), m_file.soup.triangles};
  }

  /// Returns what was built. Throws `Input_error` when it has no triangle.
  Mesh_file take(const std::string& name, bool is_truncated = false)
  {
    if (m_file.soup.triangles.empty())
      throw Input_error(
          name + ": the file has no faces" +
          (m_file.notes.fewer_than_three != 0 ? " of three or more corners" : "") +
          (m_file.notes.ignored.count("line elements") + m_file.notes.ignored.count("point elements") != 0
               ? ", only points or lines"
               : "") +
          (is_truncated ? ", and ends within a line: it seems to be truncated"
                        : "; export the mesh as polygons"));
    if (is_truncated)
      ++m_file.notes.remarks["lines that are not ended, as at the end of a truncated file"];
    close(m_file.soup.uvs, "texture coordinates");
    close(m_file.soup.normals, "normals");
    return std::move(m_file);
  }

private:
  static constexpr Index s_none = std::numeric_limits<Index>::max();

  // Where the triangles have the first corner of the polygon: 3 × triangle + place in it.
  Index place_of_first_corner() const
  {
    Index place = 0;
    while (m_cut[place / 3][place % 3] != 0)
      ++place;
    return place;
  }

  static std::vector<Index> rotated(std::vector<Index> values, std::size_t start)
  {
    if (!values.empty())
      std::rotate(values.begin(), values.begin() + std::ptrdiff_t(start), values.end());
    return values;
  }

  template <std::size_t dimension>
  void add_values(Corner_values<dimension>& values, const std::vector<Index>& numbers, std::size_t first)
  {
    if (numbers.empty())
      return;
    values.of_triangle.resize(first, {s_none, s_none, s_none});
    for (const auto& [a, b, c] : m_cut)
      values.of_triangle.push_back({numbers[a], numbers[b], numbers[c]});
  }

  /// Gives triangles without values a value that stands for none.
  template <std::size_t dimension>
  void close(Corner_values<dimension>& values, const std::string& name)
  {
    if (values.empty()) {
      if (!values.values.empty())
        ignore(name + " that no face names", values.values.size());
      values = {};
      return;
    }
    values.of_triangle.resize(m_file.soup.triangles.size(), {s_none, s_none, s_none});
    const auto is_none = [](const Index_triple& corners) { return corners[0] == s_none; };
    if (std::none_of(values.of_triangle.begin(), values.of_triangle.end(), is_none))
      return;
    values.missing = static_cast<Index>(values.values.size());
    values.values.push_back(row_unlike(values.values));
    std::replace_if(values.of_triangle.begin(), values.of_triangle.end(), is_none,
                    Index_triple{*values.missing, *values.missing, *values.missing});
  }

  static bool has_repeated(const std::vector<Index>& corners)
  {
    if (corners.size() == 3)
      return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    std::vector<Index> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  }

  Mesh_file m_file;
  std::vector<Index_triple> m_cut;
  Polygon_starts m_start_of;
  Cancellation_poll m_poll;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_SOUP_BUILDER_H
