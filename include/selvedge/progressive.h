// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_PROGRESSIVE_H
#define SELVEDGE_PROGRESSIVE_H

#include <selvedge/Progression.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/mesh_files.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge {

/// \file
/// Writes a reduction with all its steps to one glTF file, and makes any state between from it.
///
/// A progressive file is a glTF file of the finest mesh, which every program reads, with lists in its
/// `extras` that say where each vertex goes and when (docs/progressive.md has the layout). Vertices are in
/// the order in which they go, the last first, so that those of every state are the first of each vertex
/// buffer.
///
/// **Guarantees**
/// 1. *Same*: the state after n steps has the triangles that the reduction had then, in the order of the
///    file, with the same positions, texture coordinates, colours and normals at their corners, bit for bit.
///    So it is what `simplify_soup` gives for that number of faces alone. The numbers of vertices differ.
/// 2. *Whole*: a file holds a digest of its triangles, positions and lists. What was changed or damaged, or
///    written anew by another program, is refused. (The digest is no signature.)
/// 3. *Refusal*: whatever a file contains, it is either read or refused with an `Input_error` of one line.

/// A mesh with the steps of its reduction, as a progressive file holds them.
struct Progressive_mesh
{
  /// The step of a vertex that does not go.
  static constexpr Index never = std::numeric_limits<Index>::max();

  /// The finest mesh. Poses are those that the file holds in its lists.
  Triangle_soup soup;

  /// For every vertex, the vertex before it to which it goes, or its own number.
  std::vector<Index> merges_into;

  /// For every vertex, the step after which no triangle has it, counted from 1, or `never`. In each vertex
  /// buffer, these do not ascend.
  std::vector<Index> steps;

  /// The number of triangles before the first step and after each. They do not ascend.
  std::vector<Index> faces;

  /// How many triangles could never change, and so do not count for a ratio.
  std::size_t fixed_faces = 0;

  /// For every pose of `soup`, whether the steps were judged in it.
  std::vector<char> is_pose_guarded;

  std::size_t step_count() const { return faces.size() - 1; }
};

/// What a progressive file says beside its mesh.
struct Progressive_notes
{
  std::size_t fixed_faces = 0;     ///< `Simplify_report::faces_fixed`
  bool are_poses_written = true;   ///< false when the document makes them, by targets, animations or skins
  std::vector<std::size_t> levels; ///< numbers of faces of which the file has index buffers, too
  std::vector<std::size_t> guarded_poses; ///< by number, as in `Simplify_options::guarded_poses`
};

/// Returns why a progressive file cannot hold all poses of a soup, or nothing when it can: their coordinates
/// must be 32-bit floats.
std::string poses_not_carried(const Triangle_soup& soup, const Progressive_notes& notes);

/// Writes a progressive file, `.glb` or `.gltf`, as `write_mesh` does: whole or not at all. `soup` is what
/// was reduced (`Prepared_soup::soup`), `progression` the steps of it. What a glTF file does not hold of the
/// soup (`not_carried`) is lost. A mesh that stands in several places of a scene becomes several.
///
/// Throws `Argument_error` when the name is not one of glTF, when coordinates are not 32-bit floats
/// (`needs_float32`), or when the `extras` of the scene's document are no object.
void write_progressive(const std::filesystem::path& path, const Triangle_soup& soup,
                       const Progression& progression, const Progressive_notes& notes = {});

/// Reads a progressive file. Throws `Input_error`.
Progressive_mesh read_progressive(const std::filesystem::path& path);

/// Reads a progressive file from memory. `name` stands for the file in messages.
Progressive_mesh read_progressive(std::string_view contents, Mesh_format format, const std::string& name);

/// Returns after how many steps there are at most so many faces; all steps when there are always more.
std::size_t steps_to_faces(const Progressive_mesh& mesh, std::size_t faces);

/// Returns the number of faces that a ratio stands for, as in `Simplify_options::ratio`.
std::size_t faces_at_ratio(const Progressive_mesh& mesh, double ratio);

/// Returns the mesh after so many steps: triangles that are left in their order, and their vertices.
/// Triangles of a mesh that shades flat share them as those do that `read_mesh` returns, unless it has poses.
///
/// **Preconditions** There are as many steps. **Complexity** Linear.
Triangle_soup level(const Progressive_mesh& mesh, std::size_t steps);

} // namespace selvedge

#endif // SELVEDGE_PROGRESSIVE_H
