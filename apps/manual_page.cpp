// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "manual_page.h"

#include "Help_formatter.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace selvedge::app {
namespace {

// Returns text that troff prints as it is, also at the beginning of a line.
std::string literal(const std::string& text)
{
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-' || c == '\'' || c == '`' || c == '^' || c == '~') // would become typographic ones
      escaped += c == '-' ? "\\-" : c == '\'' ? "\\(aq" : c == '`' ? "\\(ga" : c == '^' ? "\\(ha" : "\\(ti";
    else
      escaped += c;
  }
  return escaped.rfind('.', 0) == 0 ? "\\&" + escaped : escaped;
}

std::string upper_case(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

void print_options(std::ostream& page, const CLI::App& command)
{
  for (const CLI::Option* option : command.get_options(
           [](const CLI::Option* o) { return !o->nonpositional() && !o->get_group().empty(); }))
    page << ".TP\n\\fI" << literal(option->get_name()) << "\\fR\n"
         << literal(Help_formatter::explanation_of(option)) << '\n';
  for (const std::string& group : command.get_groups()) {
    const auto options = command.get_options([&](const CLI::Option* o) {
      return o->nonpositional() && !group.empty() && o->get_group() == group;
    });
    if (!options.empty() && group != "Options")
      page << ".PP\n" << literal(group) << ":\n";
    for (const CLI::Option* option : options)
      page << ".TP\n\\fB" << literal(option->get_name(false, true)) << "\\fR"
           << literal(Help_formatter::value_of(option)) << '\n'
           << literal(Help_formatter::explanation_of(option)) << '\n';
  }
}

// Lines that are indented stay as they are; others are filled.
void print_footer(std::ostream& page, const std::string& footer)
{
  std::istringstream lines(footer);
  bool is_example = false;
  page << ".PP\n";
  for (std::string line; std::getline(lines, line);) {
    if (const bool is_indented = line.rfind("  ", 0) == 0; is_indented != is_example) {
      page << (is_indented ? ".RS 2\n.nf\n" : ".fi\n.RE\n");
      is_example = is_indented;
    }
    page << (line.empty() ? ".PP" : literal(is_example ? line.substr(2) : line)) << '\n';
  }
  if (is_example)
    page << ".fi\n.RE\n";
}

} // namespace

std::string manual_page(const CLI::App& program)
{
  const std::string name = program.get_name();
  std::ostringstream page;
  page << ".TH " << upper_case(name) << " 1 \"\" \"" << program.version() << "\"\n"
       << ".SH NAME\n"
       << name << " \\- simplify layered triangle meshes so that no layer pierces another\n"
       << ".SH SYNOPSIS\n.B " << name << "\n.I SUBCOMMAND\n[OPTIONS] ...\n"
       << ".SH DESCRIPTION\n"
       << literal(program.get_description()) << '\n'
       << ".SH OPTIONS\n";
  print_options(page, program);
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    page << ".SH " << upper_case(name + ' ' + command->get_name()) << '\n'
         << literal(command->get_description()) << '\n';
    print_options(page, *command);
    print_footer(page, command->get_footer());
  }
  page << ".SH EXAMPLES AND EXIT STATUS\n";
  print_footer(page, program.get_footer());
  return page.str();
}

} // namespace selvedge::app
