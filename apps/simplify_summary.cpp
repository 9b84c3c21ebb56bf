// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "simplify_summary.h"

#include "text.h"

#include <selvedge/Parts.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <ostream>
#include <sstream>
#include <utility>

namespace selvedge::app {
namespace {

// From here on a user should know where the result is off.
constexpr double far_off = 0.01;

std::string percent(double share)
{
  return with_digits(100 * share) + " %";
}

/// Says in a clause why a reduction ended before its target.
std::string why_missed(const Simplify_request& request, const Simplify_report& report)
{
  // The error is asked last of what limits shape, so that each collapse that it refused would go on.
  const std::optional<double>& error = request.options.max_error;
  if (error && !report.is_stopped && report.refused_in_last_pass.error > 0)
    return "fewer would move the surface by more than " + percent(*error) + " of its size" +
           (*error > 0 ? "; --error " + with_digits(5 * *error) + " goes on" : "");
  const std::string outcome = report.outcome();
  for (const Refusals::Rule& rule : Refusals::rules())
    if (outcome == rule.key)
      return std::string("the rule '") + rule.name + "' refuses most of the collapses left";
  return report.is_stopped ? "it was interrupted" : "every collapse left would change the topology";
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

void print_snapping(std::ostream& stream, const Snapping_notes& notes)
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
  print(notes.left_frozen, "a face there is frozen");
  print(notes.left_foreign, "the partner belongs to a node with another transform");
  print(notes.left_ambiguous, "every partner has a nearer one");
  print(notes.near_without_edge, "no edge beside them can be sewn to the border that is near");
}

} // namespace

void print_input(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                 const Json& notes, const std::vector<std::string>& dropped)
{
  stream << request.input << ": " << counted(prepared.soup.triangles.size(), "face");
  if (!prepared.offending_pairs.empty())
    stream << ", " << counted(prepared.offending_pairs.size(), "offending pair") << ", "
           << counted(prepared.frozen_faces, "face") << " frozen";
  if (const std::size_t left_out = prepared.left_out_faces + prepared.left_out_by_rounding; left_out > 0)
    stream << ", " << counted(left_out, "degenerate face") << " left out";
  stream << '\n';
  for (const Json& note : notes)
    stream << "  " << note.get<std::string>() << '\n';
  if (prepared.rounding.coordinates > 0)
    stream << "  " << counted(prepared.rounding.coordinates, "coordinate")
           << " rounded to 32-bit floats, because the output's format stores nothing more precise\n";
  if (prepared.normals == Normals_treatment::flat)
    stream << "  normals made anew: every face of the input has its own, as in flat shading\n";
  if (prepared.normals == Normals_treatment::smooth)
    stream << "  normals made anew, with the hard edges of the input\n";
  if (request.weld_distance > 0)
    print_snapping(stream, prepared.snapping);
  const char* separator = "  not in the output, because its format cannot hold them: ";
  for (const std::string& what : dropped)
    stream << std::exchange(separator, ", ") << what;
  stream << (dropped.empty() ? "" : "\n");
}

void print_summary(std::ostream& stream, const Simplify_request& request, const Prepared_soup& prepared,
                   const Level& level, const Outcome& outcome)
{
  const auto& [output, result, verification] = level;
  const Simplify_report& done = result.report;
  const std::size_t faces = result.soup.triangles.size();
  const Distance& distance = verification.distances->original_to_result;
  stream << "reduced to " << counted(faces, "face") << " ("
         << with_digits(100.0 * double(faces) / double(prepared.soup.triangles.size())) << " %) in "
         << with_digits(done.seconds_reduce) << " s: ";
  if (request.options.ratio || request.options.faces || !request.lods.empty() ||
      !request.intent.ratios.empty())
    stream << "target " << with_commas(done.faces_target)
           << (done.is_reached() ? " reached" : " not reached: " + why_missed(request, done));
  else
    stream << "as far as the limits allow";
  if (done.faces_fixed > 0)
    stream << "\nfixed: " << counted(done.faces_fixed, "face")
           << " with all corners frozen, locked or coincident; a ratio is of the other "
           << with_commas(done.faces_input - done.faces_fixed);
  stream << "\ncollapses refused, by rule:";
  const char* separator = " ";
  for (const Refusals::Rule& rule : Refusals::rules())
    if (done.refused.*rule.count > 0)
      stream << std::exchange(separator, ", ") << rule.name << ' ' << with_commas(done.refused.*rule.count);
  stream << (*separator == ' ' ? " none" : "");
  if (result.placed_vertices > 0)
    stream << "\nvertices: " << with_commas(result.soup.points.size() - result.placed_vertices)
           << " kept bit for bit, " << with_commas(result.placed_vertices)
           << " at new places with interpolated attributes";
  stream << "\njudged: ";
  if (verification.embedded())
    stream << "embedded (no triangles touch or cross)";
  else
    stream << counted(verification.pairs.size(), "offending pair")
           << " (triangles that touch or cross, or are degenerate), "
           << with_commas(verification.new_pairs.size()) << " of them new";
  stream << ", topology " << (verification.same_topology() ? "kept" : "CHANGED")
         << "\ndistance from the original's vertices: " << percent(distance.root_mean_square)
         << " of the diagonal (RMS), at most " << percent(distance.maximum) << '\n';
  if (distance.maximum > far_off)
    stream << "worst deviation " << percent(distance.maximum) << " of the size, "
           << place_of(distance.farthest, prepared.soup) << '\n';
  stream << (outcome.is_written() ? "written: " : "NOT written: ") << output << std::endl;
}

std::string complaint(const Simplify_request& request, const Level& level, const Outcome& outcome)
{
  const auto& [output, result, verification] = level;
  const std::string where = request.lods.empty() ? "" : output + ": ";
  if (!outcome.is_written()) {
    if (verification.accepted() && verification.same_topology())
      return "";
    return where + "THE RESULT IS WRONG and was not written: " +
           counted(verification.new_pairs.size(), "new offending pair") +
           (verification.same_topology() ? "" : ", topology changed") +
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
           " was missed: " + with_commas(result.soup.triangles.size()) + " are left, because " +
           why_missed(request, result.report) + "; the result is written";
  return "";
}

} // namespace selvedge::app
