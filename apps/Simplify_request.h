// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_SIMPLIFY_REQUEST_H
#define SELVEDGE_APPS_SIMPLIFY_REQUEST_H

#include "poses_option.h"
#include "report_json.h"

#include <selvedge/drop_parts.h>
#include <selvedge/simplify.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::app {

/// Where collapses put merged vertices, as the user wants it.
enum class Placement_choice { automatic, vertices, optimal };

/// What the command line asks of `selvedge simplify`.
struct Simplify_request
{
  std::string input;
  std::string output;
  std::optional<Mesh_format> format; // of IN or output where they are "-"
  std::string report;
  std::string log;
  std::string progressive;
  std::string html;
  std::vector<std::string> ratios; // "R" or "PART=R"
  std::string error;               // "E", "none", or empty for the default
  bool is_error_everywhere = false;
  std::vector<double> lods;
  std::string obstacle;
  Pose_sources poses, obstacle_poses;
  bool are_key_poses_chosen = false;
  std::string poses_output;               // with {pose}
  std::vector<std::string> may_intersect; // "PART:PART"
  Placement_choice placement = Placement_choice::automatic;
  Simplify_options options; // but for the placement; `complete` puts the next four in
  std::optional<Instances> instances;
  std::optional<std::size_t> faces_per_cluster;
  std::optional<double> corner_height, border_turn;
  Simplify_intent intent;
  bool is_unguarded = false;
  bool is_in_cells = false;
  std::string weld;         // "EPS", a word, or empty
  double weld_distance = 0; // 0 unless EPS is given; then open seams are ignored
  Open_seams open_seams = Open_seams::hold;
  Normals_choice normals = Normals_choice::automatic;
  Parts_to_drop dropped_parts;
  std::vector<std::string> dropped_attributes;
  bool are_faces_oriented = true;
  bool is_sewn = false;
  std::optional<Defects> defects; // none: the default
  bool is_strict = false;         // the same as Defects::refuse
  bool is_target_required = false;
  bool is_quiet = false;
  bool is_ascii = false;
  bool are_polygons_split = false;
  std::optional<std::size_t> threads;
};

/// Declares the options of the subcommand, which set `request`.
void add_options(CLI::App& command, Simplify_request& request);

/// Completes the request once all options are read, and refuses what can be refused before any work is done.
///
/// @throws Argument_error  the options do not fit each other
/// @throws Output_error    a file cannot be written
void complete(Simplify_request& request);

/// Returns whether several levels of detail go to one file: the name of the output has no {lod}.
bool are_levels_in_one_file(const Simplify_request& request);

/// Returns whether gaps in seams are closed, by --weld auto or --weld EPS.
bool are_gaps_welded(const Simplify_request& request);

/// Returns the format of the output.
Mesh_format output_format(const Simplify_request& request);

/// Returns how many of the further poses of the input are guarded until the judge refuses a result in others.
std::size_t poses_guarded_first(const Simplify_request& request, std::size_t poses);

/// Returns the files of poses and of the obstacle, which the run reads and must not replace.
std::vector<Named_file> files_read_beside(const Simplify_request& request);

/// Returns the output file of each level: the name with the level's number, from 1, in place of each {lod}.
/// It is the name as given, once, when there are no levels or all are in one file.
std::vector<std::string> outputs(const Simplify_request& request);

/// Returns whether a file of `Simplify_request::poses_output` holds all poses, by its name. Throws
/// `Argument_error` when the name stands for no format.
bool is_one_file_of_poses(const std::string& name);

/// Returns the output file of a pose: `Simplify_request::poses_output`, or the name that it has for a level
/// (from 1), with the name of the pose in place of {pose}.
std::string pose_output(const Simplify_request& request, std::size_t level, const std::string& pose);

/// Returns whether the request writes something to this program's standard output.
bool has_standard_output(const Simplify_request& request);

/// Returns whether the user has set a limit of the distances between original and result.
bool has_own_error(const Simplify_request& request);

/// Returns whether a reduction that gets stuck above its target is done again, to more faces
/// (`Missed_target`): neither where a file has every level on the way in any case, nor where the error is to
/// be kept everywhere.
bool is_shape_kept(const Simplify_request& request);

/// Returns where collapses put merged vertices. `Placement_choice::automatic` is where the surface changes
/// least, in a mesh of at most `Simplify_options::most_faces_shaded` faces. But vertices stay at those of the
/// input where something needs them there: further poses, a progressive file, levels of detail that share the
/// vertices of a glTF file, or a piece of `selvedge cells cut`, whose box no vertex may leave.
Placement placement_for(const Simplify_request& request, const Triangle_soup& soup);

/// Returns the word for this in reports: vertices or optimal.
const char* name_of(Placement placement);

/// Returns what becomes of offending pairs of the input.
Defects defects_of(const Simplify_request& request);

/// Returns the options of the request as the report lists them.
Json options_json(const Simplify_request& request);

} // namespace selvedge::app

#endif // SELVEDGE_APPS_SIMPLIFY_REQUEST_H
