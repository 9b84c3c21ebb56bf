// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Simplify_request.h"

#include "html_report.h"
#include "output_files.h"
#include "poses_option.h"
#include "standard_streams.h"
#include "subcommands.h"

#include <selvedge/Error.h>
#include <selvedge/cells.h>
#include <selvedge/key_poses.h>
#include <selvedge/poses.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <string_view>
#include <system_error>
#include <utility>

namespace selvedge::app {
namespace {

// As far off as a shape may be by default. Beyond it, ears become slabs, and a hat becomes a tent.
constexpr double default_error = 0.01;

// The placement that the user has chosen.
Placement chosen(Placement_choice choice)
{
  return choice == Placement_choice::optimal ? Placement::optimal : Placement::vertices;
}

/// Returns the number that a text consists of, or NaN.
double number_in(const std::string& text)
{
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : std::nan("");
}

double ratio_in(const std::string& text)
{
  const double ratio = number_in(text);
  if (!(ratio >= 0 && ratio <= 1))
    throw Argument_error("--ratio: '" + text + "' is not a number from 0 to 1" + share_meant(text));
  return ratio;
}

void read_error(Simplify_request& request)
{
  if (request.error == "none") {
    if (request.is_error_everywhere)
      throw Argument_error("--error-everywhere: there is no limit to keep; give --error E in place of none");
    return;
  }
  const double error = request.error.empty() ? default_error : number_in(request.error);
  if (!(error >= 0 && std::isfinite(error)))
    throw Argument_error("--error: '" + request.error + "' is neither a number of at least 0 nor none");
  request.options.max_error = error;
}

constexpr std::array<std::pair<const char*, Open_seams>, 3> seams_words{
    {{"hold", Open_seams::hold}, {"auto", Open_seams::weld}, {"none", Open_seams::measure}}};

void read_weld(Simplify_request& request)
{
  const bool is_loop_of_cgal = request.options.loop == Collapse_loop::cgal;
  if (is_loop_of_cgal && request.weld == "hold")
    throw Argument_error(
        "--weld hold: CGAL's loop collapses no two edges right after each other, as the two sides of a gap "
        "need it; leave out --loop cgal");
  if (request.weld.empty()) {
    request.open_seams = is_loop_of_cgal ? Open_seams::measure : Open_seams::hold;
    return;
  }
  for (const auto& [word, seams] : seams_words)
    if (request.weld == word) {
      request.open_seams = seams;
      return;
    }
  request.open_seams = Open_seams::ignore;
  request.weld_distance = number_in(request.weld);
  if (!(request.weld_distance >= 0 && std::isfinite(request.weld_distance)))
    throw Argument_error("--weld: '" + request.weld +
                         "' is neither a number of at least 0 nor hold, auto or none");
}

Json weld_json(const Simplify_request& request)
{
  for (const auto& [word, seams] : seams_words)
    if (request.open_seams == seams)
      return word;
  return request.weld_distance;
}

void read_ratios(Simplify_request& request)
{
  for (const std::string& text : request.ratios)
    if (const std::size_t equals = text.rfind('='); equals != std::string::npos)
      request.intent.ratios.push_back({text.substr(0, equals), ratio_in(text.substr(equals + 1))});
    else if (request.options.ratio)
      throw Argument_error("--ratio: '" + text +
                           "' is a second ratio for the whole mesh; name a part, as in PART=" + text);
    else
      request.options.ratio = ratio_in(text);
}

void check_poses(const Simplify_request& request)
{
  const auto refuse_with = [](const char* option, const char* why) {
    throw Argument_error(std::string(option) + ": " + why + "; leave it out, or the further poses (" +
                         options_of_poses + ")");
  };
  check_obstacle_poses(request.obstacle_poses, request.obstacle, request.poses);
  if (request.poses.empty()) {
    if (!request.poses_output.empty() || request.are_key_poses_chosen)
      throw Argument_error(std::string(request.poses_output.empty() ? "--key-poses" : "--poses-out") +
                           ": the mesh has no further poses; give them by " + options_of_poses);
    return;
  }
  if (request.is_in_cells)
    refuse_with("--cells", "a mesh in several poses is not reduced in cells");
  if (are_gaps_welded(request))
    refuse_with("--weld", "gaps are closed in one pose only");
  if (request.is_sewn)
    refuse_with("--sewn", "vertices that meet in one pose may be apart in others");
  if (request.placement == Placement_choice::optimal)
    refuse_with("--placement optimal", "a new place is a place in one pose only");
  const bool is_one_file = is_one_file_of_poses(request.poses_output);
  const std::string example =
      std::string("small") + (request.lods.empty() ? "" : "_{lod}") +
      (is_one_file ? std::filesystem::path(request.poses_output).extension().string() : "_{pose}.obj");
  const auto require_mark = [&](std::string_view mark, const char* what) {
    if (!request.poses_output.empty() && request.poses_output.find(mark) == std::string::npos)
      throw Argument_error("--poses-out: the name must contain " + std::string(mark) + ", which stands for " +
                           what + ": --poses-out '" + example + "'");
  };
  require_avatar(request.poses_output, {}); // what is written there is a new document
  if (!is_one_file)
    require_mark(pose_mark, "the name of the pose");
  if (!request.lods.empty())
    require_mark(level_mark, "the number of the level");
  if (!request.poses_output.empty() && !is_point_cache(request.poses_output))
    format_of(request.poses_output, std::nullopt);
}

void check_progressive(const Simplify_request& request)
{
  if (request.progressive.empty())
    return;
  const auto refuse = [](const std::string& why) { throw Argument_error("--progressive: " + why); };
  const Mesh_format format = output_format(request.progressive);
  if (format != Mesh_format::glb && format != Mesh_format::gltf)
    refuse("the file is a glTF file; choose a name that ends in .glb");
  if (request.placement == Placement_choice::optimal)
    refuse("--placement optimal makes new vertices, and a progressive file has those of the input; leave out "
           "one of the two");
  if (request.is_unguarded)
    refuse("every step in the file has been judged; leave out --no-intersection-check");
  if (!request.lods.empty() && (request.is_in_cells || !request.intent.ratios.empty()))
    refuse(
        "with --cells, or with ratios of parts, each of --lods is a reduction of its own, and the file holds "
        "one; leave out --lods");
}

/// Refuses options that would do nothing beside the others.
void check_use(const Simplify_request& request)
{
  require_use_of_ascii(request.is_ascii, {request.output, request.poses_output}, request.format);
  if (request.faces_per_cluster && request.options.index != Face_index::clusters)
    throw Argument_error(
        "--cluster-size: the packed index has no clusters; leave it out, or give --index clusters");
  if (request.corner_height && request.options.max_border_turn == 180 &&
      request.options.max_normal_change == 180)
    throw Argument_error("--corner-height: with such a --border-turn and --normal-change, borders and faces "
                         "may turn as far at any corner as at a low one; leave it out");
  if (request.is_sewn && output_format(request) == Mesh_format::stl)
    throw Argument_error("--sewn: an STL file has no vertices that could be merged; leave it out, or choose "
                         "another format");
  if (request.instances != Instances::shared)
    return;
  const bool is_from_gltf = is_gltf(format_of(request.input, request.format));
  if (!is_from_gltf || !is_gltf(output_format(request)))
    throw Argument_error("--instances shared: only glTF has meshes in several places, and " +
                         (is_from_gltf ? "the output" : input_name(request.input)) +
                         " is of another format; leave it out");
}

void check_kept_parts(const Simplify_request& request)
{
  for (const Simplify_intent::Part_ratio& part : request.intent.ratios)
    for (const std::string& kept : request.intent.kept)
      if (part.name == kept)
        throw Argument_error("--keep: no face of '" + kept + "' may change, so that --ratio " + kept +
                             "=R can do nothing; leave out one of the two");
}

void check_clearance(const Simplify_request& request)
{
  if (!request.options.clearance)
    return;
  const auto refuse_with = [](const char* option, const char* why) {
    throw Argument_error("--clearance: " + std::string(why) + "; leave it out, or " + option);
  };
  if (request.is_unguarded)
    refuse_with("--no-intersection-check", "a distance is kept only where intersections are checked");
  if (request.is_in_cells)
    refuse_with("--cells", "cells do not know how near the pieces beside them are");
  if (are_gaps_welded(request))
    refuse_with("--weld", "closing gaps brings pieces nearer to each other");
  if (!request.may_intersect.empty())
    refuse_with("--may-intersect", "parts that may intersect have no distance");
}

/// Returns whether nothing says how far to reduce the whole mesh.
bool is_without_target(const Simplify_request& request)
{
  return !request.options.ratio && !request.options.faces &&
         (request.error.empty() || request.error == "none") && request.lods.empty();
}

/// Refuses what can be refused before any work is done.
void check(const Simplify_request& request)
{
  if (is_without_target(request) && request.intent.ratios.empty())
    throw Argument_error("say how far to reduce the mesh: give --ratio, --faces, --error or --lods");
  if (request.is_target_required && !request.options.ratio && !request.options.faces &&
      request.lods.empty() && request.intent.ratios.empty())
    throw Argument_error(
        "--require-target: --error is a limit and no target; give --ratio or --faces as well");
  if (!request.lods.empty() && (request.options.ratio || request.options.faces))
    throw Argument_error("--lods already says how far to reduce the mesh; leave out --ratio R and --faces");
  if (request.is_strict && request.defects.value_or(Defects::refuse) != Defects::refuse)
    throw Argument_error("--strict refuses what --defects would accept; leave out one of the two");
  if (request.is_in_cells && !request.intent.ratios.empty())
    throw Argument_error(
        "--cells: parts cannot have ratios of their own; leave out --cells or --ratio PART=R");
  if (request.is_in_cells && !request.may_intersect.empty())
    throw Argument_error(
        "--cells: no parts may intersect each other there; leave out --cells or --may-intersect");
  if (!request.log.empty() && !request.lods.empty())
    throw Argument_error(
        "--log: a log holds one reduction, but --lods asks for several; leave out one of the two");
  check_poses(request);
  check_use(request);
  check_kept_parts(request);
  check_progressive(request);
  check_clearance(request);
  require_html(request.html);
  std::vector<Named_file> written;
  for (const std::string& output : outputs(request)) {
    format_of(output, request.format);
    written.push_back({"--output", output});
  }
  const std::vector<Named_file> beside = {{"--report", request.report},
                                          {"--log", request.log},
                                          {"--progressive", request.progressive},
                                          {"--html", request.html}};
  written.insert(written.end(), beside.begin(), beside.end());
  check_streams({{"IN", request.input}, {"--obstacle", request.obstacle}}, written, request.format);
  // A mesh may replace its input, but nothing else may.
  require_distinct(written, files_read_beside(request));
  require_distinct(beside, {{"IN", request.input}});
  require_writable(written);
}

} // namespace

Mesh_format output_format(const Simplify_request& request)
{
  return format_of(request.output, request.format);
}

std::size_t poses_guarded_first(const Simplify_request& request, std::size_t poses)
{
  return request.are_key_poses_chosen ? number_of_key_poses(poses) : poses;
}

std::vector<Named_file> files_read_beside(const Simplify_request& request)
{
  std::vector<Named_file> files{{"--obstacle", request.obstacle}};
  append_pose_files(files, "--pose", request.poses.files, request.input);
  append_pose_files(files, "--obstacle-pose", request.obstacle_poses.files, request.obstacle);
  return files;
}

bool are_gaps_welded(const Simplify_request& request)
{
  return request.open_seams == Open_seams::weld || request.weld_distance > 0;
}

bool are_levels_in_one_file(const Simplify_request& request)
{
  return !request.lods.empty() && request.output.find(level_mark) == std::string::npos;
}

std::vector<std::string> outputs(const Simplify_request& request)
{
  const std::size_t place = request.output.find(level_mark);
  if (request.lods.empty() && place != std::string::npos)
    throw Argument_error("--output: {lod} stands for the number of a level, but no level is asked for; give "
                         "--lods R,R, or a name without {lod}");
  if (are_levels_in_one_file(request) && !is_gltf(output_format(request)))
    throw Argument_error(
        "--lods: the name of the output must contain {lod}, which stands for the number of the level: -o "
        "'jacket_{lod}.obj'; only .glb and .gltf files hold all levels in one: -o jacket.glb");
  if (place == std::string::npos)
    return {request.output};
  std::vector<std::string> names;
  for (std::size_t level = 1; level <= request.lods.size(); ++level)
    names.push_back(with_mark_replaced(request.output, level_mark, std::to_string(level)));
  return names;
}

bool is_one_file_of_poses(const std::string& name)
{
  return is_point_cache(name) || (!name.empty() && name.find(pose_mark) == std::string::npos &&
                                  is_gltf(format_of(name, std::nullopt)));
}

std::string pose_output(const Simplify_request& request, std::size_t level, const std::string& pose)
{
  return with_mark_replaced(with_mark_replaced(request.poses_output, level_mark, std::to_string(level)),
                            pose_mark, pose);
}

bool has_standard_output(const Simplify_request& request)
{
  return is_standard_output(request.output) || is_standard_output(request.report) ||
         is_standard_output(request.log) || is_standard_output(request.html);
}

Json options_json(const Simplify_request& request)
{
  const Simplify_options& options = request.options;
  Json part_ratios = Json::array();
  for (const Simplify_intent::Part_ratio& part : request.intent.ratios)
    part_ratios.push_back({{"part", part.name}, {"ratio", part.ratio}});
  return {{"ratio", or_null(options.ratio)},
          {"faces", or_null(options.faces)},
          {"error", or_null(options.max_error)},
          {"error_everywhere", request.is_error_everywhere},
          {"normal_change", options.max_normal_change},
          {"aspect_ratio", options.min_aspect_ratio},
          {"border_turn", options.max_border_turn},
          {"corner_height", options.max_corner_height},
          {"seam_turn", options.max_seam_turn},
          {"border_drift", options.max_border_drift},
          {"placement",
           request.placement == Placement_choice::automatic ? "auto" : name_of(chosen(request.placement))},
          {"instances", options.instances == Instances::shared ? "shared" : "apart"},
          {"loop", options.loop == Collapse_loop::own ? "own" : "cgal"},
          {"index", options.index == Face_index::packed ? "packed" : "clusters"},
          {"cluster_size", options.faces_per_cluster},
          {"intersection_check", options.check_intersections},
          {"clearance", or_null(options.clearance)},
          {"stabiliser", options.cost.stabiliser},
          {"memory", options.cost.memory},
          {"border_weight", options.cost.border_weight},
          {"uv_weight", options.uv_weight},
          {"normal_weight", options.normal_weight},
          {"part_ratios", part_ratios},
          {"lods", request.lods},
          {"progressive", or_null(request.progressive)},
          {"lock", request.intent.locked},
          {"keep", request.intent.kept},
          {"may_intersect", request.may_intersect},
          {"weights", or_null(request.intent.weights)},
          {"obstacle", or_null(request.obstacle)},
          {"pose", request.poses.files},
          {"morphs", request.poses.are_morphs},
          {"animation", or_null(request.poses.animation)},
          {"every", request.poses.every},
          {"humanoid_poses", request.poses.are_of_humanoid},
          {"without_pose", request.poses.left_out},
          {"obstacle_pose", request.obstacle_poses.files},
          {"obstacle_animation", or_null(request.obstacle_poses.animation)},
          {"obstacle_humanoid_poses", request.obstacle_poses.are_of_humanoid},
          {"key_poses", request.are_key_poses_chosen ? "auto" : "all"},
          {"poses_out", or_null(request.poses_output)},
          {"weld", weld_json(request)},
          {"sewn", request.is_sewn},
          {"normals", name_of(request.normals)},
          {"drop_part", request.dropped_parts.names},
          {"drop_smaller", request.dropped_parts.smaller_than},
          {"drop_attribute", request.dropped_attributes},
          {"orient", request.are_faces_oriented ? "auto" : "keep"},
          {"polygons", request.are_polygons_split ? "split" : "keep"},
          {"threads", or_null(request.threads)},
          {"cells", request.is_in_cells},
          {"defects", name_of(defects_of(request))},
          {"strict", defects_of(request) == Defects::refuse}};
}

bool has_own_error(const Simplify_request& request)
{
  return (!request.error.empty() || request.is_error_everywhere) && request.options.max_error.has_value();
}

bool is_shape_kept(const Simplify_request& request)
{
  return request.progressive.empty() && !request.is_error_everywhere;
}

Placement placement_for(const Simplify_request& request, const Triangle_soup& soup)
{
  const auto is_number_in_whole = [](const Attribute& attribute) {
    return attribute.name == vertex_in_whole_property;
  };
  if (request.placement != Placement_choice::automatic)
    return chosen(request.placement);
  const bool are_vertices_needed =
      !soup.poses.empty() || !request.progressive.empty() ||
      (soup.scene && are_levels_in_one_file(request)) ||
      std::any_of(soup.vertex_attributes.begin(), soup.vertex_attributes.end(), is_number_in_whole);
  return are_vertices_needed || soup.triangles.size() > Simplify_options::most_faces_shaded
             ? Placement::vertices
             : Placement::optimal;
}

const char* name_of(Placement placement)
{
  return placement == Placement::optimal ? "optimal" : "vertices";
}

Defects defects_of(const Simplify_request& request)
{
  return request.is_strict ? Defects::refuse : request.defects.value_or(Prepare_options().defects);
}

void complete(Simplify_request& request)
{
  if (are_levels_in_one_file(request)) // from fine to coarse
    std::sort(request.lods.begin(), request.lods.end(), std::greater<>());
  request.options.check_intersections = !request.is_unguarded;
  request.options.faces_per_cell = request.is_in_cells ? Simplify_options::default_faces_per_cell : 0;
  request.options.faces_per_cluster = request.faces_per_cluster.value_or(request.options.faces_per_cluster);
  request.options.max_corner_height = request.corner_height.value_or(request.options.max_corner_height);
  request.options.max_border_turn = request.border_turn.value_or(request.options.max_border_turn);
  request.options.instances = request.instances.value_or(request.options.instances);
  read_ratios(request);
  read_error(request);
  read_weld(request);
  check(request);
  if (is_without_target(request))
    request.options.ratio = 1; // for what is in no part with a ratio
}

} // namespace selvedge::app
