// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"

#include <nlohmann/json.hpp>

#include <tuple>

namespace selvedge::test {
namespace {

TEST(App_cells, CutsAMeshWhosePiecesAreReducedAndJoined)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.ply", 6000), out = folder / "out.obj",
                    small = folder / "small_{cell}.ply";
  const App_result cut =
      run_app({"cells", "cut", in, "-o", folder / "cell_{cell}.ply", "--faces-per-cell", "2e3"});
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_NE(cut.out.find("cut into 3 pieces"), std::string::npos) << cut.out;
  const nlohmann::json plan = nlohmann::json::parse(contents_of(folder / "cell_plan.json"));
  ASSERT_EQ(plan["cells"].size(), 3u);
  EXPECT_TRUE(plan["cells"][0]["low"][0].is_null());
  const auto result_of = [&](int cell) { return folder / ("small_" + std::to_string(cell) + ".ply"); };
  for (int cell = 1; cell <= 3; ++cell) {
    const App_result reduced =
        run_app({"simplify", folder / ("cell_" + std::to_string(cell) + ".ply"), "-o", result_of(cell),
                 "--ratio", "0.3", "--keep", "fixed", "--defects", "freeze", "--quiet"});
    EXPECT_EQ(reduced.code, 0) << reduced.err;
  }
  const App_result joined =
      run_app({"cells", "join", folder / "cell_plan.json", small, "-o", out, "--verify"});
  EXPECT_EQ(joined.code, 0) << joined.err;
  EXPECT_NE(joined.out.find("embedded, and so is the joined mesh"), std::string::npos) << joined.out;
  EXPECT_EQ(run_app({"verify", out, "--against", in}).code, 0);

  // Without --keep, walls are crossed.
  ASSERT_EQ(
      run_app({"simplify", folder / "cell_2.ply", "-o", result_of(2), "--ratio", "0.3", "--quiet"}).code, 0);
  const std::string before = contents_of(out);
  expect_refused({"cells", "join", folder / "cell_plan.json", small, "-o", out}, 3, "small_2.ply: ");
  EXPECT_EQ(contents_of(out), before);
  std::filesystem::remove(result_of(2));
  expect_refused({"cells", "join", folder / "cell_plan.json", small, "-o", out}, 3, "small_2.ply");
  write_text(folder / "cell_1.ply", contents_of(folder / "cell_3.ply"));
  expect_refused({"cells", "join", folder / "cell_plan.json", small, "-o", out}, 3,
                 "cell_1.ply: is not the piece that was cut");
}

TEST(App_cells, NumbersEveryMarkOfAName)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.ply", 200);
  ASSERT_EQ(run_app({"cells", "cut", in, "-o", folder / "{cell}_{cell}.ply", "--cells", "2"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "2_2.ply"));
}

TEST(App_cells, RefusesWhatMakesNoSense)
{
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.ply", 200), pieces = folder / "cell_{cell}.ply",
                    out = folder / "out.ply", plan = folder / "plan.json";
  write_text(plan, "{}");
  const std::tuple<std::vector<std::string>, int, const char*> senseless[] = {
      {{"cells", "part", in, "-o", pieces, "--cells", "2"}, 2, "cut, join"},
      {{"cells", "cut", in, "-o", pieces}, 2, "--faces-per-cell"},
      {{"cells", "cut", in, "-o", pieces, "--cells", "2", "--faces-per-cell", "9"}, 2, "one of the two"},
      {{"cells", "cut", in, "-o", pieces, "--cells", "0"}, 2, "--cells"},
      {{"cells", "cut", in, "-o", pieces, "--cells", "2", "--shift", "1"}, 2, "--shift"},
      {{"cells", "cut", in, "-o", out, "--cells", "2"}, 2, "{cell}"},
      {{"cells", "cut", in, "-o", pieces, "--cells", "2", "--verify"}, 2, "--verify"},
      {{"cells", "cut", in, "-o", folder / "{cell}.obj", "--cells", "2"}, 2, ".ply"},
      {{"cells", "cut", in, out, "-o", pieces, "--cells", "2"}, 2, "one mesh"},
      {{"cells", "cut", in, "-o", pieces, "--cells", "2", "--plan", in}, 2, "--plan and IN"},
      {{"cells", "join", plan, "-o", out}, 2, "which files to join"},
      {{"cells", "join", plan, out, "-o", out}, 2, "{cell}"},
      {{"cells", "join", plan, pieces, "-o", folder / "out.glb"}, 2, "32-bit"},
      {{"cells", "join", plan, pieces, "-o", out, "--cells", "2"}, 2, "for cells cut"},
      {{"cells", "join", plan, pieces, "-o", out}, 3, "is no plan"},
      {{"cells", "join", in, pieces, "-o", out}, 3, "is no plan"}};
  for (const auto& [arguments, code, what] : senseless)
    expect_refused(arguments, code, what);
  EXPECT_EQ(folder.files(), 2u);
}

} // namespace
} // namespace selvedge::test
