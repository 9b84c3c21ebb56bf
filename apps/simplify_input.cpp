// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "simplify_input.h"

#include "attributes_option.h"
#include "cost_of_poses.h"
#include "dropped_parts_options.h"
#include "output_files.h"
#include "poses_option.h"
#include "standard_streams.h"
#include "text.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>
#include <selvedge/internal/Stopwatch.h>
#include <selvedge/mesh_files.h>
#include <selvedge/poses.h>
#include <selvedge/rounding.h>
#include <selvedge/suited_normals.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

/// One call of `read_input`.
class Input_reader
{
public:
  Input_reader(const Simplify_request& request, Progress_bar& bar) : m_request(request), m_bar(bar) {}

  Simplify_input run()
  {
    Triangle_soup soup = read();
    const Triangle_soup obstacle = read_obstacle();
    prepare_input(std::move(soup), obstacle);
    return std::move(m_result);
  }

private:
  // One rounding for all files: the mesh and its poses are judged as they are written.
  bool is_rounded(const Triangle_soup& soup) const
  {
    const std::string& poses = m_request.poses_output;
    if (needs_float32(soup, output_format(m_request)) ||
        (!m_request.progressive.empty() && needs_float32(soup, Mesh_format::glb)))
      return true;
    if (poses.empty() || (!is_point_cache(poses) && !stores_float32(mesh_format(poses))))
      return false;
    if (is_one_file_of_poses(poses) && !is_point_cache(poses) && !has_float32_points(soup.points))
      return true; // the mesh itself is in that file as well
    return !std::all_of(soup.poses.begin(), soup.poses.end(),
                        [](const Pose& pose) { return has_float32_points(pose.points); });
  }

  // A scene is written with the coordinates of its nodes, which lead to no rounded coordinates of the world.
  void require_one_rounding(const Triangle_soup& soup) const
  {
    const bool is_scene_written = is_gltf(output_format(m_request)) || !m_request.progressive.empty();
    if (!soup.scene || !is_scene_written || !is_rounded(soup) || has_float32_points(soup.points))
      return;
    const bool is_of_output = needs_float32(soup, output_format(m_request));
    throw Argument_error(
        (is_of_output ? std::string("--progressive") : "--poses-out " + m_request.poses_output) +
        ": the transforms of nodes bring vertices of " + m_request.input + " to places that are no 32-bit " +
        "floats, which " + (is_of_output ? m_request.output : "that file") + " needs, and " +
        (is_gltf(output_format(m_request)) ? m_request.output : m_request.progressive) +
        " cannot be rounded with it; " +
        (is_of_output
             ? "leave out --progressive, or write the mesh as .obj, .ply or .glb"
             : "write poses of their own, as with --poses-out 'NAME_{pose}.obj', or the mesh as .obj"));
  }

  void drop_parts_of(Mesh_file& file)
  {
    const Parts_left left = drop_parts(file.soup, m_request.dropped_parts, m_request.input);
    if (!m_request.dropped_parts.names.empty())
      file.notes.remarks["faces left out by --drop-part"] += left.named;
    if (left.small > 0)
      file.notes.remarks["faces left out by --drop-smaller, in " + counted(left.small_pieces, "piece")] +=
          left.small;
    else if (m_request.dropped_parts.smaller_than > 0 && !m_request.is_quiet)
      m_bar.complain("--drop-smaller leaves out nothing: no piece of " + input_name(m_request.input) +
                     " is that small");
    m_result.log_header.dropped_parts = m_request.dropped_parts;
  }

  void drop_attributes_of(Mesh_file& file)
  {
    const std::size_t joined = drop_attributes(file.soup, m_request.dropped_attributes, m_request.input);
    if (joined > 0)
      file.notes.remarks["corners joined, for their vertices differ in nothing but what is left out"] +=
          joined;
    m_result.log_header.dropped = m_request.dropped_attributes;
  }

  void suit_normals_of(Mesh_file& file)
  {
    m_normals = m_request.normals;
    if (m_normals == Normals_choice::automatic && !m_request.progressive.empty())
      return; // the file has one normal for each vertex, and lines stay
    const Suited_normals suited = suit_normals(file.soup, m_normals, has_normals_of_vertices(file.format));
    m_normals = suited.choice;
    if (suited.joined_corners == 0)
      return;
    file.notes.remarks[remark_on_joined_corners] += suited.joined_corners;
    m_result.log_header.normals = shared_normals(m_normals);
  }

  void say_what_poses_cost(const Triangle_soup& soup)
  {
    if (m_request.is_quiet || !m_request.options.check_intersections)
      return;
    const std::size_t poses = soup.poses.size(),
                      every = has_frames(m_request.poses, m_request.input) ? m_request.poses.every : 0;
    if (const std::string cost =
            cost_of_poses(poses, soup.triangles.size(), poses_guarded_first(m_request, poses), every);
        !cost.empty())
      m_bar.complain(cost);
  }

  // Their names are known only now.
  void check_pose_outputs(const std::vector<Pose>& poses) const
  {
    if (m_request.poses_output.empty())
      return;
    std::vector<Named_file> poses_written;
    for (std::size_t level = 1; level <= std::max<std::size_t>(m_request.lods.size(), 1); ++level) {
      for (const Pose& pose : poses) {
        poses_written.push_back({"--poses-out", pose_output(m_request, level, pose.name)});
        if (is_one_file_of_poses(m_request.poses_output))
          break;
      }
    }
    std::vector<Named_file> written = poses_written;
    for (const std::string& mesh : outputs(m_request))
      written.push_back({"--output", mesh});
    for (const auto& [option, name] :
         {std::make_pair("--report", m_request.report), std::make_pair("--log", m_request.log),
          std::make_pair("--progressive", m_request.progressive), std::make_pair("--html", m_request.html)})
      written.push_back({option, name});
    require_distinct(written, files_read_beside(m_request));
    // The mesh may take the place of the input, but no pose may.
    require_distinct(poses_written, {{"IN", m_request.input}});
    require_writable(written);
  }

  // Returns the input without what is left out of it, having refused outputs that do not fit it.
  Triangle_soup read()
  {
    m_bar.begin("reading");
    const internal::Stopwatch stopwatch;
    Mesh_input input(m_request.input, m_request.format);
    Mesh_file file = input.read();
    m_result.seconds = stopwatch.seconds();
    read_poses(m_request.poses, m_request.input, file.soup);
    if (!m_request.log.empty()) {
      m_result.numbering.emplace(file.soup, file.format == Mesh_format::stl);
      m_result.log_header.vertices = m_result.numbering->size();
      m_result.log_header.triangles = file.soup.triangles.size();
    }
    drop_parts_of(file);
    drop_attributes_of(file);
    suit_normals_of(file);
    m_result.report = input_json(m_request.input, file);
    check_pose_outputs(file.soup.poses);
    require_one_rounding(file.soup);
    say_what_poses_cost(file.soup);
    if (are_levels_in_one_file(m_request) && m_request.placement == Placement_choice::optimal &&
        file.soup.scene)
      throw Argument_error(
          "--lods: levels with vertices at new places (--placement optimal) cannot share the "
          "scene of a glTF file; write each to a file of its own, as with -o "
          "'jacket_{lod}.glb', or leave out --placement optimal");
    if (m_request.are_polygons_split)
      file.soup.polygons.clear();
    m_result.polygons = file.soup.polygons.size();
    if (!m_request.log.empty()) {
      m_result.log_header.sha256 = input.sha256();
      m_result.log_header.is_rounded_to_float32 = is_rounded(file.soup);
      for (const Pose& pose : file.soup.poses)
        m_result.log_header.poses.push_back({pose.name, digest_of(pose.points), {}});
    }
    return std::move(file.soup);
  }

  Triangle_soup read_obstacle()
  {
    if (m_request.obstacle.empty())
      return {};
    Mesh_input input(m_request.obstacle, m_request.format);
    Triangle_soup obstacle = input.read().soup;
    read_obstacle_poses(m_request.obstacle_poses, m_request.obstacle, m_request.poses, obstacle);
    m_result.log_header.obstacle = {obstacle.points.size(), obstacle.triangles.size(), input.sha256()};
    return obstacle;
  }

  void prepare_input(Triangle_soup soup, const Triangle_soup& obstacle)
  {
    for (const std::string& name : {m_request.output, m_request.progressive})
      require_avatar(name, soup);
    m_result.references = relocate(soup, output_format(m_request), m_request.input, m_request.output);

    m_bar.begin("judging the input", soup.poses.size());
    Prepare_options options;
    options.round_to_float32 = is_rounded(soup);
    options.defects = defects_of(m_request);
    options.weld_distance = m_request.weld_distance;
    options.open_seams = m_request.open_seams;
    options.normals = m_normals;
    options.orient = m_request.are_faces_oriented;
    options.may_intersect = parts_in_pairs(soup, m_request.may_intersect, "--may-intersect");
    keep_from_snapping(options, m_request.intent);
    try {
      m_result.prepared = prepare(std::move(soup), options, obstacle);
      const Normals_treatment normals = m_result.prepared.normals;
      if (!m_request.progressive.empty() && (normals == Normals_treatment::smooth ||
                                             normals == Normals_treatment::smoothed || are_picked(normals)))
        throw Argument_error(
            "--progressive: normals that are made anew are others in every level, and the file has "
            "one for each vertex; leave out --normals");
    } catch (const Input_error& error) {
      throw Input_error(input_name(m_request.input) +
                        (m_request.dropped_parts.empty() ? ": " : ", without what is left out: ") +
                        error.what());
    }
  }

  const Simplify_request& m_request;
  Progress_bar& m_bar;
  Simplify_input m_result;
  Normals_choice m_normals = Normals_choice::automatic; // that suits the input
};

} // namespace

Simplify_input read_input(const Simplify_request& request, Progress_bar& bar)
{
  return Input_reader(request, bar).run();
}

} // namespace selvedge::app
