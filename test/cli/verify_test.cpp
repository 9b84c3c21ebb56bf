// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include <nlohmann/json.hpp>

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
