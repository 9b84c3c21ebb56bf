// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "coarse_part.h"

#include "text.h"

#include <selvedge/Parts.h>
#include <selvedge/part_report.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

constexpr double far_fewer = 0.5;   // of the share of faces that the whole keeps
constexpr double shapeless = 0.005; // root mean square distance, as a share of the size of the part

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
  for (const Part_kind& kind : part_kinds(original.soup)) {
    if (kind.names.empty())
      continue;
    std::vector<Part_triangles> parts = triangles_of_parts(kind, result);
    const auto share_of = [](const Part_triangles& part) {
      return double(part.after.size()) / double(part.before.size());
    };
    std::vector<std::string> names; // of the parts that may have lost their shape
    std::vector<Part_triangles> suspects;
    for (Index i = 0; i < kind.count; ++i)
      if (parts[i].before.size() > most && share_of(parts[i]) < far_fewer * share_of_whole &&
          !kind.names[i].empty() && !has_ratio[parts[i].before.front()]) {
        names.push_back(kind.names[i]);
        suspects.push_back(std::move(parts[i]));
      }
    const std::vector<Part_distance> distances = part_distances(result, original, suspects);
    for (std::size_t i = 0; i < suspects.size(); ++i) {
      const double off = distances[i].distance.root_mean_square / distances[i].diagonal;
      if (!(off > shapeless) || suspects[i].before.size() <= most)
        continue;
      most = suspects[i].before.size();
      text = std::string(name(kind.name)) + " '" + names[i] + "' keeps " + percent(share_of(suspects[i])) +
             " of its faces" +
             (suspects[i].after.empty() ? "" : " and is off by " + percent(off) + " of its own size (RMS)") +
             "; --ratio '" + names[i] + '=' +
             with_digits((std::min)(1.0, 2 * (std::max)(share_wanted, share_of(suspects[i]))), "%.2g") +
             "' keeps more of it";
    }
  }
  return text;
}

} // namespace selvedge::app
