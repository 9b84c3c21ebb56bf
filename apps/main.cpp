// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "interruption.h"
#include "subcommands.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <utility>

namespace {

using namespace selvedge::app;

/// One line, whatever is in a file name.
Exit_code fail(Exit_code code, std::string message)
{
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  std::cerr << "selvedge: " << message << std::endl;
  return code;
}

Exit_code run(int argc, char** argv)
{
  CLI::App app("Reduces triangle meshes that lie close together so that no layer ever pierces another, "
               "decided exactly.");
  app.name("selvedge");
  app.set_version_flag("--version", "selvedge " SELVEDGE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  selvedge generate skirt -o skirt.obj --faces 50000 --layers 3\n"
      "  selvedge simplify skirt.obj -o small.obj --ratio 0.2\n"
      "  selvedge verify small.obj --against skirt.obj\n"
      "`selvedge COMMAND --help` says more.\n\n"
      "Exit codes: 0 done and verified, 1 not verified (or target missed with --require-target), 2 usage,\n"
      "3 unreadable or unacceptable input, 4 output not written, 5 interrupted.");

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
      add("simplify", "Reduce a mesh, judge the result, and write it.", add_simplify),
      add("verify", "Judge a mesh, or a result against its original.", add_verify),
      add("replay", "Judge a reduction step by step, by its log.", add_replay),
      add("generate", "Make a layered garment or a hard scene, embedded by construction.", add_generate)};

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {
    app.exit(wish); // help or version, on stdout
    return exit_done;
  } catch (const CLI::ParseError& error) {
    return fail(exit_usage, std::string(error.what()) + " (selvedge --help says more)");
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
