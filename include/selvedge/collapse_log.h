// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_COLLAPSE_LOG_H
#define SELVEDGE_COLLAPSE_LOG_H

#include <selvedge/Reduction_limits.h>
#include <selvedge/mesh/Triangle_soup.h>

#include <array>
#include <cstddef>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace selvedge {

/// \file
/// The log of a reduction: every motion of a vertex, in order, so that a program that knows nothing of the
/// one that wrote it can do the same again and judge each step (`replay.h`).
///
/// **The format**, version 1, to the byte. Text in ASCII; a line ends with a line feed (a carriage return
/// before it is ignored); words in a line are separated by one or more blanks. An empty line, and one that
/// begins with `#`, says nothing. Lines come in this order:
///
///     selvedge-log 1
///     input VERTICES TRIANGLES SHA256
///     rounding none|float32                  once at most; none where it is missing
///     obstacle VERTICES TRIANGLES SHA256     once at most
///     limit NAME NUMBER                      any number of them, each name once
///     s MOVED KEPT                           any number of them
///     w VERTEX VERTEX ...                    any number of them
///     c REMOVED KEPT [X Y Z [FIRST]]         any number of them
///     result COLLAPSES TRIANGLES SHA256
///
/// - *Vertices* are 0-based numbers of the input file: in OBJ, OFF and PLY the order of its vertices, used
///   or not; in glTF that in which `read_mesh` finds them, by nodes, then primitives. In STL, which has no
///   vertices, 3 × triangle + corner, any of those at one position.
/// - *input*: vertices of the file (in STL three for each triangle), triangles after polygons were cut as
///   `read_mesh` cuts them, and the SHA-256 of the file's bytes, in 64 hexadecimal digits, or `-` for
///   unknown.
/// - *rounding*: what was done to every coordinate before anything else: nothing, or to the nearest 32-bit
///   float, ties to even.
/// - *obstacle*: a mesh that the writer kept clear of and did not change, as *input* describes a mesh. The
///   log does not hold it, and nobody can judge by it; the line says that there was one.
/// - *limit*: what the writer held itself to, and wants to be held to. NAME is a key of `limit_descriptions`
///   (`normal_change`, `aspect_ratio`, `border_turn`, `seam_turn`, `border_drift`, `weld_distance`), NUMBER
///   is at least 0; `Reduction_limits` has the units. The diagonal is that of the bounding box of the
///   vertices that triangles use, after all snaps. What is not declared is not judged, except that a log
///   with snaps must declare its `weld_distance`. When `border_turn`, `seam_turn` or `border_drift` is
///   declared, vertices of borders and seams must also keep to their lines.
/// - *s*, a snap: the vertices at the position of MOVED go, along a straight line, to that of KEPT, their
///   partner on another border within the weld distance (`snapping.h` says who is a partner); no edge joins
///   the two.
/// - *w*, welding: vertices at one position, which from here on move as one. Vertices at one position always
///   do, stated or not; the line is for readers who would rather not look for them. A writer states all
///   groups or none.
/// - *c*, a collapse: the vertices at the position of REMOVED go to that of KEPT, along their common edge,
///   and merge with it. Where X Y Z is given both go there instead, KEPT first, or REMOVED first when FIRST
///   is `removed`; FIRST may also be `kept`. Numbers are decimal, with a point, and so many digits that they
///   read back as the same double (17 do; the shortest that do are what we write).
/// - *result*: how many c-lines there were, how many triangles are left, and the SHA-256, or `-`, of this
///   text: a line `A B C` and a line feed for every triangle left, in the order of the input, its corners in
///   their order there, each by the smallest number of a vertex that was, before the first c-line, at the
///   position where the corner is now. (A position X Y Z has the number of the vertex that went there as
///   KEPT.)
///
/// Triangles with two corners at one position, at the start or after rounding, are left out of everything
/// but the count in *input*.
///
/// **Complexity** Both directions stream: memory does not grow with the length of the log.

/// How a log numbers the vertices of a soup that was read from a file.
class Log_numbering
{
public:
  Log_numbering(const Triangle_soup& original, bool is_stl);

  std::size_t size() const { return m_vertices.empty() ? m_vertex_count : m_vertices.size(); }
  Index vertex(Index number) const { return m_vertices.empty() ? number : m_vertices[number]; }

  /// The smallest number of a vertex.
  Index number(Index vertex) const { return m_numbers.empty() ? vertex : m_numbers[vertex]; }

private:
  std::size_t m_vertex_count;
  std::vector<Index> m_vertices, m_numbers; // empty where both are the same
};

/// What a log says before its first motion.
struct Log_header
{
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::string sha256; ///< of the file; empty when unknown
  bool is_rounded_to_float32 = false;

  /// A mesh beside the input that the writer kept clear of.
  struct Obstacle
  {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::string sha256; ///< of the file; empty when unknown
  };
  std::optional<Obstacle> obstacle;

  Reduction_limits limits;
};

/// A line that moves or welds.
struct Log_step
{
  enum class Kind { snap, weld, collapse };

  Kind kind = Kind::collapse;
  Index removed = 0; ///< of a snap: what moves
  Index kept = 0;
  std::optional<std::array<double, 3>> place; ///< where both go, if not to where KEPT is
  bool is_removed_first = false;
  std::vector<Index> group; ///< of a weld
  std::size_t line = 0;     ///< counted from 1; set by the reader
};

/// What a log says after its last motion.
struct Log_result
{
  std::size_t collapses = 0;
  std::size_t triangles = 0;
  std::string sha256; ///< empty when unknown
};

/// Writes a log to a stream that outlives the writer.
class Log_writer
{
public:
  Log_writer(std::ostream& stream, const Log_header& header);

  void write(const Log_step& step);
  void write(const Log_result& result);

private:
  std::ostream& m_stream;
};

/// Reads a log from a stream that outlives the reader. Whatever is no log of this version, in whatever line,
/// is an `Input_error` that names `name`, the line and the mend.
class Log_reader
{
public:
  /// Reads the header.
  Log_reader(std::istream& stream, const std::string& name);
  ~Log_reader();

  const Log_header& header() const;

  /// The next motion or weld; false after the last, when `result` is known.
  bool read(Log_step& step);

  const Log_result& result() const;

private:
  friend Reduction_limits read_limits(std::istream& stream, const std::string& name);

  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

/// Reads `limit` lines, as a log's header has them, and nothing else but empty lines and those that begin
/// with `#`. Throws `Input_error`, which names `name` and the line, where there is anything else, and when
/// there is no limit.
Reduction_limits read_limits(std::istream& stream, const std::string& name);

} // namespace selvedge

#endif // SELVEDGE_COLLAPSE_LOG_H
