// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/Ply_header.h"

#include "files/ply_types.h"

#include <algorithm>
#include <utility>

namespace selvedge::files {
namespace {

class Header_reader
{
public:
  explicit Header_reader(Text_reader& text) : m_text(text) {}

  Ply_header read()
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
      else if (keyword == "comment" || keyword == "obj_info")
        read_comment(keyword);
      else if (!keyword.empty() && m_header.elements.empty())
        ++m_header.unknown_lines;
      else if (!keyword.empty())
        m_text.fail("the header has an unknown statement " + in_quotes(keyword) + "; remove it");
    }
    if (m_header.format.empty())
      m_text.fail("the header names no format; the file is damaged");
    return std::move(m_header);
  }

private:
  void next_line()
  {
    m_text.line();
    if (m_text.at_end())
      m_text.fail("the file ends within its header; it is cut short");
    m_text.advance(1);
  }

  void read_comment(std::string_view keyword)
  {
    const std::string_view text = m_text.line();
    if (text != "\\") // would continue the line when written
      m_header.comments.push_back(std::string(keyword) + ' ' + std::string(text));
  }

  void read_format()
  {
    m_header.format = m_text.word();
    if (m_header.format != "ascii" && m_header.format != "binary_little_endian" &&
        m_header.format != "binary_big_endian")
      m_text.fail("the format " + in_quotes(m_header.format) +
                  " is none of ascii, binary_little_endian, binary_big_endian");
  }

  void read_element()
  {
    Ply_element element;
    element.name = m_text.word();
    const std::int64_t count = m_text.integer();
    if (count < 0)
      m_text.fail("the element " + in_quotes(element.name) + " has a negative count");
    element.count = static_cast<std::uint64_t>(count);
    m_header.elements.push_back(std::move(element));
  }

  void read_property()
  {
    if (m_header.elements.empty())
      m_text.fail("a property stands before the first element; the header is damaged");
    m_header.elements.back().declarations += "property " + std::string(Text_reader(m_text).line()) + '\n';
    Ply_property property;
    std::string_view type = m_text.word();
    if (type == "list") {
      property.count_type = read_type(m_text.word());
      if (!is_integer(*property.count_type))
        m_text.fail("the lengths of a list are no integers; the header is damaged");
      type = m_text.word();
    }
    property.type = read_type(type);
    property.name = m_text.word();
    while (!property.name.empty() && property.name.back() == '\\') // would continue the line when written
      property.name.pop_back();
    m_header.elements.back().properties.push_back(std::move(property));
  }

  Attribute::Type read_type(std::string_view name) const
  {
    for (std::size_t i = 0; i < ply_type_names.size(); ++i)
      if (name == ply_type_names[i][0] || name == ply_type_names[i][1])
        return static_cast<Attribute::Type>(i);
    m_text.fail("the header has an unknown type " + in_quotes(name) + "; convert the file");
  }

  Text_reader& m_text;
  Ply_header m_header;
};

} // namespace

std::size_t Ply_element::find(std::string_view property) const
{
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const Ply_property& candidate) { return candidate.name == property; });
  return static_cast<std::size_t>(found - properties.begin());
}

Ply_header read_ply_header(Text_reader& text)
{
  return Header_reader(text).read();
}

} // namespace selvedge::files
