// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Binary_reader.h"
#include "files/Soup_builder.h"
#include "files/Text_reader.h"
#include "files/formats.h"

// Reads and writes STL, text and binary: facets without vertex numbers, so that equal positions become one
// vertex.

namespace selvedge::files {
namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

/// Numbers positions in the order in which they first occur; −0 is 0. It is a hash table of vertex numbers
/// with open addressing.
class Position_numbers
{
public:
  explicit Position_numbers(std::vector<Point_3>& points) : m_points(points), m_slots(1024, free_slot) {}

  /// Returns the number of this position if it has occurred, else `m_points.size()`: the caller then adds it
  /// there.
  Index find_or_reserve(const Point_3& point)
  {
    if (2 * m_points.size() >= m_slots.size())
      grow();
    Index& slot = m_slots[slot_of(point)];
    if (slot == free_slot)
      slot = static_cast<Index>(m_points.size());
    return slot;
  }

private:
  static constexpr Index free_slot = std::numeric_limits<Index>::max();

  std::size_t slot_of(const Point_3& point) const
  {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate = point[axis] + 0.0; // makes −0 the same as 0
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (m_slots.size() - 1);
    while (m_slots[slot] != free_slot && m_points[m_slots[slot]] != point)
      slot = (slot + 1) & (m_slots.size() - 1);
    return slot;
  }

  void grow()
  {
    m_slots.assign(2 * m_slots.size(), free_slot);
    for (Index i = 0; i < m_points.size(); ++i)
      m_slots[slot_of(m_points[i])] = i;
  }

  std::vector<Point_3>& m_points;
  std::vector<Index> m_slots;
};

class Stl_reader
{
public:
  explicit Stl_reader(std::string_view contents, const std::string& name) : m_contents(contents), m_name(name)
  {
  }

  Mesh_file read()
  {
    // Some binary files begin with "solid" too; their size, which follows from the number of facets, shows
    // it.
    const std::uint64_t facets =
        m_contents.size() < header_bytes
            ? 0
            : Binary_reader(m_contents.substr(header_bytes - 4), false).take<std::uint32_t>();
    const std::uint64_t bytes = header_bytes + facets * facet_bytes;
    Text_reader text(m_contents, m_name);
    text.skip_space();
    const bool says_solid = text.rest().substr(0, 5) == "solid";
    if (m_contents.size() == bytes || !says_solid) {
      read_binary(facets, bytes);
    } else {
      std::string copy;
      text = Text_reader(with_line_feeds(m_contents, copy), m_name);
      read_ascii(text);
    }
    return m_builder.take(m_name);
  }

private:
  void read_binary(std::uint64_t facets, std::uint64_t bytes)
  {
    if (m_contents.size() < header_bytes)
      throw Input_error(m_name + ": the file is too short for an STL file; export it again");
    if (m_contents.size() < bytes)
      throw Input_error(m_name + ": the header announces " + std::to_string(facets) +
                        " facets, but the file ends after " +
                        std::to_string((m_contents.size() - header_bytes) / facet_bytes) +
                        "; it is cut short, or no STL file");
    Binary_reader data(m_contents.substr(header_bytes), false);
    m_builder.soup().triangles.reserve(facets);
    for (std::uint64_t facet = 0; facet < facets; ++facet) {
      const auto fail = [&](const std::string& message) {
        throw Input_error(m_name + ": facet " + std::to_string(facet) + ": " + message);
      };
      data.skip(3 * sizeof(float));
      for (Index& corner : m_corners) {
        const double x = data.take<float>(), y = data.take<float>(), z = data.take<float>();
        corner = number_corner(x, y, z, fail);
      }
      m_builder.add_face(m_corners);
      if (data.take<std::uint16_t>() != 0)
        m_builder.ignore("attributes of facets (colours)");
    }
    if (m_contents.size() != bytes)
      m_builder.ignore("bytes after the last facet", m_contents.size() - bytes);
  }

  void read_ascii(Text_reader& text)
  {
    const auto fail = [&text](const std::string& message) { text.fail(message); };
    const auto expect = [&](std::string_view keyword) {
      text.skip_space();
      const Text_reader start = text;
      const std::string_view word = text.word();
      if (word != keyword)
        start.fail((start.at_end() ? "the file ends" : in_quotes(word) + " stands") + " where '" +
                   std::string(keyword) + "' should; the file is damaged or cut short");
    };
    while (!text.at_end()) {
      expect("solid");
      if (!text.line().empty())
        m_builder.ignore("names of solids");
      for (;;) {
        text.skip_space();
        if (text.rest().substr(0, 8) == "endsolid")
          break;
        expect("facet");
        expect("normal");
        text.line();
        expect("outer");
        expect("loop");
        for (Index& corner : m_corners) {
          expect("vertex");
          const double x = text.real(), y = text.real(), z = text.real();
          corner = number_corner(x, y, z, fail);
        }
        expect("endloop");
        expect("endfacet");
        m_builder.add_face(m_corners);
      }
      text.line();
      text.skip_space();
    }
  }

  template <class Fail>
  Index number_corner(double x, double y, double z, const Fail& fail)
  {
    std::vector<Point_3>& points = m_builder.soup().points;
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      fail("a corner has a coordinate that is not finite; remove or repair it");
    const Index number = m_numbers.find_or_reserve(Point_3(x, y, z));
    if (number == points.size())
      m_builder.add_point(x, y, z, 0, fail);
    return number;
  }

  std::string_view m_contents;
  const std::string& m_name;
  Soup_builder m_builder{Mesh_format::stl};
  Position_numbers m_numbers{m_builder.soup().points};
  std::vector<Index> m_corners = {0, 0, 0};
};

/// Returns the unit normal; zero where the triangle has none. Coordinates are floats, so no double on the way
/// overflows.
std::array<float, 3> unit_normal(const Point_3& a, const Point_3& b, const Point_3& c)
{
  const Kernel::Vector_3 normal = CGAL::cross_product(b - a, c - a);
  const double length = std::sqrt(normal.squared_length());
  if (length == 0)
    return {0, 0, 0};
  return {static_cast<float>(normal.x() / length), static_cast<float>(normal.y() / length),
          static_cast<float>(normal.z() / length)};
}

void write_binary(Byte_writer& out, const Triangle_soup& soup)
{
  if (soup.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw Argument_error(
        "a binary STL file cannot hold more than 4294967295 triangles; write another format");
  std::string header = "binary STL";
  header.resize(header_bytes - 4, ' ');
  out << header;
  out.binary(static_cast<std::uint32_t>(soup.triangles.size()));
  for (const auto& [a, b, c] : soup.triangles) {
    for (const float coordinate : unit_normal(soup.points[a], soup.points[b], soup.points[c]))
      out.binary(coordinate);
    for (const Index corner : {a, b, c})
      for (int axis = 0; axis < 3; ++axis)
        out.binary(static_cast<float>(soup.points[corner][axis]));
    out.binary(std::uint16_t{0});
  }
}

void write_ascii(Byte_writer& out, const Triangle_soup& soup)
{
  out << "solid\n";
  for (const auto& [a, b, c] : soup.triangles) {
    const std::array<float, 3> normal = unit_normal(soup.points[a], soup.points[b], soup.points[c]);
    out << "facet normal " << normal[0] << ' ' << normal[1] << ' ' << normal[2] << "\nouter loop\n";
    for (const Index corner : {a, b, c}) {
      const Point_3& p = soup.points[corner];
      out << "vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid\n";
}

} // namespace

Mesh_file read_stl(std::string_view contents, const std::string& name)
{
  return Stl_reader(contents, name).read();
}

void write_stl(Byte_writer& out, const Triangle_soup& soup, const Write_options& options)
{
  if (options.encoding == Encoding::binary_big_endian)
    throw Argument_error("STL has no big-endian form; choose the binary or the ascii one");
  if (options.encoding == Encoding::ascii)
    write_ascii(out, soup);
  else
    write_binary(out, soup);
  out.commit();
}

} // namespace selvedge::files
