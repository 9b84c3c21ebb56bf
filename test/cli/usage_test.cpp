// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include <selvedge/mesh_files.h>

#include <sstream>

namespace selvedge::test {
namespace {

TEST(App_usage, HelpTeachesByExample)
{
  for (const char* command : {"", "simplify", "verify", "info", "replay", "generate", "cells"}) {
    std::vector<std::string> arguments{"--help"};
    if (*command)
      arguments.insert(arguments.begin(), command);
    const App_result result = run_app(arguments);
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_NE(result.out.find(std::string("  selvedge ") + command), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("Examples:"), std::string::npos) << result.out;
  }
}

TEST(App_usage, ManualPageAndCompletionsHaveEveryOption)
{
  const std::string manual = run_app({"--man"}).out;
  std::vector<std::string> scripts{manual};
  for (const char* shell : {"bash", "zsh", "fish"})
    scripts.push_back(run_app({"--completion", shell}).out);
  EXPECT_EQ(run_app({"--completion", "tcsh"}).code, 2);
  for (const char* command : {"simplify", "verify", "info", "replay", "generate", "cells"}) {
    std::istringstream help(run_app({command, "--help"}).out);
    std::size_t options = 0;
    for (std::string line; std::getline(help, line);) {
      if (line.rfind("  -", 0) != 0)
        continue;
      const std::size_t begin = line.find("--") + 2;
      const std::string name = line.substr(begin, line.find(' ', begin) - begin);
      std::string escaped;
      for (const char c : "--" + name)
        escaped += c == '-' ? "\\-" : std::string(1, c);
      EXPECT_NE(scripts[0].find(escaped), std::string::npos) << name;
      EXPECT_NE(scripts[1].find("--" + name), std::string::npos) << name;
      EXPECT_NE(scripts[2].find("--" + name), std::string::npos) << name;
      EXPECT_NE(scripts[3].find("-l " + name), std::string::npos) << name;
      ++options;
    }
    EXPECT_GT(options, 3u);
  }
}

TEST(App_usage, EmptyValuesAreRefusedWithWhatTheyMayBe)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 200), out = folder / "out.obj";
  for (const auto& [option, values] : {std::pair("--weld", "EPS|auto|hold|none"),
                                       std::pair("--error", "E|none"),
                                       std::pair("--ratio", "[PART=]R"),
                                       std::pair("--faces", "N"),
                                       std::pair("--lods", "R,R"),
                                       std::pair("--placement", "auto|vertices|optimal"),
                                       std::pair("--weights", "NAME"),
                                       std::pair("--lock", "PART"),
                                       std::pair("--keep", "PART"),
                                       std::pair("--may-intersect", "PART:PART"),
                                       std::pair("--drop-attribute", "NAME"),
                                       std::pair("--drop-part", "PART"),
                                       std::pair("--drop-smaller", "LENGTH"),
                                       std::pair("--obstacle", "FILE"),
                                       std::pair("--pose", "FILE|PATTERN"),
                                       std::pair("--animation", "NAME|all"),
                                       std::pair("--obstacle-animation", "NAME|all"),
                                       std::pair("--poses-out", "PATTERN"),
                                       std::pair("--threads", "N"),
                                       std::pair("--report", "FILE"),
                                       std::pair("--log", "FILE"),
                                       std::pair("--html", "FILE"),
                                       std::pair("--progressive", "FILE"),
                                       std::pair("--output", "FILE")}) {
    std::vector<std::string> arguments{"simplify", in, "-o", out, "--ratio", "0.5", option, ""};
    if (option == std::string("--output"))
      arguments.erase(arguments.begin() + 2, arguments.begin() + 4);
    expect_refused(arguments, 2,
                   std::string(option) + ": the value is empty; give " + values + " (see selvedge simplify");
  }
  expect_refused({"simplify", in, "-o", out, "--weld=", "--ratio", "0.5"}, 2,
                 "--weld: the value is empty; give EPS|auto|hold|none");
  expect_refused({"simplify", "", "-o", out, "--ratio", "0.5"}, 2, "IN: the value is empty; give a name");
  expect_refused({"verify", in, "--against", ""}, 2, "--against: the value is empty; give FILE");
  expect_refused({"replay", in, ""}, 2, "LOG: the value is empty; give a name");
  expect_refused({"cells", "cut", in, "-o", ""}, 2, "--output: the value is empty; give ");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(App_usage, VersionIsTheProjects)
{
  EXPECT_EQ(run_app({"--version"}).out, "selvedge " SELVEDGE_VERSION "\n");
}

TEST(App_usage, RefusesWhatMakesNoSense)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 200);
  const std::string out = folder / "out.obj";
  const std::pair<std::vector<std::string>, const char*> senseless[] = {
      {{}, "subcommand"},
      {{"shrink"}, "there is no subcommand 'shrink' (see"},
      {{"simplfy", in}, "did you mean 'simplify'?"},
      {{"inof", in}, "did you mean 'info'?"},
      {{"simplify", in, "-o", out, "--rato", "0.5"}, "did you mean '--ratio'?"},
      {{"simplify", in, "-o", out, "--rato=0.25"}, "no option '--rato'; did you mean '--ratio'?"},
      {{"simplify", "-x.obj", "-o", out, "--ratio", "0.5"}, "there is no option '-x.obj'; a file"},
      {{"simplify", "--", "-x.obj", "-o", out}, "--output is required"},
      {{"simplify", in, "-o", out, "\u2013ratio", "0.5"}, "'\u2013ratio' begins with a long dash"},
      {{"simplify", "my", "mesh.obj", "-o", out, "--ratio", "0.5"}, "'mesh.obj' is not expected here; names"},
      {{"simplify", in}, "--output"},
      {{"simplify", "-o", out, "--ratio", "0.5"}, "IN"},
      {{"simplify", in, "-o", out}, "--ratio"},
      {{"simplify", in, "-o", out, "--ratio", "1.5"}, "--ratio"},
      {{"simplify", in, "-o", out, "--ratio", "nan"}, "--ratio"},
      {{"simplify", in, "-o", out, "--ratio", "half"}, "--ratio"},
      {{"simplify", in, "-o", out, "--ratio", "30%"}, "'30%' is not a number from 0 to 1; did you mean 0.3?"},
      {{"simplify", in, "-o", out, "--ratio", "30"}, "did you mean 0.3?"},
      {{"simplify", in, "-o", out, "--ratio", "0,3"}, "did you mean 0.3?"},
      {{"simplify", in, "-o", out, "--lods", "50%,25%"}, "did you mean 0.5?"},
      {{"simplify", in, "-o", out, "--ratio"}, "--ratio"},
      {{"simplify", in, "-o", out, "--faces", "-1"}, "--faces"},
      {{"simplify", in, "-o", out, "--faces", "1.5"}, "--faces"},
      {{"simplify", in, "-o", out, "--faces", "1e30"}, "--faces"},
      {{"simplify", in, "-o", out, "--faces", "20,5"}, "--faces"},
      {{"simplify", in, "-o", out, "--faces", "1,00"}, "--faces"},
      {{"simplify", in, "-o", folder / "{lod}.obj", "--ratio", "0.5"}, "--lods"},
      {{"simplify", in, "-o", out, "--lods", "0.5,0.2"}, "only .glb and .gltf files hold all levels in one"},
      {{"verify", in, "--lod", "0"}, "--lod"},
      {{"info", in, "--lod", "1.5"}, "--lod"},
      {{"generate", "grid", "-o", out, "--faces", "-5"}, "--faces"},
      {{"generate", "grid", "-o", out, "--seed", "-5"}, "--seed"},
      {{"simplify", in, "-o", out, "--error", "-1"}, "--error"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--normal-change", "181"}, "--normal-change"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--aspect-ratio", "2"}, "--aspect-ratio"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--border-turn", "-8"}, "--border-turn"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--corner-height", "-1"}, "--corner-height"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--seam-turn", "999"}, "--seam-turn"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--border-drift", "-1"}, "--border-drift"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--clearance", "0"},
       "--clearance: '0' is not a positive number"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--clearance", "inf"}, "--clearance"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--clearance", "1", "--cells"}, "or --cells"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--clearance", "1", "--weld", "auto"}, "or --weld"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--clearance", "1", "--weld", "0.1"}, "or --weld"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--clearance", "1", "--may-intersect", "a:b"},
       "or --may-intersect"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--clearance", "1", "--no-intersection-check"},
       "or --no-intersection-check"},
      {{"verify", in, "--clearance", "-1"}, "--clearance"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--cluster-size", "0"}, "--cluster-size"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--index", "none"},
       "--index: 'none' is none of clusters, packed"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--stabiliser", "-1"}, "--stabiliser"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--memory", "2"}, "--memory"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--border-weight", "x"}, "--border-weight"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--threads", "0"}, "--threads"},
      {{"verify", in, "--threads", "-1"}, "--threads"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--cells", "--ratio", "part=0.2"}, "--cells"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--wish"}, "--wish"},
      {{"simplify", in, "-o", folder / "out.xyz", "--ratio", "0.5"},
       "choose a name with one of these endings"},
      {{"simplify", in, "-o", folder / ".", "--ratio", "0.5"}, "is a folder; name a mesh file in it"},
      {{"simplify", folder / "absent.obj", "-o", folder / "out.xyz", "--ratio", "0.5"},
       "out.xyz"}, // before any work
      {{"simplify", in, "-o", folder / "a.vrm", "--ratio", "0.5"}, "a.vrm: a .vrm file holds a VRM avatar"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--progressive", folder / "a.vrm"}, "a.vrm"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--pose", in, "--poses-out", folder / "{pose}.vrm"},
       "{pose}.vrm"},
      {{"generate", "grid", "-o", folder / "a.vrm"}, "a.vrm"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--report", out}, "--report"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--report", in}, "--report and IN"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--log", in}, "--log and IN"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--html", in}, "--html"},
      {{"verify", in, "--html", in}, "--html"},
      {{"replay", in, "log", "--html", in}, "--html"},
      {{"simplify", in, "-o", in, "--ratio", "0.5", "--obstacle", in}, "--output and --obstacle"},
      {{"replay", in, "log", "-o", in}, "--output and ORIGINAL"},
      {{"verify", in, "--report", in}, "--report and MESH"},
      {{"verify"}, "MESH"},
      {{"verify", in, "--json", "--report", folder / "r.json"}, "--json"}};
  for (const auto& [arguments, what] : senseless)
    expect_refused(arguments, 2, what);
  EXPECT_EQ(folder.files(), 1u);
}

// An option that changes nothing beside the others is a mistake.
TEST(App_usage, RefusesWhatWouldDoNothing)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 200),
                    scene = folder.generate("grid", "in.glb", 200);
  const std::string out = folder / "out.obj", glb = folder / "out.glb", log = folder / "in.log";
  ASSERT_EQ(
      run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--log", log, "--placement", "vertices"}).code,
      0);
  const std::size_t files = folder.files();
  const char* const ascii = "--ascii: no mesh is written that can be text";
  const std::pair<std::vector<std::string>, const char*> idle[] = {
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--cluster-size", "50"}, "or give --index clusters"},
      {{"simplify", in, "-o", out, "--ratio", "0.5", "--border-turn", "180", "--normal-change", "180",
        "--corner-height", "0"},
       "--corner-height: with such a --border-turn"},
      {{"simplify", in, "-o", folder / "out.stl", "--ratio", "0.5", "--sewn"}, "--sewn: an STL file"},
      {{"simplify", in, "-o", glb, "--lods", "1,0.5", "--ascii"}, ascii},
      {{"simplify", in, "-o", glb, "--ratio", "0.5", "--instances", "shared"}, "in.obj is of another format"},
      {{"simplify", scene, "-o", out, "--ratio", "0.5", "--instances", "shared"},
       "the output is of another format"},
      {{"replay", in, log, "--ascii"}, ascii},
      {{"replay", in, log, "-o", glb, "--ascii"}, ascii},
      {{"level", scene, "-o", glb, "--ratio", "0.5", "--ascii"}, ascii},
      {{"generate", "skirt", "-o", glb, "--ascii"}, ascii},
      {{"generate", "--list", "-o", out}, "leave it out, or --output"},
      {{"generate", "--list", "skirt"}, "leave it out, or NAME"},
      {{"generate", "sheets", "-o", out, "--thickness", "0"},
       "--thickness: changes nothing in the scene 'sheets'"}};
  for (const auto& [arguments, what] : idle)
    expect_refused(arguments, 2, what);
  EXPECT_EQ(folder.files(), files);
  const std::vector<std::string> of_use[] = {
      {"simplify", in, "-o", out, "--ratio", "0.5", "--cluster-size", "50", "--index", "clusters"},
      {"simplify", in, "-o", out, "--ratio", "0.5", "--border-turn", "180", "--corner-height", "0"},
      {"simplify", in, "-o", folder / "out.off", "--ratio", "0.5", "--sewn"},
      {"simplify", in, "-o", out, "--ratio", "0.5", "--ascii"},
      {"simplify", scene, "-o", out, "--ratio", "0.5", "--instances", "apart"},
      {"simplify", in, "-o", folder / "out.ply.gz", "--ratio", "0.5", "--ascii"},
      {"simplify", in, "-o", out, "--ratio", "0.5", "--pose", in, "--poses-out", folder / "{pose}.stl",
       "--ascii"},
      {"simplify", scene, "-o", glb, "--ratio", "0.5", "--instances", "apart"}};
  for (const std::vector<std::string>& arguments : of_use)
    EXPECT_EQ(run_app(arguments).code, 0) << arguments.back();
}

TEST(App_usage, RequiresATargetThatIsGiven)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 200), out = folder / "out.obj";
  expect_refused({"simplify", in, "-o", out, "--error", "0.01", "--require-target"}, 2,
                 "give --ratio or --faces");
  EXPECT_EQ(
      run_app({"simplify", in, "-o", out, "--error", "0.01", "--faces", "100", "--require-target"}).code, 0);
}

TEST(App_usage, PutsTheNumberOfTheLevelInPlaceOfEveryMark)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 200);
  std::filesystem::create_directory(folder / "level_1");
  std::filesystem::create_directory(folder / "level_2");
  EXPECT_EQ(run_app({"simplify", in, "-o", folder / "level_{lod}/grid_{lod}.obj", "--lods", "0.5,0.25"}).code,
            0);
  EXPECT_TRUE(std::filesystem::exists(folder / "level_1/grid_1.obj"));
  EXPECT_TRUE(std::filesystem::exists(folder / "level_2/grid_2.obj"));
}

TEST(App_usage, SeesThatTwoNamesAreOneNewFile)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 200);
  const std::string out = folder / "out.obj";
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::create_symlink("out.obj", folder / "link.obj");
  for (const std::string& other :
       {folder / "./out.obj", folder / "link.obj", std::filesystem::relative(out, here).string()})
    for (const char* option : {"--report", "--log"})
      expect_refused({"simplify", in, "-o", out, "--ratio", "0.5", option, other}, 2,
                     std::string(option) + " and --output name the same file");
  EXPECT_FALSE(std::filesystem::exists(out));
  // A device is no file that could be lost.
  EXPECT_EQ(run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--report", "/dev/null", "--log",
                     "/dev/null", "--quiet"})
                .code,
            0);
}

TEST(App_usage, ReadsWholeNumbersAsPeopleWriteThem)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 4000);
  const std::string out = folder / "out.obj";
  for (const char* number : {"1e3", "1,000", "1000"}) {
    EXPECT_EQ(run_app({"simplify", in, "-o", out, "--faces", number, "--quiet"}).code, 0);
    EXPECT_NEAR(double(read_mesh(out).soup.triangles.size()), 1000, 2) << number;
  }
}

TEST(App_usage, RefusesAPlaceThatCannotBeWrittenBeforeAnyWork)
{
  const Workspace folder;
  write_text(folder / "file", "");
  std::filesystem::create_directory(folder / "folder.obj");
  // The input does not exist: that these end with 4 shows what was looked at first.
  const std::string in = folder / "absent.obj";
  for (const char* name : {"none/out.obj", "file/out.obj", "folder.obj"})
    expect_refused({"simplify", in, "-o", folder / name, "--ratio", "0.5"}, 4, name);
  expect_refused({"simplify", in, "-o", folder / "a.obj", "--ratio", "0.5", "--report", folder / "none/r"}, 4,
                 "none/r");
  expect_refused({"generate", "grid", "-o", folder / "none/out.obj"}, 4, "none/out.obj");
  std::filesystem::create_directory(folder / "meshes");
  expect_refused({"info", folder / "meshes"}, 3, "meshes: is a folder");
}

} // namespace
} // namespace selvedge::test
