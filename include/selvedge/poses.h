// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_POSES_H
#define SELVEDGE_POSES_H

#include <selvedge/Triangle_soup.h>
#include <selvedge/mesh_files.h>

#include <filesystem>
#include <string>
#include <vector>

namespace selvedge {

/// \file
/// Poses of a mesh as files: each holds the same vertices and faces in the same order, at other places.

/// Reads a pose of a mesh from a mesh file of any format. Its name is that of the file without ending.
///
/// The file has as many vertices as the mesh has, and its faces name the same vertices, in the same order.
/// STL files have no vertices: there each corner has the place of its vertex, so that vertices which the mesh
/// has at one place must be at one place in every pose. Everything but places is ignored. How a face of more
/// than three corners is cut into triangles depends on its shape; the cuts are those of the mesh.
///
/// Throws `Input_error` when the file cannot be read, or is no pose of the mesh; the message names the file
/// and the first difference. Vertices and faces are counted from 1 in it. Linear.
Pose read_pose(const std::filesystem::path& path, const Triangle_soup& mesh);

/// Returns whether the ending of a path is that of a point cache, `.mdd` or `.pc2`, in upper or lower case.
bool is_point_cache(const std::filesystem::path& path);

/// Reads the poses of a mesh from a point cache, one for each frame: LightWave's MDD (also Blender's), or PC2
/// of 3ds Max (version 1). They are named frame_1, frame_2 and so on, and have the times of the frames.
///
/// Throws `Input_error` when the file cannot be read, is truncated or longer than it says, has another number
/// of points than the mesh has vertices, or a coordinate that is not finite. Counts in the file are not
/// believed before the bytes are there. Linear.
std::vector<Pose> read_point_cache(const std::filesystem::path& path, const Triangle_soup& mesh);

/// Writes the poses of a mesh to a point cache; the mesh's own places are not among them. PC2 holds the time
/// of the first frame and the time from there to the second. The file appears whole or not at all
/// (`write_mesh`).
///
/// Throws `Argument_error` when there is no pose, or a coordinate is not the value of a 32-bit float, and
/// `Output_error` when the file cannot be written.
void write_point_cache(const std::filesystem::path& path, const Triangle_soup& mesh);

/// Returns the files that a name stands for: the file of this name where there is one; otherwise, of a
/// pattern with `*`, `?` or `[...]` (POSIX glob), all files that match but `mesh`, in natural order: frame_2
/// before frame_10. Throws `Input_error` when there is none.
std::vector<std::filesystem::path> files_named(const std::string& name, const std::filesystem::path& mesh);

/// Returns a mesh as it is in one of its further poses, which it then has none of. It has no glTF scene any
/// more, since a scene holds the places of its own pose.
Triangle_soup in_pose(const Triangle_soup& mesh, std::size_t pose);

} // namespace selvedge

#endif // SELVEDGE_POSES_H
