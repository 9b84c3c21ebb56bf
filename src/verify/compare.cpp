// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Cancellation_scope.h>
#include <selvedge/compare.h>

#include "Diagonal.h"
#include "face_samples.h"
#include "for_each_pose.h"
#include "kept_attributes.h"
#include "layer_order.h"
#include "lines.h"
#include "soup/check_soup.h"
#include "soup/obstacle.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

// Compares a result with its original: distances, borders, seams, gaps, kept attributes, normals and the
// order of layers. It measures and gives no verdict; `verify` gives one. The figures are defined in
// compare.h.

namespace selvedge {

using namespace internal;

namespace {

double angle(const Vector_3& a, const Vector_3& b)
{
  constexpr double degrees = 57.29577951308232;
  return degrees * std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
}

/// Measures the angles between the faces of the result and the faces of the original nearest to them, see
/// `Normal_deviation`. No point of either mesh is farther from the other than `largest_distance`.
Normal_deviation normal_deviation(const Triangle_soup& result, const Triangle_soup& original,
                                  double largest_distance)
{
  Normal_deviation deviation;
  if (result.triangles.empty() || original.triangles.empty())
    return deviation;
  const int exponent = common_exponent(result, original);
  const Surface before(original, exponent), after(result, exponent);
  std::vector<Vector_3> directions;
  for (Index face = 0; face < before.triangles.size(); ++face)
    directions.push_back(before.normal(face));
  std::vector<double> areas;
  double area_of_all = 0;
  for (Index face = 0; face < after.triangles.size(); ++face) {
    areas.push_back(std::sqrt(after.normal(face).squared_length()));
    area_of_all += areas.back();
  }
  const double limit = 1.000001 * std::ldexp(largest_distance, -exponent) + 1e-12;

  constexpr double spread_by_area = 50'000;
  Surface_tree tree(before);
  Face_samples samples(after);
  double sum = 0, sum_of_squares = 0, turned = 0;
  Cancellation_poll poll;
  for (Index face = 0; face < after.triangles.size(); ++face) {
    if (!(areas[face] > 0))
      continue;
    const Vector_3 normal = after.normal(face);
    const auto count = 1 + static_cast<std::size_t>(spread_by_area * (areas[face] / area_of_all));
    const double weight = areas[face] / static_cast<double>(count) / area_of_all;
    for (std::size_t k = 0; k < count; ++k) {
      poll();
      const Point_3 point = samples.next(face);
      Index nearest = tree.nearest(point).triangle;
      if (!(directions[nearest] * normal > 0)) {
        if (const auto facing = tree.nearest_facing(point, directions, normal, limit))
          nearest = facing->triangle;
        else
          turned += weight;
      }
      const double degrees = angle(directions[nearest], normal);
      ++deviation.samples;
      sum += weight * degrees;
      sum_of_squares += weight * degrees * degrees;
      deviation.maximum = std::max(deviation.maximum, degrees);
    }
  }
  deviation.mean = sum;
  deviation.root_mean_square = std::sqrt(sum_of_squares);
  deviation.turned = turned;
  return deviation;
}

Bounds relative(const Bounds& bounds, const Diagonal& diagonal)
{
  return {diagonal.share(bounds.lower), diagonal.share(bounds.upper)};
}

Distances_anywhere distances_in_first_pose(const Triangle_soup& result, const Triangle_soup& original)
{
  Distances_anywhere distances;
  tbb::parallel_invoke(Cancellation_scope::inherited(
                           [&] { distances.original_to_result = {maximum_distance(original, result)}; }),
                       Cancellation_scope::inherited(
                           [&] { distances.result_to_original = {maximum_distance(result, original)}; }));
  return distances;
}

// Adds the further poses, and makes all a share of the diagonal.
Bounds_over_poses over_poses(const Bounds_over_poses& in_first, const Triangle_soup& from,
                             const Triangle_soup& to, const Diagonal& diagonal)
{
  Bounds_over_poses all = in_first;
  for (std::size_t pose = 0; pose < from.poses.size(); ++pose) {
    const Bounds bounds =
        maximum_distance(geometry_in_pose(from, {}, pose), geometry_in_pose(to, {}, pose), all);
    all = {bounds, bounds.lower > all.lower ? pose : all.pose};
  }
  return {relative(all, diagonal), all.pose};
}

Distances_anywhere over_poses(const Distances_anywhere& in_first, const Triangle_soup& result,
                              const Triangle_soup& original, const Diagonal& diagonal)
{
  require_same_number_of_poses(result, original);
  Distances_anywhere distances;
  tbb::parallel_invoke(Cancellation_scope::inherited([&] {
                         distances.original_to_result =
                             over_poses(in_first.original_to_result, original, result, diagonal);
                       }),
                       Cancellation_scope::inherited([&] {
                         distances.result_to_original =
                             over_poses(in_first.result_to_original, result, original, diagonal);
                       }));
  return distances;
}

} // namespace

bool is_farther(const Triangle_soup& from, const Triangle_soup& to, double share)
{
  const double length = Diagonal(to).length_of(share);
  return maximum_distance(from, to, {length, length}).lower > length;
}

Distances_anywhere distances_anywhere(const Triangle_soup& result, const Triangle_soup& original)
{
  return over_poses(distances_in_first_pose(result, original), result, original, Diagonal(original));
}

Comparison compare(const Triangle_soup& result, const Triangle_soup& original)
{
  check_arrays(result, "the result");
  check_arrays(original, "the original");
  Comparison comparison;
  const Diagonal diagonal(original);
  comparison.diagonal = diagonal.length();
  const auto make_lines_relative = [&](Line_comparison lines) {
    for (Line_distance* line : {&lines.original_to_result, &lines.result_to_original})
      *line = {{diagonal.share(line->of_ends.root_mean_square), diagonal.share(line->of_ends.maximum)},
               relative(line->maximum, diagonal)};
    return lines;
  };

  Distances_anywhere in_first_pose;
  tbb::parallel_invoke(
      Cancellation_scope::inherited([&] { in_first_pose = distances_in_first_pose(result, original); }),
      Cancellation_scope::inherited([&] {
        const Borders_and_seams before = borders_and_seams(original), after = borders_and_seams(result);
        comparison.borders = make_lines_relative(compare_lines(after.borders, before.borders));
        comparison.seams = make_lines_relative(compare_lines(after.seams, before.seams));
        const Gaps gaps = find_gaps(after, before);
        comparison.gaps = {gaps.open_edges, diagonal.share(gaps.length), diagonal.share(gaps.width)};
      }),
      Cancellation_scope::inherited([&] { compare_values(comparison, result, original); }));

  const double largest = in_first_pose.larger().upper;
  tbb::parallel_invoke(Cancellation_scope::inherited([&] {
                         comparison.distances = over_poses(in_first_pose, result, original, diagonal);
                       }),
                       Cancellation_scope::inherited(
                           [&] { comparison.normals = normal_deviation(result, original, largest); }),
                       Cancellation_scope::inherited([&] {
                         const double reach = std::clamp(2.5 * diagonal.share(largest), 1e-9, 0.25);
                         comparison.layers = layer_order(result, original, diagonal.length_of(reach));
                       }));
  return comparison;
}

} // namespace selvedge
