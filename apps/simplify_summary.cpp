// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "simplify_summary.h"

#include "advice.h"
#include "coarse_part.h"
#include "doubtful_units.h"
#include "fate_of_limit.h"
#include "output_files.h"
#include "price_of_target.h"
#include "standard_streams.h"
#include "text.h"

#include <selvedge/Parts.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/normals.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace selvedge::app {
namespace {

// From here on a user should know where the result is off.
constexpr double far_off = 0.01;

/// What the arithmetic of distances leaves where there is none, as a share of the size.
constexpr double rounding = 0x1p-44;

bool has_vertex_values(const Triangle_soup& soup)
{
  return !soup.uvs.empty() || !soup.normals.empty() || !soup.vertex_attributes.empty() ||
         soup.scene != nullptr;
}

/// Says how many of the offending pairs the input does not explain.
std::string origin_of_pairs(const Verification& verification, Defects defects)
{
  const std::size_t unexplained = verification.new_pairs.size();
  if (defects != Defects::descend)
    return with_commas(unexplained) + " of them new";
  const std::string of_input = with_commas(verification.pairs_of_original) + " of the input";
  return unexplained == 0 ? "all descended from the " + of_input
                          : with_commas(unexplained) + " of them NOT descended from the " + of_input;
}

/// Says in a clause where a vertex of the original is.
std::string place_of(Index vertex, const Triangle_soup& original)
{
  std::ostringstream text;
  for (const Part_kind& kind : part_kinds(original))
    for (Index t = 0; t < original.triangles.size() && kind.name != Part_kind::Name::piece; ++t) {
      const Index_triple& triangle = original.triangles[t];
      const std::string& part = kind.names[kind.of_triangle[t]];
      if (part.empty() || std::find(triangle.begin(), triangle.end(), vertex) == triangle.end())
        continue;
      text << "at " << name(kind.name) << " '" << part << "', ";
      break;
    }
  const Point_3& point = original.points[vertex];
  text << "near (" << with_digits(point.x()) << ", " << with_digits(point.y()) << ", "
       << with_digits(point.z()) << ')';
  return text.str();
}

void print_snapping(std::ostream& stream, const Snapping_notes& notes, std::size_t tied)
{
  stream << "  seams closed: " << with_commas(notes.snapped) << " of " << with_commas(notes.partnered)
         << " border vertices that have a partner, along " << counted(notes.seam_edges, "edge")
         << "; the widest gap was " << with_digits(notes.largest_distance) << '\n';
  const auto print = [&](std::size_t count, const char* why) {
    if (count > 0)
      stream << "  not closed: " << with_commas(count) << " border " << (count == 1 ? "vertex" : "vertices")
             << ", because " << why << '\n';
  };
  print(notes.left_blocked, "another part of the mesh lies in the gap");
  print(notes.left_folding, "a face would degenerate or fold over");
  print(notes.left_unmanifold, "more than two faces would meet at an edge");
  print(notes.left_frozen, "a face there is frozen, or belongs to an offending pair");
  print(notes.left_foreign, "the partner belongs to a node with another transform");
  print(notes.left_ambiguous, "every partner has a nearer one");
  if (tied > 0)
    stream << "  tied: " << counted(tied, "pair")
           << " of border vertices that stay apart leave their borders together\n";
  print(notes.near_without_edge, "no edge beside them can be sewn to the border that is near");
}

void print_border_gaps(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                       double diagonal)
{
  const Border_gaps& gaps = prepared.border_gaps;
  const std::string found = gaps.clear_length ? partners_in_clear_gaps(gaps, diagonal) : "";
  if (request.open_seams == Open_seams::weld)
    stream << "  --weld auto: "
           << (gaps.clear_length
                   ? found + ", which is the length chosen\n"
                   : "nothing is closed, because no gaps in seams are clearly narrower than what "
                     "lies beside them; --weld EPS closes gaps up to a length\n");
  else if (gaps.clear_length) {
    // Otherwise, --weld is refused.
    const bool may_weld =
        prepared.soup.poses.empty() && !request.options.clearance && request.may_intersect.empty();
    stream << "  open seams: " << found
           << (request.open_seams != Open_seams::hold ? ""
               : !prepared.facing.empty()             ? "; they get hardly wider"
               : !prepared.tied.empty()               ? "; they get no wider"
                                                      : "; not held, as no piece there has a vertex inside")
           << (may_weld ? "; --weld auto closes them\n" : "\n");
  }
  if (gaps.clear_length_to_edges)
    stream << "  open seams: " << edges_in_clear_gaps(gaps, diagonal)
           << (request.open_seams == Open_seams::hold       ? "; they get hardly wider\n"
               : request.options.loop == Collapse_loop::own ? "; --weld hold keeps them from getting wider\n"
                                                            : "\n");
}

// Says in which further pose pieces are nearest to each other.
std::string describe_poses_with_clearance(const Verification& verification)
{
  const auto nearest = std::min_element(
      verification.poses.begin(), verification.poses.end(), [](const auto& a, const auto& b) {
        return std::make_pair(a.clearance->too_near() == 0, a.clearance->least.lower) <
               std::make_pair(b.clearance->too_near() == 0, b.clearance->least.lower);
      });
  return "nearest in '" + nearest->name + "', " + describe(*nearest->clearance);
}

// Says what the judge found in the further poses.
void print_poses(std::ostream& stream, const Level& level, Defects defects)
{
  const Verification& verification = level.verification;
  std::size_t pairs = 0, unexplained = 0, of_original = 0, affected = 0;
  for (const Verification::In_pose& pose : verification.poses) {
    pairs += pose.pairs.size();
    unexplained += pose.new_pairs.size();
    of_original += pose.pairs_of_original;
    affected += !pose.pairs.empty();
  }
  if (verification.clearance)
    stream << "\nclearance in poses: " << describe_poses_with_clearance(verification);
  stream << "\nposes: " << counted(verification.poses.size(), "further pose") << " judged, ";
  if (level.guarded_poses.size() < verification.poses.size())
    stream << with_commas(level.guarded_poses.size()) << " of them at every collapse, ";
  if (pairs == 0)
    stream << "embedded in each";
  else
    stream << counted(pairs, "offending pair") << " in " << with_commas(affected) << " of them, "
           << (unexplained > 0 ? with_commas(unexplained) + " of them NEW"
               : defects == Defects::descend
                   ? "all descended from the " + with_commas(of_original) + " of the input"
                   : "none new");
}

// Names the first pose that seems to be in another unit.
void print_doubtful_pose(std::ostream& stream, const Triangle_soup& soup)
{
  if (soup.poses.empty())
    return;
  const CGAL::Bbox_3 box = box_of(soup.points, soup.triangles);
  for (const Pose& pose : soup.poses)
    if (const std::string doubt = doubt_of_unit(box, box_of(pose.points, soup.triangles)); !doubt.empty()) {
      stream << "  pose '" << pose.name << "' is " << doubt << '\n';
      return;
    }
}

void print_distances(std::ostream& stream, const Level& level, const Distances_anywhere& distances,
                     double limit)
{
  const auto& [there, back] = distances;
  const bool has_poses = !level.verification.poses.empty();
  stream << "distance of any point" << (has_poses ? " in any pose" : "") << ": at most "
         << percent(there.upper) << " from the original to the result, " << percent(back.upper) << " back";
  if (has_poses)
    stream << "; the most in " << describe_pose(level.verification, distances.larger().pose);
  stream << '\n';
  if (const std::string fate =
          fate_of_limit(limit, distances.larger(), level.error_search, level.guarded_poses);
      !fate.empty())
    stream << fate << '\n';
}

/// Returns whether vertices at new places are allowed, and would have come nearer to the original: they do
/// where few faces are left, on all meshes that were measured.
bool would_new_places_help(const Simplify_request& request, const Prepared_soup& prepared, const Level& level)
{
  constexpr double few = 0.2;   // of the faces
  constexpr double near = 1e-4; // root mean square distance, as a share of the diagonal
  const bool are_allowed = request.poses.empty() && request.progressive.empty() && request.lods.empty() &&
                           level.result.shared_meshes == 0;
  return are_allowed && placement_for(request, prepared.soup) == Placement::vertices &&
         double(level.result.soup.triangles.size()) <= few * double(prepared.soup.triangles.size()) &&
         level.verification.distances->original_to_result.root_mean_square > near;
}

void print_normals(std::ostream& stream, Normals_choice choice, Normals_treatment treatment,
                   const Simplified_soup& result)
{
  const std::size_t others = std::max(result.fitted_normals, result.mended_normals);
  if (treatment == Normals_treatment::smoothed)
    stream << "\nnormals: fitted to the smooth shading of the input";
  else if (are_fitted(treatment) && others > 0)
    stream << "\nnormals: fitted to the shading of the input, other ones at " << counted(others, "corner")
           << " of " << with_commas(3 * result.soup.triangles.size());
  else if (others > 0)
    stream << "\nnormals: kept, but for " << counted(others, "corner")
           << " with a new one, as the old one is too far from the normal of the face";
  if (choice == Normals_choice::automatic && treatment == Normals_treatment::picked)
    stream << "\nhard edges: hardly any, so that none holds vertices (--normals mend keeps them all)";
  else if (treatment == Normals_treatment::softened)
    stream << "\nhard edges: those that are too soft to be seen hold no vertices (--normals mend keeps them "
              "all)";
}

// Says what a target has more than `--faces`: that is of faces in no part that stays or has a ratio of its
// own.
std::string what_is_beside_faces(const Simplify_request& request, const Simplify_report& done)
{
  const std::optional<std::size_t>& faces = request.options.faces;
  return faces && done.faces_target > *faces
             ? " (--faces " + std::to_string(*faces) + ", and " + with_commas(done.faces_target - *faces) +
                   " of other parts)"
             : "";
}

// Says how far the mesh was reduced.
void print_reach(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                 const Level& level)
{
  const Simplify_report& done = level.result.report;
  const std::size_t faces = level.result.soup.triangles.size();
  stream << "reduced to " << counted(faces, "face") << " ("
         << with_digits(100.0 * double(faces) / double(prepared.soup.triangles.size())) << " %) in "
         << with_digits(level.seconds) << " s: ";
  if (request.options.ratio || request.options.faces || !request.lods.empty() ||
      !request.intent.ratios.empty())
    stream << "target " << with_commas(done.faces_target) << what_is_beside_faces(request, done)
           << (done.is_reached() ? " reached"
               : done.is_stopped ? " not reached: interrupted"
                                 : " not reached");
  else
    stream << (done.is_stopped ? "interrupted" : "as far as the limits allow");
}

// Says what was done to the mesh besides.
void print_reduction(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                     const Level& level)
{
  const Simplified_soup& result = level.result;
  const Simplify_report& done = result.report;
  const Mesh_format format = output_format(request);
  const bool has_normals = format != Mesh_format::off && format != Mesh_format::stl;
  const bool has_polygons = format != Mesh_format::stl && !is_gltf(format);
  if (done.faces_fixed > 0)
    stream << "\nfixed: " << counted(done.faces_fixed, "face")
           << " with all corners frozen, locked or coincident; a ratio is of the other "
           << with_commas(done.faces_input - done.faces_fixed);
  if (result.shared_meshes > 0)
    stream << "\ninstances: " << counted(result.shared_meshes, "mesh", "meshes") << " in "
           << with_commas(result.shared_places) << " places reduced once, alike in all"
           << (placement_for(request, prepared.soup) == Placement::optimal ? ", at vertices of the input"
                                                                           : "");
  if (request.is_sewn && prepared.soup.scene)
    stream << "\nseams: not merged, because --sewn leaves the vertices of a glTF input as they are";
  if (result.apart_meshes > 0)
    stream
        << "\ninstances: " << counted(result.apart_meshes, "mesh", "meshes")
        << (prepared.soup.poses.empty()
                ? " not the same in all places (snapped, rounded, degenerate or doubled in some), so each "
                  "place was reduced by itself"
                : " in several places, each of which was reduced by itself, because it may move by itself in "
                  "poses");
  if (result.untied_pairs > 0)
    stream << "\nopen seams: " << counted(result.untied_pairs, "pair")
           << " of border vertices not held, because their meshes were reduced once for several places; "
              "--instances apart holds them";
  if (const std::size_t turned = prepared.turned_faces(); turned > 0)
    stream << "\norientation: " << counted(turned, "face")
           << " turned to agree with the others of their surface, and turned back in the output";
  if (const Sewing_notes& sewing = result.sewing; sewing.misoriented_edges > 0)
    stream << "\norientation: faces disagree along " << counted(sewing.misoriented_edges, "edge") << " of "
           << counted(sewing.misoriented_pieces, "piece") << ", whose vertices there do not move; "
           << (request.are_faces_oriented ? "`selvedge info` names them"
                                          : "--orient auto turns those that can be turned");
  if (done.left_alone > 0)
    stream << "\nopen seams: " << counted(done.left_alone, "border vertex", "border vertices")
           << " stayed while the partner across the gap left; there the gap may be wider than it was";
  if (result.placed_vertices > 0)
    stream << "\nvertices: " << with_commas(result.soup.points.size() - result.placed_vertices)
           << " kept bit for bit, " << with_commas(result.placed_vertices) << " at new places"
           << (has_vertex_values(prepared.soup) ? " with interpolated attributes" : "")
           << (result.fitted_texture > 0 ? ", the texture fitted to that of the input" : "")
           << (result.fitted_attributes > 0 ? ", colours and the like fitted to those of the input" : "");
  if (has_normals)
    print_normals(stream, request.normals, prepared.normals, result);
  if (level.polygons.input > 0 && has_polygons)
    stream << "\npolygons: " << with_commas(level.polygons.output) << " of "
           << counted(level.polygons.input, "face") << " of more than three corners written as they were";
}

// Says what the judge found.
void print_verdict(std::ostream& stream, const Prepared_soup& prepared, const Level& level)
{
  const Verification& verification = level.verification;
  stream << "\njudged: ";
  std::size_t permitted = 0;
  for (const Verification::Permitted& parts : verification.permitted)
    permitted += parts.pairs;
  if (verification.pairs.empty())
    stream << (permitted == 0 ? "embedded (no triangles touch or cross)"
                              : "embedded, but for parts that may intersect");
  else
    stream << counted(verification.pairs.size(), "offending pair")
           << " (triangles that touch or cross, or are degenerate), "
           << origin_of_pairs(verification, prepared.defects);
  stream << ", topology " << (verification.same_topology() ? "kept" : "CHANGED");
  if (verification.clearance)
    stream << "\nclearance: " << describe(*verification.clearance);
  if (!verification.poses.empty())
    print_poses(stream, level, prepared.defects);
  for (const Verification::Permitted& parts : verification.permitted)
    stream << "\nmay intersect: " << counted(parts.pairs_of_original, "pair") << " between '" << parts.first
           << "' and '" << parts.second << "' before, " << with_commas(parts.pairs) << " now";
}

// Says how far the result is from the original.
void print_deviation(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                     const Level& level)
{
  const Verification& verification = level.verification;
  const Distance& distance = verification.distances->original_to_result;
  stream << "\ndistance from the original's vertices"
         << (verification.poses.empty() ? "" : " in the mesh's own pose") << ": ";
  if (distance.maximum > 0 && distance.maximum <= rounding)
    stream << "no more than rounding";
  else
    stream << percent(distance.root_mean_square) << " of the diagonal (RMS), at most "
           << percent(distance.maximum);
  stream << (would_new_places_help(request, prepared, level) ? "; --placement optimal comes nearer" : "")
         << '\n';
  if (level.distances_anywhere)
    print_distances(stream, level, *level.distances_anywhere, *request.options.max_error);
  if (distance.maximum > far_off)
    stream << "worst deviation " << percent(distance.maximum) << " of the size, "
           << place_of(distance.farthest, prepared.soup) << '\n';
}

/// Counts what a file got otherwise, which begins with a noun in the plural.
std::string counted_note(std::size_t count, const std::string& what)
{
  const std::string plural = what.substr(0, what.find(' '));
  const std::string singular = plural == "meshes"     ? "mesh"
                               : plural == "vertices" ? "vertex"
                                                      : plural.substr(0, plural.size() - 1);
  return counted(count, singular, plural) + what.substr(plural.size());
}

} // namespace

std::string name_of(const Level& level)
{
  return level.output + (level.number == 0 ? "" : " (level " + std::to_string(level.number) + ")");
}

void print_input(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                 double diagonal, const Json& notes, const std::vector<std::string>& dropped,
                 const std::vector<std::string>& references)
{
  stream << input_name(request.input) << ": " << counted(prepared.soup.triangles.size(), "face");
  if (!prepared.offending_pairs.empty())
    stream << ", " << counted(prepared.offending_pairs.size(), "offending pair");
  if (const std::size_t doubles = prepared.doubles(); doubles > 0)
    stream << ", " << counted(doubles, "face") << " with the same corners as an earlier one";
  if (prepared.frozen_faces > 0)
    stream << ", " << counted(prepared.frozen_faces, "face") << " frozen";
  if (const std::size_t left_out = prepared.left_out_faces + prepared.left_out_by_rounding; left_out > 0)
    stream << ", " << counted(left_out, "degenerate face") << " left out";
  stream << '\n';
  if (const std::size_t faces = prepared.obstacle.triangles.size(); faces > 0) {
    stream << "  obstacle: " << counted(faces, "face");
    const std::string doubt = doubt_of_obstacle(prepared.soup, prepared.obstacle);
    stream << (doubt.empty() ? "" : ", ") << doubt << '\n';
  }
  print_doubtful_pose(stream, prepared.soup);
  if (const std::size_t open = prepared.left_out_faces_that_open; open > 0)
    stream << "  " << with_commas(open)
           << " of the degenerate faces open when morph targets or bones move, like "
           << "a closed lid, and leave holes then; part their corners in the modeller to keep them\n";
  for (const Json& note : notes)
    stream << "  " << note.get<std::string>() << '\n';
  // Otherwise, further poses are refused.
  const bool may_guard = !request.is_in_cells && !request.is_sewn && !are_gaps_welded(request) &&
                         request.placement != Placement_choice::optimal;
  std::string unguarded;
  if (!request.poses.are_morphs && has_morph_targets(prepared.soup))
    unguarded =
        std::string("the shapes of morph targets") + (may_guard ? " (--morphs guards these, too)" : "");
  if (request.poses.animation.empty() && !request.poses.are_of_humanoid && has_humanoid(prepared.soup))
    unguarded += (unguarded.empty() ? "" : " and ") + std::string("poses such as arms down") +
                 (may_guard ? " (--humanoid-poses guards some)" : "");
  if (!unguarded.empty())
    stream << "  nothing is promised in " << unguarded << '\n';
  if (prepared.rounding.coordinates > 0)
    stream << "  " << counted(prepared.rounding.coordinates, "coordinate")
           << " rounded to 32-bit floats, because "
           << (needs_float32(prepared.soup, output_format(request)) ? "the output's format"
               : request.progressive.empty()                        ? "the file of --poses-out"
                                                                    : "the file of --progressive")
           << " stores nothing more precise\n";
  if (prepared.normals == Normals_treatment::flat)
    stream << "  normals made anew where faces change: every face of the input has its own, as in flat "
              "shading; --normals smooth shades the result smooth\n";
  const bool is_shown_flat = is_gltf(output_format(request));
  if (prepared.normals == Normals_treatment::dropped && is_shown_flat)
    stream << "  normals dropped: programs that show glTF then shade every face flat\n";
  if (prepared.normals == Normals_treatment::none && is_shown_flat && request.progressive.empty())
    stream
        << "  no normals: programs that show glTF then shade every face flat; --normals smooth makes smooth "
           "ones\n";
  if (prepared.normals == Normals_treatment::smoothed)
    stream << "  normals made anew, smooth up to edges where faces of the input turn by more than 60°\n";
  if (prepared.normals == Normals_treatment::smooth)
    stream << "  normals made anew, with the hard edges of the input\n";
  if (const auto held = std::count(prepared.is_held.begin(), prepared.is_held.end(), char(true)); held > 0)
    stream << "  coincident in some poses and not in others, so that their faces are frozen: "
           << counted(std::size_t(held), "vertex", "vertices") << ", the first is " << prepared.first_held
           << '\n';
  print_border_gaps(stream, request, prepared, diagonal);
  if (prepared.snapping.distance > 0)
    print_snapping(stream, prepared.snapping, prepared.tied.size());
  if (!dropped.empty())
    stream << "  not in the output, because its format cannot hold them: " << listed(dropped, dropped.size())
           << '\n';
  if (!references.empty())
    stream << "  files beside the input are named from the output's folder: " << listed(references) << '\n';
}

void print_summary(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                   const Level& level, const Outcome& outcome, const Level* before)
{
  const Simplified_soup& result = level.result;
  const Simplify_report& done = result.report;
  print_reach(stream, request, prepared, level);
  if (before && before->result.soup.points == result.soup.points &&
      before->result.soup.triangles == result.soup.triangles) {
    stream << "; the same mesh as the level before\n"
           << (outcome.is_written() ? "written: " : "NOT written: ") << name_of(level) << std::endl;
    return;
  }
  if (!done.is_reached() && !done.is_stopped)
    stream << "\nheld back: " << held_back(request, prepared, result)
           << what_shape_takes(request, done, level.verification.distances->original_to_result)
           << what_is_left_for_pieces(prepared, done);
  if (done.is_reached() && request.progressive.empty())
    stream << what_texture_takes(request, result.soup);
  print_reduction(stream, request, prepared, level);
  print_verdict(stream, prepared, level);
  print_deviation(stream, request, prepared, level);
  if (const std::string sentence = coarse_part(request, prepared, result); !sentence.empty())
    stream << "parts: " << sentence << '\n';
  stream << (outcome.is_written() ? "written: " : "NOT written: ") << name_of(level) << std::endl;
  if (const std::string sentence = enlargement(request, level); !sentence.empty())
    stream << sentence << std::endl;
}

std::string enlargement(const Simplify_request& request, const Level& level)
{
  if (level.bytes_more == 0)
    return "";
  std::string why;
  if (level.polygons.output < level.polygons.input)
    why = counted(level.polygons.input - level.polygons.output, "face") +
          " of more than three corners cut into triangles";
  for (const auto& [what, count] : level.notes)
    why += (why.empty() ? "" : "; ") + counted_note(count, what);
  if (why.empty() && request.is_ascii)
    why = "--ascii writes numbers as text";
  if (why.empty() && output_format(request) == Mesh_format::gltf)
    why = "a .gltf file has its buffers in it as text, which takes a third more than a .glb file";
  return "larger than the input by " + counted(level.bytes_more, "byte") + ": " +
         (why.empty() ? "its numbers, or what stands beside them, take more space than in the input" : why);
}

std::string complaint(const Simplify_request& request, const Level& level, const Outcome& outcome)
{
  const Simplified_soup& result = level.result;
  const Verification& verification = level.verification;
  const std::string where = request.lods.empty() ? "" : name_of(level) + ": ";
  if (!outcome.is_written()) {
    if (verification.accepted() && verification.same_topology())
      return "";
    return where + "THE RESULT IS WRONG and was not written: " +
           counted(verification.new_pairs.size(), "new offending pair") +
           (verification.same_topology() ? "" : ", topology changed") +
           (verification.is_clearance_kept() ? "" : ", pieces nearer to each other than --clearance allows") +
           (verification.matching.is_complete() ? "" : ", " + verification.matching.mismatches[0].message) +
           "; this is a bug in selvedge: please report it with the input and the options";
  }
  if (!outcome.is_guarded)
    return where + "written but not verified, because of --no-intersection-check: " +
           counted(verification.new_pairs.size(), "new offending pair");
  if (result.report.is_stopped)
    return where + "interrupted at " + counted(result.soup.triangles.size(), "face") +
           "; this result is verified and written";
  if (request.is_target_required && !result.report.is_reached())
    return where + "the target of " + counted(result.report.faces_target, "face") +
           " was missed: " + with_commas(result.soup.triangles.size()) + " are left" +
           (result.report.hindrances.total() > 0
                ? ", held back most by " + most_frequent_reason(result.report.hindrances)
                : "") +
           "; the result is written";
  return "";
}

} // namespace selvedge::app
