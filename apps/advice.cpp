// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "advice.h"

#include "small_pieces.h"
#include "text.h"

#include <selvedge/Missed_target.h>
#include <selvedge/Parts.h>
#include <selvedge/attributes.h>
#include <selvedge/inspect.h>
#include <selvedge/normals.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

/// Returns the reasons that hold edges back, those of most edges first.
std::vector<Hindrances::Description> reasons(const Hindrances& hindrances)
{
  std::vector<Hindrances::Description> reasons;
  for (const Hindrances::Description& description : Hindrances::descriptions())
    if (hindrances[description.reason] > 0)
      reasons.push_back(description);
  std::stable_sort(reasons.begin(), reasons.end(),
                   [&](const auto& a, const auto& b) { return hindrances[a.reason] > hindrances[b.reason]; });
  return reasons;
}

/// Returns the options that let the faces go that were kept for the shape.
std::string options_without_shape(const Simplify_request& request, const Simplify_report& report)
{
  const std::vector<Simplify_intent::Part_ratio>& parts = request.intent.ratios;
  std::string options;
  for (std::size_t i = 0; i < report.shares.size(); ++i) {
    const Simplify_report::Share& share = report.shares[i];
    if (share.within_reach == 0)
      continue;
    const std::string ratio =
        with_digits_up(double(share.within_reach - share.fixed) / double(share.input - share.fixed));
    if (i > 0)
      options += " --ratio '" + parts[i - 1].name + '=' + ratio + '\'';
    else if (!request.lods.empty())
      options += " --lods " + ratio;
    else if (request.options.ratio && !parts.empty())
      options += " --ratio " + ratio;
    else
      options += " --faces " + std::to_string(share.within_reach);
  }
  return options;
}

/// Returns the option that takes a reason away; empty when none does.
std::string remedy(Hindrance reason, const Simplify_request& request)
{
  const Simplify_options& options = request.options;
  switch (reason) {
  case Hindrance::frozen:
    return defects_of(request) == Defects::freeze ? "--defects descend" : "";
  case Hindrance::misoriented:
    return request.are_faces_oriented ? "" : "--orient auto";
  case Hindrance::locked:
    return request.intent.locked.empty() ? "--keep for fewer parts" : "--lock for fewer parts";
  case Hindrance::normals:
    return joins_vertices(request.normals) || !request.progressive.empty() ? "" : "--normals loose";
  case Hindrance::border_turn:
    return options.max_border_turn == 180      ? ""
           : request.corner_height.has_value() ? "--border-turn 180 without --corner-height"
                                               : "--border-turn 180";
  case Hindrance::seam_turn:
    return options.max_seam_turn < 180 ? "--seam-turn 180" : "";
  case Hindrance::drift:
    return "--border-drift " +
           with_digits(options.max_border_drift > 0 ? 5 * options.max_border_drift : 0.01);
  case Hindrance::gap:
    return request.open_seams == Open_seams::hold ? "--weld auto or none" : "";
  case Hindrance::aspect_ratio:
    return options.min_aspect_ratio > 0 ? "--aspect-ratio 0" : "";
  case Hindrance::normal_change:
    return options.max_normal_change < 90    ? "--normal-change 90"
           : options.max_normal_change < 180 ? "--normal-change 180"
                                             : "";
  case Hindrance::error:
    return "--error " + with_digits(*options.max_error > 0 ? 5 * *options.max_error : 0.01);
  case Hindrance::clearance:
    return "--clearance " + with_digits(*options.clearance / 2);
  case Hindrance::companions:
    return "--instances apart";
  case Hindrance::by_loop:
    return "--loop own";
  default:
    return "";
  }
}

/// Says why no option takes a reason away.
std::string why_it_stays(Hindrance reason)
{
  switch (reason) {
  case Hindrance::frozen:
    return "what only rounding has brought to one place stays as it is";
  case Hindrance::non_manifold:
    return "what meets at edges of three faces or more stays as it is";
  case Hindrance::misoriented:
    return "what cannot be turned to face one way, like a Moebius band, stays as it is there";
  case Hindrance::topology:
    return "every piece keeps its holes and handles";
  case Hindrance::intersection:
    return "no layer passes through another";
  default:
    return "borders, seams and textures are kept";
  }
}

/// Says what `remedy` costs, if that is the shape or the size of the file.
std::string cost_of_remedy(Hindrance reason, const Simplified_soup& reduced)
{
  if (reason == Hindrance::companions)
    return ", which may make " + with_commas(reduced.shared_places) + " meshes of " +
           with_commas(reduced.shared_meshes);
  return reason == Hindrance::error ? ", which costs shape" : "";
}

/// Options that are named to a user whose target was missed.
struct Remedies
{
  std::string text;      // empty when there is none
  std::size_t edges = 0; // that are held by the reasons against which they are
  bool let_seams_gape = false;
};

/// Returns the option against the most frequent reason that has one and holds a tenth of the edges, of those
/// that are not in parts at their target, and that against the next, if it is half as frequent: an edge that
/// one of them lets go may be held by the other.
Remedies remedies(const std::vector<Hindrances::Description>& all, const Simplify_request& request,
                  const Simplified_soup& reduced)
{
  const Hindrances& hindrances = reduced.report.hindrances;
  std::vector<std::pair<std::string, Hindrances::Description>> options;
  const std::size_t total = hindrances.total() - hindrances[Hindrance::target];
  for (const Hindrances::Description& description : all) {
    const std::string option = remedy(description.reason, request);
    if (option.empty() || 10 * hindrances[description.reason] < total)
      continue;
    if (!options.empty() && 2 * hindrances[description.reason] < hindrances[options[0].second.reason])
      break;
    options.emplace_back(option, description);
    if (options.size() == 2)
      break;
  }
  Remedies result;
  std::string cost;
  for (const auto& [option, description] : options) {
    const bool is_clear = options.size() == 1 && description.reason == all[0].reason;
    result.text += (result.text.empty() ? ""
                    : cost.empty()      ? " and "
                                        : ", and ") +
                   option + (is_clear ? "" : std::string(" against ") + description.name);
    cost = cost_of_remedy(description.reason, reduced);
    result.text += cost;
    result.edges += hindrances[description.reason];
    result.let_seams_gape |= description.reason == Hindrance::gap;
  }
  return result;
}

/// Names the attribute that makes most of the seams that nothing else makes, if they are many. A texture is
/// named where seams and their ends hold more edges than the options that are named are against.
std::string seams_to_leave_out(const Prepared_soup& prepared, const Hindrances& hindrances,
                               const Remedies& options)
{
  const std::size_t by_seams =
      hindrances[Hindrance::seam] + hindrances[Hindrance::texture] + hindrances[Hindrance::line_end];
  const bool is_texture_left = !options.text.empty() && options.edges >= by_seams;
  std::pair<std::string, std::size_t> most;
  for (const auto& [name, count] : seams_of_attributes(prepared))
    if (count > most.second && !(is_texture_left && name == "texture"))
      most = {name, count};
  if (10 * most.second < hindrances.total())
    return "";
  const std::string name = name_to_drop(most.first);
  return "; " + counted(most.second, "edge") + " of the input " +
         (most.second == 1 ? "is a seam" : "are seams") + " because of " + most.first +
         " and nothing else: " +
         (name.empty() ? "leave it out of the file" : "--drop-attribute " + name + " lets them go") +
         ", if nobody needs it";
}

/// Names what holds open seams, if that holds many edges: gaps that get no wider, and borders that drift less
/// there.
std::string seams_to_let_gape(const Simplify_request& request, const Prepared_soup& prepared,
                              const Hindrances& hindrances)
{
  const std::size_t held = hindrances[Hindrance::gap] + hindrances[Hindrance::drift];
  if (request.open_seams != Open_seams::hold || prepared.facing.empty() || 10 * held < hindrances.total())
    return "";
  return "; " + with_commas(held) +
         " are held so that seams that stand open get hardly wider: --weld none lets them go";
}

} // namespace

std::string held_back(const Simplify_request& request, const Prepared_soup& prepared,
                      const Simplified_soup& result)
{
  const Simplify_report& report = result.report;
  const Hindrances& hindrances = report.hindrances;
  if (hindrances.total() == 0)
    return "all faces left are fixed; no option helps";
  constexpr std::size_t least_named = 3; // and as many as make two thirds of the edges
  std::string text =
      "of " + counted(hindrances.total(), "edge") + " left" +
      (report.faces_within_reach > 0 ? " at " + counted(report.faces_within_reach, "face") : "") + ", ";
  const std::vector<Hindrances::Description> all = reasons(hindrances);
  std::size_t others = hindrances.total();
  for (std::size_t i = 0; i < all.size() && (i < least_named || 3 * others > hindrances.total()); ++i) {
    const std::size_t count = hindrances[all[i].reason];
    text += (i == 0 ? "" : ", ") + (count == hindrances.total() ? "all" : with_commas(count)) + " by " +
            all[i].name;
    others -= count;
  }
  if (others > 0)
    text += ", " + with_commas(others) + " by other rules";
  const Remedies options = remedies(all, request, result);
  const std::string seams = seams_to_leave_out(prepared, hindrances, options),
                    gaping = options.let_seams_gape ? "" : seams_to_let_gape(request, prepared, hindrances);
  if (!options.text.empty())
    text += "; try " + options.text;
  else if (seams.empty() && gaping.empty())
    text += "; no option helps much: " + std::string(why_it_stays(all[0].reason));
  return text + seams + gaping;
}

std::string most_frequent_reason(const Hindrances& hindrances)
{
  return reasons(hindrances)[0].name;
}

std::string what_shape_takes(const Simplify_request& request, const Simplify_report& report,
                             const Distance& distance)
{
  const std::size_t faces = report.faces_output, within_reach = report.faces_within_reach;
  if (within_reach > 0 && within_reach < faces)
    return "\nkept: " + counted(faces - within_reach, "face") +
           " that could go, because all that nothing holds would be flattened for them;" +
           options_without_shape(request, report) + " lets them go";
  const bool is_asked_for_target = request.options.ratio || request.options.faces || !request.lods.empty();
  if (is_shape_kept(request) || !is_asked_for_target ||
      !Missed_target::is_flattened(request.options, distance))
    return "";
  return "\nflattened: all that nothing holds, as far as --error " + with_digits(*request.options.max_error) +
         " allows; a ratio that is larger by a tenth keeps more of its shape";
}

std::string what_is_left_for_pieces(const Prepared_soup& prepared, const Simplify_report& report)
{
  constexpr double hardly_enough = 8;
  const double pieces = double(part_kinds(prepared.soup).front().count);
  if (pieces < 2 || report.faces_target == 0 || double(report.faces_target) > hardly_enough * pieces)
    return "";
  const std::optional<Small_pieces> small = small_pieces(prepared.soup);
  return "\npieces: the target leaves " + with_digits(double(report.faces_target) / pieces) +
         " faces for each of the " + with_commas(std::size_t(pieces)) + ", and none of them vanishes" +
         (small ? "; --drop-smaller " + small->length + " leaves out the small ones, " +
                      with_commas(small->count) + " with " + counted(small->triangles, "face")
                : "");
}

std::string what_texture_takes(const Simplify_request& request, const Triangle_soup& soup)
{
  constexpr std::size_t most_vertices = 100000; // in meshes that have more, few are on seams
  if (soup.uvs.empty() || soup.points.size() > most_vertices)
    return "";
  std::vector<std::pair<Point_3, std::array<double, 2>>> values; // of all corners, each once
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      values.emplace_back(soup.points[soup.triangles[t][k]], soup.uvs.values[soup.uvs.of_triangle[t][k]]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::size_t positions = 0, on_seams = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_first = i == 0 || values[i - 1].first != values[i].first;
    positions += is_first;
    on_seams += is_first && i + 1 < values.size() && values[i + 1].first == values[i].first;
  }
  if (2 * on_seams <= positions)
    return "";
  return "\ntexture: " + with_commas(on_seams) + " of " + counted(positions, "vertex", "vertices") +
         " left lie on its seams, which keep their course; " +
         (request.options.max_seam_turn < 180 ? "--seam-turn 180 lets them go straighter, " : "") +
         "--drop-attribute texture lets them go, if it is baked anew";
}

} // namespace selvedge::app
