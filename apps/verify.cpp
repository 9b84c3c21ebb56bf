// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Thread_limit.h"
#include "attributes_option.h"
#include "blind_spots.h"
#include "doubtful_units.h"
#include "dropped_parts_options.h"
#include "html_report.h"
#include "output_files.h"
#include "part_pairs_option.h"
#include "poses_option.h"
#include "report_json.h"
#include "report_output.h"
#include "standard_streams.h"
#include "subcommands.h"
#include "text.h"
#include "threads_option.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/compare.h>
#include <selvedge/mesh_files.h>
#include <selvedge/normals.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::app {
namespace {

struct Verify_request
{
  std::string mesh;
  std::string original;
  std::size_t level = 1;
  std::string obstacle;
  Pose_sources poses, obstacle_poses;
  std::vector<std::string> files_of_poses_of_original;
  std::string report;
  std::string html;
  std::optional<Mesh_format> format;
  std::optional<double> weld_distance;
  Parts_to_drop dropped_parts;
  std::vector<std::string> dropped_attributes;
  std::vector<std::string> may_intersect;
  std::optional<double> clearance;
  bool is_json = false;
  std::optional<std::size_t> threads;
};

void print(const char* what, const Line_comparison& lines)
{
  if (lines.edges_of_original == 0 && lines.edges_of_result == 0)
    return;
  const std::string none = "none";
  std::cout << what << ": "
            << (lines.edges_of_original == 0 ? none : counted(lines.edges_of_original, "edge")) << " before, "
            << (lines.edges_of_result == 0 ? none : with_commas(lines.edges_of_result)) << " now";
  if (lines.edges_of_original > 0 && lines.edges_of_result > 0)
    std::cout << "; moved by " << with_digits(lines.original_to_result.of_ends.root_mean_square)
              << " RMS, at most "
              << with_digits((std::max)(lines.original_to_result.maximum.upper,
                                        lines.result_to_original.maximum.upper));
  std::cout << '\n';
}

void print(const Layer_order& layers, bool are_all_vertices_known)
{
  if (layers.crossing == 0) {
    std::cout << "layers: none near enough to another to change places with it (none of "
              << counted(layers.lines, "line") << " through the faces crosses two)\n";
  } else if (layers.compared == 0 && 100 * layers.crossing <= layers.lines) {
    std::cout << "layers: hardly any close to another (of " << counted(layers.lines, "line")
              << " through the faces, " << with_commas(layers.crossing)
              << " cross two, and find neither in the result)\n";
  } else if (layers.compared == 0) {
    std::cout << "layers: could not be compared (" << counted(layers.crossing, "line")
              << " cross two or more, but none finds them in the result)\n";
  } else if (layers.swaps.empty()) {
    std::cout << "layers: no two changed places (compared along " << counted(layers.lines_compared, "line")
              << ")\n";
  } else {
    const Layer_swap& first = layers.swaps.front();
    std::cout << "layers CHANGED PLACES: " << with_commas(layers.swaps.size()) << " of "
              << counted(layers.compared, "pair") << " compared along "
              << counted(layers.lines_compared, "line") << "; the first: triangles "
              << first.of_original[0] + 1 << " and " << first.of_original[1] + 1 << " of the original became "
              << first.of_result[0] + 1 << " and " << first.of_result[1] + 1 << ", in the other order\n";
    if (!are_all_vertices_known)
      std::cout << "  not all vertices are those of the original, so that a few may be taken for those of "
                   "another layer; replay of a log tells for certain\n";
  }
  if (const std::size_t count = layers.without_order; count > 0)
    std::cout << "  " << counted(count, "pair")
              << " of layers changed places where they intersect nearby in the "
              << "original, and so have no order\n";
}

void print(const Verification& verification, const Comparison& comparison)
{
  const Distances& distances = *verification.distances;
  std::cout << "lengths, as shares of the bounding box's diagonal of " << with_digits(distances.diagonal)
            << ":\n";
  const auto print_distance = [&](const char* what, const Distance& of_vertices,
                                  const Bounds_over_poses& maximum) {
    std::cout << "  distance from " << what << ": " << with_digits(of_vertices.root_mean_square)
              << " RMS at the vertices, at most " << with_digits(maximum.upper) << " anywhere";
    if (!verification.poses.empty())
      std::cout << " in any pose, the most in " << describe_pose(verification, maximum.pose);
    std::cout << '\n';
  };
  print_distance("original to result", distances.original_to_result, comparison.distances.original_to_result);
  print_distance("result to original", distances.result_to_original, comparison.distances.result_to_original);
  print("  borders", comparison.borders);
  print("  seams", comparison.seams);
  if (const Gaps& gaps = comparison.gaps; gaps.open_edges > 0) {
    std::cout << "  GAPS: " << counted(gaps.open_edges, "edge") << " of seams open, "
              << with_digits(gaps.length) << " long in all";
    if (gaps.width > 0)
      std::cout << ", up to " << with_digits(gaps.width) << " wide\n";
    else
      std::cout << ", but not wide: one side has a vertex more, or a border has come near a seam\n";
  }

  std::cout << "vertices: " << with_commas(comparison.original_vertices) << " of "
            << with_commas(comparison.vertices) << " are the original's, bit for bit"
            << (comparison.original_vertices < comparison.vertices && !comparison.attributes.empty()
                    ? "; values at the others are not compared\n"
                    : "\n");
  for (const Kept_attribute& attribute : comparison.attributes)
    if (const std::size_t compared = attribute.combinations - attribute.at_new_places;
        attribute.original < compared)
      std::cout << attribute.name << ": " << with_commas(compared - attribute.original) << " of "
                << with_commas(compared)
                << (attribute.name == "normal" || attribute.name == "TANGENT"
                        ? " values are not the original's, as where they were fitted to new faces\n"
                        : " values are NOT the original's\n");
  if (const std::vector<std::string>& lost = comparison.lost_attributes; !lost.empty())
    std::cout << "attributes LOST: " << listed(lost, lost.size()) << '\n';

  const Normal_deviation& normals = comparison.normals;
  std::cout << "normals: turned by " << with_digits(normals.mean) << "° on average, "
            << with_digits(normals.root_mean_square) << "° RMS, at most " << with_digits(normals.maximum)
            << "°";
  if (normals.turned > 0)
    std::cout << "; " << with_digits(100 * normals.turned) << " % of the area turned over";
  std::cout << '\n';

  print(comparison.layers, comparison.share_of_original_vertices() == 1);
}

/// Prints a line for each of the first few of a list, and how many more there are.
template <class Element, class Line_of>
void print_first(const std::vector<Element>& list, const Line_of& line_of)
{
  for (std::size_t i = 0; i < (std::min)(list.size(), most_printed); ++i)
    std::cout << "  " << line_of(list[i]) << '\n';
  if (list.size() > most_printed)
    std::cout << "  and " << with_commas(list.size() - most_printed) << " more\n";
}

void print(const Piece_matching& matching)
{
  std::size_t pieces[5] = {};
  for (const Piece_match& match : matching.matches)
    pieces[int(match.by)] += match.of_original.size();
  std::cout << (matching.is_complete() ? "pieces: all match those of the original" : "pieces WRONG");
  const char* separator = "; matched ";
  for (const Matched_by by :
       {Matched_by::vertices, Matched_by::positions, Matched_by::borders, Matched_by::distance})
    if (pieces[int(by)] > 0) {
      std::cout << separator << with_commas(pieces[int(by)]) << " by " << name(by);
      separator = ", ";
    }
  std::cout << '\n';
  print_first(matching.mismatches, [](const Piece_mismatch& mismatch) { return mismatch.message; });
}

void print(const Clearance_verdict& verdict, const Triangle_soup& mesh)
{
  std::cout << "clearance: " << describe(verdict) << '\n';
  const auto piece = [&](Index triangle) {
    return triangle < mesh.triangles.size() ? "that of triangle " + with_commas(triangle + 1)
                                            : std::string("the obstacle");
  };
  print_first(verdict.near, [&](const Near_pieces& pair) {
    const std::string before =
        ", and was " + with_digits(pair.before.lower, "%.6g") + (pair.is_too_near ? ": TOO NEAR" : "");
    return piece(pair.first) + " and " + piece(pair.second) + ": " + with_digits(pair.now.lower, "%.6g") +
           (verdict.least_of_original ? before : "");
  });
}

void print_pairs_of_original(std::size_t pairs)
{
  if (pairs > 0)
    std::cout << "  the original has " << counted(pairs, "offending pair")
              << ", from which some of these may descend (--defects descend); `selvedge replay` judges that, "
                 "with a log\n";
}

/// Prints the offending pairs of the mesh in its own pose.
void print_pairs(const Verify_request& request, const Verification& verification, std::size_t triangles)
{
  const bool has_original = !request.original.empty();
  for (const Verification::Permitted& parts : verification.permitted)
    std::cout << "may intersect: " << counted(parts.pairs, "pair") << " between '" << parts.first << "' and '"
              << parts.second << "', which no other figure counts\n";
  if (verification.pairs.empty()) {
    std::cout << (verification.permitted.empty() ? "embedded: no triangles"
                                                 : "embedded, but for these parts: no other triangles")
              << " touch or cross" << (request.obstacle.empty() ? "" : " each other or the obstacle")
              << ", and none is degenerate\n";
  } else {
    std::cout << "NOT embedded: " << counted(verification.pairs.size(), "offending pair");
    if (has_original)
      std::cout << ", " << with_commas(verification.new_pairs.size()) << " of them not in the original";
    std::cout << '\n';
    const auto& pairs =
        has_original && !verification.new_pairs.empty() ? verification.new_pairs : verification.pairs;
    print_first(pairs, [&](const Offending_pair& pair) { return describe(pair, triangles); });
    if (!verification.new_pairs.empty())
      print_pairs_of_original(verification.pairs_of_original);
  }
}

void print_pose(const Verification::In_pose& pose, const Triangle_soup& mesh, bool has_original)
{
  if (pose.clearance) {
    std::cout << "in pose '" << pose.name << "', ";
    print(*pose.clearance, mesh);
  }
  std::cout << "pose '" << pose.name << "': ";
  if (pose.pairs.empty()) {
    std::cout << "embedded\n";
    return;
  }
  std::cout << counted(pose.pairs.size(), "offending pair");
  if (has_original)
    std::cout << ", " << with_commas(pose.new_pairs.size()) << " of them not in the original";
  std::cout << ", the first: "
            << describe(pose.new_pairs.empty() ? pose.pairs.front() : pose.new_pairs.front(),
                        mesh.triangles.size())
            << '\n';
  if (!pose.new_pairs.empty())
    print_pairs_of_original(pose.pairs_of_original);
}

void print_original(const Verification& verification, const Comparison& comparison,
                    const std::vector<std::string>& cannot_see)
{
  if (verification.is_original_rounded)
    std::cout << "the original was rounded to 32-bit floats before the comparison, because the result "
                 "stores only these\n";
  print(verification.matching);
  const std::vector<Piece_mismatch>& mismatches = verification.matching.mismatches;
  const bool is_changed =
      std::any_of(mismatches.begin(), mismatches.end(), [](const Piece_mismatch& mismatch) {
        return mismatch.what == Mismatch::missing || mismatch.what == Mismatch::added ||
               mismatch.what == Mismatch::topology;
      });
  std::cout << (verification.same_topology() ? "topology: as in the original\n"
                : is_changed                 ? "topology CHANGED:\n"
                                             : "topology: the files number vertices differently:\n");
  for (const Topology_difference& difference : verification.topology_differences)
    std::cout << "  pieces with " << counted(difference.boundary_loops, "boundary loop")
              << " and Euler characteristic " << difference.euler_characteristic << ": "
              << difference.pieces_of_original << " before, " << difference.pieces_of_result << " now\n";
  print(verification, comparison);
  std::cout << "what this cannot see:\n";
  for (const std::string& line : cannot_see)
    std::cout << "  - " << line << '\n';
}

void print(const Verify_request& request, const Mesh_file& mesh, const Triangle_soup& obstacle,
           const Judgement& judgement, const std::vector<std::string>& cannot_see)
{
  const auto& [verification, comparison] = judgement;
  std::size_t loops = 0;
  long euler = 0;
  for (const Piece& piece : verification.pieces) {
    loops += piece.boundary_loops;
    euler += piece.euler_characteristic;
  }
  std::cout << input_name(request.mesh) << ": " << counted(mesh.soup.triangles.size(), "face") << ", "
            << counted(verification.pieces.size(), "piece") << ", " << counted(loops, "boundary loop")
            << ", Euler characteristic " << euler << '\n';
  for (const std::string& note : describe(mesh.notes))
    std::cout << "  " << note << '\n';
  if (!request.obstacle.empty())
    if (const std::string doubt = doubt_of_obstacle(mesh.soup, obstacle); !doubt.empty())
      std::cout << "  obstacle: " << doubt << '\n';

  print_pairs(request, verification, mesh.soup.triangles.size());
  if (verification.clearance)
    print(*verification.clearance, mesh.soup);
  for (const Verification::In_pose& pose : verification.poses)
    print_pose(pose, mesh.soup, comparison.has_value());
  if (comparison)
    print_original(verification, *comparison, cannot_see);
  std::cout << std::flush;
}

/// Says of a file without names, such as OFF and STL, what to do instead of "there is no such part".
void require_names(const Verify_request& request, const Triangle_soup& mesh)
{
  if (!request.may_intersect.empty() && part_kinds(mesh).size() == 1 && mesh.triangle_attributes.empty())
    throw Argument_error("--may-intersect: " + input_name(request.mesh) +
                         " holds no names of parts, so that none can be told from the others; write the "
                         "result as OBJ or glTF, which hold them, and judge that");
}

/// Refuses options that say something of the original where there is none.
void require_original(const Verify_request& request)
{
  const char* const option = !request.files_of_poses_of_original.empty() ? "--against-pose"
                             : request.weld_distance                     ? "--weld"
                             : !request.dropped_parts.names.empty()      ? "--drop-part"
                             : request.dropped_parts.smaller_than > 0    ? "--drop-smaller"
                             : !request.dropped_attributes.empty()       ? "--drop-attribute"
                                                                         : nullptr;
  if (option && request.original.empty())
    throw Argument_error(std::string(option) + ": there is no original; give --against FILE");
}

Exit_code run(const Verify_request& request)
{
  const bool has_original = !request.original.empty();
  require_original(request);
  require_html(request.html);
  const std::vector<Named_file> written{{"--report", request.report}, {"--html", request.html}};
  std::vector<Named_file> read{
      {"MESH", request.mesh}, {"--against", request.original}, {"--obstacle", request.obstacle}};
  check_streams(read, {}, request.format);
  check_obstacle_poses(request.obstacle_poses, request.obstacle, request.poses);
  append_pose_files(read, "--pose", request.poses.files, request.mesh);
  append_pose_files(read, "--obstacle-pose", request.obstacle_poses.files, request.obstacle);
  append_pose_files(read, "--against-pose", request.files_of_poses_of_original, request.original);
  require_distinct(written, read);
  require_writable(written);
  Mesh_file mesh = Mesh_input(request.mesh, request.format).read(request.level);
  Pose_sources of_mesh = request.poses, of_original = request.poses;
  of_original.files = request.files_of_poses_of_original;
  if (has_frames(of_original, request.original) && !has_frames(of_mesh, request.mesh))
    of_mesh.every = 1; // it chooses of the frames of the original
  read_poses(of_mesh, request.mesh, mesh.soup);
  Json report = new_report("verify");
  report["input"] = input_json(request.mesh, mesh);
  Judgement judgement;
  Mesh_file original;
  Verify_options options;
  require_names(request, mesh.soup);
  options.may_intersect = parts_in_pairs(mesh.soup, request.may_intersect, "--may-intersect");
  options.clearance = request.clearance;
  Triangle_soup obstacle;
  if (!request.obstacle.empty()) {
    obstacle = Mesh_input(request.obstacle, request.format).read().soup;
    read_obstacle_poses(request.obstacle_poses, request.obstacle, request.poses, obstacle);
  }
  report["obstacle"] = request.obstacle.empty() ? Json(nullptr) : Json{{"path", request.obstacle}};
  if (has_original) {
    original = Mesh_input(request.original, request.format).read();
    if (!is_gltf(original.format)) { // all poses of the original are in files
      of_original.are_morphs = of_original.are_of_humanoid = false;
      of_original.animation.clear();
      of_original.every = has_frames(of_original, request.original) ? of_original.every : 1;
    }
    read_poses(of_original, request.original, original.soup);
    drop_parts(original.soup, request.dropped_parts, request.original);
    drop_attributes(original.soup, request.dropped_attributes, request.original);
    report["original"] = input_json(request.original, original);
    if (has_normals_of_vertices(mesh.format) || has_normals_of_vertices(original.format)) {
      // Vertices that a file has for its normals alone make no pieces.
      options.triangles_in_file = mesh.soup.triangles;
      share_vertices_without_normals(mesh.soup);
      share_vertices_without_normals(original.soup);
    }
    options.weld_distance = request.weld_distance.value_or(0);
    judgement = judge(mesh.soup, original.soup, options, obstacle);
    report["original"]["rounded"] = judgement.verification.is_original_rounded;
  } else {
    judgement.verification = verify(mesh.soup, options, obstacle);
  }
  const auto& [verification, comparison] = judgement;
  const Exit_code code = judgement.is_accepted() ? exit_done : exit_not_verified;
  std::vector<std::string> cannot_see;
  add_verification(report, verification, has_original);
  if (comparison) {
    add_comparison(report, verification, *comparison);
    cannot_see = blind_spots(verification, *comparison, mesh.soup.scene || original.soup.scene);
    report["cannot_see"] = cannot_see;
  }
  report["memory"] = {{"peak_bytes", peak_memory_bytes()}};
  report["exit_code"] = int(code);
  {
    const Text_to_standard_error elsewhere(is_standard_output(request.html));
    put_report(request, report, [&] { print(request, mesh, obstacle, judgement, cannot_see); });
  }
  if (!request.html.empty()) {
    Html_report html(has_original ? original.soup : mesh.soup, has_original ? mesh.soup : original.soup);
    html.add_result(request.mesh, verification);
    write_file(output_path(request.html), html.page(report));
  }
  return code;
}

} // namespace

Action add_verify(CLI::App& command)
{
  const auto request = std::make_shared<Verify_request>();
  command.add_option("MESH", request->mesh, std::string("Mesh to judge: ") + mesh_endings + ".")
      ->required()
      ->type_name("");
  command.add_option("--against", request->original, "Original mesh, of which MESH is a reduction.")
      ->type_name("FILE");
  add_attributes_option(command, request->dropped_attributes,
                        "Attribute of the original that MESH has lost by this option of simplify.");
  add_dropped_parts_options(command, request->dropped_parts,
                            "Part of the original that this option of simplify has left out.",
                            "What simplify has left out of the original by this option.", "");
  add_level_option(command, request->level, "MESH");
  const char* const poses = "Poses (the same vertices and faces at other places)";
  add_pose_options(command, request->poses, "MESH, and of its original",
                   "Further poses of MESH, each judged like it: a mesh file, or a pattern in quotes. May be "
                   "given several times.",
                   poses);
  add_poses_option(command, "--against-pose", request->files_of_poses_of_original,
                   "The same poses of the original, in the same order.")
      ->group(poses);
  add_obstacle_pose_options(command, request->obstacle_poses, "MESH", poses);
  command
      .add_option(
          "--weld", request->weld_distance,
          "Accept that borders of the original within this length of each other were joined. Give the "
          "value that `simplify` was given.")
      ->check(in_range(0))
      ->type_name("EPS");
  command
      .add_option(
          "--clearance", request->clearance,
          "Distance, in the unit of the file, that no two pieces may be nearer to each other than, in any "
          "pose; with --against, where they are nearer already, than they are in the original. Pieces "
          "are what common positions connect.")
      ->check(positive())
      ->type_name("D");
  command
      .add_option(
          "--obstacle", request->obstacle,
          "Mesh that no triangle of MESH may touch or cross, such as a body. It is not judged itself; "
          "with --against, what touches or crosses it in the original already may do so.")
      ->type_name("FILE");
  add_part_pairs_option(
      command, request->may_intersect,
      "Accept that these parts of MESH intersect each other, as `simplify` was told. May be "
      "given several times.");
  add_format_option(command, request->format);
  add_report_options(command, *request);
  add_html_option(command, request->html)->excludes("--obstacle");
  add_threads_option(command, request->threads);
  command.footer(
      "Examples:\n"
      "  selvedge verify jacket.obj                        # do any triangles touch or cross?\n"
      "  selvedge verify small.obj --against jacket.obj    # is anything wrong that was not wrong before?\n"
      "  selvedge verify small.obj --obstacle body.obj     # does it touch the body, or cut into it?\n"
      "  selvedge verify small.obj --clearance 0.002       # are any two pieces nearer than this?\n"
      "  selvedge verify small.obj --json | jq .verified.pairs\n\n"
      "Without --against the exit code is 0 when MESH is embedded: no triangles touch or cross where they "
      "should\n"
      "not, and none is degenerate. With --against it is 0 when no such pair is new, every piece matches one "
      "of\n"
      "the original's (same boundary loops, Euler characteristic and names, and in the same place), and no "
      "two\n"
      "layers were found in another order. The other figures are for you to judge. The text lists what a\n"
      "comparison of two meshes cannot see. Triangles and pieces are counted from 1; polygons are first cut "
      "into\n"
      "triangles.");
  return [request] {
    const Thread_limit limit(request->threads);
    return run(*request);
  };
}

} // namespace selvedge::app
