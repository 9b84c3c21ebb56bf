// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A mesh that is written to another folder refers to the same files as before.

#include "App_run.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace selvedge::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Makes a file in a folder, which is made as well.
void make_file(const fs::path& path)
{
  fs::create_directories(path.parent_path());
  write_text(path, "#\n");
}

std::vector<std::string> libraries_of(const fs::path& mesh)
{
  std::vector<std::string> result;
  std::ifstream stream(mesh);
  for (std::string line; std::getline(stream, line);)
    if (line.rfind("mtllib ", 0) == 0)
      result.push_back(line.substr(7));
  return result;
}

TEST(App_references, OfAnObjLeadToItsMaterialLibraries)
{
  const Workspace folder;
  const fs::path in = folder / "in", out = folder / "out/deep";
  for (const char* name : {"two words.mtl", "a.mtl", "looks/b.mtl"})
    make_file(in / name);
  fs::create_directories(out);
  const std::string mesh = in / "in.obj";
  const std::string plain = contents_of(folder.generate("grid", "in/plain.obj", 200));
  write_text(mesh, "mtllib two words.mtl\nmtllib a.mtl looks/b.mtl\nmtllib /nowhere/c.mtl\n" + plain);

  const App_result moved = run_app({"simplify", mesh, "-o", out / "out.obj", "--ratio", "0.5"});
  EXPECT_EQ(moved.code, 0) << moved.err;
  const std::vector<std::string> libraries = libraries_of(out / "out.obj");
  ASSERT_EQ(libraries.size(), 3u);
  EXPECT_TRUE(fs::equivalent(out / libraries[0], in / "two words.mtl")) << libraries[0];
  const std::size_t blank = libraries[1].find(' ');
  EXPECT_TRUE(fs::equivalent(out / libraries[1].substr(0, blank), in / "a.mtl")) << libraries[1];
  EXPECT_TRUE(fs::equivalent(out / libraries[1].substr(blank + 1), in / "looks/b.mtl")) << libraries[1];
  EXPECT_EQ(libraries[2], "/nowhere/c.mtl");
  EXPECT_NE(
      moved.out.find("\n  files beside the input are named from the output's folder: ../../in/two words.mtl, "
                     "../../in/a.mtl, ../../in/looks/b.mtl\n"),
      std::string::npos)
      << moved.out;

  // In its own folder, by another spelling, a mesh keeps its words.
  const App_result beside = run_app({"simplify", mesh, "-o", folder / "out/../in/out.obj", "--ratio", "0.5"});
  EXPECT_EQ(libraries_of(in / "out.obj"), libraries_of(mesh));
  EXPECT_EQ(beside.out.find("files beside"), std::string::npos) << beside.out;
}

TEST(App_references, OfAGltfLeadToItsImages)
{
  const Workspace folder;
  make_file(folder / "in/my tex/a b.png");
  fs::create_directories(folder / "out");
  const std::string mesh = folder.generate("grid", "in/in.gltf", 200);
  Json document = Json::parse(contents_of(mesh));
  document["images"] = {
      {{"uri", "my%20tex/a%20b.png"}}, {{"uri", "https://somewhere/c.png"}}, {{"uri", "data:,"}}};
  write_text(mesh, document.dump());
  const App_result moved = run_app({"simplify", mesh, "-o", folder / "out/out.gltf", "--ratio", "0.5"});
  EXPECT_EQ(moved.code, 0) << moved.err;
  const Json images = Json::parse(contents_of(folder / "out/out.gltf"))["images"];
  EXPECT_EQ(images[0]["uri"], "../in/my%20tex/a%20b.png");
  EXPECT_EQ(images[1]["uri"], "https://somewhere/c.png");
  EXPECT_EQ(images[2]["uri"], "data:,");
  EXPECT_NE(moved.out.find("output's folder: ../in/my tex/a b.png\n"), std::string::npos) << moved.out;
  for (int i = 0; i < 9; ++i)
    document["images"].push_back({{"uri", "image_" + std::to_string(i) + ".png"}});
  write_text(mesh, document.dump());
  const App_result listed = run_app({"simplify", mesh, "-o", folder / "out/out.gltf", "--ratio", "0.5"});
  EXPECT_NE(listed.out.find(", ../in/image_3.png and 5 more\n"), std::string::npos) << listed.out;
  // Where nothing moves, nothing changes.
  run_app({"simplify", mesh, "-o", folder / "in/out.gltf", "--ratio", "0.5"});
  EXPECT_EQ(Json::parse(contents_of(folder / "in/out.gltf"))["images"], document["images"]);
}

TEST(App_references, OfEveryOtherMeshThatIsWrittenLeadThereToo)
{
  const Workspace folder;
  const fs::path in = folder / "in", out = folder / "out", deep = folder / "poses/deep";
  make_file(in / "a.mtl");
  fs::create_directories(out);
  fs::create_directories(deep);
  const std::string mesh = in / "in.obj", log = folder / "run.log";
  write_text(mesh, "mtllib a.mtl\n" + contents_of(folder.generate("grid", "in/in.obj", 200)));
  fs::copy_file(mesh, in / "pose_1.obj");
  const auto leads = [&](const fs::path& written) {
    const std::vector<std::string> libraries = libraries_of(written);
    return libraries.size() == 1 && fs::equivalent(written.parent_path() / libraries[0], in / "a.mtl");
  };
  const auto simplify = [&](const std::string& output) {
    const App_result result =
        run_app({"simplify", mesh, "-o", output, "--ratio", "0.5", "--pose", in / "pose_1.obj", "--poses-out",
                 deep / "{pose}.obj", "--log", log, "--quiet"});
    EXPECT_EQ(result.code, 0) << result.err;
  };
  simplify(out / "out.obj");
  EXPECT_TRUE(leads(out / "out.obj"));
  EXPECT_TRUE(leads(deep / "pose_1.obj"));
  simplify(out / "out.ply"); // names no libraries, so that poses name them as the input does
  EXPECT_TRUE(leads(deep / "pose_1.obj"));
  const App_result replayed =
      run_app({"replay", mesh, log, "-o", deep / "again.obj", "--pose", in / "pose_1.obj"});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_TRUE(leads(deep / "again.obj"));
}

TEST(App_references, OfALevelAndOfAReplayLeadToTheImages)
{
  const Workspace folder;
  const fs::path in = folder / "in", out = folder / "out", deep = folder / "levels/deep";
  make_file(in / "a.png");
  fs::create_directories(out);
  fs::create_directories(deep);
  const std::string mesh = folder.generate("grid", "in/in.gltf", 200);
  Json document = Json::parse(contents_of(mesh));
  document["images"] = {{{"uri", "a.png"}}};
  write_text(mesh, document.dump());
  const std::string log = folder / "run.log", progressive = out / "all.glb";
  const App_result result = run_app({"simplify", mesh, "-o", folder / "out.obj", "--ratio", "0.5", "--log",
                                     log, "--progressive", progressive, "--quiet"});
  EXPECT_EQ(result.code, 0) << result.err;
  const App_result level = run_app({"level", progressive, "--ratio", "0.7", "-o", deep / "level.gltf"});
  EXPECT_EQ(level.code, 0) << level.err;
  const App_result replayed = run_app({"replay", mesh, log, "-o", deep / "again.gltf"});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  for (const char* name : {"level.gltf", "again.gltf"}) {
    const std::string uri = Json::parse(contents_of(deep / name))["images"][0]["uri"];
    EXPECT_TRUE(fs::equivalent(deep / uri, in / "a.png")) << name << ": " << uri;
  }
}

} // namespace
} // namespace selvedge::test
