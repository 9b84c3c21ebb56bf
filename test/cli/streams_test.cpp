// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// "-" is standard input or output, a name in .gz is a packed file, and polygons come out as they were.

#include "App_run.h"

#include <selvedge/mesh_files.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace selvedge::test {
namespace {

using Json = nlohmann::json;

/// Runs a line of the shell in which $S is the app; messages go to a file. Returns the exit code.
int run_line(const Workspace& folder, const std::string& line)
{
  write_text(folder / "line.sh",
             "set -o pipefail\ncd '" + folder / "" + "'\nS='" + path_of_app() + "'\n" + line + '\n');
  return WEXITSTATUS(std::system(("bash '" + folder / "line.sh" + "'").c_str()));
}

TEST(App_streams, GiveTheMeshThatFilesGive)
{
  const Workspace folder;
  for (const std::string format : {"obj", "off", "ply", "stl", "glb", "gltf"}) {
    SCOPED_TRACE(format);
    const std::string in = folder.generate("skirt", "in." + format, 1000);
    const std::string out = folder / ("out." + format);
    ASSERT_EQ(run_app({"simplify", in, "-o", out, "--ratio", "0.3", "--quiet"}).code, 0);
    EXPECT_EQ(run_line(folder, "cat in." + format + " | $S simplify - -o - --ratio 0.3 --format " + format +
                                   " > piped 2> messages"),
              0)
        << contents_of(folder / "messages");
    EXPECT_TRUE(contents_of(folder / "piped") == contents_of(out));
    EXPECT_NE(contents_of(folder / "messages").find("standard input: "), std::string::npos);
    // Redirected, not piped; one of the two a file.
    EXPECT_EQ(run_line(folder, "$S simplify - -o direct." + format + " --ratio 0.3 --quiet --format " +
                                   format + " < in." + format),
              0);
    EXPECT_TRUE(contents_of(folder / ("direct." + format)) == contents_of(out));
  }
}

TEST(App_streams, CarryAMeshThroughAllSubcommands)
{
  const Workspace folder;
  EXPECT_EQ(run_line(folder, "$S generate skirt -o - --faces 1000 --format ply 2> messages > skirt.ply"), 0);
  EXPECT_NE(contents_of(folder / "messages").find("free of intersections"), std::string::npos);
  EXPECT_EQ(
      run_line(
          folder,
          "$S simplify skirt.ply -o - --ratio 0.4 --placement vertices --log steps.log "
          "--format ply --quiet | tee small.ply | $S verify - --against skirt.ply --format ply > verdict"),
      0);
  EXPECT_NE(contents_of(folder / "verdict").find("standard input: "), std::string::npos);
  EXPECT_EQ(run_line(folder, "$S info - --format ply --json < small.ply > info.json"), 0);
  EXPECT_EQ(Json::parse(contents_of(folder / "info.json"))["input"]["triangles"],
            read_mesh(folder / "small.ply").soup.triangles.size());
  EXPECT_EQ(run_line(folder, "$S replay - steps.log -o - --format ply < skirt.ply > again.ply 2> verdict"),
            0);
  EXPECT_NE(contents_of(folder / "verdict").find("input bound"), std::string::npos);
  EXPECT_TRUE(contents_of(folder / "again.ply") == contents_of(folder / "small.ply"));
  // A log of the run on standard input is bound to its bytes, and may itself come from there.
  EXPECT_EQ(run_line(folder, "$S simplify - -o b.ply --ratio 0.4 --log - --quiet --format ply < skirt.ply | "
                             "$S replay skirt.ply - --report - 2> verdict > report.json"),
            0);
  EXPECT_NE(contents_of(folder / "verdict").find("ACCEPTED"), std::string::npos);
  EXPECT_EQ(Json::parse(contents_of(folder / "report.json"))["exit_code"], 0);
}

TEST(App_streams, GetNothingThatWasNotAccepted)
{
  const Workspace folder;
  folder.generate("skirt", "in.obj", 2000);
  // Output without a mesh: the input is cut off.
  EXPECT_EQ(
      run_line(folder, "head -c 30000 in.obj | $S simplify - -o - --ratio 0.3 --format ply > out 2> err"), 3);
  EXPECT_EQ(contents_of(folder / "out"), "");
  EXPECT_EQ(contents_of(folder / "err").rfind("selvedge: standard input", 0), 0u);
  EXPECT_EQ(run_line(folder, "$S simplify in.obj -o - --ratio 0.3 --format obj > /dev/full 2> err"), 4);
}

TEST(App_streams, AreRefusedWhereTheyMakeNoSense)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 200);
  const std::pair<std::vector<std::string>, const char*> senseless[] = {
      {{"simplify", in, "-o", "-", "--ratio", "0.5"}, "give --format"},
      {{"simplify", "-", "-o", "out.obj", "--ratio", "0.5"}, "give --format"},
      {{"verify", "-"}, "give --format"},
      {{"info", "-"}, "give --format"},
      {{"generate", "grid", "-o", "-"}, "give --format"},
      {{"info", in, "--format", "obj"}, "--format is for a mesh that is -"},
      {{"info", "-", "--format", "fbx"}, "--format"},
      {{"verify", "-", "--against", "-", "--format", "obj"}, "MESH and --against are both standard input"},
      {{"simplify", "-", "-o", "-", "--ratio", "0.5", "--obstacle", "-", "--format", "obj"},
       "IN and --obstacle are both standard input"},
      {{"replay", "-", "-", "--format", "obj"}, "ORIGINAL and LOG are both standard input"},
      {{"replay", in, "log", "-o", "-", "--json", "--format", "obj"},
       "--output and --json are both standard output"},
      {{"simplify", in, "-o", "-", "--ratio", "0.5", "--report", "-", "--format", "obj"},
       "--output and --report are both standard output"},
      {{"simplify", in, "-o", "-", "--lods", "0.5,0.2", "--format", "obj"}, "{lod}"}};
  for (const auto& [arguments, what] : senseless)
    expect_refused(arguments, 2, what);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(App_packed, FilesAreReadAndWrittenEverywhere)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj.gz", 1000);
  const std::string out = folder / "out.ply.gz", log = folder / "steps.log.gz", report = folder / "r.json.gz";
  const App_result result = run_app({"simplify", in, "-o", out, "--ratio", "0.4", "--placement", "vertices",
                                     "--log", log, "--report", report});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(run_app({"verify", out, "--against", in}).code, 0);
  EXPECT_EQ(run_app({"info", out}).code, 0);
  EXPECT_EQ(Json::parse(read_file(report))["output"]["path"], out);
  const App_result replayed = run_app({"replay", in, log, "-o", folder / "again.ply"});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_TRUE(contents_of(folder / "again.ply") == read_file(out));
  write_text(folder / "cut.obj.gz", contents_of(in).substr(0, 1000));
  expect_refused({"info", folder / "cut.obj.gz"}, 3, "truncated");
}

/// How many faces of an OBJ file have more than three corners.
std::size_t polygons_in(const std::string& path)
{
  std::istringstream lines(contents_of(path));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);)
    count += line.rfind("f ", 0) == 0 && std::count(line.begin(), line.end(), ' ') > 3;
  return count;
}

TEST(App_polygons, AreKeptCountedAndSplitOnDemand)
{
  const Workspace folder;
  const std::string in = folder / "in.obj", out = folder / "out.obj", log = folder / "steps.log",
                    report = folder / "report.json", again = folder / "again.obj";
  // A wave of 20 x 20 quads.
  std::ostringstream text;
  constexpr int side = 21;
  for (int i = 0; i < side * side; ++i)
    text << "v " << i % side << ' ' << i / side << ' ' << (i % side) * (i % side) / 40.0 << '\n';
  for (int i = 0; i + side + 1 < side * side; ++i)
    if (i % side + 1 < side)
      text << "f " << i + 1 << ' ' << i + 2 << ' ' << i + side + 2 << ' ' << i + side + 1 << '\n';
  write_text(in, text.str());
  const std::vector<std::string> command{"simplify", in,      "-o", out,        "--ratio",
                                         "0.8",      "--log", log,  "--report", report};
  const App_result kept = run_app(command);
  EXPECT_EQ(kept.code, 0) << kept.err;
  const std::size_t count = polygons_in(out);
  EXPECT_GT(count, 0u);
  EXPECT_LT(count, 400u);
  EXPECT_NE(kept.out.find("\npolygons: " + std::to_string(count) +
                          " of 400 faces of more than three corners written as they were\n"),
            std::string::npos)
      << kept.out;
  EXPECT_EQ(Json::parse(contents_of(report))["output"]["polygons"], count);
  EXPECT_EQ(run_app({"verify", out, "--against", in}).code, 0);
  EXPECT_EQ(run_app({"replay", in, log, "-o", again}).code, 0);
  EXPECT_TRUE(contents_of(again) == contents_of(out));
  const auto triangles = read_mesh(out).soup.triangles;

  std::vector<std::string> split = command;
  split.insert(split.end(), {"--polygons", "split"});
  EXPECT_EQ(run_app(split).code, 0);
  EXPECT_EQ(polygons_in(out), 0u);
  EXPECT_TRUE(read_mesh(out).soup.triangles == triangles);
  EXPECT_EQ(Json::parse(contents_of(report))["output"]["polygons"], 0);
  EXPECT_EQ(run_app({"replay", in, log, "-o", again, "--polygons", "split"}).code, 0);
  EXPECT_TRUE(contents_of(again) == contents_of(out));
}

} // namespace
} // namespace selvedge::test
