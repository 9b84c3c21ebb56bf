// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/verify.h>

#include "clearance.h"
#include "for_each_pose.h"
#include "rounded.h"
#include "soup/check_soup.h"
#include "soup/obstacle.h"
#include "triangles_of_part.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

// The judge, which decides whether a result may be written. It puts together what `offending_pairs`,
// `pieces`, `match_pieces` and `distances` say of a result and its original, and knows nothing of the
// reduction.

namespace selvedge {
namespace {

using Permitted = Verification::Permitted;

std::vector<Permitted> begin_permitted(const Verify_options& options)
{
  std::vector<Permitted> permitted;
  for (const auto& [a, b] : options.may_intersect)
    permitted.push_back({a, b});
  return permitted;
}

void check_options(const Verify_options& options)
{
  if (!(options.weld_distance >= 0))
    throw Argument_error("the length within which borders may have been joined is a number of at least 0");
  if (options.clearance && !(*options.clearance > 0 && std::isfinite(*options.clearance)))
    throw Argument_error("clearance: a distance is positive and finite");
  if (options.clearance && !options.may_intersect.empty())
    throw Argument_error("parts that may intersect have no clearance; leave out one of the two options");
}

void require_triangles(const std::vector<Index>& of_original, const Triangle_soup& result,
                       const Triangle_soup& original)
{
  if (of_original.empty())
    return;
  if (of_original.size() != result.triangles.size())
    throw Argument_error("the result has " + std::to_string(result.triangles.size()) +
                         " triangles, and triangles_of_original names " + std::to_string(of_original.size()));
  for (std::size_t t = 0; t < of_original.size(); ++t)
    if (of_original[t] >= original.triangles.size())
      throw Argument_error("triangle " + std::to_string(t) +
                           " (counted from 0) of the result is said to be number " +
                           std::to_string(of_original[t]) + " of the " +
                           std::to_string(original.triangles.size()) + " of the original");
}

void require_same_places(const std::vector<Index_triple>& in_file, const Triangle_soup& result)
{
  if (in_file.empty())
    return;
  if (in_file.size() != result.triangles.size())
    throw Argument_error("the result has " + std::to_string(result.triangles.size()) +
                         " triangles, and triangles_in_file has " + std::to_string(in_file.size()));
  for (std::size_t t = 0; t < in_file.size(); ++t)
    for (int place = 0; place < 3; ++place)
      if (const Index v = in_file[t][place];
          v >= result.points.size() || result.points[v] != result.points[result.triangles[t][place]])
        throw Argument_error("triangle " + std::to_string(t) +
                             " (counted from 0) of the result has other corners in triangles_in_file");
}

// Takes out what may intersect by the names of the original.
void permit_of_original(const Triangle_soup& original, std::vector<Offending_pair>& pairs,
                        std::vector<Permitted>& permitted)
{
  for (Permitted& parts : permitted)
    parts.pairs_of_original =
        take_out_pairs_between(internal::triangles_of_part(original, parts.first),
                               internal::triangles_of_part(original, parts.second), pairs);
}

// Takes out what may intersect by the names of the result and, where it is known what its triangles were, of
// the original.
void permit_of_result(const Triangle_soup& result, const Triangle_soup* original,
                      const Verify_options& options, std::vector<Offending_pair>& pairs,
                      std::vector<Permitted>& permitted)
{
  const auto triangles_of = [&](const std::string& name) {
    std::vector<char> is_of_part = internal::triangles_of_part(result, name);
    if (original && !options.triangles_of_original.empty()) {
      const std::vector<char> was_of_part = internal::triangles_of_part(*original, name);
      for (std::size_t t = 0; t < is_of_part.size(); ++t)
        is_of_part[t] = is_of_part[t] && was_of_part[options.triangles_of_original[t]];
    }
    return is_of_part;
  };
  for (Permitted& parts : permitted)
    parts.pairs = take_out_pairs_between(triangles_of(parts.first), triangles_of(parts.second), pairs);
}

// Calls a function with the geometry of a mesh and an obstacle, or with the mesh itself, not with a copy of
// it, where there is no obstacle.
template <class Function>
auto call_beside(const Triangle_soup& obstacle, const Triangle_soup& mesh, const Function& function)
{
  return obstacle.triangles.empty() ? function(mesh) : function(geometry_with_obstacle(mesh, obstacle));
}

// Leaves out the pairs of an obstacle alone, whose triangles come after those of the mesh.
void leave_out_pairs_of_obstacle(const Triangle_soup& mesh, std::vector<Offending_pair>& pairs)
{
  const auto is_of_obstacle = [&](const Offending_pair& pair) {
    return (std::min)(pair.first, pair.second) >= mesh.triangles.size();
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_of_obstacle), pairs.end());
}

// Judges the clearance in every pose, between pieces as they are matched.
void judge_clearances(const Triangle_soup& result, const Triangle_soup& original,
                      const Verify_options& options, const Triangle_soup& obstacle,
                      Verification& verification)
{
  const internal::Numbered_pieces of_result = internal::numbered_pieces(result),
                                  of_original = internal::numbered_pieces(original);
  const auto judge_clearance_of = [&](const Triangle_soup& after, const Triangle_soup& before) {
    return internal::judge_clearance(*options.clearance, after, before,
                                     internal::matched_pieces(after, before, of_result, of_original,
                                                              verification.matching,
                                                              options.triangles_of_original));
  };
  verification.clearance = judge_clearance_of(geometry_with_obstacle(result, obstacle),
                                              geometry_with_obstacle(original, obstacle));
  internal::for_each_pose(result.poses.size(), [&](std::size_t pose) {
    verification.poses[pose].clearance = judge_clearance_of(geometry_in_pose(result, obstacle, pose),
                                                            geometry_in_pose(original, obstacle, pose));
  });
}

} // namespace

bool are_between(const std::vector<char>& first, const std::vector<char>& second, Index a, Index b)
{
  const auto is_in = [](const std::vector<char>& part, const std::vector<char>& other, Index triangle) {
    return triangle < part.size() && part[triangle] != 0 && other[triangle] == 0;
  };
  return (is_in(first, second, a) && is_in(second, first, b)) ||
         (is_in(first, second, b) && is_in(second, first, a));
}

std::size_t take_out_pairs_between(const std::vector<char>& first, const std::vector<char>& second,
                                   std::vector<Offending_pair>& pairs)
{
  const auto kept = std::remove_if(pairs.begin(), pairs.end(), [&](const Offending_pair& pair) {
    return are_between(first, second, pair.first, pair.second);
  });
  const std::size_t count = std::size_t(pairs.end() - kept);
  pairs.erase(kept, pairs.end());
  return count;
}

Verification verify(const Triangle_soup& mesh, const Verify_options& options, const Triangle_soup& obstacle)
{
  check_arrays(mesh, "the mesh");
  check_geometry(obstacle, "the obstacle");
  check_options(options);
  require_fitting_poses(obstacle, mesh);
  internal::Numbered_pieces numbered;
  if (options.clearance)
    numbered = internal::numbered_pieces(mesh);
  Verification verification;
  const auto judge = [&](const Triangle_soup& geometry, std::vector<Permitted>& permitted,
                         std::vector<Offending_pair>& pairs, std::optional<Clearance_verdict>& clearance) {
    permitted = begin_permitted(options);
    pairs = offending_pairs(geometry);
    leave_out_pairs_of_obstacle(mesh, pairs);
    permit_of_result(mesh, nullptr, options, pairs, permitted);
    if (options.clearance)
      clearance = internal::judge_clearance(*options.clearance, geometry,
                                            internal::pieces_by_position(geometry, numbered));
  };
  verification.poses.resize(mesh.poses.size());
  tbb::parallel_invoke(
      Cancellation_scope::inherited([&] {
        call_beside(obstacle, mesh, [&](const Triangle_soup& geometry) {
          judge(geometry, verification.permitted, verification.pairs, verification.clearance);
        });
        verification.new_pairs = verification.pairs;
        internal::for_each_pose(mesh.poses.size(), [&](std::size_t pose) {
          Verification::In_pose& in_pose = verification.poses[pose];
          in_pose.name = mesh.poses[pose].name;
          std::vector<Permitted> permitted;
          judge(geometry_in_pose(mesh, obstacle, pose), permitted, in_pose.pairs, in_pose.clearance);
          in_pose.new_pairs = in_pose.pairs;
        });
      }),
      Cancellation_scope::inherited([&] {
        if (!options.clearance)
          numbered = internal::numbered_pieces(mesh);
      }));
  verification.pieces = std::move(numbered.pieces);
  return verification;
}

Verification verify(const Triangle_soup& result, const Triangle_soup& original, const Verify_options& options,
                    const Triangle_soup& obstacle)
{
  check_arrays(result, "the result");
  check_arrays(original, "the original");
  const bool is_rounded = options.may_be_rounded && internal::is_only_first_rounded(result, original);
  const Triangle_soup rounded = is_rounded ? internal::rounded(original) : Triangle_soup();
  const Triangle_soup& before = is_rounded ? rounded : original;
  Verification verification =
      verify(result, before, call_beside(obstacle, before, offending_pairs), options, obstacle);
  verification.is_original_rounded = is_rounded;
  leave_out_pairs_of_obstacle(result, verification.pairs);
  for (Verification::In_pose& in_pose : verification.poses)
    leave_out_pairs_of_obstacle(result, in_pose.pairs);
  return verification;
}

Verification verify(const Triangle_soup& result, const Triangle_soup& original,
                    const std::vector<Offending_pair>& all_pairs_of_original, const Verify_options& options,
                    const Triangle_soup& obstacle)
{
  check_arrays(result, "the result");
  check_arrays(original, "the original");
  check_geometry(obstacle, "the obstacle");
  check_options(options);
  require_triangles(options.triangles_of_original, result, original);
  require_same_places(options.triangles_in_file, result);
  require_fitting_poses(obstacle, result);
  Verification verification;
  verification.permitted = begin_permitted(options);
  std::vector<Offending_pair> pairs_of_original = all_pairs_of_original;
  permit_of_original(original, pairs_of_original, verification.permitted);
  verification.pairs_of_original = pairs_of_original.size();
  const auto find_pairs = [&](const Triangle_soup& after, const Triangle_soup& before,
                              const std::vector<Offending_pair>& known, std::vector<Permitted>& permitted,
                              std::vector<Offending_pair>& pairs, std::vector<Offending_pair>& of_result) {
    pairs = offending_pairs(after);
    permit_of_result(result, &original, options, pairs, permitted);
    if (!options.collapses) {
      of_result = new_pairs(after, pairs, before, known);
      return;
    }
    std::vector<Index> triangles = options.triangles_of_original;
    for (std::size_t t = original.triangles.size(); t < before.triangles.size(); ++t)
      triangles.push_back(Index(t)); // of the obstacle
    of_result = pairs_without_descent(after, pairs, before, known, *options.collapses, triangles);
  };
  internal::require_same_number_of_poses(result, original);
  verification.poses.resize(result.poses.size());
  const auto judge_pose = [&](std::size_t pose) {
    const Triangle_soup before = geometry_in_pose(original, obstacle, pose);
    std::vector<Offending_pair> known = options.pairs_in_poses_of_original
                                            ? (*options.pairs_in_poses_of_original)[pose]
                                            : offending_pairs(before);
    std::vector<Permitted> permitted = begin_permitted(options);
    permit_of_original(original, known, permitted);
    Verification::In_pose& in_pose = verification.poses[pose];
    in_pose.name = result.poses[pose].name;
    in_pose.pairs_of_original = known.size();
    find_pairs(geometry_in_pose(result, obstacle, pose), before, known, permitted, in_pose.pairs,
               in_pose.new_pairs);
  };
  tbb::parallel_invoke(
      Cancellation_scope::inherited([&] {
        const auto find_in_first = [&](const Triangle_soup& after, const Triangle_soup& before) {
          find_pairs(after, before, pairs_of_original, verification.permitted, verification.pairs,
                     verification.new_pairs);
        };
        if (obstacle.triangles.empty())
          find_in_first(result, original);
        else
          find_in_first(geometry_with_obstacle(result, obstacle), geometry_with_obstacle(original, obstacle));
        internal::for_each_pose(result.poses.size(), judge_pose);
      }),
      Cancellation_scope::inherited(
          [&] { verification.matching = match_pieces(result, original, options); }));
  if (options.clearance)
    judge_clearances(result, original, options, obstacle, verification);
  verification.pieces = verification.matching.pieces_of_result;
  verification.topology_differences =
      topology_differences(verification.pieces, verification.matching.pieces_of_original);
  verification.distances = distances(result, original);
  return verification;
}

} // namespace selvedge
