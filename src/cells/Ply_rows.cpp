// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cells/Ply_rows.h"

#include "files/Binary_reader.h"
#include "files/Text_reader.h"
#include "files/ply_types.h"
#include "soup/with_number.h"

#include <selvedge/Error.h>

#include <algorithm>
#include <cstring>

namespace selvedge::cells {

using files::Binary_reader;
using files::in_quotes;
using files::Text_reader;
using Type = Attribute::Type;

namespace {

std::optional<Type> ply_type(std::string_view name)
{
  for (std::size_t i = 0; i < files::ply_type_names.size(); ++i)
    if (name == files::ply_type_names[i][0] || name == files::ply_type_names[i][1])
      return Type(i);
  return std::nullopt;
}

std::size_t bytes_of(Type type)
{
  return with_number(type, [](auto number) { return sizeof number; });
}

bool is_whole(Type type)
{
  return type != Type::float32 && type != Type::float64;
}

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

const Ply_rows::Property* Ply_rows::Element::find(std::string_view property) const
{
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const Property& p) { return p.name == property; });
  return found == properties.end() ? nullptr : &*found;
}

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

/// Returns false when the file is no PLY file of the kind that has rows to copy. Then `read_mesh` says what
/// is wrong with it, if anything is.
bool Ply_rows::read_header()
{
  Text_reader text(m_bytes, m_name);
  if (text.line() != "ply")
    return false;
  std::vector<Element> elements;
  bool is_little_endian = false;
  for (;;) {
    text.line(); // what is left of it
    if (text.at_end())
      return false;
    text.advance(1);
    Text_reader line = text;
    const std::string whole_line = std::string(line.line()) + '\n';
    const std::string_view keyword = text.word();
    if (keyword == "end_header")
      break;
    if (keyword == "format") {
      is_little_endian = text.word() == "binary_little_endian";
    } else if (keyword == "element") {
      Element& element = elements.emplace_back();
      element.name = text.word();
      const std::int64_t count = text.integer();
      if (count < 0)
        return false;
      element.count = std::size_t(count);
    } else if (keyword == "property" && !elements.empty()) {
      Property property;
      std::string_view type = text.word();
      if (type == "list") {
        property.count_type = ply_type(text.word());
        if (!property.count_type || !is_whole(*property.count_type))
          return false;
        type = text.word();
      }
      const std::optional<Type> known = ply_type(type);
      if (!known)
        return false;
      property.type = *known;
      property.name = text.word();
      elements.back().properties.push_back(property);
      elements.back().declarations += whole_line;
    } else if (keyword == "comment" || keyword == "obj_info") {
      m_comments += whole_line;
    }
  }
  text.line();
  if (!is_little_endian || text.at_end() || elements.size() < 2 || elements[0].name != "vertex" ||
      elements[1].name != "face")
    return false;
  text.advance(1);
  m_vertices = elements[0];
  m_faces = elements[1];
  for (std::size_t i = 2; i < elements.size(); ++i)
    m_other_elements.push_back(elements[i].name);

  std::size_t found = 0;
  for (const Property& property : m_vertices.properties) {
    if (property.count_type)
      return false;
    for (int axis = 0; axis < 3; ++axis)
      if (property.name == std::string(1, char('x' + axis))) {
        if (is_whole(property.type) || (found > 0 && m_is_float32 != (property.type == Type::float32)))
          return false;
        m_is_float32 = property.type == Type::float32;
        m_places[axis] = m_vertex_size;
        ++found;
      }
    m_vertex_size += bytes_of(property.type);
  }
  const Property* corners = m_faces.find("vertex_indices");
  if (!corners)
    corners = m_faces.find("vertex_index");
  if (found != 3 || !corners || !corners->count_type || !is_whole(corners->type))
    return false;
  m_corners_property = std::size_t(corners - m_faces.properties.data());
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
    const Property& property = m_faces.properties[i];
    std::uint64_t count = 1;
    if (property.count_type) {
      require(bytes_of(*property.count_type));
      count = whole_number(bytes.substr(at), *property.count_type);
      at += bytes_of(*property.count_type);
      if (count > bytes.size())
        fail("a face has a list of more values than the file can hold; it is damaged");
    }
    require(count * bytes_of(property.type));
    if (i == m_corners_property) {
      face.corners_begin = at;
      face.corners = count;
    }
    at += count * bytes_of(property.type);
  }
  face.row = bytes.substr(0, at);
  bytes.remove_prefix(at);
  return face;
}

Index Ply_rows::corner(const Face& face, std::size_t i) const
{
  const Type type = m_faces.properties[m_corners_property].type;
  const std::uint64_t number = whole_number(face.row.substr(face.corners_begin + i * bytes_of(type)), type);
  if (number >= m_vertices.count)
    fail("a face names vertex " + std::to_string(std::int64_t(number)) + ", but the vertices are 0 to " +
         std::to_string(m_vertices.count - 1) + "; export the file again");
  return Index(number);
}

void Ply_rows::set_corner(std::string& row, const Face& face, std::size_t i, Index number) const
{
  // No number of a piece is larger than that of the whole, so it fits.
  const std::size_t size = bytes_of(m_faces.properties[m_corners_property].type);
  for (std::size_t byte = 0; byte < size; ++byte)
    row[face.corners_begin + i * size + byte] = char(std::uint64_t(number) >> (8 * byte) & 0xff);
}

} // namespace selvedge::cells
