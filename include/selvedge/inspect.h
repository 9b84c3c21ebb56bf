// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_INSPECT_H
#define SELVEDGE_INSPECT_H

#include <selvedge/Border_gaps.h>
#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>
#include <selvedge/prepare.h>
#include <selvedge/verify.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

// Says what a mesh is, and what a reduction would find in it, before anything is reduced.

namespace selvedge {

/// Which normals a file has.
enum class Normals_of_file {
  none,
  per_face,   ///< those of flat shading, as `has_flat_normals` says
  per_vertex, ///< one for all corners at a vertex number
  per_corner  ///< several at some vertex
};

/// What a file names and holds, apart from its shape.
struct Contents
{
  Mesh_format format = Mesh_format::obj;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::vector<std::string> groups, objects, materials; ///< the names that triangles have
  std::vector<std::string> images;                     ///< of a glTF file, by name, address or number
  std::vector<std::string> material_libraries;         ///< of an OBJ file
  std::size_t texture_coordinates = 0;
  Normals_of_file normals = Normals_of_file::none;
  std::vector<std::string> attributes; ///< names of all others, of vertices and then of triangles

  /// Names of those that only some primitives of a glTF file have, and of those that all have, but not in one
  /// type. Such attributes stay in glTF files, and are no columns of the soup.
  std::vector<std::string> attributes_of_some_primitives, attributes_of_different_types;
};

/// Returns what a file holds. **Complexity** O(n).
Contents contents_of(const Mesh_file& file);

/// Triangles that are connected by positions, as coincident borders are when a reduction sews them.
struct Connected_surface
{
  /// Its counts, with one vertex for each position.
  Piece shape;

  /// Edges of exactly two faces that face opposite ways.
  std::size_t misoriented_edges = 0;

  /// The nearest other surface, by number, and the distance to it. None when there is no other.
  std::optional<Index> nearest;
  double distance = 0;

  /// Returns whether every edge has two faces.
  bool is_closed() const { return shape.border_edges == 0 && shape.non_manifold_edges == 0; }

  /// Returns the number of handles, for a closed surface whose faces all face the same way and whose Euler
  /// characteristic is that of such a surface.
  std::optional<std::size_t> genus() const;
};

/// What is in a mesh. Triangles with two corners at one position count for `left_out_faces` alone, because a
/// reduction leaves them out; triangle numbers are those of the mesh without them.
struct Inspection
{
  std::size_t vertices = 0;
  std::size_t unused_vertices = 0;     ///< of no triangle
  std::size_t joined_corners = 0;      ///< by `share_vertices_without_normals`, before all that follows
  std::size_t coincident_vertices = 0; ///< at the position of an earlier one
  std::size_t faces = 0;
  std::size_t left_out_faces = 0;
  double diagonal = 0; ///< of the bounding box of the triangles, in the unit of the file

  /// What a reduction does with the normals. Those that are made anew make no seams.
  Normals_treatment normals = Normals_treatment::none;

  /// Pieces, connected by vertex numbers, in the order of their first triangles.
  std::vector<Piece> pieces;

  /// Faces that a reduction turns because they run against the others of their surface, and the numbers of
  /// their pieces, ascending.
  std::size_t turned_faces = 0;
  std::vector<Index> turned_pieces;

  /// Edges at which that does not help: of exactly two faces that face opposite ways, by position. And the
  /// numbers of the pieces that have such edges, ascending.
  std::size_t misoriented_edges = 0;
  std::vector<Index> misoriented_pieces;

  /// Surfaces, connected by positions, in the order of their first triangles.
  std::vector<Connected_surface> surfaces;

  /// All offending pairs, exactly.
  std::vector<Offending_pair> pairs;
  std::size_t fixed_faces = 0; ///< faces whose corners all cannot move; a ratio is of the others

  /// How many vertices of the sewn mesh may move how, at the beginning.
  struct Vertices
  {
    std::size_t free = 0;         ///< along any edge
    std::size_t on_lines = 0;     ///< along a border or seam
    std::size_t ends = 0;         ///< not at all: ends and junctions of borders and seams
    std::size_t non_manifold = 0; ///< not at all: their faces cannot be joined to one fan
    std::size_t misoriented = 0;  ///< not at all: at edges whose faces face opposite ways
  };
  Vertices movable;

  /// Edges of the sewn mesh that are kept as lines, with surface on both sides; and across how many of them
  /// each of these differs.
  struct Seams
  {
    std::size_t edges = 0;
    std::size_t by_vertices = 0; ///< vertex numbers: a seam between pieces, or one that the format needs
    std::size_t by_texture = 0;
    std::size_t by_normals = 0;
    std::size_t by_labels = 0;  ///< groups, objects or materials
    std::size_t by_regions = 0; ///< values of faces that are the same in large regions
    std::size_t by_doubles = 0; ///< the number of faces with the same corners, or how they run
    std::map<std::string, std::size_t> by_attributes; ///< `seams_of_attributes`, but for texture
  };
  Seams seams;

  std::size_t border_edges = 0;

  /// The gaps between borders, and the length that `Open_seams::weld` would weld.
  Border_gaps border_gaps;
};

/// Returns the attributes because of which alone edges of two triangles are seams, and of how many: those
/// that differ between the vertices on the two sides, where neither position, normals, labels nor another
/// attribute do, and those of faces that tell regions apart (they differ across at most a sixteenth of such
/// edges). They have the names of the file, and texture coordinates are `texture`, as `drop_attributes` takes
/// them; those of morph targets are followed by "of morph targets". What `drop_attributes` leaves out
/// together counts as one: colours, each of them, and all texture coordinates with the tangents, as
/// `texture`, or, where the first are alike, as `further_texture_coordinates`. Of triangles with the same
/// corners, the first one counts. **Complexity** O(n log n).
std::map<std::string, std::size_t> seams_of_attributes(const Prepared_soup& prepared);

/// Inspects a mesh as the program would treat it with default options: with the choice of normals that suits
/// it (`suited_to`), and with fewer vertices where that joins those of a file that has one normal for each
/// vertex (`share_vertices_without_normals`).
///
/// Throws `Input_error` when the mesh has no triangle, or when all have two corners at one position.
///
/// **Exactness** Offending pairs, pieces, surfaces, and which vertices may move are exact. Distances are
/// computed in double: that of two surfaces is 0 when a pair of their triangles offends. Otherwise it is
/// positive, the least distance of corners, edges and faces of any two of their triangles, rounded. Distances
/// between parts of one surface, such as its folds, are not computed.
///
/// **Complexity** O(n log n) as a rule; more where many triangles lie at nearly the least distance.
Inspection inspect(Triangle_soup soup, bool has_normals_of_vertices = false);

} // namespace selvedge

#endif // SELVEDGE_INSPECT_H
