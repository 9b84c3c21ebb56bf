// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cells/Ply_rows.h"

#include "files/Binary_reader.h"
#include "files/Text_reader.h"
#include "files/ply_types.h"
#include "soup/with_number.h"

#include <selvedge/Error.h>

#include <type_traits>

namespace selvedge::cells {

using files::Binary_reader;
using files::is_integer;
using files::ply_size_of;
using files::Text_reader;
using Type = Attribute::Type;

namespace {

/// Returns the whole number that the bytes begin with; a negative one as a very large one.
std::uint64_t whole_number(std::string_view bytes, Type type)
{
  return with_number(type, [&](auto zero) {
    using Number = decltype(zero);
    if constexpr (std::is_integral_v<Number>)
      return std::uint64_t(std::int64_t(Binary_reader(bytes, false).take<Number>()));
    else
      return std::uint64_t(0);
  });
}

} // namespace

std::optional<Ply_rows> Ply_rows::open(const std::filesystem::path& path)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || std::filesystem::file_size(path, ignored) == 0)
    return std::nullopt;
  Ply_rows rows(path);
  if (!rows.read_header())
    return std::nullopt;
  return rows;
}

Ply_rows::Ply_rows(const std::filesystem::path& path) : m_name(path.string())
{
  namespace ipc = boost::interprocess;
  try {
    m_region = ipc::mapped_region(ipc::file_mapping(m_name.c_str(), ipc::read_only), ipc::read_only);
  } catch (const ipc::interprocess_exception& error) {
    fail(std::string("cannot be read: ") + error.what());
  }
  m_bytes = {static_cast<const char*>(m_region.get_address()), m_region.get_size()};
}

void Ply_rows::fail(const std::string& message) const
{
  throw Input_error(m_name + ": " + message);
}

/// Returns false when the file is no PLY file of the kind that has rows to copy.
bool Ply_rows::read_header()
{
  Text_reader text(m_bytes, m_name);
  if (Text_reader(text).line() != "ply")
    return false;
  const files::Ply_header header = files::read_ply_header(text);
  const std::vector<files::Ply_element>& elements = header.elements;
  if (header.format != "binary_little_endian" || elements.size() < 2 || elements[0].name != "vertex" ||
      elements[1].name != "face")
    return false;
  m_vertices = elements[0];
  m_faces = elements[1];
  for (std::size_t i = 2; i < elements.size(); ++i)
    m_other_elements.push_back(elements[i].name);
  for (const std::string& comment : header.comments)
    m_comments += comment + '\n';

  std::size_t found = 0;
  for (const files::Ply_property& property : m_vertices.properties) {
    if (property.count_type)
      return false;
    for (int axis = 0; axis < 3; ++axis)
      if (property.name == std::string(1, char('x' + axis))) {
        if (is_integer(property.type) || (found > 0 && m_is_float32 != (property.type == Type::float32)))
          return false;
        m_is_float32 = property.type == Type::float32;
        m_places[axis] = m_vertex_size;
        ++found;
      }
    m_vertex_size += ply_size_of(property.type);
  }
  const std::vector<files::Ply_property>& of_faces = m_faces.properties;
  m_corners_property = m_faces.find(has_face_property("vertex_indices") ? "vertex_indices" : "vertex_index");
  if (found != 3 || m_corners_property == of_faces.size() || !of_faces[m_corners_property].count_type ||
      !is_integer(of_faces[m_corners_property].type))
    return false;
  m_vertices_begin = m_bytes.size() - text.remaining();
  if (m_vertices.count > text.remaining() / m_vertex_size)
    fail("the file ends before its last vertex; it is cut short");
  m_faces_begin = m_vertices_begin + m_vertices.count * m_vertex_size;
  return true;
}

Point_3 Ply_rows::point(std::size_t vertex) const
{
  const std::string_view row = vertex_row(vertex);
  double coordinates[3];
  for (int axis = 0; axis < 3; ++axis) {
    Binary_reader number(row.substr(m_places[axis]), false);
    coordinates[axis] = m_is_float32 ? number.take<float>() : number.take<double>();
  }
  return {coordinates[0], coordinates[1], coordinates[2]};
}

Ply_rows::Face Ply_rows::take_face(std::string_view& bytes) const
{
  Face face;
  std::size_t at = 0;
  const auto require = [&](std::size_t count) {
    if (count > bytes.size() - at)
      fail("the file ends before its last face; it is cut short");
  };
  for (std::size_t i = 0; i < m_faces.properties.size(); ++i) {
    const files::Ply_property& property = m_faces.properties[i];
    std::uint64_t count = 1;
    if (property.count_type) {
      require(ply_size_of(*property.count_type));
      count = whole_number(bytes.substr(at), *property.count_type);
      at += ply_size_of(*property.count_type);
      if (count > bytes.size())
        fail("a face has a list of more values than the file can hold; it is damaged");
    }
    require(count * ply_size_of(property.type));
    if (i == m_corners_property) {
      face.corners_begin = at;
      face.corners = count;
    }
    at += count * ply_size_of(property.type);
  }
  face.row = bytes.substr(0, at);
  bytes.remove_prefix(at);
  return face;
}

Index Ply_rows::corner(const Face& face, std::size_t i) const
{
  const Type type = m_faces.properties[m_corners_property].type;
  const std::uint64_t number =
      whole_number(face.row.substr(face.corners_begin + i * ply_size_of(type)), type);
  if (number >= m_vertices.count)
    fail("a face names vertex " + std::to_string(std::int64_t(number)) + ", but the vertices are 0 to " +
         std::to_string(m_vertices.count - 1) + "; export the file again");
  return Index(number);
}

void Ply_rows::set_corner(std::string& row, const Face& face, std::size_t i, Index number) const
{
  // No number of a piece is larger than that of the whole, so it fits.
  const std::size_t size = ply_size_of(m_faces.properties[m_corners_property].type);
  for (std::size_t byte = 0; byte < size; ++byte)
    row[face.corners_begin + i * size + byte] = char(std::uint64_t(number) >> (8 * byte) & 0xff);
}

} // namespace selvedge::cells
