// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_WRITTEN_FACES_H
#define SELVEDGE_SRC_FILES_WRITTEN_FACES_H

#include "files/Polygon_starts.h"

#include <selvedge/mesh_files.h>

#include <cstddef>
#include <vector>

namespace selvedge::files {

/// The faces that a file holds of a soup: its triangles, but a polygon in place of the triangles into which
/// it was cut, where these are what every reader of this library cuts it into again.
///
/// A polygon is written only if
/// - its triangles in the soup form one polygon, which names no vertex twice,
/// - this polygon, cut again by the rule of mesh_files.h, gives exactly these triangles, in their order and
///   each with its first corner first,
/// - its triangles have the same labels and attributes, and the same texture coordinate and normal at each
///   corner of the polygon,
/// - and the format can hold so many corners: any number in OBJ and OFF, 127 or 255 in PLY, with and without
///   texture coordinates. STL and glTF hold triangles alone.
///
/// So whatever `Triangle_soup::polygons` says, the file reads back as the triangles of the soup.
///
/// **Complexity** O(t + n² log n) for t triangles and n corners of a polygon, as for reading it.
class Written_faces
{
public:
  /// The soup outlives this object.
  Written_faces(const Triangle_soup& soup, Mesh_format format);

  std::size_t size() const { return m_soup.triangles.size() - m_triangles_saved; }
  std::size_t polygons() const { return m_first_triangles.size(); }

  /// Calls `function(first_triangle, corners)` for every face in its order, with the corners of the face as 3
  /// × triangle + place in it.
  template <class Function>
  void for_each(const Function& function) const
  {
    std::vector<Index> corners;
    std::size_t polygon = 0;
    for (Index t = 0; t < m_soup.triangles.size();) {
      const bool is_polygon = polygon < m_first_triangles.size() && m_first_triangles[polygon] == t;
      if (is_polygon) {
        corners.assign(m_corners.begin() + std::ptrdiff_t(m_ends[polygon]),
                       m_corners.begin() + std::ptrdiff_t(m_ends[polygon + 1]));
        ++polygon;
      } else {
        corners = {3 * t, 3 * t + 1, 3 * t + 2};
      }
      function(t, corners);
      t += Index(corners.size() - 2);
    }
  }

private:
  struct Edge
  {
    Index from, to, corner;
  };

  Index vertex(Index corner) const { return m_soup.triangles[corner / 3][corner % 3]; }
  bool find_loop(const Cut_polygon& polygon);
  bool is_uniform(const Cut_polygon& polygon) const;
  bool is_cut_the_same(const Cut_polygon& polygon);
  const Edge* border_edge_from(Index from) const;

  const Triangle_soup& m_soup;
  std::vector<Index> m_first_triangles;  // of the polygons
  std::vector<Index> m_corners;          // of all polygons, one after another
  std::vector<std::size_t> m_ends = {0}; // of each polygon among the corners
  std::size_t m_triangles_saved = 0;
  std::vector<Edge> m_edges, m_border; // of the polygon in question
  std::vector<Index> m_loop;           // its corners
  Polygon_starts m_start_of;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_WRITTEN_FACES_H
