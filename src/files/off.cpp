// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Soup_builder.h"
#include "files/Text_reader.h"
#include "files/Written_faces.h"
#include "files/formats.h"

// Reads and writes OFF: points and triangles alone.

namespace selvedge::files {
namespace {

/// Whether the next word holds a letter, as keywords do and counts do not.
bool at_keyword(Text_reader text)
{
  const std::string_view word = text.word();
  return std::any_of(word.begin(), word.end(),
                     [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); });
}

/// Reads a count. Refuses it when the rest of the file is too short for so many elements of `least_bytes`
/// each.
std::size_t read_count(Text_reader& text, const std::string& kind, std::size_t least_bytes)
{
  const std::int64_t count = text.integer();
  if (count < 0 || static_cast<std::uint64_t>(count) > (text.remaining() + 1) / least_bytes)
    text.fail("the header announces " + std::to_string(count) + " " + kind +
              ", which the file cannot hold; it is damaged or cut short");
  return static_cast<std::size_t>(count);
}

} // namespace

Mesh_file read_off(std::string_view contents, const std::string& name)
{
  Soup_builder builder(Mesh_format::off);
  std::string copy;
  Text_reader text(with_line_feeds(contents, copy), name);
  const auto fail = [&text](const std::string& message) { text.fail(message); };
  const auto to_line_of = [&](const std::string& kind, std::size_t number, std::size_t count) {
    text.skip_line();
    if (!text.to_next_statement())
      fail("the file ends before " + kind + " " + std::to_string(number) + " of " + std::to_string(count) +
           "; it is cut short");
  };

  // The keyword may be missing. Its prefixes announce further columns, which are noted where they stand and
  // not carried.
  if (!text.to_next_statement())
    fail("the file has no header; an OFF file begins with OFF");
  if (at_keyword(text)) {
    const std::string_view keyword = text.word();
    if (keyword != "OFF" && keyword != "COFF" && keyword != "NOFF" && keyword != "CNOFF" &&
        keyword != "STOFF" && keyword != "STCOFF" && keyword != "STNOFF" && keyword != "STCNOFF")
      fail("the header is " + in_quotes(keyword) + ", not that of an OFF file with three coordinates");
    if (!text.to_next_statement())
      fail("the file ends after its header; it is cut short");
    if (at_keyword(text))
      fail("the header continues with " + in_quotes(text.word()) + "; only text is read, convert the file");
  }
  const std::size_t vertices = read_count(text, "vertices", 6);
  const std::size_t faces = read_count(text, "faces", 2);

  builder.soup().points.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    to_line_of("vertex", i, vertices);
    const double x = text.real(), y = text.real(), z = text.real();
    builder.add_point(x, y, z, 0, fail);
    if (!text.at_line_end())
      builder.ignore("further columns of vertices (normals, colours, texture coordinates)");
  }
  builder.soup().triangles.reserve(faces);
  std::vector<Index> corners;
  for (std::size_t i = 0; i < faces; ++i) {
    to_line_of("face", i, faces);
    const std::size_t size = read_count(text, "corners of a face", 2);
    corners.clear();
    for (std::size_t corner = 0; corner < size; ++corner) {
      if (text.at_line_end())
        text.to_next_statement(); // some programs break the lines of a face
      const std::int64_t index = text.integer();
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
        fail("face " + std::to_string(i) + " names vertex " + std::to_string(index) +
             ", but the vertices are 0 to " + std::to_string(static_cast<std::int64_t>(vertices) - 1) +
             "; correct or remove the face");
      corners.push_back(static_cast<Index>(index));
    }
    builder.add_face(corners);
    if (!text.at_line_end())
      builder.ignore("further columns of faces (colours)");
  }
  text.skip_line();
  for (; text.to_next_statement(); text.skip_line())
    builder.ignore("lines after the last face");
  return builder.take(name);
}

void write_off(Byte_writer& out, const Triangle_soup& soup, const Write_options& options)
{
  out << "OFF\n";
  for (const std::string& comment : options.comments)
    out << "# " << comment << '\n';
  const Written_faces faces(soup, Mesh_format::off);
  out << soup.points.size() << ' ' << faces.size() << " 0\n";
  for (const Point_3& p : soup.points)
    out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  faces.for_each([&](Index, const std::vector<Index>& corners) {
    out << corners.size();
    for (const Index corner : corners)
      out << ' ' << soup.triangles[corner / 3][corner % 3];
    out << '\n';
  });
  out.commit();
}

} // namespace selvedge::files
