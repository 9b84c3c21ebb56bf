// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_CELLS_H
#define SELVEDGE_CELLS_H

#include <selvedge/Triangle_soup.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace selvedge {

/// \file
/// Cuts a mesh that is too large for one machine into pieces, and joins the pieces again once each has been
/// reduced by itself, on any machine and by any program.
///
/// Space is divided into *cells*: open boxes, of which no two meet, and whose closures fill all space. The
/// *piece* of a cell has every face of the mesh whose bounding box meets the closure of the cell. A face is
/// *free* in the cell when its three corners are strictly inside, and *fixed* otherwise. So a face may be
/// fixed in several pieces, and is free in at most one.
///
/// **The contract of a piece.** Whoever reduces a piece may do with it what he likes, as long as
/// 1. every fixed face is still there, with the same three positions, bit for bit (−0 equals 0), in the same
///    order around it, and as often as before; one with two corners at one position may go,
/// 2. every other face has its three corners strictly inside the cell,
/// 3. no pair of faces offends (verify.h) that did not offend before,
/// 4. the pieces of the mesh, in the sense of verify.h, match those from before (`match_pieces`).
///
/// **Guarantees** `Cell_join` checks 1 to 3 exactly and 4 as `match_pieces` does, and refuses a piece that
/// breaks one of them. So:
/// 1. *Embedded* (G1): the offending pairs of the joined mesh are among those of the whole; there are none
///    when the whole was embedded. docs/guarantees.md proves it.
/// 2. *Motion* (G2): when each piece was reduced by `simplify_soup` with its fixed faces kept and
///    `Placement::vertices`, no layer has passed through another, in the whole either. What another program
///    did on the way is not judged.
/// 3. *Complete*: pieces that were not reduced give the faces of the whole again, each once.

/// An open box, unbounded where its sides are infinite.
struct Cell
{
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  std::array<double, 3> low{-infinity, -infinity, -infinity};
  std::array<double, 3> high{infinity, infinity, infinity};

  /// Returns whether a point is strictly inside.
  bool contains(const Point_3& p) const
  {
    for (std::size_t i = 0; i < 3; ++i)
      if (!(low[i] < p[int(i)] && p[int(i)] < high[i]))
        return false;
    return true;
  }

  /// Returns whether a closed box meets the closure of this one.
  bool touches(const CGAL::Bbox_3& box) const
  {
    for (std::size_t i = 0; i < 3; ++i)
      if (!((box.min)(int(i)) <= high[i] && (box.max)(int(i)) >= low[i]))
        return false;
    return true;
  }
};

/// A piece that `cut_into_cells` has written.
struct Cell_piece
{
  Cell cell;
  std::filesystem::path file;
  std::size_t vertices = 0;
  std::size_t faces = 0; ///< of the file: polygons count once
  std::size_t fixed_faces = 0;
};

/// One of the first two is to be given, and at least 1. Fewer cells come out where a mesh has too few
/// vertices apart.
struct Cut_options
{
  std::optional<std::size_t> cells;
  std::optional<std::size_t> faces_per_cell; ///< about how many free faces a cell has

  /// How far the walls are moved, as a share of a cell, from 0 to less than 1. Where it is not 0, there is
  /// one cell more: the first one is this share of a cell, and the last one the rest. What was fixed at the
  /// walls of one cut so becomes free in the next.
  double shift = 0;
};

/// What a mesh was cut into.
struct Cut_mesh
{
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::vector<Cell_piece> pieces;   ///< of the cells that some face meets
  std::vector<std::string> ignored; ///< what the file has and the pieces do not
};

/// The properties that a piece has besides those of the mesh: for every vertex its number in the whole, and
/// for every face 1 where it is fixed, else 0.
constexpr std::string_view vertex_in_whole_property = "vertex_in_whole", fixed_property = "fixed";

/// Cuts a mesh into cells, and writes the piece of each as a binary PLY file, to `name_of_piece(i)` for the
/// i-th of them, counted from 1. Walls stand at medians of the vertices, so that cells have about the same
/// number of them.
///
/// A little-endian binary PLY file is not read into memory: its rows are copied as they are, with all
/// properties of vertices and faces. Meshes of other formats are read as by `read_mesh`, and keep what a PLY
/// file can hold.
///
/// **Complexity** The file is passed twice, and its faces are written to a temporary file beside the pieces.
/// Memory: that of the largest piece, about 40 bytes a face, and 64 KiB a cell. The system keeps in memory
/// what it can of the file.
///
/// Throws `Argument_error` when an option is out of range, `Input_error` when the mesh cannot be read, has
/// more than 2^32 − 2 vertices, or is a piece already, and `Output_error` when a file cannot be written.
Cut_mesh cut_into_cells(const std::filesystem::path& mesh, const Cut_options& options,
                        const std::function<std::filesystem::path(std::size_t)>& name_of_piece);

/// Joins reduced pieces, one after another.
class Cell_join
{
public:
  /// `cells` are those of the pieces, in their order.
  explicit Cell_join(std::vector<Cell> cells);

  /// Adds a piece: as it was cut, and what it was reduced to. `piece_name` and `result_name` are for
  /// messages. Vertices of fixed faces are one in the joined mesh when they were one in the whole.
  ///
  /// Throws `Input_error`, which names the file, the face and the mend, when the result breaks the contract.
  ///
  /// **Complexity** As `offending_pairs` and `match_pieces`.
  void add(std::size_t cell, const Triangle_soup& piece, Triangle_soup result, const std::string& piece_name,
           const std::string& result_name);

  /// Returns the joined mesh, in the order in which the pieces came. It has the attributes that all results
  /// have. To be called once, when all pieces are there.
  Triangle_soup take();

  /// The offending pairs that were found in the results, all of which the pieces had before. A pair of fixed
  /// faces counts in every piece.
  std::size_t pairs() const { return m_pairs; }

  /// The attributes that some results have and others do not, and the joined mesh so has not.
  const std::set<std::string>& lost_attributes() const { return m_lost; }

private:
  void append(Triangle_soup part);
  void keep_common_attributes(std::vector<Attribute>& of_whole, std::vector<Attribute>& of_part);

  std::vector<Cell> m_cells;
  Triangle_soup m_whole;
  std::unordered_map<Index, Index> m_vertices; // by their numbers in the mesh that was cut
  std::size_t m_pairs = 0;
  std::set<std::string> m_lost;
};

} // namespace selvedge

#endif // SELVEDGE_CELLS_H
