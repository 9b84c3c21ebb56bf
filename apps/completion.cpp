// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "completion.h"

#include "Help_formatter.h"

#include <selvedge/Error.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

namespace selvedge::app {
namespace {

// Returns the words that an option takes: those of "vertices|optimal", and "none" of "E|none".
std::vector<std::string> words_of(const CLI::Option* option)
{
  std::vector<std::string> words;
  const std::string type = option->get_type_name();
  if (type.find('|') == std::string::npos)
    return words;
  std::istringstream alternatives(type);
  for (std::string word; std::getline(alternatives, word, '|');)
    if (std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::islower(c); }))
      words.push_back(word);
  return words;
}

std::vector<const CLI::Option*> options_of(const CLI::App& command)
{
  return command.get_options(
      [](const CLI::Option* option) { return option->nonpositional() && !option->get_group().empty(); });
}

std::vector<const CLI::App*> commands_of(const CLI::App& program)
{
  return program.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> names_of(const CLI::Option* option)
{
  std::vector<std::string> names;
  for (const std::string& name : option->get_snames())
    names.push_back('-' + name);
  for (const std::string& name : option->get_lnames())
    names.push_back("--" + name);
  return names;
}

std::string joined(const std::vector<std::string>& words, const char* separator = " ")
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : separator) + word;
  return text;
}

// The first sentence, which is all that a list of completions has room for.
std::string first_sentence(const std::string& text)
{
  return text.substr(0, text.find(". "));
}

// In single quotes, as sh, zsh and fish read them. `also` are characters that need a backslash besides.
std::string quoted(const std::string& text, const std::string& also = "")
{
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'')
      quoted += "'\\''";
    else if (also.find(c) != std::string::npos)
      quoted += std::string("\\") + c;
    else
      quoted += c;
  }
  return quoted + '\'';
}

void print_bash_options(std::ostream& script, const CLI::App& command)
{
  std::vector<std::string> all;
  script << "    case $previous in\n";
  for (const CLI::Option* option : options_of(command)) {
    const std::vector<std::string> names = names_of(option);
    all.insert(all.end(), names.begin(), names.end());
    if (const std::vector<std::string> words = words_of(option); !words.empty())
      script << "      " << joined(names, "|") << ") words=" << quoted(joined(words)) << " ;;\n";
  }
  script << "      *) [[ $current == -* ]] && words=" << quoted(joined(all)) << " ;;\n    esac\n";
}

std::string bash(const CLI::App& program)
{
  const std::string name = program.get_name();
  std::vector<std::string> commands;
  for (const CLI::App* command : commands_of(program))
    commands.push_back(command->get_name());
  std::ostringstream script;
  script << "# Completes command lines of " << name << " in bash.\n_" << name << "()\n{\n"
         << "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} words=\n"
         << "  case $COMP_CWORD:${COMP_WORDS[1]} in\n"
         << "  1:[^-]* | 1:) words=" << quoted(joined(commands)) << " ;;\n";
  for (const CLI::App* command : commands_of(program)) {
    script << "  *:" << command->get_name() << ")\n";
    print_bash_options(script, *command);
    script << "    ;;\n";
  }
  script << "  *)\n";
  print_bash_options(script, program);
  script << "    ;;\n  esac\n"
         << "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         << "}\ncomplete -o default -F _" << name << ' ' << name << '\n';
  return script.str();
}

void print_zsh_options(std::ostream& script, const CLI::App& command)
{
  for (const CLI::Option* option : options_of(command))
    for (const std::string& option_name : names_of(option)) {
      std::string spec =
          quoted('*' + option_name + '[' + first_sentence(option->get_description()) + ']', "[]:");
      // The brackets around the explanation are the two that are no part of it.
      spec.replace(spec.find("\\["), 2, "[");
      spec.replace(spec.rfind("\\]"), 2, "]");
      script << " \\\n      " << spec;
      if (option->get_type_size() != 0) {
        const std::vector<std::string> words = words_of(option);
        script << quoted(":value:" + (words.empty() ? "_files" : '(' + joined(words) + ')'));
      }
    }
  script << '\n';
}

std::string zsh(const CLI::App& program)
{
  const std::string name = program.get_name();
  std::ostringstream script;
  script << "#compdef " << name << "\n# Completes command lines of " << name << " in zsh.\n_" << name
         << "()\n{\n  case $CURRENT:$words[2] in\n  2:[^-]* | 2:)\n    local -a commands=(";
  for (const CLI::App* command : commands_of(program))
    script << "\n      " << quoted(command->get_name() + ':' + command->get_description());
  script << ")\n    _describe subcommand commands ;;\n";
  for (const CLI::App* command : commands_of(program)) {
    script << "  *:" << command->get_name()
           << ")\n    shift words\n    (( CURRENT-- ))\n    _arguments '*:file:_files'";
    print_zsh_options(script, *command);
    script << "    ;;\n";
  }
  script << "  *)\n    _arguments";
  print_zsh_options(script, program);
  script << "    ;;\n  esac\n}\n"
         << "if [ \"$funcstack[1]\" = _" << name << " ]; then _" << name << " \"$@\"; else compdef _" << name
         << ' ' << name << "; fi\n";
  return script.str();
}

void print_fish_options(std::ostream& script, const std::string& begin, const CLI::App& command)
{
  for (const CLI::Option* option : options_of(command)) {
    script << begin;
    for (const std::string& letter : option->get_snames())
      script << " -s " << letter;
    for (const std::string& word : option->get_lnames())
      script << " -l " << word;
    if (option->get_type_size() != 0)
      script << " -r";
    if (const std::vector<std::string> words = words_of(option); !words.empty())
      script << " -f -a " << quoted(joined(words));
    script << " -d " << quoted(first_sentence(option->get_description())) << '\n';
  }
}

std::string fish(const CLI::App& program)
{
  const std::string begin = "complete -c " + program.get_name();
  const std::string first = begin + " -n __fish_use_subcommand";
  std::ostringstream script;
  script << "# Completes command lines of " << program.get_name() << " in fish.\n";
  print_fish_options(script, first, program);
  for (const CLI::App* command : commands_of(program)) {
    script << first << " -f -a " << command->get_name() << " -d " << quoted(command->get_description())
           << '\n';
    print_fish_options(script, begin + " -n '__fish_seen_subcommand_from " + command->get_name() + '\'',
                       *command);
  }
  return script.str();
}

} // namespace

std::string completion(const CLI::App& program, const std::string& shell)
{
  if (shell == "bash")
    return bash(program);
  if (shell == "zsh")
    return zsh(program);
  if (shell == "fish")
    return fish(program);
  throw Argument_error("--completion: '" + shell + "' is none of bash, fish, zsh");
}

} // namespace selvedge::app
