// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The tables of the documentation say what the code says.

#include "Documentation.h"

#include "apps/exit_codes.h"

#include <selvedge/Surface_mesh_simplification/Hindrances.h>
#include <selvedge/Surface_mesh_simplification/Refusals.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace selvedge::test {
namespace {

TEST(App_documentation, ReadmeAndHelpListTheExitCodes)
{
  const std::string help = run_app({"--help"}).out;
  std::vector<Row> expected;
  for (const auto& [code, meaning] : app::exit_code_descriptions) {
    expected.push_back({std::to_string(code), meaning});
    EXPECT_NE(help.find("\n  " + std::to_string(code) + "  " + meaning), std::string::npos) << help;
  }
  EXPECT_EQ(documented_rows("README.md", [](const auto& heading) { return heading == "### Exit codes"; }),
            expected);
}

TEST(App_documentation, ListsTheRulesOfRefusalInTheirOrder)
{
  std::vector<std::string> expected, documented;
  for (const Refusals::Rule& rule : Refusals::rules())
    expected.push_back(std::string("`refused.") + rule.key + "` *" + rule.name + '*');
  for (const Row& row : documented_rows(
           "docs/report.md", [](const auto& heading) { return heading == "### Refused collapses"; }))
    documented.push_back(row.at(0) + ' ' + row.at(1).substr(0, row.at(1).find(':')));
  EXPECT_EQ(documented, expected);
}

TEST(App_documentation, ListsTheReasonsThatHoldEdgesBackInTheirOrder)
{
  std::vector<std::string> expected, documented;
  for (const Hindrances::Description& reason : Hindrances::descriptions())
    expected.push_back(std::string("`hindrances.") + reason.key + "` *" + reason.name + '*');
  for (const Row& row : documented_rows(
           "docs/report.md", [](const auto& heading) { return heading == "### What holds edges back"; }))
    documented.push_back(row.at(0) + ' ' + row.at(1).substr(0, row.at(1).find(':')));
  EXPECT_EQ(documented, expected);
}

// Each key of an option is the option's name, and what --help states as its default is what a run has without
// it.
TEST(App_documentation, OptionsInReportsAreThoseOfTheHelp)
{
  const std::map<std::string, std::string> other_names{{"intersection_check", "no-intersection-check"},
                                                       {"part_ratios", "ratio"}};
  const Workspace folder;
  const std::string in = folder.generate("grid", "in.obj", 200), report = folder / "report.json";
  ASSERT_EQ(
      run_app({"simplify", in, "-o", folder / "out.obj", "--ratio", "0.5", "--quiet", "--report", report})
          .code,
      0);
  const nlohmann::json options = nlohmann::json::parse(contents_of(report))["options"];
  const std::string help = run_app({"simplify", "--help"}).out;
  std::size_t defaults = 0;
  for (const auto& [key, value] : options.items()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    if (const auto other = other_names.find(key); other != other_names.end())
      name = other->second;
    const std::size_t begin = help.find("\n  --" + name + ' ');
    ASSERT_NE(begin, std::string::npos) << name;
    const std::string paragraph = help.substr(begin, help.find("\n  --", begin + 1) - begin);
    const std::string mark = "(default: ";
    const std::size_t stated = paragraph.find(mark);
    if (stated == std::string::npos || value.is_null())
      continue;
    const std::size_t first = stated + mark.size();
    const std::string text = paragraph.substr(first, paragraph.find(')', first) - first);
    if (value.is_string()) {
      EXPECT_EQ(text, value.get<std::string>()) << name;
    } else {
      EXPECT_EQ(std::stod(text), value.get<double>()) << name;
    }
    ++defaults;
  }
  EXPECT_EQ(defaults, 24u);
}

} // namespace
} // namespace selvedge::test
