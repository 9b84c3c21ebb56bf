// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Further poses, from files and from glTF, as a user gives them to the app.

#include "App_run.h"
#include "support/soups.h"

#include <selvedge/gltf_poses.h>
#include <selvedge/internal/base64.h>
#include <selvedge/mesh_files.h>
#include <selvedge/poses.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

/// Two sheets, slightly curved, the upper one in steps, which a morph target named "up/waves" lets wave
/// together, and an animation that brings it in within a second. As glTF, and as two OBJ files.
class Waving_sheets : public ::testing::Test
{
protected:
  void SetUp() override
  {
    constexpr std::uint32_t n = 20;
    std::vector<float> flat, rise;
    std::vector<std::uint32_t> faces;
    std::string obj, waving_obj, obj_faces;
    for (std::uint32_t sheet = 0; sheet < 2; ++sheet)
      for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
          const float z = float(sheet * (1 + j / 8)) / 64 + float(i * i) / 64,
                      wave = std::floor(8 * std::sin(0.9f * float(i)) * std::cos(0.7f * float(j)));
          flat.insert(flat.end(), {float(i), float(j), z});
          rise.insert(rise.end(), {0, 0, wave / 8});
          const std::string row = "v " + std::to_string(i) + ' ' + std::to_string(j) + ' ';
          obj += row + std::to_string(z) + '\n';
          waving_obj += row + std::to_string(z + wave / 8) + '\n';
          const std::uint32_t corner = sheet * (n + 1) * (n + 1) + i * (n + 1) + j;
          if (i < n && j < n)
            for (const auto& [a, b] :
                 {std::pair(corner + n + 1, corner + n + 2), std::pair(corner + n + 2, corner + 1)}) {
              faces.insert(faces.end(), {corner, a, b});
              obj_faces += "f " + std::to_string(corner + 1) + ' ' + std::to_string(a + 1) + ' ' +
                           std::to_string(b + 1) + '\n';
            }
        }
    write_text(folder / "flat.obj", obj + obj_faces);
    write_text(folder / "waving.obj", waving_obj + obj_faces);

    std::string bytes;
    nlohmann::json views, accessors;
    const auto add = [&](const auto& numbers, int component, const char* type, std::size_t count) {
      const std::size_t size = numbers.size() * 4;
      views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
      bytes.append(reinterpret_cast<const char*>(numbers.data()), size);
      accessors.push_back(
          {{"bufferView", accessors.size()}, {"componentType", component}, {"count", count}, {"type", type}});
      return accessors.size() - 1;
    };
    const std::size_t points = add(flat, 5126, "VEC3", flat.size() / 3),
                      target = add(rise, 5126, "VEC3", flat.size() / 3),
                      corners = add(faces, 5125, "SCALAR", faces.size()),
                      times = add(std::vector<float>{0, 1}, 5126, "SCALAR", 2),
                      weights = add(std::vector<float>{0, 1}, 5126, "SCALAR", 2);
    const nlohmann::json document = {
        {"asset", {{"version", "2.0"}}},
        {"buffers",
         {{{"byteLength", bytes.size()},
           {"uri", "data:application/octet-stream;base64," + internal::base64(bytes)}}}},
        {"bufferViews", views},
        {"accessors", accessors},
        {"meshes",
         {{{"primitives",
            {{{"attributes", {{"POSITION", points}}},
              {"indices", corners},
              {"targets", {{{"POSITION", target}}}}}}},
           {"extras", {{"targetNames", {"up/waves"}}}}}}},
        {"nodes", {{{"mesh", 0}}}},
        {"scenes", {{{"nodes", {0}}}}},
        {"animations",
         {{{"name", "wave"},
           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
           {"samplers", {{{"input", times}, {"output", weights}}}}}}}};
    write_text(gltf, document.dump());
  }

  /// Runs the app with its log, and expects that it is done.
  void simplify(const std::string& mesh, const std::string& output, std::vector<std::string> poses)
  {
    poses.insert(poses.begin(), {"simplify", mesh, "-o", output, "--ratio", "0.2", "--quiet", "--log", log});
    const App_result result = run_app(poses);
    EXPECT_EQ(result.code, 0) << result.err;
  }

  Workspace folder;
  const std::string gltf = folder / "sheets.gltf", log = folder / "steps.log";
};

TEST_F(Waving_sheets, PierceEachOtherInAPoseThatIsNotGiven)
{
  simplify(gltf, folder / "alone.glb", {});
  EXPECT_EQ(run_app({"verify", folder / "alone.glb", "--against", gltf}).code, 0);
  const App_result result = run_app({"verify", folder / "alone.glb", "--against", gltf, "--morphs"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("pose 'up_waves': "), std::string::npos) << result.out;
}

TEST_F(Waving_sheets, AreNeverReplaced)
{
  const std::string flat = folder / "flat.obj", out = folder / "out.obj", pose = folder / "waving.obj";
  const std::string before = contents_of(pose);
  for (const auto& [option, file] : {std::pair("--report", pose), std::pair("--log", pose),
                                     std::pair("--poses-out", folder / "{pose}.obj")})
    expect_refused(
        {"simplify", flat, "-o", out, "--ratio", "0.2", "--pose", folder / "wavin*.obj", option, file}, 2,
        std::string(option) + " and --pose name the same file");
  expect_refused({"simplify", flat, "-o", pose, "--ratio", "0.2", "--pose", pose}, 2,
                 "--output and --pose name the same file");
  expect_refused({"verify", flat, "--pose", pose, "--report", pose}, 2,
                 "--report and --pose name the same file");
  simplify(flat, out, {"--pose", pose});
  expect_refused({"replay", flat, log, "--pose", pose, "--report", pose}, 2,
                 "--report and --pose name the same file");
  EXPECT_EQ(contents_of(pose), before);
  // The input may be replaced by the mesh alone.
  std::filesystem::copy_file(flat, folder / "a_waving.obj");
  const std::string input = folder / "a_waving.obj", whole = contents_of(input);
  expect_refused({"simplify", input, "-o", out, "--ratio", "0.2", "--pose", pose, "--poses-out",
                  folder / "a_{pose}.obj"},
                 2, "--poses-out and IN name the same file");
  EXPECT_EQ(contents_of(input), whole);
}

TEST_F(Waving_sheets, HaveNamesOfTheirOwnAndAreChosenAmongTheFramesOfCaches)
{
  const std::string flat = folder / "flat.obj", out = folder / "out.obj", walk = folder / "walk.pc2",
                    run = folder / "run.pc2";
  Triangle_soup mesh = read_mesh(flat).soup;
  const Triangle_soup waving = read_mesh(folder / "waving.obj").soup;
  for (const float time : {0.f, 1.f, 2.f})
    mesh.poses.push_back({"", time == 1 ? waving.points : mesh.points, time});
  write_point_cache(walk, mesh);
  mesh.poses.pop_back();
  write_point_cache(run, mesh);
  simplify(flat, out, {"--pose", walk, "--pose", run, "--poses-out", folder / "p_{pose}.obj"});
  for (const char* const name : {"walk_frame_1", "walk_frame_2", "run_frame_1", "run_frame_2", "frame_3"})
    EXPECT_TRUE(std::filesystem::exists(folder / ("p_" + std::string(name) + ".obj"))) << name;
  simplify(flat, out, {"--pose", walk, "--every", "2", "--poses-out", folder / "q_{pose}.obj"});
  EXPECT_TRUE(std::filesystem::exists(folder / "q_frame_3.obj"));
  EXPECT_FALSE(std::filesystem::exists(folder / "q_frame_2.obj"));
  // In a verification, of the frames of either mesh.
  EXPECT_EQ(run_app({"verify", out, "--against", flat, "--pose", folder / "q_frame_1.obj", "--pose",
                     folder / "q_frame_3.obj", "--against-pose", walk, "--every", "2"})
                .code,
            0);
  expect_refused(
      {"simplify", flat, "-o", out, "--ratio", "0.2", "--pose", folder / "waving.obj", "--every", "2"}, 2,
      "--every: there are no frames to choose from");
}

TEST_F(Waving_sheets, AreRefusedInFilesThatWouldRoundAWholeScene)
{
  nlohmann::json document = nlohmann::json::parse(contents_of(gltf));
  document["nodes"][0]["scale"] = {0.1, 0.1, 0.1};
  const std::string moved = folder / "moved.gltf", out = folder / "out.glb";
  write_text(moved, document.dump());
  for (const std::string poses : {"p.glb", "p_{pose}.glb", "p.pc2"})
    expect_refused(
        {"simplify", moved, "-o", out, "--ratio", "0.2", "--morphs", "--poses-out", folder / poses}, 2,
        "--poses-out");
  expect_refused({"simplify", moved, "-o", folder / "out.stl", "--ratio", "0.2", "--progressive", out}, 2,
                 "--progressive");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.stl"));
  EXPECT_FALSE(std::filesystem::exists(out));
  simplify(moved, out, {"--morphs", "--poses-out", folder / "p_{pose}.obj"});
  simplify(moved, folder / "out.obj", {"--morphs", "--poses-out", folder / "p.pc2"});
  simplify(gltf, out, {"--morphs", "--poses-out", folder / "p.glb"});
}

TEST_F(Waving_sheets, MayBeLeftOutByName)
{
  const std::string out = folder / "small.glb", alone = folder / "alone.glb";
  simplify(gltf, alone, {});
  simplify(gltf, out, {"--morphs", "--without-pose", "up_waves"});
  EXPECT_EQ(contents_of(out), contents_of(alone));
  simplify(gltf, out, {"--morphs"});
  EXPECT_NE(contents_of(out), contents_of(alone)) << "the control";
  const std::vector<std::string> verify{"verify", alone, "--against", gltf, "--morphs", "--without-pose"};
  const auto verify_without = [&](const std::string& name) {
    std::vector<std::string> arguments = verify;
    arguments.push_back(name);
    return run_app(arguments);
  };
  EXPECT_EQ(verify_without("up_waves").code, 0);
  const App_result result = verify_without("down");
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("has no further pose 'down' to leave out; there are 'up_waves'"),
            std::string::npos)
      << result.err;
}

TEST_F(Waving_sheets, AreSaidToMorphWithoutAPromise)
{
  const auto says_so = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"simplify", gltf, "-o", folder / "small.glb", "--ratio", "0.2"});
    const App_result result = run_app(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return result.out.find("(--morphs guards these, too)") != std::string::npos;
  };
  EXPECT_TRUE(says_so({}));
  EXPECT_TRUE(says_so({"--animation", "wave"}));
  EXPECT_FALSE(says_so({"--morphs"}));
}

TEST_F(Waving_sheets, AreLegalInMorphTargetsAndKeyframes)
{
  for (const std::vector<std::string>& poses : {std::vector<std::string>{"--morphs"},
                                                {"--animation", "wave"},
                                                {"--morphs", "--animation", "all", "--every", "2"}}) {
    const std::string small = folder / "small.glb";
    simplify(gltf, small, poses);
    std::vector<std::string> verify{"verify", small, "--against", gltf}, replay{"replay", gltf, log};
    verify.insert(verify.end(), poses.begin(), poses.end());
    replay.insert(replay.end(), poses.begin(), poses.end());
    EXPECT_EQ(run_app(verify).code, 0);
    EXPECT_EQ(run_app(replay).code, 0);
  }
}

TEST_F(Waving_sheets, AreMeasuredInEveryPose)
{
  const std::string flat = folder / "flat.obj", out = folder / "small.obj", report = folder / "r.json",
                    judged = folder / "judged.json";
  const auto distance = [](const std::string& file) {
    return nlohmann::json::parse(contents_of(file))["distance"]["original_to_result"];
  };
  // The limit holds in the pose of the file, where hardly anything is to be seen of what it does to the
  // waves.
  const std::vector<std::string> limited{"simplify", flat, "-o", out, "--error", "0.004", "--report", report};
  EXPECT_EQ(run_app(limited).code, 0);
  EXPECT_LE(distance(report)["max_upper"], 0.00404);
  EXPECT_TRUE(distance(report)["max_pose"].is_null());

  const std::string waving = folder / "waving.obj", small_waving = folder / "small_waving.obj";
  std::vector<std::string> in_poses = limited;
  in_poses.insert(in_poses.end(), {"--pose", waving, "--poses-out", folder / "small_{pose}.obj"});
  const App_result guarded = run_app(in_poses);
  EXPECT_NE(guarded.out.find("\ndistance of any point in any pose: at most "), std::string::npos)
      << guarded.out;
  EXPECT_NE(guarded.out.find("; the most in pose 'waving'\n"), std::string::npos) << guarded.out;
  EXPECT_EQ(distance(report)["max_pose"], "waving");
  const App_result result = run_app({"verify", out, "--against", flat, "--pose", small_waving,
                                     "--against-pose", waving, "--report", judged});
  EXPECT_NE(result.out.find(" anywhere in any pose, the most in pose 'small_waving'\n"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("in 1 further pose: they are those of the mesh's own pose"), std::string::npos)
      << result.out;
  EXPECT_EQ(distance(judged)["max_upper"], distance(report)["max_upper"]);
  EXPECT_EQ(distance(judged)["max_pose"], "small_waving");
}

TEST(App_poses, ThatAreNotGuardedAreNamedWhereTheyBreakTheLimit)
{
  const Workspace folder;
  const Triangle_soup flat = sheet(20, 20);
  write_mesh(folder / "flat.obj", flat);
  write_mesh(folder / "above.obj", moved(flat, 0, 0, 100));
  write_mesh(folder / "below.obj", moved(flat, 0, 0, -100));
  write_mesh(folder / "hill.obj", mapped(flat, [](const Point_3& p) {
               return Point_3(p.x(), p.y(), p.x() == 9 && p.y() == 11 ? 4 : 0);
             }));
  std::vector<std::string> arguments{"simplify",         folder / "flat.obj", "-o",
                                     folder / "out.obj", "--error",           "0.01"};
  for (const char* name : {"above.obj", "below.obj", "hill.obj"})
    arguments.insert(arguments.end(), {"--pose", folder / name});
  const App_result all = run_app(arguments);
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(all.out.find("\nlimit: "), std::string::npos) << all.out;
  arguments.insert(arguments.end(), {"--key-poses", "auto"});
  const App_result some = run_app(arguments);
  EXPECT_NE(
      some.out.find("; the most in pose 'hill'\nlimit: 1 % holds in the mesh's own pose and in 2 others, "),
      std::string::npos)
      << some.out;
}

TEST_F(Waving_sheets, AreGuardedInKeyPosesAndJudgedInAll)
{
  // Of four poses, two are chosen at first: those farthest from each other.
  const std::vector<std::string> poses{
      "--pose", folder / "flat.obj", "--pose", folder / "waving.obj", "--morphs",
      "--pose", folder / "half.obj"};
  const Triangle_soup flat = read_mesh(folder / "flat.obj").soup,
                      waving = read_mesh(folder / "waving.obj").soup;
  Triangle_soup half = flat;
  for (std::size_t v = 0; v < half.points.size(); ++v)
    half.points[v] = v % 2 == 0 ? flat.points[v] : waving.points[v];
  write_mesh(folder / "half.obj", half);
  std::vector<std::string> arguments = poses;
  arguments.insert(arguments.end(), {"--key-poses", "auto", "--report", folder / "r.json"});
  simplify(gltf, folder / "small.glb", arguments);
  const auto report = nlohmann::json::parse(contents_of(folder / "r.json"));
  std::size_t guarded = 0;
  for (const auto& pose : report["verified"]["poses"]) {
    guarded += pose["guarded"].get<bool>();
    EXPECT_EQ(pose["new_pairs"], 0) << pose["name"];
  }
  EXPECT_GE(guarded, 2u);
  EXPECT_LT(guarded, 4u);
  std::vector<std::string> replay{"replay", gltf, log};
  replay.insert(replay.end(), poses.begin(), poses.end());
  const App_result replayed = run_app(replay);
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_NE(replayed.out.find("not judged: the log does not name"), std::string::npos) << replayed.out;
}

// The log tells by digests which pose is which, whatever the files are called, and in any order.
TEST_F(Waving_sheets, AreReplayedInThePosesOfTheLogAlone)
{
  const std::string flat = folder / "flat.obj", waving = folder / "waving.obj", small = folder / "small.obj";
  const auto replay = [&](const std::vector<const char*>& names) {
    std::vector<std::string> arguments{"replay", flat, log};
    for (const char* name : names)
      arguments.insert(arguments.end(), {"--pose", folder / name});
    return run_app(arguments);
  };
  Triangle_soup higher = read_mesh(waving).soup;
  for (Point_3& p : higher.points)
    p = Point_3(p.x(), p.y(), p.z() + 1);
  write_mesh(folder / "higher.obj", higher);
  std::filesystem::copy_file(waving, folder / "another_name.obj");

  simplify(flat, small, {"--pose", waving});
  App_result result = replay({"flat.obj", "another_name.obj"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("pose 'another_name': ACCEPTED\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1 further pose not judged: the log does not name 'flat'\n"), std::string::npos)
      << result.out;
  std::filesystem::create_directory(folder / "other"); // a pose of the log's name
  std::filesystem::copy_file(flat, folder / "other/waving.obj");
  for (const std::vector<const char*>& others :
       {std::vector<const char*>{"flat.obj"}, {"other/waving.obj"}}) {
    result = replay(others);
    EXPECT_EQ(result.code, 3) << result.out;
    EXPECT_NE(result.err.find("none of the poses given is the pose 'waving' that the log names"),
              std::string::npos)
        << result.err;
  }

  simplify(flat, small, {"--pose", waving, "--pose", folder / "higher.obj"});
  result = replay({"higher.obj", "another_name.obj"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out.find("not judged: the log"), std::string::npos) << result.out;
  EXPECT_EQ(replay({"waving.obj"}).code, 3);
  EXPECT_EQ(replay({}).code, 0) << "its verdict names the poses as not judged";

  simplify(flat, small, {});
  result = replay({"waving.obj"});
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("the log names no further pose"), std::string::npos) << result.err;
}

TEST_F(Waving_sheets, ComeOutInEveryPose)
{
  simplify(folder / "flat.obj", folder / "of_files.obj",
           {"--pose", folder / "waving.obj", "--poses-out", folder / "{pose}_of_{pose}.obj"});
  simplify(gltf, folder / "of_gltf.obj", {"--morphs", "--poses-out", folder / "{pose}.obj"});
  const auto points = [&](const char* name) { return read_mesh(folder / name).soup.points; };
  EXPECT_EQ(points("of_files.obj"), points("of_gltf.obj"));
  EXPECT_EQ(points("waving_of_waving.obj"), points("up_waves.obj")) << "a slash is no folder";
  EXPECT_NE(points("up_waves.obj"), points("of_gltf.obj"));
}

TEST_F(Waving_sheets, ComeOutAsOneAnimation)
{
  const std::vector<std::string> poses{"--pose", folder / "waving.obj", "--pose", folder / "flat.obj"};
  for (const std::string& name : {folder / "poses.glb", folder / "poses.pc2"}) {
    std::vector<std::string> arguments = poses;
    arguments.insert(arguments.end(), {"--poses-out", name});
    simplify(folder / "flat.obj", folder / "small.obj", arguments);
  }
  const Triangle_soup small = read_mesh(folder / "small.obj").soup,
                      shown = read_mesh(folder / "poses.glb").soup;
  EXPECT_EQ(shown.points, small.points);
  EXPECT_EQ(shown.triangles, small.triangles);
  const std::vector<Pose> keys = animation_poses(shown, "poses", 1, "poses.glb"),
                          frames = read_point_cache(folder / "poses.pc2", small);
  ASSERT_EQ(keys.size(), 2u);
  for (const std::size_t key : {0, 1})
    EXPECT_EQ(keys[key].points, frames[key].points);
  EXPECT_NE(keys[0].points, shown.points);
  EXPECT_EQ(keys[1].points, shown.points);
  EXPECT_EQ(run_app({"verify", folder / "poses.glb", "--animation", "all"}).code, 0);
  // So do several nodes.
  Triangle_soup parts = small;
  parts.poses = frames;
  for (std::size_t t = 0; t < parts.triangles.size(); ++t)
    parts.groups.of_triangle.push_back(Index(t % 2));
  parts.groups.names = {"a", "b"};
  write_gltf_poses(folder / "parts.gltf", parts);
  Triangle_soup again = read_mesh(folder / "parts.gltf").soup;
  again.poses = animation_poses(again, "poses", 1, "parts.gltf");
  for (std::size_t v = 0; v < again.points.size(); ++v) {
    const std::size_t of_small = std::size_t(
        std::find(small.points.begin(), small.points.end(), again.points[v]) - small.points.begin());
    ASSERT_LT(of_small, small.points.size());
    EXPECT_EQ(again.poses[0].points[v], frames[0].points[of_small]);
  }
  EXPECT_EQ(run_app({"simplify", folder / "flat.obj", "-o", folder / "x.obj", "--ratio", "0.5", "--pose",
                     folder / "waving.obj", "--poses-out", folder / "all.obj"})
                .code,
            2); // OBJ holds one pose
}

TEST_F(Waving_sheets, MayBeAnObstacleThatMoves)
{
  // The same sheets below those that wave, and farther below when these reach down.
  Triangle_soup flat = read_mesh(folder / "flat.obj").soup;
  for (const auto& [name, z] : {std::pair("below.obj", -1.), std::pair("farther.obj", -2.)}) {
    Triangle_soup below = flat;
    for (Point_3& p : below.points)
      p = Point_3(p.x(), p.y(), p.z() + z);
    write_mesh(folder / name, below);
  }
  const std::vector<std::string> arguments{"--obstacle", gltf, "--obstacle-animation", "all"};
  std::vector<std::string> one = arguments, two = arguments;
  one.insert(one.end(), {"--pose", folder / "below.obj", "--pose", folder / "farther.obj"});
  std::vector<std::string> replayed{"replay", folder / "below.obj", log};
  replayed.insert(replayed.end(), one.begin(), one.end());
  simplify(folder / "below.obj", folder / "x.obj", one);
  const App_result result = run_app(replayed);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find(", obstacle bound\n"), std::string::npos) << result.out;
  replayed.erase(replayed.begin() + 5, replayed.begin() + 7); // the obstacle stands still
  EXPECT_EQ(run_app(replayed).code, 3);
  two.insert(two.end(), {"simplify", folder / "below.obj", "-o", folder / "x.obj", "--ratio", "0.5", "--pose",
                         folder / "farther.obj"});
  std::rotate(two.begin(), two.begin() + std::ptrdiff_t(arguments.size()), two.end());
  EXPECT_EQ(run_app(two).code, 2); // one pose for two keyframes
  EXPECT_EQ(run_app({"simplify", gltf, "-o", folder / "x.glb", "--ratio", "0.5", "--morphs",
                     "--obstacle-animation", "all"})
                .code,
            2); // there is no obstacle
}

TEST_F(Waving_sheets, OfOtherFilesHaveNoMorphTargets)
{
  for (const std::vector<std::string>& poses :
       {std::vector<std::string>{"--morphs"}, {"--animation", "all"}}) {
    std::vector<std::string> arguments{"simplify",       folder / "flat.obj", "-o",
                                       folder / "x.obj", "--ratio",           "0.5"};
    arguments.insert(arguments.end(), poses.begin(), poses.end());
    const App_result result = run_app(arguments);
    EXPECT_EQ(result.code, 3);
    EXPECT_NE(result.err.find("flat.obj: "), std::string::npos) << result.err;
  }
  EXPECT_EQ(run_app({"simplify", gltf, "-o", folder / "x.glb", "--ratio", "0.5", "--every", "2"}).code, 2);
  EXPECT_EQ(run_app({"simplify", gltf, "-o", folder / "x.glb", "--ratio", "0.5", "--animation", "dive"}).code,
            3);
}

} // namespace
} // namespace selvedge::test
