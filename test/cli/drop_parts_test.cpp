// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Parts that `simplify` leaves out, such as stitches: in the output, the log and what judges both.

#include "App_run.h"
#include "support/soups.h"

#include <selvedge/mesh_files.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

// A sheet with a row of closed stitches above it, in groups of their own.
Triangle_soup stitched_sheet(std::size_t stitches)
{
  const Triangle_soup cloth = sheet(20, 20);
  Triangle_soup soup = cloth;
  for (std::size_t i = 0; i < stitches; ++i)
    soup =
        joined(soup, moved(mapped(tetrahedron(),
                                  [](const Point_3& p) { return Point_3(p.x() / 8, p.y() / 8, p.z() / 8); }),
                           double(i), 10.25, 0.25));
  soup.groups.names = {"cloth", "stitches"};
  for (Index t = 0; t < soup.triangles.size(); ++t)
    soup.groups.of_triangle.push_back(t >= cloth.triangles.size());
  return soup;
}

using Arguments = std::vector<std::string>;

Arguments operator+(Arguments first, const Arguments& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TEST(App_drop_parts, AreInNoOutputAndInNoVerdict)
{
  const Workspace folder;
  for (const char* ending : {"obj", "ply", "stl", "glb"}) {
    SCOPED_TRACE(ending);
    const std::string in = folder / ("in." + std::string(ending)),
                      out = folder / ("out." + std::string(ending)), log = folder / "steps.log",
                      report = folder / "report.json";
    write_mesh(in, stitched_sheet(20));
    std::vector<Arguments> ways{{"--drop-smaller", "0.5"}};
    if (ending != std::string("ply") && ending != std::string("stl")) // which hold no names of groups
      ways.push_back({"--drop-part", "stitches"});
    for (const Arguments& way : ways) {
      const App_result reduced = run_app(
          Arguments{"simplify", in, "-o", out, "--ratio", "0.1", "--log", log, "--report", report} + way);
      EXPECT_EQ(reduced.code, 0) << reduced.err;
      EXPECT_NE(reduced.out.find("in." + std::string(ending) + ": 800 faces\n"), std::string::npos)
          << reduced.out;
      EXPECT_NE(reduced.out.find("  faces left out by " + way[0]), std::string::npos) << reduced.out;
      EXPECT_NE(reduced.out.find("target 80 reached"), std::string::npos) << reduced.out;
      EXPECT_LE(read_mesh(out).soup.triangles.size(), 80u);
      const App_result replayed = run_app({"replay", in, log});
      EXPECT_EQ(replayed.code, 0) << replayed.out << replayed.err;
      EXPECT_NE(
          replayed.out.find("not judged: " + std::string(way[0] == "--drop-part" ? "drop_part: the part "
                                                                                   "'stitches'"
                                                                                 : "drop_smaller: ")),
          std::string::npos)
          << replayed.out;
      EXPECT_EQ(run_app(Arguments{"verify", out, "--against", in} + way).code, 0);
      EXPECT_EQ(run_app({"verify", out, "--against", in}).code, 1);
      const nlohmann::json options = nlohmann::json::parse(contents_of(report))["options"];
      EXPECT_EQ(options["drop_smaller"] == 0.5, way[0] == "--drop-smaller");
      EXPECT_EQ(options["drop_part"].size(), way[0] == "--drop-part" ? 1u : 0u);
    }
  }
}

// The primitives of a glTF mesh are numbered, and those after one that is left out get other numbers.
TEST(App_drop_parts, LeaveTheNamesOfOtherPrimitives)
{
  const Workspace folder;
  Triangle_soup soup = stitched_sheet(20);
  soup.materials = std::exchange(soup.groups, {});
  std::reverse(soup.triangles.begin(), soup.triangles.end()); // the stitches come first
  std::reverse(soup.materials.of_triangle.begin(), soup.materials.of_triangle.end());
  write_mesh(folder / "in.glb", soup);
  ASSERT_NE(read_mesh(folder / "in.glb").soup.groups.names.at(1).find("/1"), std::string::npos);
  ASSERT_EQ(run_app({"simplify", folder / "in.glb", "-o", folder / "out.glb", "--ratio", "0.5", "--drop-part",
                     "stitches", "--quiet"})
                .code,
            0);
  const App_result judged =
      run_app({"verify", folder / "out.glb", "--against", folder / "in.glb", "--drop-part", "stitches"});
  EXPECT_EQ(judged.code, 0);
  EXPECT_EQ(judged.out.find("NOT the original's"), std::string::npos) << judged.out;
}

TEST(App_drop_parts, AreNamedWhereTheyTakeTheTarget)
{
  const Workspace folder;
  write_mesh(folder / "in.obj", stitched_sheet(20));
  const App_result info = run_app({"info", folder / "in.obj"});
  EXPECT_NE(info.out.find("small surfaces: 20, with 80 faces, are smaller than 0.2"), std::string::npos)
      << info.out;
  const App_result missed =
      run_app({"simplify", folder / "in.obj", "-o", folder / "out.obj", "--faces", "20"});
  const std::string::size_type advice = missed.out.find("; --drop-smaller 0.2");
  ASSERT_NE(advice, std::string::npos) << missed.out;
  EXPECT_NE(missed.out.find(" leaves out the small ones, 20 with 80 faces\n"), std::string::npos)
      << missed.out;
  // The advice can be followed to the letter.
  const std::string::size_type length = missed.out.find("0.2", advice);
  const App_result followed =
      run_app({"simplify", folder / "in.obj", "-o", folder / "out.obj", "--faces", "20", "--drop-smaller",
               missed.out.substr(length, missed.out.find(' ', length) - length)});
  EXPECT_NE(followed.out.find("  faces left out by --drop-smaller, in 20 pieces: 80\n"), std::string::npos)
      << followed.out;

  write_mesh(folder / "few.obj", stitched_sheet(7));
  // A figure of many parts in a large room.
  Triangle_soup room =
      joined(stitched_sheet(20),
             mapped(sheet(2, 2), [](const Point_3& p) { return Point_3(1000 * p.x(), 1000 * p.y(), -1); }));
  room.groups = {};
  write_mesh(folder / "room.obj", room);
  for (const char* name : {"few.obj", "room.obj"})
    EXPECT_EQ(run_app({"info", folder / name}).out.find("small surfaces"), std::string::npos) << name;
}

// Stitches of many faces: the target leaves enough for each piece, but they take nearly all of it.
TEST(App_drop_parts, AreNamedWhereTheyHaveMostOfTheFaces)
{
  const Workspace folder;
  const auto missed = [&](Index side_of_cloth) {
    const auto rough = [](const Triangle_soup& soup) {
      return mapped(soup, [](const Point_3& p) {
        const int x = int(p.x()), y = int(p.y());
        return Point_3(p.x(), p.y(), (3 * x * x + 5 * y * y + x * y) % 11 / 8.);
      });
    };
    Triangle_soup soup = mapped(rough(sheet(side_of_cloth, side_of_cloth)), [&](const Point_3& p) {
      return Point_3(40 * p.x() / side_of_cloth, 40 * p.y() / side_of_cloth, p.z());
    });
    for (int i = 0; i < 20; ++i)
      soup = joined(soup,
                    moved(mapped(rough(sheet(4, 4)),
                                 [](const Point_3& p) { return Point_3(p.x() / 8, p.y() / 8, p.z() / 8); }),
                          2 * i, 2 * i, 5));
    write_mesh(folder / "in.obj", soup);
    return run_app(
               {"simplify", folder / "in.obj", "-o", folder / "out.obj", "--ratio", "0.5", "--error", "0"})
        .out;
  };
  const std::string most = missed(10);
  EXPECT_NE(
      most.find("\npieces: 20 small ones have 640 of the faces of the input, and none of them vanishes; "
                "--drop-smaller 0."),
      std::string::npos)
      << most;
  const std::string few = missed(20);
  EXPECT_NE(few.find("not reached"), std::string::npos) << few;
  EXPECT_EQ(few.find("--drop-smaller"), std::string::npos) << few;
}

TEST(App_drop_parts, RefusesWhatLeavesNothing)
{
  const Workspace folder;
  const std::string in = folder / "in.obj", out = folder / "out.obj";
  write_mesh(in, stitched_sheet(2));
  const Arguments simplify{"simplify", in, "-o", out, "--ratio", "0.5"};
  expect_refused(simplify + Arguments{"--drop-smaller", "100"}, 3,
                 "in.obj: --drop-smaller: no face would be left");
  expect_refused(simplify + Arguments{"--drop-part", "cloth", "--drop-part", "stitches"}, 3,
                 "in.obj: --drop-part: no face would be left");
  expect_refused(simplify + Arguments{"--drop-part", "zip"}, 2,
                 "--drop-part: no group, object or material is called 'zip'; there are cloth, stitches");
  expect_refused(simplify + Arguments{"--drop-part", "stitches", "--keep", "stitches"}, 2,
                 "no group, object or material is called 'stitches'; there are cloth");
  expect_refused(simplify + Arguments{"--drop-smaller", "0"}, 2,
                 "--drop-smaller: '0' is not a positive number");
  Triangle_soup pierced = joined(stitched_sheet(1), moved(crossing(), 0, 0, 9));
  pierced.groups = {};
  write_mesh(folder / "crossing.obj", pierced);
  expect_refused(
      {"simplify", folder / "crossing.obj", "-o", out, "--ratio", "0.5", "--strict", "--drop-smaller", "0.5"},
      3, "crossing.obj, without what is left out: ");
  const App_result none = run_app(simplify + Arguments{"--drop-smaller", "0.01"});
  EXPECT_EQ(none.code, 0);
  EXPECT_NE(none.err.find("--drop-smaller leaves out nothing: no piece of "), std::string::npos) << none.err;
}

} // namespace
} // namespace selvedge::test
