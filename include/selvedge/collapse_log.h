// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_COLLAPSE_LOG_H
#define SELVEDGE_COLLAPSE_LOG_H

#include <selvedge/Reduction_limits.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/drop_parts.h>
#include <selvedge/normals.h>

#include <array>
#include <cstddef>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace selvedge {

/// \file
/// The log of a reduction. It lists every motion of a vertex, in order, so that a program that knows nothing
/// of the one that wrote the log can repeat each step and judge it (`replay.h`).
///
/// **The format**, version 1, to the byte. A log is ASCII text. A line ends with a line feed; a carriage
/// return before it is ignored. Words in a line are separated by one or more blanks. Empty lines and lines
/// that begin with `#` are ignored. The other lines come in this order:
///
///     selvedge-log 1
///     input VERTICES TRIANGLES SHA256
///     rounding none|float32                  once at most; none where it is missing
///     normals kept|joined|ignored|dropped|smooth|smooth_shared|soft|soft_shared|hard|loose_shared
///                                            once at most; kept where it is missing
///     drop_part PART                         any number of them
///     drop_smaller NUMBER                    once at most
///     dropped NAME                           any number of them
///     defects freeze|descend                 once at most; freeze where it is missing
///     may_intersect PART PART                any number of them
///     obstacle VERTICES TRIANGLES SHA256     once at most
///     pose NAME SHA256 [OBSTACLE]            any number of them
///     limit NAME NUMBER                      any number of them, each name once
///     s MOVED KEPT                           any number of them
///     w VERTEX VERTEX ...                    any number of them
///     t TRIANGLE TRIANGLE ...                any number of them
///     c REMOVED KEPT [X Y Z [FIRST]]         any number of them
///     result COLLAPSES TRIANGLES SHA256
///
/// - *Vertices* are given by their 0-based numbers in the input file. In OBJ, OFF and PLY these follow the
///   order of the vertices in the file, used or not; in glTF they follow the order in which `read_mesh` finds
///   vertices, by nodes, then primitives. STL has no vertices: there, the number is 3 × triangle + corner, of
///   any corner at the position.
/// - *input*: the number of vertices of the file (in STL three for each triangle), the number of triangles
///   after polygons were cut as `read_mesh` cuts them, and the SHA-256 of the file's bytes, in 64 hexadecimal
///   digits, or `-` when unknown.
/// - *rounding*: what was done to every coordinate before anything else: nothing, or rounding to the nearest
///   32-bit float, ties to even.
/// - *normals*: whether an edge across which the normals of the input differ is a line, like one across which
///   texture coordinates or materials do. Normals that are nearly alike at a vertex may have become one
///   first (`join_near_normals`), or smooth ones may have taken the place of all (`smooth_normals`), or those
///   of a vertex on a soft line (`loosen_soft_lines`) or between two hard edges
///   (`join_normals_between_hard_edges`) may have become one; all this follows from the input. They are
///   ignored when the writer makes the normals anew and keeps no edge for them. Where they are dropped, or
///   smooth and shared, vertices that differ in nothing else are one (`share_vertices_without_normals`),
///   before anything else is done; where they are soft and shared, those on soft lines. Where they are loose
///   and shared, they are ignored, and such vertices are one. The side of TANGENT keeps vertices apart unless
///   normals are dropped.
/// - *drop_part*, *drop_smaller*: what the writer left out before anything else (`drop_parts`): all triangles
///   of a part, and those that positions connect to nothing as large as NUMBER, which is positive, in the
///   unit of the file. PART is written as in *may_intersect*.
/// - *dropped*: an attribute that the writer left out, before all that follows (`drop_attributes`).
///   Vertices that differ in nothing else are one, and no edge is a line because of it. NAME is written as in
///   *may_intersect*.
/// - *defects*: what becomes of the offending pairs of the input. Their triangles stay as they are, or the
///   pairs and all that descend from them are exempt (`pairs_without_descent` of verify.h says which do). A
///   degenerate triangle is then removed or stays as it is.
/// - *may_intersect*: two parts of the input that the writer was asked to let intersect, each by the name of
///   a group, object or material or by one of its words. Of names, blanks, control bytes, `%` and bytes from
///   127 on are written as `%` and two hexadecimal digits. No triangle of one part has, at the start, a
///   corner where a triangle of the other has one. Pairs between the two are not judged.
/// - *obstacle*: a mesh that the writer kept clear of and did not change: the numbers of its vertices and
///   triangles, as `read_mesh` finds them, and the SHA-256 of its file, as in *input*. The log does not hold
///   its triangles; `replay` judges them when it is given the mesh (`Replay_options::obstacle`). It is not
///   rounded.
/// - *pose*: a further pose of the input, in which the steps are legal, too: every vertex has another place
///   there, and moves along its own segment. NAME is written as in *may_intersect*. The SHA-256 is of the
///   places of all vertices in their order, before rounding: for each its coordinates as 64-bit IEEE floats,
///   the least significant byte first, −0 as 0. OBSTACLE is the SHA-256 of the places of the obstacle's
///   vertices in this pose, made alike; it may be missing, or `-` when unknown. Snaps and new places (X Y Z)
///   do not go together with poses.
/// - *limit*: a limit that the writer kept to, and by which it wants to be judged. NAME is a key of
///   `limit_descriptions` (`normal_change`, `aspect_ratio`, `border_turn`, `corner_height`, `seam_turn`,
///   `border_drift`, `weld_distance`, `clearance`). NUMBER is at least 0; `Reduction_limits` has the units.
///   The diagonal is that of the bounding box of the vertices that triangles use, after all snaps. A limit
///   that is not declared is not judged, except that a log with snaps must declare its `weld_distance`, and
///   that `corner_height` only eases `border_turn` and `normal_change`: a border may turn by any angle where
///   every vertex that it has had lies within this height of the segment that replaces it, and the normal of
///   a triangle where its corner that moves lies within this height of the line through the others before and
///   after; without it, they may not. When
///   `border_turn`, `seam_turn` or `border_drift` is declared, vertices of borders and seams must also stay
///   on their lines.
/// - *s*, a snap: the vertices at the position of MOVED go in a straight line to the position of KEPT, their
///   partner on a border within the weld distance (`Prepare_options::weld_distance` defines partners). No
///   edge joins the two.
/// - *w*, a group of coincident vertices, which move together from here on. Coincident vertices always do,
///   stated or not; the line spares readers the search for them. A writer states all groups or none.
/// - *t*, triangles that run against the others of their surface, by their 0-based numbers among those that
///   are not dropped and have corners at three positions. From here on the second and the third corner of
///   each change places, so that the sides at an edge run opposite ways: such an edge is no border. Nothing
///   moves by that, and the text for *result* has the corners in the order of the input.
/// - *c*, a collapse: the vertices at the position of REMOVED go to the position of KEPT, along their common
///   edge, and merge with the vertices there. When X Y Z is given, both go to that place instead: KEPT first,
///   or REMOVED first when FIRST is `removed`. FIRST may also be `kept`. Numbers are decimal, with a point,
///   and with so many digits that they read back as the same double. 17 digits suffice; `Log_writer` writes
///   the fewest that do.
/// - *result*: the number of c-lines, the number of triangles left, and the SHA-256 of the following text, or
///   `-`. The text has a line `A B C`, ended by a line feed, for every triangle left. Triangles are in the
///   order of the input, and so are the corners of each. A corner is given by the smallest number of a vertex
///   that was, before the first c-line, at the position where the corner is now. (A position X Y Z has the
///   number of the vertex that went there as KEPT.)
///
/// Triangles that are dropped, and those with two corners at one position, at the start or after rounding,
/// are left out of everything but the count in *input*.
///
/// **Complexity** Logs are read and written line by line: memory does not grow with their length.

/// Returns what a log says of a pose, by the places of all vertices in it.
std::string digest_of(const std::vector<Point_3>& places);

/// Converts between the vertices of a soup that was read from a file, and their numbers in a log. The two
/// differ for STL alone.
class Log_numbering
{
public:
  Log_numbering(const Triangle_soup& original, bool is_stl);

  /// How many numbers there are.
  std::size_t size() const { return m_vertices.empty() ? m_vertex_count : m_vertices.size(); }

  /// Returns the vertex that has a number.
  Index vertex(Index number) const { return m_vertices.empty() ? number : m_vertices[number]; }

  /// Returns the smallest number of a vertex.
  Index number(Index vertex) const { return m_numbers.empty() ? vertex : m_numbers[vertex]; }

private:
  std::size_t m_vertex_count;
  std::vector<Index> m_vertices, m_numbers; // empty when every vertex is its own number
};

/// What a log says of the normals of the input.
enum class Logged_normals {
  kept,          ///< an edge across which they differ is a line
  joined,        ///< those that are nearly alike at a vertex are one, and then kept
  ignored,       ///< it is none
  dropped,       ///< nor is it one, and vertices that differ in nothing else are one
  smooth,        ///< smooth ones have taken their place (`smooth_normals`), and are kept
  smooth_shared, ///< likewise, and vertices that differ in nothing but their normals are one
  soft,          ///< one is none where it is soft (`loosen_soft_lines`)
  soft_shared,   ///< likewise, and vertices on soft lines that differ in nothing but their normals are one
  hard,          ///< an edge is a line where it is hard (`join_normals_between_hard_edges`)
  loose_shared   ///< as dropped, but vertices on different sides of TANGENT are apart
};

/// Returns what a log says of the normals where `share_vertices_without_normals` has made vertices one, for a
/// choice that joins them.
Logged_normals shared_normals(Normals_choice choice);

/// The lines of a log before its first motion.
struct Log_header
{
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::string sha256; ///< of the file; empty when unknown
  bool is_rounded_to_float32 = false;
  Logged_normals normals = Logged_normals::kept;
  Parts_to_drop dropped_parts;
  std::vector<std::string> dropped; ///< attributes that were left out (`drop_attributes`)
  bool may_pairs_descend = false;   ///< the policy for offending pairs is `descend`

  /// The names of parts that may intersect each other.
  std::vector<std::pair<std::string, std::string>> may_intersect;

  /// A mesh beside the input that the writer kept clear of.
  struct Obstacle
  {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::string sha256; ///< of the file; empty when unknown
  };
  std::optional<Obstacle> obstacle;

  /// A further pose in which the steps are legal.
  struct Posed
  {
    std::string name;
    std::string sha256;             ///< of the places of its vertices; empty when unknown
    std::string sha256_of_obstacle; ///< of those of the obstacle; likewise
  };
  std::vector<Posed> poses;

  Reduction_limits limits;
};

/// One line of a log that moves vertices, states a group of coincident ones, or turns triangles.
struct Log_step
{
  enum class Kind { snap, weld, turn, collapse };

  Kind kind = Kind::collapse;
  Index removed = 0; ///< REMOVED of a collapse, or MOVED of a snap
  Index kept = 0;
  std::optional<std::array<double, 3>> place; ///< X Y Z: where both go, if not to the position of KEPT
  bool is_removed_first = false;
  std::vector<Index> group; ///< of a weld: the coincident vertices; of a turn: the triangles
  std::size_t line = 0;     ///< number of the line, from 1; set by the reader
};

/// The last line of a log.
struct Log_result
{
  std::size_t collapses = 0;
  std::size_t triangles = 0;
  std::string sha256; ///< empty when unknown
};

/// Writes a log to a stream. The constructor writes the header. The stream must outlive the writer.
class Log_writer
{
public:
  Log_writer(std::ostream& stream, const Log_header& header);

  void write(const Log_step& step);
  void write(const Log_result& result);

private:
  std::ostream& m_stream;
};

/// Reads a log from a stream, which must outlive the reader. All members throw `Input_error` when a line does
/// not belong in a log of this version. The message has `name`, which stands for the file, the line, and how
/// to mend it.
class Log_reader
{
public:
  /// Reads the header.
  Log_reader(std::istream& stream, const std::string& name);
  ~Log_reader();

  const Log_header& header() const;

  /// Reads the next line that moves, welds or turns. Returns false after the last, when `result` has been
  /// read.
  bool read(Log_step& step);

  const Log_result& result() const;

private:
  friend Reduction_limits read_limits(std::istream& stream, const std::string& name);

  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

/// Reads a file of limits: `limit` lines, as in the header of a log, and lines that are empty or begin with
/// `#`. Throws `Input_error`, which names `name` and the line, when there is anything else, and when there is
/// no limit.
Reduction_limits read_limits(std::istream& stream, const std::string& name);

} // namespace selvedge

#endif // SELVEDGE_COLLAPSE_LOG_H
