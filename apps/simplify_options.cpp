// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Simplify_request.h"

#include "attributes_option.h"
#include "dropped_parts_options.h"
#include "html_report.h"
#include "output_files.h"
#include "part_pairs_option.h"
#include "poses_option.h"
#include "standard_streams.h"
#include "subcommands.h"
#include "text.h"
#include "threads_option.h"

#include <string>

namespace selvedge::app {
namespace {

void add_options_of_targets(CLI::App& command, Simplify_request& request)
{
  Simplify_options& options = request.options;
  const char* const how_far =
      "How far to reduce (with several of these, the reduction stops at the first one that is met)";
  command
      .add_option(
          "--ratio", request.ratios,
          "Share of the faces to keep, from 0 to 1, of those that can be reduced: frozen and locked faces "
          "stay and do not count. PART=R is the share of one group, object or material, as `selvedge info` "
          "names them; R alone is then for all others, which stay as they are where nothing says how far to "
          "reduce them. May be given several times.")
      ->type_name("[PART=]R")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(how_far);
  command
      .add_option("--faces", options.faces,
                  "Number of faces to keep, of all; with --keep or --ratio PART=R, of all others.")
      ->transform(whole_number())
      ->type_name("N")
      ->group(how_far);
  command
      .add_option(
          "--error", request.error,
          "Largest distance between the surfaces of the original and the result, as a share of the "
          "diagonal of the bounding box, measured at vertices and at points between them; none sets no "
          "limit. Without another target, the reduction goes as far as this allows. With this option, the "
          "summary says how far any point is.")
      ->type_name("E|none")
      ->default_str("0.01")
      ->group(how_far);
  command
      .add_flag("--error-everywhere", request.is_error_everywhere,
                "Keep the limit of --error at every point of both surfaces, in every output and pose: judge "
                "the result, and reduce again with a smaller limit while any point may be farther away, and "
                "with a larger one when all are far nearer: twice to seven times in all.")
      ->group(how_far);

  command
      .add_option(
          "--lods", request.lods,
          "Ratios of several levels of detail, made in one run. Each is what a run for it alone gives "
          "where that reaches its target. In the name of the output, {lod} stands for the number of the level. A .glb or .gltf output "
          "without {lod} holds all levels, from fine to coarse, by the extension MSFT_lod; 1 is the mesh as "
          "it came.")
      ->delimiter(',')
      ->check(in_range(0, 1))
      ->type_name("R,R")
      ->group(how_far);

  command
      .add_option(
          "--progressive", request.progressive,
          "Write the mesh with all steps of the reduction, as one glTF file: `selvedge level` and engines "
          "make any level from it, from all faces down to the target.")
      ->type_name("FILE")
      ->group(how_far);

  command
      .add_option("--placement", request.placement,
                  "Where a collapse puts the merged vertex: at one of the two vertices, or where the surface "
                  "changes least. The latter comes nearer, takes more time, and interpolates the attributes of "
                  "vertices at new places; auto takes it in meshes of up to 500,000 faces, unless something "
                  "needs the vertices of the input (--pose, --progressive, levels in one glTF file, cells).")
      ->transform(one_of<Placement_choice>({{"auto", Placement_choice::automatic},
                                            {"vertices", Placement_choice::vertices},
                                            {"optimal", Placement_choice::optimal}}))
      ->type_name("auto|vertices|optimal")
      ->default_str("auto")
      ->group(how_far);
}

void add_options_of_parts(CLI::App& command, Simplify_request& request)
{
  const char* const parts = "Parts (PART names a group, an object, a material, or a property of 0 and 1 of "
                            "the faces of a PLY file; 'button*' names all that begin so)";
  command
      .add_option("--lock", request.intent.locked,
                  "Parts whose vertices must not move. Their faces count for --faces, but not for --ratio.")
      ->type_name("PART")
      ->group(parts);
  command
      .add_option("--keep", request.intent.kept,
                  "Parts whose faces must not change. The target is for the other faces.")
      ->type_name("PART")
      ->group(parts);
  add_dropped_parts_options(
      command, request.dropped_parts,
      "Part that is left out before the reduction, such as stitches that a texture shows. Targets are of the other faces.",
      "Leaves out likewise what is smaller than this, in the unit of the file, such as stitches and buttons: faces that "
      "common positions connect to nothing larger, by the diagonal of their bounding box.",
      parts);
  add_part_pairs_option(
      command, request.may_intersect,
      "Two parts that are not joined, and that may come to pierce each other, as skin under an opaque layer "
      "may: they are not kept apart, from each other alone. May be given several times.")
      ->group(parts);
  command
      .add_option("--weights", request.intent.weights,
                  "Vertex attribute that makes vertices costly to remove, relative to its largest value.")
      ->type_name("NAME")
      ->group(parts);
  command
      .add_option("--obstacle", request.obstacle,
                  "Mesh that no face may touch or pass through, such as a body. It is not changed, counted "
                  "or written.")
      ->type_name("FILE")
      ->group(parts);

  command
      .add_option(
          "--instances", request.instances,
          "Meshes that stand in several places of a glTF scene: reduce each once, with collapses that "
          "all places allow, so that the output shares them as the input does; or in each place by "
          "itself. Outputs of other formats have no places: then it is apart.")
      ->transform(one_of<Instances>({{"shared", Instances::shared}, {"apart", Instances::apart}}))
      ->type_name("shared|apart")
      ->default_str("shared")
      ->group(parts);
}

void add_options_of_poses(CLI::App& command, Simplify_request& request)
{
  const char* const poses =
      "Poses (the same vertices and faces at other places, such as frames of an animation)";
  add_pose_options(
      command, request.poses, "IN",
      "Further poses of IN: a mesh file, a pattern in quotes for several, in natural order, or a "
      "point cache (.mdd, .pc2). "
      "Everything that holds in IN holds in each of them: no layers touch or pass through each "
      "other, limits are kept, and the cost is the mean of all. May be given several times.",
      poses);
  add_obstacle_pose_options(command, request.obstacle_poses, "IN", poses);
  command
      .add_option(
          "--key-poses", request.are_key_poses_chosen,
          "Poses in which every collapse is judged: all, or a few that differ most, and those in which "
          "the result has pairs that it should not have: then it is reduced again, until there is none. "
          "Faster for many poses. All are judged at the end, but what happens on the way, and limits, "
          "hold in the few alone.")
      ->transform(one_of<bool>({{"all", false}, {"auto", true}}))
      ->type_name("all|auto")
      ->default_str("all")
      ->group(poses);
  command
      .add_option(
          "--poses-out", request.poses_output,
          "Files for the poses of the result: {pose} stands for the name of each, the name of its "
          "file without ending, of its morph target, or of its animation with the number of the "
          "keyframe. Without {pose}: one point cache, or one .glb or .gltf file that shows one pose after "
          "another by morph targets.")
      ->type_name("PATTERN")
      ->group(poses);
}

void add_options_of_limits(CLI::App& command, Simplify_request& request)
{
  Simplify_options& options = request.options;
  const char* const limits = "Limits of a collapse";
  command
      .add_option("--normal-change", options.max_normal_change,
                  "Largest turn of the normal of a face that is not low, in degrees.")
      ->check(in_range(0, 180))
      ->type_name("DEG")
      ->capture_default_str()
      ->group(limits);
  command
      .add_option("--aspect-ratio", options.min_aspect_ratio,
                  "Smallest aspect ratio of a face that becomes thinner, from 0 (a line) to 1 (equilateral). "
                  "0.2 keeps "
                  "faces round enough for a simulation. Faces between two borders or seams, such as those "
                  "along the edge of thick cloth, may be thinner.")
      ->check(in_range(0, 1))
      ->type_name("A")
      ->capture_default_str()
      ->group(limits);
  command
      .add_option("--border-turn", request.border_turn,
                  "Largest turn of a border at a vertex that is removed, in degrees, where the corner is not low.")
      ->check(in_range(0, 180))
      ->type_name("DEG")
      ->default_str(with_digits(options.max_border_turn))
      ->group(limits);
  command
      .add_option("--corner-height", request.corner_height,
                  "Height up to which a corner of a border or of a face is low, as a share of the diagonal. "
                  "There both may turn by any angle, so that small rings, bevels and parts lose faces, too. "
                  "0 makes none low.")
      ->check(in_range(0))
      ->type_name("D")
      ->default_str(with_digits(options.max_corner_height))
      ->group(limits);
  command
      .add_option("--seam-turn", options.max_seam_turn,
                  "Largest turn of a seam, which has surface on both sides, at a vertex that is removed, in degrees.")
      ->check(in_range(0, 180))
      ->type_name("DEG")
      ->capture_default_str()
      ->group(limits);
  command
      .add_option("--border-drift", options.max_border_drift,
                  "Largest distance of a border or seam from where it was, as a share of the diagonal.")
      ->check(in_range(0))
      ->type_name("D")
      ->capture_default_str()
      ->group(limits);
  command
      .add_option(
          "--clearance", options.clearance,
          "Distance to keep between pieces, in the unit of the file, in every pose that is guarded: no "
          "two come nearer to each other than this, or, where they are nearer already, than they are. "
          "Pieces are what is connected after sewing, and the obstacle.")
      ->check(positive())
      ->type_name("D")
      ->group(limits);
  command
      .add_flag("--no-intersection-check", request.is_unguarded,
                "Let layers pierce each other, to see what the check does. The exit code is 1, because the "
                "result is "
                "not verified.")
      ->group(limits);
}

void add_options_of_seams(CLI::App& command, Simplify_request& request)
{
  const char* const seams = "Seams";
  command
      .add_option("--weld", request.weld,
                  "What becomes of seams that gape. A length, in the unit of the file, closes them: a border "
                  "vertex snaps onto its partner on another border within this length; auto takes the "
                  "length at which most gaps clearly end, if there is one, which the summary says. hold "
                  "closes no gap, but lets none of those get wider: the two sides lose their vertices in "
                  "pairs. none reduces the two sides as separate borders.")
      ->type_name("EPS|auto|hold|none")
      ->default_str("hold")
      ->group(seams);
  command
      .add_flag(
          "--sewn", request.is_sewn,
          "Merge the vertices of pieces that meet, where their attributes allow it. Without this option, "
          "pieces that are separate in the input are separate in the output.")
      ->group(seams);

  command
      .add_option(
          "--orient", request.are_faces_oriented,
          "Faces that run against the others of their surface: turn them for the reduction, and what "
          "is left of them back in the output, so that their surface is reduced as one; or keep them, "
          "so that nothing moves where two faces disagree.")
      ->transform(one_of<bool>({{"auto", true}, {"keep", false}}))
      ->type_name("auto|keep")
      ->default_str("auto")
      ->group(seams);
  command
      .add_option(
          "--normals", request.normals,
          "Normals of the input: keep them as they are, so that an edge with different normals on its "
          "two sides is a seam; mend them: those that give every face its own normal, or that would come to "
          "belong to another side of the surface, are made anew, and those that differ by at most 0.1 "
          "degrees at a vertex become one; loose is auto without seams where normals differ: each face first "
          "gets those normals of its vertices that suit it best; recompute makes all anew, with the hard "
          "edges of the input; smooth makes smooth ones first, hard where faces turn by more than 60 degrees, "
          "for scans that are shaded flat or have none; or leave them out, so that vertices of PLY and glTF "
          "that differ in nothing else are one. auto mends them, and then fits them to the shading of the "
          "input, which is truer on large faces than what is kept at their corners; it is loose where nine "
          "tenths of the seams that normals make are too soft to be seen, and elsewhere at those that are.")
      ->transform(one_of<Normals_choice>({{"auto", Normals_choice::automatic},
                                          {"keep", Normals_choice::keep},
                                          {"mend", Normals_choice::mend},
                                          {"loose", Normals_choice::loose},
                                          {"recompute", Normals_choice::recompute},
                                          {"smooth", Normals_choice::smooth},
                                          {"drop", Normals_choice::drop}}))
      ->type_name("auto|keep|mend|loose|recompute|smooth|drop")
      ->default_str("auto")
      ->group(seams);
  add_attributes_option(command, request.dropped_attributes,
                        "Leaves out an attribute of IN, and the seams that it makes: texture (with the "
                        "textures of glTF materials, and their images), colors, or a vertex attribute by the name that info "
                        "gives it. For textures that are baked anew, and those of which every face has its "
                        "own piece.")
      ->group(seams);
}

void add_options_of_tuning(CLI::App& command, Simplify_request& request)
{
  Simplify_options& options = request.options;
  const char* const tuning = "Tuning";
  command
      .add_option("--index", options.index,
                  "Index that finds the faces nearby: a packed R-tree, or clusters of faces with a CGAL AABB "
                  "tree each. "
                  "The result is the same.")
      ->transform(one_of<Face_index>({{"packed", Face_index::packed}, {"clusters", Face_index::clusters}}))
      ->type_name("packed|clusters")
      ->default_str("packed")
      ->group(tuning);
  command
      .add_option("--cluster-size", request.faces_per_cluster, "Faces per cluster, for --index clusters.")
      ->check(in_range(1))
      ->type_name("N")
      ->default_str(std::to_string(options.faces_per_cluster))
      ->group(tuning);
  command
      .add_option("--loop", options.loop,
                  "Loop that collapses edges: Selvedge's own, or CGAL's for comparison.")
      ->transform(one_of<Collapse_loop>({{"own", Collapse_loop::own}, {"cgal", Collapse_loop::cgal}}))
      ->type_name("own|cgal")
      ->default_str("own")
      ->group(tuning);
  const auto add_weight = [&](const char* name, double& weight, const char* description) {
    command.add_option(name, weight, description)
        ->check(in_range(0))
        ->type_name("W")
        ->capture_default_str()
        ->group(tuning);
  };
  add_weight("--stabiliser", options.cost.stabiliser,
             "Weight of the distance to the original vertices in the cost; it decides where the surface is "
             "flat.");
  command
      .add_option("--memory", options.cost.memory,
                  "Share of the cost that is the distance to all planes since the original, from 0 to 1; the "
                  "rest is that to the faces as they are. 1 is faster, with an error up to 40 % larger.")
      ->check(in_range(0, 1))
      ->type_name("SHARE")
      ->capture_default_str()
      ->group(tuning);
  add_weight("--uv-weight", options.uv_weight,
             "Weight of the displacement of the texture in the cost, relative to that of the surface; 0 "
             "ignores it.");
  add_weight(
      "--normal-weight", options.normal_weight,
      "Weight of the turn of normals in the cost, likewise: of those that are kept or, in a mesh of up to 500,000 faces that keeps "
      "none, smooth ones, as viewers shade it. More keeps the shading truer, and the shape less so.");
  add_weight("--border-weight", options.cost.border_weight,
             "Weight of borders, and of edges over which the surface folds, in the cost.");
}

void add_options_of_conduct(CLI::App& command, Simplify_request& request)
{
  const char* const conduct = "Conduct";
  command
      .add_option(
          "--defects", request.defects,
          "What becomes of pairs of faces that intersect in the input: reduce their faces like others, "
          "so that only what descends from these pairs may intersect, and never more of it than in the "
          "input; leave their faces as they are; or refuse the input.")
      ->transform(one_of<Defects>(
          {{"descend", Defects::descend}, {"freeze", Defects::freeze}, {"refuse", Defects::refuse}}))
      ->type_name("descend|freeze|refuse")
      ->default_str(name_of(Prepare_options().defects))
      ->group(conduct);
  command
      .add_flag("--strict", request.is_strict,
                "Refuse an input with intersecting, duplicate or degenerate faces: --defects refuse.")
      ->group(conduct);
  command
      .add_flag("--require-target", request.is_target_required,
                "End with exit code 1 when the target is missed.")
      ->group(conduct);
  add_threads_option(command, request.threads)->group(conduct);
  command
      .add_flag("--cells", request.is_in_cells,
                "For large meshes: first reduce boxes of space at once, on all threads, then the whole. This "
                "changes the result, but the number of threads does not.")
      ->group(conduct);
  command.add_option("--report", request.report, "Write a JSON report of the run.")
      ->type_name("FILE")
      ->group(conduct);
  command.add_option("--log", request.log, "Write a log of every collapse, for `selvedge replay`.")
      ->type_name("FILE")
      ->group(conduct);
  add_html_option(command, request.html)->group(conduct);
  command.add_flag("--quiet", request.is_quiet, "Print no summary and no progress bar.")->group(conduct);
  add_ascii_option(command, request.is_ascii)->group(conduct);
  add_polygons_option(command, request.are_polygons_split)->group(conduct);
}

} // namespace

void add_options(CLI::App& command, Simplify_request& request)
{
  command.add_option("IN", request.input, std::string("Mesh to reduce: ") + mesh_endings + ".")
      ->required()
      ->type_name("");
  command
      .add_option("-o,--output", request.output,
                  "File to write; its ending chooses the format. It may be IN.")
      ->required()
      ->type_name("FILE");
  add_format_option(command, request.format);

  add_options_of_targets(command, request);
  add_options_of_parts(command, request);
  add_options_of_poses(command, request);
  add_options_of_limits(command, request);
  add_options_of_seams(command, request);
  add_options_of_tuning(command, request);
  add_options_of_conduct(command, request);

  command.footer(
      "Examples:\n"
      "  selvedge simplify jacket.obj -o small.obj --ratio 0.3\n"
      "  selvedge simplify jacket.obj -o small.ply --faces 20000 --report small.json\n"
      "  selvedge simplify jacket.obj -o jacket.obj --error 0.0005    # at most 0.05 % of the size away\n"
      "  selvedge simplify jacket.obj -o 'jacket_{lod}.obj' --lods 0.5,0.25,0.1\n"
      "  selvedge simplify jacket.glb -o levels.glb --lods 1,0.5,0.1      # all in one file\n"
      "  selvedge simplify hero.glb -o small.glb --ratio 0.1 --ratio Head=0.2    # the face keeps more\n"
      "  selvedge simplify jacket.obj -o small.obj --ratio 0.2 --ratio collar=0.8 --keep logo --obstacle "
      "body.obj\n"
      "  selvedge simplify jacket.obj -o small.obj --ratio 0.1 --require-target || echo missed\n"
      "  selvedge simplify draped.obj -o small.obj --ratio 0.3 --weld auto      # close narrow gaps\n"
      "  selvedge simplify rest.obj -o small.obj --ratio 0.2 --pose 'frame_*.obj' --poses-out "
      "'small_{pose}.obj'\n\n"
      "The result is always judged before it is written. A target that cannot be reached is no error: the\n"
      "result is written, and summary and report say what prevented more. Ctrl-C during the reduction stops "
      "it,\n"
      "and what was reached is judged and written; at any other time nothing is written.");
}

} // namespace selvedge::app
