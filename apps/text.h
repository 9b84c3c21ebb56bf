// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_APPS_TEXT_H
#define SELVEDGE_APPS_TEXT_H

#include <selvedge/Border_gaps.h>
#include <selvedge/replay.h>
#include <selvedge/verify.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace selvedge::app {

/// Returns 1234567 as 1,234,567.
inline std::string with_commas(std::size_t number)
{
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3)
    text.insert(i - 3, 1, ',');
  return text;
}

/// Returns a number with its noun: "1 face", "2,000 faces". The plural is given where it is another one.
inline std::string counted(std::size_t number, const std::string& noun, const std::string& plural = "")
{
  return with_commas(number) + ' ' + (number == 1 ? noun : plural.empty() ? noun + 's' : plural);
}

constexpr std::size_t most_printed = 5; ///< of the words of a list

/// Returns the first few of some words in a sentence.
inline std::string listed(const std::vector<std::string>& words, std::size_t most = most_printed)
{
  std::string text;
  for (std::size_t i = 0; i < (std::min)(most, words.size()); ++i)
    text += (i == 0 ? "" : ", ") + words[i];
  return words.size() > most ? text + " and " + with_commas(words.size() - most) + " more" : text;
}

/// What is said of the corners that `share_vertices_without_normals` joins.
constexpr const char* remark_on_joined_corners =
    "corners joined, for their vertices differ in nothing but their normals";

inline std::string with_digits(double value, const char* format = "%.3g")
{
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Returns a positive number with three digits, rounded up: whoever types them gets no less.
inline std::string with_digits_up(double value)
{
  const std::string text = with_digits(value);
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::stod(text) >= value ? text : with_digits(value + unit / 2);
}

/// Returns a share of 0.5 as "50 %".
inline std::string percent(double share)
{
  return with_digits(100 * share) + " %";
}

/// Says which pose it is: "pose 'walk'", or "the mesh's own pose".
inline std::string describe_pose(const Verification& verification, const std::optional<std::size_t>& further)
{
  return further ? "pose '" + verification.poses[*further].name + '\'' : "the mesh's own pose";
}

/// Says what the judge found of a clearance.
inline std::string describe(const Clearance_verdict& verdict)
{
  const std::size_t near = verdict.near.size(), too_near = verdict.too_near();
  std::string text = (near == 0 ? "no two pieces" : counted(near, "pair") + " of pieces") + " nearer than " +
                     with_digits(verdict.clearance);
  if (near > 0 && verdict.least_of_original)
    text +=
        too_near == 0 ? ", none nearer than before" : ", " + with_commas(too_near) + " NEARER than before";
  if (!std::isinf(verdict.least.lower))
    text += "; the least distance is " + with_digits(verdict.least.lower);
  if (verdict.least_of_original && !std::isinf(verdict.least_of_original->lower))
    text += ", and was " + with_digits(verdict.least_of_original->lower);
  return text;
}

/// Says of a step of a log, or of the result, what is wrong with it.
inline std::string describe(const Violation& violation)
{
  return (violation.step > 0
              ? "step " + with_commas(violation.step) + " (line " + with_commas(violation.line) + ", " +
                    std::to_string(violation.removed) + " to " + std::to_string(violation.kept) + ")"
              : "the result") +
         ": " + name(violation.kind) + ": " + violation.message;
}

/// Says how many border vertices have a partner within the clear length, which there is. Lengths that floats
/// of 32 bits hardly hold are the work of arithmetic, such as the sine of 180°.
inline std::string partners_in_clear_gaps(const Border_gaps& gaps, double diagonal)
{
  constexpr double share_of_rounding = 0x1p-22;
  return with_commas(gaps.within_clear_length) + " of " + with_commas(gaps.border_vertices) +
         " border vertices have a partner within " + with_digits_up(*gaps.clear_length) + " (" +
         (*gaps.clear_length <= share_of_rounding * diagonal
              ? "no more than rounding"
              : percent(*gaps.clear_length / diagonal) + " of the size") +
         ")";
}

/// Says how many border vertices are within the clear length to edges, which there is.
inline std::string edges_in_clear_gaps(const Border_gaps& gaps, double diagonal)
{
  return with_commas(gaps.within_clear_length_to_edges) + " of " + with_commas(gaps.border_vertices) +
         " border vertices are within " + with_digits_up(*gaps.clear_length_to_edges) + " (" +
         percent(*gaps.clear_length_to_edges / diagonal) + " of the size) of an edge of another border";
}

inline const char* name(Offence offence)
{
  switch (offence) {
  case Offence::degenerate:
    return "degenerate";
  case Offence::duplicate:
    return "duplicate";
  case Offence::intersection:
    return "intersection";
  }
  return "";
}

inline const char* name(Matched_by by)
{
  switch (by) {
  case Matched_by::vertices:
    return "vertices";
  case Matched_by::positions:
    return "positions";
  case Matched_by::borders:
    return "borders";
  case Matched_by::distance:
    return "distance";
  case Matched_by::triangles:
    return "triangles";
  }
  return "";
}

inline const char* name(Mismatch what)
{
  switch (what) {
  case Mismatch::missing:
    return "missing";
  case Mismatch::added:
    return "added";
  case Mismatch::topology:
    return "topology";
  case Mismatch::name:
    return "name";
  case Mismatch::far:
    return "far";
  case Mismatch::turned:
    return "turned";
  }
  return "";
}

} // namespace selvedge::app

#endif // SELVEDGE_APPS_TEXT_H
