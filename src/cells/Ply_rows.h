// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_CELLS_PLY_ROWS_H
#define SELVEDGE_SRC_CELLS_PLY_ROWS_H

#include "files/Ply_header.h"

#include <selvedge/Triangle_soup.h>

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge::cells {

/// The rows of a little-endian binary PLY file, which is mapped and not read into memory. Its first two
/// elements are vertices, of which every property is a number, and faces.
class Ply_rows
{
public:
  /// Opens a file; none when it is another kind of PLY file. Throws `Input_error` when it is damaged.
  static std::optional<Ply_rows> open(const std::filesystem::path& path);

  const std::string& name() const { return m_name; }
  std::size_t number_of_vertices() const { return m_vertices.count; }
  std::size_t number_of_faces() const { return m_faces.count; }

  /// The lines of the header that declare the properties of vertices and of faces.
  const std::string& vertex_properties() const { return m_vertices.declarations; }
  const std::string& face_properties() const { return m_faces.declarations; }
  bool has_vertex_property(std::string_view name) const
  {
    return m_vertices.find(name) < m_vertices.properties.size();
  }
  bool has_face_property(std::string_view name) const
  {
    return m_faces.find(name) < m_faces.properties.size();
  }

  /// The comments of the header, as lines with their keywords.
  const std::string& comments() const { return m_comments; }

  /// The names of the elements after the faces.
  const std::vector<std::string>& other_elements() const { return m_other_elements; }

  std::string_view vertex_row(std::size_t vertex) const
  {
    return m_bytes.substr(m_vertices_begin + vertex * m_vertex_size, m_vertex_size);
  }
  Point_3 point(std::size_t vertex) const;

  /// The row of a face, and the numbers of its corners in it.
  struct Face
  {
    std::string_view row;
    std::size_t corners_begin = 0; ///< where in the row the first number is
    std::size_t corners = 0;
  };

  /// Passes one row of a face and takes it from `bytes`.
  Face take_face(std::string_view& bytes) const;
  std::string_view rows_of_faces() const { return m_bytes.substr(m_faces_begin); }

  /// Numbers of corners are read and written in the type that the file has for them.
  Index corner(const Face& face, std::size_t i) const;
  void set_corner(std::string& row, const Face& face, std::size_t i, Index number) const;

private:
  explicit Ply_rows(const std::filesystem::path& path);
  bool read_header();
  [[noreturn]] void fail(const std::string& message) const;

  std::string m_name;
  boost::interprocess::mapped_region m_region;
  std::string_view m_bytes;
  files::Ply_element m_vertices, m_faces;
  std::size_t m_corners_property = 0; // of m_faces
  std::size_t m_places[3] = {};       // of x, y and z in the row of a vertex
  bool m_is_float32 = false;
  std::size_t m_vertex_size = 0, m_vertices_begin = 0, m_faces_begin = 0;
  std::string m_comments;
  std::vector<std::string> m_other_elements;
};

} // namespace selvedge::cells

#endif // SELVEDGE_SRC_CELLS_PLY_ROWS_H
