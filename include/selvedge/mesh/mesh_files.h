// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_MESH_FILES_H
#define SELVEDGE_MESH_MESH_FILES_H

#include <selvedge/mesh/Triangle_soup.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge {

/// \file
/// Mesh files to and from a `Triangle_soup`, with positions that are the same doubles on both sides.
///
/// **Guarantees**
/// 1. *Read*: a decimal in a text file (OBJ, OFF, ascii PLY and STL) becomes the double nearest to it, also
///    where the file declares a narrower type for it; a binary number becomes the double of the same value.
/// 2. *Written* (G3): `read_mesh(p)` after `write_mesh(p, soup)` gives the same coordinates bit for bit, the
///    same triangles in the same order, and the same number of every vertex. STL, which has no vertex
///    numbers, gives the same triangles up to those numbers (and the sign of zeros).
/// 3. *Refusal* (G9): a file that is not a mesh with at least one triangle and finite coordinates is refused
///    with an `Input_error` of one line that names file, line (in text), element and mend. No content of a
///    file, however damaged, does anything else, and no count in it is believed before the bytes are there.
/// 4. *Atomicity* (G9): a file appears whole or not at all; see `write_mesh`.
/// 5. What a file holds and the soup does not is said in `Read_notes`, what a soup holds and a format does
///    not by `not_carried`.
///
/// **Faces.** A face of more than three corners is cut into triangles by one rule: ears are cut off in turn,
/// the second corner being tried first. On a convex polygon that is the fan of its first corner; on any other
/// simple polygon it gives triangles that neither overlap nor degenerate. It is decided exactly on the
/// projection to one of the coordinate planes, the one in which the polygon looks largest if that works out,
/// else another one. A polygon that looks simple in none of them becomes the fan of its first corner. Faces
/// of fewer than three corners are skipped and counted. Faces that name a vertex twice are kept: a soup may
/// hold degenerate triangles.
///
/// **Scenes.** The position of a vertex of a glTF file, which is what is reduced and judged, is its world
/// position in doubles:
///
///     ((G_0 x + G_1 y) + G_2 z) + G_3        for each row G of the global matrix of its node
///
/// with (x, y, z) the 32-bit floats of the file. The global matrix is the product P L of the parent's and the
/// node's own, its entries (P_0 L_0 + P_1 L_1) + P_2 L_2, and + P_3 in the last column; at a root, P is the
/// identity. L is `matrix`, or from `translation` t, `rotation` (x, y, z, w) and `scale` s the matrix with
/// the columns R_j s_j and t, where R has 1 − 2 (y y + z z), 2 (x y − z w), 2 (x z + y w) as its first row,
/// and so on, not normalised. Every operation is rounded to double, in this order. A skinned mesh is taken in
/// its bind pose, that is with the identity for G: its node does not move it, as the format says. Morph
/// targets are carried along and not guarded, animations likewise. Nodes that mirror have their triangles
/// turned over, so that outside is outside.
///
/// Written to glTF again, every vertex has its rows of every accessor of its primitive and of its morph
/// targets bit for bit, so that its world position is the same double. All else in the document stays as it
/// is, images byte for byte, addresses of files unchanged, and numbers of accessors and buffer views too; but
/// a mesh that several nodes share is one for each from then on, accessors of triangles are written in full
/// and without gaps, and all buffers are one. Primitives of points or lines and meshes outside the scene stay
/// as they are. Primitives and meshes without a triangle left are gone.
///
/// **Complexity.** Time is linear in the size of the file, but quadratic in the number of corners of a polygon.
/// Memory is linear, with two exceptions: a glTF scene may show a part in many of its nodes, and a polygon in a
/// PLY file gives its attributes to each of its triangles. Where these take more than 64 times the size of the
/// file, it is refused.

enum class Mesh_format { obj, off, ply, stl, glb, gltf };

/// The format that a path's extension names (`.obj`, `.off`, `.ply`, `.stl`, `.glb`, `.gltf`, in any case).
/// Throws `Input_error` when it names none of them.
Mesh_format mesh_format(const std::filesystem::path& path);

/// Whether every file of this format holds its positions as 32-bit floats, as STL and glTF do: what is
/// written there must be rounded before it is judged (`round_to_float32`). PLY holds floats when that loses
/// nothing, else doubles.
bool stores_float32(Mesh_format format);

/// Whether positions of this soup must be 32-bit floats to be written in this format: where it stores those,
/// unless the soup goes from glTF to glTF, which has them already, though its positions in the scene are
/// doubles.
bool needs_float32(const Triangle_soup& soup, Mesh_format format);

/// For every vertex of a soup from a glTF file the number of the transform that it is under; empty for any
/// other soup. A vertex may be given the position of another only under the same transform, for else the file
/// cannot hold it.
std::vector<Index> transforms_of_vertices(const Triangle_soup& soup);

/// What the author of a file may want to know about how it was read.
struct Read_notes
{
  std::size_t polygons_cut = 0;     ///< Faces of more than three corners, each cut into triangles.
  std::size_t repeated_corner = 0;  ///< Faces that name a vertex more than once; kept.
  std::size_t fewer_than_three = 0; ///< Faces of fewer than three corners; skipped.

  /// What was taken otherwise than it stands in the file, and how often.
  std::map<std::string, std::size_t> remarks;

  /// What the soup does not hold, by name, and how often it stands in the file.
  std::map<std::string, std::size_t> ignored;
};

/// The notes as lines for a person, each ending in a count; none when there is nothing to say.
std::vector<std::string> describe(const Read_notes& notes);

struct Mesh_file
{
  Triangle_soup soup;
  Mesh_format format = Mesh_format::obj;
  Read_notes notes;
};

/// Reads a mesh; its extension says the format.
///
/// - OBJ: `v` with a weight (attribute `w`) or a colour (`red`, `green`, `blue`, `alpha`), `vt` of one or two
///   numbers (the second is 0 when there is none; a third that is not 0 is noted), `vn`, `f` with absolute
///   and relative indices, `o`, `g`, `usemtl`, `s`, `mtllib`. A label of a triangle is the whole text of the
///   latest such statement above it without blanks at its ends (a `g` of several names is one label), and
///   empty above the first. A backslash at the end of a line, outside comments, counts as a blank.
/// - OFF: one vertex or face to a line; further columns are ignored.
/// - PLY: ascii and both binary kinds; elements in any order. Of vertices, `nx ny nz` are normals, `s t`, `u
/// v` or
///   `texture_u texture_v` texture coordinates; of faces, a list `texcoord` of two numbers per corner is,
///   in place of those. All other numbers are attributes of the type that the header says; a number in text
///   that is not of it is refused. Other lists and other elements are noted. Triangles of a polygon have its
///   attributes.
/// - STL: ascii and binary. Corners of identical coordinates (−0 equals 0) are one vertex, which has the
///   coordinates of the first of them; vertices are numbered by their first corner.
///
/// - GLB, glTF 2.0: all triangles of the scene (strips and fans too) as one soup in world space; see
/// **Scenes** below.
///   A group is a primitive in a node, named after the node, or after the mesh where the node has no name; a
///   material is one of the file. Texture coordinates are those of TEXCOORD_0, the second taken from 1 since
///   it points down there, normals are turned with their nodes, COLOR_0 is a colour, and other attributes are
///   carried where all vertices have them in the same form. Vertices without indices are one where they agree
///   in every attribute. Buffers are in the file, in data addresses, or in files relative to its folder (none
///   when read from memory). Refused, by name: compressed and quantised meshes, instances by extension,
///   unknown extensions that the file requires.
///
/// Vertices in messages are counted as the format does: from 1 in OBJ, from 0 elsewhere.
/// Throws `Input_error`.
Mesh_file read_mesh(const std::filesystem::path& path);

/// The same from memory; `name` stands for the file in messages.
Mesh_file read_mesh(std::string_view contents, Mesh_format format, const std::string& name);

enum class Encoding { binary, ascii, binary_big_endian };

struct Write_options
{
  /// For PLY, and for STL (which has no big-endian form: `Argument_error`). Binary is little endian.
  Encoding encoding = Encoding::binary;

  /// Lines of comment at the head of OBJ, OFF and PLY files; STL has no place for any.
  /// Precondition, checked (`Argument_error`): no control characters.
  std::vector<std::string> comments = {};
};

/// Writes a mesh; the path's extension says the format.
///
/// The whole file is written to a new file in the same folder, brought to the disk, and only then renamed to
/// `path`. When anything fails (no room, no permission) that new file is removed, what stood at `path` is
/// untouched, and `Output_error` is thrown; so with `Interrupted` when the call is cancelled, see
/// Cancellation_scope.h. A symbolic link is followed (one that leads nowhere is
/// replaced); what is neither a file nor a link to one (a device, a pipe) is written to directly.
///
/// OBJ and OFF hold the shortest decimals that read back as the same doubles. PLY positions, normals and
/// texture coordinates are `float` when every one of them is, else `double`.
///
/// - OBJ: statements stand before the first face to which they apply, where several do in the order `o`, `g`,
///   `usemtl`, `s`; behind an `o` the others are repeated, which some readers forget there. Colours of a PLY
///   file's integers become fractions. `mtllib` stays as it is, also when the file goes to another folder:
///   `missing_material_libraries` says what then has to be copied there.
/// - PLY: texture coordinates stand at the vertices (`s t`) when they have the numbers of the vertices, else
/// at the
///   faces (`texcoord`). Attributes of several components become as many properties, `name_0`, `name_1`, ...
///
/// - GLB, glTF: a soup that was read from glTF goes back into its document, see **Scenes**. Any other becomes
/// a new one:
///   a node and a mesh for each group, a primitive for each material in it (by name alone), vertices split
///   where corners differ in texture coordinates or normals; these and colours that are no integers are
///   rounded to 32-bit floats. Triangles are ordered by group and material. `.gltf` files hold their buffer
///   in a data address, so that a mesh is one file.
///
/// Preconditions, checked (`Argument_error`): coordinates are finite, and 32-bit floats when the format
/// stores those (`needs_float32`); a soup of a glTF file has its groups, `scene_vertices`, and positions,
/// each of them that of some vertex of the file under the same transform; labels in an OBJ begin and end with
/// no blank, do not end in a backslash, and are one line; names of attributes in a PLY hold no blanks and do
/// not end in a backslash.
void write_mesh(const std::filesystem::path& path, const Triangle_soup& soup,
                const Write_options& options = {});

/// What of this soup a file of that format does not hold, as names; empty when it holds all.
std::vector<std::string> not_carried(const Triangle_soup& soup, Mesh_format format);

/// The files that an OBJ at `path` names as its material libraries and that are not there.
std::vector<std::string> missing_material_libraries(const std::filesystem::path& path,
                                                    const Triangle_soup& soup);

/// Writes any file as `write_mesh` does: whole or not at all. Throws `Output_error`.
void write_file(const std::filesystem::path& path, std::string_view contents);

} // namespace selvedge

#endif // SELVEDGE_MESH_MESH_FILES_H
