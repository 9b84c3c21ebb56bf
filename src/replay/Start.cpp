// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Start.h"

#include "Complex.h"

#include "soup/selection.h"
#include "verify/triangles_of_part.h"
#include <selvedge/Error.h>
#include <selvedge/rounding.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace selvedge {
namespace reference {
namespace {

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
    start.parts.push_back(std::move(part_of));
  }
}

// Finds the triangles that have the same three positions as an earlier one.
void find_fronts(Start& start, const Log_header& header, const std::vector<Index>& first_at,
                 const std::vector<char>& is_frozen)
{
  std::map<std::vector<Index>, Index> front_of; // by positions in ascending order, and by parts
  std::vector<Index> times(start.soup.triangles.size(), 1);
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
  start.offences.count_times(std::move(times));
}

} // namespace

Start start_of(const Triangle_soup& original, const Log_header& header, std::optional<std::size_t> pose)
{
  Start start;
  start.soup = original;
  start.soup.poses.clear();
  if (pose) {
    Triangle_soup first = start.soup;
    if (header.is_rounded_to_float32)
      round_to_float32(first);
    start.points_of_first_pose = std::move(first.points);
    start.soup.points = original.poses[*pose].points;
  }
  if (header.are_normals_ignored)
    start.soup.normals = {};
  for (Index t = 0; t < original.triangles.size(); ++t)
    start.numbers.push_back(t);
  leave_out_needless(start);
  const std::vector<Index> before = first_at_position(start.soup.points);
  if (header.is_rounded_to_float32) {
    round_to_float32(start.soup);
    leave_out_needless(start);
  }
  find_parts(start, header);
  const std::vector<Index> first = first_at_position(start.soup.points);
  std::vector<char> is_frozen(start.soup.triangles.size(), false);
  // Where rounding alone has made several positions one, the faces there are frozen.
  std::vector<char> is_merged(first.size(), false);
  for (Index v = 0; v < first.size(); ++v)
    if (before[v] != before[first[v]])
      is_merged[first[v]] = true;
  for (Index t = 0; t < start.soup.triangles.size(); ++t)
    for (const Index v : start.soup.triangles[t])
      is_frozen[t] = is_frozen[t] || is_merged[first[v]];
  const std::vector<Offending_pair> pairs = offending_pairs(start.soup);
  find_fronts(start, header, first, is_frozen);
  for (const Offending_pair& pair : pairs) {
    if (start.is_permitted(pair.first, pair.second))
      continue;
    ++start.offending_pairs;
    if (!header.may_pairs_descend)
      is_frozen[pair.first] = is_frozen[pair.second] = true;
    const Index f = start.fronts[pair.first], g = start.fronts[pair.second];
    if (f == g && pair.first != pair.second)
      continue; // a double offends with its front wherever they go
    if (header.may_pairs_descend && f != g && f == pair.first && g == pair.second)
      start.lineage.add_pair(f, g); // a degenerate face exempts nothing
    start.offences.add(f, g);
  }
  start.is_locked.assign(first.size(), false);
  for (Index t = 0; t < start.soup.triangles.size(); ++t) {
    for (const Index v : start.soup.triangles[t])
      start.is_locked[first[v]] = start.is_locked[first[v]] || is_frozen[t];
  }
  return start;
}

} // namespace reference
} // namespace selvedge
