// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_REDUCTION_LIMITS_H
#define SELVEDGE_REDUCTION_LIMITS_H

#include <array>
#include <optional>

namespace selvedge {

struct Simplify_options;

/// Limits of quality that a reduction keeps to, or by which it is judged. A limit without a value is not
/// judged. `Simplify_options` and `Prepare_options` say exactly what each limit bounds.
struct Reduction_limits
{
  std::optional<double> normal_change; ///< degrees
  std::optional<double> aspect_ratio;  ///< from 0 to 1, as `aspect_ratio()` defines it
  std::optional<double> border_turn;   ///< degrees
  std::optional<double> corner_height; ///< share of the diagonal; eases `border_turn`, `normal_change`
  std::optional<double> seam_turn;     ///< degrees
  std::optional<double> border_drift;  ///< share of the diagonal of the bounding box
  std::optional<double> weld_distance; ///< length in the unit of the coordinates
  std::optional<double> clearance;     ///< likewise
};

/// Describes one limit: its names in logs and reports, and the words for it in messages. They are written in
/// no other place.
struct Limit_description
{
  std::optional<double> Reduction_limits::*value;
  const char* key = "";  ///< in the `limit` lines of a log, in JSON, and as the name of its `Violation_kind`
                         ///< (except `corner_height`, which only eases two others)
  const char* unit = ""; ///< follows the number in a sentence
  const char* bounds = ""; ///< what the limit bounds
  const char* broken = ""; ///< what a step does that breaks the limit; the number and its unit follow
};

inline constexpr std::array<Limit_description, 8> limit_descriptions{
    {{&Reduction_limits::normal_change, "normal_change", "°",
      "by how much a collapse turns the normal of a triangle", "the normal of a triangle turns by more than"},
     {&Reduction_limits::aspect_ratio, "aspect_ratio", "", "how thin a collapse makes a triangle",
      "a triangle that is not between two lines gets thinner than it was, and its aspect ratio is less than"},
     {&Reduction_limits::border_turn, "border_turn", "°",
      "how sharp a corner of a border a collapse cuts off", "the border turns there by more than"},
     {&Reduction_limits::corner_height, "corner_height", " of the diagonal",
      "how high a corner may be where a border or a normal turns by more than border_turn or normal_change",
      ""},
     {&Reduction_limits::seam_turn, "seam_turn", "°", "how sharp a corner of a seam a collapse cuts off",
      "the seam turns there by more than"},
     {&Reduction_limits::border_drift, "border_drift", " of the diagonal",
      "how far collapses take a border or seam away from where it was",
      "the border or seam goes further away than"},
     {&Reduction_limits::weld_distance, "weld_distance", "", "how far a snap moves a vertex",
      "the vertex snaps further than"},
     {&Reduction_limits::clearance, "clearance", "", "how near a collapse brings a piece to another",
      "a triangle comes nearer to one of another piece than its neighbours were, and nearer than"}}};

/// Returns the description of the limit that is the member `value`.
constexpr const Limit_description& describe(std::optional<double> Reduction_limits::*value)
{
  std::size_t i = 0;
  while (limit_descriptions[i].value != value)
    ++i;
  return limit_descriptions[i];
}

/// Returns the limits that `simplify_soup` keeps to under `options`. The weld distance is not among them: it
/// belongs to `Prepare_options`.
Reduction_limits limits_of(const Simplify_options& options);

/// Returns the limits that Derichs, Misiak and Fuhrmann use: 45° of normal change, an aspect ratio of 0.2,
/// and 8° of turn. The pieces that they reduce are not sewn, so that every seam is a border of two pieces;
/// therefore 8° holds for borders and seams alike. There is no limit of drift, and no weld distance.
Reduction_limits limits_of_seed();

} // namespace selvedge

#endif // SELVEDGE_REDUCTION_LIMITS_H
