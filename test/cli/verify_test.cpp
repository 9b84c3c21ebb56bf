// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace selvedge::test {
namespace {

const char* const crossing = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 1\nv 9 9 0\nf 1 2 3\nf 4 5 6\n";
const char* const apart = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 1\nv 1 1 3\nv 9 9 2\nf 1 2 3\nf 4 5 6\n";

TEST(App_verify, EmbeddedIsGood)
{
  const Workspace folder;
  const App_result result = run_app({"verify", folder.generate("skirt", "in.obj", 1000)});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("embedded: no two faces"), std::string::npos) << result.out;
}

TEST(App_verify, NamesWhatOffends)
{
  const Workspace folder;
  write_text(folder / "in.obj", crossing);
  const App_result result = run_app({"verify", folder / "in.obj"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("triangles 1 and 2 intersect"), std::string::npos) << result.out;
}

TEST(App_verify, AgainstTheOriginalOnlyNewPairsCount)
{
  const Workspace folder;
  write_text(folder / "crossing.obj", crossing);
  write_text(folder / "apart.obj", apart);
  EXPECT_EQ(run_app({"verify", folder / "crossing.obj", "--against", folder / "crossing.obj"}).code, 0);
  EXPECT_EQ(run_app({"verify", folder / "crossing.obj", "--against", folder / "apart.obj"}).code, 1);
  EXPECT_EQ(run_app({"verify", folder / "apart.obj", "--against", folder / "crossing.obj"}).code, 0);
}

TEST(App_verify, AgainstTheOriginalTopologyCounts)
{
  const Workspace folder;
  write_text(folder / "one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_text(folder / "apart.obj", apart);
  const App_result result = run_app({"verify", folder / "one.obj", "--against", folder / "apart.obj"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("topology CHANGED"), std::string::npos) << result.out;
}

TEST(App_verify, SaysTheSameInJson)
{
  const Workspace folder;
  write_text(folder / "in.obj", crossing);
  const App_result printed = run_app({"verify", folder / "in.obj", "--against", folder / "in.obj", "--json"});
  EXPECT_EQ(printed.code, 0);
  const nlohmann::json report = nlohmann::json::parse(printed.out);
  EXPECT_EQ(report["verified"]["pairs"], 1);
  EXPECT_EQ(report["verified"]["new_pairs"], 0);
  EXPECT_EQ(report["topology"]["same"], true);
  EXPECT_EQ(report["distance"]["original_to_result"]["max"], 0);
  EXPECT_EQ(run_app({"verify", folder / "in.obj", "--report", folder / "r.json"}).code, 1);
  EXPECT_EQ(
      nlohmann::json::parse(contents_of(folder / "r.json"))["verified"]["first_new_pairs"][0]["offence"],
      "intersection");
}

// Two bumps, each pulled through the patch under it: embedded, and with the same topology.
TEST(App_verify, LayersThatChangedPlacesAreNotVerified)
{
  const Workspace folder;
  const std::string in = folder.generate("tunnel", "in.obj", 100);
  const std::string out = folder / "out.obj";
  run_app({"simplify", in, "-o", out, "--ratio", "0", "--no-intersection-check", "--quiet"});
  EXPECT_EQ(run_app({"verify", out}).code, 0);
  const App_result result = run_app({"verify", out, "--against", in});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("layers SWAPPED, at "), std::string::npos) << result.out;
  const nlohmann::json report =
      nlohmann::json::parse(run_app({"verify", out, "--against", in, "--json"}).out);
  EXPECT_EQ(report["exit_code"], 1);
  EXPECT_EQ(report["verified"]["embedded"], true);
  EXPECT_EQ(report["topology"]["same"], true);
  EXPECT_GT(report["layers"]["swaps"], 0);
  EXPECT_EQ(report["layers"]["first_swaps"].size(), std::min<std::size_t>(100, report["layers"]["swaps"]));
}

TEST(App_verify, SaysWhatIsLeftOfTheOriginal)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 2000);
  const std::string out = folder / "out.obj", bare = folder / "out.off";
  ASSERT_EQ(run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--quiet"}).code, 0);
  ASSERT_EQ(run_app({"simplify", in, "-o", bare, "--ratio", "0.5", "--quiet"}).code, 0);
  const App_result kept = run_app({"verify", out, "--against", in});
  EXPECT_EQ(kept.code, 0) << kept.out;
  EXPECT_NE(kept.out.find("are the original's, bit for bit"), std::string::npos) << kept.out;
  EXPECT_NE(kept.out.find("layers: in order"), std::string::npos) << kept.out;
  EXPECT_EQ(kept.out.find("LOST"), std::string::npos) << kept.out;
  EXPECT_EQ(kept.out.find("GAPS"), std::string::npos) << kept.out;
  const App_result lost = run_app({"verify", bare, "--against", in});
  EXPECT_NE(lost.out.find("attributes LOST: uv group"), std::string::npos) << lost.out;
}

TEST(App_verify, TellsOfGaps)
{
  const Workspace folder;
  // Two squares that share two edges by position; in the other file one of them has moved aside.
  const std::string faces = "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 6 7 8\nf 6 8 9\nf 6 9 10\n";
  const std::string left = "v 0 0 0\nv 1 0 0\nv 1 0.5 0\nv 1 1 0\nv 0 1 0\n";
  write_text(folder / "in.obj", left + "v 2 1 0\nv 1 1 0\nv 1 0.5 0\nv 1 0 0\nv 2 0 0\n" + faces);
  write_text(folder / "out.obj",
             left + "v 2 1 0\nv 1.0625 1 0\nv 1.0625 0.5 0\nv 1.0625 0 0\nv 2 0 0\n" + faces);
  const App_result result = run_app({"verify", folder / "out.obj", "--against", folder / "in.obj"});
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("GAPS: 4 edges of seams open"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("seams: 2 edges before, none now"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("vertices: 7 of 10 are"), std::string::npos) << result.out;
}

TEST(App_verify, RefusesUnreadableInput)
{
  const Workspace folder;
  expect_refused({"verify", folder / "absent.obj"}, 3, "absent.obj");
  write_text(folder / "in.obj", apart);
  expect_refused({"verify", folder / "in.obj", "--against", folder / "absent.ply"}, 3, "absent.ply");
  expect_refused({"verify", folder / "in.obj", "--report", folder / "in.obj"}, 2, "--report");
  expect_refused({"verify", folder / "in.obj", "--report", folder / "none/r.json"}, 4, "r.json");
}

} // namespace
} // namespace selvedge::test
