// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Soup_builder.h"
#include "files/Text_reader.h"
#include "files/formats.h"

#include <algorithm>
#include <set>
#include <unordered_map>

namespace selvedge::files {
namespace {

constexpr std::string_view default_group = "default";

/// Reads the text twice: first the vertices, then the faces, which need all vertices for cutting polygons.
class Obj_reader
{
public:
  Obj_reader(std::string_view contents, const std::string& name) : m_contents(contents), m_name(name) {}

  Mesh_file read()
  {
    for (Text_reader text(m_contents, m_name); text.to_next_statement(); text.skip_line())
      read_vertex_statement(text);
    for (Text_reader text(m_contents, m_name); text.to_next_statement(); text.skip_line())
      read_face_statement(text);
    close_uvs();
    if (m_label_is_new)
      m_builder.ignore("groups and objects without faces");
    return m_builder.take(m_name);
  }

private:
  void read_vertex_statement(Text_reader& text)
  {
    const std::string_view keyword = text.word();
    const auto fail = [&text](const std::string& message) { text.fail(message); };
    if (keyword == "v") {
      const double x = text.real(), y = text.real(), z = text.real();
      m_builder.add_point(x, y, z, 1, fail);
      if (!text.at_line_end())
        note_further_columns(text);
    } else if (keyword == "vt") {
      auto& uvs = m_builder.soup().uvs.values;
      const double u = text.real(), v = text.at_line_end() ? 0 : text.real();
      if (!std::isfinite(u) || !std::isfinite(v))
        fail("texture coordinate " + std::to_string(uvs.size() + 1) + " is not finite; remove or repair it");
      if (uvs.size() == std::numeric_limits<Index>::max())
        fail("the mesh has more than 4294967295 texture coordinates; split it");
      uvs.push_back({u, v});
      if (!text.at_line_end() && text.real() != 0)
        m_builder.ignore("third texture coordinates");
    }
  }

  void note_further_columns(Text_reader text)
  {
    std::size_t columns = 0;
    for (; !text.at_line_end(); ++columns)
      text.word();
    m_builder.ignore(columns == 1                   ? "vertex weights"
                     : columns == 3 || columns == 4 ? "vertex colours"
                                                    : "vertex columns");
  }

  void read_face_statement(Text_reader& text)
  {
    const std::string_view keyword = text.word();
    if (keyword == "v")
      ++m_points_above;
    else if (keyword == "f")
      read_face(text);
    else if (keyword == "vt")
      ++m_uvs_above;
    else if (keyword == "g" || keyword == "o")
      start_group(Text_reader(text).line()); // skip_line must see whether the line is continued
    else
      ignore_statement(keyword);
  }

  void read_face(Text_reader& text)
  {
    m_corners.clear();
    m_uv_corners.clear();
    bool has_normals = false;
    while (!text.at_line_end()) {
      m_corners.push_back(read_index(text, "vertex", m_points_above, m_builder.soup().points.size()));
      if (text.peek() == '/') {
        text.advance(1);
        if (text.peek() != '/' && !text.at_word_end())
          m_uv_corners.push_back(
              read_index(text, "texture coordinate", m_uvs_above, m_builder.soup().uvs.values.size()));
        if (text.peek() == '/') {
          text.advance(1);
          has_normals = true;
          if (!text.at_word_end())
            text.integer_prefix();
        }
      }
      if (!text.at_word_end())
        text.fail("a corner of a face is followed by " + in_quotes(text.word()) +
                  "; write corners as v, v/vt, v//vn or v/vt/vn");
    }
    if (has_normals)
      m_builder.ignore("normals at the corners of faces");
    const bool has_uvs = !m_corners.empty() && m_uv_corners.size() == m_corners.size();
    if (!has_uvs)
      m_uv_corners.clear();
    const std::size_t triangles = m_builder.add_face(m_corners, m_uv_corners);
    if (triangles != 0)
      label_triangles(triangles);
  }

  Index read_index(Text_reader& text, const std::string& kind, std::size_t above, std::size_t count)
  {
    const Text_reader start = text;
    const std::int64_t number = text.integer_prefix();
    // Relative indices count back from the latest element above the face.
    const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(above) + number;
    if (number == 0)
      start.fail("a face names " + kind + " 0, but OBJ files count from 1");
    if (index < 0 || static_cast<std::uint64_t>(index) >= count)
      start.fail("a face names " + kind + " " + std::to_string(number) + ", but there are only " +
                 std::to_string(number > 0 ? count : above) + (number > 0 ? "" : " above it") +
                 "; correct or remove the face");
    return static_cast<Index>(index);
  }

  void start_group(std::string_view name)
  {
    if (m_label_is_new)
      m_builder.ignore("groups and objects without faces");
    while (!name.empty() && (name.back() == '\\' || name.back() == ' '))
      name.remove_suffix(1);
    m_label = name.empty() ? default_group : name;
    m_label_is_new = true;
  }

  void label_triangles(std::size_t count)
  {
    if (m_label.empty())
      return;
    Triangle_soup& soup = m_builder.soup();
    if (m_label_is_new) {
      m_label_is_new = false;
      const std::size_t unlabelled = soup.triangles.size() - count;
      // Faces above the first label are in the group that an OBJ begins with.
      if (soup.groups.of_triangle.size() < unlabelled)
        soup.groups.of_triangle.resize(unlabelled, group_number(default_group));
      m_group = group_number(m_label);
    }
    soup.groups.of_triangle.resize(soup.triangles.size(), m_group);
  }

  Index group_number(std::string_view name)
  {
    auto& names = m_builder.soup().groups.names;
    const auto [place, is_new] = m_group_numbers.emplace(name, static_cast<Index>(names.size()));
    if (is_new)
      names.emplace_back(name);
    return place->second;
  }

  void ignore_statement(std::string_view keyword)
  {
    static const std::unordered_map<std::string_view, std::string> names = {
        {"vn", "normals"},       {"l", "line elements"},       {"p", "point elements"},
        {"usemtl", "materials"}, {"mtllib", "material files"}, {"s", "smoothing groups"}};
    constexpr std::size_t most_names = 16; // a file that is no OBJ at all has a new one on every line
    const auto known = names.find(keyword);
    if (known != names.end()) {
      m_builder.ignore(known->second);
    } else {
      const std::string name = "statements " + in_quotes(keyword);
      const bool is_listed =
          m_unknown.size() < most_names ? (m_unknown.insert(name), true) : m_unknown.count(name) != 0;
      m_builder.ignore(is_listed ? name : "other statements");
    }
  }

  /// Texture coordinates are on every corner, or are dropped.
  void close_uvs()
  {
    Triangle_soup& soup = m_builder.soup();
    if (soup.uvs.values.empty() || soup.uvs.of_triangle.size() == soup.triangles.size())
      return;
    m_builder.ignore(soup.uvs.of_triangle.empty() ? "texture coordinates that no face names"
                                               : "texture coordinates, for some corners have none",
                     soup.uvs.values.size());
    soup.uvs.values = {};
    soup.uvs.of_triangle = {};
  }

  std::string_view m_contents;
  const std::string& m_name;
  Soup_builder m_builder{Mesh_format::obj};
  std::vector<Index> m_corners, m_uv_corners;
  std::size_t m_points_above = 0, m_uvs_above = 0;
  std::string_view m_label; // empty above the first group or object
  bool m_label_is_new = false;
  Index m_group = 0;
  std::unordered_map<std::string_view, Index> m_group_numbers;
  std::set<std::string> m_unknown;
};

/// Whether a reader finds the same name again.
bool is_group_name(const std::string& name)
{
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  return !name.empty() && name.front() != ' ' && name.back() != ' ' && name.back() != '\\' &&
         std::none_of(name.begin(), name.end(), is_control);
}

} // namespace

Mesh_file read_obj(std::string_view contents, const std::string& name)
{
  return Obj_reader(contents, name).read();
}

void write_obj(Byte_writer& out, const Triangle_soup& soup, const Write_options& options)
{
  for (const std::string& name : soup.groups.names)
    if (!is_group_name(name))
      throw Argument_error("the group name '" + name + "' cannot stand in an OBJ file; rename the group");
  for (const std::string& comment : options.comments)
    out << "# " << comment << '\n';
  for (const Point_3& p : soup.points)
    out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  const bool has_uvs = !soup.uvs.of_triangle.empty();
  for (std::size_t i = 0; has_uvs && i < soup.uvs.values.size(); ++i)
    out << "vt " << soup.uvs.values[i][0] << ' ' << soup.uvs.values[i][1] << '\n';
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    if (!soup.groups.of_triangle.empty() && (i == 0 || soup.groups.of_triangle[i] != soup.groups.of_triangle[i - 1]))
      out << "g " << soup.groups.names[soup.groups.of_triangle[i]] << '\n';
    out << 'f';
    for (int corner = 0; corner < 3; ++corner) {
      out << ' ' << std::uint64_t{soup.triangles[i][corner]} + 1;
      if (has_uvs)
        out << '/' << std::uint64_t{soup.uvs.of_triangle[i][corner]} + 1;
    }
    out << '\n';
  }
  out.commit();
}

} // namespace selvedge::files
