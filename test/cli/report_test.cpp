// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Documentation.h"

#include <selvedge/mesh_files.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <set>

namespace selvedge::test {
namespace {

using Json = nlohmann::json;

// "a.b" for every value of every object; arrays are values.
void collect_keys(const Json& object, const std::string& prefix, std::set<std::string>& keys)
{
  for (const auto& [name, value] : object.items())
    if (value.is_object())
      collect_keys(value, prefix + name + '.', keys);
    else
      keys.insert(prefix + name);
}

// The keys that docs/report.md lists for every report and for that of a command.
std::set<std::string> documented_keys(const std::string& command)
{
  const auto is_wanted = [&](const std::string& heading) {
    return heading == "## Keys of every report" ||
           (heading.rfind("## ", 0) == 0 && heading.find("`selvedge " + command) != std::string::npos);
  };
  std::set<std::string> keys;
  for (const Row& row : documented_rows("docs/report.md", is_wanted))
    if (row[0][0] == '`') {
      EXPECT_TRUE(keys.insert(row[0].substr(1, row[0].find('`', 1) - 1)).second) << row[0];
    }
  return keys;
}

// The keys that only one of two sets has; a whole set is too long to be printed.
std::set<std::string> difference(const std::set<std::string>& a, const std::set<std::string>& b)
{
  std::set<std::string> result;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(result, result.end()));
  return result;
}

Json report_of(const Workspace& folder, const std::string& in, const std::string& out,
               std::vector<std::string> options)
{
  options.insert(options.begin(), {"simplify", in, "-o", out, "--quiet", "--report", folder / "report.json"});
  const App_result result = run_app(options);
  const Json report = Json::parse(contents_of(folder / "report.json"));
  EXPECT_EQ(report["exit_code"], result.code);
  return report;
}

TEST(App_report, HasExactlyTheDocumentedKeys)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 2000);
  std::set<std::string> keys;
  const Json report = report_of(folder, in, folder / "out.obj", {"--ratio", "0.6"});
  collect_keys(report, "", keys);
  EXPECT_FALSE(keys.empty());
  for (const auto& [name, value] : report["parts"].at(0).items())
    keys.insert("parts[]." + name);
  EXPECT_EQ(keys.count("lods"), 0u);
  keys.insert("lods"); // documented as there with --lods only
  EXPECT_EQ(difference(keys, documented_keys("simplify")), std::set<std::string>());

  keys.clear();
  collect_keys(Json::parse(run_app({"info", in, "--json"}).out), "", keys);
  EXPECT_EQ(difference(keys, documented_keys("info")), std::set<std::string>());

  keys.clear();
  collect_keys(Json::parse(run_app({"verify", folder / "out.obj", "--against", in, "--json"}).out), "", keys);
  EXPECT_EQ(difference(keys, documented_keys("verify")), std::set<std::string>());

  keys.clear();
  report_of(folder, in, folder / "out.obj", {"--ratio", "0.6", "--log", folder / "run.log"});
  collect_keys(Json::parse(run_app({"replay", in, folder / "run.log", "--json"}).out), "", keys);
  EXPECT_EQ(difference(keys, documented_keys("replay")), std::set<std::string>());
}

TEST(App_report, AgreesWithTheFiles)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 2000);
  const Json report = report_of(folder, in, folder / "out.obj", {"--ratio", "0.6"});
  EXPECT_EQ(report["version"], SELVEDGE_VERSION);
  EXPECT_EQ(report["faces"]["input"], read_mesh(in).soup.triangles.size());
  EXPECT_EQ(report["faces"]["output"], read_mesh(folder / "out.obj").soup.triangles.size());
  EXPECT_EQ(report["target"]["reached"], true);
  EXPECT_EQ(report["target"]["outcome"], "reached");
  EXPECT_EQ(report["verified"]["embedded"], true);
  EXPECT_EQ(report["verified"]["new_pairs"], 0);
  EXPECT_EQ(report["topology"]["same"], true);
  EXPECT_EQ(report["output"]["written"], true);
  EXPECT_GT(report["collapses"], 0);
  EXPECT_GT(report["memory"]["peak_bytes"], 1'000'000);
}

TEST(App_report, SaysWhatHeldBack)
{
  const Workspace folder;
  const std::string in = folder.generate("sheets", "in.obj", 1000);
  const Json report = report_of(folder, in, folder / "out.obj",
                                {"--faces", "1", "--normal-change", "0.01", "--aspect-ratio", "0"});
  EXPECT_EQ(report["target"]["reached"], false);
  EXPECT_EQ(report["target"]["outcome"], "normal_change");
  EXPECT_GT(report["refused"]["normal_change"], 0);
}

TEST(App_report, SaysWhyTheOutputIsLargerThanTheInput)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.ply", 600);
  const Json larger = report_of(folder, in, folder / "out.ply", {"--ratio", "0.99", "--ascii"});
  const std::string sentence = larger["output"]["larger"];
  EXPECT_EQ(sentence.find("larger than the input by "), 0u);
  EXPECT_NE(sentence.find(" bytes: --ascii writes numbers as text"), std::string::npos);
  const App_result run = run_app({"simplify", in, "-o", folder / "out.ply", "--ratio", "0.99", "--ascii"});
  EXPECT_NE(run.out.find(sentence), std::string::npos);
  const Json smaller = report_of(folder, in, folder / "out.ply", {"--ratio", "0.5"});
  EXPECT_TRUE(smaller["output"]["larger"].is_null());
  const Json of_other_format = report_of(folder, in, folder / "out.obj", {"--ratio", "0.99"});
  EXPECT_TRUE(of_other_format["output"]["larger"].is_null());
}

// One mesh in two nodes, of which one is stretched, so that its places are reduced otherwise.
TEST(App_report, CountsOneOfWhatMakesAFileLarger)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.gltf", 600);
  Json scene = Json::parse(read_file(in));
  const std::size_t meshes = scene["meshes"].size();
  scene["nodes"].push_back({{"mesh", 0}, {"translation", {100, 0, 0}}, {"scale", {1, 5, 1}}});
  scene["scenes"][0]["nodes"].push_back(scene["nodes"].size() - 1);
  write_file(in, scene.dump());
  const Json report = report_of(folder, in, folder / "out.gltf",
                                {"--ratio", "0.9", "--instances", "apart", "--placement", "vertices"});
  ASSERT_EQ(Json::parse(read_file(folder / "out.gltf"))["meshes"].size(), meshes + 1);
  const std::string sentence = report["output"]["larger"];
  EXPECT_NE(sentence.find("1 mesh more than in the input"), std::string::npos) << sentence;
}

TEST(App_report, CountsPairsOfAnUncheckedRun)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 4000);
  const Json report =
      report_of(folder, in, folder / "out.obj", {"--ratio", "0.4", "--no-intersection-check"});
  EXPECT_EQ(report["exit_code"], 1);
  EXPECT_EQ(report["output"]["written"], true);
  EXPECT_EQ(report["options"]["intersection_check"], false);
  EXPECT_GT(report["verified"]["new_pairs"], 0);
}

TEST(App_report, SaysWhatRoundingAndTheFormatTake)
{
  const Workspace folder;
  const std::string in = folder.generate("skirt", "in.obj", 2000);
  const Json report = report_of(folder, in, folder / "out.stl", {"--ratio", "0.6"});
  EXPECT_GT(report["rounding"]["coordinates"], 0);
  EXPECT_FALSE(report["output"]["not_carried"].empty());
}

} // namespace
} // namespace selvedge::test
