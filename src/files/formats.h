// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SRC_FILES_FORMATS_H
#define SELVEDGE_SRC_FILES_FORMATS_H

#include "files/Byte_writer.h"

#include <selvedge/mesh_files.h>

namespace selvedge::files {

// One reader and one writer for each format, behind `read_mesh` and `write_mesh`. `name` stands for the file
// in messages.
Mesh_file read_obj(std::string_view contents, const std::string& name);
Mesh_file read_off(std::string_view contents, const std::string& name);
Mesh_file read_ply(std::string_view contents, const std::string& name);
Mesh_file read_stl(std::string_view contents, const std::string& name);

/// `folder` is where buffers in files of their own are looked for; null when there is none. `level` is that
/// of `Read_options`.
Mesh_file read_gltf(std::string_view contents, Mesh_format format, const std::string& name,
                    const std::filesystem::path* folder, std::size_t level);

void write_obj(Byte_writer& out, const Triangle_soup& soup, const Write_options& options);
void write_off(Byte_writer& out, const Triangle_soup& soup, const Write_options& options);
void write_ply(Byte_writer& out, const Triangle_soup& soup, const Write_options& options);
void write_stl(Byte_writer& out, const Triangle_soup& soup, const Write_options& options);

/// Writes one mesh in all of its levels of detail, from fine to coarse. There is one at least. `has_poses` is
/// that of `with_gltf_scene`, for soups without a scene.
Write_notes write_gltf(Byte_writer& out, const std::vector<const Triangle_soup*>& levels, Mesh_format format,
                       bool has_poses = false);

/// Names what only glTF files hold of this scene.
const std::vector<std::string>& only_in_gltf(const Gltf_scene& scene);

/// Returns the same triangles with a new document: one node for each group, and vertices split where corners
/// differ in texture coordinates or normals. Precondition: coordinates are 32-bit floats.
/// The poses of the soup become morph targets and keyframes if `has_poses` (`write_gltf_poses`).
Triangle_soup with_gltf_scene(const Triangle_soup& soup, bool has_poses = false);

/// Whether an OBJ file of this soup holds this attribute of its vertices: a colour, or else a weight.
bool is_in_obj(const Triangle_soup& soup, const Attribute& attribute);

/// Returns the normal of every vertex, as PLY stores them; nothing when there are none, a corner has none, or
/// a vertex has several.
std::vector<std::array<double, 3>> values_of_vertices(const Corner_values<3>& values,
                                                      const Triangle_soup& soup);

} // namespace selvedge::files

#endif // SELVEDGE_SRC_FILES_FORMATS_H
