// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "part_pairs.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>

namespace selvedge::app {
namespace {

using Names = std::pair<std::string, std::string>;

Names names_in(const std::string& text, const Triangle_soup& soup)
{
  const auto fail = [&](const std::string& why) {
    throw Argument_error("--may-intersect: '" + text + "': " + why);
  };
  std::vector<Names> found;
  std::string unknown = "this is not of the form A:B";
  for (std::size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
    const Names names{text.substr(0, colon), text.substr(colon + 1)};
    try {
      triangles_named(soup, names.first);
      triangles_named(soup, names.second);
      found.push_back(names);
    } catch (const Argument_error& error) {
      unknown = error.what();
    }
  }
  if (found.empty())
    fail(unknown);
  if (found.size() > 1)
    fail("this may be '" + found[0].first + "' and '" + found[0].second + "', or '" + found[1].first +
         "' and '" + found[1].second + "'; rename a part");
  return found.front();
}

} // namespace

CLI::Option* add_part_pairs_option(CLI::App& command, std::vector<std::string>& texts,
                                   const char* description)
{
  return command.add_option("--may-intersect", texts, description)
      ->type_name("PART:PART")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<Names> part_pairs(const std::vector<std::string>& texts, const Triangle_soup& soup)
{
  std::vector<Names> pairs;
  for (const std::string& text : texts)
    pairs.push_back(names_in(text, soup));
  return pairs;
}

} // namespace selvedge::app
