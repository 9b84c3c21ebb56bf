// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "judge_start.h"

#include "judge_stop.h"
#include "same_bits.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace selvedge::test {
namespace {

/// For every point the first of those with equal coordinates.
std::vector<Index> first_at_position(const std::vector<Point_3>& points)
{
  std::map<Coordinates, Index> first;
  std::vector<Index> result;
  for (Index v = 0; v < points.size(); ++v)
    result.push_back(first.emplace(coordinates(points[v]), v).first->second);
  return result;
}

bool has_three_positions(const Index_triple& triangle, const std::vector<Index>& positions)
{
  const Index a = positions[triangle[0]], b = positions[triangle[1]], c = positions[triangle[2]];
  return a != b && b != c && c != a;
}

Point_3 rounded(const Point_3& p)
{
  // In memory: GCC 12 takes conversions to float and back that stand side by side for none.
  const volatile float x = float(p.x()), y = float(p.y()), z = float(p.z());
  return {x, y, z};
}

// In which of the two objects that may intersect a triangle is: 1, 2, or 0 for neither.
char part_of_triangle(const World& world, const Triangle_soup& input, Index triangle)
{
  return world.may_intersect.empty() ? 0 : char(input.objects.of_triangle[triangle]);
}

} // namespace

Expected_start::Expected_start(const World& world)
{
  const bool is_rounded = world.prepare_options().round_to_float32;
  const Triangle_soup input = input_of(world);
  soup.points = input.points;
  const std::vector<Index> first = first_at_position(soup.points);
  std::vector<Point_3> before = soup.points;
  if (is_rounded)
    for (Point_3& p : soup.points)
      p = rounded(p);
  const std::vector<Index> first_after = first_at_position(soup.points);
  for (Index t = 0; t < input.triangles.size(); ++t)
    if (const Index_triple& triangle = input.triangles[t];
        has_three_positions(triangle, first) && has_three_positions(triangle, first_after)) {
      soup.triangles.push_back(triangle);
      part_of.push_back(part_of_triangle(world, input, t));
    }
  obstacle.points = world.obstacle.points;
  const std::vector<Index> first_of_obstacle = first_at_position(obstacle.points);
  std::copy_if(world.obstacle.triangles.begin(), world.obstacle.triangles.end(),
               std::back_inserter(obstacle.triangles),
               [&](const Index_triple& t) { return has_three_positions(t, first_of_obstacle); });

  // Vertices of different positions that rounding has brought to one.
  std::vector<Point_3> after = soup.points;
  for (auto* points : {&before, &after})
    points->insert(points->end(), obstacle.points.begin(), obstacle.points.end());
  std::vector<char> is_used(after.size(), false);
  for (const Index_triple& t : soup.triangles)
    for (const Index v : t)
      is_used[v] = true;
  for (const Index_triple& t : obstacle.triangles)
    for (const Index v : t)
      is_used[soup.points.size() + v] = true;
  std::map<Coordinates, std::set<Coordinates>> merged;
  for (std::size_t v = 0; v < after.size(); ++v)
    if (is_used[v])
      merged[coordinates(after[v])].insert(coordinates(before[v]));
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    is_merged.push_back(is_used[v] && merged[coordinates(after[v])].size() > 1);
}

World in_pose(const World& world, std::size_t pose)
{
  World posed = world;
  posed.soup = input_of(world);
  posed.dropped_parts = {}; // already are
  posed.dropped.clear();
  if (world.normals == Normals_choice::smooth)
    smooth_normals(posed.soup);
  posed.normals = Normals_choice::keep; // what is joined or smooth is so in all poses
  posed.soup.points = world.soup.poses[pose].points;
  if (!world.obstacle.poses.empty())
    posed.obstacle.points = world.obstacle.poses[pose].points;
  posed.soup.poses.clear();
  posed.obstacle.poses.clear();
  return posed;
}

namespace {

/// Whether no power of two brings the largest coordinate of the soup between 2^-140 and 2^140 without
/// taking a digit below the smallest double, or a coordinate beyond the largest.
bool is_too_far_apart(const Triangle_soup& soup, const Triangle_soup& obstacle)
{
  const auto is_fine = [&](int exponent) {
    double largest = 0;
    for (const auto* part : {&soup, &obstacle})
      for (const Index_triple& t : part->triangles)
        for (const Index v : t)
          for (const double x : coordinates(part->points[v])) {
            const double scaled = std::ldexp(x, exponent);
            if (!std::isfinite(scaled) || std::ldexp(scaled, -exponent) != x)
              return false;
            if (part == &soup)
              largest = std::max(largest, std::abs(scaled));
          }
    return largest == 0 || (largest >= 0x1p-141 && largest < 0x1p140);
  };
  for (int exponent = -2100; exponent <= 2100; ++exponent)
    if (is_fine(exponent))
      return false;
  return true;
}

/// Whether some triangle has two corners at one position in some pose, and no two that are so in all.
bool has_side_of_length_zero_in_some_pose(const World& world)
{
  const auto has_one = [&](const std::vector<Index_triple>& triangles,
                           const std::vector<std::vector<Index>>& positions) { // by pose
    return std::any_of(triangles.begin(), triangles.end(), [&](const Index_triple& triangle) {
      bool is_in_some = false, is_in_all = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto is_zero = [&](const std::vector<Index>& in_pose) {
          return in_pose[triangle[k]] == in_pose[triangle[(k + 1) % 3]];
        };
        is_in_some |= std::any_of(positions.begin(), positions.end(), is_zero);
        is_in_all |= std::all_of(positions.begin(), positions.end(), is_zero);
      }
      return is_in_some && !is_in_all;
    });
  };
  std::vector<std::vector<Index>> of_own, of_obstacle;
  const auto add = [&](const Expected_start& start) {
    of_own.push_back(first_at_position(start.soup.points));
    of_obstacle.push_back(first_at_position(start.obstacle.points));
  };
  add(Expected_start(world));
  for (std::size_t pose = 0; pose < world.soup.poses.size(); ++pose)
    add(Expected_start(in_pose(world, pose)));
  return has_one(input_of(world).triangles, of_own) || has_one(world.obstacle.triangles, of_obstacle);
}

} // namespace

Verdict judge_refusal(const World& world, const std::string& message)
{
  if (has_side_of_length_zero_in_some_pose(world))
    return std::nullopt;
  for (std::size_t pose = 0; pose < world.soup.poses.size(); ++pose)
    if (!judge_refusal(in_pose(world, pose), message))
      return std::nullopt;
  const bool is_rounded = world.prepare_options().round_to_float32;
  if (is_rounded)
    for (const Point_3& p : world.soup.points)
      if (!std::isfinite(rounded(p).x()) || !std::isfinite(rounded(p).y()) || !std::isfinite(rounded(p).z()))
        return std::nullopt;
  if (world.defects == Defects::refuse) {
    const Triangle_soup input = input_of(world);
    const std::vector<Index> first = first_at_position(input.points),
                             first_of_obstacle = first_at_position(world.obstacle.points);
    for (const Index_triple& t : input.triangles)
      if (!has_three_positions(t, first))
        return std::nullopt;
    for (const Index_triple& t : world.obstacle.triangles)
      if (!has_three_positions(t, first_of_obstacle))
        return std::nullopt;
    Judged_complex complex(input, world.obstacle);
    std::vector<char> part_of;
    for (Index t = 0; t < input.triangles.size(); ++t)
      part_of.push_back(part_of_triangle(world, input, t));
    complex.permit(part_of);
    if (!complex.offending_pairs().empty())
      return std::nullopt;
  }
  const Expected_start expected(world);
  if (expected.soup.triangles.empty() || is_too_far_apart(expected.soup, expected.obstacle))
    return std::nullopt;
  return Broken_promise{Promise::refusal, message};
}

Verdict judge_preparation(const World& world, const World_run& run, const Expected_start& expected,
                          Judged_complex& complex)
{
  const auto broken = [](const std::string& what) { return Broken_promise{Promise::preparation, what}; };
  const Prepared_soup& unsnapped = run.unsnapped;
  if (unsnapped.soup.triangles != expected.soup.triangles ||
      unsnapped.obstacle.triangles != expected.obstacle.triangles)
    return broken("the triangles left are not those with three positions");
  for (const auto& [found, wanted] : {std::pair(&unsnapped.soup.points, &expected.soup.points),
                                      std::pair(&unsnapped.obstacle.points, &expected.obstacle.points)})
    if (found->size() != wanted->size() ||
        !std::equal(found->begin(), found->end(), wanted->begin(), has_same_bits))
      return broken("points are not those of the input, rounded where that was asked for");

  const std::size_t own = expected.soup.triangles.size();
  const auto pairs = complex.offending_pairs();
  std::set<std::pair<Index, Index>> found;
  for (const Offending_pair& pair : unsnapped.offending_pairs)
    found.insert({pair.first, pair.second});
  if (found != pairs)
    return broken(std::to_string(found.size()) + " offending pairs found, and there are " +
                  std::to_string(pairs.size()));
  if (world.defects == Defects::refuse && world.prepare_options().round_to_float32 == false && !pairs.empty())
    return Broken_promise{Promise::refusal, "an input that is not embedded was accepted, though strict"};

  std::vector<char> is_frozen(own + expected.obstacle.triangles.size(), false);
  const bool may_descend = world.defects == Defects::descend;
  for (const auto& [f, g] : pairs)
    if (!may_descend)
      is_frozen[f] = is_frozen[g] = true;
  if (may_descend)
    complex.exempt(pairs);
  for (std::size_t t = 0; t < own; ++t)
    for (const Index v : expected.soup.triangles[t])
      is_frozen[t] |= expected.is_merged[v];
  for (Index f = 0; f < is_frozen.size(); ++f)
    if (is_frozen[f] || f >= own) {
      complex.freeze(f);
      for (const Prepared_soup* prepared : {&unsnapped, &run.prepared})
        if (f >= prepared->is_frozen.size() || !prepared->is_frozen[f])
          return Broken_promise{Promise::frozen,
                                "triangle " + std::to_string(f) + " should be frozen, and is not"};
    }
  return std::nullopt;
}

Verdict judge_snaps(const World& world, const World_run& run, Judged_complex& complex, std::size_t& count)
{
  const double distance = run.prepared.snapping.distance;
  if (distance != (world.open_seams == Open_seams::weld ? run.prepared.border_gaps.clear_length.value_or(0)
                                                        : world.weld_distance))
    return Broken_promise{Promise::seams, "the distance of snaps is not the one that was asked for"};
  std::vector<char> is_still(run.prepared.soup.points.size() + world.obstacle.points.size(), false);
  const std::vector<char> is_held = held(world, run.prepared.soup, true);
  for (std::size_t t = 0; t < is_held.size(); ++t)
    for (const Index v : run.prepared.soup.triangles[t])
      is_still[complex.position(v)] |= is_held[t];
  for (const Index v : world.intent.locked_vertices)
    is_still[complex.position(v)] = true;
  for (const Snap& snap : run.prepared.snapping.snaps) {
    if (is_still[complex.position(snap.from)])
      return Broken_promise{Promise::seams, "a vertex snaps that the user keeps or locks"};
    const Index from = complex.position(snap.from), to = complex.position(snap.to);
    const Point_3 &p = complex.point(from), &q = complex.point(to);
    if (!(std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()) <= distance * (1 + 1e-12)))
      return Broken_promise{Promise::seams, "a snap goes further than the distance"};
    ++count;
    if (auto broken = complex.snap(from, to)) {
      broken->message += " in the snap of " + std::to_string(snap.from) + " to " + std::to_string(snap.to);
      return broken;
    }
  }
  const Triangle_soup& soup = run.prepared.soup;
  if (soup.triangles != run.unsnapped.soup.triangles ||
      soup.points.size() != run.unsnapped.soup.points.size())
    return Broken_promise{Promise::seams, "snapping changes more than coordinates"};
  for (Index v = 0; v < soup.points.size(); ++v)
    if (soup.points[v] != complex.point(complex.position(v)))
      return Broken_promise{Promise::seams, "vertex " + std::to_string(v) + " is not where the snaps lead"};
  return std::nullopt;
}

} // namespace selvedge::test
