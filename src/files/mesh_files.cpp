// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>
#include <selvedge/rounding.h>

#include "files/Input_descriptor.h"
#include "files/Written_faces.h"
#include "files/columns.h"
#include "files/formats.h"
#include "files/gzip.h"
#include "soup/Gltf_scene.h"
#include "soup/check_soup.h"
#include "soup/first_alike.h"
#include "soup/flat_shading.h"
#include "soup/poles.h"
#include "soup/selection.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

// Reads and writes mesh files, the first and the last step of the program. The extension selects the format,
// whose own file does the rest.

namespace selvedge {
namespace {

[[noreturn]] void refuse_folder(const std::filesystem::path& path)
{
  throw Input_error(path.string() + ": is a folder; name a mesh file in it");
}

std::string bytes_of_file(const std::filesystem::path& path)
{
  const std::string name = path.string();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw Input_error(name + ": there is no such file");
  if (std::filesystem::is_directory(status))
    refuse_folder(path);
  files::Input_descriptor file(path);
  constexpr std::size_t least = 1 << 16, most = 1 << 24;
  std::string contents;
  if (const auto size = std::filesystem::file_size(path, error); !error)
    contents.resize(size + least); // with room for the question whether there is more
  // A file that grows meanwhile, or has no size beforehand (a pipe), is read to its end all the same.
  for (std::size_t read = 0;;) {
    Cancellation_scope::check();
    if (contents.size() - read < least)
      contents.resize(std::max(2 * read, read + least));
    const std::size_t count = file.read(contents.data() + read, std::min(contents.size() - read, most));
    read += count;
    if (count == 0) {
      contents.resize(read);
      return contents;
    }
  }
}

std::string lower_case_extension(const std::filesystem::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

constexpr char avatar_extension[] = ".vrm";

// Returns the extension that says the format of a file, packed or not.
std::string extension_of_mesh(const std::filesystem::path& path)
{
  return lower_case_extension(is_gzip(path) ? path.stem() : path);
}

bool is_avatar(const Triangle_soup& soup)
{
  if (!soup.scene || !soup.scene->document.contains("extensions"))
    return false;
  const auto& extensions = soup.scene->document["extensions"];
  return extensions.contains("VRM") || extensions.contains("VRMC_vrm");
}

bool is_gltf(Mesh_format format)
{
  return format == Mesh_format::glb || format == Mesh_format::gltf;
}

// Says of a file under the name of a mesh what it is instead.
void refuse_what_is_no_mesh(std::string_view contents, Mesh_format format, const std::string& name)
{
  const auto begins_with = [&](std::string_view text) { return contents.substr(0, text.size()) == text; };
  if (contents.empty())
    throw Input_error(name + ": the file is empty; export it again");
  if (begins_with("version https://git-lfs"))
    throw Input_error(name +
                      ": this is only a pointer of Git LFS to the file; fetch the file (git lfs pull)");
  if (begins_with("<!DOCTYPE") || begins_with("<!doctype") || begins_with("<html"))
    throw Input_error(name + ": this is a web page; download the file itself");
  using namespace std::string_view_literals;
  const bool is_text = format != Mesh_format::stl && format != Mesh_format::glb; // those may begin like this
  if ((is_text && (begins_with("\xff\xfe"sv) || begins_with("\xfe\xff"sv))) || begins_with("\xff\xfes\0"sv))
    throw Input_error(name + ": the text of the file is in UTF-16; save it in UTF-8 or ASCII");
}

// PLY and glTF: connects the faces of a file that has several vertices at a place because of their normals.
Mesh_file with_shared_vertices(Mesh_file file)
{
  const std::size_t used = count_of_used_vertices(file.soup);
  const bool is_flat = has_flat_normals(file.soup);
  if (const std::size_t joined = share_split_vertices(file.soup); joined > 0)
    file.notes.remarks[std::string("corners joined, for their vertices differ in nothing, or only in ") +
                       (is_flat ? "flat normals" : "the last digits of normals")] += joined;
  if (const std::size_t joined = share_poles(file.soup); joined > 0)
    file.notes.remarks["corners joined, for around a pole every face has texture coordinates of its own"] +=
        joined;
  file.notes.joined_vertices += used - count_of_used_vertices(file.soup);
  return file;
}

void check_writable(const Triangle_soup& soup, Mesh_format format, const Write_options& options)
{
  check_arrays(soup, "the mesh");
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  for (const std::string& comment : options.comments)
    if (std::any_of(comment.begin(), comment.end(), is_control))
      throw Argument_error("a comment for a mesh file holds a control character or is more than one line");
  for (const std::string& comment : soup.header_comments)
    if (comment.find_first_of("\n\r") != std::string::npos)
      throw Argument_error("a comment of the header is more than one line");
  for (const Point_3& point : soup.points)
    for (int axis = 0; axis < 3; ++axis)
      if (needs_float32(soup, format) && !is_float32(point[axis]))
        throw Argument_error("vertex " + std::to_string(&point - soup.points.data()) +
                             " (counted from 0) has a coordinate that is no 32-bit float, and the format "
                             "stores no others; write OBJ, OFF or PLY, which store doubles, or round all "
                             "coordinates to 32-bit floats before the mesh is reduced");
}

std::vector<std::string> not_carried_by_gltf(const Triangle_soup& soup)
{
  std::vector<std::string> names;
  if (soup.scene)
    return names;                                    // it was read from glTF
  if (!soup.objects.empty() && !soup.groups.empty()) // without groups, objects are nodes
    names.push_back("objects");
  if (!soup.smoothing_groups.empty())
    names.push_back("smoothing groups");
  if (!soup.material_libraries.empty())
    names.push_back("material libraries");
  const std::vector<files::Attribute_component> colours = files::find_colours(soup.vertex_attributes);
  for (const Attribute& attribute : soup.vertex_attributes)
    if (std::none_of(colours.begin(), colours.end(),
                     [&](const auto& colour) { return colour.attribute == &attribute; }))
      names.push_back("vertex attribute '" + attribute.name + "'");
  for (const Attribute& attribute : soup.triangle_attributes)
    names.push_back("face attribute '" + attribute.name + "'");
  if (!soup.header_comments.empty())
    names.push_back("comments of the header");
  return names;
}

// Connects the faces of a file in which every triangle, or every quad, has vertices of its own, as in STL:
// otherwise every face would be a piece, and nothing could be reduced. Vertices keep their numbers, and the
// first of those that are alike stands for all. A few faces may well be as many pieces.
Mesh_file connected(Mesh_file file)
{
  Triangle_soup& soup = file.soup;
  const std::size_t used = count_of_used_vertices(soup);
  constexpr std::size_t few = 100;
  const std::size_t triangles = soup.triangles.size();
  const bool is_of_quads = 2 * file.notes.polygons_cut == triangles;
  if (triangles < few || used != (is_of_quads ? 2 : 3) * triangles)
    return file;
  const std::vector<Index> first = first_alike(soup);
  std::size_t joined = 0;
  for (Index_triple& triangle : soup.triangles)
    for (Index& v : triangle)
      joined += std::exchange(v, first[v]) != first[v];
  if (joined > 0) {
    file.notes.remarks["corners of faces joined, for every face has vertices of its own"] += joined;
    file.notes.joined_vertices += used - count_of_used_vertices(soup);
  }
  return file;
}

// `folder` holds the files that a glTF file refers to; null when these cannot be read.
Mesh_file read_contents(std::string_view contents, Mesh_format format, const std::string& name,
                        const std::filesystem::path* folder, const Read_options& options)
{
  refuse_what_is_no_mesh(contents, format, name);
  if (options.level_of_detail > 0 && !is_gltf(format))
    throw Input_error(name + ": is no glTF file, and only these have levels of detail; leave the level out");
  switch (format) {
  case Mesh_format::obj:
    return connected(files::read_obj(contents, name));
  case Mesh_format::off:
    return connected(files::read_off(contents, name));
  case Mesh_format::ply:
    return with_shared_vertices(connected(files::read_ply(contents, name)));
  case Mesh_format::glb:
  case Mesh_format::gltf:
    return with_shared_vertices(files::read_gltf(contents, format, name, folder, options.level_of_detail));
  case Mesh_format::stl:
    break;
  }
  return files::read_stl(contents, name);
}

} // namespace

bool is_gzip(const std::filesystem::path& path)
{
  return lower_case_extension(path) == ".gz";
}

Mesh_format mesh_format(const std::filesystem::path& path)
{
  const std::string extension = extension_of_mesh(path);
  if (extension == ".obj")
    return Mesh_format::obj;
  if (extension == ".off")
    return Mesh_format::off;
  if (extension == ".ply")
    return Mesh_format::ply;
  if (extension == ".stl")
    return Mesh_format::stl;
  if (extension == ".glb" || extension == avatar_extension)
    return Mesh_format::glb;
  if (extension == ".gltf")
    return Mesh_format::gltf;
  if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
    refuse_folder(path);
  throw Input_error(
      path.string() +
      ": the name does not end in .obj, .off, .ply, .stl, .glb, .gltf or .vrm, with or without .gz; "
      "choose a name with one of these endings, or convert the file");
}

void require_avatar(const std::filesystem::path& path, const Triangle_soup& soup)
{
  if (extension_of_mesh(path) == avatar_extension && !is_avatar(soup))
    throw Argument_error(
        path.string() + ": a .vrm file holds a VRM avatar, and this mesh comes from none; choose a name that "
                        "ends in .glb");
}

bool has_normals_of_vertices(Mesh_format format)
{
  return format == Mesh_format::ply || is_gltf(format);
}

bool stores_float32(Mesh_format format)
{
  return format == Mesh_format::stl || is_gltf(format);
}

bool needs_float32(const Triangle_soup& soup, Mesh_format format)
{
  return stores_float32(format) && !(is_gltf(format) && soup.scene);
}

std::vector<std::string> describe(const Read_notes& notes)
{
  std::vector<std::string> sentences;
  const auto say = [&sentences](const std::string& what, std::size_t count) {
    if (count != 0)
      sentences.push_back(what + ": " + std::to_string(count));
  };
  say("faces of more than three corners, cut into triangles", notes.polygons_cut);
  say("faces of fewer than three corners, skipped", notes.fewer_than_three);
  say("faces that name a vertex more than once, kept", notes.repeated_corner);
  for (const auto& [what, count] : notes.remarks)
    say(what, count);
  for (const auto& [name, count] : notes.ignored)
    say("not carried, " + name, count);
  return sentences;
}

std::string read_file(const std::filesystem::path& path)
{
  std::string bytes = bytes_of_file(path);
  if (is_gzip(path))
    return files::unpacked(bytes, path.string());
  return bytes;
}

Mesh_file read_mesh(const std::filesystem::path& path, const Read_options& options)
{
  const Mesh_format format = mesh_format(path);
  const std::string contents = read_file(path);
  const std::filesystem::path folder = path.parent_path();
  return read_contents(contents, format, path.string(), &folder, options);
}

Mesh_file read_mesh(std::string_view contents, Mesh_format format, const std::string& name,
                    const Read_options& options)
{
  return read_contents(contents, format, name, nullptr, options);
}

Write_notes write_mesh(const std::filesystem::path& path, const Triangle_soup& soup,
                       const Write_options& options)
{
  const Mesh_format format = options.format ? *options.format : mesh_format(path);
  require_avatar(path, soup);
  check_writable(soup, format, options);
  files::Byte_writer out(path);
  switch (format) {
  case Mesh_format::obj:
    files::write_obj(out, soup, options);
    break;
  case Mesh_format::off:
    files::write_off(out, soup, options);
    break;
  case Mesh_format::ply:
    files::write_ply(out, soup, options);
    break;
  case Mesh_format::stl:
    files::write_stl(out, soup, options);
    break;
  case Mesh_format::glb:
  case Mesh_format::gltf:
    return files::write_gltf(out, {&soup}, format);
  }
  return {};
}

Write_notes write_levels_of_detail(const std::filesystem::path& path,
                                   const std::vector<Triangle_soup>& levels, const Write_options& options)
{
  const Mesh_format format = options.format ? *options.format : mesh_format(path);
  if (!is_gltf(format))
    throw Argument_error("only glTF files hold several levels of detail; write each level to its own file");
  if (levels.empty())
    throw Argument_error("there is no level of detail to write");
  std::vector<const Triangle_soup*> soups;
  for (const Triangle_soup& level : levels) {
    require_avatar(path, level);
    check_writable(level, format, options);
    soups.push_back(&level);
  }
  files::Byte_writer out(path);
  return files::write_gltf(out, soups, format);
}

std::vector<std::string> not_carried(const Triangle_soup& soup, Mesh_format format)
{
  if (is_gltf(format))
    return not_carried_by_gltf(soup);
  const bool is_obj = format == Mesh_format::obj, is_ply = format == Mesh_format::ply;
  std::vector<std::string> names;
  const auto say = [&names](bool is_lost, const std::string& name) {
    if (is_lost)
      names.push_back(name);
  };
  say(!is_obj && !is_ply && !soup.uvs.empty(), "texture coordinates");
  if (is_ply)
    say(soup.normals.missing.has_value(), "normals, for not every vertex has one");
  else
    say(!is_obj && !soup.normals.empty(), "normals");
  say(!is_obj && !soup.groups.empty(), "groups");
  say(!is_obj && !soup.objects.empty(), "objects");
  say(!is_obj && !soup.materials.empty(), "materials");
  say(!is_obj && !soup.smoothing_groups.empty(), "smoothing groups");
  say(!is_obj && !soup.material_libraries.empty(), "material libraries");
  if (!is_ply) {
    for (const Attribute& attribute : soup.vertex_attributes)
      say(!is_obj || !files::is_in_obj(soup, attribute), "vertex attribute '" + attribute.name + "'");
    for (const Attribute& attribute : soup.triangle_attributes)
      say(true, "face attribute '" + attribute.name + "'");
    say(!soup.header_comments.empty(), "comments of the header");
  }
  say(format == Mesh_format::stl && !soup.points.empty(), "vertex numbers");
  say(has_tangents_in_scene_only(soup), "tangents");
  if (soup.scene)
    for (const std::string& name : files::only_in_gltf(*soup.scene))
      say(true, name);
  return names;
}

std::size_t written_polygons(const Triangle_soup& soup, Mesh_format format)
{
  return files::Written_faces(soup, format).polygons();
}

std::vector<std::string> missing_material_libraries(const std::filesystem::path& path,
                                                    const Triangle_soup& soup)
{
  const auto is_there = [folder = path.parent_path()](const std::string& name) {
    std::error_code error;
    return std::filesystem::exists(folder / name, error);
  };
  std::vector<std::string> missing;
  for (const std::string& libraries : soup.material_libraries) {
    // A statement holds one name, perhaps with blanks in it, or several names without blanks.
    if (is_there(libraries))
      continue;
    std::istringstream words(libraries);
    for (std::string name; words >> name;)
      if (!is_there(name))
        missing.push_back(name);
  }
  return missing;
}

void write_file(const std::filesystem::path& path, std::string_view contents)
{
  files::Byte_writer out(path);
  out << contents;
  out.commit();
}

} // namespace selvedge
