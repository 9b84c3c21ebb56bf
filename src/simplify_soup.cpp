// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/simplify_soup.h>

#include <selvedge/Error.h>
#include <selvedge/mesh/Working_mesh.h>
#include <selvedge/mesh/selection.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

namespace selvedge {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool has_two_corners_at_one_position(const Index_triple& triangle, const std::vector<Index>& positions)
{
  const Index a = positions[triangle[0]], b = positions[triangle[1]], c = positions[triangle[2]];
  return a == b || b == c || c == a;
}

std::string describe(const Offending_pair& pair)
{
  if (pair.offence == Offence::degenerate)
    return "triangle " + std::to_string(pair.first + 1) + " is degenerate";
  return "triangles " + std::to_string(pair.first + 1) + " and " + std::to_string(pair.second + 1) +
         (pair.offence == Offence::duplicate ? " have the same three corners" : " intersect");
}

void refuse_unless_embedded(const Triangle_soup& soup)
{
  const std::vector<Offending_pair> pairs = offending_pairs(soup);
  if (!pairs.empty())
    throw Input_error("the mesh is not embedded: " + std::to_string(pairs.size()) + " offending pairs of triangles, the first: " +
                      describe(pairs.front()) + "; repair it, or do without strict to have them left as they are");
}

} // namespace

Prepared_soup prepare(Triangle_soup input, const Prepare_options& options)
{
  if (input.triangles.empty())
    throw Input_error("the mesh has no triangles");
  if (options.is_strict)
    refuse_unless_embedded(input);

  Prepared_soup prepared;
  prepared.soup = std::move(input);
  Triangle_soup& soup = prepared.soup;

  Clock::time_point start = Clock::now();
  prepared.positions = number_positions(soup.points);
  const auto leave_out = [&](const std::vector<Index>& positions) {
    std::vector<Index> kept;
    for (Index t = 0; t < soup.triangles.size(); ++t)
      if (!has_two_corners_at_one_position(soup.triangles[t], positions))
        kept.push_back(t);
    const std::size_t left_out = soup.triangles.size() - kept.size();
    if (left_out > 0)
      keep_triangles(soup, kept);
    return left_out;
  };
  prepared.left_out_faces = leave_out(prepared.positions);

  // The defects that the input had before it was rounded, and where its vertices then fall together.
  std::vector<Offending_pair> pairs_before;
  std::vector<Index> positions_after;
  if (options.round_to_float32) {
    Triangle_soup unrounded;
    unrounded.points = soup.points;
    prepared.rounding = round_to_float32(soup);
    if (prepared.rounding.coordinates > 0) {
      positions_after = number_positions(soup.points);
      prepared.left_out_by_rounding = leave_out(positions_after);
      unrounded.triangles = soup.triangles;
      prepared.seconds_weld = seconds_since(start);
      start = Clock::now();
      pairs_before = offending_pairs(unrounded);
      prepared.seconds_check = seconds_since(start);
      start = Clock::now();
    }
  }
  prepared.seconds_weld += seconds_since(start);
  if (soup.triangles.empty())
    throw Input_error("every triangle of the mesh has two corners at one position; there is nothing to reduce");

  start = Clock::now();
  prepared.offending_pairs = offending_pairs(soup);
  prepared.is_frozen.assign(soup.triangles.size(), false);
  for (const Offending_pair& pair : prepared.offending_pairs) {
    prepared.is_frozen[pair.first] = prepared.is_frozen[pair.second] = true;
    if (prepared.rounding.coordinates > 0)
      prepared.pairs_by_rounding +=
        !std::binary_search(pairs_before.begin(), pairs_before.end(), pair, [](const auto& a, const auto& b) {
          return std::make_pair(a.first, a.second) < std::make_pair(b.first, b.second);
        });
  }
  if (!positions_after.empty()) {
    std::vector<char> is_merged(soup.points.size(), false);
    for (Index v = 0; v < positions_after.size(); ++v)
      if (prepared.positions[v] != prepared.positions[positions_after[v]])
        is_merged[v] = is_merged[positions_after[v]] = true;
    for (Index t = 0; t < soup.triangles.size(); ++t)
      for (const Index v : soup.triangles[t])
        prepared.is_frozen[t] |= is_merged[v];
  }
  prepared.frozen_faces = std::count(prepared.is_frozen.begin(), prepared.is_frozen.end(), true);
  prepared.seconds_check += seconds_since(start);

  start = Clock::now();
  prepared.snapping = snap_borders(soup, prepared.positions, prepared.is_frozen, options.weld_distance);
  prepared.seconds_snap = seconds_since(start);
  return prepared;
}

Simplified_soup simplify_soup(const Prepared_soup& prepared, const Simplify_options& options)
{
  Simplified_soup result;
  Clock::time_point start = Clock::now();
  Working_mesh working(prepared.soup, prepared.positions, prepared.is_frozen);
  result.welding = working.notes();
  result.seconds_weld = seconds_since(start);

  result.report = simplify(working.mesh(), options, working.constraints(), working);

  start = Clock::now();
  Working_mesh::Result left = working.result();
  result.soup = std::move(left.soup);
  result.triangles = std::move(left.triangles);
  result.corners = std::move(left.corners);
  result.seconds_weld += seconds_since(start);
  return result;
}

} // namespace selvedge
