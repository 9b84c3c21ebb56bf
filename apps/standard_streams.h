// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_STANDARD_STREAMS_H
#define SELVEDGE_APPS_STANDARD_STREAMS_H

#include "output_files.h"

#include <selvedge/mesh_files.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <istream>
#include <memory>
#include <optional>
#include <streambuf>
#include <string>
#include <vector>

// The file name "-" stands for standard input where a file is read, and for standard output where one is
// written.

namespace selvedge::app {

/// What the help says of the names of meshes.
constexpr char mesh_endings[] = ".obj, .off, .ply, .stl, .glb, .gltf or .vrm, each also with .gz";

/// Adds `--format`.
CLI::Option* add_format_option(CLI::App& command, std::optional<Mesh_format>& format);

/// Adds `--lod`: which level of detail of `mesh` is read, counted from 1.
CLI::Option* add_level_option(CLI::App& command, std::size_t& level, const std::string& mesh);

/// Throws `Argument_error` when two files are standard input or two are standard output, and when there is a
/// `format` although no file is either.
void check_streams(const std::vector<Named_file>& read, const std::vector<Named_file>& written,
                   const std::optional<Mesh_format>& format = std::nullopt);

/// Returns the format of a mesh that is read or written: `format` for "-", else what the name ends in. Throws
/// `Argument_error` when there is none.
Mesh_format format_of(const std::string& name, const std::optional<Mesh_format>& format);

/// Returns how messages name a file that is read.
std::string input_name(const std::string& name);

/// A mesh that a run reads.
class Mesh_input
{
public:
  Mesh_input(const std::string& name, const std::optional<Mesh_format>& format)
      : m_name(name), m_format(format)
  {
  }

  /// Reads the mesh, or a further one of its levels of detail, which are counted from 1. Throws
  /// `Input_error`, and `Argument_error` for standard input without a format. To be called once.
  Mesh_file read(std::size_t level = 1);

  /// The SHA-256 of the bytes of the file. To be called after `read`.
  std::string sha256() const;

private:
  std::string m_name;
  std::optional<Mesh_format> m_format;
  std::string m_sha256; // of standard input, which cannot be read again
};

/// Opens a text file to read, also a packed one. Throws `Input_error`.
std::unique_ptr<std::istream> open_text(const std::string& name);

/// Sends `std::cout` to standard error while it lives, if `is_on`, because something else goes to standard
/// output.
class Text_to_standard_error
{
public:
  explicit Text_to_standard_error(bool is_on);
  ~Text_to_standard_error();
  Text_to_standard_error(const Text_to_standard_error&) = delete;
  Text_to_standard_error& operator=(const Text_to_standard_error&) = delete;

private:
  std::streambuf* m_buffer;
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_STANDARD_STREAMS_H
