// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "part_pairs.h"

namespace selvedge::app {

CLI::Option* add_part_pairs_option(CLI::App& command, std::vector<std::string>& texts,
                                   const char* description)
{
  return command.add_option("--may-intersect", texts, description)
      ->type_name("PART:PART")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

} // namespace selvedge::app
