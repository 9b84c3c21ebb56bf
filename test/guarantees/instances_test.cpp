// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes that stand in several places of a scene: reduced once, judged in every place.

#include "support/Temporary_folder.h"
#include "support/logged_reduction.h"
#include "support/soups.h"

#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

namespace selvedge::test {
namespace {

using Json = nlohmann::ordered_json;

constexpr int s_side = 12;

/// A sheet of hills over the unit square.
Triangle_soup hills(double x = 0, double y = 0, double z = 0)
{
  std::vector<Point_3> points;
  std::vector<Index_triple> triangles;
  for (int i = 0; i <= s_side; ++i)
    for (int j = 0; j <= s_side; ++j) {
      const float height = float(0.08 * std::sin(1.1 * i) * std::cos(0.9 * j));
      points.emplace_back(x + i / 16., y + j / 16., z + double(height));
    }
  for (Index i = 0; i < s_side; ++i)
    for (Index j = 0; j < s_side; ++j) {
      const Index a = i * (s_side + 1) + j, b = a + s_side + 1;
      triangles.push_back({a, b, b + 1});
      triangles.push_back({a, b + 1, a + 1});
    }
  return soup(std::move(points), std::move(triangles));
}

/// The hills in several nodes.
Triangle_soup in_places(const std::vector<Json>& nodes, const Triangle_soup& mesh = hills())
{
  const Temporary_folder folder;
  write_mesh(folder / "a.gltf", mesh);
  Json json = Json::parse(read_file(folder / "a.gltf"));
  json["nodes"] = nodes;
  json["scenes"][0]["nodes"] = Json::array();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    json["nodes"][n]["mesh"] = 0;
    json["scenes"][0]["nodes"].push_back(n);
  }
  return read_mesh(json.dump(), Mesh_format::gltf, "test").soup;
}

Simplify_options as_far_as_possible(Instances instances)
{
  Simplify_options options;
  options.instances = instances;
  return options;
}

std::vector<std::size_t> faces_of_places(const Triangle_soup& soup)
{
  std::vector<std::size_t> faces(soup.groups.names.size(), 0);
  for (const Index group : soup.groups.of_triangle)
    ++faces[group];
  return faces;
}

const std::vector<Json> s_far_apart = {
    {{"name", "first"}},
    {{"name", "turned"}, {"translation", {3, 0, 0}}, {"rotation", {0, 0, 0.6, 0.8}}},
    {{"name", "mirrored"}, {"translation", {0, 3, 0}}, {"scale", {-1, 1, 0.5}}}};

TEST(Instances, AreReducedOnceAndJudgedInEveryPlace)
{
  const Triangle_soup soup = in_places(s_far_apart);
  const Logged_reduction shared = reduce_and_log(soup, as_far_as_possible(Instances::shared));
  EXPECT_EQ(shared.simplified.shared_meshes, 1u);
  EXPECT_EQ(shared.simplified.shared_places, 3u);
  EXPECT_EQ(shared.simplified.report.collapses % 3, 0u);
  const auto faces = faces_of_places(shared.simplified.soup);
  EXPECT_LT(faces[0], 150u);
  EXPECT_EQ(faces[1], faces[0]);
  EXPECT_EQ(faces[2], faces[0]);
  EXPECT_TRUE(replay_text(soup, shared.log).is_accepted());
  const Temporary_folder folder;
  const auto meshes = [&](const Triangle_soup& result) {
    write_mesh(folder / "b.gltf", result);
    return Json::parse(read_file(folder / "b.gltf"))["meshes"].size();
  };
  EXPECT_EQ(meshes(shared.simplified.soup), 1u);
  // By themselves, the flatter place comes out otherwise.
  const Logged_reduction apart = reduce_and_log(soup, as_far_as_possible(Instances::apart));
  EXPECT_GT(meshes(apart.simplified.soup), 1u);
}

TEST(Instances, GapsThatAreHeldDoNotSetPlacesApart)
{
  Triangle_soup mirrored = mapped(hills(), [](const Point_3& p) { // the same at the gap, and steeper behind
    return Point_3(p.x(), s_side / 8. + 1 / 64. - p.y(), double(float(p.z() * (1 + s_side / 16. - p.y()))));
  });
  for (Index_triple& triangle : mirrored.triangles)
    std::swap(triangle[1], triangle[2]);
  const Triangle_soup soup = in_places(s_far_apart, joined(hills(), mirrored));
  Prepare_options of_soup;
  of_soup.open_seams = Open_seams::hold;
  Prepared_soup prepared = prepare(soup, of_soup);
  ASSERT_FALSE(prepared.tied.empty());
  const auto reduced = [&](Instances instances) {
    Simplify_options options = as_far_as_possible(instances);
    options.max_border_turn = 180;
    return simplify_soup(prepared, options);
  };
  const Simplified_soup shared = reduced(Instances::shared);
  const Simplified_soup apart = reduced(Instances::apart);
  EXPECT_EQ(shared.shared_meshes, 1u);
  EXPECT_EQ(shared.apart_meshes, 0u);
  EXPECT_EQ(shared.report.left_alone, 0u);
  EXPECT_EQ(shared.untied_pairs, prepared.tied.size());
  EXPECT_EQ(apart.untied_pairs, 0u);
  Prepared_soup welded = prepared;
  welded.snapping.distance = 1 / 64.;
  EXPECT_EQ(simplify_soup(welded, as_far_as_possible(Instances::shared)).shared_meshes, 0u);
  prepared.tied.clear();
  EXPECT_EQ(reduced(Instances::shared).soup.triangles, shared.soup.triangles) << "they are not held there";
  EXPECT_NE(reduced(Instances::apart).soup.triangles, apart.soup.triangles);
}

TEST(Instances, GapsBetweenPlacesAreNotHeld)
{
  const Triangle_soup soup =
      in_places({{{"name", "left"}}, {{"name", "right"}, {"translation", {4.0625, 0, 0}}}}, sheet(4, 4));
  Prepare_options options;
  options.open_seams = Open_seams::hold;
  const Prepared_soup prepared = prepare(soup, options);
  EXPECT_TRUE(prepared.tied.empty());
  EXPECT_TRUE(prepared.facing.empty());
}

TEST(Instances, WhatOnePlaceRefusesIsDoneInNone)
{
  const Triangle_soup soup = in_places(s_far_apart);
  const auto faces = [&](Instances instances, const Triangle_soup& obstacle) {
    Simplify_options options = as_far_as_possible(instances);
    options.max_normal_change = 45; // so that the obstacle holds many
    const Logged_reduction done = reduce_and_log(soup, options, {}, false, obstacle);
    EXPECT_TRUE(replay_text(soup, done.log).violations.empty());
    if (!obstacle.triangles.empty()) {
      EXPECT_EQ(done.simplified.report.refused_elsewhere > 0, instances == Instances::shared);
      EXPECT_EQ(done.simplified.report.hindrances[Hindrance::companions] > 0, instances == Instances::shared);
    }
    return faces_of_places(done.simplified.soup);
  };
  // Close over the hills in the second place.
  Triangle_soup above = soup;
  for (Point_3& p : above.points)
    p = Point_3(p.x(), p.y(), p.z() + 0.001);
  std::vector<Index_triple> triangles;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    if (soup.groups.of_triangle[t] == 1)
      triangles.push_back(soup.triangles[t]);
  const Triangle_soup obstacle = test::soup(above.points, triangles);
  const auto free = faces(Instances::shared, {}), held = faces(Instances::shared, obstacle),
             apart = faces(Instances::apart, obstacle);
  EXPECT_GT(held[0], free[0] + 50);
  EXPECT_EQ(held[0], held[1]);
  EXPECT_LT(apart[0], held[0]);
  EXPECT_GT(apart[1], apart[0] + 50);
}

// Most collapses are then companions, which are not in the queue. As many edges as there are collapses to
// come would be all that it has, and they would come without regard to their costs.
TEST(Instances, TheTargetDoesNotDecideOnTheOrder)
{
  constexpr int side = 90;
  const Triangle_soup waves = mapped(sheet(side, side), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), double(float(std::sin(0.3 * p.x()) * std::cos(0.004 * p.y() * p.y()))));
  });
  const Triangle_soup soup = in_places({{{"name", "left"}}, {{"translation", {2 * side, 0, 0}}}}, waves);
  Simplify_options options;
  options.faces = soup.triangles.size() / 2;
  const Simplified_soup alone = simplify_soup(prepare(soup), options);
  ASSERT_EQ(alone.shared_meshes, 1u);
  options.least_faces = {*options.faces};
  options.faces.reset();
  options.ratio = 0.02;
  EXPECT_EQ(simplify_soup(prepare(soup), options).soup.triangles, alone.soup.triangles);
  options.instances = Instances::apart; // the control
  const Simplified_soup apart = simplify_soup(prepare(soup), options);
  options.ratio.reset();
  options.faces = options.least_faces[0];
  EXPECT_NE(simplify_soup(prepare(soup), options).soup.triangles, apart.soup.triangles);
}

TEST(Instances, PlacesThatComeTooNearDoNotMove)
{
  const Triangle_soup soup =
      in_places({{{"name", "below"}}, {{"name", "above"}, {"translation", {0, 0, 0.002}}}});
  const Logged_reduction shared = reduce_and_log(soup, as_far_as_possible(Instances::shared));
  EXPECT_EQ(shared.simplified.report.collapses, 0u);
  EXPECT_GT(shared.simplified.report.refused.companions, 0u);
  EXPECT_GT(shared.simplified.report.hindrances[Hindrance::companions], 0u);
  EXPECT_EQ(shared.simplified.report.hindrances[Hindrance::by_loop], 0u);
  EXPECT_GT(reduce_and_log(soup, as_far_as_possible(Instances::apart)).simplified.report.collapses, 0u);
}

TEST(Instances, PlacesThatAreSewnStaySewn)
{
  // Side by side, so that borders coincide: nothing moves there, and all else moves alike.
  const Triangle_soup soup =
      in_places({{{"name", "left"}},
                 {{"name", "right"}, {"translation", {0.75, 0, 0}}, {"scale", {-1, 1, 1}}},
                 {{"name", "away"}, {"translation", {0, 5, 0}}}});
  const Logged_reduction shared = reduce_and_log(soup, as_far_as_possible(Instances::shared));
  EXPECT_TRUE(replay_text(soup, shared.log).is_accepted());
  const auto faces = faces_of_places(shared.simplified.soup);
  EXPECT_LT(faces[0], 200u);
  EXPECT_EQ(faces[1], faces[0]);
  EXPECT_EQ(faces[2], faces[0]);
}

TEST(Instances, LevelsAreTheSameInAllPlaces)
{
  const Prepared_soup prepared = prepare(in_places(s_far_apart));
  for (const Simplified_soup& level :
       simplify_lods(prepared, as_far_as_possible(Instances::shared), {0.9, 0.7})) {
    const auto faces = faces_of_places(level.soup);
    EXPECT_EQ(faces[1], faces[0]);
    EXPECT_EQ(faces[2], faces[0]);
  }
}

TEST(Instances, WhatIsLockedInOnePlaceIsFixedInAll)
{
  Simplify_intent intent;
  intent.locked = {"turned"};
  const auto fixed = [&](Instances instances) {
    return simplify_soup(prepare(in_places(s_far_apart)), as_far_as_possible(instances), intent)
        .report.faces_fixed;
  };
  EXPECT_EQ(fixed(Instances::apart), 2u * s_side * s_side);
  EXPECT_EQ(fixed(Instances::shared), 3u * 2 * s_side * s_side);
}

TEST(Instances, PlacesThatDifferAreReducedApart)
{
  Triangle_soup soup = in_places(s_far_apart);
  Point_3& point = soup.points[soup.triangles.front()[0]]; // moved as by a snap
  point = Point_3(point.x() - 0.125, point.y(), point.z());
  const Simplified_soup result = simplify_soup(prepare(soup), as_far_as_possible(Instances::shared));
  EXPECT_EQ(result.apart_meshes, 1u);
  EXPECT_EQ(result.shared_meshes, 0u);
  EXPECT_GT(result.report.collapses, 0u);
}

} // namespace
} // namespace selvedge::test
