// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Progressive files and their levels, as a user makes them.

#include "App_run.h"

#include <selvedge/mesh_files.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace selvedge::test {
namespace {

class Progressive_file : public ::testing::Test
{
protected:
  // A small jacket, its reduction to 30 % and, in the progressive file, all on the way.
  void SetUp() override
  {
    run({"simplify", in, "-o", folder / "least.glb", "--ratio", "0.3", "--progressive", file, "--report",
         folder / "report.json"});
  }

  App_result run(const std::vector<std::string>& arguments) const
  {
    App_result result = run_app(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return result;
  }

  static std::vector<Point_3> corners(const std::string& name)
  {
    const Triangle_soup soup = read_mesh(name).soup;
    std::vector<Point_3> result;
    for (const Index_triple& triangle : soup.triangles)
      for (const Index v : triangle)
        result.push_back(soup.points[v]);
    return result;
  }

  const Workspace folder;
  const std::string in = folder.generate("jacket", "in.obj", 2000), file = folder / "jacket.glb",
                    out = folder / "out.glb";
};

TEST_F(Progressive_file, ALevelIsWhatSimplifyWrites)
{
  const nlohmann::json report = nlohmann::json::parse(contents_of(folder / "report.json"));
  EXPECT_EQ(report["progressive"]["path"], file);
  EXPECT_EQ(report["progressive"]["least_faces"], corners(folder / "least.glb").size() / 3);
  const App_result least = run({"level", file, "--ratio", "0.3", "-o", out});
  EXPECT_NE(least.out.find("each of which was judged"), std::string::npos) << least.out;
  EXPECT_EQ(corners(out), corners(folder / "least.glb"));
  run({"simplify", in, "-o", folder / "alone.glb", "--faces", "1500", "--quiet", "--placement", "vertices"});
  EXPECT_EQ(run({"level", file, "--faces", "1500", "-o", out, "--quiet"}).out, "");
  EXPECT_EQ(corners(out), corners(folder / "alone.glb"));
  run({"verify", out, "--against", file});
  run({"level", file, "--faces", "1500", "-o", folder / "out.obj"});
  EXPECT_EQ(corners(folder / "out.obj"), corners(out));
  EXPECT_NE(run({"level", file, "--faces", "1", "-o", out}).out.find("no level of fewer faces"),
            std::string::npos);
}

TEST_F(Progressive_file, TheProgramOfTheManualMakesTheSameLevel)
{
  const std::string page = contents_of(std::string(SELVEDGE_SOURCES) + "/docs/progressive.md");
  const std::string mark = "```python\n";
  const std::size_t begin = page.find(mark) + mark.size();
  write_text(folder / "reader.py", page.substr(begin, page.find("```", begin) - begin));
  write_text(folder / "sum.py",
             "import reader, sys\n"
             "print(sum(len(t) for _, t in reader.level(*reader.read(sys.argv[1]), int(sys.argv[2]))))\n");
  const std::string count = folder / "count";
  ASSERT_EQ(std::system(("python3 -B " + folder / "sum.py").append(" " + file + " 1500 > " + count).c_str()),
            0);
  run({"level", file, "--faces", "1500", "-o", out});
  EXPECT_EQ(std::stoul(contents_of(count)), corners(out).size() / 3);
}

TEST_F(Progressive_file, ALevelHasThePosesOfTheRun)
{
  run({"generate", "skirt", "-o", folder / "skirt.obj", "--faces", "2000", "--layers", "1", "--poses", "1",
       "--poses-out", folder / "skirt_{pose}.obj", "--quiet"});
  run({"simplify", folder / "skirt.obj", "-o", out, "--ratio", "0.5", "--pose", folder / "skirt_1.obj",
       "--poses-out", folder / "run_{pose}.glb", "--progressive", folder / "skirt.glb", "--quiet"});
  run({"level", folder / "skirt.glb", "--ratio", "0.5", "-o", folder / "level.glb", "--poses-out",
       folder / "level_{pose}.glb"});
  EXPECT_EQ(corners(folder / "level_skirt_1.glb"), corners(folder / "run_skirt_1.glb"));
  EXPECT_NE(corners(folder / "level_skirt_1.glb"), corners(folder / "level.glb"));
  expect_refused(
      {"level", folder / "skirt.glb", "--ratio", "0.5", "-o", out, "--poses-out", folder / "a.obj"}, 2,
      "must contain {pose}");
  expect_refused({"level", file, "--ratio", "0.5", "-o", out, "--poses-out", folder / "a_{pose}.obj"}, 2,
                 "holds no poses");
}

TEST_F(Progressive_file, OfMorphsSaysThatItsLevelsHaveThem)
{
  run({"generate", "skirt", "-o", folder / "skirt.obj", "--faces", "1000", "--layers", "1", "--poses", "1",
       "--poses-out", folder / "skirt_{pose}.obj", "--quiet"});
  const std::string morphs = folder / "morphs.glb"; // the pose as a morph target, and an animation of it
  run({"simplify", folder / "skirt.obj", "-o", out, "--ratio", "1", "--pose", folder / "skirt_1.obj",
       "--poses-out", morphs, "--quiet"});
  run({"simplify", morphs, "-o", out, "--ratio", "0.5", "--morphs", "--progressive",
       folder / "progressive.glb", "--quiet"});
  expect_refused(
      {"level", folder / "progressive.glb", "--ratio", "0.5", "-o", out, "--poses-out",
       folder / "a_{pose}.obj"},
      2,
      "--poses-out: the file holds no poses of other files, but morph targets and animations, which "
      "its levels have themselves: leave the option out, and write the level to a .glb file");
  run({"level", folder / "progressive.glb", "--ratio", "0.5", "-o", out, "--quiet"});
  EXPECT_EQ(run_app({"verify", out, "--against", folder / "progressive.glb", "--morphs"}).code, 0);
}

TEST_F(Progressive_file, WhatCannotBeIsRefused)
{
  const std::vector<std::string> simplify{"simplify", in, "-o", out, "--ratio", "0.5", "--progressive"};
  const auto expect_no = [&](std::vector<std::string> arguments, const std::string& what) {
    arguments.insert(arguments.begin(), simplify.begin(), simplify.end());
    expect_refused(arguments, 2, what);
  };
  expect_no({folder / "a.obj"}, "ends in .glb");
  expect_no({out}, "the same file");
  expect_no({folder / "a.glb", "--placement", "optimal"}, "makes new vertices");
  expect_no({folder / "a.glb", "--no-intersection-check"}, "has been judged");
  write_text(folder / "round.obj",
             "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nvn -1 -1 -1\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\n"
             "f 1//1 3//3 2//2\nf 1//1 2//2 4//4\nf 1//1 4//4 3//3\nf 2//2 3//3 4//4\n");
  expect_refused({"simplify", folder / "round.obj", "-o", out, "--ratio", "0.5", "--normals", "recompute",
                  "--progressive", folder / "a.glb"},
                 2, "leave out --normals");
  expect_refused({"level", file, "-o", out}, 2, "--faces or --ratio");
  expect_refused({"level", file, "--faces", "9", "-o", file}, 2, "FILE");
  expect_refused({"level", folder / "least.glb", "--faces", "9", "-o", out}, 3, "no progressive file");
  expect_refused({"level", in, "--faces", "9", "-o", out}, 3, "progressive file is a glTF file");
  std::string damaged = contents_of(file);
  damaged[damaged.size() - 100] = char(damaged[damaged.size() - 100] ^ 1);
  write_text(folder / "damaged.glb", damaged);
  expect_refused({"level", folder / "damaged.glb", "--faces", "9", "-o", out}, 3, "the file is damaged");
}

} // namespace
} // namespace selvedge::test
