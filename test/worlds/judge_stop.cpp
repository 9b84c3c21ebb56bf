// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "judge_stop.h"

#include "soup/obstacle.h"

#include <selvedge/Parts.h>
#include <selvedge/compare.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace selvedge::test {

std::vector<char> held(const World& world, const Triangle_soup& soup, bool with_locked)
{
  std::vector<char> is_held(soup.triangles.size(), false);
  for (const auto* names : {&world.intent.kept, with_locked ? &world.intent.locked : &world.intent.kept})
    for (const std::string& name : *names) {
      const std::vector<char> is_named = triangles_named(soup, name);
      for (std::size_t t = 0; t < is_held.size(); ++t)
        is_held[t] |= is_named[t];
    }
  return is_held;
}

namespace {

// Whether corners, middles of sides and centres of faces are no farther from the other mesh than a bound
// says, in shares of the diagonal. (A distance from a needle may come out too large by a few 1e-10.)
bool is_bound(const Bounds& bounds, const Triangle_soup& from, const Triangle_soup& to, double diagonal)
{
  Triangle_soup points;
  for (const auto& [a, b, c] : from.triangles) {
    const Point_3 &p = from.points[a], &q = from.points[b], &r = from.points[c];
    for (const Point_3& point : {p, q, r, CGAL::midpoint(p, q), CGAL::midpoint(q, r), CGAL::midpoint(r, p),
                                 CGAL::centroid(p, q, r)}) {
      const Index i = Index(points.points.size());
      points.points.push_back(point);
      points.triangles.push_back({i, i, i});
    }
  }
  double largest = 0; // of the coordinates, of which these points are rounded
  for (const Point_3& point : points.points)
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(point[axis]));
  const double unit = diagonal > 0 ? diagonal : 1, rounding = 0x1p-50 * largest / unit;
  const double seen = distance(points, to).maximum / unit;
  return seen <= bounds.upper * (1 + 1e-9) + rounding + 1e-8;
}

} // namespace

Verdict judge_stop(const World& world, const World_run& run)
{
  const auto broken = [](const std::string& what) { return Broken_promise{Promise::stop, what}; };
  const Simplify_report& report = run.result.report;
  const Triangle_soup& soup = run.prepared.soup;
  if (report.collapses != run.collapses.size())
    return broken("the report counts other collapses");
  const std::vector<Reduction_history::Sample>& samples = run.result.history.samples();
  if (report.collapses != (samples.empty() ? 0 : samples.back().collapses))
    return broken("the history has other collapses");
  if (report.faces_input != soup.triangles.size() || report.faces_output != run.result.soup.triangles.size())
    return broken("the report counts other faces");
  if (report.is_stopped != run.is_told_to_stop)
    return broken("told to stop, and not so reported, or the other way round");
  if (!run.result.soup.triangles.empty()) {
    const Distances at_vertices = distances(run.result.soup, soup);
    if (world.options.max_error &&
        at_vertices.original_to_result.maximum > *world.options.max_error * (1 + 1e-6) + 1e-9)
      return broken("a vertex of the original is farther away than the error allows");
    for (std::size_t pose = 0; world.options.max_error && pose < soup.poses.size(); ++pose)
      if (world.is_guarded(pose) &&
          distance(geometry_in_pose(soup, {}, pose), geometry_in_pose(run.result.soup, {}, pose)).maximum >
              (*world.options.max_error * (1 + 1e-6) + 1e-9) *
                  (at_vertices.diagonal > 0 ? at_vertices.diagonal : 1))
        return broken("a vertex of the original is farther away in a further pose than the error allows");
    const Distances_anywhere anywhere = distances_anywhere(run.result.soup, soup);
    const auto are_bounds = [&](const Triangle_soup& after, const Triangle_soup& before) {
      return is_bound(anywhere.original_to_result, before, after, at_vertices.diagonal) &&
             is_bound(anywhere.result_to_original, after, before, at_vertices.diagonal);
    };
    bool is_any_wrong = !are_bounds(run.result.soup, soup);
    for (std::size_t pose = 0; pose < soup.poses.size(); ++pose)
      is_any_wrong |=
          !are_bounds(geometry_in_pose(run.result.soup, {}, pose), geometry_in_pose(soup, {}, pose));
    if (is_any_wrong)
      return broken("a point is farther from the other mesh than its bounds say");
    for (const Bounds_over_poses& bounds : {anywhere.original_to_result, anywhere.result_to_original})
      if (soup.poses.empty() && bounds.upper > 1.02 * bounds.lower + 2e-6)
        return broken("the bounds of the largest distance are far apart");
  }

  const bool is_over = report.is_reached() || report.is_stopped;
  if (is_over && report.hindrances.total() > 0)
    return broken("the report names what holds back a reduction that has not been held back");
  if (world.options.loop == Collapse_loop::own && report.hindrances[Hindrance::by_loop] > 0)
    return broken("every rule accepts a collapse that the loop has not made");

  // A face of several shares is of the last.
  std::vector<std::size_t> share_of(soup.triangles.size(), 0);
  std::vector<double> ratios{world.options.ratio.value_or(0)};
  const auto add = [&](const std::string& part, double ratio) {
    const std::vector<char> is_named = triangles_named(soup, part);
    for (std::size_t t = 0; t < share_of.size(); ++t)
      if (is_named[t])
        share_of[t] = ratios.size();
    ratios.push_back(ratio);
  };
  for (const Simplify_intent::Part_ratio& part : world.intent.ratios)
    add(part.name, part.ratio);
  for (const std::string& part : world.intent.kept)
    add(part, 1);
  for (Index t = 0; t < run.prepared.fronts.size(); ++t) // a double counts where its front does
    share_of[t] = share_of[run.prepared.fronts[t]];
  // What is locked or frozen, by position. Coincident vertices that are not sewn hold further faces: how
  // many, only the report says. The share of each is open then, and with it the target.
  std::vector<char> is_held(soup.points.size() + world.obstacle.points.size(), false);
  const std::vector<char> is_locked = held(world, soup, true);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (is_locked[t] || run.prepared.is_frozen[t])
      for (const Index v : soup.triangles[t])
        is_held[run.prepared.positions[v]] = true;
  for (const Index v : world.intent.locked_vertices)
    is_held[run.prepared.positions[v]] = true;
  const auto is_fixed = [&](std::size_t t) {
    return std::all_of(soup.triangles[t].begin(), soup.triangles[t].end(),
                       [&](Index v) { return is_held[run.prepared.positions[v]]; });
  };
  const auto fixed_in = [&](std::size_t share) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < share_of.size(); ++t)
      count += share_of[t] == share && is_fixed(t);
    return count;
  };
  std::size_t fixed_in_all = 0;
  for (std::size_t share = 0; share < ratios.size(); ++share)
    fixed_in_all += fixed_in(share);
  if (report.faces_fixed < fixed_in_all || report.faces_fixed > soup.triangles.size())
    return broken("the report counts other faces that are fixed");
  if (report.faces_fixed != fixed_in_all)
    return std::nullopt;
  std::map<std::pair<Index, Index>, std::size_t> faces_at; // by the positions of an edge
  std::size_t most_at_edge = 2;
  for (const Index_triple& t : soup.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& positions = run.prepared.positions;
      const auto edge = std::minmax(positions[t[k]], positions[t[(k + 1) % 3]]);
      most_at_edge = std::max(most_at_edge, ++faces_at[edge]);
    }
  std::size_t target = 0, to_go = 0;
  for (std::size_t share = 0; share < ratios.size(); ++share) {
    const std::size_t before = std::size_t(std::count(share_of.begin(), share_of.end(), share));
    const std::size_t fixed = fixed_in(share);
    std::size_t aim = fixed + std::size_t(std::llround(ratios[share] * double(before - fixed)));
    if (share == 0)
      aim = std::max(world.options.ratio ? aim : 0, world.options.faces.value_or(0));
    if (share < world.options.least_faces.size())
      aim = std::max(aim, world.options.least_faces[share]);
    const std::size_t now =
        std::size_t(std::count_if(run.result.triangles.begin(), run.result.triangles.end(),
                                  [&](Index t) { return share_of[t] == share; }));
    target += aim;
    to_go += now - std::min(now, aim);
    // The last collapse may take all faces of an edge where one was to go, in each place of a shared mesh.
    if (now + most_at_edge * std::max<std::size_t>(1, run.result.shared_places) < std::min(aim, before) + 1)
      return broken("a share has " + std::to_string(now) + " faces left, and was to keep " +
                    std::to_string(aim));
  }
  if (report.faces_target != target || report.faces_to_go != to_go || report.is_reached() != (to_go == 0))
    return broken("the report has another target, or distance to it");
  if ((report.outcome() == "reached") != (to_go == 0))
    return broken("the outcome is \"" + report.outcome() + '"');
  return std::nullopt;
}

} // namespace selvedge::test
