// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Thread_limit.h"
#include "output_files.h"
#include "report_json.h"
#include "report_output.h"
#include "small_pieces.h"
#include "standard_streams.h"
#include "subcommands.h"
#include "text.h"
#include "threads_option.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/inspect.h>
#include <selvedge/mesh_files.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

struct Info_request
{
  std::string mesh;
  std::string report;
  std::optional<Mesh_format> format;
  std::size_t level = 1;
  bool is_json = false;
  std::optional<std::size_t> threads;
};

constexpr std::size_t most_parts_printed = 12, most_listed = 100;

const char* format_name(Mesh_format format)
{
  switch (format) {
  case Mesh_format::obj:
    return "OBJ";
  case Mesh_format::off:
    return "OFF";
  case Mesh_format::ply:
    return "PLY";
  case Mesh_format::stl:
    return "STL";
  case Mesh_format::glb:
    return "GLB";
  case Mesh_format::gltf:
    return "glTF";
  }
  return "";
}

const char* normals_name(Normals_of_file normals)
{
  switch (normals) {
  case Normals_of_file::none:
    return "none";
  case Normals_of_file::per_face:
    return "per_face";
  case Normals_of_file::per_vertex:
    return "per_vertex";
  case Normals_of_file::per_corner:
    return "per_corner";
  }
  return "";
}

/// Describes the kind of a piece or surface in words, such as "closed, of genus 1".
std::string kind_of(const Connected_surface& surface)
{
  if (surface.shape.non_manifold_edges > 0)
    return "with " + counted(surface.shape.non_manifold_edges, "edge") + " of three faces or more";
  if (const auto genus = surface.genus())
    return "closed, of genus " + std::to_string(*genus);
  if (surface.shape.border_edges == 0)
    return "closed, of Euler characteristic " + std::to_string(surface.shape.euler_characteristic);
  if (surface.shape.boundary_loops == 1 && surface.shape.euler_characteristic == 1)
    return "open, like a disc";
  return "open, with " + counted(surface.shape.boundary_loops, "boundary loop") +
         " and Euler characteristic " + std::to_string(surface.shape.euler_characteristic);
}

/// Says how many of some surfaces are of which kind, most first.
std::string kinds_of(const std::vector<Connected_surface>& surfaces)
{
  std::map<std::string, std::size_t> counts;
  for (const Connected_surface& surface : surfaces)
    ++counts[kind_of(surface)];
  std::vector<std::pair<std::string, std::size_t>> kinds(counts.begin(), counts.end());
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> words;
  for (const auto& [kind, count] : kinds)
    words.push_back(with_commas(count) + ' ' + kind);
  std::string text;
  for (std::size_t i = 0; i < (std::min)(most_printed, words.size()); ++i)
    text += (i == 0 ? "" : "; ") + words[i];
  return words.size() > most_printed
             ? text + "; and " + with_commas(words.size() - most_printed) + " other kinds"
             : text;
}

/// Prints the names by which options such as `--ratio PART=R` know parts of a mesh, those of most faces
/// first.
void print_parts(const std::vector<Part_kind>& kinds)
{
  for (const Part_kind& kind : kinds) {
    std::vector<std::size_t> faces(kind.count);
    for (const Index part : kind.of_triangle)
      ++faces[part];
    std::vector<Index> with_faces;
    for (Index part = 0; part < kind.names.size(); ++part)
      if (!kind.names[part].empty() && faces[part] > 0)
        with_faces.push_back(part);
    std::stable_sort(with_faces.begin(), with_faces.end(),
                     [&](Index a, Index b) { return faces[a] > faces[b]; });
    std::vector<std::string> words;
    for (const Index part : with_faces)
      words.push_back(kind.names[part] + (words.empty() ? " with " + counted(faces[part], "face")
                                                        : " with " + with_commas(faces[part])));
    if (!words.empty())
      std::cout << name(kind.name) << "s: " << with_commas(words.size()) << " ("
                << listed(words, most_parts_printed) << ")\n";
  }
}

void print_content(const Contents& contents, const std::vector<Part_kind>& parts)
{
  const auto print = [](const char* what, const std::vector<std::string>& names) {
    if (!names.empty())
      std::cout << what << ": " << with_commas(names.size()) << " (" << listed(names) << ")\n";
  };
  print_parts(parts);
  print("images", contents.images);
  print("material libraries", contents.material_libraries);
  std::vector<std::string> attributes;
  if (contents.texture_coordinates > 0)
    attributes.push_back(counted(contents.texture_coordinates, "texture coordinate"));
  if (contents.normals != Normals_of_file::none)
    attributes.push_back(contents.normals == Normals_of_file::per_face     ? "a normal per face"
                         : contents.normals == Normals_of_file::per_vertex ? "a normal per vertex"
                                                                           : "normals per corner");
  attributes.insert(attributes.end(), contents.attributes.begin(), contents.attributes.end());
  for (const std::string& one : contents.attributes_of_some_primitives)
    attributes.push_back(one + " of some primitives");
  for (const std::string& one : contents.attributes_of_different_types)
    attributes.push_back(one + " of different types");
  std::cout << "attributes: " << (attributes.empty() ? "none" : listed(attributes)) << '\n';
}

void print_surfaces(const Inspection& mesh, const std::optional<Small_pieces>& small)
{
  std::cout << "pieces: " << with_commas(mesh.pieces.size()) << ", connected by vertex numbers\n"
            << "surfaces: " << with_commas(mesh.surfaces.size())
            << ", where coincident borders are sewn: " << kinds_of(mesh.surfaces) << '\n';
  if (small)
    std::cout << "small surfaces: " << with_commas(small->count) << ", with "
              << counted(small->triangles, "face") << ", are smaller than " << small->length
              << " and than all others by far; `simplify --drop-smaller " << small->length
              << "` leaves them out\n";
  const auto list_of = [](const std::vector<Index>& pieces) {
    std::vector<std::string> names;
    for (const Index piece : pieces)
      names.push_back(std::to_string(piece + 1));
    return counted(names.size(), "piece") + " (" + listed(names) + ")";
  };
  if (mesh.turned_faces > 0)
    std::cout << "orientation: a reduction turns " << counted(mesh.turned_faces, "face") << " of "
              << list_of(mesh.turned_pieces)
              << " to agree with the others of their surface, and turns them back in the output\n";
  if (mesh.misoriented_edges > 0)
    std::cout << "orientation: faces disagree along " << counted(mesh.misoriented_edges, "edge") << " of "
              << list_of(mesh.misoriented_pieces) << ", and turning does not help: nothing moves there\n";
  if (mesh.pairs.empty()) {
    std::cout << "intersections: none (decided exactly)\n";
  } else {
    std::size_t counts[3] = {};
    for (const Offending_pair& pair : mesh.pairs)
      ++counts[int(pair.offence)];
    std::cout << "intersections: " << counted(mesh.pairs.size(), "offending pair")
              << " (decided exactly): " << with_commas(counts[int(Offence::intersection)]) << " intersect, "
              << with_commas(counts[int(Offence::duplicate)]) << " have the same corners, "
              << with_commas(counts[int(Offence::degenerate)]) << " degenerate\n";
    if (mesh.pairs.size() > counts[int(Offence::degenerate)])
      std::cout << "  their faces are reduced like others: only what descends from these pairs may intersect "
                   "then (--defects descend); --defects freeze leaves them as they are\n";
    if (counts[int(Offence::duplicate)] > 0)
      std::cout << "  faces with the same corners, such as the two sides of a leaf, are reduced as one\n";
    if (counts[int(Offence::degenerate)] > 0)
      std::cout << "  a degenerate face stays as it is until a collapse along one of its sides removes it\n";
  }
  if (mesh.surfaces.size() < 2) {
    std::cout << "layers: one surface; the distance between its own folds is not measured\n";
    return;
  }
  const auto nearest = std::min_element(mesh.surfaces.begin(), mesh.surfaces.end(),
                                        [](const auto& a, const auto& b) { return a.distance < b.distance; });
  std::cout << "layers: ";
  if (nearest->distance > 0)
    std::cout << "the least distance between two surfaces is " << with_digits(nearest->distance) << " ("
              << percent(nearest->distance / mesh.diagonal) << " of the size, rounded), between ";
  else
    std::cout << "two surfaces meet, such as ";
  std::cout << "surface " << nearest - mesh.surfaces.begin() + 1 << " and " << *nearest->nearest + 1
            << "; folds of one surface are not measured\n";
}

void print_seams(const Inspection& mesh)
{
  const Inspection::Seams& seams = mesh.seams;
  std::cout << "seams: ";
  if (seams.edges == 0) {
    std::cout << "none";
  } else {
    std::cout << counted(seams.edges, "edge") << "; across them differ";
    const char* separator = " ";
    for (const auto& [count, what] :
         {std::pair(seams.by_vertices, "vertex numbers"), std::pair(seams.by_texture, "texture coordinates"),
          std::pair(seams.by_normals, "normals"), std::pair(seams.by_labels, "groups, objects or materials"),
          std::pair(seams.by_regions, "values of faces"),
          std::pair(seams.by_doubles, "numbers of faces with the same corners")})
      if (count > 0)
        std::cout << std::exchange(separator, ", ") << what << " (" << with_commas(count) << ')';
    separator = "; where only vertex numbers or values of faces differ, it is for ";
    for (const auto& [name, count] : seams.by_attributes)
      std::cout << std::exchange(separator, ", ") << name << " (" << with_commas(count) << ')';
  }
  if (mesh.normals == Normals_treatment::flat)
    std::cout << " (normals are made anew, and make no seams)";
  else if (mesh.normals == Normals_treatment::picked)
    std::cout << " (normals make none, as hardly any edge is hard)";
  else if (mesh.normals == Normals_treatment::softened)
    std::cout << " (normals make none of edges that are too soft to be seen)";
  std::cout << "\nborders: ";
  if (mesh.border_edges == 0) {
    std::cout << "none\n";
    return;
  }
  const Border_gaps& gaps = mesh.border_gaps;
  std::cout << counted(mesh.border_edges, "edge") << ", " << with_commas(gaps.border_vertices)
            << (gaps.border_vertices == 1 ? " vertex" : " vertices") << '\n';
  if (gaps.lengths.empty())
    std::cout << "gaps: no border vertex has a partner on another border";
  else
    std::cout << "gaps: " << with_commas(gaps.lengths.size())
              << " of the border vertices have a partner within " << with_digits_up(gaps.lengths.back())
              << ", half of these within " << with_digits_up(gaps.lengths[gaps.lengths.size() / 2]);
  std::cout << " (looked for within the median length of border edges, " << with_digits(gaps.limit) << ")\n";
  if (gaps.clear_length)
    std::cout << "open seams: " << partners_in_clear_gaps(gaps, mesh.diagonal)
              << "; --weld auto closes them\n";
  if (gaps.clear_length_to_edges)
    std::cout << "open seams: " << edges_in_clear_gaps(gaps, mesh.diagonal)
              << "; --weld hold keeps them from getting wider\n";
  if (!gaps.clear_length && !gaps.clear_length_to_edges && !gaps.lengths.empty())
    std::cout << "open seams: none that are clearly narrower than what lies beside them\n";
}

void print_freedom(const Inspection& mesh)
{
  const Inspection::Vertices& count = mesh.movable;
  std::cout << "vertices when sewn: " << with_commas(count.free) << " free, " << with_commas(count.on_lines)
            << " on borders and seams, along which they move";
  const auto print = [](std::size_t number, const char* what) {
    if (number > 0)
      std::cout << ", " << with_commas(number) << ' ' << what;
  };
  print(count.ends, "at ends and junctions of these, which stay");
  print(count.non_manifold, "frozen at non-manifold places");
  print(count.misoriented, "frozen where faces disagree in orientation");
  std::cout << "\nfixed: " << counted(mesh.fixed_faces, "face") << " ("
            << percent(double(mesh.fixed_faces) / double(mesh.faces))
            << ") cannot change; a ratio is of the other " << with_commas(mesh.faces - mesh.fixed_faces)
            << '\n';
}

void print(const Info_request& request, const Contents& contents, const std::vector<std::string>& notes,
           const std::vector<Part_kind>& parts, const Inspection& mesh,
           const std::optional<Small_pieces>& small)
{
  std::cout << input_name(request.mesh) << ": " << format_name(contents.format) << ", "
            << with_commas(contents.vertices) << (contents.vertices == 1 ? " vertex, " : " vertices, ")
            << counted(contents.faces, "face") << ", size (diagonal of the bounding box) "
            << with_digits(mesh.diagonal) << '\n';
  for (const std::string& note : notes)
    std::cout << "  " << note << '\n';
  if (mesh.left_out_faces > 0)
    std::cout << "  " << counted(mesh.left_out_faces, "face")
              << " with two corners at one position, which count for nothing below\n";
  if (mesh.unused_vertices > 0)
    std::cout << "  " << with_commas(mesh.unused_vertices) << " of the vertices "
              << (mesh.unused_vertices == 1 ? "belongs" : "belong") << " to no face\n";
  print_content(contents, parts);
  print_surfaces(mesh, small);
  print_seams(mesh);
  print_freedom(mesh);
  std::cout << std::flush;
}

Json to_json(const Contents& contents)
{
  return {{"format", format_name(contents.format)},
          {"groups", contents.groups},
          {"objects", contents.objects},
          {"materials", contents.materials},
          {"images", contents.images},
          {"material_libraries", contents.material_libraries},
          {"texture_coordinates", contents.texture_coordinates},
          {"normals", normals_name(contents.normals)},
          {"attributes", contents.attributes},
          {"attributes_of_some_primitives", contents.attributes_of_some_primitives},
          {"attributes_of_different_types", contents.attributes_of_different_types}};
}

void add_inspection(Json& report, const Inspection& mesh)
{
  report["faces"] = {{"count", mesh.faces}, {"left_out", mesh.left_out_faces}, {"fixed", mesh.fixed_faces}};
  report["vertices"] = {{"unused", mesh.unused_vertices}, {"coincident", mesh.coincident_vertices}};
  report["diagonal"] = mesh.diagonal;
  report["pieces"] = {{"count", mesh.pieces.size()}};
  const auto first_of = [](const std::vector<Index>& pieces) {
    Json first = Json::array();
    for (std::size_t i = 0; i < (std::min)(most_listed, pieces.size()); ++i)
      first.push_back(pieces[i] + 1);
    return first;
  };
  report["orientation"] = {{"turned_faces", mesh.turned_faces},
                           {"turned_pieces", mesh.turned_pieces.size()},
                           {"first_turned_pieces", first_of(mesh.turned_pieces)},
                           {"misoriented_edges", mesh.misoriented_edges},
                           {"misoriented_pieces", mesh.misoriented_pieces.size()},
                           {"first_pieces", first_of(mesh.misoriented_pieces)}};

  std::vector<Index> largest(mesh.surfaces.size());
  std::iota(largest.begin(), largest.end(), Index(0));
  std::stable_sort(largest.begin(), largest.end(), [&](Index a, Index b) {
    return mesh.surfaces[a].shape.faces > mesh.surfaces[b].shape.faces;
  });
  largest.resize((std::min)(most_listed, largest.size()));
  std::sort(largest.begin(), largest.end());
  Json surfaces = Json::array();
  for (const Index number : largest) {
    const Connected_surface& surface = mesh.surfaces[number];
    surfaces.push_back({{"number", number + 1},
                        {"first_triangle", surface.shape.first_triangle + 1},
                        {"faces", surface.shape.faces},
                        {"closed", surface.is_closed()},
                        {"boundary_loops", surface.shape.boundary_loops},
                        {"border_edges", surface.shape.border_edges},
                        {"non_manifold_edges", surface.shape.non_manifold_edges},
                        {"misoriented_edges", surface.misoriented_edges},
                        {"euler_characteristic", surface.shape.euler_characteristic},
                        {"genus", or_null(surface.genus())},
                        {"nearest", surface.nearest ? Json(*surface.nearest + 1) : Json(nullptr)},
                        {"distance", surface.nearest ? Json(surface.distance) : Json(nullptr)}});
  }
  const auto closed = std::count_if(mesh.surfaces.begin(), mesh.surfaces.end(),
                                    [](const Connected_surface& surface) { return surface.is_closed(); });
  report["surfaces"] = {
      {"count", mesh.surfaces.size()}, {"closed", closed}, {"largest", std::move(surfaces)}};
  std::size_t offences[3] = {};
  for (const Offending_pair& pair : mesh.pairs)
    ++offences[int(pair.offence)];
  report["pairs"] = {{"count", mesh.pairs.size()},
                     {"intersection", offences[int(Offence::intersection)]},
                     {"duplicate", offences[int(Offence::duplicate)]},
                     {"degenerate", offences[int(Offence::degenerate)]}};
  Json by_attributes = Json::array();
  for (const auto& [name, edges] : mesh.seams.by_attributes)
    by_attributes.push_back({{"name", name}, {"edges", edges}});
  report["seams"] = {{"normals", name_of(mesh.normals)},         {"edges", mesh.seams.edges},
                     {"by_vertices", mesh.seams.by_vertices},    {"by_texture", mesh.seams.by_texture},
                     {"by_normals", mesh.seams.by_normals},      {"by_labels", mesh.seams.by_labels},
                     {"by_regions", mesh.seams.by_regions},      {"by_doubles", mesh.seams.by_doubles},
                     {"by_attributes", std::move(by_attributes)}};
  report["borders"] = {{"edges", mesh.border_edges}};
  report["border_gaps"] = border_gaps_json(mesh.border_gaps);
  report["movable"] = {{"free", mesh.movable.free},
                       {"on_lines", mesh.movable.on_lines},
                       {"ends", mesh.movable.ends},
                       {"non_manifold", mesh.movable.non_manifold},
                       {"misoriented", mesh.movable.misoriented}};
}

Exit_code run(const Info_request& request)
{
  check_streams({{"MESH", request.mesh}}, {}, request.format);
  if (!request.report.empty()) {
    require_distinct({{"--report", request.report}}, {{"MESH", request.mesh}});
    require_writable(request.report);
  }
  Mesh_file file = Mesh_input(request.mesh, request.format).read(request.level);
  Json report = new_report("info");
  report["input"] = input_json(request.mesh, file);
  const Contents contents = contents_of(file);
  const std::vector<Part_kind> parts = part_kinds(file.soup);
  const std::optional<Small_pieces> small = small_pieces(file.soup);
  Inspection mesh;
  try {
    mesh = inspect(std::move(file.soup), has_normals_of_vertices(file.format));
    mesh.unused_vertices -= file.notes.joined_vertices;
    if (mesh.joined_corners > 0) {
      file.notes.remarks[remark_on_joined_corners] += mesh.joined_corners;
      report["input"]["notes"] = describe(file.notes);
    }
  } catch (const Input_error& error) {
    throw Input_error(input_name(request.mesh) + ": " + error.what());
  }
  report["contents"] = to_json(contents);
  add_inspection(report, mesh);
  report["surfaces"]["small"] =
      small ? Json{{"below", std::stod(small->length)}, {"count", small->count}, {"faces", small->triangles}}
            : Json(nullptr);
  report["memory"] = {{"peak_bytes", peak_memory_bytes()}};
  report["exit_code"] = int(exit_done);
  put_report(request, report, [&] { print(request, contents, describe(file.notes), parts, mesh, small); });
  return exit_done;
}

} // namespace

Action add_info(CLI::App& command)
{
  const auto request = std::make_shared<Info_request>();
  command.add_option("MESH", request->mesh, std::string("Mesh to describe: ") + mesh_endings + ".")
      ->required()
      ->type_name("");
  add_level_option(command, request->level, "MESH");
  add_format_option(command, request->format);
  add_report_options(command, *request);
  add_threads_option(command, request->threads);
  command.footer(
      "Examples:\n"
      "  selvedge info jacket.obj\n"
      "  selvedge info jacket.glb --json | jq .movable\n\n"
      "It says what is in the file, and what `simplify` with its default options would find: pieces, and "
      "surfaces\n"
      "when coincident borders are sewn; pairs of faces that intersect, exactly; how near two surfaces "
      "come,\n"
      "rounded; seams, borders, and within what length border vertices have a partner; which vertices "
      "cannot\n"
      "move, and why; and how many faces are fixed thereby. Nothing is reduced or written. Pieces and "
      "surfaces are\n"
      "counted from 1, in the order of their first faces. The exit code is 0, however bad the mesh is, and 3 "
      "when it\n"
      "cannot be read or every face has two corners at one position.");
  return [request] {
    const Thread_limit limit(request->threads);
    return run(*request);
  };
}

} // namespace selvedge::app
