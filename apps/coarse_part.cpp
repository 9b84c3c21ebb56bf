// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "coarse_part.h"

#include "text.h"

#include <selvedge/Parts.h>
#include <selvedge/verify.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace selvedge::app {
namespace {

constexpr double far_fewer = 0.5;   // of the share of faces that the whole keeps
constexpr double shapeless = 0.005; // root mean square distance, as a share of the size of the part

/// Returns the geometry of some triangles, with three points for each.
Triangle_soup geometry(const Triangle_soup& soup, const std::vector<Index>& triangles, const Scale& scale)
{
  Triangle_soup cut;
  for (const Index t : triangles) {
    const Index first = Index(cut.points.size());
    for (const Index vertex : soup.triangles[t])
      cut.points.push_back(scale(soup.points[vertex]));
    cut.triangles.push_back({first, first + 1, first + 2});
  }
  return cut;
}

double diagonal(const Triangle_soup& soup)
{
  CGAL::Bbox_3 box;
  for (const Point_3& point : soup.points)
    box += point.bbox();
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

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

/// Returns the share of faces that the whole keeps, without the parts that have a ratio of their own: at most
/// what is asked for.
double share_kept(const Simplify_request& request, const std::vector<char>& has_ratio,
                  const std::vector<Index>& triangles_left)
{
  const auto before = std::count(has_ratio.begin(), has_ratio.end(), char(false));
  const auto after = std::count_if(triangles_left.begin(), triangles_left.end(),
                                   [&](Index triangle) { return !has_ratio[triangle]; });
  const double share = before > 0 ? double(after) / double(before) : 0;
  return (std::min)(share, request.options.ratio.value_or(1));
}

} // namespace

std::string coarse_part(const Simplify_request& request, const Prepared_soup& original,
                        const Simplified_soup& result)
{
  if (request.is_in_cells) // parts cannot have ratios then
    return "";
  const std::vector<char> has_ratio = triangles_with_ratio(request, original.soup);
  const double share_of_whole = share_kept(request, has_ratio, result.triangles);
  std::string text;
  std::size_t most = 0;
  for (const Part_kind& kind : part_kinds(original.soup)) {
    if (kind.names.empty())
      continue;
    std::vector<std::vector<Index>> before(kind.count), after(kind.count);
    for (Index t = 0; t < kind.of_triangle.size(); ++t)
      before[kind.of_triangle[t]].push_back(t);
    for (Index i = 0; i < result.triangles.size(); ++i)
      after[kind.of_triangle[result.triangles[i]]].push_back(i);
    for (Index part = 0; part < kind.count; ++part) {
      const double share = double(after[part].size()) / double(before[part].size());
      if (kind.names[part].empty() || before[part].size() <= most || has_ratio[before[part].front()] ||
          !(share < far_fewer * share_of_whole))
        continue;
      const Triangle_soup shape = geometry(original.soup, before[part], original.scale);
      const double off = // infinite when nothing is left
          distance(shape, geometry(result.soup, after[part], original.scale)).root_mean_square /
          diagonal(shape);
      if (!(off > shapeless))
        continue;
      most = before[part].size();
      text = std::string(name(kind.name)) + " '" + kind.names[part] + "' keeps " + percent(share) +
             " of its faces" +
             (after[part].empty() ? "" : " and is off by " + percent(off) + " of its own size (RMS)") +
             "; --ratio '" + kind.names[part] + '=' +
             with_digits((std::min)(1.0, 2 * share_of_whole), "%.2g") + "' keeps more of it";
    }
  }
  return text;
}

} // namespace selvedge::app
