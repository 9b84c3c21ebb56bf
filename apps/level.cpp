// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output_files.h"
#include "standard_streams.h"
#include "subcommands.h"
#include "text.h"

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/poses.h>
#include <selvedge/progressive.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::app {
namespace {

struct Level_request
{
  std::string input;
  std::string output;
  std::string poses_output;          // with {pose}
  std::optional<Mesh_format> format; // of output where it is "-"
  std::optional<std::size_t> faces;
  std::optional<double> ratio;
  bool is_quiet = false;
  bool is_ascii = false;
};

// Says why a progressive file has no poses to write, and where its shapes are instead.
std::string without_poses(const Triangle_soup& soup)
{
  std::string own;
  for (const std::string& name : not_carried(soup, Mesh_format::obj))
    for (const char* const shapes : {"morph targets", "animations", "skins"})
      if (name == shapes)
        own += (own.empty() ? "" : " and ") + name;
  if (own.empty())
    return "the file holds no poses beside its own; leave the option out";
  return "the file holds no poses of other files, but " + own +
         ", which its levels have themselves: leave the option out, and write the level to a .glb file";
}

// Writes the poses that a progressive file holds.
void write_poses(const Level_request& request, const Triangle_soup& soup)
{
  if (soup.poses.empty())
    throw Argument_error("--poses-out: " + without_poses(soup));
  if (is_point_cache(request.poses_output))
    return write_point_cache(output_path(request.poses_output), soup);
  std::vector<Named_file> written = {{"--output", request.output}};
  for (const Pose& pose : soup.poses)
    written.push_back({"--poses-out", with_mark_replaced(request.poses_output, pose_mark, pose.name)});
  require_distinct(written, {{"FILE", request.input}});
  require_writable(written);
  for (std::size_t i = 0; i < soup.poses.size(); ++i) {
    const std::filesystem::path& path = written[i + 1].path;
    write_output(path, in_pose(soup, i), output_format(path), request.is_ascii);
  }
}

Exit_code run(const Level_request& request)
{
  if (!request.faces && !request.ratio)
    throw Argument_error("say which level: give --faces or --ratio");
  check_streams({}, {{"--output", request.output}}, request.format);
  const Mesh_format format = format_of(request.output, request.format);
  require_use_of_ascii(request.is_ascii, {request.output, request.poses_output}, request.format);
  require_distinct({{"--output", request.output}}, {{"FILE", request.input}});
  require_writable(request.output);
  if (!request.poses_output.empty() && !is_point_cache(request.poses_output) &&
      request.poses_output.find(pose_mark) == std::string::npos)
    throw Argument_error(
        "--poses-out: the name must contain {pose}, which stands for the name of the pose, or be "
        "that of a point cache (.mdd, .pc2)");

  const Progressive_mesh mesh = read_progressive(request.input);
  const std::size_t target =
      std::max(request.faces.value_or(0), request.ratio ? faces_at_ratio(mesh, *request.ratio) : 0);
  const std::size_t steps = steps_to_faces(mesh, target);
  Triangle_soup soup = level(mesh, steps);
  relocate(soup, format, request.input, request.output);
  if (!request.poses_output.empty())
    write_poses(request, soup);
  write_output(request.output, soup, format, request.is_ascii);

  const Text_to_standard_error elsewhere(is_standard_output(request.output));
  if (request.is_quiet)
    return exit_done;
  std::cout << request.output << ": " << counted(soup.triangles.size(), "face") << " of "
            << with_commas(mesh.faces.front()) << ", after " << with_commas(steps) << " of "
            << counted(mesh.step_count(), "step") << ", each of which was judged";
  if (soup.triangles.size() > target)
    std::cout << "; the file has no level of fewer faces";
  std::cout << std::endl;
  return exit_done;
}

} // namespace

Action add_level(CLI::App& command)
{
  const auto request = std::make_shared<Level_request>();
  command.add_option("FILE", request->input, "Progressive file, made by `selvedge simplify --progressive`.")
      ->required()
      ->type_name("");
  command
      .add_option("-o,--output", request->output,
                  std::string("File to write: ") + mesh_endings + "; its ending chooses the format.")
      ->required()
      ->type_name("FILE");
  add_format_option(command, request->format);
  command
      .add_option("--faces", request->faces,
                  "Number of faces to keep, of all. The level is the first one that has no more.")
      ->transform(whole_number())
      ->type_name("N");
  command
      .add_option("--ratio", request->ratio,
                  "Share of the faces to keep, from 0 to 1, of those that could be reduced, as in simplify.")
      ->check(in_range(0, 1))
      ->type_name("R");
  command
      .add_option("--poses-out", request->poses_output,
                  "Files for the poses that FILE holds, of which {pose} is the name. Or one point cache.")
      ->type_name("PATTERN");
  command.add_flag("--quiet", request->is_quiet, "Print no summary.");
  add_ascii_option(command, request->is_ascii);
  command.footer(
      "Examples:\n"
      "  selvedge simplify jacket.obj -o least.glb --ratio 0.02 --progressive jacket.glb\n"
      "  selvedge level jacket.glb --faces 20000 -o jacket_20000.glb\n"
      "  selvedge level jacket.glb --ratio 0.25 -o jacket_quarter.obj\n"
      "  selvedge verify jacket_20000.glb --against jacket.glb      # judge it once more\n\n"
      "A level has the faces that `selvedge simplify` gives for the same number with the same options,\n"
      "and no reduction is run again. A file that is not as simplify wrote it is refused.");
  return [request] { return run(*request); };
}

} // namespace selvedge::app
