// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Binary_reader.h"
#include "files/Soup_builder.h"
#include "files/Text_reader.h"
#include "files/formats.h"

#include <selvedge/mesh/rounding.h>

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>

namespace selvedge::files {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(Type type)
{
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

bool is_integer(Type type)
{
  return type != Type::float32 && type != Type::float64;
}

struct Property
{
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count_type; // of a list
};

struct Element
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  std::size_t find(std::string_view property) const
  {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const Property& candidate) { return candidate.name == property; });
    return static_cast<std::size_t>(found - properties.begin());
  }
};

/// The values of a binary body, one after the other. Every function throws when the file ends before the
/// value.
class Binary_values
{
public:
  Binary_values(std::string_view body, bool big_endian, const std::string& name)
      : m_data(body, big_endian), m_name(&name)
  {
  }

  static std::size_t least_bytes(Type type) { return size_of(type); }
  std::size_t remaining() const { return m_data.remaining(); }

  double real(Type type)
  {
    check(size_of(type));
    switch (type) {
    case Type::float32:
      return m_data.take<float>();
    case Type::float64:
      return m_data.take<double>();
    default:
      return static_cast<double>(integer(type));
    }
  }

  std::int64_t integer(Type type)
  {
    check(size_of(type));
    switch (type) {
    case Type::int8:
      return m_data.take<std::int8_t>();
    case Type::uint8:
      return m_data.take<std::uint8_t>();
    case Type::int16:
      return m_data.take<std::int16_t>();
    case Type::uint16:
      return m_data.take<std::uint16_t>();
    case Type::int32:
      return m_data.take<std::int32_t>();
    default:
      return m_data.take<std::uint32_t>();
    }
  }

  void skip(Type type, std::uint64_t count)
  {
    check(count * size_of(type)); // a list's count has at most 32 bits
    m_data.skip(count * size_of(type));
  }

  [[noreturn]] void fail(const std::string& message) const { throw Input_error(*m_name + ": " + message); }

private:
  void check(std::uint64_t bytes) const
  {
    if (bytes > m_data.remaining())
      fail("the file ends before its last element; it is cut short");
  }

  Binary_reader m_data;
  const std::string* m_name;
};

/// The values of an ascii body.
class Text_values
{
public:
  explicit Text_values(const Text_reader& text) : m_text(text) {}

  static std::size_t least_bytes(Type) { return 2; }
  std::size_t remaining() const { return m_text.remaining() + 1; } // the last value needs no blank after it

  double real(Type)
  {
    m_text.skip_space();
    return m_text.real();
  }

  std::int64_t integer(Type)
  {
    m_text.skip_space();
    return m_text.integer();
  }

  void skip(Type, std::uint64_t count)
  {
    for (; count != 0; --count) {
      m_text.skip_space();
      if (m_text.word().empty())
        fail("a value is missing; the file is damaged or cut short");
    }
  }

  [[noreturn]] void fail(const std::string& message) const { m_text.fail(message); }

private:
  Text_reader m_text;
};

class Ply_reader
{
public:
  Ply_reader(std::string_view contents, const std::string& name) : m_name(name), m_text(contents, name) {}

  Mesh_file read()
  {
    read_header();
    if (m_format == "ascii")
      read_body(Text_values(m_text));
    else
      read_body(Binary_values(m_text.rest(), m_format == "binary_big_endian", m_name));
    return m_builder.take(m_name);
  }

private:
  void read_header()
  {
    if (m_text.line() != "ply")
      m_text.fail("the first line is not 'ply'; the file is no PLY file");
    for (;;) {
      next_line();
      if (m_text.at_end())
        m_text.fail("the file ends within its header; it is cut short");
      const std::string_view keyword = m_text.word();
      if (keyword == "end_header") {
        next_line();
        break;
      }
      if (keyword == "format")
        read_format();
      else if (keyword == "element")
        read_element();
      else if (keyword == "property")
        read_property();
      else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty())
        m_text.fail("the header has an unknown statement " + in_quotes(keyword) + "; remove it");
    }
    if (m_format.empty())
      m_text.fail("the header names no format; the file is damaged");
  }

  void next_line()
  {
    m_text.line();
    if (m_text.at_end())
      m_text.fail("the file ends within its header; it is cut short");
    m_text.advance(1);
  }

  void read_format()
  {
    m_format = m_text.word();
    if (m_format != "ascii" && m_format != "binary_little_endian" && m_format != "binary_big_endian")
      m_text.fail("the format " + in_quotes(m_format) +
                  " is none of ascii, binary_little_endian, binary_big_endian");
  }

  void read_element()
  {
    Element element;
    element.name = m_text.word();
    const std::int64_t count = m_text.integer();
    if (count < 0)
      m_text.fail("the element " + in_quotes(element.name) + " has a negative count");
    element.count = static_cast<std::uint64_t>(count);
    m_elements.push_back(std::move(element));
  }

  void read_property()
  {
    if (m_elements.empty())
      m_text.fail("a property stands before the first element; the header is damaged");
    Property property;
    std::string_view type = m_text.word();
    if (type == "list") {
      property.count_type = read_type(m_text.word());
      if (!is_integer(*property.count_type))
        m_text.fail("the lengths of a list are no integers; the header is damaged");
      type = m_text.word();
    }
    property.type = read_type(type);
    property.name = m_text.word();
    m_elements.back().properties.push_back(std::move(property));
  }

  Type read_type(std::string_view name) const
  {
    static const std::unordered_map<std::string_view, Type> types = {
        {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
        {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
        {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
        {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
        {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
        {"float64", Type::float64}};
    const auto found = types.find(name);
    if (found == types.end())
      m_text.fail("the header has an unknown type " + in_quotes(name) + "; convert the file");
    return found->second;
  }

  /// Reads the vertices first, wherever they stand: cutting polygons needs them.
  template <class Values>
  void read_body(Values values)
  {
    std::optional<Values> faces_begin;
    const Element* faces = nullptr;
    bool has_vertices = false, has_faces = false;
    for (const Element& element : m_elements) {
      check_count(values, element);
      if (element.name == "vertex" && !has_vertices) {
        read_vertices(values, element);
        has_vertices = true;
      } else if (element.name == "face" && faces == nullptr) {
        faces = &element;
        faces_begin = values;
        has_faces = has_vertices;
        if (has_faces)
          read_faces(values, element);
        else
          skip_element(values, element);
      } else {
        m_builder.ignore("elements " + in_quotes(element.name), element.count);
        skip_element(values, element);
      }
    }
    if (!has_vertices)
      values.fail("the header announces no element 'vertex'; export the file as a mesh");
    if (faces == nullptr) {
      const bool strips = std::any_of(m_elements.begin(), m_elements.end(),
                                      [](const Element& element) { return element.name == "tristrips"; });
      values.fail(
          strips ? "the faces are triangle strips, which are not read; export the file as a list of faces"
                 : "the header announces no element 'face'; export the file as a mesh");
    }
    if (!has_faces)
      read_faces(*faces_begin, *faces);
  }

  /// Nothing is believed of a count before the bytes are there.
  template <class Values>
  void check_count(const Values& values, const Element& element) const
  {
    std::uint64_t least = 0;
    for (const Property& property : element.properties)
      least += Values::least_bytes(property.count_type.value_or(property.type));
    if (least != 0 && element.count > values.remaining() / least)
      values.fail("the header announces " + std::to_string(element.count) + " elements " +
                  in_quotes(element.name) + ", which the file cannot hold; it is damaged or cut short");
  }

  template <class Values>
  static void skip_property(Values& values, const Property& property)
  {
    if (property.count_type)
      values.skip(property.type, read_length(values, property));
    else
      values.skip(property.type, 1);
  }

  template <class Values>
  static std::uint64_t read_length(Values& values, const Property& property)
  {
    const std::int64_t length = values.integer(*property.count_type);
    if (length < 0 ||
        static_cast<std::uint64_t>(length) > values.remaining() / Values::least_bytes(property.type))
      values.fail("a list " + in_quotes(property.name) + " has a length of " + std::to_string(length) +
                  ", which the file cannot hold; it is damaged or cut short");
    return static_cast<std::uint64_t>(length);
  }

  template <class Values>
  static void skip_element(Values& values, const Element& element)
  {
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
      for (const Property& property : element.properties)
        skip_property(values, property);
  }

  template <class Values>
  void read_vertices(Values& values, const Element& element)
  {
    const std::array<std::size_t, 3> axes = {element.find("x"), element.find("y"), element.find("z")};
    for (const std::size_t axis : axes)
      if (axis == element.properties.size() || element.properties[axis].count_type)
        values.fail("the vertices lack one of the properties x, y, z");
    const auto fail = [&values](const std::string& message) { values.fail(message); };
    m_builder.soup().points.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      std::array<double, 3> position = {};
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const auto axis = std::find(axes.begin(), axes.end(), p);
        if (axis != axes.end())
          position[static_cast<std::size_t>(axis - axes.begin())] = values.real(element.properties[p].type);
        else
          skip_property(values, element.properties[p]);
      }
      m_builder.add_point(position[0], position[1], position[2], 0, fail);
    }
    for (std::size_t p = 0; p < element.properties.size(); ++p)
      if (std::find(axes.begin(), axes.end(), p) == axes.end())
        m_builder.ignore("values of the vertex property " + in_quotes(element.properties[p].name),
                         element.count);
  }

  template <class Values>
  void read_faces(Values& values, const Element& element)
  {
    const std::size_t plural = element.find("vertex_indices");
    const std::size_t list = plural != element.properties.size() ? plural : element.find("vertex_index");
    if (list == element.properties.size() || !element.properties[list].count_type ||
        !is_integer(element.properties[list].type))
      values.fail("the faces lack a list of integers 'vertex_indices'; export the file as a mesh");
    const std::size_t vertices = m_builder.soup().points.size();
    m_builder.soup().triangles.reserve(element.count);
    std::vector<Index> corners;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (p != list) {
          skip_property(values, property);
          continue;
        }
        corners.resize(read_length(values, property));
        for (Index& corner : corners) {
          const std::int64_t index = values.integer(property.type);
          if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
            values.fail("face " + std::to_string(i) + " names vertex " + std::to_string(index) +
                        ", but there are only " + std::to_string(vertices) +
                        " counted from 0; correct or remove the face");
          corner = static_cast<Index>(index);
        }
      }
      m_builder.add_face(corners);
    }
    for (std::size_t p = 0; p < element.properties.size(); ++p)
      if (p != list)
        m_builder.ignore("values of the face property " + in_quotes(element.properties[p].name),
                         element.count);
  }

  const std::string& m_name;
  Text_reader m_text;
  Soup_builder m_builder{Mesh_format::ply};
  std::string_view m_format;
  std::vector<Element> m_elements;
};

void write_ascii(Byte_writer& out, const Triangle_soup& soup)
{
  for (const Point_3& p : soup.points)
    out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& [a, b, c] : soup.triangles)
    out << "3 " << a << ' ' << b << ' ' << c << '\n';
}

void write_binary(Byte_writer& out, const Triangle_soup& soup, bool as_float32, bool big_endian)
{
  for (const Point_3& point : soup.points)
    for (int axis = 0; axis < 3; ++axis)
      if (as_float32)
        out.binary(static_cast<float>(point[axis]), big_endian);
      else
        out.binary(point[axis], big_endian);
  for (const Index_triple& triangle : soup.triangles) {
    out << char{3};
    for (const Index corner : triangle)
      out.binary(corner, big_endian);
  }
}

} // namespace

Mesh_file read_ply(std::string_view contents, const std::string& name)
{
  return Ply_reader(contents, name).read();
}

void write_ply(Byte_writer& out, const Triangle_soup& soup, const Write_options& options)
{
  const bool as_float32 = std::all_of(soup.points.begin(), soup.points.end(), [](const Point_3& p) {
    return is_float32(p.x()) && is_float32(p.y()) && is_float32(p.z());
  });
  const bool big_endian = options.encoding == Encoding::binary_big_endian;
  const bool ascii = options.encoding == Encoding::ascii;
  // Many readers know only signed indices.
  const bool is_small =
      soup.points.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  out << "ply\nformat "
      << (ascii        ? "ascii"
          : big_endian ? "binary_big_endian"
                       : "binary_little_endian")
      << " 1.0\n";
  for (const std::string& comment : options.comments)
    out << "comment " << comment << '\n';
  out << "element vertex " << soup.points.size() << '\n';
  for (const char axis : {'x', 'y', 'z'})
    out << "property " << (as_float32 ? "float " : "double ") << axis << '\n';
  out << "element face " << soup.triangles.size() << "\nproperty list uchar " << (is_small ? "int" : "uint")
      << " vertex_indices\nend_header\n";
  if (ascii)
    write_ascii(out, soup);
  else
    write_binary(out, soup, as_float32, big_endian);
  out.commit();
}

} // namespace selvedge::files
