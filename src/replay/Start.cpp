// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Start.h"

#include "Complex.h"

#include "soup/obstacle.h"
#include "soup/selection.h"
#include "verify/triangles_of_part.h"
#include <selvedge/Error.h>
#include <selvedge/attributes.h>
#include <selvedge/drop_parts.h>
#include <selvedge/normals.h>
#include <selvedge/rounding.h>
#include <selvedge/suited_normals.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace selvedge {
namespace reference {
namespace {

// Returns the numbers of the triangles that are left.
std::vector<Index> drop_from(Triangle_soup& soup, const Parts_to_drop& parts)
{
  try {
    return drop_parts(soup, parts).triangles;
  } catch (const Argument_error& error) {
    throw Input_error(std::string("the log leaves out a part that is not there: ") + error.what());
  }
}

void treat_normals(Triangle_soup& soup, Logged_normals normals)
{
  for (const Normals_choice choice :
       {Normals_choice::drop, Normals_choice::smooth, Normals_choice::soft, Normals_choice::loose})
    if (normals == shared_normals(choice))
      share_vertices_without_normals(soup, choice);
  switch (normals) {
  case Logged_normals::kept:
    return;
  case Logged_normals::joined:
    return join_near_normals(soup);
  case Logged_normals::hard:
    return join_normals_between_hard_edges(soup);
  case Logged_normals::smooth:
  case Logged_normals::smooth_shared:
    return smooth_normals(soup);
  case Logged_normals::soft:
  case Logged_normals::soft_shared:
    return loosen_soft_lines(soup);
  default:
    soup.normals = {};
  }
}

void leave_out_needless(Start& start)
{
  const std::vector<Index> first = first_at_position(start.soup.points);
  std::vector<Index> kept, numbers;
  for (Index t = 0; t < start.soup.triangles.size(); ++t) {
    const auto& [a, b, c] = start.soup.triangles[t];
    if (first[a] == first[b] || first[b] == first[c] || first[c] == first[a])
      continue;
    kept.push_back(t);
    numbers.push_back(start.numbers[t]);
  }
  keep_triangles(start.soup, kept);
  start.numbers = std::move(numbers);
}

// Finds the triangles of parts that may intersect. No position has faces of both.
void find_parts(Start& start, const Log_header& header)
{
  const std::vector<Index> first = first_at_position(start.soup.points);
  for (const auto& [a, b] : header.may_intersect) {
    std::vector<char> part_of(start.soup.triangles.size(), 0);
    for (const auto& [name, number] : {std::make_pair(&a, char(1)), std::make_pair(&b, char(2))}) {
      const std::vector<char> is_of_part = internal::triangles_of_part(start.soup, *name);
      bool is_there = false;
      for (Index t = 0; t < part_of.size(); ++t)
        if (is_of_part[t]) {
          part_of[t] = char(part_of[t] | number);
          is_there = true;
        }
      if (!is_there)
        throw Input_error("the log lets the part '" + *name +
                          "' intersect another, but the mesh has no such part");
    }
    std::vector<char> parts_at(first.size(), 0);
    for (Index t = 0; t < part_of.size(); ++t)
      for (const Index v : start.soup.triangles[t])
        if ((parts_at[first[v]] = char(parts_at[first[v]] | part_of[t])) == 3)
          throw Input_error("the log lets the parts '" + a + "' and '" + b +
                            "' intersect, but they share the vertex " + std::to_string(v + 1) +
                            "; only parts that are not joined may intersect");
    part_of.resize(start.numbers.size(), 0); // an obstacle belongs to no part
    start.parts.push_back(std::move(part_of));
  }
}

// Finds the triangles that have the same three positions as an earlier one.
void find_fronts(Start& start, const Log_header& header, const std::vector<Index>& first_at,
                 const std::vector<char>& is_frozen)
{
  std::map<std::vector<Index>, Index> front_of; // by positions in ascending order, and by parts
  std::vector<Index> times(start.numbers.size(), 1);
  for (Index t = 0; t < start.soup.triangles.size(); ++t) {
    start.fronts.push_back(t);
    const auto& [a, b, c] = start.soup.triangles[t];
    if (!header.may_pairs_descend || is_frozen[t] ||
        CGAL::collinear(start.soup.points[a], start.soup.points[b], start.soup.points[c]))
      continue;
    std::vector<Index> key{first_at[a], first_at[b], first_at[c]};
    std::sort(key.begin(), key.end());
    for (const std::vector<char>& part_of : start.parts)
      key.push_back(Index(part_of[t]));
    start.fronts[t] = front_of.emplace(std::move(key), t).first->second;
    times[start.fronts[t]] += start.fronts[t] != t;
  }
  for (Index t = Index(start.fronts.size()); t < start.numbers.size(); ++t)
    start.fronts.push_back(t);
  start.offences.count_times(std::move(times));
}

// Leaves out the triangles of an obstacle that have two corners at one position, and puts the others beside
// the soup.
void add_obstacle(Start& start, Triangle_soup& obstacle, const std::vector<Index>& first_at,
                  Index first_number)
{
  const Index own_vertices = Index(start.soup.points.size());
  std::vector<Index_triple> kept;
  for (Index t = 0; t < obstacle.triangles.size(); ++t) {
    std::array<Place, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = obstacle.triangles[t][k];
      const Point_3& point = obstacle.points[v];
      corners[k] = {first_at[own_vertices + v], {point.x(), point.y(), point.z()}};
    }
    if (corners[0].id == corners[1].id || corners[1].id == corners[2].id || corners[2].id == corners[0].id)
      continue;
    kept.push_back(obstacle.triangles[t]);
    start.obstacle.push_back(corners);
    start.numbers.push_back(first_number + t);
  }
  obstacle.triangles = std::move(kept);
}

std::vector<Index> first_at_position_of_both(std::vector<Point_3> points, const std::vector<Point_3>& beside)
{
  points.insert(points.end(), beside.begin(), beside.end());
  return first_at_position(points);
}

// Returns which triangles are frozen because rounding alone has made several positions one.
std::vector<char> are_at_merged_positions(const Start& start, const std::vector<Index>& first,
                                          const std::vector<Index>& before)
{
  std::vector<char> is_merged(first.size(), false), result(start.numbers.size(), false);
  for (Index v = 0; v < first.size(); ++v)
    if (before[v] != before[first[v]])
      is_merged[first[v]] = true;
  for (Index t = 0; t < start.soup.triangles.size(); ++t)
    for (const Index v : start.soup.triangles[t])
      result[t] = result[t] || is_merged[first[v]];
  return result;
}

// Counts the pairs that are not permitted, which descend, or freeze their triangles.
void add_pairs(Start& start, const std::vector<Offending_pair>& pairs, bool may_descend,
               std::vector<char>& is_frozen)
{
  for (const Offending_pair& pair : pairs) {
    if (start.is_permitted(pair.first, pair.second))
      continue;
    ++start.offending_pairs;
    if (pair.first >= start.soup.triangles.size())
      continue; // the obstacle stays as it is
    if (!may_descend)
      is_frozen[pair.first] = is_frozen[pair.second] = true;
    const Index f = start.fronts[pair.first], g = start.fronts[pair.second];
    if (f == g && pair.first != pair.second)
      continue; // a double offends with its front wherever they go
    if (may_descend && f != g && f == pair.first && g == pair.second)
      start.lineage.add_pair(f, g); // a degenerate face exempts nothing
    start.offences.add(f, g);
  }
}

} // namespace

Start start_of(const Triangle_soup& original, const Triangle_soup& obstacle, const Log_header& header,
               std::optional<std::size_t> pose)
{
  Start start;
  start.soup = original;
  start.numbers = drop_from(start.soup, header.dropped_parts);
  drop_attributes(start.soup, header.dropped);
  treat_normals(start.soup, header.normals);
  start.soup.poses.clear();
  Triangle_soup beside;
  beside.points = pose ? points_in_pose(obstacle, *pose) : obstacle.points;
  beside.triangles = obstacle.triangles;
  if (pose) {
    Triangle_soup first = start.soup;
    if (header.is_rounded_to_float32)
      round_to_float32(first);
    start.points_of_first_pose = std::move(first.points);
    start.soup.points = original.poses[*pose].points;
  }
  leave_out_needless(start);
  const std::vector<Index> before = first_at_position_of_both(start.soup.points, beside.points);
  if (header.is_rounded_to_float32) {
    round_to_float32(start.soup);
    leave_out_needless(start);
  }
  const std::vector<Index> first = first_at_position_of_both(start.soup.points, beside.points);
  add_obstacle(start, beside, first, Index(original.triangles.size()));
  find_parts(start, header);
  std::vector<char> is_frozen = are_at_merged_positions(start, first, before);
  const std::vector<Offending_pair> pairs = offending_pairs(geometry_with_obstacle(start.soup, beside));
  find_fronts(start, header, first, is_frozen);
  add_pairs(start, pairs, header.may_pairs_descend, is_frozen);
  start.is_locked.assign(first.size(), false);
  for (Index t = 0; t < start.soup.triangles.size(); ++t)
    for (const Index v : start.soup.triangles[t])
      start.is_locked[first[v]] = start.is_locked[first[v]] || is_frozen[t];
  for (const std::array<Place, 3>& triangle : start.obstacle)
    for (const Place& corner : triangle)
      start.is_locked[corner.id] = true;
  return start;
}

} // namespace reference
} // namespace selvedge
