// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "World_run.h"
#include "support/Temporary_folder.h"

#include "weld/snapping.h"
#include <selvedge/Error.h>
#include <selvedge/Reduction_log.h>
#include <selvedge/attributes.h>
#include <selvedge/collapse_log.h>
#include <selvedge/drop_parts.h>
#include <selvedge/merge.h>
#include <selvedge/progressive.h>

#include <sstream>

namespace selvedge::test {
namespace {

void reduce(const World& world, const Prepared_soup& prepared, Reduction_log* log, World_run& run)
{
  Simplify_options options = world.options;
  options.is_history_kept = true;
  options.on_collapse = [&](const Soup_collapse& collapse) {
    run.collapses.push_back(collapse);
    if (log)
      log->add_collapse(collapse);
  };
  if (world.questions)
    options.should_stop = [&run, left = *world.questions](const Simplify_progress&) mutable {
      return run.is_told_to_stop = run.is_told_to_stop || left-- == 0;
    };
  options.is_progression_recorded = options.placement == Placement::vertices;
  run.result = simplify_soup(prepared, options, world.intent);
}

World_run prepared(const World& world)
{
  World_run run;
  try {
    run.prepared = prepare(input_of(world), world.prepare_options(), world.obstacle);
  } catch (const Input_error& error) {
    run.refusal = error.what();
  }
  return run;
}

const char* file_name(const World& world)
{
  static constexpr const char* s_names[] = {"out.obj", "out.off", "out.ply",
                                            "out.stl", "out.glb", "out.gltf"};
  return s_names[std::size_t(world.output_format)];
}

} // namespace

Triangle_soup input_of(const World& world, bool are_vertices_joined)
{
  Triangle_soup soup = world.soup;
  drop_parts(soup, world.dropped_parts);
  drop_attributes(soup, world.dropped);
  if (are_vertices_joined && joins_vertices(world.normals))
    share_vertices_without_normals(soup, world.normals);
  return soup;
}

Verification verify_guarded(const World& world, const Simplified_soup& result, const Prepared_soup& prepared)
{
  Verification verification = verify(result, prepared);
  std::vector<Verification::In_pose>& poses = verification.poses;
  for (std::size_t pose = poses.size(); pose-- > 0;)
    if (!world.is_guarded(pose))
      poses.erase(poses.begin() + std::ptrdiff_t(pose));
  return verification;
}

World_run run(const World& world)
{
  World_run run = prepared(world);
  if (run.refusal)
    return run;
  const Prepare_options prepare_options = world.prepare_options();
  run.unsnapped = run.prepared;
  if (world.weld_distance > 0 || world.open_seams == Open_seams::weld) {
    Prepare_options without = prepare_options;
    without.weld_distance = 0;
    without.open_seams = Open_seams::ignore;
    run.unsnapped = prepare(input_of(world), without, world.obstacle);
  }

  const Log_numbering numbering(world.soup, world.input_format == Mesh_format::stl);
  Log_header header;
  header.vertices = numbering.size();
  header.triangles = world.soup.triangles.size();
  header.is_rounded_to_float32 = prepare_options.round_to_float32;
  header.dropped_parts = world.dropped_parts;
  header.dropped = world.dropped;
  if (input_of(world).triangles != input_of(world, false).triangles)
    header.normals = shared_normals(world.normals);
  if (!world.obstacle.triangles.empty())
    header.obstacle = {world.obstacle.points.size(), world.obstacle.triangles.size(), {}};
  std::ostringstream stream;
  Reduction_log log(stream, header, numbering, run.prepared, world.options);
  reduce(world, run.prepared, &log, run);
  log.finish(run.result);
  run.log = stream.str();
  run.verification = verify_guarded(world, run.result, run.prepared);

  if (!run.result.soup.triangles.empty()) {
    const Temporary_folder folder;
    write_mesh(folder / file_name(world),
               world.is_sewn ? merged_at_positions(run.result.soup) : run.result.soup);
    run.read_back = read_mesh(folder / file_name(world)).soup;
    if ((world.output_format == Mesh_format::glb || world.output_format == Mesh_format::gltf) &&
        !world.is_sewn && !run.result.progression.empty() &&
        run.prepared.normals != Normals_treatment::smooth && !are_picked(run.prepared.normals)) {
      write_progressive(folder / "all.glb", run.prepared.soup, run.result.progression);
      const Progressive_mesh mesh = read_progressive(folder / "all.glb");
      run.last_level = level(mesh, mesh.step_count());
    }
  }
  return run;
}

World_run run_without_output(const World& world)
{
  World_run run = prepared(world);
  if (!run.refusal)
    reduce(world, run.prepared, nullptr, run);
  return run;
}

World_run run_again(const World& world, const Prepared_soup& prepared)
{
  World_run run;
  reduce(world, prepared, nullptr, run);
  return run;
}

} // namespace selvedge::test
