// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_OUTPUT_FILES_H
#define SELVEDGE_APPS_OUTPUT_FILES_H

#include <selvedge/mesh_files.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace selvedge::app {

/// Returns the format that the name of an output file stands for. Throws `Argument_error` when it stands for
/// none.
Mesh_format output_format(const std::filesystem::path& path);

/// Returns whether a format is glTF, as text or packed.
bool is_gltf(Mesh_format format);

/// Returns the path to write to for the name of a file; "-" stands for standard output.
std::filesystem::path output_path(const std::filesystem::path& name);

/// Throws `Output_error` when a file cannot be written, as far as that is clear before any work is done.
void require_writable(const std::filesystem::path& name);

/// What stands in the name of an output for the number of a level, the name of a pose, or the number of a
/// cell.
inline constexpr std::string_view level_mark = "{lod}", pose_mark = "{pose}", cell_mark = "{cell}";

/// Returns the name of a file with `text` in place of each such mark.
std::string with_mark_replaced(std::string name, std::string_view mark, const std::string& text);

/// A file of a run, and the option that names it. An empty path stands for an option that was not given.
struct Named_file
{
  std::string option;
  std::filesystem::path path;
};

/// Throws `Argument_error` when two of the files that a run writes are one file, by whatever spelling, or
/// when one of them is also read. The files need not exist. Devices and pipes may be named several times.
void require_distinct(const std::vector<Named_file>& written, const std::vector<Named_file>& read);

/// Throws `Output_error` when one of the files cannot be written.
void require_writable(const std::vector<Named_file>& files);

/// Returns whether the name of a file stands for this program's standard output.
bool is_standard_output(const std::filesystem::path& name);

/// Has a mesh that names other files as the file `from` does name them as the file `to` must, a file of the
/// given format. Returns the names as `relocate_references` does; standard output is in no folder.
std::vector<std::string> relocate(Triangle_soup& soup, Mesh_format format, const std::filesystem::path& from,
                                  const std::filesystem::path& to);

/// Adds `--polygons`; `are_split` says that triangles are wanted.
CLI::Option* add_polygons_option(CLI::App& command, bool& are_split);

/// Adds `--ascii`.
CLI::Option* add_ascii_option(CLI::App& command, bool& is_ascii);

/// Throws `Argument_error` when `--ascii` is given and all meshes that a run writes are glTF; an empty name
/// stands for no mesh. `format` is that of "-".
void require_use_of_ascii(bool is_ascii, const std::vector<std::string>& meshes,
                          const std::optional<Mesh_format>& format);

/// Returns the size of a file in bytes; 0 where there is none, or something else (a pipe).
std::uintmax_t size_of_file(const std::filesystem::path& path);

/// Returns whether a .gltf file that can be read has bytes of its meshes in other files.
bool has_buffers_beside(const std::filesystem::path& path);

/// Writes a mesh as `write_mesh` does, but throws `Output_error` when the format cannot hold it: the command
/// line is not at fault then.
Write_notes write_output(const std::filesystem::path& name, const Triangle_soup& soup, Mesh_format format,
                         bool is_ascii);

/// Writes several levels of detail to one file, as `write_levels_of_detail` does. Throws likewise.
void write_output(const std::filesystem::path& name, const std::vector<Triangle_soup>& levels,
                  Mesh_format format);

/// Writes the further poses of a mesh to one file: a point cache, or else glTF. Throws likewise.
void write_output_of_poses(const std::filesystem::path& name, const Triangle_soup& soup);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_OUTPUT_FILES_H
