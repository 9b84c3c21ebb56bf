// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "standard_streams.h"

#include "subcommands.h"

#include <selvedge/Error.h>
#include <selvedge/Sha256.h>

#include <fstream>
#include <iostream>
#include <sstream>

namespace selvedge::app {
namespace {

constexpr char stream_name[] = "-";

/// Returns the options whose file is "-", joined by "and", and refuses more than one.
std::string stream_among(const std::vector<Named_file>& files, const std::string& what)
{
  std::string found;
  for (const Named_file& file : files)
    if (file.path == stream_name) {
      if (!found.empty())
        throw Argument_error(found + " and " + file.option + " are both " + what +
                             ", which there is only one of; name a file for one of them");
      found = file.option;
    }
  return found;
}

} // namespace

CLI::Option* add_format_option(CLI::App& command, std::optional<Mesh_format>& format)
{
  return command
      .add_option("--format", format,
                  "Format of a mesh that is -, which stands for standard input or output. The names of files "
                  "say their formats themselves.")
      ->transform(one_of<Mesh_format>({{"obj", Mesh_format::obj},
                                       {"off", Mesh_format::off},
                                       {"ply", Mesh_format::ply},
                                       {"stl", Mesh_format::stl},
                                       {"glb", Mesh_format::glb},
                                       {"gltf", Mesh_format::gltf}}))
      ->type_name("obj|off|ply|stl|glb|gltf");
}

CLI::Option* add_level_option(CLI::App& command, std::size_t& level, const std::string& mesh)
{
  return command
      .add_option("--lod", level,
                  "Level of detail of " + mesh + ", a glTF file with MSFT_lod: 1 is the finest.")
      ->transform(whole_number())
      ->check(in_range(1))
      ->type_name("N")
      ->capture_default_str();
}

void check_streams(const std::vector<Named_file>& read, const std::vector<Named_file>& written,
                   const std::optional<Mesh_format>& format)
{
  const std::string in = stream_among(read, "standard input"), out = stream_among(written, "standard output");
  if (format && in.empty() && out.empty())
    throw Argument_error(
        "--format is for a mesh that is -, but none is; leave it out: the names of files say "
        "their formats");
}

Mesh_format format_of(const std::string& name, const std::optional<Mesh_format>& format)
{
  if (name != stream_name)
    return output_format(name);
  if (!format)
    throw Argument_error(
        "--format: - has no ending that says the format of the mesh; give --format obj, off, "
        "ply, stl, glb or gltf");
  return *format;
}

std::string input_name(const std::string& name)
{
  return name == stream_name ? "standard input" : name;
}

Mesh_file Mesh_input::read(std::size_t level)
{
  const Read_options options{level - 1};
  if (m_name != stream_name)
    return read_mesh(m_name, options);
  const Mesh_format format = format_of(m_name, m_format);
  const std::string contents = read_file("/dev/stdin");
  Sha256 sha256;
  sha256.add(contents);
  m_sha256 = sha256.digest();
  return read_mesh(contents, format, input_name(m_name), options);
}

std::string Mesh_input::sha256() const
{
  return m_name == stream_name ? m_sha256 : sha256_of_file(m_name);
}

std::unique_ptr<std::istream> open_text(const std::string& name)
{
  if (name == stream_name)
    return std::make_unique<std::istringstream>(read_file("/dev/stdin"));
  if (is_gzip(name))
    return std::make_unique<std::istringstream>(read_file(name));
  auto stream = std::make_unique<std::ifstream>(name, std::ios::binary);
  if (!*stream)
    throw Input_error(name + ": cannot be opened; check its name and permissions");
  return stream;
}

Text_to_standard_error::Text_to_standard_error(bool is_on) : m_buffer(is_on ? std::cout.rdbuf() : nullptr)
{
  if (m_buffer)
    std::cout.rdbuf(std::cerr.rdbuf());
}

Text_to_standard_error::~Text_to_standard_error()
{
  if (!m_buffer)
    return;
  std::cout.flush();
  std::cout.rdbuf(m_buffer);
}

} // namespace selvedge::app
