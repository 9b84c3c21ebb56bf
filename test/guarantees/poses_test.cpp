// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A mesh in several poses: what is guaranteed of its own pose holds in each.

#include "support/Edge_ratio_stop.h"
#include "support/logged_reduction.h"
#include "support/mesh_of.h"
#include "support/meshes.h"
#include "support/reduction.h"
#include "support/soups.h"

#include <selvedge/Error.h>
#include <selvedge/Surface_mesh_simplification/Border_filter.h>
#include <selvedge/Surface_mesh_simplification/Halfedge_placement.h>
#include <selvedge/Surface_mesh_simplification/Pose_intersection_filter.h>
#include <selvedge/Surface_mesh_simplification/Visitor_chain.h>
#include <selvedge/generate.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

Triangle_soup in_pose(const Triangle_soup& soup, std::size_t pose)
{
  Triangle_soup result = soup;
  result.points = soup.poses[pose].points;
  result.poses.clear();
  return result;
}

void add_pose(Triangle_soup& soup, const std::string& name, const std::function<Point_3(const Point_3&)>& map)
{
  Pose pose{name, {}};
  for (const Point_3& point : soup.points)
    pose.points.push_back(map(point));
  soup.poses.push_back(std::move(pose));
}

Point_3 twisted(const Point_3& p, double turns)
{
  const double angle = turns * p.z();
  return {p.x() * std::cos(angle) - p.y() * std::sin(angle),
          p.x() * std::sin(angle) + p.y() * std::cos(angle), p.z()};
}

Point_3 bent(const Point_3& p, double curvature)
{
  const double angle = curvature * p.z(), radius = 1 / curvature + p.x();
  return {radius * std::cos(angle) - 1 / curvature, p.y(), radius * std::sin(angle)};
}

/// A garment of several layers that moves as one: maps of space keep the layers apart.
Triangle_soup moving_garment(std::size_t faces)
{
  Generate_options options;
  options.faces = faces;
  options.thickness = 0;
  Triangle_soup soup = generate("skirt", options);
  add_pose(soup, "twisted", [](const Point_3& p) { return twisted(p, 3); });
  add_pose(soup, "bent", [](const Point_3& p) { return bent(p, 1.5); });
  return soup;
}

std::size_t pairs_in_poses(const Triangle_soup& soup)
{
  std::size_t pairs = 0;
  for (std::size_t pose = 0; pose < soup.poses.size(); ++pose)
    pairs += offending_pairs(in_pose(soup, pose)).size();
  return pairs;
}

/// The poses of a result of which only the first was guarded.
Triangle_soup carried_along(const Simplified_soup& result, const Triangle_soup& original)
{
  Triangle_soup soup = result.soup;
  for (const Pose& pose : original.poses) {
    Pose& left = soup.poses.emplace_back(Pose{pose.name, std::vector<Point_3>(soup.points.size())});
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index corner = result.corners[t][k];
        left.points[soup.triangles[t][k]] = pose.points[original.triangles[corner / 3][corner % 3]];
      }
  }
  return soup;
}

TEST(Poses, EachIsGuarded)
{
  const Triangle_soup soup = moving_garment(4000);
  ASSERT_EQ(pairs_in_poses(soup), 0u);
  Triangle_soup first_alone = soup;
  first_alone.poses.clear();
  const Simplify_options options = without_limits(to_ratio(0.1));
  EXPECT_GT(pairs_in_poses(carried_along(reduce(first_alone, options).simplified, soup)), 0u)
      << "the control";

  const Reduction guarded = reduce(soup, options);
  EXPECT_TRUE(guarded.verification.accepted());
  EXPECT_TRUE(guarded.verification.embedded());
  ASSERT_EQ(guarded.verification.poses.size(), 2u);
  EXPECT_EQ(guarded.verification.poses[1].name, "bent");
  EXPECT_TRUE(guarded.simplified.report.is_reached());
  EXPECT_EQ(pairs_in_poses(guarded.simplified.soup), 0u);
  const Triangle_soup due = carried_along(guarded.simplified, soup);
  for (std::size_t pose = 0; pose < 2; ++pose)
    EXPECT_EQ(guarded.simplified.soup.poses[pose].points, due.poses[pose].points) << "bits of the input";

  Simplify_options other = options;
  other.index = Face_index::clusters;
  EXPECT_EQ(reduce(soup, other).simplified.corners, guarded.simplified.corners);
  other.loop = Collapse_loop::cgal;
  EXPECT_TRUE(reduce(soup, other).verification.embedded());
}

TEST(Poses, ReplayJudgesEach)
{
  const Triangle_soup soup = moving_garment(3000);
  const Logged_reduction guarded = reduce_and_log(soup, to_ratio(0.2));
  EXPECT_TRUE(replay_text(soup, guarded.log).is_accepted());
  EXPECT_EQ(not_judged(replay_text(soup, guarded.log)).front().key, "poses");
  Replay_options options;
  for (std::size_t pose = 0; pose < 2; ++pose) {
    options.pose = pose;
    const Replay_verdict verdict = replay_text(soup, guarded.log, options);
    EXPECT_TRUE(verdict.is_accepted()) << (verdict.violations.empty() ? "" : verdict.violations[0].message);
  }
  options.pose = 2;
  EXPECT_THROW(replay_text(soup, guarded.log, options), Argument_error);

  // Steps that were guarded in the first pose alone.
  Triangle_soup first_alone = soup;
  first_alone.poses.clear();
  std::string log = reduce_and_log(first_alone, without_limits(to_ratio(0.1))).log;
  options.pose = 0;
  EXPECT_THROW(replay_text(soup, log, options), Input_error) << "it says nothing of poses";
  log.insert(log.find("limit"), "pose twisted -\n");
  EXPECT_FALSE(replay_text(soup, log, options).is_accepted());
  log.replace(log.find("twisted -"), 9, "twisted " + digest_of(soup.poses[1].points));
  EXPECT_THROW(replay_text(soup, log, options), Input_error) << "another pose";
}

TEST(Poses, CostIsTheMeanAndLimitsHoldInTheWorst)
{
  Triangle_soup soup = sheet(40, 40);
  add_pose(soup, "folded", [](const Point_3& p) { return Point_3(p.x(), p.y(), std::abs(p.x() - 13)); });
  Triangle_soup flat = soup;
  flat.poses.clear();
  const auto error_in_fold = [&](const Triangle_soup& result) {
    return distances(in_pose(result, 0), in_pose(soup, 0)).original_to_result.root_mean_square;
  };
  const Reduction guarded = reduce(soup, to_ratio(0.1));
  const double with_mean = error_in_fold(guarded.simplified.soup);
  const double without = error_in_fold(carried_along(reduce(flat, to_ratio(0.1)).simplified, soup));
  EXPECT_LT(with_mean, 0.5 * without);

  Triangle_soup bowl = flat;
  add_pose(bowl, "bowl", [](const Point_3& p) {
    return Point_3(p.x(), p.y(), 0.02 * ((p.x() - 20) * (p.x() - 20) + (p.y() - 20) * (p.y() - 20)));
  });
  Simplify_options options = to_ratio(0.01);
  options.max_error = 1e-3;
  const Simplified_soup bounded = reduce(bowl, options).simplified;
  EXPECT_FALSE(bounded.report.is_reached());
  EXPECT_GT(bounded.report.hindrances.total(), 0u);
  EXPECT_LE(distances(in_pose(bounded.soup, 0), in_pose(bowl, 0)).original_to_result.maximum,
            1.001e-3 * distances(flat, flat).diagonal);
  EXPECT_TRUE(reduce(flat, options).simplified.report.is_reached()) << "the control";
}

TEST(Poses, WhatTouchesInSomeStaysApart)
{
  // Two sheets side by side, which have one border in common in the second pose only.
  const Triangle_soup left = sheet(6, 6), right = moved(left, 7, 0, 0);
  Triangle_soup soup = joined(left, right);
  add_pose(soup, "closed",
           [](const Point_3& p) { return Point_3(p.x() < 6.5 ? p.x() : p.x() - 1, p.y(), p.z()); });
  const Reduction reduction = reduce(soup, without_limits(to_ratio(0)));
  EXPECT_EQ(std::count(reduction.prepared.is_held.begin(), reduction.prepared.is_held.end(), char(true)), 14);
  EXPECT_NE(reduction.prepared.first_held.find("'closed'"), std::string::npos);
  EXPECT_TRUE(reduction.verification.embedded());
  std::size_t held = 0;
  for (const Point_3& point : reduction.simplified.soup.points)
    held += point.x() == 6 || point.x() == 7;
  EXPECT_EQ(held, 14u);
  std::swap(soup.points, soup.poses[0].points);
  const Reduction closed = reduce(soup, without_limits(to_ratio(0)));
  EXPECT_TRUE(closed.verification.embedded());
  EXPECT_NE(closed.prepared.first_held.find(" in the first pose, which is the mesh's own"),
            std::string::npos);
  EXPECT_EQ(closed.prepared.first_held.back(), 'n') << "the end of the sentence";
}

TEST(Poses, PairsDescendInEachByItself)
{
  // Two layers that cross in the second pose.
  Triangle_soup soup = joined(sheet(12, 12), sheet(12, 12, 1));
  const std::size_t half = soup.points.size() / 2;
  soup.poses.push_back({"crossed", soup.points});
  for (std::size_t v = half; v < soup.points.size(); ++v) {
    const Point_3& p = soup.points[v];
    soup.poses[0].points[v] = {p.x() + 0.3, p.y() + 0.2, 0.31 * (p.x() - 6) + 0.05};
  }
  const std::size_t before = pairs_in_poses(soup);
  ASSERT_GT(before, 0u);
  const Reduction reduction = reduce(soup, to_ratio(0.2));
  EXPECT_TRUE(reduction.simplified.report.is_reached());
  EXPECT_TRUE(reduction.verification.accepted());
  EXPECT_TRUE(reduction.verification.pairs.empty()) << "no pair of the first pose is exempt";
  EXPECT_LE(reduction.verification.poses[0].pairs.size(), before);
  EXPECT_EQ(reduction.verification.poses[0].pairs_of_original, before);
  const Logged_reduction logged = reduce_and_log(soup, to_ratio(0.2));
  Replay_options options;
  options.pose = 0;
  EXPECT_TRUE(replay_text(soup, logged.log, options).is_accepted());

  const Reduction frozen = reduce(soup, to_ratio(0.2), with(Defects::freeze));
  EXPECT_EQ(frozen.verification.poses[0].pairs.size(), before);
  EXPECT_TRUE(frozen.verification.accepted());
  EXPECT_THROW(reduce(soup, to_ratio(0.2), with(Defects::refuse)), Input_error);
}

TEST(Poses, AnObstacleHasItsOwn)
{
  const Triangle_soup cloth = sheet(20, 20);
  Triangle_soup soup = cloth;
  add_pose(soup, "arched",
           [](const Point_3& p) { return Point_3(p.x(), p.y(), 0.02 * p.x() * (20 - p.x())); });
  Triangle_soup body = moved(sheet(20, 20), 0, 0, -0.01);
  Triangle_soup still = body;
  add_pose(body, "arched",
           [](const Point_3& p) { return Point_3(p.x(), p.y(), p.z() + 0.02 * p.x() * (20 - p.x())); });
  const auto pairs = [&](const Triangle_soup& obstacle) {
    const Prepared_soup prepared = prepare(soup, {}, obstacle);
    const Simplified_soup result = simplify_soup(prepared, without_limits(to_ratio(0.05)));
    EXPECT_TRUE(verify(result, prepared).accepted());
    return offending_pairs(joined(in_pose(result.soup, 0), in_pose(body, 0))).size();
  };
  EXPECT_EQ(pairs(body), 0u);
  EXPECT_GT(pairs(still), 0u) << "the control";

  const auto replayed = [&](const Triangle_soup& obstacle, const std::string& log) {
    Replay_options options;
    options.obstacle = obstacle;
    options.pose = 0;
    return replay_text(soup, log, options);
  };
  const auto log_beside = [&](const Triangle_soup& obstacle) {
    return reduce_and_log(soup, without_limits(to_ratio(0.05)), {}, false, obstacle).log;
  };
  EXPECT_TRUE(replayed(body, log_beside(body)).is_accepted());
  std::string of_still = log_beside(still);
  EXPECT_TRUE(replayed(still, of_still).is_accepted());
  EXPECT_THROW(replayed(body, of_still), Input_error) << "it stands elsewhere in the pose";
  of_still.replace(of_still.find("arched - ") + 9, 64, "-");
  EXPECT_FALSE(replayed(body, of_still).is_accepted()) << "the control";

  body.poses.push_back(body.poses.front());
  EXPECT_THROW(prepare(soup, {}, body), Argument_error);
}

TEST(Poses, WhatDoesNotGoWithThemIsRefused)
{
  Triangle_soup soup = sheet(4, 4);
  soup.poses.push_back({"same", soup.points});
  Prepare_options weld;
  weld.weld_distance = 0.1;
  EXPECT_THROW(prepare(soup, weld), Argument_error);
  Simplify_options options = to_ratio(0.5);
  options.faces_per_cell = 100;
  EXPECT_THROW(reduce(soup, options), Argument_error);
  options.faces_per_cell = 0;
  options.placement = Placement::optimal;
  EXPECT_THROW(reduce(soup, options), Argument_error);
  soup.poses[0].points[1] = soup.poses[0].points[0];
  EXPECT_THROW(prepare(soup), Input_error) << "an edge of length zero in one pose";
  soup.poses[0].points.pop_back();
  EXPECT_THROW(prepare(soup), Argument_error);
}

TEST(Poses, RoundingIsJudgedInEach)
{
  Triangle_soup soup = moving_garment(1000);
  Prepare_options options;
  options.round_to_float32 = true;
  const Reduction reduction = reduce(soup, to_ratio(0.3), options);
  EXPECT_TRUE(reduction.verification.accepted());
  for (const Pose& pose : reduction.simplified.soup.poses)
    for (const Point_3& point : pose.points)
      ASSERT_EQ(double(float(point.x())), point.x());
}

TEST(Poses, OfGeneratedGarmentsAreEmbedded)
{
  Generate_options options;
  options.faces = 20000;
  Triangle_soup soup = generate("jacket", options);
  soup.poses = moving_poses(soup, 3);
  ASSERT_EQ(soup.poses.size(), 3u);
  EXPECT_EQ(pairs_in_poses(soup), 0u);
  EXPECT_NE(soup.poses[0].points, soup.poses[1].points);
}

TEST(Poses, FilterWorksInBothLoops)
{
  using Points = Simplify_constraints<Mesh>::Pose_points;
  const Triangle_soup soup = moving_garment(2000);
  for (const bool is_own : {true, false}) {
    const auto count_pairs = [&](const auto& filter_of) {
      Mesh mesh = mesh_of(soup);
      const Points points = get(CGAL::dynamic_vertex_property_t<Point_3>(), mesh);
      for (const auto v : mesh.vertices())
        put(points, v, twisted(mesh.point(v), 3));
      const Intersection_filter<Mesh> filter(mesh);
      const Pose_intersection_filter<Mesh, Points, Intersection_filter<Mesh>> poses(mesh, {points}, filter);
      const Quadric_cost<Mesh> cost(mesh);
      const Border_rule<Mesh> rule(mesh);
      const auto parameters =
          CGAL::parameters::filter(filter_of(filter, poses))
              .visitor(Visitor_chain(filter.visitor(), poses.visitor(), Border_visitor<Mesh>(rule)))
              .get_cost(cost)
              .get_placement(Halfedge_placement<Mesh, Quadric_cost<Mesh>, Border_rule<Mesh>>(cost, rule));
      if (is_own)
        selvedge::edge_collapse(mesh, Edge_ratio_stop(0.15), parameters);
      else
        CGAL::Surface_mesh_simplification::edge_collapse(mesh, Edge_ratio_stop(0.15), parameters);
      for (const auto v : mesh.vertices())
        mesh.point(v) = get(points, v);
      return offending_pairs(soup_of(mesh)).size();
    };
    EXPECT_EQ(count_pairs([](const auto&, const auto& poses) { return poses; }), 0u);
    EXPECT_GT(count_pairs([](const auto& filter, const auto&) { return filter; }), 0u) << "the control";
  }
}

} // namespace
} // namespace selvedge::test
