// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output_files.h"
#include "standard_streams.h"
#include "subcommands.h"
#include "text.h"

#include <selvedge/Error.h>
#include <selvedge/generate.h>
#include <selvedge/mesh_files.h>
#include <selvedge/poses.h>
#include <selvedge/rounding.h>
#include <selvedge/verify.h>

#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace selvedge::app {
namespace {

struct Generate_request
{
  std::string name;
  std::string output;
  std::optional<Mesh_format> mesh_format;
  Generate_options options;
  std::size_t poses = 0;
  std::string poses_output;
  bool is_list = false;
  bool is_quiet = false;
  bool is_ascii = false;
};

std::string named_pose(const Generate_request& request, const std::string& pose)
{
  if (request.poses_output.find(pose_mark) == std::string::npos)
    throw Argument_error(
        "--poses-out: the name must contain {pose}, which stands for the number of the pose, or "
        "be that of a point cache (.mdd, .pc2)");
  return with_mark_replaced(request.poses_output, pose_mark, pose);
}

// The options that change nothing in a scene; garments use all.
const std::map<std::string_view, std::vector<std::string>> unused_options{
    {"sheets", {"--thickness"}},
    {"folded", {"--thickness"}},
    {"nested", {"--thickness", "--fold-depth", "--folds"}},
    {"seams", {"--layers", "--thickness", "--gap", "--fold-depth", "--folds"}},
    {"tunnel", {"--layers", "--thickness", "--gap", "--fold-depth", "--folds", "--seed"}},
    {"grid", {"--layers", "--thickness", "--gap", "--fold-depth", "--folds", "--seed"}},
    {"needles", {"--thickness"}}};

/// Refuses an option that changes nothing in a scene, or in the list of all.
void require_use(const Generate_request& request, const CLI::App& command)
{
  if (request.is_list) {
    for (const CLI::Option* option : command.get_options())
      if (option->count() > 0 && option->get_name() != "--list")
        throw Argument_error("--list names all scenes and makes none; leave it out, or " +
                             option->get_name());
    return;
  }
  if (const auto unused = unused_options.find(request.name); unused != unused_options.end())
    for (const std::string& option : unused->second)
      if (command.count(option) > 0)
        throw Argument_error(option + ": changes nothing in the scene '" + request.name + "'; leave it out");
}

Exit_code run(const Generate_request& request)
{
  if (request.is_list) {
    for (const Scene_description& scene : scenes())
      std::cout << scene.name << std::string(10 - scene.name.size(), ' ') << scene.description << '\n';
    std::cout << std::flush;
    return exit_done;
  }
  if (request.name.empty())
    throw Argument_error("say what to generate; selvedge generate --list names all scenes");
  if (request.output.empty())
    throw Argument_error("say where to write the mesh: -o FILE");
  check_streams({}, {{"--output", request.output}}, request.mesh_format);
  const Mesh_format format = format_of(request.output, request.mesh_format);
  require_writable(request.output);
  require_use_of_ascii(request.is_ascii, {request.output, request.poses_output}, request.mesh_format);
  for (const std::string& name : {request.output, request.poses_output})
    require_avatar(name, {});
  if ((request.poses > 0) != !request.poses_output.empty())
    throw Argument_error("--poses N says how many, and --poses-out PATTERN where; give both or none");
  const bool is_cache = is_point_cache(request.poses_output);
  if (request.poses > 0 && !is_cache) {
    format_of(named_pose(request, "1"), std::nullopt);
    for (std::size_t i = 1; i <= request.poses; ++i)
      require_distinct({{"--poses-out", named_pose(request, std::to_string(i))}},
                       {{"--output", request.output}});
  }
  if (request.poses > 0)
    require_writable(is_cache ? request.poses_output : named_pose(request, "1"));

  Triangle_soup soup = generate(request.name, request.options);
  if (stores_float32(format) && round_to_float32(soup).coordinates > 0 && !is_embedded(soup))
    throw Output_error(request.output +
                       ": not written, because rounding to the 32-bit floats of this format would make "
                       "triangles touch; choose .ply or .obj, or a larger --gap");
  soup.poses = moving_poses(soup, request.poses);
  if (is_cache || (request.poses > 0 && stores_float32(mesh_format(request.poses_output))))
    for (Pose& pose : soup.poses)
      for (Point_3& p : pose.points)
        p = Point_3(nearest_float32(p.x()), nearest_float32(p.y()), nearest_float32(p.z()));
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < soup.poses.size(); ++i)
    pairs += offending_pairs(in_pose(soup, i)).size();
  write_output(request.output, soup, format, request.is_ascii);
  if (is_cache)
    write_point_cache(output_path(request.poses_output), soup);
  for (std::size_t i = 0; i < soup.poses.size() && !is_cache; ++i) {
    const std::string name = named_pose(request, soup.poses[i].name);
    write_output(name, in_pose(soup, i), mesh_format(name), request.is_ascii);
  }
  const Text_to_standard_error elsewhere(is_standard_output(request.output));
  if (request.is_quiet)
    return exit_done;
  std::cout << request.output << ": '" << request.name << "' with " << counted(soup.triangles.size(), "face")
            << ", free of intersections by construction" << std::endl;
  if (request.poses > 0)
    std::cout << request.poses_output << ": " << counted(request.poses, "pose") << ", "
              << (pairs == 0 ? "judged: embedded in each"
                             : counted(pairs, "offending pair") +
                                   " in all; fewer with more --faces or a larger --gap")
              << std::endl;
  return exit_done;
}

} // namespace

Action add_generate(CLI::App& command)
{
  const auto request = std::make_shared<Generate_request>();
  Generate_options& options = request->options;
  command.add_option("NAME", request->name, "Scene to make; --list names all of them.")->type_name("");
  command.add_option("-o,--output", request->output, std::string("File to write: ") + mesh_endings + ".")
      ->type_name("FILE");
  add_format_option(command, request->mesh_format);
  command.add_flag("--list", request->is_list, "List all scenes.");
  command.add_option("--faces", options.faces, "Number of faces, within 2 %.")
      ->transform(whole_number())
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--layers", options.layers, "Number of layers.")->type_name("L")->capture_default_str();
  command
      .add_option("--thickness", options.thickness,
                  "Thickness of a garment's cloth in metres. 0 makes each layer a single sheet.")
      ->type_name("T")
      ->capture_default_str();
  command.add_option("--gap", options.gap, "Smallest distance between two layers in metres.")
      ->type_name("G")
      ->capture_default_str();
  command.add_option("--fold-depth", options.fold_depth, "Amplitude of folds and waves in metres.")
      ->type_name("D")
      ->capture_default_str();
  command
      .add_option("--folds", options.folds, "Number of folds around a garment, or of waves along a sheet.")
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Seed of the random irregularities.")
      ->check(in_range(0))
      ->type_name("S")
      ->capture_default_str();
  command
      .add_option("--poses", request->poses,
                  "Number of poses to make as well: the mesh twists, sways and breathes.")
      ->transform(whole_number())
      ->type_name("N");
  command
      .add_option("--poses-out", request->poses_output,
                  "Files for the poses, of which {pose} is the number, or one point cache (.mdd, .pc2).")
      ->type_name("PATTERN");
  command.add_flag("--quiet", request->is_quiet, "Print no summary.");
  add_ascii_option(command, request->is_ascii);
  command.footer("Examples:\n"
                 "  selvedge generate --list\n"
                 "  selvedge generate skirt -o skirt.obj --faces 50000 --layers 3\n"
                 "  selvedge generate skirt -o skirt.obj --poses 8 --poses-out 'skirt_{pose}.obj'\n"
                 "  selvedge generate sheets -o sheets.ply --faces 1000000 --layers 5 --gap 1e-9\n\n"
                 "The same name and options give the same bytes on every machine.");
  return [request, &command] {
    require_use(*request, command);
    return run(*request);
  };
}

} // namespace selvedge::app
