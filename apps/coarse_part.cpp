// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "coarse_part.h"

#include "text.h"

#include <selvedge/Parts.h>
#include <selvedge/part_report.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

constexpr double far_fewer = 0.5;   // of the share of faces that the whole keeps
constexpr double shapeless = 0.005; // root mean square distance, as a share of the size of the part

constexpr std::size_t least_piece = 100;    // triangles of a piece without a name that is worth a word
constexpr std::size_t most_suspects = 1000; // parts that are measured, the largest ones

/// Returns one flag per triangle: whether the user has given a ratio for a part to which it belongs.
std::vector<char> triangles_with_ratio(const Simplify_request& request, const Triangle_soup& soup)
{
  std::vector<char> have(soup.triangles.size(), false);
  for (const Simplify_intent::Part_ratio& part : request.intent.ratios) {
    const std::vector<char> is_named = triangles_named(soup, part.name);
    for (std::size_t t = 0; t < have.size(); ++t)
      have[t] = have[t] || is_named[t];
  }
  return have;
}

/// Returns the share of faces that the whole keeps, without the parts that have a ratio of their own.
double share_kept(const std::vector<char>& has_ratio, const std::vector<Index>& triangles_left)
{
  const auto before = std::count(has_ratio.begin(), has_ratio.end(), char(false));
  const auto after = std::count_if(triangles_left.begin(), triangles_left.end(),
                                   [&](Index triangle) { return !has_ratio[triangle]; });
  return before > 0 ? double(after) / double(before) : 0;
}

double share_of(const Part_triangles& part)
{
  return double(part.after.size()) / double(part.before.size());
}

struct Coarse_part
{
  Index number;
  Part_triangles triangles;
  double off; // root mean square distance, as a share of its size
};

/// Returns the largest part of a kind that has lost its shape, if it has more than `most` triangles, and no
/// ratio of its own.
std::optional<Coarse_part> largest_coarse_part(const Part_kind& kind, const std::vector<char>& has_ratio,
                                               double share_of_whole, std::size_t most,
                                               const Prepared_soup& original, const Simplified_soup& result)
{
  std::vector<Part_triangles> parts = triangles_of_parts(kind, result);
  std::vector<Index> suspects;
  for (Index i = 0; i < kind.count; ++i)
    if (parts[i].before.size() > most && share_of(parts[i]) < far_fewer * share_of_whole &&
        (kind.names.empty() || !kind.names[i].empty()) && !has_ratio[parts[i].before.front()])
      suspects.push_back(i);
  std::stable_sort(suspects.begin(), suspects.end(),
                   [&](Index a, Index b) { return parts[a].before.size() > parts[b].before.size(); });
  suspects.resize((std::min)(suspects.size(), most_suspects));
  std::vector<Part_triangles> triangles;
  for (const Index i : suspects)
    triangles.push_back(std::move(parts[i]));
  const std::vector<Part_distance> distances = part_distances(result, original, triangles);
  for (std::size_t i = 0; i < suspects.size(); ++i)
    if (const double off = distances[i].distance.root_mean_square / distances[i].diagonal; off > shapeless)
      return Coarse_part{suspects[i], std::move(triangles[i]), off};
  return std::nullopt;
}

std::string what_it_keeps(const Coarse_part& part)
{
  return " keeps " + percent(share_of(part.triangles)) + " of its faces" +
         (part.triangles.after.empty() ? ""
                                       : " and is off by " + percent(part.off) + " of its own size (RMS)");
}

/// Says where a part of the original is: the middle of its bounding box.
std::string place_of(const Part_triangles& part, const Triangle_soup& soup)
{
  CGAL::Bbox_3 box;
  for (const Index t : part.before)
    for (const Index v : soup.triangles[t])
      box += soup.points[v].bbox();
  const auto middle = [&](int axis) { return with_digits(box.min(axis) / 2 + box.max(axis) / 2); };
  return "(" + middle(0) + ", " + middle(1) + ", " + middle(2) + ")";
}

/// Says in which group, object or material all triangles of a piece are, if the mesh has several: the first
/// kind that knows it.
std::string home_of(const Part_triangles& piece, const std::vector<Part_kind>& kinds)
{
  for (const Part_kind& kind : kinds) {
    if (kind.names.empty() || kind.count < 2)
      continue;
    const Index part = kind.of_triangle[piece.before.front()];
    if (!kind.names[part].empty() && std::all_of(piece.before.begin(), piece.before.end(),
                                                 [&](Index t) { return kind.of_triangle[t] == part; }))
      return std::string(" in ") + name(kind.name) + " '" + kind.names[part] + "'";
  }
  return "";
}

} // namespace

std::string coarse_part(const Simplify_request& request, const Prepared_soup& original,
                        const Simplified_soup& result)
{
  if (request.is_in_cells || (!request.lods.empty() && !request.progressive.empty()))
    return ""; // parts cannot have ratios then
  const std::vector<char> has_ratio = triangles_with_ratio(request, original.soup);
  const double share_of_whole = share_kept(has_ratio, result.triangles),
               share_wanted = (std::min)(share_of_whole, request.options.ratio.value_or(1));
  std::string text;
  std::size_t most = 0;
  const std::vector<Part_kind> kinds = part_kinds(original.soup);
  for (const Part_kind& kind : kinds) {
    if (kind.names.empty())
      continue;
    const auto part = largest_coarse_part(kind, has_ratio, share_of_whole, most, original, result);
    if (!part)
      continue;
    most = part->triangles.before.size();
    const std::string& of_part = kind.names[part->number];
    text = std::string(name(kind.name)) + " '" + of_part + "'" + what_it_keeps(*part) + "; --ratio '" +
           of_part + '=' +
           with_digits((std::min)(1.0, 2 * (std::max)(share_wanted, share_of(part->triangles))), "%.2g") +
           "' keeps more of it";
  }
  if (!text.empty())
    return text;
  const auto piece =
      largest_coarse_part(kinds.front(), has_ratio, share_of_whole, least_piece, original, result);
  if (piece)
    text = "the piece around " + place_of(piece->triangles, original.soup) +
           home_of(piece->triangles, kinds) + what_it_keeps(*piece) +
           "; in a group of its own, it could keep more by --ratio 'GROUP=R'";
  return text;
}

} // namespace selvedge::app
