// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_DROPPED_PARTS_OPTIONS_H
#define SELVEDGE_APPS_DROPPED_PARTS_OPTIONS_H

#include "standard_streams.h"
#include "subcommands.h"

#include <selvedge/Error.h>
#include <selvedge/Triangle_soup.h>
#include <selvedge/drop_parts.h>

#include <CLI/CLI.hpp>

#include <string>

namespace selvedge::app {

/// Declares --drop-part and --drop-smaller with these descriptions, in this group of options.
inline void add_dropped_parts_options(CLI::App& command, Parts_to_drop& parts, const std::string& of_part,
                                      const std::string& of_size, const char* group)
{
  command.add_option("--drop-part", parts.names, of_part + " May be given several times.")
      ->type_name("PART")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(group);
  command.add_option("--drop-smaller", parts.smaller_than, of_size)
      ->check(positive())
      ->type_name("LENGTH")
      ->group(group);
}

/// Leaves out parts of a mesh that was read from a file, to which errors refer.
inline Parts_left drop_parts(Triangle_soup& soup, const Parts_to_drop& parts, const std::string& file)
{
  try {
    return selvedge::drop_parts(soup, parts);
  } catch (const Argument_error& error) {
    throw Argument_error(std::string("--drop-part: ") + error.what());
  } catch (const Input_error& error) {
    throw Input_error(input_name(file) + ": " +
                      (parts.smaller_than > 0
                           ? parts.names.empty() ? "--drop-smaller: " : "--drop-part and --drop-smaller: "
                           : "--drop-part: ") +
                      error.what());
  }
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_DROPPED_PARTS_OPTIONS_H
