// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_HELP_FORMATTER_H
#define SELVEDGE_APPS_HELP_FORMATTER_H

#include <CLI/CLI.hpp>

#include <cstddef>
#include <sstream>
#include <string>

namespace selvedge::app {

/// Prints the help of each option as sentences in lines of limited width. Its default stands at the end.
class Help_formatter : public CLI::Formatter
{
public:
  std::string make_option_opts(const CLI::Option* option) const override { return value_of(option); }
  std::string make_option_desc(const CLI::Option* option) const override
  {
    return wrapped(explanation_of(option));
  }

  /// Returns what follows the name of an option, such as " FILE", with a blank before it.
  static std::string value_of(const CLI::Option* option)
  {
    if (option->get_type_size() == 0 || option->get_type_name().empty())
      return "";
    const bool is_list = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    return ' ' + option->get_type_name() + (is_list ? " ..." : "");
  }

  /// Returns the sentences on an option, in one line.
  static std::string explanation_of(const CLI::Option* option)
  {
    std::string text = option->get_description();
    if (option->get_required())
      text += " (required)";
    if (!option->get_default_str().empty())
      text += " (default: " + option->get_default_str() + ')';
    for (const CLI::Option* other : option->get_excludes())
      text += " (not with " + other->get_name() + ')';
    return text;
  }

private:
  static std::string wrapped(const std::string& text)
  {
    constexpr std::size_t width = 72;
    std::istringstream words(text);
    std::string lines;
    std::size_t length = 0; // of the last line
    for (std::string word; words >> word; length += word.size()) {
      if (length > 0 && length + 1 + word.size() > width) {
        lines += '\n';
        length = 0;
      } else if (length > 0) {
        lines += ' ';
        ++length;
      }
      lines += word;
    }
    return lines;
  }
};

} // namespace selvedge::app

#endif // SELVEDGE_APPS_HELP_FORMATTER_H
