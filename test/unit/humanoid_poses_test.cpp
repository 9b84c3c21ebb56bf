// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The poses that the skeleton of a human figure makes.

#include "support/Figure.h"

#include <selvedge/Error.h>
#include <selvedge/gltf_poses.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

namespace selvedge::test {
namespace {

using Direction = Kernel::Vector_3;

// Each coordinate is the result of some hundred operations on numbers below 32.
constexpr double rounding_of_bones = 1e-12;

Figure figure_with_corners()
{
  Figure figure;
  figure.wear_corners();
  return figure;
}

Triangle_soup soup_of_figure(const Figure::Json& document)
{
  return read_mesh(document.dump(), Mesh_format::gltf, "figure.gltf").soup;
}

std::vector<Pose> poses_of_figure(const Figure::Json& document)
{
  return humanoid_poses(soup_of_figure(document), "figure.gltf");
}

Point_3 place_of(const Pose& pose, std::size_t bone)
{
  return pose.points[4 * bone];
}

Direction direction_between(const Pose& pose, std::size_t from, std::size_t to)
{
  const Direction v = place_of(pose, to) - place_of(pose, from);
  return v / std::sqrt(v.squared_length());
}

void expect_same_poses(const std::vector<Pose>& found, const std::vector<Pose>& expected,
                       double largest_difference)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].name, expected[i].name);
    for (std::size_t v = 0; v < 4 * std::size_t(Figure::bones); ++v)
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(found[i].points[v][axis], expected[i].points[v][axis], largest_difference)
            << found[i].name << ' ' << v;
  }
}

// Every bone keeps its length, and what hangs on it its shape and its sides.
void expect_rigid_bones(const std::vector<Pose>& poses, const Figure& figure)
{
  for (const Pose& pose : poses)
    for (std::size_t bone = 0; bone < Figure::bones; ++bone) {
      std::array<Direction, 3> edges;
      for (std::size_t k = 0; k < 3; ++k)
        edges[k] = pose.points[4 * bone + k + 1] - place_of(pose, bone);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(edges[k] * edges[k], 1, rounding_of_bones) << pose.name << ' ' << bone;
        EXPECT_NEAR(edges[k] * edges[(k + 1) % 3], 0, rounding_of_bones) << pose.name << ' ' << bone;
      }
      EXPECT_NEAR(CGAL::determinant(edges[0], edges[1], edges[2]), 1, rounding_of_bones)
          << pose.name << ' ' << bone;
      const auto &at = figure.joints[bone].place, &from = figure.joints[figure.joints[bone].parent].place;
      EXPECT_NEAR((place_of(pose, bone) - place_of(pose, figure.joints[bone].parent)).squared_length(),
                  Direction(at[0] - from[0], at[1] - from[1], at[2] - from[2]).squared_length(),
                  64 * rounding_of_bones)
          << pose.name << ' ' << bone;
    }
}

TEST(Humanoid_poses, AreThoseTheyAreNamedAfter)
{
  const Figure figure = figure_with_corners();
  ASSERT_TRUE(has_humanoid(soup_of_figure(figure.document())));
  const std::vector<Pose> poses = poses_of_figure(figure.document());
  std::vector<std::string> names;
  for (const Pose& pose : poses)
    names.push_back(pose.name);
  ASSERT_EQ(names, (std::vector<std::string>{"arms_down", "elbows_bent", "arms_forward", "arms_up", "step",
                                             "sit", "bow"}));
  expect_rigid_bones(poses, figure);
  const auto along = [](const Pose& pose, std::size_t bone) {
    return direction_between(pose, bone, bone + 1);
  };
  constexpr double nearly = 0.9;
  for (const auto& [upper_arm, upper_leg, outwards] :
       {std::tuple(Figure::left_upper_arm, Figure::left_upper_leg, 1),
        std::tuple(Figure::right_upper_arm, Figure::right_upper_leg, -1)}) {
    EXPECT_LT(along(poses[0], upper_arm).y(), -nearly);
    EXPECT_LT(along(poses[0], upper_arm + 1).y(), -nearly);
    EXPECT_GT(outwards * along(poses[0], upper_arm).x(), 0) << "out of the body";
    EXPECT_LT(along(poses[1], upper_arm).y(), -nearly);
    EXPECT_GT(along(poses[1], upper_arm + 1).z(), nearly);
    EXPECT_GT(along(poses[2], upper_arm).z(), nearly);
    EXPECT_GT(along(poses[2], upper_arm + 1).z(), nearly);
    EXPECT_GT(along(poses[3], upper_arm).y(), nearly);
    EXPECT_GT(along(poses[3], upper_arm + 1).y(), nearly);
    EXPECT_GT(along(poses[5], upper_leg).z(), nearly);
    EXPECT_GT(outwards * along(poses[5], upper_leg).x(), 0);
    EXPECT_LT(along(poses[5], upper_leg + 1).y(), -nearly);
    EXPECT_LT(along(poses[6], upper_arm).y(), -nearly);
    for (const std::size_t pose : {0u, 1u, 2u, 3u, 6u})
      EXPECT_EQ(place_of(poses[pose], upper_leg + 2).y(), 1) << "stands on its feet";
  }
  EXPECT_GT(place_of(poses[4], Figure::left_foot).z(), place_of(poses[4], Figure::right_foot).z());
  EXPECT_LT(place_of(poses[4], Figure::left_hand).z(), place_of(poses[4], Figure::right_hand).z());
  const Point_3 between = CGAL::midpoint(place_of(poses[6], Figure::left_upper_arm), //
                                         place_of(poses[6], Figure::right_upper_arm));
  const Direction back = between - place_of(poses[6], Figure::spine);
  EXPECT_NEAR(std::atan2(back.z(), back.y()) * 180 / std::acos(-1), 40, 1);
  EXPECT_NEAR(back.x(), 0, rounding_of_bones);
}

TEST(Humanoid_poses, DoNotDependOnThePoseOfTheFile)
{
  Figure lowered;
  lowered.stand_with_arms_lowered();
  lowered.wear_corners();
  const std::vector<Pose> found = poses_of_figure(lowered.document()),
                          expected = poses_of_figure(figure_with_corners().document());
  expect_rigid_bones(found, lowered);
  for (std::size_t pose = 0; pose < expected.size(); ++pose)
    for (std::size_t bone = 0; bone < Figure::bones; ++bone)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(place_of(found[pose], bone)[axis], place_of(expected[pose], bone)[axis],
                    rounding_of_bones)
            << expected[pose].name << ' ' << bone;
}

TEST(Humanoid_poses, FaceWhereTheFigureDoes)
{
  Figure turned; // by half, as figures of VRM 0 look along -z
  for (Figure::Joint& joint : turned.joints)
    joint.place = {-joint.place[0], joint.place[1], -joint.place[2]};
  turned.wear_corners();
  const std::vector<Pose> found = poses_of_figure(turned.document()),
                          expected = poses_of_figure(figure_with_corners().document());
  for (std::size_t pose = 0; pose < expected.size(); ++pose)
    for (std::size_t bone = 0; bone < Figure::bones; ++bone) {
      const Point_3 p = place_of(expected[pose], bone);
      EXPECT_EQ(place_of(found[pose], bone), Point_3(-p.x(), p.y(), -p.z()))
          << expected[pose].name << ' ' << bone;
    }
}

TEST(Humanoid_poses, TurnByAnyWayWhereABonePointsTheOtherWay)
{
  Figure figure; // its left arm is opposite to where it hangs, the right one nearly
  for (const auto& [bone, side, more] :
       {std::tuple(Figure::left_upper_arm, 1.f, 0.f), std::tuple(Figure::right_upper_arm, -1.f, 1 / 65536.f)})
    for (std::size_t i = 1; i <= 2; ++i)
      figure.joints[bone + i].place = {side * (3 - float(i)), 24 + 4 * float(i), more * float(i)};
  figure.wear_corners();
  const std::vector<Pose> poses = poses_of_figure(figure.document()),
                          expected = poses_of_figure(figure_with_corners().document());
  expect_rigid_bones(poses, figure);
  for (const std::size_t bone : {Figure::left_upper_arm, Figure::right_upper_arm})
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(direction_between(poses[0], bone, bone + 1)[axis],
                  direction_between(expected[0], bone, bone + 1)[axis], rounding_of_bones);
}

// Names a bone as rigs do: {l} is replaced by l or r, and so are {L}, {left} and {Left}.
std::string name_in_rig(std::string pattern, bool is_left)
{
  for (const auto& [mark, left, right] :
       {std::tuple("{l}", "l", "r"), std::tuple("{L}", "L", "R"), std::tuple("{left}", "left", "right"),
        std::tuple("{Left}", "Left", "Right")})
    if (const std::size_t at = pattern.find(mark); at != std::string::npos)
      pattern.replace(at, std::string(mark).size(), is_left ? left : right);
  return pattern;
}

TEST(Humanoid_poses, KnowTheNamesOfManyRigs)
{
  const std::vector<Pose> expected = poses_of_figure(figure_with_corners().document());
  const std::vector<std::array<const char*, 6>> rigs = {
      {"{Left}Arm", "{Left}ForeArm", "{Left}Hand", "{Left}UpLeg", "{Left}Leg", "{Left}Foot"},
      {"mixamorig1:{Left}Arm_09", "mixamorig1:{Left}ForeArm_010", "mixamorig1:{Left}Hand_011",
       "mixamorig1:{Left}UpLeg_056", "mixamorig1:{Left}Leg_057", "mixamorig1:{Left}Foot_058"},
      {"upperarm_{l}", "lowerarm_{l}", "hand_{l}", "thigh_{l}", "calf_{l}", "foot_{l}"},
      {"DEF-upper_arm.{L}", "DEF-forearm.{L}", "DEF-hand.{L}", "DEF-thigh.{L}", "DEF-shin.{L}",
       "DEF-foot.{L}"},
      {"Bip01 {L} UpperArm", "Bip01 {L} Forearm", "Bip01 {L} Hand", "Bip01 {L} Thigh", "Bip01 {L} Calf",
       "Bip01 {L} Foot"},
      {"ValveBiped.Bip01_{L}_UpperArm", "ValveBiped.Bip01_{L}_Forearm", "ValveBiped.Bip01_{L}_Hand",
       "ValveBiped.Bip01_{L}_Thigh", "ValveBiped.Bip01_{L}_Calf", "ValveBiped.Bip01_{L}_Foot"},
      {"J_Bip_{L}_UpperArm", "J_Bip_{L}_LowerArm", "J_Bip_{L}_Hand", "J_Bip_{L}_UpperLeg",
       "J_Bip_{L}_LowerLeg", "J_Bip_{L}_Foot"},
      {"CC_Base_{L}_Upperarm", "CC_Base_{L}_Forearm", "CC_Base_{L}_Hand", "CC_Base_{L}_Thigh",
       "CC_Base_{L}_Calf", "CC_Base_{L}_Foot"},
      {"{Left} arm", "{Left} elbow", "{Left} wrist", "{Left} leg", "{Left} knee", "{Left} ankle"},
      {"{left}_shoulder", "{left}_elbow", "{left}_wrist", "{left}_hip", "{left}_knee", "{left}_ankle"},
      {"upperarm01.{L}", "lowerarm01.{L}", "wrist.{L}", "upperleg01.{L}", "lowerleg01.{L}", "foot.{L}"},
      {"{l}ShldrBend", "{l}ForearmBend", "{l}Hand", "{l}ThighBend", "{l}Shin", "{l}Foot"},
      {"{left}arm", "{left}forearm", "{left}hand", "{L}UpLeg", "{L}Leg", "{L}Foot"}};
  for (const std::array<const char*, 6>& rig : rigs) {
    Figure figure = figure_with_corners();
    for (std::size_t i = 0; i < 6; ++i) {
      const std::size_t limbs = i < 3 ? Figure::left_upper_arm : Figure::left_upper_leg - 3;
      figure.joints[limbs + i].name = name_in_rig(rig[i], true);
      figure.joints[limbs + i + 3].name = name_in_rig(rig[i], false);
    }
    SCOPED_TRACE(rig[0]);
    expect_same_poses(poses_of_figure(figure.document()), expected, 0);
  }
}

/// The same figure, with names that say nothing, and the bones in an extension.
Figure::Json in_extension(Figure figure, const char* extension)
{
  const char* const bones[] = {"UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot"};
  Figure::Json list;
  const bool is_of_1 = extension == std::string("VRMC_vrm");
  for (std::size_t i = 0; i < figure.joints.size(); ++i) {
    figure.joints[i].name = "mixamorig:RightHand";
    if (i < Figure::left_upper_arm)
      continue;
    const std::size_t limb = (i - 3) / 3;
    const std::string name = (limb % 2 == 0 ? "left" : "right") + std::string(bones[limb / 2 * 3 + i % 3]);
    if (is_of_1)
      list[name]["node"] = i + 1;
    else
      list.push_back({{"bone", name}, {"node", i + 1}, {"useDefaultValues", true}});
  }
  Figure::Json document = figure.document();
  document["extensions"][extension]["humanoid"]["humanBones"] = list;
  return document;
}

TEST(Humanoid_poses, TakeTheBonesThatVrmNames)
{
  const Figure figure = figure_with_corners();
  const std::vector<Pose> expected = poses_of_figure(figure.document());
  for (const char* extension : {"VRM", "VRMC_vrm"}) {
    SCOPED_TRACE(extension);
    expect_same_poses(poses_of_figure(in_extension(figure, extension)), expected, 0);
    Figure::Json document = in_extension(figure, extension);
    Figure::Json& bones = document["extensions"][extension]["humanoid"]["humanBones"];
    (bones.is_array() ? bones[5] : bones["rightHand"])["node"] = 99;
    EXPECT_FALSE(has_humanoid(soup_of_figure(document)));
    (bones.is_array() ? bones[5] : bones["rightHand"])["node"] = "none";
    EXPECT_FALSE(has_humanoid(soup_of_figure(document)));
    EXPECT_THROW(poses_of_figure(document), Input_error);
  }
}

TEST(Humanoid_poses, TurnTheFirstOfSeveralJointsOfOneName)
{
  Figure figure;
  figure.joints.push_back({figure.joints[Figure::left_upper_arm].name, Figure::hips, {0, 17, 0}});
  figure.joints.push_back({figure.joints[Figure::left_hand].name, Figure::hips, {1, 17, 0}});
  figure.wear_corners();
  const std::vector<Pose> poses = poses_of_figure(figure.document());
  expect_same_poses(poses, poses_of_figure(figure_with_corners().document()), 0);
  EXPECT_EQ(place_of(poses[0], Figure::bones), Point_3(0, 17, 0));
}

TEST(Humanoid_poses, TakeNodesWithMatricesAndScales)
{
  const Figure figure = figure_with_corners();
  Figure::Json document = figure.document();
  for (Figure::Json& node : document["nodes"])
    if (node.contains("translation")) {
      const Figure::Json t = node["translation"];
      node.erase("translation");
      node["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, t[0], t[1], t[2], 1};
    }
  const std::vector<Pose> expected = poses_of_figure(figure.document());
  expect_same_poses(poses_of_figure(document), expected, 0);

  // As large as four, and turned by a quarter about y: (x, y, z) goes to (4 z, 4 y, -4 x).
  document["nodes"].push_back(
      {{"children", {1}}, {"matrix", {0, 0, -4, 0, 0, 4, 0, 0, 4, 0, 0, 0, 0, 0, 0, 1}}});
  document["scenes"][0]["nodes"] = {0, document["nodes"].size() - 1};
  const std::vector<Pose> found = poses_of_figure(document);
  for (std::size_t pose = 0; pose < expected.size(); ++pose)
    for (std::size_t v = 0; v < expected[pose].points.size(); ++v) {
      const Point_3 &p = expected[pose].points[v], &q = found[pose].points[v];
      EXPECT_NEAR(q.x(), 4 * p.z(), 4 * rounding_of_bones);
      EXPECT_NEAR(q.y(), 4 * p.y(), 4 * rounding_of_bones);
      EXPECT_NEAR(q.z(), -4 * p.x(), 4 * rounding_of_bones);
    }
}

TEST(Humanoid_poses, KeepCoincidentVerticesTogether)
{
  Figure figure = figure_with_corners();
  const auto first = std::uint32_t(figure.vertices.size());
  figure.vertices.push_back(
      {{5.5f, 24.3f, 0.7f}, {Figure::left_upper_arm, Figure::chest, 4, 9}, {0.3f, 0.6f, 0.1f, 0}});
  figure.vertices.push_back(
      {{5.5f, 24.3f, 0.7f}, {4, 9, Figure::chest, Figure::left_upper_arm}, {0.1f, 0, 0.6f, 0.3f}});
  figure.corners.insert(figure.corners.end(), {0, 1, first, 0, 2, first + 1});
  for (const Pose& pose : poses_of_figure(figure.document()))
    EXPECT_EQ(pose.points[first], pose.points[first + 1]) << pose.name;
}

TEST(Humanoid_poses, DoNotBowWithoutASpine)
{
  Figure figure;
  figure.joints[Figure::left_upper_arm].parent = Figure::hips;
  figure.joints[Figure::right_upper_arm].parent = Figure::hips;
  figure.wear_corners();
  const std::vector<Pose> poses = poses_of_figure(figure.document());
  ASSERT_EQ(poses.size(), 6u);
  EXPECT_EQ(poses.back().name, "sit");
}

TEST(Humanoid_poses, OfOtherFilesAreRefused)
{
  const auto refused = [](const char* what, const std::function<void(Figure&)>& spoil,
                          const std::function<void(Figure::Json&)>& change = {}) {
    Figure figure;
    spoil(figure);
    figure.wear_corners();
    Figure::Json document = figure.document();
    if (change)
      change(document);
    try {
      poses_of_figure(document);
      ADD_FAILURE() << what;
    } catch (const Input_error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  const auto as_it_is = [](Figure&) {};
  refused("there is no leftHand; name the joints as VRM or Mixamo does, or give poses by --animation",
          [](Figure& figure) { figure.joints[Figure::left_hand].name = "hook"; });
  refused("there is no rightLowerLeg, rightFoot;",
          [](Figure& figure) { figure.joints[Figure::right_lower_leg].parent = Figure::hips; });
  refused("there is no rightHand", as_it_is,
          [](Figure::Json& json) { json["nodes"][Figure::right_hand + 1].erase("name"); });
  refused("node 4 is a bone without length", [](Figure& figure) {
    figure.joints[Figure::left_lower_arm].place = figure.joints[Figure::left_upper_arm].place;
  });
  refused("both legs of its figure begin at one place; correct nodes 10 and 13", [](Figure& figure) {
    figure.joints[Figure::right_upper_leg].place = {2, 14, 0};
  });
  refused("has no skin that a figure could move", as_it_is,
          [](Figure::Json& json) { json["nodes"][0].erase("skin"); });

  Triangle_soup soup = soup_of_figure(figure_with_corners().document());
  soup.scene = nullptr;
  EXPECT_FALSE(has_humanoid(soup));
  EXPECT_THROW(humanoid_poses(soup, "x"), Input_error);
}

} // namespace
} // namespace selvedge::test
