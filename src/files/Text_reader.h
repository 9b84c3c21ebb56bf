// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_TEXT_READER_H
#define SELVEDGE_SRC_FILES_TEXT_READER_H

#include <selvedge/Error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

namespace selvedge::files {

/// Returns a part of a file's text in quotes for a message: short and printable, whatever the text is.
inline std::string in_quotes(std::string_view text)
{
  constexpr std::size_t longest = 40;
  std::string result(text.substr(0, longest));
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return "'" + result + (text.size() > longest ? "...'" : "'");
}

/// Returns a text with line feeds for its line ends, kept in `copy`, when these are carriage returns alone,
/// as old programs of the Macintosh write them; else the text itself.
inline std::string_view with_line_feeds(std::string_view text, std::string& copy)
{
  if (text.find('\n') != text.npos || text.find('\r') == text.npos)
    return text;
  copy = text;
  std::replace(copy.begin(), copy.end(), '\r', '\n');
  return copy;
}

/// Reads a text in memory word by word and line by line, for the readers of text formats. Copies are cheap
/// bookmarks.
class Text_reader
{
public:
  Text_reader(std::string_view text, const std::string& name)
      : m_begin(text.data()), m_at(m_begin), m_end(m_begin + text.size()), m_name(&name)
  {
    if (text.substr(0, 3) == "\xef\xbb\xbf") // byte order mark
      m_at += 3;
  }

  bool at_end() const { return m_at == m_end; }
  std::size_t remaining() const { return static_cast<std::size_t>(m_end - m_at); }
  std::string_view rest() const { return {m_at, remaining()}; }
  char peek() const { return at_end() ? '\0' : *m_at; }
  void advance(std::size_t count) { m_at += count; }

  /// Passes blanks, and line ends that follow a backslash.
  void skip_blanks()
  {
    for (;;) {
      while (m_at != m_end && is_blank(*m_at))
        ++m_at;
      const std::size_t continued = continuation(m_at);
      if (continued == 0)
        return;
      m_at += continued;
    }
  }

  /// Passes blanks and line ends.
  void skip_space()
  {
    while (m_at != m_end && (is_blank(*m_at) || *m_at == '\n'))
      ++m_at;
  }

  /// Whether the text ends within a line, as that of a truncated file does.
  bool is_truncated() const { return m_begin != m_end && m_end[-1] != '\n'; }

  /// Whether nothing but blanks and a comment remain on the line.
  bool at_line_end()
  {
    skip_blanks();
    return m_at == m_end || *m_at == '\n' || *m_at == '#';
  }

  /// Passes lines that hold nothing or only a comment. Returns false at the end of the text.
  bool to_next_statement()
  {
    while (at_line_end() && m_at != m_end)
      skip_line();
    return m_at != m_end;
  }

  /// Passes the rest of the line, and the lines that continue it. Comments are never continued, so that a
  /// path in one may end with a backslash.
  void skip_line()
  {
    for (;;) {
      const void* const found = std::memchr(m_at, '\n', remaining());
      if (found == nullptr) {
        m_at = m_end;
        return;
      }
      const char* const line_end = static_cast<const char*>(found);
      const char* last = line_end;
      if (last != m_at && last[-1] == '\r')
        --last;
      const bool continued = last != m_at && last[-1] == '\\' && std::find(m_at, last, '#') == last;
      m_at = line_end + 1;
      if (!continued)
        return;
    }
  }

  /// Returns the next word; an empty one at the end of the line.
  std::string_view word()
  {
    skip_blanks();
    const char* const first = m_at;
    while (!at_separator(m_at))
      ++m_at;
    return {first, static_cast<std::size_t>(m_at - first)};
  }

  /// Returns the rest of the physical line without blanks at its ends.
  std::string_view line()
  {
    skip_blanks();
    const std::string_view text = rest();
    const std::string_view content = text.substr(0, text.find('\n'));
    m_at += content.size();
    std::size_t size = content.size();
    while (size != 0 && is_blank(content[size - 1]))
      --size;
    return content.substr(0, size);
  }

  /// Returns the rest of the statement without blanks and backslashes at its end; a continued line end counts
  /// as a blank.
  std::string statement() const
  {
    Text_reader first = *this, last = *this;
    first.skip_blanks();
    last.skip_line();
    std::string result;
    for (const char* at = first.m_at; at < last.m_at;) {
      const std::size_t continued = continuation(at);
      result += continued != 0 ? ' ' : *at;
      at += std::max<std::size_t>(continued, 1);
    }
    while (!result.empty() && (is_blank(result.back()) || result.back() == '\n' || result.back() == '\\'))
      result.pop_back();
    return result;
  }

  /// Returns the number nearest to the next word; infinite when that overflows.
  template <class Number = double>
  Number real()
  {
    skip_blanks();
    const char* const first = number_begin();
    Number value = 0;
    const auto [last, error] = std::from_chars(first, m_end, value);
    if (error == std::errc::result_out_of_range)
      value = static_cast<Number>(out_of_range_value(std::string(first, last)));
    else if (error != std::errc())
      fail_at_word("a number");
    if (!at_separator(last))
      fail_at_word("a number");
    m_at = last;
    return value;
  }

  /// Returns the next word as an integer.
  std::int64_t integer()
  {
    const Text_reader start = *this;
    const std::int64_t value = integer_prefix();
    if (!at_separator(m_at))
      start.fail_at_word("an integer");
    return value;
  }

  /// Returns the integer that the next word begins with.
  std::int64_t integer_prefix()
  {
    skip_blanks();
    std::int64_t value = 0;
    const auto [last, error] = std::from_chars(number_begin(), m_end, value);
    if (error != std::errc())
      fail_at_word("an integer");
    m_at = last;
    return value;
  }

  /// Whether a word ends here.
  bool at_word_end() const { return at_separator(m_at); }

  /// Throws an `Input_error` that names the file and the line.
  [[noreturn]] void fail(const std::string& message) const
  {
    const bool is_cut = is_truncated() && std::find(m_at, m_end, '\n') == m_end;
    throw Input_error(*m_name + ":" + std::to_string(1 + std::count(m_begin, m_at, '\n')) + ": " + message +
                      (is_cut ? "; the file ends within this line: it seems to be truncated" : ""));
  }

private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

  bool at_separator(const char* at) const
  {
    return at == m_end || is_blank(*at) || *at == '\n' || continuation(at) != 0;
  }

  /// Returns the length of a continued line end that begins at `at`; 0 when there is none.
  std::size_t continuation(const char* at) const
  {
    if (at == m_end || *at != '\\')
      return 0;
    const char* end = at + 1;
    if (end != m_end && *end == '\r')
      ++end;
    return end != m_end && *end == '\n' ? static_cast<std::size_t>(end + 1 - at) : 0;
  }

  /// Returns where a number begins for from_chars, which accepts no plus sign.
  const char* number_begin() const
  {
    const bool plus = m_end - m_at >= 2 && *m_at == '+' && m_at[1] != '-';
    return plus ? m_at + 1 : m_at;
  }

  /// Returns the value of a number that from_chars finds out of range; it tells neither overflow from
  /// underflow nor what a tiny number rounds to.
  static double out_of_range_value(const std::string& number)
  {
    std::istringstream stream(number);
    stream.imbue(std::locale::classic());
    double value = 0;
    return stream >> value ? value : std::copysign(std::numeric_limits<double>::infinity(), value);
  }

  [[noreturn]] void fail_at_word(const std::string& kind) const
  {
    Text_reader at = *this;
    const std::string_view found = at.word();
    fail(found.empty()
             ? "the line ends where " + kind + " should stand"
             : in_quotes(found) + " is not " + kind +
                   (kind == "a number" && found.find(',') != found.npos ? "; write decimals with a point"
                                                                        : ""));
  }

  const char* m_begin;
  const char* m_at;
  const char* m_end;
  const std::string* m_name;
};

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_TEXT_READER_H
