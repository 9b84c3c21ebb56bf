// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_MESH_FILES_H
#define SELVEDGE_MESH_FILES_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge {

/// \file
/// Reads mesh files into a `Triangle_soup`, and writes them from it. Positions are the same doubles on both
/// sides.
///
/// **Guarantees**
/// 1. *Read*: a decimal in a text file (OBJ, OFF, ascii PLY and STL) becomes the double nearest to it, also
///    where the file declares a narrower type for it; a binary number becomes the double of the same value.
/// 2. *Written* (G3): `read_mesh(p)` after `write_mesh(p, soup)` gives the same coordinates bit for bit, the
///    same triangles in the same order, and the same number of every vertex. STL, which has no vertex
///    numbers, gives the same triangles up to those numbers (and the sign of zeros); so do PLY and glTF where
///    vertices are split or joined (**Normals**, **Poles**), and glTF where they are compressed as in the
///    file, which may change their order and that of the triangles.
/// 3. *Refusal* (G9): a file that is not a mesh with at least one triangle and finite coordinates is refused
///    with an `Input_error` of one line, which names the file, the line (in text), the element, and how to
///    mend it. Whatever a file contains, however damaged it is, it is either read or refused in this way.
///    Counts in a file are not believed before the bytes are there.
/// 4. *Atomicity* (G9): a file appears whole or not at all; see `write_mesh`.
/// 5. *Losses*: `Read_notes` tells what a file holds and the soup does not; `not_carried` tells what a soup
///    holds and a format does not.
///
/// **Faces.** A face of more than three corners is cut into triangles by one rule: ears are cut off one after
/// another, and the second corner is tried first. A convex polygon so becomes the fan of its first corner;
/// any other simple polygon becomes triangles that neither overlap nor degenerate. Ears are decided exactly,
/// in the projection to a coordinate plane: the plane in which the polygon looks largest, or another one when
/// the polygon is not simple there. A polygon that is simple in none of the projections becomes the fan of
/// its first corner. A face with the corners of an earlier one, as the two sides of a cloth may have them in
/// opposite orders, counts from where that one begins, so that both are cut alike. Faces of fewer than three
/// corners are skipped and counted. Faces that name a vertex twice are kept, because a soup may hold
/// degenerate triangles.
///
/// The soup remembers which of its triangles were one face (`Triangle_soup::polygons`). `write_mesh` writes
/// such a face to OBJ, OFF and PLY as it was, but only if the rule above cuts it again into exactly the
/// triangles of the soup, in the same order, and all of these have the same labels and attributes and the
/// same values at each corner. So guarantee 2 holds for polygons as well: what is read back is the triangles
/// that were written, judged or not. `written_polygons` counts such faces.
///
/// **Scenes.** A vertex of a glTF file is reduced and judged at its world position, in doubles:
///
///     ((G_0 x + G_1 y) + G_2 z) + G_3        for each row G of the global matrix of its node
///
/// Here (x, y, z) are the 32-bit floats of the file. The global matrix is the product P L of the parent's
/// global matrix and the node's own; its entries are (P_0 L_0 + P_1 L_1) + P_2 L_2, and + P_3 in the last
/// column; at a root, P is the identity. L is `matrix`, or, from `translation` t, `rotation` (x, y, z, w) and
/// `scale` s, the matrix with the columns R_j s_j and t, where R has 1 − 2 (y y + z z), 2 (x y − z w), 2 (x z
/// + y w) as its first row, and so on, not normalised. Every operation is rounded to double, in this order.
/// An instance of EXT_mesh_gpu_instancing stands where a child of its node would, with its row of
/// TRANSLATION, ROTATION (normalised integers are fractions, in doubles) and SCALE. Morph targets and
/// animations are carried along; nothing is guaranteed for the shapes that they make, unless they are given
/// as poses (gltf_poses.h).
///
/// A skinned mesh is taken in its bind pose. Its node does not move it, as the format says; instead, G is J B
/// for the first joint of its skin, with the global matrix J and the inverse bind matrix B. If a node before
/// it has a skin with one of the same joints, and that skin the matrix H, then G is (H C⁻¹) D for the first
/// of them, where C and D are its inverse bind matrices in the first such skin and in this one: so meshes of
/// one skeleton stand to each other as they were bound, however the joints are posed. Where J B or H C⁻¹ D
/// differs from the identity, or from the matrix of another skin, only as roundings of 32-bit floats make it,
/// G is that one. It is the identity if J B is singular, or the skin is not as the format demands.
///
/// Triangles of nodes that mirror are turned over, so that outside is outside.
///
/// When a scene is written to glTF again, every vertex that is not at a new place keeps its rows of all
/// accessors, morph targets included, bit for bit, and so its world position. Only NORMAL is what the soup
/// says: the row of a vertex of the file that has this normal, where there is one, else the normal turned
/// back into its node, and rounded to what the file can hold where it has them quantised. TANGENT goes with
/// it, as does what morph targets add to both: they are those of the vertex with this normal or, of those
/// that differ in nothing else, of the one whose normal is nearest. Then the tangent is made perpendicular to
/// the normal, and keeps its side; and what morph targets add is turned by the shortest rotation that takes
/// the old normal to the new one, for TANGENT also the tangent, and scaled as their lengths are, so that the
/// sum is the sum of the file, turned, whatever the weights (negated if the two are opposite; zero stays
/// zero; numbers that the file has quantised are cut off at -1 and 1). Without normals, the file gets neither
/// NORMAL nor TANGENT. The rest of the document stays as it is: images byte for byte, addresses of files,
/// numbers of accessors and buffer views. Accessors that were quantised or compressed are so again, where
/// reading them gives the same numbers; of a vertex at which fans of faces meet, Draco may make one for each
/// fan. Exceptions: a mesh that stands in several places (nodes or instances) becomes several, one for all
/// places in which it has the same triangles of the same vertices, with the normals of the first of them;
/// images in data addresses go into the buffer of a GLB file; instances that have come to differ become
/// nodes, without the extension's own attributes; accessors of triangles are written without gaps, and in
/// full unless the file has nothing but sparse values for them; those that shared a buffer view share one
/// again, one behind the other or, if one level of detail is written, interleaved as they were; buffers
/// become one, and bytes that nothing can refer to go, as do accessors and buffer views at the end of their
/// lists. Primitives of points or lines, and meshes outside the scene, stay as they are. Those without a
/// triangle left are removed.
///
/// Colours of a mesh from another format are written to glTF from 0 to 1, as it has them: red, green and blue
/// are divided by 255 where the largest of all three is more than 2 and at most 255, and none is negative. So
/// is alpha, by itself. Others are cut off at 0 and 1.
///
/// **Normals.** PLY and glTF hold one normal for each vertex, so that a file with a normal for each face has
/// several vertices at every corner of its mesh. Where the normals are flat (normals.h), triangles name the
/// first of the vertices that differ in nothing but the normal, and each corner keeps its own normal, as in
/// OBJ. What goes with the normal need not be alike: the direction of TANGENT, and unless normals are the
/// same, what morph targets add to NORMAL and TANGENT. The others are unused, and all keep their numbers:
/// those of the file, in a log too. Vertices that differ in nothing at all stay apart unless another one
/// differs from them in its normal, or every face has vertices of its own. Writers split such vertices again,
/// in the order that they had, and all other vertices that have several normals.
///
/// **Poles.** glTF also holds one pair of texture coordinates for each vertex, so that around a pole, as of a
/// sphere, every face may have a vertex of its own there. Such vertices, where they differ in nothing but
/// TEXCOORD_0, NORMAL and TANGENT, also of morph targets, are one like those of flat normals: at least three
/// edges lead from them to vertices that the faces on both sides share. A row that texture coordinate and
/// normal do not tell from all others, such as one of several tangents, stays a vertex of its own.
/// `write_mesh` writes each corner to glTF with the row of the file that has its texture coordinates.
///
/// **Packed files.** A file whose name ends in `.gz` is unpacked by zlib when it is read, and packed when it
/// is written; all else is as without `.gz`. A packed file that is damaged or truncated is refused, and so is
/// one whose contents are more than 100 times its size (and 64 KiB): a small file cannot fill the memory.
/// The same mesh gives the same packed bytes.
///
/// **Complexity.** Time is linear in the size of the file, and as a rule O(n log n) for a polygon of n
/// corners; where very many of its triangles are long and lie askew to the axes, as in a narrow strip, O(n²).
/// Memory is linear, with two exceptions: a glTF scene may show a part in many of its nodes, and a polygon in
/// a PLY file gives its attributes to each of its triangles. A PLY file for which these take more than 64
/// times its size (unpacked) is refused, and a glTF file whose instances have more than 2^20 vertices and
/// corners and more than 256 for each byte of its buffers.

enum class Mesh_format { obj, off, ply, stl, glb, gltf };

/// Returns the format that a path's extension names (`.obj`, `.off`, `.ply`, `.stl`, `.glb`, `.gltf`, or
/// `.vrm`, which is a GLB file that holds a VRM avatar; in upper or lower case, also followed by `.gz`).
/// Throws `Input_error` when it names none of them.
Mesh_format mesh_format(const std::filesystem::path& path);

/// Throws `Argument_error` when a path ends in `.vrm`, but the soup comes from no VRM avatar: from a glTF
/// file with the extension `VRM` (version 0) or `VRMC_vrm` (version 1). The functions that write files call
/// it.
void require_avatar(const std::filesystem::path& path, const Triangle_soup& soup);

/// Returns whether a path's extension is `.gz`, in upper or lower case: the file is packed.
bool is_gzip(const std::filesystem::path& path);

/// Returns whether files of this format have one normal for each vertex, as PLY and glTF have, so that they
/// hold several vertices where normals differ.
bool has_normals_of_vertices(Mesh_format format);

/// Returns whether every file of this format holds its positions as 32-bit floats, as STL and glTF do. A mesh
/// that is written to such a format must be rounded (`round_to_float32`) before it is judged. PLY holds
/// floats when that loses nothing, else doubles.
bool stores_float32(Mesh_format format);

/// Returns whether the positions of this soup must be 32-bit floats to be written in this format. That is so
/// for formats that store 32-bit floats, unless the soup goes from glTF to glTF: its positions in the scene
/// are doubles, but the file has 32-bit floats for them.
bool needs_float32(const Triangle_soup& soup, Mesh_format format);

/// What reading a file has changed or left out.
struct Read_notes
{
  std::size_t polygons_cut = 0;     ///< faces of more than three corners, each cut into triangles
  std::size_t repeated_corner = 0;  ///< faces that name a vertex more than once; kept
  std::size_t fewer_than_three = 0; ///< faces of fewer than three corners; skipped

  /// Vertices that triangles name in the file and not in the soup: those that are one with another.
  std::size_t joined_vertices = 0;

  /// What was read otherwise than it stands in the file, and how often.
  std::map<std::string, std::size_t> remarks;

  /// What the file has and the soup does not hold, by name, and how often the file has it.
  std::map<std::string, std::size_t> ignored;
};

/// Returns the notes as lines for a person, each ending in a count; none when there is nothing to say.
std::vector<std::string> describe(const Read_notes& notes);

struct Mesh_file
{
  Triangle_soup soup;
  Mesh_format format = Mesh_format::obj;
  Read_notes notes;
};

struct Read_options
{
  /// The level of detail to read of a glTF file with MSFT_lod, 0 being the finest. A node with fewer levels
  /// is read at its coarsest. `Input_error` when no node has the level, and for other formats when it is not
  /// 0.
  std::size_t level_of_detail = 0;
};

/// Reads a mesh. The path's extension says the format. Lines of text end with a line feed, with a carriage
/// return before it, or, all of them, with a carriage return alone.
///
/// - OBJ: `v` with a weight (attribute `w`) or a colour (`red`, `green`, `blue`, `alpha`), `vt` of one or two
///   numbers (the second is 0 when there is none; a third that is not 0 is noted), `vn`, `f` with absolute
///   and relative indices, `o`, `g`, `usemtl`, `s`, `mtllib`. The label of a triangle is the whole text of
///   the latest such statement above it, without blanks at its ends (a `g` with several names is one label).
///   Above the first statement it is empty. A backslash at the end of a line, outside comments, counts as a
///   blank.
/// - OFF: one vertex or face to a line. Further columns are noted and not read.
/// - PLY: ascii and both binary kinds, with elements in any order. For vertices, `nx ny nz` are normals, and
///   `s t`, `u v` or `texture_u texture_v` are texture coordinates. For faces, a list `texcoord` of two
///   numbers per corner holds texture coordinates; where there is one, those of vertices are attributes. All
///   other numbers are attributes of the type that the header says; a number in text that does not have this
///   type is refused. Other lists and other elements are noted. The triangles of a polygon have its
///   attributes.
/// - STL: ascii and binary. Corners with identical coordinates (−0 equals 0) are one vertex, which has the
///   coordinates of the first of them. Vertices are numbered by their first corners.
/// - GLB, glTF 2.0: all triangles of the scene, those of strips and fans too, as one soup in world space; see
///   **Scenes** above. A group is a primitive in a node. It is named after the node, or after the mesh when
///   the node has no name. A material is one of the file. Texture coordinates are those of TEXCOORD_0; the
///   second is subtracted from 1, because it points down in glTF. Normals are turned with their nodes, and
///   COLOR_0 is a colour, in 32-bit floats where primitives have it in different types. Other attributes are
///   carried when all vertices have them in the same form. In primitives without indices, vertices that agree
///   in every attribute become one. Buffers are in the file, data addresses, or files beside it. Of levels of
///   detail (MSFT_lod) in nodes one is read, and the others are left out. What EXT_meshopt_compression,
///   KHR_draco_mesh_compression (2.2) and KHR_mesh_quantization pack is decoded. KHR_meshopt_compression is
///   passed over where the file has the same data uncompressed. Refused: other required extensions.
///
/// In OBJ, OFF and PLY files of at least 100 triangles, or of quads, in which no two faces share a vertex,
/// corners at one position with the same vertex attributes refer to the first of their vertices, as in STL;
/// the others are unused. Otherwise every face would be a piece of its own.
///
/// Vertices in messages are counted as the format counts them: from 1 in OBJ, from 0 elsewhere.
///
/// Throws `Input_error`.
Mesh_file read_mesh(const std::filesystem::path& path, const Read_options& options = {});

/// Reads a mesh from memory. `name` stands for the file in messages.
Mesh_file read_mesh(std::string_view contents, Mesh_format format, const std::string& name,
                    const Read_options& options = {});

enum class Encoding { binary, ascii, binary_big_endian };

struct Write_options
{
  /// The encoding of PLY and STL files; other formats ignore it. `binary` is little endian. STL has no
  /// big-endian form (`Argument_error`).
  Encoding encoding = Encoding::binary;

  /// Comment lines at the head of OBJ, OFF and PLY files; other formats ignore them. Precondition, checked
  /// (`Argument_error`): no control characters.
  std::vector<std::string> comments = {};

  /// The format; when there is none, the path's extension says it.
  std::optional<Mesh_format> format = std::nullopt;
};

/// What a file got otherwise than the one that its mesh was read from, and how often: all that may make it
/// the larger of the two. Each begins with a noun in the plural. Empty but for glTF.
using Write_notes = std::map<std::string, std::size_t>;

/// Writes a mesh. The path's extension says the format.
///
/// The whole file is written to a new file in the same folder, brought to the disk, and only then renamed to
/// `path`. When anything fails (no room, no permission), the new file is removed, what stood at `path` is
/// untouched, and `Output_error` is thrown. The same happens, with `Interrupted`, when the call is cancelled
/// (Cancellation_scope.h). A symbolic link is followed; one that leads nowhere is replaced. What is neither a
/// file nor a link to one (a device, a pipe) is written to directly.
///
/// OBJ and OFF hold the shortest decimals that read back as the same doubles. PLY positions, normals and
/// texture coordinates are `float` when every one of them is, else `double`.
///
/// - OBJ: a statement stands before the first face to which it applies; several stand in the order `o`, `g`,
///   `usemtl`, `s`. After an `o` the others are repeated, because some readers forget them there. Colours
///   that are integers in a PLY file become fractions. `mtllib` stays as it is, also when the file goes to
///   another folder: `missing_material_libraries` tells what then has to be copied there.
/// - PLY: texture coordinates stand at the vertices (`s t`) when they have the numbers of the vertices and no
///   attribute has these names, else at the faces (`texcoord`). An attribute of several components becomes
///   several properties: `name_0`, `name_1`, ... A vertex with several normals becomes one for each if the
///   normals are flat, and unused vertices then go; other normals of corners are not written.
/// - GLB, glTF: a soup that was read from glTF goes back into its document, see **Scenes** above. Any other
///   soup becomes a new document. It has a node and a mesh for each group, and in it a primitive for each
///   material; of materials it has the names alone. Vertices are split where corners differ in texture
///   coordinates or normals. These, and colours that are no integers, are rounded to 32-bit floats. Triangles
///   are ordered by group and material. `.gltf` files hold their buffer in a data address, so that a mesh is
///   one file.
///
/// **Preconditions**, checked (`Argument_error`): those of `Triangle_soup` but for its polygons, of which
/// those that do not fit are written as triangles; coordinates are finite, and 32-bit floats where
/// `needs_float32` says so. A soup that was read from glTF still has its groups and `scene_vertices`, and
/// each of its positions is that of some vertex of the file under the same transform. Labels in an OBJ file
/// are one line, neither begin nor end with a blank, and do not end in a backslash. Names of attributes in a
/// PLY file hold no blanks and do not end in a backslash.
Write_notes write_mesh(const std::filesystem::path& path, const Triangle_soup& soup,
                       const Write_options& options = {});

/// Writes one mesh in all of its levels of detail, from fine to coarse, to one glTF file with the extension
/// MSFT_lod: reading each of them (`Read_options::level_of_detail`) gives what reading it from a file of its
/// own would give, but for numbers of vertices and nodes. The finest stands in the scene, where it would in a
/// file of its own. Each node of the scene in which levels differ names the nodes of the others, which are
/// outside the scene, are called like it with `_LOD1` and so on, and have its transform, skin, weights and
/// instances. A node that does more than show a mesh (it moves, is a joint, or has children, a camera or an
/// extension) gets a child that does this for it, because a program that shows a level leaves out the node
/// that names it. Animations of morph weights move all levels. Whatever levels have in common stands in the
/// file once. `MSFT_screencoverage`, by which programs choose a level, is the number of triangles of the next
/// level divided by that of the finest, and 0 for the last.
///
/// **Preconditions** beyond those of `write_mesh`, checked (`Argument_error`): there is a level, the format
/// is glTF, and all are reductions of one soup.
///
/// **Not promised** Levels of different nodes side by side: a program may show one node at one level and its
/// neighbour at another, which no judge of a level has seen.
Write_notes write_levels_of_detail(const std::filesystem::path& path,
                                   const std::vector<Triangle_soup>& levels,
                                   const Write_options& options = {});

/// Returns the names of what this soup holds and a file of that format does not; empty when it holds all.
std::vector<std::string> not_carried(const Triangle_soup& soup, Mesh_format format);

/// Returns how many faces of more than three corners `write_mesh` writes to a file of that format.
std::size_t written_polygons(const Triangle_soup& soup, Mesh_format format);

/// Returns the names of the material libraries of this soup that are not there for an OBJ file at `path`.
std::vector<std::string> missing_material_libraries(const std::filesystem::path& path,
                                                    const Triangle_soup& soup);

/// Returns the contents of any file, unpacked when its name ends in `.gz`. `/dev/stdin` and the like stand
/// for the file that is open already, from where it is now. Waiting for a pipe can be cancelled. Throws
/// `Input_error`.
std::string read_file(const std::filesystem::path& path);

/// Writes any contents to a file as `write_mesh` does: whole or not at all, and packed when the name ends in
/// `.gz`. Throws `Output_error`.
void write_file(const std::filesystem::path& path, std::string_view contents);

} // namespace selvedge

#endif // SELVEDGE_MESH_FILES_H
