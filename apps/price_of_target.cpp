// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "price_of_target.h"

#include "small_pieces.h"
#include "text.h"

#include <selvedge/Missed_target.h>
#include <selvedge/Parts.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

/// Returns the options that let most of the faces go that were kept for the shape. A reduction to another
/// target takes edges in another order, and may end a little above what was possible with this one, so the
/// options leave it a third of the faces that were kept.
std::string options_without_shape(const Simplify_request& request, const Simplify_report& report)
{
  const std::vector<Simplify_intent::Part_ratio>& parts = request.intent.ratios;
  std::string options;
  for (std::size_t i = 0; i < report.shares.size(); ++i) {
    const Simplify_report::Share& share = report.shares[i];
    if (share.within_reach == 0)
      continue;
    const std::size_t faces = share.within_reach + (share.output - share.within_reach + 2) / 3;
    const std::string ratio = with_digits_up(double(faces - share.fixed) / double(share.input - share.fixed));
    if (i > 0)
      options += " --ratio '" + parts[i - 1].name + '=' + ratio + '\'';
    else if (!request.lods.empty())
      options += " --lods " + ratio;
    else if (request.options.ratio && !parts.empty())
      options += " --ratio " + ratio;
    else
      options += " --faces " + std::to_string(faces);
  }
  return options;
}

/// Says that borders were let turn farther, and by which option they are not; empty where none was.
std::string what_borders_lose(const Simplify_options& asked, const Simplify_report& report)
{
  if (!report.eased_border_turn)
    return "";
  return "\neased: the turn of borders, whose corners keep faces that the rest needs more; --border-turn " +
         with_digits(asked.max_border_turn) + " keeps them";
}

} // namespace

std::string what_shape_takes(const Simplify_request& request, const Simplify_report& report,
                             const Distance& distance)
{
  const std::size_t faces = report.faces_output, within_reach = report.faces_within_reach;
  if (within_reach > 0 && within_reach < faces)
    return "\nkept: " + counted(faces - within_reach, "face") +
           " that could go, because all that nothing holds would be flattened for them;" +
           options_without_shape(request, report) + " lets most of them go" +
           what_borders_lose(request.options, report);
  const bool is_target_asked_for = request.options.ratio || request.options.faces || !request.lods.empty();
  if (!is_target_asked_for || is_shape_kept(request))
    return "";
  if (!Missed_target::is_flattened(request.options, distance))
    return "";
  return "\nflattened: all that nothing holds, as far as --error " + with_digits(*request.options.max_error) +
         " allows; a ratio that is larger by a tenth keeps more of its shape";
}

std::string what_is_left_for_pieces(const Prepared_soup& prepared, const Simplify_report& report)
{
  constexpr double hardly_enough = 8;
  const double pieces = double(part_kinds(prepared.soup).front().count);
  if (pieces < 2 || report.faces_target == 0)
    return "";
  const std::optional<Small_pieces> small = small_pieces(prepared.soup);
  if (double(report.faces_target) <= hardly_enough * pieces)
    return "\npieces: the target leaves " + with_digits(double(report.faces_target) / pieces) +
           " faces for each of the " + with_commas(std::size_t(pieces)) + ", and none of them vanishes" +
           (small ? "; --drop-smaller " + small->length + " leaves out the small ones, " +
                        with_commas(small->count) + " with " + counted(small->triangles, "face")
                  : "");
  if (!small || 2 * small->triangles < prepared.soup.triangles.size())
    return "";
  return "\npieces: " + with_commas(small->count) + " small ones have " + with_commas(small->triangles) +
         " of the faces of the input, and none of them vanishes; --drop-smaller " + small->length +
         " leaves them out";
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
