// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Ply_header.h"
#include "files/Soup_builder.h"
#include "files/columns.h"
#include "files/formats.h"
#include "files/ply_values.h"

#include <boost/container_hash/hash.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <unordered_map>

// Reads PLY, text and binary: positions, normals, texture coordinates, and all other properties as
// attributes.

namespace selvedge::files {
namespace {

using Type = Attribute::Type;

using Property = Ply_property;
using Element = Ply_element;

class Ply_reader
{
public:
  Ply_reader(std::string_view contents, const std::string& name)
      : m_name(name), m_file_size(contents.size()), m_text(contents, name), m_header(read_ply_header(m_text))
  {
  }

  Mesh_file read()
  {
    m_builder.soup().header_comments = std::move(m_header.comments);
    if (m_header.unknown_lines > 0)
      m_builder.ignore("lines of the header that PLY does not know", m_header.unknown_lines);
    check_elements();
    if (m_header.format == "ascii")
      read_body(Ply_text_values(m_text, is_row_a_line()));
    else
      read_body(Ply_binary_values(m_text.rest(), m_header.format == "binary_big_endian", m_name));
    return m_builder.take(m_name);
  }

private:
  /// Refuses a header without vertices or faces.
  void check_elements() const
  {
    const auto has = [this](const auto& is_wanted) {
      return std::any_of(m_header.elements.begin(), m_header.elements.end(), is_wanted);
    };
    if (!has([](const Element& element) { return element.name == "vertex"; }))
      m_text.fail("the header announces no element 'vertex'; export the file as a mesh");
    if (has(is_of_faces))
      return;
    const std::string announces = "the header announces no element 'face'";
    if (has([](const Element& element) { return find_list(element) != nullptr; }))
      m_text.fail(announces + ", whose list of vertices it has; write 'element face' and the number of faces "
                              "above this list");
    m_text.fail(announces + "; export the file as a mesh");
  }

  static bool is_of_faces(const Element& element) { return element.name == "face" || is_of_strips(element); }

  /// Returns whether the body has a line for each row, as most programs write it. Some write values there
  /// that their header does not announce.
  bool is_row_a_line() const
  {
    std::uint64_t rows = 0;
    for (const Element& element : m_header.elements)
      rows += element.count;
    std::uint64_t lines = 0;
    for (Text_reader text = m_text; lines <= rows && text.to_next_statement(); text.skip_line())
      ++lines;
    return lines == rows;
  }

  template <class Values>
  void end_row(Values& values)
  {
    if (!values.end_row())
      m_builder.ignore("ends of rows, with values that the header does not announce");
  }

  /// Reads the vertices before the faces, whichever come first in the file, because cutting polygons needs
  /// them.
  template <class Values>
  void read_body(Values values)
  {
    std::optional<Values> faces_begin;
    const Element* faces = nullptr;
    bool has_vertices = false, has_faces = false;
    for (const Element& element : m_header.elements) {
      check_count(values, element);
      if (element.name == "vertex" && !has_vertices) {
        read_vertices(values, element);
        has_vertices = true;
      } else if (is_of_faces(element) && faces == nullptr) {
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
    if (!has_faces)
      read_faces(*faces_begin, *faces);
  }

  /// Refuses a number of elements that the rest of the file cannot hold, before memory is reserved for them.
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
  static void check_row(Values& values, const Element& element, std::uint64_t row)
  {
    if (values.at_end())
      values.fail("the file ends after " + std::to_string(row) + " of the " + std::to_string(element.count) +
                  " elements " + in_quotes(element.name) +
                  " that the header announces; it is cut short, copy or export it again");
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
    Cancellation_poll poll;
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      poll();
      check_row(values, element, i);
      for (const Property& property : element.properties)
        skip_property(values, property);
    }
  }

  /// Where the values of a property go: to a number, to an attribute, or, when they are a list, nowhere.
  struct Target
  {
    double* number = nullptr;
    Attribute* attribute = nullptr;
  };

  /// Makes an attribute of every property that has no target yet.
  void add_attributes(const Element& element, std::vector<Target>& targets,
                      std::vector<Attribute>& attributes)
  {
    attributes.reserve(element.properties.size()); // targets point there
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (targets[i].number != nullptr)
        continue;
      if (property.count_type) {
        if (!is_read_list(element, property))
          m_builder.ignore("values of the " + element.name + " property " + in_quotes(property.name),
                           element.count);
        continue;
      }
      const bool is_repeated =
          std::any_of(element.properties.begin(), element.properties.begin() + std::ptrdiff_t(i),
                      [&](const Property& earlier) { return earlier.name == property.name; });
      if (is_repeated) {
        m_builder.ignore("values of a second " + element.name + " property " + in_quotes(property.name),
                         element.count);
        continue;
      }
      if (element.name == "face" && is_of_normal(property)) {
        if (property.name == "nx")
          m_builder.ignore("normals of faces, which their corners tell", element.count);
        continue;
      }
      const bool is_colour = property.name == "red" || property.name == "green" || property.name == "blue" ||
                             property.name == "alpha";
      const bool is_normalized = is_colour && (property.type == Type::uint8 || property.type == Type::uint16);
      attributes.push_back({property.name, property.type, 1, is_normalized, {}});
      attributes.back().rows.reserve(element.count * ply_size_of(property.type));
      targets[i].attribute = &attributes.back();
    }
  }

  static bool is_of_normal(const Property& property)
  {
    return property.name == "nx" || property.name == "ny" || property.name == "nz";
  }

  static bool is_read_list(const Element& element, const Property& property)
  {
    return element.name == "face" && property.count_type &&
           (&property == find_list(element) || &property == find_uv_list(element));
  }

  static const Property* find_list(const Element& element)
  {
    const std::size_t plural = element.find("vertex_indices");
    const std::size_t list = plural != element.properties.size() ? plural : element.find("vertex_index");
    return list == element.properties.size() ? nullptr : &element.properties[list];
  }

  static const Property* find_uv_list(const Element& element)
  {
    const std::size_t list = element.find("texcoord");
    const bool is_one = list != element.properties.size() && element.properties[list].count_type &&
                        !is_integer(element.properties[list].type);
    return is_one ? &element.properties[list] : nullptr;
  }

  /// Whether the element has all of these properties as floating-point numbers, which then go to `numbers`.
  template <std::size_t size>
  static bool find_numbers(const Element& element, const std::array<const char*, size>& names,
                           std::array<double, size>& numbers, std::vector<Target>& targets)
  {
    std::array<std::size_t, size> places;
    for (std::size_t i = 0; i < size; ++i) {
      places[i] = element.find(names[i]);
      if (places[i] == element.properties.size() || element.properties[places[i]].count_type ||
          is_integer(element.properties[places[i]].type))
        return false;
    }
    for (std::size_t i = 0; i < size; ++i)
      targets[places[i]].number = &numbers[i];
    return true;
  }

  template <class Values>
  void read_vertices(Values& values, const Element& element)
  {
    Triangle_soup& soup = m_builder.soup();
    std::vector<Target> targets(element.properties.size());
    std::array<double, 3> position = {}, normal = {};
    std::array<double, 2> uv = {};
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t place = element.find(std::string(1, static_cast<char>('x' + axis)));
      if (place == element.properties.size() || element.properties[place].count_type)
        values.fail("the vertices lack one of the properties x, y, z");
      targets[place].number = &position[axis];
    }
    m_has_normals = find_numbers<3>(element, {"nx", "ny", "nz"}, normal, targets);
    const bool has_face_uvs =
        std::any_of(m_header.elements.begin(), m_header.elements.end(), [](const Element& candidate) {
          return candidate.name == "face" && find_uv_list(candidate) != nullptr;
        });
    m_has_uvs = !has_face_uvs && (find_numbers<2>(element, {"s", "t"}, uv, targets) ||
                                  find_numbers<2>(element, {"u", "v"}, uv, targets) ||
                                  find_numbers<2>(element, {"texture_u", "texture_v"}, uv, targets));
    add_attributes(element, targets, soup.vertex_attributes);

    const auto fail = [&values](const std::string& message) { values.fail(message); };
    soup.points.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      check_row(values, element, i);
      for (std::size_t p = 0; p < targets.size(); ++p)
        read_property(values, element.properties[p], targets[p]);
      m_builder.add_point(position[0], position[1], position[2], 0, fail);
      if (m_has_normals)
        m_normals.push_back(normal);
      if (m_has_uvs) {
        check_uv(values, uv, "vertex " + std::to_string(i));
        m_uvs.push_back(uv);
      }
      end_row(values);
    }
  }

  template <class Values>
  static void read_property(Values& values, const Property& property, const Target& target)
  {
    if (target.number != nullptr)
      *target.number = values.real(property.type);
    else if (target.attribute != nullptr)
      values.append(property.type, target.attribute->rows);
    else
      skip_property(values, property);
  }

  template <class Values>
  static void check_uv(const Values& values, const std::array<double, 2>& uv, const std::string& where)
  {
    if (!std::isfinite(uv[0]) || !std::isfinite(uv[1]))
      values.fail(where + " has a texture coordinate that is not finite; remove or repair it");
  }

  template <class Values>
  void read_faces(Values& values, const Element& element)
  {
    const Property* const list = find_list(element);
    if (list == nullptr || !list->count_type || !is_integer(list->type))
      values.fail("the faces lack a list of integers 'vertex_indices'; export the file as a mesh");
    if (is_of_strips(element))
      read_strips(values, element, *list);
    else
      read_polygons(values, element, *list);
    Triangle_soup& soup = m_builder.soup();
    if (m_has_normals)
      m_builder.set_vertex_values(soup.normals, std::move(m_normals));
    if (m_has_uvs)
      m_builder.set_vertex_values(soup.uvs, std::move(m_uvs));
  }

  static bool is_of_strips(const Element& element) { return element.name == "tristrips"; }

  /// Reads strips of triangles. Each three numbers in a row are a triangle, and every second one is turned
  /// over; −1 begins another strip. Repeated numbers only lead from one strip to the next.
  template <class Values>
  void read_strips(Values& values, const Element& element, const Property& list)
  {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      check_row(values, element, i);
      for (const Property& property : element.properties) {
        if (&property != &list) {
          skip_property(values, property);
          continue;
        }
        std::size_t in_strip = 0;
        Index before = 0, last = 0;
        for (std::uint64_t left = read_length(values, list); left > 0; --left) {
          const std::int64_t index = values.integer(list.type);
          if (index == -1 || index == std::numeric_limits<std::uint32_t>::max()) {
            in_strip = 0;
            continue;
          }
          const Index corner = checked_vertex(values, index, "a triangle strip");
          const bool is_triangle = ++in_strip > 2 && before != last && last != corner && corner != before;
          if (is_triangle && in_strip % 2 == 1)
            m_builder.add_face({before, last, corner});
          else if (is_triangle)
            m_builder.add_face({last, before, corner});
          before = std::exchange(last, corner);
        }
      }
    }
  }

  template <class Values>
  void read_polygons(Values& values, const Element& element, const Property& list)
  {
    const Property* const uv_list = find_uv_list(element);
    Triangle_soup& soup = m_builder.soup();
    std::vector<Target> targets(element.properties.size());
    add_attributes(element, targets, soup.triangle_attributes);
    soup.triangles.reserve(element.count);
    std::vector<Index> corners, uv_corners;
    std::vector<double> uvs;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      check_row(values, element, i);
      for (std::size_t p = 0; p < targets.size(); ++p) {
        const Property& property = element.properties[p];
        if (&property == &list)
          read_corners(values, property, i, corners);
        else if (&property == uv_list)
          read_numbers(values, property, uvs);
        else
          read_property(values, property, targets[p]);
      }
      end_row(values);
      number_uvs(values, uvs, corners, i, uv_corners);
      repeat_last_rows(values, m_builder.add_face(corners, uv_corners));
    }
  }

  template <class Values>
  void read_corners(Values& values, const Property& list, std::uint64_t face, std::vector<Index>& corners)
  {
    corners.resize(read_length(values, list));
    for (Index& corner : corners)
      corner = checked_vertex(values, values.integer(list.type), "face ", face);
  }

  /// Returns the number of a vertex, or refuses it for the sake of what names it.
  template <class Values>
  Index checked_vertex(const Values& values, std::int64_t index, const char* what,
                       std::optional<std::uint64_t> number = {})
  {
    const std::size_t vertices = m_builder.soup().points.size();
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
      values.fail(what + (number ? std::to_string(*number) : "") + " names vertex " + std::to_string(index) +
                  ", but there are only " + std::to_string(vertices) +
                  " counted from 0; correct or remove it");
    return static_cast<Index>(index);
  }

  template <class Values>
  static void read_numbers(Values& values, const Property& list, std::vector<double>& numbers)
  {
    numbers.resize(read_length(values, list));
    for (double& number : numbers)
      number = values.real(list.type);
  }

  static constexpr Index s_none = Index(-1);

  using Uv_bits = std::array<std::uint64_t, 2>;
  struct Hash_of_bits
  {
    std::size_t operator()(const Uv_bits& bits) const { return boost::hash_range(bits.begin(), bits.end()); }
  };
  static Uv_bits bits_of(const std::array<double, 2>& uv)
  {
    Uv_bits bits;
    std::memcpy(bits.data(), uv.data(), sizeof bits);
    return bits;
  }

  /// Numbers the texture coordinates of a face's corners; equal ones get the number of the first of them.
  template <class Values>
  void number_uvs(const Values& values, const std::vector<double>& uvs, const std::vector<Index>& corners,
                  std::uint64_t face, std::vector<Index>& numbers)
  {
    numbers.clear();
    if (uvs.size() != 2 * corners.size()) {
      if (!uvs.empty())
        m_builder.ignore("texture coordinates of faces, not two to a corner");
      return;
    }
    auto& known = m_builder.soup().uvs.values;
    m_last_uv_at.resize(m_builder.soup().points.size(), s_none);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::array<double, 2> uv = {uvs[2 * i], uvs[2 * i + 1]};
      check_uv(values, uv, "face " + std::to_string(face));
      if (known.size() + 1 >= std::numeric_limits<Index>::max())
        values.fail("the mesh has more than 4294967293 texture coordinates; split it");
      // Most corners have the same as another one at their vertex.
      Index& number = m_last_uv_at[corners[i]];
      if (number == s_none || bits_of(known[number]) != bits_of(uv)) {
        const auto [place, is_new] = m_uv_numbers.emplace(bits_of(uv), static_cast<Index>(known.size()));
        if (is_new)
          known.push_back(uv);
        number = place->second;
      }
      numbers.push_back(number);
    }
  }

  /// Repeats the row that a face has added to each attribute for each of its triangles. The rows of a polygon
  /// with many corners and many attributes may be far larger than the file, so their size is limited.
  template <class Values>
  void repeat_last_rows(const Values& values, std::size_t triangles)
  {
    constexpr std::size_t most_for_a_byte = 64;
    for (const Attribute& attribute : m_builder.soup().triangle_attributes)
      m_repeated_bytes += triangles * ply_size_of(attribute.type);
    if (m_repeated_bytes / most_for_a_byte > m_file_size)
      values.fail(
          "the attributes of the polygons take more than 64 times the size of the file when these are cut "
          "into triangles; cut them before");
    for (Attribute& attribute : m_builder.soup().triangle_attributes) {
      const std::size_t size = ply_size_of(attribute.type);
      attribute.rows.resize(attribute.rows.size() - (triangles == 0 ? size : 0));
      for (std::size_t i = 1; i < triangles; ++i) {
        attribute.rows.resize(attribute.rows.size() + size);
        std::copy(attribute.rows.end() - 2 * static_cast<std::ptrdiff_t>(size),
                  attribute.rows.end() - static_cast<std::ptrdiff_t>(size),
                  attribute.rows.end() - static_cast<std::ptrdiff_t>(size));
      }
    }
  }

  const std::string& m_name;
  std::size_t m_file_size;
  Text_reader m_text;
  Ply_header m_header;
  Soup_builder m_builder{Mesh_format::ply};
  bool m_has_normals = false, m_has_uvs = false; // at vertices
  std::vector<std::array<double, 3>> m_normals;
  std::vector<std::array<double, 2>> m_uvs;
  std::unordered_map<Uv_bits, Index, Hash_of_bits> m_uv_numbers;
  std::vector<Index> m_last_uv_at;  // by vertex: the number of the last one read
  std::size_t m_repeated_bytes = 0; // of attributes of triangles
};

/// Does for PLY what `with_line_feeds` does for a text. The body stays as it is when it is binary.
std::string_view with_line_feeds_in_header(std::string_view contents, std::string& copy)
{
  constexpr std::string_view begin = "ply\r", end = "\rend_header\r";
  const std::size_t place = contents.substr(0, begin.size()) == begin ? contents.find(end) : contents.npos;
  if (place == contents.npos)
    return contents;
  const std::string_view header = contents.substr(0, place + end.size());
  if (header.find('\n') != header.npos)
    return contents;
  const bool is_text = header.find("\rformat ascii") != header.npos;
  copy = contents;
  std::replace(copy.begin(), is_text ? copy.end() : copy.begin() + std::ptrdiff_t(header.size()), '\r', '\n');
  return copy;
}

} // namespace

Mesh_file read_ply(std::string_view contents, const std::string& name)
{
  std::string copy;
  return Ply_reader(with_line_feeds_in_header(contents, copy), name).read();
}

} // namespace selvedge::files
