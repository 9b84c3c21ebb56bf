// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include <selvedge/mesh_files.h>
#include <selvedge/verify.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace selvedge::test {
namespace {

using Json = nlohmann::json;

/// A reduction that the app has done, with its log.
struct Logged_run
{
  explicit Logged_run(std::vector<std::string> options = {"--ratio", "0.6"})
  {
    original = folder.generate("skirt", "in.obj", 1500);
    reduced = folder / "out.obj";
    log = folder / "run.log";
    options.insert(options.begin(), {"simplify", original, "-o", reduced, "--quiet", "--log", log});
    if (std::find(options.begin(), options.end(), "--placement") == options.end())
      options.insert(options.end(), {"--placement", "vertices"}); // of which replay judges everything
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
  EXPECT_NE(result.out.find("\nACCEPTED: limits of the log, input bound, result bound\n"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("\nlimits judged: normal_change 75°, aspect_ratio 0.01, border_turn 30°, "
                            "corner_height 0.0025 of the "
                            "diagonal, seam_turn 90°, border_drift 0.01 of the diagonal\n"),
            std::string::npos)
      << result.out;
  EXPECT_EQ(contents_of(again), contents_of(run.reduced));
}

// Exceptions that the help names. Positions and faces are the same even so.
TEST(App_replay, MakesTheSameFacesWhereTheLogDoesNotHoldAll)
{
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--sewn"}, {"--placement", "optimal"}}) {
    std::vector<std::string> all = options;
    all.insert(all.end(), {"--ratio", "0.6"});
    const Logged_run run(all);
    EXPECT_EQ(run.code, 0);
    const std::string again = run.folder / "again.obj";
    const App_result result = run_app({"replay", run.original, run.log, "-o", again});
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out.find("\nnot judged: places: ") != std::string::npos, options.front() != "--sewn")
        << result.out;
    EXPECT_TRUE(contents_of(again) != contents_of(run.reduced)) << options.front();
    const Triangle_soup now = read_mesh(again).soup, before = read_mesh(run.reduced).soup;
    ASSERT_EQ(now.triangles.size(), before.triangles.size());
    for (std::size_t t = 0; t < now.triangles.size(); ++t)
      for (int place = 0; place < 3; ++place)
        ASSERT_EQ(now.points[now.triangles[t][place]], before.points[before.triangles[t][place]]);
  }
}

// What it takes to have nothing judged but geometry shows in the verdict.
TEST(App_replay, NamesWhatALogWithoutTermsLeavesOpen)
{
  const Logged_run run;
  std::istringstream lines(run.text);
  std::string stripped;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("input", 0) == 0 || line.rfind("result", 0) == 0)
      line = line.substr(0, line.rfind(' ')) + " -";
    if (line.rfind("limit", 0) != 0)
      stripped += line + '\n';
  }
  write_text(run.log, stripped);
  const App_result result = run_app({"replay", run.original, run.log});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("\nACCEPTED: no limits, input NOT BOUND, result NOT BOUND\n"), std::string::npos)
      << result.out;
  for (const char* key : {"normal_change", "aspect_ratio", "border_turn", "seam_turn", "border_drift",
                          "lines", "input", "result", "attributes"})
    EXPECT_NE(result.out.find(std::string("\nnot judged: ") + key + ": "), std::string::npos) << result.out;
}

TEST(App_replay, LimitsOfTheJudgeTakeThePlaceOfTheLogs)
{
  const Logged_run run({"--ratio", "0.2", "--error", "none", "--normal-change", "120", "--aspect-ratio",
                        "0.2", "--border-turn", "8", "--seam-turn", "8"});
  const auto replay = [&](const std::string& limits) {
    return run_app({"replay", run.original, run.log, "--limits", limits});
  };
  EXPECT_EQ(run_app({"replay", run.original, run.log}).code, 0);
  for (const auto& [limits, degrees] : {std::pair("default", "75"), std::pair("seed", "45")}) {
    const App_result refused = replay(limits);
    EXPECT_EQ(refused.code, 1);
    EXPECT_NE(refused.out.find("normal_change: the normal of a triangle turns by more than " +
                               std::string(degrees) + "°"),
              std::string::npos)
        << refused.out;
  }
  const std::string file = run.folder / "limits";
  write_text(file, "limit normal_change 120\nlimit seam_turn 60\n");
  const App_result accepted = replay(file);
  EXPECT_EQ(accepted.code, 0);
  EXPECT_NE(accepted.out.find("\nlimits judged: normal_change 120°, seam_turn 60°\n"), std::string::npos)
      << accepted.out;
  EXPECT_NE(accepted.out.find("\nlimits declared by the log, but not judged: normal_change 120°"),
            std::string::npos)
      << accepted.out;
  EXPECT_NE(accepted.out.find("\nACCEPTED: limits of the judge, input bound, result bound\n"),
            std::string::npos)
      << accepted.out;
  write_text(file, "limit normal_change 45\n");
  EXPECT_EQ(replay(file).code, 1);
  write_text(file, "limit normal_changes 45\n");
  expect_refused({"replay", run.original, run.log, "--limits", file}, 3, "limits, line 1");
  expect_refused({"replay", run.original, run.log, "--limits", run.folder / "absent"}, 3, "absent");
  expect_refused({"replay", run.original, run.log, "--limits", "seed", "--no-limits"}, 2, "--limits");
}

TEST(App_replay, AcceptsTheDefaultsByTheDefaults)
{
  const Logged_run run;
  const App_result result = run_app({"replay", run.original, run.log, "--limits", "default"});
  EXPECT_EQ(result.code, 0) << result.out;
  const std::size_t first = result.out.find("limits judged: "), second = result.out.find("but not judged: ");
  ASSERT_NE(second, std::string::npos);
  const auto rest_of_line = [&](std::size_t at) {
    return result.out.substr(at, result.out.find('\n', at) - at);
  };
  EXPECT_EQ(rest_of_line(first + 15), rest_of_line(second + 16))
      << "simplify declares what default stands for";
}

TEST(App_replay, JudgesTheObstacleThatItIsGivenOrSaysThatItDidNot)
{
  const Workspace folder;
  const std::string obstacle = folder.generate("nested", "obstacle.obj", 200),
                    other = folder.generate("nested", "other.obj", 300);
  const Logged_run run({"--ratio", "0.6", "--obstacle", obstacle});
  EXPECT_NE(run.text.find("\nobstacle "), std::string::npos);
  App_result result = run_app({"replay", run.original, run.log});
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("\nnot judged: obstacle: "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(", obstacle NOT JUDGED"), std::string::npos) << result.out;

  result = run_app({"replay", run.original, run.log, "--obstacle", obstacle});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out.find("not judged: obstacle"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(", obstacle bound\n"), std::string::npos) << result.out;

  result = run_app({"replay", run.original, run.log, "--obstacle", other});
  EXPECT_EQ(result.code, 3);
  EXPECT_NE(result.err.find("this is not the obstacle that the log names"), std::string::npos) << result.err;
  EXPECT_EQ(run_app({"replay", run.original, run.log, "--obstacle-pose", obstacle}).code, 2);
}

TEST(App_replay, GivesTheVerdictAsJson)
{
  const Logged_run run({"--ratio", "0.6", "--no-intersection-check"});
  const std::string file = run.folder / "verdict.json";
  const App_result result = run_app({"replay", run.original, run.log, "--all", "--report", file});
  const Json verdict = Json::parse(contents_of(file));
  EXPECT_EQ(verdict["exit_code"], result.code);
  EXPECT_EQ(verdict["verdict"], "refused");
  EXPECT_EQ(verdict["terms"]["limits_of"], "log");
  EXPECT_EQ(verdict["terms"]["limits"]["normal_change"], 75);
  EXPECT_TRUE(verdict["terms"]["limits"]["weld_distance"].is_null());
  EXPECT_EQ(verdict["terms"]["input_bound"], true);
  EXPECT_EQ(verdict["terms"]["not_judged"].size(), 1u);
  EXPECT_GT(verdict["violations"]["count"], 0);
  EXPECT_EQ(verdict["violations"]["first"].size(),
            std::min(verdict["violations"]["count"].get<std::size_t>(), std::size_t(100)));
  EXPECT_GT(verdict["violations"]["first"][0]["step"], 0);
  std::size_t total = 0;
  for (const Json& kind : verdict["violations"]["kinds"])
    total += kind["count"].get<std::size_t>();
  EXPECT_EQ(verdict["violations"]["count"], total);

  const App_result printed = run_app({"replay", run.original, run.log, "--json", "--limits", "seed"});
  EXPECT_EQ(Json::parse(printed.out)["terms"]["limits_of"], "judge");
  EXPECT_EQ(Json::parse(printed.out)["terms"]["declared"]["seam_turn"], 90);
  EXPECT_EQ(Json::parse(printed.out)["terms"]["limits"]["seam_turn"], 8);
  expect_refused({"replay", run.original, run.log, "--report", run.log}, 2, "--report");
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

TEST(App_replay, SaysThatTheResultHasAnotherDigest)
{
  const Logged_run run;
  const std::size_t digest = run.text.rfind(' ') + 1;
  write_text(run.log, run.text.substr(0, digest) + std::string(64, 'a') + '\n');
  const App_result result = run_app({"replay", run.original, run.log});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.out.find("\nresult: NOT BOUND (the log has another SHA-256)\n"), std::string::npos)
      << result.out;
  EXPECT_EQ(result.out.find("\nnot judged: result: "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("the log's digest stands for"), std::string::npos) << result.out;
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
  const std::string scene = run.folder / "scene.obj";
  const App_result result = run_app({"replay", run.original, run.log, "--all", "--scene", scene});
  EXPECT_EQ(result.code, 1);
  EXPECT_FALSE(std::filesystem::exists(scene));
  EXPECT_NE(result.err.find("--scene: no file is written: in the first violation (no_edge) no triangles"),
            std::string::npos)
      << result.err;
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

TEST(App_replay, NamesTheFormatsForAResultOfDoubles)
{
  const Logged_run run;
  const std::string again = run.folder / "again.glb";
  const App_result result = run_app({"replay", run.original, run.log, "-o", again});
  EXPECT_EQ(result.code, 4);
  EXPECT_NE(result.err.find("write OBJ, OFF or PLY, which store doubles"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(again));
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
