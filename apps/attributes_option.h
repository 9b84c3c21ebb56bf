// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_ATTRIBUTES_OPTION_H
#define SELVEDGE_APPS_ATTRIBUTES_OPTION_H

#include "standard_streams.h"

#include <selvedge/Error.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/attributes.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace selvedge::app {

/// Declares --drop-attribute with this description.
inline CLI::Option* add_attributes_option(CLI::App& command, std::vector<std::string>& names,
                                          const std::string& description)
{
  return command.add_option("--drop-attribute", names, description + " May be given several times.")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

/// Leaves out attributes of a mesh that was read from a file (`drop_attributes`), to which errors refer.
inline std::size_t drop_attributes(Triangle_soup& soup, const std::vector<std::string>& names,
                                   const std::string& file)
{
  try {
    return selvedge::drop_attributes(soup, names);
  } catch (const Input_error& error) {
    throw Input_error(input_name(file) + ": --drop-attribute: " + error.what());
  }
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_ATTRIBUTES_OPTION_H
