// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include <selvedge/mesh/mesh_files.h>
#include <selvedge/verify.h>

namespace selvedge::test {
namespace {

/// A reduction that the app has done, with its log.
struct Logged_run
{
  explicit Logged_run(std::vector<std::string> options = {"--ratio", "0.6"})
  {
    original = folder.generate("skirt", "in.obj", 1500);
    reduced = folder / "out.obj";
    log = folder / "run.log";
    options.insert(options.begin(), {"simplify", original, "-o", reduced, "--quiet", "--log", log});
    const App_result result = run_app(options);
    code = result.code;
    text = contents_of(log);
  }

  Workspace folder;
  std::string original, reduced, log, text;
  int code;
};

std::size_t count(const std::string& text, const std::string& part)
{
  std::size_t result = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++result;
  return result;
}

TEST(App_replay, AcceptsItsOwnLogAndMakesTheSameFile)
{
  const Logged_run run;
  EXPECT_EQ(run.code, 0);
  EXPECT_GT(count(run.text, "\nc "), 200u);
  const std::string again = run.folder / "again.obj";
  const App_result result = run_app({"replay", run.original, run.log, "-o", again});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("\nACCEPTED\n"), std::string::npos) << result.out;
  EXPECT_EQ(contents_of(again), contents_of(run.reduced));
}

TEST(App_replay, RefusesALogThatLacksAStep)
{
  const Logged_run run;
  const std::size_t first = run.text.find("\nc ") + 1;
  write_text(run.log, run.text.substr(0, first) + run.text.substr(run.text.find('\n', first) + 1));
  const App_result result = run_app({"replay", run.original, run.log});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("\nREFUSED; the first violation:\n"), std::string::npos) << result.out;
}

TEST(App_replay, RefusesACollapseAcrossAndNamesIt)
{
  const Logged_run run;
  const std::size_t first = run.text.find("\nc ") + 1;
  // The same vertex to one that no edge joins it with.
  const std::string removed = run.text.substr(first + 2, run.text.find(' ', first + 2) - first - 2);
  const std::string other = removed == "0" ? "700" : "0";
  write_text(run.log, run.text.substr(0, first) + "c " + removed + ' ' + other +
                          run.text.substr(run.text.find('\n', first)));
  const App_result result = run_app({"replay", run.original, run.log, "--all"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("step 1 (line "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(removed + " to " + other), std::string::npos) << result.out;
}

TEST(App_replay, ListsTheBadStepsOfAnUnguardedRun)
{
  const Logged_run run({"--no-intersection-check", "--ratio", "0.3"});
  EXPECT_EQ(run.code, 1);
  const std::string scene = run.folder / "scene.obj";
  const App_result result =
      run_app({"replay", run.original, run.log, "--no-limits", "--all", "--scene", scene});
  EXPECT_EQ(result.code, 1);
  const std::size_t all = result.out.find("\nall ");
  ASSERT_NE(all, std::string::npos) << result.out;
  EXPECT_GT(count(result.out.substr(all), "\nstep "), 1u);
  EXPECT_FALSE(read_mesh(scene).soup.triangles.empty());
}

TEST(App_replay, RefusesWhatItCannotRead)
{
  const Logged_run run;
  const std::string other = run.folder.generate("skirt", "other.obj", 1200);
  expect_refused({"replay", other, run.log}, 3, "SHA-256");
  expect_refused({"replay", run.original, run.folder / "absent.log"}, 3, "absent.log");
  expect_refused({"replay", run.folder / "absent.obj", run.log}, 3, "absent.obj");
  expect_refused({"replay", run.original, run.log, "-o", run.folder / "again.xyz"}, 2, "again.xyz");
  expect_refused({"replay", run.original, run.original}, 3, "in.obj");
  write_text(run.log, run.text.substr(0, run.text.find("\nc ")) + "\nc 1 nonsense\n");
  expect_refused({"replay", run.original, run.log}, 3, "run.log");
}

} // namespace
} // namespace selvedge::test
