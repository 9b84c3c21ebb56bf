// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Help_formatter.h"
#include "completion.h"
#include "interruption.h"
#include "manual_page.h"
#include "subcommands.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <array>
#include <cstddef>
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

// Counts the letters to be replaced, added or left out, and the neighbours to be exchanged, to make one word
// of the other.
std::size_t letters_apart(const std::string& a, const std::string& b)
{
  std::vector<std::vector<std::size_t>> apart(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      apart[i][j] = i + j;
      if (i == 0 || j == 0)
        continue;
      apart[i][j] =
          std::min({apart[i - 1][j - 1] + (a[i - 1] != b[j - 1]), apart[i - 1][j] + 1, apart[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        apart[i][j] = std::min(apart[i][j], apart[i - 2][j - 2] + 1);
    }
  return apart.back().back();
}

// Says that there is no such word, and asks whether the nearest one is meant, if it is near.
std::string unknown(const std::string& kind, const std::string& word, const std::vector<std::string>& words)
{
  const auto nearest =
      std::min_element(words.begin(), words.end(), [&](const std::string& a, const std::string& b) {
        return letters_apart(word, a) < letters_apart(word, b);
      });
  const std::string message = "there is no " + kind + " '" + word + "'";
  if (letters_apart(word, *nearest) <= std::max<std::size_t>(1, nearest->size() / 3))
    return message + "; did you mean '" + *nearest + "'?";
  return message;
}

// Says why an argument is not expected after a subcommand.
std::string not_expected(const std::string& argument, const CLI::App& command)
{
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options())
    options.push_back(option->get_name());
  for (const char* dash : {"\u2013", "\u2014", "\u2212"})
    if (argument.rfind(dash, 0) == 0)
      return '\'' + argument + "' begins with a long dash in place of hyphens; type it anew, as --ratio";
  if (argument.rfind("--", 0) == 0)
    return unknown("option", argument.substr(0, argument.find('=')), options);
  if (argument.size() > 1 && argument[0] == '-')
    return "there is no option '" + argument + "'; a file of such a name is './" + argument + '\'';
  return '\'' + argument +
         "' is not expected here; names with blanks, and patterns such as 'frame_*.obj', need quotes";
}

// Has every option of a command, and of those within it, refuse an empty value, and say what it may be.
void refuse_empty_values(CLI::App& command)
{
  for (CLI::Option* const option : command.get_options()) {
    if (option->get_items_expected_max() == 0) // a flag
      continue;
    const std::string values = option->get_type_name();
    const std::string message = "the value is empty; give " + (values.empty() ? "a name" : values);
    // The first of its tests, which a transformation is.
    option->transform(
        CLI::Validator([message](const std::string& text) { return text.empty() ? message : ""; }, ""));
  }
  for (CLI::App* const within : command.get_subcommands({}))
    refuse_empty_values(*within);
}

// Returns the arguments in reverse order, as CLI11 wants them. An option followed by `=` alone has an empty
// value; CLI11 would take the next argument for it.
std::vector<std::string> arguments_reversed(int argc, char** argv)
{
  std::vector<std::string> result;
  for (int i = 1; i < argc; ++i) {
    std::string argument = argv[i];
    const bool is_without_value =
        argument.size() > 3 && argument.rfind("--", 0) == 0 && argument.find('=') == argument.size() - 1;
    if (is_without_value)
      argument.pop_back();
    result.push_back(std::move(argument));
    if (is_without_value)
      result.emplace_back();
  }
  std::reverse(result.begin(), result.end());
  return result;
}

Exit_code run(int argc, char** argv)
{
  CLI::App app("Reduces triangle meshes whose layers lie close together, such as garments, so that no layer\n"
               "ever pierces, touches or passes through another. Every such decision is exact.");
  app.name("selvedge");
  app.formatter(std::make_shared<Help_formatter>());
  app.set_version_flag("--version", "selvedge " SELVEDGE_VERSION);
  const auto print = [](const std::string& text) { throw CLI::CallForVersion(text, 0); };
  app.add_flag_callback(
      "--man", [&] { print(manual_page(app)); }, "Display the manual page in the language of man and exit");
  app.add_option_function<std::string>(
         "--completion", [&](const std::string& shell) { print(completion(app, shell)); },
         "Display a script by which a shell completes command lines and exit")
      ->type_name("bash|zsh|fish");
  app.require_subcommand(1);
  std::string footer = "Examples:\n"
                       "  selvedge generate skirt -o skirt.obj --faces 50000 --layers 3\n"
                       "  selvedge info skirt.obj\n"
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
  const std::array<Command, 7> commands{
      add("simplify", "Reduce a mesh to fewer faces, judge the result, and write it.", add_simplify),
      add("verify", "Judge a mesh, or compare a reduced mesh with its original.", add_verify),
      add("info", "Say what is in a mesh, and what a reduction would find in it.", add_info),
      add("level", "Make any state of a reduction from its progressive file.", add_level),
      add("replay", "Judge every step of a reduction, from its log.", add_replay),
      add("generate", "Make a garment in layers or another test scene, free of intersections.", add_generate),
      add("cells", "Cut a mesh that is too large for one machine into pieces, and join them again.",
          add_cells)};

  refuse_empty_values(app);
  std::vector<std::string> names;
  for (const Command& command : commands)
    names.push_back(command.app->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end())
    return fail(exit_usage, unknown("subcommand", argv[1], names) + " (see selvedge --help)");

  try {
    app.parse(arguments_reversed(argc, argv));
  } catch (const CLI::Success& wish) {
    app.exit(wish); // prints the help or the version on stdout
    return exit_done;
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> named = app.get_subcommands();
    const std::string command = named.empty() ? "" : named.front()->get_name() + ' ';
    std::string message = error.what();
    // An option that is not known may be why something is missing.
    if (!named.empty() &&
        (dynamic_cast<const CLI::ExtrasError*>(&error) || dynamic_cast<const CLI::RequiredError*>(&error))) {
      const std::vector<std::string> extra = app.remaining(true);
      char** const end = std::find(argv, argv + argc, std::string("--"));
      char** const first = std::find_if(argv + 1, end, [&extra](const char* argument) {
        return std::find(extra.begin(), extra.end(), argument) != extra.end();
      });
      if (first != end)
        message = not_expected(*first, *named.front());
    }
    return fail(exit_usage, message + " (see selvedge " + command + "--help)");
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
