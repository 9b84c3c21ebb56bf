// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Help_formatter.h"
#include "interruption.h"
#include "subcommands.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace selvedge::app;

/// Prints the message as one line, whatever characters the name of a file has.
Exit_code fail(Exit_code code, std::string message)
{
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  std::cerr << "selvedge: " << message << std::endl;
  return code;
}

Exit_code run(int argc, char** argv)
{
  CLI::App app("Reduces triangle meshes whose layers lie close together, such as garments, so that no layer\n"
               "ever pierces, touches or passes through another. Every such decision is exact.");
  app.name("selvedge");
  app.formatter(std::make_shared<Help_formatter>());
  app.set_version_flag("--version", "selvedge " SELVEDGE_VERSION);
  app.require_subcommand(1);
  std::string footer = "Examples:\n"
                       "  selvedge generate skirt -o skirt.obj --faces 50000 --layers 3\n"
                       "  selvedge simplify skirt.obj -o small.obj --ratio 0.2\n"
                       "  selvedge verify small.obj --against skirt.obj\n"
                       "`selvedge SUBCOMMAND --help` explains its options.\n\n"
                       "Exit codes:";
  for (const auto& [code, meaning] : exit_code_descriptions)
    footer += "\n  " + std::to_string(code) + "  " + meaning;
  app.footer(footer);

  struct Command
  {
    CLI::App* app;
    Action action;
  };
  const auto add = [&app](const char* name, const char* description, Action (*declare)(CLI::App&)) {
    CLI::App* const command = app.add_subcommand(name, description);
    return Command{command, declare(*command)};
  };
  const std::array<Command, 4> commands{
      add("simplify", "Reduce a mesh to fewer faces, judge the result, and write it.", add_simplify),
      add("verify", "Judge a mesh, or compare a reduced mesh with its original.", add_verify),
      add("replay", "Judge every step of a reduction, from its log.", add_replay),
      add("generate", "Make a garment in layers or another test scene, free of intersections.",
          add_generate)};

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {
    app.exit(wish); // prints the help or the version on stdout
    return exit_done;
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> named = app.get_subcommands();
    const std::string command = named.empty() ? "" : named.front()->get_name() + ' ';
    return fail(exit_usage, error.what() + (" (see selvedge " + command + "--help)"));
  }
  return std::find_if(commands.begin(), commands.end(), [](const Command& c) { return c.app->parsed(); })
      ->action();
}

} // namespace

int main(int argc, char** argv)
{
  watch_for_interruption();
  const selvedge::Cancellation_scope scope(is_interrupted);
  try {
    return run(argc, argv);
  } catch (const selvedge::Interrupted& error) {
    return fail(exit_interrupted, error.what() + std::string("; nothing was written"));
  } catch (const selvedge::Argument_error& error) {
    return fail(exit_usage, error.what());
  } catch (const selvedge::Output_error& error) {
    return fail(exit_not_written, error.what());
  } catch (const selvedge::Input_error& error) {
    return fail(exit_bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_bad_input, "there is not enough memory for this mesh");
  } catch (const std::exception& error) {
    return fail(exit_bad_input, error.what());
  }
}
