// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "part_pairs.h"

#include <selvedge/Error.h>
#include <selvedge/Parts.h>

namespace selvedge::app {

CLI::Option* add_part_pairs_option(CLI::App& command, std::vector<std::string>& texts,
                                   const char* description)
{
  return command.add_option("--may-intersect", texts, description)
      ->type_name("PART:PART")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<std::pair<std::string, std::string>> part_pairs(const std::vector<std::string>& texts,
                                                            const Triangle_soup& soup)
{
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& text : texts)
    try {
      pairs.push_back(parts_in_pair(soup, text));
    } catch (const Argument_error& error) {
      throw Argument_error(std::string("--may-intersect: ") + error.what());
    }
  return pairs;
}

} // namespace selvedge::app
