// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/collapse_log.h>

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Sha256.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <istream>
#include <ostream>
#include <utility>

namespace selvedge {
namespace {

constexpr std::string_view s_first_line = "selvedge-log 1";
const std::vector<std::string> s_words_for_normals{"kept",   "joined",        "ignored", "dropped",
                                                   "smooth", "smooth_shared", "soft",    "soft_shared",
                                                   "hard",   "loose_shared"}; // by Logged_normals

template <class Number>
std::string text_of(Number number)
{
  char text[32];
  return {text, std::to_chars(std::begin(text), std::end(text), number).ptr};
}

std::string text_of_digest(const std::string& digest)
{
  return digest.empty() ? "-" : digest;
}

bool is_plain(char c)
{
  return c > ' ' && c < 127 && c != '%';
}

std::string text_of_name(const std::string& name)
{
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const char c : name)
    if (is_plain(c))
      text += c;
    else
      text += {'%', digits[static_cast<unsigned char>(c) / 16], digits[static_cast<unsigned char>(c) % 16]};
  return text;
}

} // namespace

Logged_normals shared_normals(Normals_choice choice)
{
  switch (choice) {
  case Normals_choice::loose:
    return Logged_normals::loose_shared;
  case Normals_choice::soft:
    return Logged_normals::soft_shared;
  case Normals_choice::smooth:
    return Logged_normals::smooth_shared;
  default:
    return Logged_normals::dropped;
  }
}

std::string digest_of(const std::vector<Point_3>& places)
{
  Sha256 sha256;
  for (const Point_3& point : places) {
    std::array<char, 24> bytes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double coordinate = point[int(axis)] + 0.0; // −0 becomes 0
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof bits);
      for (std::size_t byte = 0; byte < 8; ++byte)
        bytes[8 * axis + byte] = char(bits >> (8 * byte) & 0xff);
    }
    sha256.add({bytes.data(), bytes.size()});
  }
  return sha256.digest();
}

Log_numbering::Log_numbering(const Triangle_soup& original, bool is_stl)
    : m_vertex_count(original.points.size())
{
  if (!is_stl)
    return;
  m_numbers.assign(original.points.size(), 0);
  for (const Index_triple& triangle : original.triangles)
    m_vertices.insert(m_vertices.end(), triangle.begin(), triangle.end());
  for (std::size_t number = m_vertices.size(); number-- > 0;)
    m_numbers[m_vertices[number]] = Index(number);
}

Log_writer::Log_writer(std::ostream& stream, const Log_header& header) : m_stream(stream)
{
  m_stream << s_first_line << '\n';
  const auto write_mesh = [&](const char* what, const auto& mesh) {
    m_stream << what << ' ' << text_of(mesh.vertices) << ' ' << text_of(mesh.triangles) << ' '
             << text_of_digest(mesh.sha256) << '\n';
  };
  write_mesh("input", header);
  m_stream << "rounding " << (header.is_rounded_to_float32 ? "float32" : "none") << '\n';
  if (header.normals != Logged_normals::kept)
    m_stream << "normals " << s_words_for_normals[std::size_t(header.normals)] << '\n';
  for (const std::string& name : header.dropped_parts.names)
    m_stream << "drop_part " << text_of_name(name) << '\n';
  if (const double size = header.dropped_parts.smaller_than; size > 0)
    m_stream << "drop_smaller " << text_of(size) << '\n';
  for (const std::string& name : header.dropped)
    m_stream << "dropped " << text_of_name(name) << '\n';
  if (header.may_pairs_descend)
    m_stream << "defects descend\n";
  for (const auto& [a, b] : header.may_intersect)
    m_stream << "may_intersect " << text_of_name(a) << ' ' << text_of_name(b) << '\n';
  if (header.obstacle)
    write_mesh("obstacle", *header.obstacle);
  for (const Log_header::Posed& pose : header.poses)
    m_stream << "pose " << text_of_name(pose.name) << ' ' << text_of_digest(pose.sha256)
             << (pose.sha256_of_obstacle.empty() ? "" : " " + pose.sha256_of_obstacle) << '\n';
  for (const Limit_description& limit : limit_descriptions)
    if (const std::optional<double>& value = header.limits.*limit.value)
      m_stream << "limit " << limit.key << ' ' << text_of(*value) << '\n';
}

void Log_writer::write(const Log_step& step)
{
  if (step.kind == Log_step::Kind::weld || step.kind == Log_step::Kind::turn) {
    std::string line = step.kind == Log_step::Kind::weld ? "w" : "t";
    for (const Index number : step.group)
      line += ' ' + text_of(number);
    m_stream << line << '\n';
    return;
  }
  std::string line = step.kind == Log_step::Kind::snap ? "s " : "c ";
  line += text_of(step.removed) + ' ' + text_of(step.kept);
  if (step.place) {
    for (const double coordinate : *step.place)
      line += ' ' + text_of(coordinate);
    if (step.is_removed_first)
      line += " removed";
  }
  m_stream << line << '\n';
}

void Log_writer::write(const Log_result& result)
{
  m_stream << "result " << text_of(result.collapses) << ' ' << text_of(result.triangles) << ' '
           << text_of_digest(result.sha256) << '\n';
}

class Log_reader::Implementation
{
public:
  Implementation(std::istream& stream, const std::string& name) : m_stream(stream), m_name(name) {}

  void read_header()
  {
    if (!next_line() || m_words.size() != 2 || m_words[0] != "selvedge-log")
      fail("this is no log of collapses: it does not begin with '" + std::string(s_first_line) + "'");
    if (m_words[1] != "1")
      fail("the log has version " + std::string(m_words[1]) + ", and this program knows only version 1");
    if (!next_line() || m_words[0] != "input")
      fail("the second line is 'input VERTICES TRIANGLES SHA256'");
    read_mesh(header, "input VERTICES TRIANGLES SHA256");
    bool is_rounding_known = false, are_normals_known = false, are_defects_known = false;
    while (next_line()) {
      if (m_words[0] == "rounding" && !is_rounding_known) {
        header.is_rounded_to_float32 = second_word({"none", "float32"}) == 1;
        is_rounding_known = true;
      } else if (m_words[0] == "normals" && !are_normals_known) {
        header.normals = Logged_normals(second_word(s_words_for_normals));
        are_normals_known = true;
      } else if (m_words[0] == "drop_part") {
        expect_words(2, 2, "drop_part PART");
        header.dropped_parts.names.push_back(part_name(1));
      } else if (m_words[0] == "drop_smaller" && header.dropped_parts.smaller_than == 0) {
        expect_words(2, 2, "drop_smaller NUMBER");
        header.dropped_parts.smaller_than = number<double>(1);
        if (!(header.dropped_parts.smaller_than > 0))
          fail("the size below which parts are dropped is positive");
      } else if (m_words[0] == "dropped") {
        expect_words(2, 2, "dropped NAME");
        header.dropped.push_back(part_name(1));
      } else if (m_words[0] == "defects" && !are_defects_known) {
        header.may_pairs_descend = second_word({"freeze", "descend"}) == 1;
        are_defects_known = true;
      } else if (m_words[0] == "may_intersect") {
        expect_words(3, 3, "may_intersect PART PART");
        header.may_intersect.emplace_back(part_name(1), part_name(2));
      } else if (m_words[0] == "obstacle" && !header.obstacle) {
        Log_header::Obstacle obstacle;
        read_mesh(obstacle, "obstacle VERTICES TRIANGLES SHA256");
        header.obstacle = obstacle;
      } else if (m_words[0] == "pose") {
        expect_words(3, 4, "pose NAME SHA256 [OBSTACLE]");
        header.poses.push_back({part_name(1), digest(2), m_words.size() > 3 ? digest(3) : ""});
      } else if (m_words[0] == "limit") {
        read_limit();
      } else {
        m_is_line_pending = true;
        return;
      }
    }
  }

  void read_limits()
  {
    std::size_t count = 0;
    for (; next_line(); ++count) {
      if (m_words[0] != "limit")
        fail("only lines of the form 'limit NAME NUMBER' stand in a file of limits");
      read_limit();
    }
    if (count == 0)
      fail("there is no limit in this file; add one as 'limit NAME NUMBER'");
  }

  bool read(Log_step& step)
  {
    if (m_is_over)
      return false;
    const bool is_after_header = std::exchange(m_is_line_pending, false);
    if (!is_after_header && !next_line())
      fail("the log ends without its 'result' line; it is not complete");
    step.line = m_line_number;
    step.place.reset();
    step.is_removed_first = false;
    step.group.clear();
    if (m_words[0] == "c") {
      read_collapse(step);
    } else if (m_words[0] == "s" || m_words[0] == "w") {
      const bool is_snap = m_words[0] == "s";
      if (m_stage > (is_snap ? 0 : 1))
        fail("snaps come first, then welds, then turns, then collapses");
      m_stage = is_snap ? 0 : 1;
      step.kind = is_snap ? Log_step::Kind::snap : Log_step::Kind::weld;
      if (is_snap) {
        expect_words(3, 3, "s MOVED KEPT");
        step.removed = vertex(1);
        step.kept = vertex(2);
      } else {
        for (std::size_t i = 1; i < m_words.size(); ++i)
          step.group.push_back(vertex(i));
      }
    } else if (m_words[0] == "t") {
      if (m_stage > 2)
        fail("triangles are turned before the first collapse");
      m_stage = 2;
      step.kind = Log_step::Kind::turn;
      for (std::size_t i = 1; i < m_words.size(); ++i)
        step.group.push_back(triangle(i));
    } else if (m_words[0] == "result") {
      expect_words(4, 4, "result COLLAPSES TRIANGLES SHA256");
      result = {number<std::size_t>(1), number<std::size_t>(2), digest(3)};
      m_is_over = true;
      if (next_line())
        fail("nothing comes after the 'result' line");
      return false;
    } else if (is_of_header(m_words[0])) {
      fail("the line '" + std::string(m_words[0]) +
           (is_after_header ? "' stands here for the second time; leave one of the two out"
                            : "' comes too late; it belongs before the first snap, weld, turn or collapse"));
    } else {
      fail("a line begins with '" + std::string(m_words[0].substr(0, 20)) +
           "', which this version does not know here");
    }
    return true;
  }

  Log_header header;
  Log_result result;

private:
  [[noreturn]] void fail(const std::string& message) const
  {
    throw Input_error(m_name + ", line " + std::to_string(m_line_number) + ": " + message);
  }

  bool next_line()
  {
    while (std::getline(m_stream, m_line)) {
      m_poll();
      ++m_line_number;
      if (!m_line.empty() && m_line.back() == '\r')
        m_line.pop_back();
      m_words.clear();
      for (std::size_t first = m_line.find_first_not_of(' '); first != std::string::npos;) {
        const std::size_t beyond = std::min(m_line.find(' ', first), m_line.size());
        m_words.push_back(std::string_view(m_line).substr(first, beyond - first));
        first = m_line.find_first_not_of(' ', beyond);
      }
      if (!m_words.empty() && m_words[0][0] != '#')
        return true;
    }
    if (m_stream.bad())
      fail("cannot be read on");
    return false;
  }

  static bool is_of_header(std::string_view word)
  {
    constexpr std::array<std::string_view, 12> words{
        "selvedge-log", "input",   "rounding", "normals", "drop_part", "drop_smaller",
        "dropped",      "defects", "obstacle", "pose",    "limit",     "may_intersect"};
    return std::find(words.begin(), words.end(), word) != words.end();
  }

  /// Reads a line of a key and one of several words. Returns the number of the word.
  std::size_t second_word(const std::vector<std::string>& words) const
  {
    const std::string key(m_words[0]);
    std::string form = key + ' ', names;
    for (const std::string& word : words) {
      form += (word == words.front() ? "" : "|") + word;
      names += (word == words.front() ? "" : word == words.back() ? " or " : ", ") + ("'" + word + "'");
    }
    expect_words(2, 2, form.c_str());
    const auto found = std::find(words.begin(), words.end(), m_words[1]);
    if (found == words.end())
      fail("after '" + key + "' comes " + names);
    return std::size_t(found - words.begin());
  }

  void expect_words(std::size_t least, std::size_t most, const char* form) const
  {
    if (m_words.size() < least || m_words.size() > most)
      fail(std::string("the line does not read '") + form + "'");
  }

  template <class Number>
  Number number(std::size_t word) const
  {
    Number value{};
    const char* const end = m_words[word].data() + m_words[word].size();
    const auto [stop, error] = std::from_chars(m_words[word].data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(double(value)))
      fail("'" + std::string(m_words[word].substr(0, 40)) + "' is not a number that fits here");
    return value;
  }

  Index vertex(std::size_t word) const { return number_below(header.vertices, word, "vertex "); }
  Index triangle(std::size_t word) const { return number_below(header.triangles, word, "triangle "); }

  Index number_below(std::size_t count, std::size_t word, const char* what) const
  {
    const Index value = number<Index>(word);
    if (value >= count)
      fail("there is no " + (what + std::to_string(value)) + "; there are " + std::to_string(count) +
           ", counted from 0");
    return value;
  }

  std::string digest(std::size_t word) const
  {
    std::string text(m_words[word]);
    if (text == "-")
      return {};
    for (char& c : text)
      if (c >= 'A' && c <= 'F')
        c = char(c - 'A' + 'a');
    if (text.size() != 64 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
      fail("a SHA-256 is written in 64 hexadecimal digits, or '-' when unknown");
    return text;
  }

  std::string part_name(std::size_t word) const
  {
    const std::string_view text = m_words[word];
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
      unsigned char byte = static_cast<unsigned char>(text[i]);
      if (text[i] == '%') {
        const char* const end = text.data() + std::min(i + 3, text.size());
        const auto [stop, error] = std::from_chars(text.data() + i + 1, end, byte, 16);
        if (error != std::errc() || stop != text.data() + i + 3)
          fail("after a '%' in a name come two hexadecimal digits");
        i += 2;
      } else if (!is_plain(text[i])) {
        fail("a name has a byte that is to be written as '%' and two hexadecimal digits");
      }
      name += char(byte);
    }
    return name;
  }

  template <class Mesh>
  void read_mesh(Mesh& mesh, const char* form) const
  {
    expect_words(4, 4, form);
    mesh.vertices = number<std::size_t>(1);
    mesh.triangles = number<std::size_t>(2);
    mesh.sha256 = digest(3);
  }

  void read_limit()
  {
    expect_words(3, 3, "limit NAME NUMBER");
    std::string known;
    for (const Limit_description& limit : limit_descriptions) {
      known += (known.empty() ? "" : ", ") + std::string(limit.key);
      if (m_words[1] != limit.key)
        continue;
      std::optional<double>& value = header.limits.*limit.value;
      if (value)
        fail(std::string("the limit ") + limit.key + " is declared twice");
      value = number<double>(2);
      if (*value < 0)
        fail("a limit is not negative");
      return;
    }
    fail("there is no limit called '" + std::string(m_words[1].substr(0, 20)) + "'; there are " + known);
  }

  void read_collapse(Log_step& step)
  {
    m_stage = 3;
    step.kind = Log_step::Kind::collapse;
    if (m_words.size() != 3 && m_words.size() != 6 && m_words.size() != 7)
      fail("the line does not read 'c REMOVED KEPT [X Y Z [FIRST]]'");
    step.removed = vertex(1);
    step.kept = vertex(2);
    if (m_words.size() == 3)
      return;
    step.place = {number<double>(3), number<double>(4), number<double>(5)};
    if (m_words.size() == 7) {
      if (m_words[6] != "removed" && m_words[6] != "kept")
        fail("what moves first is 'removed' or 'kept'");
      step.is_removed_first = m_words[6] == "removed";
    }
  }

  std::istream& m_stream;
  Cancellation_poll m_poll;
  std::string m_name;
  std::string m_line;
  std::vector<std::string_view> m_words;
  std::size_t m_line_number = 0;
  int m_stage = 0; // 0 snaps, 1 welds, 2 turns, 3 collapses
  bool m_is_line_pending = false;
  bool m_is_over = false;
};

Log_reader::Log_reader(std::istream& stream, const std::string& name)
    : m_implementation(std::make_unique<Implementation>(stream, name))
{
  m_implementation->read_header();
}

Log_reader::~Log_reader() = default;

const Log_header& Log_reader::header() const
{
  return m_implementation->header;
}
bool Log_reader::read(Log_step& step)
{
  return m_implementation->read(step);
}
const Log_result& Log_reader::result() const
{
  return m_implementation->result;
}

Reduction_limits read_limits(std::istream& stream, const std::string& name)
{
  Log_reader::Implementation lines(stream, name);
  lines.read_limits();
  return lines.header.limits;
}

} // namespace selvedge
