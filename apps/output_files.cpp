// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output_files.h"

#include "report_json.h"
#include "standard_streams.h"
#include "subcommands.h"

#include <selvedge/Error.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/poses.h>
#include <selvedge/references.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include <unistd.h>

namespace selvedge::app {

namespace fs = std::filesystem;

namespace {

// Follows links by hand, because the file at the end of the chain need not exist.
fs::path end_of_links(fs::path path)
{
  std::error_code ignored;
  constexpr int most_links = 40; // as many as Linux follows
  for (int link = 0; link < most_links && fs::is_symlink(path, ignored); ++link)
    path = path.parent_path() / fs::read_symlink(path, ignored);
  return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
}

bool is_same_file(const fs::path& a, const fs::path& b)
{
  if (a.empty() || b.empty())
    return false;
  std::error_code ignored;
  if (fs::exists(a, ignored) && !fs::is_regular_file(a, ignored))
    return false;
  return end_of_links(a) == end_of_links(b) || fs::equivalent(a, b, ignored);
}

template <class Write>
void write_as_output(const fs::path& name, const Write& write)
{
  try {
    write(output_path(name));
  } catch (const Argument_error& error) {
    throw Output_error(name.string() + ": cannot be written: " + error.what());
  }
}

} // namespace

Mesh_format output_format(const fs::path& path)
{
  try {
    return mesh_format(path);
  } catch (const Input_error& error) {
    throw Argument_error(error.what());
  }
}

bool is_gltf(Mesh_format format)
{
  return format == Mesh_format::gltf || format == Mesh_format::glb;
}

fs::path output_path(const fs::path& name)
{
  return name == "-" ? "/dev/stdout" : name;
}

void require_writable(const fs::path& name)
{
  const fs::path path = output_path(name);
  const auto refuse = [&](int error) {
    throw Output_error(path.string() + ": cannot be written: " + std::generic_category().message(error));
  };
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status))
    refuse(EISDIR);
  if (fs::exists(status) && ::access(path.c_str(), W_OK) != 0)
    refuse(errno);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (fs::exists(status) && !fs::is_regular_file(status))
    return; // a device is written to directly
  if (::access(folder.c_str(), F_OK) != 0)
    refuse(errno);
  if (!fs::is_directory(folder, ignored))
    refuse(ENOTDIR);
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    refuse(errno);
}

void require_writable(const std::vector<Named_file>& files)
{
  for (const Named_file& file : files)
    if (!file.path.empty())
      require_writable(file.path);
}

std::string with_mark_replaced(std::string name, std::string_view mark, const std::string& text)
{
  for (std::size_t place = 0; (place = name.find(mark, place)) != std::string::npos; place += text.size())
    name.replace(place, mark.size(), text);
  return name;
}

bool is_standard_output(const fs::path& name)
{
  const fs::path path = output_path(name);
  return path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

void require_distinct(const std::vector<Named_file>& written, const std::vector<Named_file>& read)
{
  for (auto file = written.begin(); file != written.end(); ++file) {
    std::vector<Named_file> others = read;
    others.insert(others.end(), written.begin(), file);
    for (const Named_file& other : others)
      if (is_same_file(output_path(file->path), other.path))
        throw Argument_error(file->option + " and " + other.option +
                             " name the same file; give them different names: " + file->path.string());
  }
}

std::vector<std::string> relocate(Triangle_soup& soup, Mesh_format format, const fs::path& from,
                                  const fs::path& to)
{
  if (is_standard_output(to))
    return {};
  return relocate_references(soup, format, from.parent_path(), to.parent_path());
}

CLI::Option* add_polygons_option(CLI::App& command, bool& are_split)
{
  return command
      .add_option("--polygons", are_split,
                  "Faces of more than three corners, which are cut into triangles on reading: keep those as "
                  "polygons in OBJ, OFF and PLY of which nothing has changed, or write triangles alone.")
      ->transform(one_of<bool>({{"keep", false}, {"split", true}}))
      ->type_name("keep|split")
      ->default_str("keep");
}

CLI::Option* add_ascii_option(CLI::App& command, bool& is_ascii)
{
  return command.add_flag("--ascii", is_ascii, "Write PLY and STL as text.");
}

void require_use_of_ascii(bool is_ascii, const std::vector<std::string>& meshes,
                          const std::optional<Mesh_format>& format)
{
  const auto is_text = [&](const std::string& name) {
    return !name.empty() && !is_point_cache(name) && !is_gltf(format_of(name, format));
  };
  if (is_ascii && std::none_of(meshes.begin(), meshes.end(), is_text))
    throw Argument_error("--ascii: no mesh is written that can be text, as PLY and STL can; leave it out, or "
                         "choose a name that ends in .ply or .stl");
}

std::uintmax_t size_of_file(const fs::path& path)
{
  std::error_code error;
  const std::uintmax_t size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
  return error ? 0 : size;
}

bool has_buffers_beside(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  const Json document = Json::parse(file, nullptr, false);
  if (!document.is_object() || !document.contains("buffers") || !document["buffers"].is_array())
    return false;
  return std::any_of(document["buffers"].begin(), document["buffers"].end(), [](const Json& buffer) {
    return buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string() &&
           buffer["uri"].get_ref<const std::string&>().compare(0, 5, "data:") != 0;
  });
}

Write_notes write_output(const fs::path& name, const Triangle_soup& soup, Mesh_format format, bool is_ascii)
{
  Write_notes notes;
  Write_options options;
  options.format = format;
  options.encoding = is_ascii ? Encoding::ascii : Encoding::binary;
  write_as_output(name, [&](const fs::path& path) { notes = write_mesh(path, soup, options); });
  return notes;
}

void write_output(const fs::path& name, const std::vector<Triangle_soup>& levels, Mesh_format format)
{
  Write_options options;
  options.format = format;
  write_as_output(name, [&](const fs::path& path) { write_levels_of_detail(path, levels, options); });
}

void write_output_of_poses(const fs::path& name, const Triangle_soup& soup)
{
  write_as_output(name, [&](const fs::path& path) {
    if (is_point_cache(name))
      write_point_cache(path, soup);
    else
      write_gltf_poses(path, soup);
  });
}

} // namespace selvedge::app
