// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Levels of detail that the C interface makes, in one reduction.

#include <selvedge_c.h>

#include "support/Temporary_folder.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#ifdef SELVEDGE_APP
#include "cli/App_run.h"
#endif

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

TEST(C_interface, RefusesLevelsOfDetailWithAWordAndLeavesTheResults)
{
  selvedge_mesh* const mesh = selvedge_mesh_generate("sheets", 500, 1);
  selvedge_result* results[2] = {};
  using Values = std::vector<std::pair<const char*, const char*>>;
  const auto error = [&](const Values& values, selvedge_result** into = nullptr, std::size_t count = 2) {
    selvedge_options* const options = selvedge_options_new();
    for (const auto& [name, value] : values)
      EXPECT_EQ(selvedge_options_set(options, name, value), 0) << selvedge_last_error();
    EXPECT_EQ(selvedge_reduce_lods(mesh, options, into ? into : results, count), -1);
    const std::string refusal = selvedge_last_error();
    selvedge_options_free(options);
    return refusal;
  };
  const std::pair<const char*, const char*> two{"lods", "0.5,0.25"};
  EXPECT_EQ(error({two, {"ratio", "0.5"}}).rfind("lods: they already say how far", 0), 0u);
  EXPECT_EQ(error({two, {"faces", "100"}}).rfind("lods: they already say how far", 0), 0u);
  EXPECT_EQ(error({two, {"lods", "0.1"}}), "lods: the option has 3 ratios, and there is room for 2 results");
  EXPECT_EQ(error({{"ratio", "0.5"}}, results, 0),
            "lods: the option has 0 ratios, and there is room for 0 results");
  EXPECT_EQ(error({two, {"cells", "true"}, {"part_ratios", "sheet_1=0.5"}}).rfind("in cells no part", 0), 0u);
  EXPECT_EQ(results[0], nullptr);

  selvedge_options* const options = selvedge_options_new();
  for (const char* const value : {"0.5,", "0.5,x", "1.5", "-1", ""})
    EXPECT_EQ(selvedge_options_set(options, "lods", value), -1) << value;
  EXPECT_STREQ(selvedge_last_error(), "lods: '' is not a number from 0 to 1");
  EXPECT_EQ(selvedge_options_set(options, "lods", "0.5,0.25"), 0);
  EXPECT_EQ(selvedge_reduce_lods(mesh, options, nullptr, 2), -1);
  EXPECT_EQ(selvedge_reduce_lods(nullptr, options, results, 2), -1);
  EXPECT_EQ(selvedge_reduce(mesh, options), nullptr);
  EXPECT_STREQ(selvedge_last_error(), "lods: selvedge_reduce makes one result; call selvedge_reduce_lods");
  EXPECT_EQ(selvedge_reduce_lods(mesh, options, results, 2), 0) << selvedge_last_error();
  EXPECT_GT(selvedge_mesh_index_count(selvedge_result_mesh(results[0])),
            selvedge_mesh_index_count(selvedge_result_mesh(results[1])));
  for (selvedge_result* const result : results)
    selvedge_result_free(result);
  selvedge_options_free(options);
  selvedge_mesh_free(mesh);
}

#ifdef SELVEDGE_APP
using Choices = std::vector<std::pair<std::string, std::string>>;

// Makes levels of a file by the program and in C, which are the same bytes, with the same in their reports.
// Returns the report of the program.
nlohmann::json levels_of_both(const Workspace& folder, const std::string& input, const std::string& ratios,
                              const Choices& choices)
{
  const std::string path = folder / "levels.json";
  std::vector<std::string> words{"simplify", input, "-o",     folder / "program_{lod}.obj", "--lods", ratios,
                                 "--report", path,  "--quiet"};
  selvedge_options* const options = selvedge_options_new();
  EXPECT_EQ(selvedge_options_set(options, "lods", ratios.c_str()), 0) << selvedge_last_error();
  EXPECT_EQ(selvedge_options_set(options, "log", "true"), 0);
  for (const auto& [name, value] : choices) {
    EXPECT_EQ(selvedge_options_set(options, name.c_str(), value.c_str()), 0) << selvedge_last_error();
    std::string word = "--" + (name == "part_ratios" ? "ratio" : name);
    std::replace(word.begin(), word.end(), '_', '-');
    words.push_back(word);
    if (value != "true")
      words.push_back(value);
  }
  if (std::find(words.begin(), words.end(), "--placement") == words.end())
    words.insert(words.end(), {"--placement", "vertices"});
  EXPECT_EQ(run_app(words).code, 0);
  const nlohmann::json expected = nlohmann::json::parse(contents_of(path));
  selvedge_mesh* const mesh = selvedge_mesh_read(input.c_str());
  std::vector<selvedge_result*> results(expected["lods"].size());
  EXPECT_EQ(selvedge_reduce_lods(mesh, options, results.data(), results.size()), 0) << selvedge_last_error();
  for (std::size_t i = 0; i < results.size(); ++i) {
    SCOPED_TRACE(i);
    const selvedge_mesh* const reduced = selvedge_result_mesh(results[i]);
    const std::string number = std::to_string(i + 1);
    EXPECT_EQ(selvedge_mesh_write(reduced, (folder / ("c_" + number + ".obj")).c_str()), 0);
    EXPECT_TRUE(contents_of(folder / ("c_" + number + ".obj")) ==
                contents_of(folder / ("program_" + number + ".obj")));
    nlohmann::json report = nlohmann::json::parse(selvedge_result_report(results[i]));
    EXPECT_EQ(report["options"]["lods"], expected["options"]["lods"]);
    EXPECT_EQ(selvedge_result_is_accepted(results[i]), 1);
    EXPECT_EQ(selvedge_result_is_reached(results[i]), int(report["target"]["reached"].get<bool>()));
    for (const char* of_run : {"schema", "version", "command", "options", "seconds"})
      report.erase(of_run);
    nlohmann::json of_program = expected["lods"][i];
    of_program.erase("output");
    EXPECT_EQ(report, of_program);

    // The log is that of this level.
    const std::string log = selvedge_result_log(results[i]);
    EXPECT_EQ(selvedge_replay(mesh, log.c_str()), 1) << selvedge_last_error();
    const std::string end = "\nresult " + report["collapses"].dump() + ' ' + report["faces"]["output"].dump();
    EXPECT_NE(log.find(end + ' '), std::string::npos) << log.substr(log.rfind("\nresult"));
  }
  for (selvedge_result* const result : results) // each may outlive the others
    selvedge_result_free(result);
  selvedge_options_free(options);
  selvedge_mesh_free(mesh);
  return expected;
}

TEST(Bindings, MakeTheLevelsOfDetailThatTheProgramMakes)
{
  const Workspace folder;
  const std::string skirt = folder.generate("skirt", "skirt.obj", 1500),
                    spheres = folder.generate("nested", "spheres.obj", 1000);
  for (const Choices& choices : {Choices{}, Choices{{"placement", "optimal"}, {"sewn", "true"}},
                                 Choices{{"cells", "true"}}, Choices{{"part_ratios", "waistband=0.8"}},
                                 Choices{{"drop_part", "waistband"}}, Choices{{"error", "0.004"}}}) {
    SCOPED_TRACE(choices.empty() ? "" : choices.front().first);
    levels_of_both(folder, skirt, "0.25,0.6,0.1", choices);
  }
  levels_of_both(folder, spheres, "0.5", {});
  // The last level misses its target, and is made again.
  const nlohmann::json missed = levels_of_both(folder, spheres, "0.5,0.01", {})["lods"][1];
  EXPECT_FALSE(missed["target"]["within_reach"].is_null());
  const nlohmann::json everywhere =
      levels_of_both(folder, skirt, "0.6,0.05", {{"error", "0.004"}, {"error_everywhere", "true"}});
  EXPECT_GT(everywhere["error_search"]["reductions"], 1);
}
#endif

} // namespace
} // namespace selvedge::test
