// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Text_reader.h"
#include "files/Written_faces.h"
#include "files/columns.h"
#include "files/formats.h"
#include "files/ply_types.h"
#include "soup/flat_shading.h"
#include "soup/poles.h"

#include <selvedge/Error.h>
#include <selvedge/rounding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>

// Writes PLY, text and binary: positions, normals, texture coordinates, and attributes as properties.

namespace selvedge::files {
namespace {

/// Writes numbers one after the other, in the encoding asked for.
class Value_writer
{
public:
  Value_writer(Byte_writer& out, Encoding encoding) : m_out(out), m_encoding(encoding) {}

  template <class Number>
  void write(Number number)
  {
    if (m_encoding == Encoding::ascii) {
      if (!m_is_line_begin)
        m_out << ' ';
      m_out << number;
      m_is_line_begin = false;
    } else if constexpr (sizeof number == 1) {
      m_out << static_cast<char>(number);
    } else {
      m_out.binary(number, m_encoding == Encoding::binary_big_endian);
    }
  }

  void write_real(double value, bool as_float32)
  {
    // As text, a 32-bit float gets the digits of a double too, because a decimal is read as the double
    // nearest to it.
    if (as_float32 && m_encoding != Encoding::ascii)
      write(static_cast<float>(value));
    else
      write(value);
  }

  void end_element()
  {
    if (m_encoding == Encoding::ascii)
      m_out << '\n';
    m_is_line_begin = true;
  }

private:
  Byte_writer& m_out;
  Encoding m_encoding;
  bool m_is_line_begin = true;
};

template <class Rows>
bool are_float32(const Rows& rows, std::size_t dimension)
{
  return std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
    for (std::size_t i = 0; i < dimension; ++i)
      if (!is_float32(row[static_cast<int>(i)]) && !std::isnan(row[static_cast<int>(i)]))
        return false;
    return true;
  });
}

struct Named_column
{
  std::string name;
  Attribute_component column;
};

/// Whether a property of this name is read back with the same name.
bool is_property_name(const std::string& name)
{
  return name.find_first_of(" \t\r\v\f\n") == std::string::npos && (name.empty() || name.back() != '\\');
}

/// Returns the components of attributes, one property each.
std::vector<Named_column> columns_of(const std::vector<Attribute>& attributes)
{
  std::vector<Named_column> columns;
  for (const Attribute& attribute : attributes)
    for (std::size_t i = 0; i < attribute.components; ++i)
      columns.push_back(
          {attribute.components == 1 ? attribute.name : attribute.name + '_' + std::to_string(i),
           {&attribute, i}});
  return columns;
}

/// Writes attributes as properties of an element that has others of the names `taken`.
void write_properties(Byte_writer& out, const std::vector<Named_column>& columns, std::set<std::string> taken)
{
  for (const auto& [name, column] : columns) {
    if (!is_property_name(name))
      throw Argument_error("the attribute name " + in_quotes(name) +
                           " cannot stand in a PLY file; rename the attribute");
    if (!taken.insert(name).second)
      throw Argument_error("two properties of a PLY file would have the name " + in_quotes(name) +
                           "; rename the attribute");
    out << "property " << ply_type_name(column.attribute->type) << ' ' << name << '\n';
  }
}

void write_properties(Byte_writer& out, bool as_float32, std::initializer_list<std::string_view> names)
{
  for (const std::string_view name : names)
    out << "property " << (as_float32 ? "float " : "double ") << name << '\n';
}

/// Decides which values of a soup a PLY file holds, and whether at vertices or at faces.
struct Ply_layout
{
  explicit Ply_layout(const Triangle_soup& soup)
      : vertex_columns(columns_of(soup.vertex_attributes)),
        face_columns(columns_of(soup.triangle_attributes)), normals(values_of_vertices(soup.normals, soup))
  {
    const auto has = [this](const char* name) {
      return std::any_of(vertex_columns.begin(), vertex_columns.end(),
                         [name](const Named_column& column) { return column.name == name; });
    };
    if (soup.uvs.empty()) {
      // Attributes of these names would be read as texture coordinates if the faces had no list of them.
      has_face_uvs =
          (has("s") && has("t")) || (has("u") && has("v")) || (has("texture_u") && has("texture_v"));
      return;
    }
    has_vertex_uvs = !has("s") && !has("t") && are_numbered_like_vertices(soup.uvs, soup);
    has_face_uvs = !has_vertex_uvs;
  }

  std::vector<Named_column> vertex_columns, face_columns;
  std::vector<std::array<double, 3>> normals; // of vertices
  bool has_vertex_uvs = false, has_face_uvs = false;
};

} // namespace

std::vector<std::array<double, 3>> values_of_vertices(const Corner_values<3>& values,
                                                      const Triangle_soup& soup)
{
  if (values.empty() || values.missing)
    return {};
  if (are_numbered_like_vertices(values, soup))
    return values.values;
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> numbers(soup.points.size(), none);
  std::vector<std::array<double, 3>> result(soup.points.size(), {0, 0, 0});
  for (std::size_t i = 0; i < soup.triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner) {
      const Index vertex = soup.triangles[i][corner], number = values.of_triangle[i][corner];
      const auto& value = values.values[number];
      if (numbers[vertex] == none)
        result[vertex] = value;
      else if (numbers[vertex] != number && std::memcmp(&result[vertex], &value, sizeof value) != 0)
        return {};
      numbers[vertex] = number;
    }
  return result;
}

void write_ply(Byte_writer& out, const Triangle_soup& soup, const Write_options& options)
{
  const Ply_layout layout(soup);
  if (layout.has_face_uvs)
    if (const std::optional<Triangle_soup> split = with_uvs_of_vertices(soup))
      return write_ply(out, *split, options);
  if (layout.normals.empty() && !soup.normals.empty() && !soup.normals.missing)
    return write_ply(out, split_by_normals(soup), options);
  const bool as_float32 = are_float32(soup.points, 3), float32_normals = are_float32(layout.normals, 3),
             float32_uvs = are_float32(soup.uvs.values, 2);
  // Many readers know only signed indices, so these are written while they suffice.
  const bool is_small =
      soup.points.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  out << "ply\nformat "
      << (options.encoding == Encoding::ascii               ? "ascii"
          : options.encoding == Encoding::binary_big_endian ? "binary_big_endian"
                                                            : "binary_little_endian")
      << " 1.0\n";
  for (const std::string& comment : options.comments)
    out << "comment " << comment << '\n';
  for (const std::string& comment : soup.header_comments)
    out << comment << '\n';
  out << "element vertex " << soup.points.size() << '\n';
  std::set<std::string> names{"x", "y", "z"};
  write_properties(out, as_float32, {"x", "y", "z"});
  if (!layout.normals.empty()) {
    write_properties(out, float32_normals, {"nx", "ny", "nz"});
    names.insert({"nx", "ny", "nz"});
  }
  if (layout.has_vertex_uvs) {
    write_properties(out, float32_uvs, {"s", "t"});
    names.insert({"s", "t"});
  }
  write_properties(out, layout.vertex_columns, std::move(names));
  const Written_faces faces(soup, Mesh_format::ply);
  out << "element face " << faces.size() << "\nproperty list uchar " << (is_small ? "int" : "uint")
      << " vertex_indices\n";
  if (layout.has_face_uvs)
    out << "property list uchar " << (float32_uvs ? "float" : "double") << " texcoord\n";
  write_properties(out, layout.face_columns, {"vertex_indices", layout.has_face_uvs ? "texcoord" : ""});
  out << "end_header\n";

  Value_writer values(out, options.encoding);
  const auto write_columns = [&values](const std::vector<Named_column>& columns, std::size_t row) {
    for (const auto& [name, column] : columns)
      column.with(row, [&](auto number) { values.write(number); });
  };
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      values.write_real(soup.points[i][axis], as_float32);
    if (!layout.normals.empty())
      for (const double coordinate : layout.normals[i])
        values.write_real(coordinate, float32_normals);
    if (layout.has_vertex_uvs)
      for (const double coordinate : soup.uvs.values[i])
        values.write_real(coordinate, float32_uvs);
    write_columns(layout.vertex_columns, i);
    values.end_element();
  }
  faces.for_each([&](Index triangle, const std::vector<Index>& corners) {
    values.write(std::uint8_t(corners.size()));
    for (const Index corner : corners)
      values.write(soup.triangles[corner / 3][corner % 3]);
    if (layout.has_face_uvs) {
      const bool has_uvs = soup.uvs.has(triangle);
      values.write(std::uint8_t(has_uvs ? 2 * corners.size() : 0));
      for (const Index corner : corners)
        if (has_uvs)
          for (const double coordinate : soup.uvs.values[soup.uvs.of_triangle[corner / 3][corner % 3]])
            values.write_real(coordinate, float32_uvs);
    }
    write_columns(layout.face_columns, triangle);
    values.end_element();
  });
  out.commit();
}

} // namespace selvedge::files
