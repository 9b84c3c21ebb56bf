// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "lines.h"

#include "Surface_tree.h"
#include "sides.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <cmath>

// Finds the borders and seams of a result and its original, measures how far apart they are, and finds seams
// that have opened, for `compare`.

namespace selvedge::internal {
namespace {

/// Whether two corners at one position differ in vertex number, texture coordinate, group, object or
/// material.
bool differ(const Triangle_soup& soup, std::size_t a, std::size_t b)
{
  const auto differ_in_label = [&](const Triangle_labels& labels) {
    return !labels.empty() && labels.of_triangle[a / 3] != labels.of_triangle[b / 3];
  };
  const auto uv = [&](std::size_t corner) {
    return soup.uvs.values[soup.uvs.of_triangle[corner / 3][corner % 3]];
  };
  return soup.triangles[a / 3][a % 3] != soup.triangles[b / 3][b % 3] ||
         (!soup.uvs.empty() && uv(a) != uv(b)) || differ_in_label(soup.groups) ||
         differ_in_label(soup.objects) || differ_in_label(soup.materials);
}

Line_distance line_distance(const Lines& from, const Lines& to)
{
  return {distance(from.edges, to.edges), maximum_distance(from.edges, to.edges)};
}

/// Returns the direction from an edge across its face, at right angles to the edge.
Vector_3 inwards(const Surface& edges, const Lines& lines, Index edge)
{
  const Vector_3 along = edges.corner(edge, 1) - edges.corner(edge, 0);
  const Vector_3 across = edges.points[lines.opposite[edge]] - edges.corner(edge, 0);
  const double length = along.squared_length();
  return length > 0 ? across - (across * along / length) * along : across;
}

} // namespace

Borders_and_seams borders_and_seams(const Triangle_soup& soup)
{
  Borders_and_seams result;
  result.borders.edges.points = result.seams.edges.points = soup.points;
  const auto add = [&](Lines& lines, const Side& side) {
    const auto vertex = [&](std::size_t corner) { return soup.triangles[corner / 3][corner % 3]; };
    const Index a = vertex(side.corner_at_low), b = vertex(side.corner_at_high);
    const std::size_t opposite = 3 - side.corner_at_low % 3 - side.corner_at_high % 3;
    lines.edges.triangles.push_back({a, b, b});
    lines.opposite.push_back(soup.triangles[side.corner_at_low / 3][opposite]);
  };
  const std::vector<Side> sides = sides_between_positions(soup.points, soup.triangles);
  Cancellation_poll poll;
  for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
    poll();
    bool is_seam = false;
    for (; last != sides.end() && last->low == first->low && last->high == first->high; ++last)
      is_seam = is_seam || differ(soup, first->corner_at_low, last->corner_at_low) ||
                differ(soup, first->corner_at_high, last->corner_at_high);
    if (last - first == 1)
      add(result.borders, *first);
    else if (is_seam)
      add(result.seams, *first);
  }
  return result;
}

Line_comparison compare_lines(const Lines& result, const Lines& original)
{
  return {original.edges.triangles.size(), result.edges.triangles.size(), line_distance(original, result),
          line_distance(result, original)};
}

Gaps find_gaps(const Borders_and_seams& result, const Borders_and_seams& original)
{
  Gaps gaps;
  if (original.seams.edges.triangles.empty() || result.borders.edges.triangles.empty())
    return gaps;
  const int exponent = common_exponent(result.borders.edges, original.seams.edges);
  const Surface edges(result.borders.edges, exponent), seams(original.seams.edges, exponent),
      borders(original.borders.edges, exponent);
  Surface_tree seam_tree(seams);
  std::optional<Surface_tree> border_tree;
  if (!borders.triangles.empty())
    border_tree.emplace(borders);
  // Positive when a point is farther from the original's border than from its seams.
  const auto excess = [&](const Point_3& point) {
    const auto distance_to = [&](Surface_tree& tree) {
      return std::sqrt(CGAL::squared_distance(point, tree.nearest(point).point));
    };
    return border_tree ? distance_to(*border_tree) - distance_to(seam_tree) : 1;
  };

  Lines open = {{}, {}};
  open.edges.points = result.borders.edges.points;
  Cancellation_poll poll;
  for (Index edge = 0; edge < edges.triangles.size(); ++edge) {
    poll();
    const Point_3 &a = edges.corner(edge, 0), &b = edges.corner(edge, 1);
    const double of_ends = excess(a) + excess(b);
    if (of_ends > 0 || (of_ends == 0 && excess(CGAL::midpoint(a, b)) > 0)) {
      open.edges.triangles.push_back(edges.triangles[edge]);
      open.opposite.push_back(result.borders.opposite[edge]);
    }
  }
  gaps.open_edges = open.edges.triangles.size();
  if (gaps.open_edges == 0)
    return gaps;

  const Surface open_edges(open.edges, exponent);
  std::vector<Vector_3> directions;
  for (Index edge = 0; edge < gaps.open_edges; ++edge)
    directions.push_back(inwards(open_edges, open, edge));
  Surface_tree tree(open_edges);
  for (Index edge = 0; edge < gaps.open_edges; ++edge) {
    poll();
    const Point_3 &a = open_edges.corner(edge, 0), &b = open_edges.corner(edge, 1);
    gaps.length += std::sqrt(CGAL::squared_distance(a, b));
    const Point_3 middle = CGAL::midpoint(a, b);
    if (const auto across = tree.nearest_facing(middle, directions, -directions[edge], 4))
      gaps.width = std::max(gaps.width, std::sqrt(CGAL::squared_distance(middle, across->point)));
  }
  gaps.length = std::ldexp(gaps.length, exponent);
  gaps.width = std::ldexp(gaps.width, exponent);
  return gaps;
}

} // namespace selvedge::internal
