// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// --humanoid-poses, as a user gives it to the app.

#include "App_run.h"
#include "support/Figure.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace selvedge::test {
namespace {

using Arguments = std::vector<std::string>;

Arguments with(Arguments arguments, const Arguments& more)
{
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// A figure in two sleeves that are straight in the file.
class Figure_in_sleeves : public ::testing::Test
{
protected:
  void SetUp() override
  {
    Figure figure;
    figure.wear_sleeves();
    write_text(gltf, figure.document().dump());
  }

  App_result simplify(const Arguments& more) const
  {
    return run_app(with({"simplify", gltf, "-o", small, "--ratio", "0.2"}, more));
  }

  Workspace folder;
  const std::string gltf = folder / "figure.gltf", small = folder / "small.glb", log = folder / "steps.log";
};

TEST_F(Figure_in_sleeves, PiercesThemWhenItsArmsGoDownUnlessTheseAreGuarded)
{
  const Arguments verify{"verify", small, "--against", gltf};
  EXPECT_EQ(simplify({}).code, 0);
  EXPECT_EQ(run_app(verify).code, 0);
  const App_result pierced = run_app(with(verify, {"--humanoid-poses"}));
  EXPECT_EQ(pierced.code, 1);
  EXPECT_NE(pierced.out.find("pose 'arms_down': "), std::string::npos) << pierced.out;

  const App_result guarded = simplify({"--humanoid-poses", "--log", log});
  EXPECT_EQ(guarded.code, 0) << guarded.err;
  EXPECT_NE(guarded.out.find("poses: 7 further poses judged, "), std::string::npos) << guarded.out;
  EXPECT_EQ(run_app(with(verify, {"--humanoid-poses"})).code, 0);
  EXPECT_EQ(run_app({"replay", gltf, log, "--humanoid-poses"}).code, 0);
}

TEST_F(Figure_in_sleeves, MeetsTheOtherOptionsOfPoses)
{
  const Arguments poses{"--humanoid-poses", "--without-pose", "arms_up", "--without-pose", "bow"};
  const std::string report = folder / "report.json", levels = folder / "levels.glb";
  EXPECT_EQ(
      simplify(with(poses, {"--key-poses", "auto", "--poses-out", folder / "{pose}.obj", "--report", report}))
          .code,
      0);
  const nlohmann::json json = nlohmann::json::parse(contents_of(report));
  EXPECT_TRUE(json["options"]["humanoid_poses"]);
  std::vector<std::string> names;
  for (const nlohmann::json& pose : json["verified"]["poses"])
    names.push_back(pose["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"arms_down", "elbows_bent", "arms_forward", "step", "sit"}));
  // What is written is what the file makes of its own skeleton.
  EXPECT_EQ(run_app({"simplify", small, "-o", folder / "again.glb", "--ratio", "1", "--quiet",
                     "--humanoid-poses", "--poses-out", folder / "again_{pose}.obj"})
                .code,
            0);
  EXPECT_EQ(contents_of(folder / "again_arms_down.obj"), contents_of(folder / "arms_down.obj"));

  EXPECT_EQ(run_app(with({"simplify", gltf, "-o", levels, "--lods", "1,0.5,0.2"}, poses)).code, 0);
  EXPECT_EQ(run_app(with({"verify", levels, "--lod", "2", "--against", gltf}, poses)).code, 0);
}

TEST_F(Figure_in_sleeves, IsAnObstacleInTheSamePoses)
{
  const std::string body = folder / "body.gltf"; // its own right arm is bare
  Figure figure;
  figure.wear_corners();
  write_text(body, figure.document().dump());
  const Arguments obstacle{"--obstacle", body, "--obstacle-humanoid-poses"},
      poses{"--humanoid-poses", "--without-pose", "step"};
  EXPECT_EQ(simplify(with(with(obstacle, poses), {"--log", log})).code, 0);
  const App_result replayed = run_app(with(with({"replay", gltf, log}, obstacle), poses));
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_NE(replayed.out.find(", obstacle bound\n"), std::string::npos) << replayed.out;
  EXPECT_EQ(run_app(with({"replay", gltf, log, "--obstacle", body}, poses)).code, 3) << "it stands still";
  const App_result refused = simplify(obstacle);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--obstacle-humanoid-poses: the mesh has no further poses"), std::string::npos)
      << refused.err;
}

TEST_F(Figure_in_sleeves, IsSaidToMoveWithoutAPromise)
{
  const auto says_so = [&](const Arguments& more) {
    const App_result result = simplify(more);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.out.find("(--humanoid-poses guards some)") != std::string::npos;
  };
  EXPECT_TRUE(says_so({}));
  EXPECT_FALSE(says_so({"--humanoid-poses"}));
}

TEST_F(Figure_in_sleeves, NeedsASkeletonThatIsKnown)
{
  Figure figure;
  for (Figure::Joint& joint : figure.joints)
    joint.name = "joint";
  figure.wear_corners();
  write_text(gltf, figure.document().dump());
  const App_result result = simplify({"--humanoid-poses"});
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(
      result.err.find("figure.gltf: its skeleton is not known to be that of a human figure: there is no "
                      "leftUpperArm, "),
      std::string::npos)
      << result.err;
}

} // namespace
} // namespace selvedge::test
