// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_PLY_VALUES_H
#define SELVEDGE_SRC_FILES_PLY_VALUES_H

#include "files/Binary_reader.h"
#include "files/Text_reader.h"
#include "files/columns.h"
#include "files/ply_types.h"

#include <selvedge/Error.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// The values of a PLY file's body, binary and text, behind one set of functions.

namespace selvedge::files {

/// Reads the values of a binary body, one after the other. Every function throws when the file ends before
/// the value.
class Ply_binary_values
{
public:
  Ply_binary_values(std::string_view body, bool big_endian, const std::string& name)
      : m_data(body, big_endian), m_name(&name)
  {
  }

  static std::size_t least_bytes(Attribute::Type type) { return ply_size_of(type); }
  std::size_t remaining() const { return m_data.remaining(); }
  bool at_end() const { return m_data.remaining() == 0; }

  double real(Attribute::Type type)
  {
    check(ply_size_of(type));
    switch (type) {
    case Attribute::Type::float32:
      return m_data.take<float>();
    case Attribute::Type::float64:
      return m_data.take<double>();
    default:
      return static_cast<double>(integer(type));
    }
  }

  std::int64_t integer(Attribute::Type type)
  {
    check(ply_size_of(type));
    switch (type) {
    case Attribute::Type::int8:
      return m_data.take<std::int8_t>();
    case Attribute::Type::uint8:
      return m_data.take<std::uint8_t>();
    case Attribute::Type::int16:
      return m_data.take<std::int16_t>();
    case Attribute::Type::uint16:
      return m_data.take<std::uint16_t>();
    case Attribute::Type::int32:
      return m_data.take<std::int32_t>();
    default:
      return m_data.take<std::uint32_t>();
    }
  }

  void append(Attribute::Type type, std::vector<unsigned char>& rows)
  {
    check(ply_size_of(type));
    with_number(type, [&](auto zero) { append_number(rows, m_data.take<decltype(zero)>()); });
  }

  void skip(Attribute::Type type, std::uint64_t count)
  {
    check(count * ply_size_of(type)); // a list's count has at most 32 bits
    m_data.skip(count * ply_size_of(type));
  }

  bool end_row() const { return true; }

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

/// Reads the values of an ASCII body, one after the other.
class Ply_text_values
{
public:
  Ply_text_values(const Text_reader& text, bool is_row_a_line) : m_text(text), m_is_row_a_line(is_row_a_line)
  {
  }

  static std::size_t least_bytes(Attribute::Type) { return 2; }
  std::size_t remaining() const { return m_text.remaining() + 1; } // the last value needs no blank after it

  /// Passes blanks and line ends, and returns whether there are no more values.
  bool at_end()
  {
    m_text.skip_space();
    return m_text.at_end();
  }

  double real(Attribute::Type)
  {
    m_text.skip_space();
    return m_text.real();
  }

  std::int64_t integer(Attribute::Type)
  {
    m_text.skip_space();
    return m_text.integer();
  }

  void append(Attribute::Type type, std::vector<unsigned char>& rows)
  {
    m_text.skip_space();
    with_number(type, [&](auto zero) {
      using Number = decltype(zero);
      if constexpr (std::is_integral_v<Number>) {
        const std::int64_t value = m_text.integer();
        if (value < std::numeric_limits<Number>::min() || value > std::numeric_limits<Number>::max())
          fail("the value " + std::to_string(value) + " is not of the type " +
               std::string(ply_type_name(type)) + " that the header announces; correct the header");
        append_number(rows, static_cast<Number>(value));
      } else {
        append_number(rows, m_text.real<Number>());
      }
    });
  }

  void skip(Attribute::Type, std::uint64_t count)
  {
    for (; count != 0; --count) {
      m_text.skip_space();
      if (m_text.word().empty())
        fail("a value is missing; the file is damaged or cut short");
    }
  }

  /// Returns false when the line of the row has more values than the header announces, and passes them.
  bool end_row()
  {
    if (!m_is_row_a_line || m_text.at_line_end())
      return true;
    m_text.skip_line();
    return false;
  }

  [[noreturn]] void fail(const std::string& message) const { m_text.fail(message); }

private:
  Text_reader m_text;
  bool m_is_row_a_line;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_PLY_VALUES_H
