// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "App_run.h"
#include "support/soups.h"

#include <selvedge/compare.h>
#include <selvedge/mesh_files.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

using Json = nlohmann::json;

/// Shorts in layers, reduced as far as an error of 0.002 allows.
class App_error : public testing::Test
{
protected:
  App_result simplify(std::vector<std::string> options) const
  {
    if (std::find(options.begin(), options.end(), "--error") == options.end())
      options.insert(options.end(), {"--error", "0.002"});
    options.insert(options.begin(), {"simplify", in, "-o", out, "--report", report});
    App_result result = run_app(options);
    EXPECT_EQ(result.code, 0) << result.err;
    return result;
  }
  static double upper(const Json& level)
  {
    return std::max(level["distance"]["original_to_result"]["max_upper"].get<double>(),
                    level["distance"]["result_to_original"]["max_upper"].get<double>());
  }
  Json read_report() const { return Json::parse(std::ifstream(report)); }

  Workspace folder;
  std::string in = folder.generate("shorts", "in.ply", 5000), out = folder / "out.ply",
              report = folder / "report.json", log = folder / "out.log";
};

TEST_F(App_error, MayBeExceededBetweenThePointsThatAreMeasured)
{
  const App_result result = simplify({});
  EXPECT_GT(upper(read_report()), 0.00205);
  EXPECT_TRUE(read_report()["error_search"].is_null());
  EXPECT_NE(result.out.find("; --error-everywhere keeps it at every point\n"), std::string::npos)
      << result.out;
}

TEST_F(App_error, IsKeptEverywhereOnDemand)
{
  const App_result result = simplify({"--error-everywhere", "--log", log});
  const Json written = read_report();
  EXPECT_LE(upper(written), 0.002);
  EXPECT_LE(distances_anywhere(read_mesh(out).soup, read_mesh(in).soup).larger().upper, 0.002);
  EXPECT_GE(written["error_search"]["reductions"], 2);
  EXPECT_LT(written["error_search"]["error"], 0.002);
  EXPECT_GT(written["error_search"]["error"], 0.001);
  EXPECT_EQ(written["options"]["error"], 0.002);
  EXPECT_NE(result.out.find("limit: 0.2 % holds at every point; found in "), std::string::npos) << result.out;
  EXPECT_EQ(run_app({"replay", in, log}).code, 0) << "the log is of the last reduction alone";
}

TEST_F(App_error, IsKeptEverywhereInEveryLevel)
{
  out = folder / "out_{lod}.ply";
  simplify({"--error-everywhere", "--lods", "0.5,0.05", "--placement", "optimal"});
  const Json levels = read_report()["lods"];
  ASSERT_EQ(levels.size(), 2u);
  for (const Json& level : levels)
    EXPECT_LE(upper(level), 0.002);
}

// Sheets that lie over each other in one plane. What a collapse covers anew lies between the points that are
// measured, so that no error but 0 keeps the limit.
TEST_F(App_error, IsKeptEverywhereBetweenSheetsInOnePlane)
{
  const std::string sheets = folder / "sheets.obj";
  write_text(sheets, "v 4 2 4\nv 5 2 5\nv 6 2 6\nv 4 3 4\nv 5 3 5\nv 6 3 6\nv 7 3 7\nv 0 4 0\nv 5 4 5\n"
                     "v 3 2 3\nv 1 0 1\nv 7 4 7\nv 1 2 1\nv 1 4 1\n"
                     "f 1 2 5 4\nf 2 3 5\nf 3 6 5\nf 4 5 9\nf 5 6 10 9\nf 8 7 10\nf 11 13 12\nf 12 13 14\n");
  in = sheets;
  const App_result result = simplify({"--ratio", "0", "--error", "1e-6", "--error-everywhere", "--placement",
                                      "optimal", "--defects", "descend"});
  EXPECT_NE(result.out.find("limit: 0.0001 % holds at every point"), std::string::npos) << result.out;
}

TEST_F(App_error, IsNotKeptEverywhereWithoutOne)
{
  const App_result result =
      run_app({"simplify", in, "-o", out, "--ratio", "0.5", "--error", "none", "--error-everywhere"});
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.err.find("--error-everywhere: there is no limit to keep"), std::string::npos)
      << result.err;
}

} // namespace
} // namespace selvedge::test
