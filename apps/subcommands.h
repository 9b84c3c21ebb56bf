// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_SUBCOMMANDS_H
#define SELVEDGE_APPS_SUBCOMMANDS_H

#include "exit_codes.h"
#include "text.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <string>

namespace selvedge::app {

/// Carries out a subcommand once its options are read.
using Action = std::function<Exit_code()>;

/// Each of these declares the options of its subcommand and returns the action that carries it out.
Action add_simplify(CLI::App& command);
Action add_verify(CLI::App& command);
Action add_replay(CLI::App& command);
Action add_info(CLI::App& command);
Action add_generate(CLI::App& command);
Action add_cells(CLI::App& command);
Action add_level(CLI::App& command);

/// Accepts a positive, finite number.
inline CLI::Validator positive()
{
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value > 0 &&
            value < std::numeric_limits<double>::infinity())
          return {};
        return "'" + text + "' is not a positive number";
      },
      "");
}

/// Returns the question whether 0.3 was meant, after 30, 30% or 0,3 where a share should stand; else nothing.
inline std::string share_meant(std::string text)
{
  const bool is_percentage = !text.empty() && text.back() == '%';
  if (is_percentage)
    text.pop_back();
  std::replace(text.begin(), text.end(), ',', '.');
  double share = -1;
  if (!CLI::detail::lexical_cast(text, share))
    return {};
  if (is_percentage || (share > 1 && share == std::floor(share)))
    share /= 100;
  return share >= 0 && share <= 1 ? "; did you mean " + with_digits(share, "%g") + '?' : "";
}

/// Accepts a number in [least, most]. Unlike `CLI::Range` it refuses NaN.
inline CLI::Validator in_range(double least, double most = std::numeric_limits<double>::infinity())
{
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most)
          return {};
        const std::string range =
            most == std::numeric_limits<double>::infinity()
                ? "of at least " + CLI::detail::to_string(least)
                : "from " + CLI::detail::to_string(least) + " to " + CLI::detail::to_string(most);
        return "'" + text + "' is not a number " + range + (least == 0 && most == 1 ? share_meant(text) : "");
      },
      "");
}

/// Accepts a whole number of at least 0, also one like 1e6 or 20,000.
inline CLI::Validator whole_number()
{
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::string digits = text;
        digits.erase(std::remove(digits.begin(), digits.end(), ','), digits.end());
        double value = -1;
        constexpr double largest = 9007199254740992; // 2^53: every whole number up to it is a double
        if (!CLI::detail::lexical_cast(digits, value) || !(value >= 0 && value <= largest) ||
            value != std::floor(value) ||
            (digits != text && text != with_commas(static_cast<std::size_t>(value)))) // 20,5 and the like
          return "'" + text + "' is not a whole number from 0 to 2^53";
        text = std::to_string(static_cast<unsigned long long>(value));
        return {};
      },
      "");
}

/// Accepts one of a few words, and puts the value that it stands for in its place.
template <class Value>
CLI::Validator one_of(const std::map<std::string, Value>& values)
{
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const auto found = values.find(text);
        if (found != values.end()) {
          text = std::to_string(static_cast<int>(found->second));
          return {};
        }
        std::string message = "'" + text + "' is none of";
        const char* separator = " ";
        for (const auto& [word, value] : values) {
          message += separator + word;
          separator = ", ";
        }
        return message;
      },
      "");
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_SUBCOMMANDS_H
