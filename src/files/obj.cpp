// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Soup_builder.h"
#include "files/Text_reader.h"
#include "files/Written_faces.h"
#include "files/columns.h"
#include "files/formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <unordered_map>

// Reads and writes OBJ: positions with colours or weights, texture coordinates, normals, and the labels of
// faces.

namespace selvedge::files {
namespace {

/// The names that statements of one keyword give to the faces below them.
struct Label_reader
{
  std::string_view keyword;
  std::string plural;
  Triangle_labels& labels;
  Index current = 0;
  bool is_begun = false;  // a statement stands above the present line
  bool is_unused = false; // no face has followed it yet
  std::unordered_map<std::string, Index> numbers = {};

  Index number(const std::string& name)
  {
    const auto [place, is_new] = numbers.emplace(name, static_cast<Index>(labels.names.size()));
    if (is_new)
      labels.names.push_back(name);
    return place->second;
  }
};

/// Reads the text twice: first the vertices, then the faces, because a polygon can be cut only when all its
/// vertices are known.
class Obj_reader
{
public:
  Obj_reader(std::string_view contents, const std::string& name) : m_contents(contents), m_name(name) {}

  Mesh_file read()
  {
    Cancellation_poll poll;
    for (Text_reader text(m_contents, m_name); text.to_next_statement(); text.skip_line()) {
      poll();
      read_vertex_statement(text);
    }
    for (Text_reader text(m_contents, m_name); text.to_next_statement(); text.skip_line()) {
      poll();
      read_face_statement(text);
    }
    for (const Label_reader& reader : m_labels)
      if (reader.is_unused)
        m_builder.ignore(reader.plural + " without faces");
    close_columns();
    return m_builder.take(m_name, Text_reader(m_contents, m_name).is_truncated());
  }

private:
  void read_vertex_statement(Text_reader& text)
  {
    const std::string_view keyword = text.word();
    const auto fail = [&text](const std::string& message) { text.fail(message); };
    Triangle_soup& soup = m_builder.soup();
    if (keyword == "v") {
      const double x = text.real(), y = text.real(), z = text.real();
      m_builder.add_point(x, y, z, 1, fail);
      if (!text.at_line_end())
        read_further_columns(text);
    } else if (keyword == "vt") {
      const double u = text.real(), v = text.at_line_end() ? 0 : text.real();
      if (!std::isfinite(u) || !std::isfinite(v))
        fail("texture coordinate " + std::to_string(soup.uvs.values.size() + 1) +
             " is not finite; remove or repair it");
      add_value(soup.uvs, {u, v}, "texture coordinates", text);
      if (!text.at_line_end() && text.real() != 0)
        m_builder.ignore("third texture coordinates");
    } else if (keyword == "vn") {
      const double x = text.real(), y = text.real(), z = text.real();
      add_value(soup.normals, {x, y, z}, "normals", text);
    }
  }

  template <std::size_t dimension>
  static void add_value(Corner_values<dimension>& values, const std::array<double, dimension>& value,
                        const char* plural, const Text_reader& text)
  {
    if (values.values.size() + 1 >= std::numeric_limits<Index>::max())
      text.fail(std::string("the mesh has more than 4294967293 ") + plural + "; split it");
    values.values.push_back(value);
  }

  /// Reads what follows the coordinates of a vertex: one number is a weight, three are a colour, four a
  /// colour with its alpha. Takes a copy of the reader, because skip_line must see the whole line.
  void read_further_columns(Text_reader text)
  {
    std::array<double, 4> numbers;
    std::size_t size = 0;
    bool is_known = true;
    while (!text.at_line_end()) {
      const std::string_view word = text.word();
      double number = 0;
      const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      // NaN marks vertices without the column, so it is not read as a value.
      is_known = is_known && size < 4 && error == std::errc() && last == word.data() + word.size() &&
                 !std::isnan(number);
      if (is_known)
        numbers[size++] = number;
    }
    if (!is_known || size == 2)
      return m_builder.ignore("vertex columns");
    const std::size_t first = size == 1 ? 0 : 1;
    for (std::size_t i = 0; i < size; ++i) {
      std::vector<double>& column = m_columns[first + i];
      column.resize(m_builder.soup().points.size() - 1, nan);
      column.push_back(numbers[i]);
    }
  }

  void close_columns()
  {
    Triangle_soup& soup = m_builder.soup();
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
      if (m_columns[i].empty())
        continue;
      m_columns[i].resize(soup.points.size(), nan);
      Attribute& attribute = soup.vertex_attributes.emplace_back();
      attribute.name = column_names[i];
      for (const double number : m_columns[i])
        append_number(attribute.rows, number);
    }
  }

  void read_face_statement(Text_reader& text)
  {
    const std::string_view keyword = text.word();
    if (keyword == "v")
      ++m_points_above;
    else if (keyword == "vt")
      ++m_uvs_above;
    else if (keyword == "vn")
      ++m_normals_above;
    else if (keyword == "f")
      read_face(text);
    else if (keyword == "mtllib")
      m_builder.soup().material_libraries.push_back(text.statement());
    else if (const auto reader = std::find_if(m_labels.begin(), m_labels.end(),
                                              [&](const Label_reader& r) { return r.keyword == keyword; });
             reader != m_labels.end())
      start_label(*reader, text.statement());
    else
      ignore_statement(keyword);
  }

  void read_face(Text_reader& text)
  {
    const Triangle_soup& soup = m_builder.soup();
    m_corners.clear();
    m_uv_corners.clear();
    m_normal_corners.clear();
    while (!text.at_line_end()) {
      const Text_reader start = text;
      m_corners.push_back(
          index_at(start, text.integer_prefix(), {"vertex", "v"}, m_points_above, soup.points.size()));
      if (text.peek() == '/') {
        text.advance(1);
        if (text.peek() != '/' && !text.at_word_end())
          read_value_index(text, {"texture coordinate", "vt"}, m_uvs_above, soup.uvs.values.size(),
                           m_uv_corners);
        if (text.peek() == '/') {
          text.advance(1);
          if (!text.at_word_end())
            read_value_index(text, {"normal", "vn"}, m_normals_above, soup.normals.values.size(),
                             m_normal_corners);
        }
      }
      if (!text.at_word_end())
        text.fail("a corner of a face is followed by " + in_quotes(text.word()) +
                  "; write corners as v, v/vt, v//vn or v/vt/vn");
    }
    keep_if_complete(m_uv_corners, "texture coordinates");
    keep_if_complete(m_normal_corners, "normals");
    const std::size_t triangles = m_builder.add_face(m_corners, m_uv_corners, m_normal_corners);
    for (Label_reader& reader : m_labels)
      if (triangles != 0 && reader.is_begun) {
        reader.labels.of_triangle.resize(soup.triangles.size(), reader.current);
        reader.is_unused = false;
      }
  }

  void keep_if_complete(std::vector<Index>& numbers, const char* plural)
  {
    if (numbers.empty() || numbers.size() == m_corners.size())
      return;
    m_builder.ignore(std::string(plural) + " of faces that have them at some corners only");
    numbers.clear();
  }

  /// What a number of a face counts, and the statement that gives one of these.
  struct Kind
  {
    const char* name;
    const char* keyword;
  };

  /// Reads the number of a value that a face can do without. Some programs write the numbers of values that
  /// they leave out of the file, and 0 for a corner without one: nothing is lost with these. A number beyond
  /// the values that there are is another matter: the face has lost its own.
  void read_value_index(Text_reader& text, const Kind& kind, std::size_t above, std::size_t count,
                        std::vector<Index>& numbers)
  {
    const Text_reader start = text;
    const std::int64_t number = text.integer_prefix();
    if (count == 0)
      m_builder.ignore(std::string("numbers of ") + kind.name + "s in a file without any");
    else if (number == 0)
      m_builder.ignore(std::string("numbers 0 of ") + kind.name + "s");
    else
      numbers.push_back(index_at(start, number, kind, above, count));
  }

  // `start` stands before the number.
  static Index index_at(const Text_reader& start, std::int64_t number, const Kind& kind, std::size_t above,
                        std::size_t count)
  {
    // Relative indices count back from the latest element above the face.
    const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(above) + number;
    if (number == 0)
      start.fail(std::string("a face names ") + kind.name +
                 " 0, but OBJ files count from 1; correct the face");
    if (index < 0 || static_cast<std::uint64_t>(index) >= count)
      start.fail(std::string("a face names ") + kind.name + " " + std::to_string(number) +
                 ", but there are only " + std::to_string(number > 0 ? count : above) +
                 (number > 0 ? "" : " above it") + "; correct or remove the face" +
                 (kind.keyword == std::string_view("v")
                      ? std::string()
                      : std::string(", or all lines that begin with ") + in_quotes(kind.keyword) +
                            " to do without " + kind.name + "s"));
    return static_cast<Index>(index);
  }

  // What has no name is nothing until something with a name has begun: Houdini writes «g» alone.
  void start_label(Label_reader& reader, const std::string& name)
  {
    if (name.empty() && !reader.is_begun)
      return;
    if (reader.is_unused)
      m_builder.ignore(reader.plural + " without faces");
    if (!reader.is_begun && !m_builder.soup().triangles.empty())
      reader.labels.of_triangle.resize(m_builder.soup().triangles.size(), reader.number(""));
    reader.current = reader.number(name);
    reader.is_begun = reader.is_unused = true;
  }

  void ignore_statement(std::string_view keyword)
  {
    static const std::unordered_map<std::string_view, std::string> names = {{"l", "line elements"},
                                                                            {"p", "point elements"}};
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

  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::array<const char*, 5> column_names = {"w", "red", "green", "blue", "alpha"};

  std::string_view m_contents;
  const std::string& m_name;
  Soup_builder m_builder{Mesh_format::obj};
  std::vector<Index> m_corners, m_uv_corners, m_normal_corners;
  std::size_t m_points_above = 0, m_uvs_above = 0, m_normals_above = 0;
  std::array<std::vector<double>, column_names.size()> m_columns;
  std::array<Label_reader, 4> m_labels = {{{"o", "objects", m_builder.soup().objects},
                                           {"g", "groups", m_builder.soup().groups},
                                           {"usemtl", "materials", m_builder.soup().materials},
                                           {"s", "smoothing groups", m_builder.soup().smoothing_groups}}};
  std::set<std::string> m_unknown;
};

/// Whether a text written behind a keyword is read back unchanged.
bool is_statement_text(const std::string& text)
{
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; };
  return text.empty() || (!is_blank(text.front()) && !is_blank(text.back()) && text.back() != '\\' &&
                          text.find('\n') == std::string::npos);
}

void check_text(const std::string& text, const std::string& kind)
{
  if (!is_statement_text(text))
    throw Argument_error("the name " + in_quotes(text) + " of a " + kind +
                         " cannot stand in an OBJ file; rename the " + kind);
}

// A line can leave out the alpha of a colour, and no other part: one number alone is read as a weight.
bool has_colour(const std::vector<Attribute_component>& colours, std::size_t i)
{
  return !colours.empty() &&
         std::none_of(colours.begin(), colours.begin() + 3,
                      [i](const Attribute_component& colour) { return std::isnan(colour.real(i)); });
}

void write_points(Byte_writer& out, const Triangle_soup& soup)
{
  const std::vector<Attribute_component> colours = find_colours(soup.vertex_attributes);
  const std::optional<Attribute_component> weight = find_column(soup.vertex_attributes, "w");
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const Point_3& p = soup.points[i];
    out << "v " << p.x() << ' ' << p.y() << ' ' << p.z();
    if (has_colour(colours, i)) {
      for (const Attribute_component& colour : colours)
        if (const double value = colour.real(i); !std::isnan(value))
          out << ' ' << value;
    } else if (weight && !std::isnan(weight->real(i))) {
      out << ' ' << weight->real(i);
    }
    out << '\n';
  }
}

template <std::size_t dimension>
void write_values(Byte_writer& out, std::string_view keyword, const Corner_values<dimension>& values)
{
  for (Index i = 0; i < values.values.size() && !values.empty(); ++i)
    if (i != values.missing) {
      out << keyword;
      for (const double value : values.values[i])
        out << ' ' << value;
      out << '\n';
    }
}

/// Returns the number of a value in the file, from 1; 0 when there is none.
template <std::size_t dimension>
std::uint64_t written_number(const Corner_values<dimension>& values, Index corner)
{
  if (values.empty())
    return 0;
  const Index number = values.of_triangle[corner / 3][corner % 3];
  if (number == values.missing)
    return 0;
  return std::uint64_t{number} + 1 - (values.missing && number > *values.missing ? 1 : 0);
}

/// Writes the label statements that must stand before a triangle. After a new object all others are repeated,
/// because some readers forget them there.
class Label_writer
{
public:
  explicit Label_writer(const Triangle_soup& soup)
      : m_kinds{{{"o", &soup.objects},
                 {"g", &soup.groups},
                 {"usemtl", &soup.materials},
                 {"s", &soup.smoothing_groups}}}
  {
  }

  void write(Byte_writer& out, std::size_t triangle)
  {
    bool is_new_object = false;
    for (Kind& kind : m_kinds) {
      if (kind.labels->empty())
        continue;
      const std::string& name = kind.labels->names[kind.labels->of_triangle[triangle]];
      const bool is_new = name != kind.current;
      if (is_new || (is_new_object && !name.empty()))
        out << kind.keyword << (name.empty() ? "" : " ") << name << '\n';
      is_new_object = is_new_object || (is_new && kind.labels == m_kinds[0].labels);
      kind.current = name;
    }
  }

private:
  struct Kind
  {
    std::string_view keyword;
    const Triangle_labels* labels;
    std::string_view current = {};
  };

  std::array<Kind, 4> m_kinds;
};

} // namespace

Mesh_file read_obj(std::string_view contents, const std::string& name)
{
  std::string copy;
  return Obj_reader(with_line_feeds(contents, copy), name).read();
}

bool is_in_obj(const Triangle_soup& soup, const Attribute& attribute)
{
  const std::vector<Attribute_component> colours = find_colours(soup.vertex_attributes);
  const auto has = [&](const Attribute_component& column) { return column.attribute == &attribute; };
  const auto colour = std::find_if(colours.begin(), colours.end(), has);
  const bool is_colour = colour != colours.end();
  const std::optional<Attribute_component> column =
      is_colour ? *colour : find_column(soup.vertex_attributes, "w");
  if (!column || !has(*column))
    return false;
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    if (!std::isnan(column->real(i)) && has_colour(colours, i) != is_colour)
      return false;
  return true;
}

void write_obj(Byte_writer& out, const Triangle_soup& soup, const Write_options& options)
{
  for (const auto& [labels, kind] :
       {std::pair(&soup.objects, "object"), std::pair(&soup.groups, "group"),
        std::pair(&soup.materials, "material"), std::pair(&soup.smoothing_groups, "smoothing group")})
    for (const std::string& name : labels->names)
      check_text(name, kind);
  for (const std::string& library : soup.material_libraries)
    check_text(library, "material library");

  for (const std::string& comment : options.comments)
    out << "# " << comment << '\n';
  for (const std::string& library : soup.material_libraries)
    out << "mtllib " << library << '\n';
  write_points(out, soup);
  write_values(out, "vt", soup.uvs);
  write_values(out, "vn", soup.normals);
  Label_writer labels(soup);
  Written_faces(soup, Mesh_format::obj).for_each([&](Index triangle, const std::vector<Index>& corners) {
    labels.write(out, triangle);
    out << 'f';
    for (const Index corner : corners) {
      out << ' ' << std::uint64_t{soup.triangles[corner / 3][corner % 3]} + 1;
      const std::uint64_t uv = written_number(soup.uvs, corner),
                          normal = written_number(soup.normals, corner);
      if (uv != 0 || normal != 0)
        out << '/';
      if (uv != 0)
        out << uv;
      if (normal != 0)
        out << '/' << normal;
    }
    out << '\n';
  });
  out.commit();
}

} // namespace selvedge::files
