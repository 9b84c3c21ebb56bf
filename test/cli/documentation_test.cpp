// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The tables of the documentation say what the code says.

#include "Documentation.h"

#include "apps/exit_codes.h"

#include <selvedge/Surface_mesh_simplification/Hindrances.h>
#include <selvedge/Surface_mesh_simplification/Refusals.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

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

// Each command in the pages has options that the program has.
TEST(App_documentation, CommandsHaveOptionsThatThereAre)
{
  const std::filesystem::path sources = SELVEDGE_SOURCES;
  std::vector<std::filesystem::path> pages{sources / "README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(sources / "docs"))
    if (entry.path().extension() == ".md")
      pages.push_back(entry.path());
  std::map<std::string, std::string> helps;
  const std::regex command("selvedge ([a-z]+) ([^\n`#|]*)"), option("(^|[ \\[])(--[a-z][a-z-]*)");
  std::size_t count = 0;
  for (const std::filesystem::path& page : pages) {
    const std::string text = contents_of(page);
    for (std::sregex_iterator found(text.begin(), text.end(), command), end; found != end; ++found) {
      const std::string name = found->str(1), arguments = found->str(2);
      if (helps.find(name) == helps.end())
        helps[name] = run_app({name, "--help"}).out;
      for (std::sregex_iterator at(arguments.begin(), arguments.end(), option); at != end; ++at, ++count)
        EXPECT_TRUE(std::regex_search(helps[name], std::regex("\n  (-[a-z],)?" + at->str(2) + "[ \n]")))
            << page << ": " << found->str();
    }
  }
  EXPECT_GT(count, 100u);
}

TEST(App_documentation, TheHelpOfReplayShowsHowTheSameFileIsMade)
{
  const Workspace folder;
  folder.generate("sheets", "jacket.obj", 2000);
  const std::string help = run_app({"replay", "--help"}).out;
  for (const char* begin : {"simplify jacket.obj -o", "replay jacket.obj jacket.log -o"}) {
    const std::size_t at = help.find(begin);
    ASSERT_NE(at, std::string::npos) << help;
    std::istringstream words(help.substr(at, std::min(help.find('\n', at), help.find(" &&", at)) - at));
    std::vector<std::string> arguments;
    for (std::string word; words >> word;)
      arguments.push_back(word.find_first_of("jsa") == 0 && word.find('.') < word.size() ? folder / word
                                                                                         : word);
    EXPECT_EQ(run_app(arguments).code, 0);
  }
  EXPECT_TRUE(contents_of(folder / "small.obj") == contents_of(folder / "again.obj"));
}

} // namespace
} // namespace selvedge::test
